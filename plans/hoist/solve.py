"""A hoist solved: what its board begins with, values and quantities, tolerances, and its curves densely.

K is that of `plans.condition`, over Q. Roots are found beside the board, so that the derivatives are central
differences of all of it.

Curves are constructions that are done for many places at once, in metres of paper.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...scales.scale import steps
from ..board import Board
from ..boards.exact import run
from ..condition import Condition, conditions_again
from ..hands.shaky import Paper, Tolerance
from ..laws import LAWS, TURN
from ..marking.key import rounded
from ..names import role
from ..quantities import Quantity, quantities
from ..solved import PAPER_MM, Solved, found_on, in_sections
from .construction import (
    BENT,
    EXTREMES,
    FORCES,
    HANGING,
    LIFT_OFF,
    RESTING,
    SCHEME,
    UP,
    Layout,
    bent_point,
    construct,
    drawn_name,
    extremes_point,
    layout_of,
    lift_off_points,
    part,
    points,
    seen,
)
from .construction import SECTIONS as BEAM_SECTIONS
from .forces import Forces, course, forces, motion_givens
from .hoist import PLANS, VALUES, Hoist, Numbers, complete
from .model import CIRCLE, HORIZONTAL, SECTIONS, motion_given, rest_of_root, section_of

TIMES, ORDINATES, SPAN, BEND = 180.0, 120.0, 160.0, 40.0  # mm of paper that axes should take
WIDEST = 2.0  # ratio of neighbours in the series of scale factors
TALLEST = 1.05  # of the greatest force, the axis of forces
SWINGS = 1.1  # of T_1, the axis of times beyond the lift-off
# units of the scale factors of diagrams
SCALED = {"mu_t": "s", "mu_F": "N", "mu_t1": "s", "mu_y": "m", "mu_v": "m/s", "mu_x": "m", "mu_w": "m"}


def board_givens(forces: Forces, layout: Layout, part_of: float = 1.0) -> dict[str, Any]:
    """Return the complete givens of the construction, beside the numbers of the hoist.

    Diagrams have about `part_of` their usual size.
    """
    found, motion = forces.found, forces.motion
    given: dict[str, Any] = {"_turn": TURN, "_t_P12_min": forces.marks["P_12_min"]}
    parts = {(i, n) for n in (layout.resting, layout.hanging, BEAM_SECTIONS) for i in range(n + 1)}
    if layout.roots is not None:
        parts |= {(i, 1) for i in range(layout.roots.sections + 1)}
        given |= {"_begin": layout.roots.begin, "_section": layout.roots.section}
        given |= {f"_t_2_{n}_exact": time for n, time in enumerate(layout.roots.times, 1)}
    given |= {part(i, n): i / n for i, n in parts}
    end = forces.end if motion else found["t_1"] + max(TURN / found["k_1"], SWINGS * found["T_1"])
    given |= {name: mu / PAPER_MM for name, mu in _scale_factors(found, layout, end, part_of).items()}
    if motion is None:
        return given | {"_rest": rest_of_root(found)}
    return given | motion_givens(motion) | _ordinates(forces, layout)


def _ordinates(forces: Forces, layout: Layout) -> dict[str, float]:
    """Return times and forces of a motion on the section lines."""
    t_1 = forces.found["t_1"]
    before, after = np.linspace(0.0, t_1, layout.resting + 1), np.linspace(t_1, forces.end, layout.hanging + 1)
    columns = course(forces, np.concatenate((before, after))).columns
    F_01, F_12 = columns["F_01"].tolist(), columns["F_12"].tolist()
    given: dict[str, float] = {}
    for i, t in enumerate(before.tolist()):
        given |= {f"_t_{RESTING}{i}": t, f"_F_01_{i}": F_01[i], f"_F_12_{i}": F_12[i]}
    for i, t in enumerate(after.tolist()):
        given |= {f"_T_{HANGING}{i}": t - t_1, f"_P_12_{i}": F_12[layout.resting + 1 + i]}
    return {motion_given(name): value for name, value in given.items()}


def _scale_factors(found: Numbers, layout: Layout, end: float, part_of: float) -> dict[str, float]:
    """Return the scale factors of the diagrams, SI per millimetre, by which they fill their axes."""
    wanted = {"mu_t": end / TIMES, "mu_F": (TALLEST * found["F_max"] + found["P_st"]) / ORDINATES}
    if layout.roots is not None:
        V, a, seen = found["V_t"], found["a"], layout.roots.sections * layout.roots.section
        end = layout.roots.begin + seen
        wanted |= {"mu_t1": seen / TIMES, "mu_y": (V * end + 0.5 * a * end * end) / ORDINATES}
        if layout.roots.waves:
            swing = math.hypot(V, a / found["k"])
            wanted["mu_v"] = (swing + max(swing, found["C_01"] / found["C_12"] * (V + a * end))) / ORDINATES
    if layout.bent:
        wanted["mu_x"] = max(found[f"l_{i}"] for i in BENT) / SPAN
        wanted["mu_w"] = max(found[f"w_{i}_max"] for i in layout.bent) / BEND

    def nearest(mu: float) -> float:  # of the customary series, by their ratio
        return min(steps(mu / WIDEST), key=lambda step: abs(math.log(step / mu)))

    return {name: nearest(mu / part_of) for name, mu in wanted.items()}


# the scale factor in which each plan shows values; on the diagrams that of the axis of ordinates
SCALES = {SCHEME: "mu_l", FORCES: "mu_F", LIFT_OFF: "mu_y", EXTREMES: "mu_v", CIRCLE: "mu_F_circle"}
SCALES |= dict.fromkeys(BENT.values(), "mu_w")
ON_PAPER = (FORCES, LIFT_OFF, EXTREMES, *BENT.values())  # plans that are drawn in millimetres of paper
# the plan that shows a quantity as a segment, the first of them that is drawn
SHOWN_ON = {
    **dict.fromkeys(("L", "l_0", "l_2", "b_0", "b_2"), (SCHEME,)),
    **dict.fromkeys(("P_st", "F_12_t1", "F_12_max", "P_12_max", "P_12_min"), (FORCES, CIRCLE)),
    **dict.fromkeys(("R", "D_0", "D_1", "P_m"), (CIRCLE,)),
    **{f"{name}_{i}{end}": (plan,) for i, plan in BENT.items() for name, end in (("w", ""), ("w", "_max"))},
}
UNITS = {"m": "kg", "k": "rad/s", "sigma": "Pa", "V": "m/s", "phi": "rad", **dict.fromkeys("tT", "s")}
UNITS |= {**dict.fromkeys("FPRD", "N"), **dict.fromkeys(("alpha", "safety", "dynamic"), "1")}
STIFFNESSES = ("C", "C_01", "C_k", "C_2", "C_12")


def unit_of(name: str) -> str:
    """Return the SI unit of a quantity of a hoist by its name."""
    return "N/m" if name in STIFFNESSES else UNITS.get(role(name).kind or name, "m")


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedHoist(Solved):
    """A hoist solved; `forces` are its numbers and checks, and its motion where the formulas are not valid."""

    hoist: Hoist
    forces: Forces
    layout: Layout
    plans: tuple[str, ...]

    @property
    def edges(self) -> tuple[str, ...]:
        """The directions of axes, beams and rope."""
        return HORIZONTAL, UP

    def worth(self, mus: Numbers) -> dict[str, float]:
        """Return what a millimetre of every plan is worth to the board: the diagrams are drawn in paper itself."""
        return {plan: PAPER_MM if plan in ON_PAPER else mu for plan, mu in mus.items()}


def solve_hoist(hoist: Hoist, values: Numbers, plans: Iterable[str] = PLANS, part_of: float = 1.0) -> SolvedHoist:
    """Solve a hoist, with its sides chosen.

    The `values` are its numbers in SI, as `hoist.complete` takes them, the `plans` wanted those of `hoist.PLANS`: the
    numbers, with the circle, need none. Diagrams on paper have about `part_of` their usual size.

    Raises InputError of numbers that no hoist can have, or of a motion of too many pieces.
    """
    found = forces(values)
    layout = layout_of(hoist, found)
    plans = tuple(plans)
    program = construct(layout, plans)
    given = complete(values) | board_givens(found, layout, part_of)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        board = run(program, {name: np.float64(value) for name, value in given.items()})  # where 1/0 is inf
    drawn = {*program.plans}
    shown = {name: next((plan for plan in own if plan in drawn), "") for name, own in SHOWN_ON.items()}
    results = _scales(given, drawn)  # marks of plans are no results
    results |= {name: q for name, q in quantities(program, board.values, {}, unit_of).items() if q.kind == "scalar"}
    return SolvedHoist(
        **found_on(board, program, SCALES, shown),
        quantities=in_sections(results, SECTIONS, section_of),
        givens=given,
        hoist=hoist,
        forces=found,
        layout=layout,
        plans=plans,
    )


def reduced(solved: SolvedHoist, part_of: float) -> SolvedHoist:
    """Return a hoist with diagrams of about a part of their usual size."""
    return solve_hoist(solved.hoist, {name: solved.givens[name] for name in VALUES}, solved.plans, part_of)


def _scales(given: Numbers, drawn: set[str]) -> dict[str, Quantity]:
    """Return the scale factors of the diagrams that are drawn: they are found, and so are results."""
    of_plan = {"mu_t": FORCES, "mu_t1": LIFT_OFF, "mu_x": "", **{SCALES[plan]: plan for plan in ON_PAPER}}
    found = {}
    for name, unit in SCALED.items():
        bends = name in ("mu_x", "mu_w") and not drawn.isdisjoint(BENT.values())
        if name in given and (of_plan[name] in drawn or bends):
            per_mm = f"({unit})/mm" if "/" in unit else f"{unit}/mm"
            found[name] = Quantity(name, float(given[name]) * PAPER_MM, per_mm)
    return found


def conditions_of(solved: SolvedHoist) -> dict[str, Condition]:
    """Return the condition of every quantity."""
    numbers = {name: float(solved.givens[name]) for name in VALUES}
    return conditions_again(solved, lambda others: solve_hoist(solved.hoist, others, solved.plans), numbers)


def tolerances_of(solved: SolvedHoist, paper: Paper, tolerance: Tolerance) -> dict[str, float]:
    """Return by how much times may miss, SI: what chords err by, and the error of a segment of the drawing."""
    limits = {}
    for name, quantity in solved.quantities.items():
        drawn = solved.quantities.get(drawn_name(name))
        if drawn is None or quantity.value is None or drawn.value is None or not math.isfinite(drawn.value):
            continue
        mu = float(solved.values["mu_t1"]) * PAPER_MM
        of_segment = tolerance.of_segment(abs(drawn.value) / mu) * mu
        least = rounded(quantity.value, tolerance)
        limits[name] = max(abs(drawn.value - quantity.value) + of_segment, least)
        limits[drawn_name(name)] = max(of_segment, least)
    return limits


POINTS, OF_BEAM, MAGNIFIED = 300, 121, 81  # of a curve
INSIDE = 1.0 - 1e-12  # of an interval at whose end the phase is another one
Places = NDArray[np.complex128]


def bent(solved: SolvedHoist, i: int, letter: str, force: str) -> Places:
    """Return a beam bent by a force, the load's place among the points."""
    found = solved.forces.found
    x = np.unique(np.append(np.linspace(0.0, found[f"l_{i}"], OF_BEAM), found[f"b_{i}"]))

    def draw(board: Board) -> None:
        points(board, BENT[i], "f", "_x")
        bent_point(board, i, letter, ("_x", "f"), force)

    return solved.dense(draw, f"{BENT[i]}.{letter}", _x=x)


