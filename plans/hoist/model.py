"""The forces of a hoist as a construction, in the order of a student's note: numbers, and the circle of phase 2.

Until t_1 the load stands on the support beam, and the rope only takes it up; then it hangs. What the two-sided formulas
give is only valid while the rope pulls and the support pushes: `forces` looks, and takes the motion where it is not.

Source: Karpenko, Muzyka, Gudym; the primed formulas are exact where the article simplifies.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from typing import Any

import numpy as np

from ..board import Board, Program, RecordingBoard
from ..boards.arrays import ArrayBoard
from ..boards.exact import ExactBoard
from ..names import is_shown, role
from .lift_off import BEAMS, lifting_off, reduced, rope_force
from .refining import rest_of_root

CIRCLE, HORIZONTAL = "circle", "_right"


def extremes(board: Board) -> None:
    """The greatest and the least force of the rope in phase 1: formula (12)."""
    board.calc("_ratio", "ratio", "C_01", "C_12")
    board.calc("_t_last", "last_maximum", "V_t", "a", "k", "_ratio", "t_1")
    board.calc("_t_first", "first_minimum", "V_t", "a", "k", "_ratio", "t_1")
    rope_force(board, "_F_last", "_t_last")
    rope_force(board, "_F_first", "_t_first")
    board.calc("F_12_max", "larger_of", "_F_last", "F_12_t1")
    board.calc("t_F12_max", "time_of_larger", "_F_last", "F_12_t1", "_t_last", "t_1")
    board.calc("F_12_min", "smaller_of", "_F_first", "F_12_t1")


def circle(board: Board) -> None:
    """Phase 2 as a circle: abscissas are the force of the rope, ordinates its rate by k_1; formula (13)."""
    board.calc("P_m", "mean_force", "m", "g", "a")
    board.calc("D_0", "excess", "F_12_t1", "P_m")
    board.calc("D_1", "ratio", "_dF_t1", "k_1")
    board.place(f"{CIRCLE}.C", "P_m", "zero")
    board.place(f"{CIRCLE}.1", "F_12_t1", "D_1")
    board.distance("R", f"{CIRCLE}.C", f"{CIRCLE}.1")
    board.read("_radius", f"{CIRCLE}.C", f"{CIRCLE}.1")
    board.turn(HORIZONTAL, "zero")
    board.angle("_phi", HORIZONTAL, "_radius")
    board.calc("phi_1", "whole_angle", "_phi")


def suspended(board: Board) -> None:
    """The greatest and the least force of the rope in phase 2, at the ends of a diameter: formula (15')."""
    board.calc("T_1", "ratio", "phi_1", "k_1")
    board.calc("P_12_max", "sum", "P_m", "R")
    board.calc("P_12_min", "excess", "P_m", "R")


def lifted(board: Board) -> None:
    """How high above the support the load is when it is lowest after the lift-off."""
    board.calc("_T_low", "lowest_after", "_dy_t1", "a", "k_1", "D_0", "D_1", "m")
    board.calc("_t_low", "later", "t_1", "_T_low")
    board.calc("_y_low", "wound", "V_t", "a", "_t_low")
    board.calc("_D_low", "swing", "D_0", "D_1", "k_1", "_T_low")
    board.calc("_P_low", "suspended_force", "P_m", "_D_low")
    board.calc("s_min", "height", "_y_low", "P_st", "C_01", "_P_low", "C_12")


def printed(board: Board) -> None:
    """What the article prints: formulas (14) and (15), for a rigid support and V_0 as the speed at the lift-off."""
    board.calc("_V_printed", "article_speed", "V_0", "a", "slack", "P_st", "C_12")
    board.calc("P_12_max_printed", "article_maximum", "m", "g", "a", "_V_printed", "C_12")
    board.calc("T_1_printed", "article_time", "_V_printed", "k_1", "a")
    board.calc("_stress_printed", "stress", "P_12_max_printed", "S")
    board.calc("_safety_printed", "ratio", "sigma", "_stress_printed")


def strength(board: Board) -> None:
    """The stress of the rope, its safety, and how far the beams bend."""
    board.calc("F_max", "larger_of", "F_12_max", "P_12_max")
    board.calc("sigma_max", "stress", "F_max", "S")
    board.calc("safety", "ratio", "sigma", "sigma_max")
    board.calc("dynamic_factor", "ratio", "P_12_max", "P_st")
    for i, force in zip(BEAMS, ("P_st", "P_12_max"), strict=True):
        board.calc(f"w_{i}_max", "greatest_deflection", force, f"b_{i}", f"l_{i}", f"I_{i}", f"E_{i}")
        board.calc(f"x_w{i}", "place_of_deflection", f"b_{i}", f"l_{i}")


def moved(board: Board) -> None:
    """What the motion of a load on a one-sided support, by a one-sided rope, gives in the place of formulas."""
    for name in ("t_1", "F_12_t1", "_dF_t1", "F_12_max", "t_F12_max", "F_12_min"):
        board.calc(name, "given", motion_given(name))


def moved_on(board: Board) -> None:
    """The same after the load has left its support."""
    for name in ("T_1", "P_12_max", "P_12_min", "s_min"):
        board.calc(name, "given", motion_given(name))


def motion_given(name: str) -> str:
    """Return the name of the given that is a quantity's value in the motion."""
    return f"_{role(name).shown}_motion"


TWO_SIDED = (reduced, lifting_off, extremes, circle, suspended, lifted, strength, printed)
ONE_SIDED = (reduced, moved, circle, moved_on, strength, printed)


@cache
def model_program(one_sided: bool = False) -> Program:
    """Return all steps, in order, recorded: formulas, or with the results of a motion in the place of some of them."""
    board = RecordingBoard()
    for part in ONE_SIDED if one_sided else TWO_SIDED:
        part(board)
    return Program(board.steps)


@cache
def _needed(wanted: tuple[str, ...], one_sided: bool) -> Program:
    program = model_program(one_sided)
    return program.needed_for(wanted) if wanted else program


def model(values: Mapping[str, Any], wanted: Iterable[str] = (), one_sided: bool = False) -> dict[str, Any]:
    """Return the quantities of a hoist by name, in SI, after the givens; by the formulas, whether valid or not.

    Parameters
    ----------
    values : mapping of str to float or array
        The complete givens, with any shapes that go together; with `one_sided` those of the motion, too.
    wanted : iterable of str
        Names of the quantities wanted, with which those come that they need; by default all.

    Returns
    -------
    dict of str to float or array
        Infinite where a beam is rigid.
    """
    program = _needed(tuple(wanted), one_sided)
    values = {name: value if np.ndim(value) else np.float64(value) for name, value in values.items()}  # 1/0 is inf
    givens = {**values, "_rest": 0.0 if one_sided else rest_of_root(values)}
    many = [value for value in givens.values() if np.ndim(value)]
    board = ArrayBoard(givens, np.broadcast(*many).size) if many else ExactBoard(givens)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        program.run(board)
    names = (name for name in (*values, *program.names) if is_shown(name))
    found = {name: board.values[name] for name in names}
    return {name: value if np.ndim(value) else float(value) for name, value in found.items()}
