"""The plans of sliding over the line of action, drawn in millimetres of paper: velocities, and specific sliding.

On `sliding` the abscissas are distances from N1, the ordinates velocities of the common point along both profiles. Its
marks are `N1` `N2`, the pole `P` with `W` above it, the twelve points `01` .. `12` of the table, and over them `V1_01`
`V2_01` .. on the lines from N1 and N2 through W. On `theta` the same points carry `T12_02` .. and `T21_01` ..,
ordinates of specific sliding; on its own base circle, where that is minus infinity, a wheel has none. Abscissas have
the scale factor mu_rho, ordinates of sliding mu_theta.

Source: GOST 16532-70; the construction is that of the note to the task `madi-gear`.
"""

from __future__ import annotations

from ..board import Board
from .gear import WHEELS, ordinate
from .geometry import POINTS, sliding_at, sliding_places

SLIDING, THETA = "sliding", "theta"
DIAGRAMS = (SLIDING, THETA)
RIGHT, UP = "_right", "_up"
FIRST = {1: POINTS[0], 2: POINTS[-1]}  # the point of a wheel's own base circle
# what is minus infinity, which nobody draws, with the other one of its point
ENDLESS = {f"theta_{i}{3 - i}_{point}": f"theta_{3 - i}{i}_{point}" for i, point in FIRST.items()}


def sliding(board: Board, pole: str) -> None:
    """Draw both plans; `pole` is the point of the table that stands in P."""
    sliding_places(board)
    velocity_lines(board)
    for point in POINTS:
        ordinates(board, point, pole)
    for point in POINTS:
        for i in (i for i in WHEELS if FIRST[i] != point):
            sliding_at(board, point, i)
    theta_diagram(board)


def velocity_lines(board: Board) -> None:
    """Draw N1N2 with the pole, and the velocity over it, to whose tip the lines from both ends run."""
    board.turn(RIGHT, "zero")
    board.normal(UP, RIGHT)
    board.pole(f"{SLIDING}.N1")
    for name, rho in (("P", "_rho_at_P1"), ("N2", "l_N1N2")):
        board.calc(f"_paper_{name}", "on_paper", rho, "mu_rho")
        board.lay(f"{SLIDING}.{name}", f"{SLIDING}.N1", RIGHT, f"_paper_{name}")
    board.lay(f"{SLIDING}.W", f"{SLIDING}.P", UP, "PW")


def ordinates(board: Board, point: str, pole: str) -> None:
    """Read both velocities at a point of the table: at N1 and N2 one of them is nothing, at the pole they are one.

    The lines are straight, so that their points divide them as the feet divide N1P and N2P.
    """
    foot = f"{SLIDING}.{point}"
    ends = {POINTS[0]: "N1", POINTS[-1]: "N2", pole: "P"}
    if point in ends:
        board.same(foot, f"{SLIDING}.{ends[point]}")
    else:
        board.calc(f"_paper_{point}", "on_paper", f"_rho_1_{point}", "mu_rho")
        board.lay(foot, f"{SLIDING}.N1", RIGHT, f"_paper_{point}")
    for i in WHEELS:
        tip = f"{SLIDING}.V{i}_{point}"
        if point == FIRST[i]:
            board.same(tip, f"{SLIDING}.N{i}")
            board.calc(ordinate(i, point), "sum", "_zero")
            continue
        if point == pole:
            board.same(tip, f"{SLIDING}.W")
        else:
            board.divide(tip, f"{SLIDING}.N{i}", f"{SLIDING}.W", f"_rho_{i}_{point}", f"_rho_at_P{i}")
        board.distance(ordinate(i, point), foot, tip)


def theta_diagram(board: Board) -> None:
    """Lay off specific sliding over the points of the table."""
    board.pole(f"{THETA}.N1")
    for point in POINTS:
        foot = f"{THETA}.{point}"
        board.calc(f"_abscissa_{point}", "on_paper", f"_rho_1_{point}", "mu_rho")
        board.lay(foot, f"{THETA}.N1", RIGHT, f"_abscissa_{point}")
        for i in (i for i in WHEELS if FIRST[i] != point):
            end = f"{i}{3 - i}_{point}"
            board.calc(f"_paper_{end}", "on_paper", f"theta_{end}", "mu_theta")
            board.lay(f"{THETA}.T{end}", foot, UP, f"_paper_{end}")