def equation(solved: SolvedHoist, curve: str, about: float | None = None, half: float = 0.0) -> Places:
    """Return a curve of an equation: `Y` and `O` of (11), `W` of (12); all of it, or `half` about an abscissa, mm."""
    roots = solved.layout.roots
    assert roots is not None
    times = np.linspace(0.0, roots.sections * roots.section, POINTS)
    if about is not None:
        times = np.linspace(about - half, about + half, MAGNIFIED) * (solved.values["mu_t1"] * PAPER_MM)

    def draw(board: Board) -> None:
        lift_off_points(board, "x")
        extremes_point(board, "x")

    plan = EXTREMES if curve == "W" else LIFT_OFF
    return solved.dense(draw, f"{plan}.{curve}x", **{seen("x"): times})


def forces_over(solved: SolvedHoist) -> dict[str, Places]:
    """Return the forces until the lift-off and the rope's after it, with the article's over one swing."""
    forces, found = solved.forces, solved.forces.found
    t_1, end = found["t_1"], forces.end
    before, after = np.linspace(0.0, t_1 * INSIDE, POINTS), np.linspace(t_1, end * INSIDE, POINTS)
    first, second = (course(forces, t).columns for t in (before, after))
    swing = after[after <= t_1 + TURN / found["k_1"]]
    curves = {"F_01": (before, first["F_01"]), "F_12": (before, first["F_12"]), "P_12": (after, second["F_12"])}
    V = LAWS["article_speed"](*(found[name] for name in ("V_0", "a", "slack", "P_st", "C_12")))
    article = LAWS["article_force"](found["m"], found["g"], found["a"], V, found["C_12"], found["k_1"], swing - t_1)
    curves["printed"] = swing, np.asarray(article)

    def draw(board: Board) -> None:
        points(board, FORCES, "fx", "_t", x="_F")

    return {name: solved.dense(draw, f"{FORCES}.x", _t=t, _F=F) for name, (t, F) in curves.items()}
