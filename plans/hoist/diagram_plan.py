"""The forces over time, drawn in millimetres of paper: F_01 and F_12 until the lift-off, P_12 for a swing after it.

Abscissas have the scale factor mu_t, ordinates mu_F. On `forces` section lines stand at `f0` .. `f12` and, after the
lift-off, at `g0` .. `g12`; on them are `S0` .. of the support's force, `R0` .. of the rope's, and `P0` .. of the rope's
with the whole load. Ordinates of phase 2 are the abscissas of points `1`, `2`, .. of the circle, which turns by equal
angles; `T` stands where the force is greatest, `L` where it is least, `M` where it is greatest before the lift-off.
"""

from __future__ import annotations

from ..board import Board
from .model import CIRCLE, HORIZONTAL, rope_force

FORCES = "forces"
UP = "_up"
SECTIONS = 12  # of either phase, at least
RESTING, HANGING = "f", "g"  # section lines of the phases


def axes(board: Board) -> None:
    """Take the directions of the axes of all diagrams."""
    board.turn(HORIZONTAL, "zero")
    board.normal(UP, HORIZONTAL)


def point(board: Board, plan: str, mark: str, abscissa: str, value: str, mu: str) -> None:
    """Mark on a section line, whose abscissa on paper is known, a value to its scale."""
    board.calc(f"_paper_{plan}_{mark}", "ratio", value, mu)
    board.place(f"{plan}.{mark}", abscissa, f"_paper_{plan}_{mark}")


def line(board: Board, plan: str, mark: str, time: str, mu: str = "mu_t") -> str:
    """Mark where a section line stands on the axis of times; return the name of its abscissa on paper."""
    abscissa = f"_abscissa_{plan}_{mark}"
    board.calc(abscissa, "ratio", time, mu)
    board.place(f"{plan}.{mark}", abscissa, "zero")
    return abscissa


def part(i: int, sections: int) -> str:
    """Return the name of the given that is i / sections."""
    return f"_part_{i}_{sections}"


def resting(board: Board, sections: int) -> None:
    """Draw both forces until the lift-off by the formulas (9) and (10)."""
    for i in range(sections + 1):
        time = f"_t_{RESTING}{i}"
        board.calc(time, "product", "t_1", part(i, sections))
        board.calc(f"_lag_{RESTING}{i}", "lagging", "V_t", "a", "k", time)
        board.calc(f"_F_01_{i}", "support_force", "C", f"_lag_{RESTING}{i}", "P_st")
        rope_force(board, f"_F_12_{i}", time)
        _rest_points(board, i, time)


def _rest_points(board: Board, i: int, time: str) -> None:
    abscissa = line(board, FORCES, f"{RESTING}{i}", time)
    point(board, FORCES, f"S{i}", abscissa, f"_F_01_{i}", "mu_F")
    point(board, FORCES, f"R{i}", abscissa, f"_F_12_{i}", "mu_F")


def hanging(board: Board, sections: int) -> None:
    """Draw the force of the rope over one swing, from the points of the circle, and where it is greatest."""
    board.calc("_period", "period", "k_1")
    for i in range(sections + 1):
        at, time = f"{CIRCLE}.{i + 1}" if i else f"{CIRCLE}.1", f"_T_{HANGING}{i}"
        board.calc(time, "product", "_period", part(i, sections))
        if i:
            board.calc(f"_run{i}", "product", "_turn", part(i, sections))
            board.calc(f"_angle{i}", "excess", "phi_1", f"_run{i}")
            board.turn(f"_ray{i}", f"_angle{i}")
            board.lay(at, f"{CIRCLE}.C", f"_ray{i}", "R")
        board.read(f"_from_C{i}", f"{CIRCLE}.C", at)
        board.calc(f"_swing{i}", "component", f"_from_C{i}", HORIZONTAL)
        board.calc(f"_P_12_{i}", "suspended_force", "P_m", f"_swing{i}")
        _hang_point(board, i, time)
    board.calc("t_P12_max", "later", "t_1", "T_1")
    point(board, FORCES, "T", line(board, FORCES, "fT", "t_P12_max"), "P_12_max", "mu_F")


def _hang_point(board: Board, i: int, time: str) -> None:
    board.calc(f"_t_{HANGING}{i}", "later", "t_1", time)
    abscissa = line(board, FORCES, f"{HANGING}{i}", f"_t_{HANGING}{i}")
    point(board, FORCES, f"P{i}", abscissa, f"_P_12_{i}", "mu_F")


def extreme_points(board: Board, least: str) -> None:
    """Mark the greatest force before the lift-off, and the least one after it, whose time is a given.

    The force of the support is the deflection of its beam, too, to a scale factor of its own.
    """
    board.calc("_mu_w_0", "ratio", "mu_F", "C_01")
    point(board, FORCES, "M", line(board, FORCES, "fM", "t_F12_max"), "F_12_max", "mu_F")
    point(board, FORCES, "L", line(board, FORCES, "fL", least), "P_12_min", "mu_F")


def moving(board: Board, before: int, after: int) -> None:
    """Draw the forces of a motion that the formulas are not valid for, with the ordinates that it gives."""
    for i in range(before + 1):
        for name in (f"_t_{RESTING}{i}", f"_F_01_{i}", f"_F_12_{i}"):
            board.calc(name, "given", f"{name}_motion")
        _rest_points(board, i, f"_t_{RESTING}{i}")
    for i in range(after + 1):
        for name in (f"_T_{HANGING}{i}", f"_P_12_{i}"):
            board.calc(name, "given", f"{name}_motion")
        _hang_point(board, i, f"_T_{HANGING}{i}")
    board.calc("t_P12_max", "later", "t_1", "T_1")
    point(board, FORCES, "T", line(board, FORCES, "fT", "t_P12_max"), "P_12_max", "mu_F")


def diameter(board: Board, slack: bool) -> None:
    """Mark on the circle the greatest and the least force, and at its sides those of a rope that goes slack."""
    board.turn(HORIZONTAL, "zero")
    board.lay(f"{CIRCLE}.max", f"{CIRCLE}.C", HORIZONTAL, "R")
    board.back(f"{CIRCLE}.min", f"{CIRCLE}.C", HORIZONTAL, "R")
    if slack:
        board.calc("_slack_high", "other_leg", "R", "P_m")
        board.calc("_slack_low", "opposite", "_slack_high")
        for side in ("high", "low"):
            board.place(f"{CIRCLE}.{side}", "zero", f"_slack_{side}")
