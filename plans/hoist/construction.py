"""The whole construction of a hoist: its numbers with the circle of phase 2, and the drawings that are wanted.

The forces over time are drawn in millimetres of paper, F_01 and F_12 until the lift-off, P_12 for a swing after it.
Abscissas have the scale factor mu_t, ordinates mu_F. On `forces` section lines stand at `f0` .. `f12` and, after the
lift-off, at `g0` .. `g12`; on them are `S0` .. of the support's force, `R0` .. of the rope's, and `P0` .. of the rope's
with the whole load. Ordinates of phase 2 are the abscissas of points `1`, `2`, .. of the circle, which turns by equal
angles; `T` stands where the force is greatest, `L` where it is least, `M` where it is greatest before the lift-off.

The equations (11) and (12) are solved by drawing: where two curves cross, joined from section line to section line. On
`lift_off` points `Y0` .. lie on the parabola y - m g / C, `O0` .. on the sinusoid osc; `X` is where their chords cross,
and its abscissa is the time of the lift-off as it is drawn. On `extremes` points `W0` .. lie on the sinusoid V cos k t
+ (a/k) sin k t, the straight line -(C_01/C_12) (V + a t) runs from `L0` to `L1`; `X1` .. are their crossings, at which
the force of the rope is greatest and least in turn. Abscissas have the scale factor mu_t1, ordinates mu_y and mu_v;
where the load swings too often before the lift-off only the last swings are drawn.

On `scheme` the load stands in `A0` on the support beam from `O1` to `O2`, the drum above it in `A2` on the bridge beam
from `B1` to `B2`, left end first; in metres. On `beam_0` and `beam_2`, drawn in millimetres of paper, places run from
the nearer end with the scale factor mu_x, deflections downwards with mu_w: `f0` .. the axis, `w0` .. the beam under its
greatest force, `A` under the load, `M` where it bends most; on `beam_2` `v0` .. is the beam under the weight alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ..board import Board, Program, RecordingBoard
from ..laws import TURN
from ..names import Name, role
from .forces import ROPE_1, Forces
from .hoist import BEAMS_PART, CIRCLE_PART, DRAWN, FORCES_PART, LEFT, PLANS, ROOTS_PART, SCHEME_PART, Hoist
from .model import CIRCLE, HORIZONTAL, ONE_SIDED, TWO_SIDED, moved, rope_force
from .roots import extremes

FORCES, LIFT_OFF, EXTREMES = "forces", "lift_off", "extremes"
BENT = {0: "beam_0", 2: "beam_2"}
# scale factors of the axes of each diagram; deflections are read downwards
AXES = {FORCES: ("mu_t", "mu_F"), LIFT_OFF: ("mu_t1", "mu_y"), EXTREMES: ("mu_t1", "mu_v")}
AXES |= dict.fromkeys(BENT.values(), ("mu_x", "mu_w"))
UP = "_up"
SECTIONS = 12  # of either phase, at least
RESTING, HANGING = "f", "g"  # section lines of the phases


def points(board: Board, plan: str, foot: str, at: str, **values: str) -> None:
    """Mark where a section line stands on the axis, and on it values by their marks, to the scales of the plan."""
    along, upwards = AXES[plan]
    abscissa = f"_abscissa_{plan}_{foot}"
    board.calc(abscissa, "ratio", at, along)
    board.place(f"{plan}.{foot}", abscissa, "zero")
    for mark, value in values.items():
        _point(board, f"{plan}.{mark}", abscissa, value, upwards)


def _point(board: Board, mark: str, abscissa: str, value: str, mu: str) -> None:
    """Mark on a section line, whose abscissa on paper is known, a value to its scale."""
    ordinate = f"_paper_{mark}".replace(".", "_")
    board.calc(ordinate, "ratio", value, mu)
    board.place(mark, abscissa, ordinate)


def part(i: int, sections: int) -> str:
    """Return the name of the given that is i / sections."""
    return f"_part_{i}_{sections}"


def _resting(board: Board, sections: int, moves: bool) -> None:
    """Draw both forces until the lift-off by the formulas (9) and (10), or as a motion gives them."""
    for i in range(sections + 1):
        time, support, rope = f"_t_{RESTING}{i}", f"_F_01_{i}", f"_F_12_{i}"
        if moves:
            moved(time, support, rope)(board)
        else:
            board.calc(time, "product", "t_1", part(i, sections))
            board.calc(f"_lag_{RESTING}{i}", "lagging", "V_t", "a", "k", time)
            board.calc(support, "support_force", "C", f"_lag_{RESTING}{i}", "P_st")
            rope_force(board, rope, time)
        points(board, FORCES, f"{RESTING}{i}", time, **{f"S{i}": support, f"R{i}": rope})


def _hanging(board: Board, sections: int, moves: bool) -> None:
    """Draw the force of the rope over one swing, from the points of the circle, or as a motion gives it."""
    if not moves:
        board.calc("_period", "period", "k_1")
    for i in range(sections + 1):
        if moves:
            moved(f"_T_{HANGING}{i}", f"_P_12_{i}")(board)
        else:  # turn the circle by i sections of a swing
            at = f"{CIRCLE}.{i + 1}"
            board.calc(f"_T_{HANGING}{i}", "product", "_period", part(i, sections))
            if i:
                board.calc(f"_run{i}", "product", "_turn", part(i, sections))
                board.calc(f"_angle{i}", "excess", "phi_1", f"_run{i}")
                board.turn(f"_ray{i}", f"_angle{i}")
                board.lay(at, f"{CIRCLE}.C", f"_ray{i}", "R")
            board.read(f"_from_C{i}", f"{CIRCLE}.C", at)
            board.calc(f"_swing{i}", "component", f"_from_C{i}", HORIZONTAL)
            board.calc(f"_P_12_{i}", "suspended_force", "P_m", f"_swing{i}")
        board.calc(f"_t_{HANGING}{i}", "later", "t_1", f"_T_{HANGING}{i}")
        points(board, FORCES, f"{HANGING}{i}", f"_t_{HANGING}{i}", **{f"P{i}": f"_P_12_{i}"})


def _extreme_points(board: Board) -> None:
    """Mark the greatest forces, the one before the lift-off last, and the least one after it, whose time is a given.

    The force of the support is the deflection of its beam, too, to a scale factor of its own.
    """
    board.calc("t_P12_max", "later", "t_1", "T_1")
    points(board, FORCES, "fT", "t_P12_max", T="P_12_max")
    board.calc("_mu_w_0", "ratio", "mu_F", "C_01")
    points(board, FORCES, "fM", "t_F12_max", M="F_12_max")
    points(board, FORCES, "fL", "_t_P12_min", L="P_12_min")


def _diameter(board: Board, slack: bool) -> None:
    """Mark on the circle the greatest and the least force, and at its sides those of a rope that goes slack."""
    board.turn(HORIZONTAL, "zero")
    board.lay(f"{CIRCLE}.max", f"{CIRCLE}.C", HORIZONTAL, "R")
    board.back(f"{CIRCLE}.min", f"{CIRCLE}.C", HORIZONTAL, "R")
    if slack:
        board.calc("_slack_high", "other_leg", "R", "P_m")
        board.calc("_slack_low", "opposite", "_slack_high")
        for side in ("high", "low"):
            board.place(f"{CIRCLE}.{side}", "zero", f"_slack_{side}")


def _lift_off_plan(board: Board, sections: int, crossed: int) -> None:
    """Draw parabola and sinusoid of (11); they cross in the section after the line `crossed`."""
    board.calc("_height", "ratio", "P_st", "C")
    board.calc("_ratio", "ratio", "C_01", "C_12")
    for i in range(sections + 1):
        board.calc(seen(i), "product", "_section", part(i, 1))
        lift_off_points(board, i)
    for curve in "YO":
        _chord(board, LIFT_OFF, curve, crossed)
    board.meet(f"{LIFT_OFF}.X", *_on(LIFT_OFF, "Y", crossed), *_on(LIFT_OFF, "O", crossed))
    _read_time(board, drawn_name("t_1"), LIFT_OFF, "X")


def drawn_name(name: str) -> Name:
    """Return the name of a quantity as a drawing gives it."""
    return Name(f"{name}_{DRAWN}", role(name).kind, role(name).of, part=DRAWN)


def seen(i: int | str) -> str:
    """Return the name of the time of a section line, counted from the first one."""
    return f"_t_{i}_{LIFT_OFF}_seen"


def lift_off_points(board: Board, i: int | str) -> None:
    """Mark parabola and sinusoid on the line `i`, or on any of its own time."""
    time = f"_t_{i}_{LIFT_OFF}"
    board.calc(time, "later", "_begin", seen(i))
    board.calc(f"_y_{i}", "wound", "V_t", "a", time)
    board.calc(f"_parabola{i}", "excess", f"_y_{i}", "_height")
    board.calc(f"_sinusoid{i}", "oscillation", "V_t", "a", "k", time)
    points(board, LIFT_OFF, f"f{i}", seen(i), **{f"Y{i}": f"_parabola{i}", f"O{i}": f"_sinusoid{i}"})


def _extremes_plan(board: Board, sections: int, crossed: Iterable[int]) -> None:
    """Draw sinusoid and straight line of (12), which cross in the sections after the lines `crossed`."""
    for i in range(sections + 1):
        extremes_point(board, i)
    for k, i in enumerate((0, sections)):
        board.calc(f"_winding{k}", "winding_speed", "V_t", "a", f"_t_{i}_{LIFT_OFF}")
        board.calc(f"_share{k}", "product", "_ratio", f"_winding{k}")
        board.calc(f"_line{k}", "opposite", f"_share{k}")
        _point(board, f"{EXTREMES}.L{k}", f"_abscissa_{EXTREMES}_f{i}", f"_line{k}", "mu_v")
    _chord(board, EXTREMES, "L", 0)
    for n, i in enumerate(crossed, 1):
        _chord(board, EXTREMES, "W", i)
        board.meet(f"{EXTREMES}.X{n}", *_on(EXTREMES, "W", i), *_on(EXTREMES, "L", 0))
        board.calc(f"t_2_{n}", "given", f"_t_2_{n}_exact")
        _read_time(board, drawn_name(f"t_2_{n}"), EXTREMES, f"X{n}")


def extremes_point(board: Board, i: int | str) -> None:
    """Mark the sinusoid of (12) on the line `i`, or on any of its own time, when (11) is drawn there."""
    board.calc(f"_wave{i}", "oscillation_rate", "V_t", "a", "k", f"_t_{i}_{LIFT_OFF}")
    points(board, EXTREMES, f"f{i}", seen(i), **{f"W{i}": f"_wave{i}"})


def _chord(board: Board, plan: str, curve: str, i: int) -> None:
    """Join the points of a curve on the section line `i` and the next one."""
    ends = f"{plan}.{curve}{i}", f"{plan}.{curve}{i + 1}"
    board.measure(f"_{plan}_{curve}{i}_length", *ends)
    board.direction(f"_{plan}_{curve}{i}", *ends, f"_{plan}_{curve}{i}_length")


def _on(plan: str, curve: str, i: int) -> tuple[str, str]:
    """Return a point of a chord, and its direction."""
    return f"{plan}.{curve}{i}", f"_{plan}_{curve}{i}"


def _read_time(board: Board, name: str, plan: str, mark: str) -> None:
    """Read the abscissa of a mark as a time, beginning with that of the first section line."""
    board.read(f"_{name}_segment", f"{plan}.f0", f"{plan}.{mark}")
    board.calc(f"_{name}_length", "component", f"_{name}_segment", HORIZONTAL)
    board.calc(f"_{name}_seen", "product", f"_{name}_length", "mu_t1")
    board.calc(name, "later", "_begin", f"_{name}_seen")


SCHEME = "scheme"
FORCE = {0: ("P_st",), 2: ("P_12_max", "P_st")}  # what bends a beam
LETTERS = ("w", "v")
ENDS = {0: ("O1", "O2"), 2: ("B1", "B2")}


def _scheme(board: Board, near: dict[int, str]) -> None:
    """Draw beams and rope; `near` says of either beam whether its left or its right end is the nearer one."""
    board.pole(f"{SCHEME}.A0")
    board.lay(f"{SCHEME}.A2", f"{SCHEME}.A0", UP, "L")
    for i, (left, right) in ENDS.items():
        board.calc(f"_far_{i}", "excess", f"l_{i}", f"b_{i}")
        sides = (f"b_{i}", f"_far_{i}") if near[i] == LEFT else (f"_far_{i}", f"b_{i}")
        board.back(f"{SCHEME}.{left}", f"{SCHEME}.A{i}", HORIZONTAL, sides[0])
        board.lay(f"{SCHEME}.{right}", f"{SCHEME}.A{i}", HORIZONTAL, sides[1])


def _beam(board: Board, i: int) -> None:
    """Draw a beam bent by its forces."""
    plan = BENT[i]
    board.calc(f"_x_M_{i}", "excess", f"l_{i}", f"x_w{i}")
    places = {str(k): f"_x_{k}_{i}" for k in range(SECTIONS + 1)}
    for k in range(SECTIONS + 1):
        board.calc(f"_x_{k}_{i}", "product", f"l_{i}", part(k, SECTIONS))
    feet = {f"f{n}": place for n, place in places.items()} | {"fA": f"b_{i}", "fM": f"_x_M_{i}"}
    for mark, place in feet.items():
        points(board, plan, mark, place)
    for letter, force in zip(LETTERS, FORCE[i], strict=False):
        for n, place in places.items():
            bent_point(board, i, f"{letter}{n}", (place, f"f{n}"), force)
    bent_point(board, i, "A", (f"b_{i}", "fA"), FORCE[i][0])
    board.calc(f"w_{i}", "given", f"_w_A_{i}")
    bent_point(board, i, "M", (f"_x_M_{i}", "fM"), FORCE[i][0])


def bent_point(board: Board, i: int, mark: str, place: tuple[str, str], force: str) -> None:
    """Mark a point of the bent beam at a place, under its foot."""
    at, foot = place
    plan, name = BENT[i], f"_w_{mark}_{i}"
    board.calc(f"{name}_unit", "deflection_of_unit", at, f"b_{i}", f"l_{i}", f"I_{i}", f"E_{i}")
    board.calc(name, "product", force, f"{name}_unit")
    board.calc(f"{name}_paper", "ratio", name, "mu_w")
    board.back(f"{plan}.{mark}", f"{plan}.{foot}", UP, f"{name}_paper")


PER_TURN = 16  # section lines in a swing, on the drawings of the equations; and at least so many in all
FEWEST = 10
MOST_TURNS, LAST_TURNS = 12.0, 2.0  # swings that are drawn; of more than so many the last ones


@dataclass(frozen=True, slots=True)
class Roots:
    """How the equations (11) and (12) are drawn: from `begin` on, a line every `section`, s.

    `lift_off` is the line before the lift-off, `extremes` are those before the roots of (12), whose times are `times`;
    these are none where (12) is not drawn, for the support is rigid: `waves` tells.
    """

    begin: float
    section: float
    lift_off: int
    extremes: tuple[int, ...]
    times: tuple[float, ...]
    waves: bool

    @property
    def sections(self) -> int:
        """How many sections there are: one and a half more than until the lift-off."""
        return self.lift_off + 2


@dataclass(frozen=True, slots=True)
class Layout:
    """What the construction of a hoist depends on beside numbers.

    `near` says which end of a beam is the nearer one, `moved` whether the forces are those of a motion, `resting` and
    `hanging` into how many sections the phases are divided; `bent` are the beams that bend, `slack` says whether the
    circle goes on where the rope would push; `roots` tells how the equations are drawn, where they are valid.
    """

    near: tuple[str, str]
    moved: bool
    resting: int
    hanging: int
    bent: tuple[int, ...]
    slack: bool
    roots: Roots | None


def layout_of(hoist: Hoist, forces: Forces) -> Layout:
    """Return what the construction of a hoist with these forces depends on."""
    found, moves = forces.found, forces.motion is not None
    return Layout(
        near=(hoist.near_0, hoist.near_2),
        moved=moves,
        resting=SECTIONS * max(1, min(math.ceil(_turns(found)), int(MOST_TURNS))),
        hanging=SECTIONS * (2 if moves else 1),
        bent=tuple(i for i in BENT if math.isfinite(found[f"I_{i}"])),
        slack=found["P_m"] < found["R"],
        roots=_roots_of(found) if forces.ok[ROPE_1] else None,
    )


def _turns(found: Mapping[str, float]) -> float:
    return 0.0 if math.isinf(found["k"]) else found["k"] * found["t_1"] / TURN


def _roots_of(found: Mapping[str, float]) -> Roots:
    """Return how the equations are drawn: the lift-off is in the middle of a section."""
    V, a, k, t_1 = (found[name] for name in ("V_t", "a", "k", "t_1"))
    turns, begin = _turns(found), 0.0
    if turns > MOST_TURNS:
        begin, turns = t_1 * (1.0 - LAST_TURNS / turns), LAST_TURNS
    before = max(FEWEST, math.ceil(PER_TURN * turns))
    section, waves = (t_1 - begin) / (before + 0.5), math.isfinite(k)
    ratio = found["C_01"] / found["C_12"]
    times = np.sort(np.concatenate(extremes(V, a, k, ratio, t_1, begin))) if waves else np.zeros(0)
    lines = np.floor((times - begin) / section).astype(int)
    return Roots(begin, section, before, tuple(lines.tolist()), tuple(times.tolist()), waves)


def construct(layout: Layout, plans: Iterable[str] = PLANS) -> Program:
    """Record the construction: all numbers, and the drawings of the plans wanted."""
    timeless = layout.roots and replace(layout.roots, begin=0.0, section=0.0, times=())
    return _constructed(replace(layout, roots=timeless), frozenset(plans))


@lru_cache(maxsize=16)
def _constructed(layout: Layout, wanted: frozenset[str]) -> Program:
    """Record it once: hoists that differ in numbers alone have the same steps."""
    board = RecordingBoard()
    for part in ONE_SIDED if layout.moved else TWO_SIDED:
        part(board)
    board.turn(HORIZONTAL, "zero")  # the axes of all diagrams
    board.normal(UP, HORIZONTAL)
    if SCHEME_PART in wanted:
        _scheme(board, dict(zip(BENT, layout.near, strict=True)))
    if CIRCLE_PART in wanted:
        _diameter(board, layout.slack)
    if FORCES_PART in wanted:
        _resting(board, layout.resting, layout.moved)
        _hanging(board, layout.hanging, layout.moved)
        _extreme_points(board)
    if ROOTS_PART in wanted and layout.roots is not None:
        _lift_off_plan(board, layout.roots.sections, layout.roots.lift_off)
        if layout.roots.waves:
            _extremes_plan(board, layout.roots.sections, layout.roots.extremes)
    if BEAMS_PART in wanted:
        for i in layout.bent:
            _beam(board, i)
    return Program(board.steps)
