"""The scheme of a hoist, and how far its beams bend.

On `scheme` the load stands in `A0` on the support beam from `O1` to `O2`, the drum above it in `A2` on the bridge beam
from `B1` to `B2`, left end first; in metres. On `beam_0` and `beam_2`, drawn in millimetres of paper, places run from
the nearer end with the scale factor mu_x, deflections downwards with mu_w: `f0` .. the axis, `w0` .. the beam under its
greatest force, `A` under the load, `M` where it bends most; on `beam_2` `v0` .. is the beam under the weight alone.
"""

from __future__ import annotations

from ..board import Board
from .diagram_plan import UP, line, part
from .hoist import LEFT
from .model import HORIZONTAL

SCHEME = "scheme"
BENT = {0: "beam_0", 2: "beam_2"}
SECTIONS = 12
FORCE = {0: ("P_st",), 2: ("P_12_max", "P_st")}  # what bends a beam
LETTERS = ("w", "v")
ENDS = {0: ("O1", "O2"), 2: ("B1", "B2")}


def scheme(board: Board, near: dict[int, str]) -> None:
    """Draw beams and rope; `near` says of either beam whether its left or its right end is the nearer one."""
    board.turn(HORIZONTAL, "zero")
    board.normal(UP, HORIZONTAL)
    board.pole(f"{SCHEME}.A0")
    board.lay(f"{SCHEME}.A2", f"{SCHEME}.A0", UP, "L")
    for i, (left, right) in ENDS.items():
        board.calc(f"_far_{i}", "excess", f"l_{i}", f"b_{i}")
        sides = (f"b_{i}", f"_far_{i}") if near[i] == LEFT else (f"_far_{i}", f"b_{i}")
        board.back(f"{SCHEME}.{left}", f"{SCHEME}.A{i}", HORIZONTAL, sides[0])
        board.lay(f"{SCHEME}.{right}", f"{SCHEME}.A{i}", HORIZONTAL, sides[1])


def beam(board: Board, i: int) -> None:
    """Draw a beam bent by its forces."""
    plan = BENT[i]
    board.calc(f"_x_M_{i}", "excess", f"l_{i}", f"x_w{i}")
    places = {str(k): f"_x_{k}_{i}" for k in range(SECTIONS + 1)}
    for k in range(SECTIONS + 1):
        board.calc(f"_x_{k}_{i}", "product", f"l_{i}", part(k, SECTIONS))
    feet = {f"f{n}": place for n, place in places.items()} | {"fA": f"b_{i}", "fM": f"_x_M_{i}"}
    for mark, place in feet.items():
        line(board, plan, mark, place, "mu_x")
    for letter, force in zip(LETTERS, FORCE[i], strict=False):
        for n, place in places.items():
            _bent(board, i, f"{letter}{n}", (place, f"f{n}"), force)
    _bent(board, i, "A", (f"b_{i}", "fA"), FORCE[i][0])
    board.calc(f"w_{i}", "given", f"_w_A_{i}")
    _bent(board, i, "M", (f"_x_M_{i}", "fM"), FORCE[i][0])


def bent_beam(board: Board, i: int, letter: str, force: str) -> None:
    """Draw a beam bent by a force: its point at the place `_x`."""
    line(board, BENT[i], "f", "_x", "mu_x")
    _bent(board, i, letter, ("_x", "f"), force)


def _bent(board: Board, i: int, mark: str, place: tuple[str, str], force: str) -> None:
    """Mark a point of the bent beam at a place, under its foot."""
    at, foot = place
    plan, name = BENT[i], f"_w_{mark}_{i}"
    board.calc(f"{name}_unit", "deflection_of_unit", at, f"b_{i}", f"l_{i}", f"I_{i}", f"E_{i}")
    board.calc(name, "product", force, f"{name}_unit")
    board.calc(f"{name}_paper", "ratio", name, "mu_w")
    board.back(f"{plan}.{mark}", f"{plan}.{foot}", UP, f"{name}_paper")
