"""The whole construction of a gear pair: its sizes calculated, its meshing drawn, velocities and sliding drawn.

`meshing`, in metres, has circles and line of action, involutes by rolling, teeth, active part, angles of action. Its
pole `P` is the origin, the line of centres vertical, `O1` below, `O2` above. The first number in a name is that of the
wheel:

- `N1` `N2`: where the line of action touches the base circles.
- `A1` `A2`: ends of the active line: where the tip circles of the wheel and of the pinion cut it.
- `K1` `K2`: a base pitch after A1 and before A2: between them one pair alone touches.
- `H1` `H2`: as far from N1 and N2 as the boundary points of the profiles are curved.
- `C_a1` `C_f1` `C_a2` `C_f2`: where tip and root circles cut the line of centres.
- `D1_0` `D1_1` ..: divisions of P N1, numbered from P; those after N1 go on beyond it.
- `T1_0` .., `E1_0` ..: the same parts laid off as arcs on the base circle, and the involute: its point k is as far from
  T1_k, along the tangent, as D1_k is from P. T1_n is N1 and E1_n is P, n being the number of parts of P N1; `T1_a`
  `E1_a` are those of the tip circle.
- `L1` `L2`: lower active points of the flanks that touch in P.
- `M1_1` `S1_1` `R1_1` ..: teeth 1, 2, 3 on the reference circle: middle, driving or driven flank, flank at rest. Tooth
  2 touches in P; 3 goes before it, 1 follows.
- `B1_start` `B1_end` ..: where the flank cuts the rolling circle at the start and at the end of engagement.

Directions: `tt` (the common tangent of the rolling circles), `centres`, `N1N2`.

Source: Artobolevsky, Theory of mechanisms and machines (involute gearing).

`sliding` and `theta` stand over the line of action, in metres of paper.

On `sliding` the abscissas are distances from N1, the ordinates velocities of the common point along both profiles. Its
marks are `N1` `N2`, the pole `P` with `W` above it, the twelve points `01` .. `12` of the table, and over them `V1_01`
`V2_01` .. on the lines from N1 and N2 through W. On `theta` the same points carry `T12_02` .. and `T21_01` ..,
ordinates of specific sliding; on its own base circle, where that is minus infinity, a wheel has none. Abscissas have
the scale factor mu_rho, ordinates of sliding mu_theta.

Source: GOST 16532-70; the construction is that of the note to the task `madi-gear`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from ..board import Board, Program, RecordingBoard, with_needs
from .gear import GEOMETRY_PART, MESHING_PART, PLANS, SLIDING_PART, WHEELS, ordinate
from .geometry import POINTS, SIZES, sliding_at, sliding_places

MESHING = "meshing"
TANGENT, CENTRES, ACTION = "tt", "centres", "N1N2"
PARTS, MOST = 4, 16  # into how many parts P N is divided, and how many of these an involute has at most
TEETH = {1: -1, 2: 0, 3: 1}  # of each wheel, and by how many pitches they go before the one that touches in P
TIP = "a"
NUMBERS = {
    "_minus_one": -1.0,
    "_base1": 0.5 * math.pi,  # directions from the centres to the pole
    "_base2": -0.5 * math.pi,
    **{f"_number{k}": float(k) for k in range(MOST + 1)},
    **{f"_ahead1_{j}": float(pitches) for j, pitches in TEETH.items()},
    **{f"_ahead2_{j}": float(-pitches) for j, pitches in TEETH.items()},
}


@dataclass(frozen=True, slots=True)
class _Rolling:
    """Into how many `parts` P N of a wheel is divided, and the `last` of these inside the tip circle."""

    parts: int
    last: int


def rolling(rho_w: float, rho_a: float) -> _Rolling:
    """Return how the involute of a wheel is divided whose curvatures at the pole and at the tip have these radii."""
    parts = max(min(PARTS, int(MOST * rho_w / rho_a)), 1)
    return _Rolling(parts, min(int(parts * rho_a / rho_w), MOST))


def mark(letters: str, i: int | str = "", number: int | str = "") -> str:
    """Return the name of a mark of this plan, `meshing.E1_2`."""
    return f"{MESHING}.{letters}{i}" + (f"_{number}" if number != "" else "")


def _meshing(board: Board, rollings: tuple[_Rolling, _Rolling], sense: int) -> None:
    """Draw the meshing and measure it."""
    _centres(board)
    _line_of_action(board)
    _active_line(board)
    for i, rolled in zip(WHEELS, rollings, strict=True):
        board.calc(f"_inv_p{i}", "unrolled_involute", f"nu_p{i}")
        board.calc(f"_inv_a{i}", "involute", f"alpha_a{i}")
        board.distance(f"r_p{i}", mark("O", i), mark("A", i))  # an arc carries the end of the active line to the flank
        board.calc(f"_down_flank{i}", "angle_on_flank", "inv_alpha_w", f"_inv_p{i}", "_sense")
        board.calc(f"_angle_of_L{i}", "sum", f"_base{i}", f"_down_flank{i}")
        board.turn(f"_to_L{i}", f"_angle_of_L{i}")
        board.lay(mark("L", i), mark("O", i), f"_to_L{i}", f"r_p{i}")
        _involute_by_rolling(board, i, rolled)
        _teeth(board, i)
    for i in WHEELS:
        _engagement(board, i, sense if i == 1 else -sense)
    board.calc("epsilon_alpha_drawn", "ratio_of", "g_alpha_drawn", "p_b")
    for i in WHEELS:  # once more, from the angles of action
        board.calc(f"epsilon_alpha_arc{i}", "ratio_of", f"phi_alpha{i}_drawn", f"tau_{i}")


def _centres(board: Board) -> None:
    """Draw the line of centres with both centres, tip and root circles on it; measure the clearances."""
    board.pole(mark("P"))
    board.turn(TANGENT, "zero")
    board.normal(CENTRES, TANGENT)
    for i in WHEELS:
        board.calc(f"_r_{i}", "half_of", f"d_{i}")
        for circle in "wbaf":
            board.calc(f"_r_{circle}{i}", "half_of", f"d_{circle}{i}")
    board.back(mark("O1"), mark("P"), CENTRES, "_r_w1")
    board.lay(mark("O2"), mark("P"), CENTRES, "_r_w2")
    for circle in "af":
        board.lay(mark("C", "", f"{circle}1"), mark("O1"), CENTRES, f"_r_{circle}1")
        board.back(mark("C", "", f"{circle}2"), mark("O2"), CENTRES, f"_r_{circle}2")
    board.distance("c_1", mark("C", "", "f1"), mark("C", "", "a2"))
    board.distance("c_2", mark("C", "", "f2"), mark("C", "", "a1"))


def _line_of_action(board: Board) -> None:
    """Lay off the angle of action at the pole, and draw the radii at right angles to the line."""
    board.calc("_angle_of_action", "angle_of_action", "alpha_w", "_sense")
    board.turn(ACTION, "_angle_of_action")
    board.normal("_radius", ACTION)
    for i in WHEELS:
        board.meet(mark("N", i), mark("O", i), "_radius", mark("P"), ACTION)
    board.distance("l_N1N2_drawn", mark("N1"), mark("N2"))


def _active_line(board: Board) -> None:
    """Mark the active line by arcs of the tip circles, the ends of the double contacts, the boundary points."""
    board.arc(mark("A1"), mark("O2"), "_r_a2", mark("P"), ACTION, "_minus_one")
    board.arc(mark("A2"), mark("O1"), "_r_a1", mark("P"), ACTION, "one")
    board.lay(mark("K1"), mark("A1"), ACTION, "p_b")
    board.back(mark("K2"), mark("A2"), ACTION, "p_b")
    board.lay(mark("H1"), mark("N1"), ACTION, "rho_l1")
    board.back(mark("H2"), mark("N2"), ACTION, "rho_l2")
    board.distance("g_alpha_drawn", mark("A1"), mark("A2"))


def _involute_by_rolling(board: Board, i: int, rolled: _Rolling) -> None:
    """Divide P N, lay the parts off on the base circle, and from there along the tangents what has been unrolled."""
    n = f"_number{rolled.parts}"
    board.measure(f"_l_PN{i}", mark("P"), mark("N", i))
    for k in range(rolled.last + 1):
        board.calc(f"_unrolled{i}_{k}", "unrolled_part", f"_l_PN{i}", f"_number{k}", n)
        if k == rolled.parts:
            for letter, own in (("D", "N"), ("T", "N"), ("E", "P")):
                board.same(mark(letter, i, k), mark(own, i) if own == "N" else mark(own))
            continue
        board.divide(mark("D", i, k), mark("P"), mark("N", i), f"_number{k}", n)
        _unrolled(board, i, k, f"_unrolled{i}_{k}")
    _unrolled(board, i, TIP, f"rho_a{i}")


def _unrolled(board: Board, i: int, k: int | str, length: str) -> None:
    """Mark the point of the base circle from which so much has been unrolled, and the end of what has been."""
    end = f"{i}_{k}"
    board.calc(
        f"_tangency{end}", "angle_of_tangency", f"_base{i}", "_sense", "alpha_w", f"_l_PN{i}", length, f"_r_b{i}"
    )
    board.turn(f"_to_T{end}", f"_tangency{end}")
    board.normal(f"_tangent{end}", f"_to_T{end}")
    board.calc(f"_laid{end}", "signed", length, "_sense")
    board.lay(mark("T", i, k), mark("O", i), f"_to_T{end}", f"_r_b{i}")
    board.lay(mark("E", i, k), mark("T", i, k), f"_tangent{end}", f"_laid{end}")


def _teeth(board: Board, i: int) -> None:
    """Lay off the angular pitch and the thickness on the reference circle, from the flank in P."""
    board.calc(f"_half_w{i}", "angle_of_thickness", f"s_w{i}", f"d_w{i}")
    board.calc(f"_half{i}", "angle_of_thickness", f"s_{i}", f"d_{i}")
    for j in TEETH:
        axis = f"_axis{i}_{j}"
        board.calc(axis, "angle_of_tooth", f"_base{i}", "_sense", f"_half_w{i}", f"tau_{i}", f"_ahead{i}_{j}")
        board.calc(f"_active{i}_{j}", "angle_beside", axis, "_sense", f"_half{i}")
        board.calc(f"_resting{i}_{j}", "angle_beside", axis, "_against", f"_half{i}")
        for letter, angle in (("M", axis), ("S", f"_active{i}_{j}"), ("R", f"_resting{i}_{j}")):
            board.turn(f"_to_{letter}{i}_{j}", angle)
            board.lay(mark(letter, i, j), mark("O", i), f"_to_{letter}{i}_{j}", f"_r_{i}")


def _engagement(board: Board, i: int, sense: int) -> None:
    """Turn the flank so that it touches in A1 and in A2, and read the angle of action of a wheel that turns so."""
    for end, ahead in (("start", "A1"), ("end", "A2")):
        at = f"_inv_p{i}" if ahead == f"A{i}" else f"_inv_a{i}"
        board.measure(f"_l_O{i}{ahead}", mark("O", i), mark(ahead))
        board.direction(f"_O{i}{ahead}", mark("O", i), mark(ahead), f"_l_O{i}{ahead}")
        board.calc(f"_along_flank{i}_{end}", "angle_on_flank", at, "inv_alpha_w", "_sense")
        board.turn(f"_slope{i}_{end}", f"_along_flank{i}_{end}")
        board.incline(f"flank_O{i}B{i}_{end}", f"_O{i}{ahead}", f"_slope{i}_{end}")
        board.lay(mark("B", i, end), mark("O", i), f"flank_O{i}B{i}_{end}", f"_r_w{i}")
    ends = (f"flank_O{i}B{i}_start", f"flank_O{i}B{i}_end")
    board.angle(f"_phi_alpha{i}", *(ends if sense > 0 else reversed(ends)))
    board.calc(f"phi_alpha{i}_drawn", "given", f"_phi_alpha{i}")


SLIDING, THETA = "sliding", "theta"
DIAGRAMS = (SLIDING, THETA)
RIGHT, UP = "_right", "_up"
FIRST = {1: POINTS[0], 2: POINTS[-1]}  # the point of a wheel's own base circle
# what is minus infinity, which nobody draws, with the other one of its point
ENDLESS = {f"theta_{i}{3 - i}_{point}": f"theta_{3 - i}{i}_{point}" for i, point in FIRST.items()}


def _sliding(board: Board, pole: str) -> None:
    """Draw both plans; `pole` is the point of the table that stands in P."""
    sliding_places(board)
    board.turn(RIGHT, "zero")  # N1N2 with the pole, and the velocity over it, to whose tip the lines of both ends run
    board.normal(UP, RIGHT)
    board.pole(f"{SLIDING}.N1")
    for name, rho in (("P", "_rho_at_P1"), ("N2", "l_N1N2")):
        board.calc(f"_paper_{name}", "on_paper", rho, "mu_rho")
        board.lay(f"{SLIDING}.{name}", f"{SLIDING}.N1", RIGHT, f"_paper_{name}")
    board.lay(f"{SLIDING}.W", f"{SLIDING}.P", UP, "PW")
    for point in POINTS:
        _ordinates(board, point, pole)
    for point in POINTS:
        for i in (i for i in WHEELS if FIRST[i] != point):
            sliding_at(board, point, i)
    _theta_diagram(board)


def _ordinates(board: Board, point: str, pole: str) -> None:
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


def _theta_diagram(board: Board) -> None:
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


NEEDS = {GEOMETRY_PART: (), MESHING_PART: (GEOMETRY_PART,), SLIDING_PART: (GEOMETRY_PART,)}


@dataclass(frozen=True, slots=True)
class Layout:
    """What the construction of a pair depends on beside numbers.

    `rollings` say how the involutes of both wheels are divided, `sense` is +1 where the pinion turns counter-clockwise,
    `pole` the point of the table of sliding that stands in P.
    """

    rollings: tuple[_Rolling, _Rolling]
    sense: int
    pole: str


def construct(layout: Layout, plans: Iterable[str] = PLANS) -> Program:
    """Record the construction of the plans wanted and of those they need."""
    board, wanted = RecordingBoard(), with_needs(plans, NEEDS)
    if GEOMETRY_PART in wanted:
        for part in SIZES:
            part(board)
    if MESHING_PART in wanted:
        _meshing(board, layout.rollings, layout.sense)
    if SLIDING_PART in wanted:
        _sliding(board, layout.pole)
    return Program(board.steps)
