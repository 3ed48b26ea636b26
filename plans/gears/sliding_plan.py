"""The plans of sliding over the line of action, drawn in millimetres of paper: velocities, and specific sliding.

On `sliding` the abscissas are distances from N1, the ordinates velocities of the common point along both profiles. Its
marks are `N1` `N2`, the pole `P` with `W` above it, the twelve points `01` .. `12` of the table, and over them `V1_01`
`V2_01` .. on the lines from N1 and N2 through W, whose directions are `vk1` and `vk2`. On `theta` the same points
carry `T12_02` .. and `T21_01` .., ordinates of specific sliding; on its own base circle, where that is minus infinity,
a wheel has none. Abscissas have the scale factor mu_rho, ordinates of sliding mu_theta.

Source: GOST 16532-70; the construction is that of the note to the task `madi-gear`.
"""

from __future__ import annotations

from ..board import Board
from .gear import WHEELS
from .geometry import POINTS, sliding_places, specific_sliding

SLIDING, THETA = "sliding", "theta"
DIAGRAMS = (SLIDING, THETA)
RIGHT, UP = "_right", "_up"
FIRST = {1: POINTS[0], 2: POINTS[-1]}  # the point of a wheel's own base circle


def sliding(board: Board, pole: str) -> None:
    """Draw both plans; `pole` is the point of the table that stands in P."""
    sliding_places(board)
    velocity_lines(board)
    for point in POINTS:
        ordinates(board, point, pole)
    specific_sliding(board)
    theta_diagram(board)


def velocity_lines(board: Board) -> None:
    """Draw N1N2 with the pole, the velocity over it, and the lines from both ends through its tip."""
    board.turn(RIGHT, "zero")
    board.normal(UP, RIGHT)
    board.pole(f"{SLIDING}.N1")
    for name, rho in (("P", "_rho_at_P1"), ("N2", "l_N1N2")):
        board.calc(f"_paper_{name}", "on_paper", rho, "mu_rho")
        board.lay(f"{SLIDING}.{name}", f"{SLIDING}.N1", RIGHT, f"_paper_{name}")
    board.lay(f"{SLIDING}.W", f"{SLIDING}.P", UP, "PW")
    for i in WHEELS:
        board.measure(f"_l_N{i}W", f"{SLIDING}.N{i}", f"{SLIDING}.W")
        board.direction(f"vk{i}", f"{SLIDING}.N{i}", f"{SLIDING}.W", f"_l_N{i}W")


def ordinates(board: Board, point: str, pole: str) -> None:
    """Read both velocities at a point of the table: at N1 and N2 one of them is nothing, at the pole they are one."""
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
            board.calc(f"y_{i}_{point}", "sum", "_zero")
            continue
        if point == pole:
            board.same(tip, f"{SLIDING}.W")
        else:
            board.meet(tip, foot, UP, f"{SLIDING}.N{i}", f"vk{i}")
        board.distance(f"y_{i}_{point}", foot, tip)


def theta_diagram(board: Board) -> None:
    """Lay off specific sliding over the points of the table."""
    board.pole(f"{THETA}.N1")
    for point in POINTS:
        foot = f"{THETA}.{point}"
        board.calc(f"_abscissa_{point}", "on_paper", f"_rho_1_{point}", "mu_rho")
        board.lay(foot, f"{THETA}.N1", RIGHT, f"_abscissa_{point}")
        for i, letters in ((1, "12"), (2, "21")):
            if point != FIRST[i]:
                theta = f"theta_{letters}_{point}"
                board.calc(f"_paper_{theta}", "on_paper", theta, "mu_theta")
                board.lay(f"{THETA}.T{letters}_{point}", foot, UP, f"_paper_{theta}")
