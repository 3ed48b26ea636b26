"""A gear pair solved: givens completed, quantities in sections, teeth, checks, errors against the scale of a drawing.

Of x_1, x_2 two fix the pair, or one of them with a_w or x_sum. Of a_w or x_sum alone the shifts follow by which both
wheels slide alike: the specific sliding at the root of the pinion, theta_12 at A1, equals that at the root of the
wheel, theta_21 at A2.

K is that of `plans.condition`, over Q; lengths that are drawn count beside the module at least. Numbers of teeth do not
err. Source of the checks: GOST 16532-70, appendix on quality by geometry.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...scales.errors import InputError
from ...scales.scale import steps
from ..boards.exact import run
from ..condition import Condition, derivatives, ratio
from ..hands.shaky import Alike, Hand, Hands, Paper, Tolerance, draw, drawing_of
from ..hands.spread import added_up, kept
from ..laws import LAWS
from ..marking.key import rounded
from ..names import role
from ..quantities import Quantity, quantities, worst_behind
from ..solved import AT_LEAST, AT_MOST, EQUAL, PAPER_MM, Check, Solved, calculated, found_on, in_sections
from . import construction
from .gear import PLANS, SHIFTS, STANDARD, VALUES, WHEELS, GearPair, impossible, unit_of
from .geometry import DIVISIONS, NOTHING, PARTS, POINTS, SIZES, geometry
from .teeth import Meshing, meshing_of, tooth_of

HALVINGS = 200
BALANCE = ("theta_12_A1", "theta_21_A2")
BASIC = ("a", "x_sum", "a_w", "alpha_w", "inv_alpha", "inv_alpha_w")


def complete(values: Mapping[str, float]) -> dict[str, float]:
    """Return the givens with the standard rack where nothing else is given, and with both shifts.

    The `values` are `m z_1 z_2` and, of `x_1 x_2 x_sum a_w`, what fixes the shifts; what `STANDARD` has may be missing.
    Raises InputError of numbers of which no pair can be made: wheels, rack, shifts, teeth, meshing.
    """
    found = {**STANDARD, **values}
    for _, error in impossible(found):
        raise error
    x_1, x_2 = _shifts(found)
    given = ", ".join(name for name in SHIFTS if name in found)
    found = {name: float(value) for name, value in found.items() if name not in SHIFTS} | {"x_1": x_1, "x_2": x_2}
    _meshes(found, given if given != "x_1, x_2" else "")
    return found


def _shifts(values: Mapping[str, float]) -> tuple[float, float]:
    """Return x_1 and x_2 of a pair of which those are given, or one and a_w or x_sum, or one of the latter alone."""
    match given := tuple(name for name in SHIFTS if name in values):
        case ("x_1", "x_2"):
            return float(values["x_1"]), float(values["x_2"])
        case ("x_1", "x_sum" | "a_w"):
            return float(values["x_1"]), _sum_of_shifts(values) - values["x_1"]
        case ("x_2", "x_sum" | "a_w"):
            return _sum_of_shifts(values) - values["x_2"], float(values["x_2"])
        case ("x_sum" | "a_w",):
            return _balanced(values, _sum_of_shifts(values))
    raise InputError("gear-shifts", given=", ".join(given) or "-")


def _sum_of_shifts(values: Mapping[str, float]) -> float:
    """Return x_1 + x_2 of a pair with given x_sum, or a_w, for which the base circles must leave room."""
    if "x_sum" in values:
        return float(values["x_sum"])
    z_1, z_2, alpha, a_w = (values[name] for name in ("z_1", "z_2", "alpha", "a_w"))
    a = LAWS["reference_centre"](values["m"], z_1, z_2)
    least = LAWS["base_diameter"](a, alpha)
    if not a_w > least:
        raise InputError("gear-centre", a_w=f"{a_w * 1e3:.7g}", least=f"{least * 1e3:.7g}")
    inv, inv_w = (LAWS["involute"](angle) for angle in (alpha, LAWS["working_angle"](a, alpha, a_w)))
    return float(LAWS["sum_of_shifts"](z_1, z_2, alpha, inv, inv_w))


def _balanced(values: Mapping[str, float], x_sum: float) -> tuple[float, float]:
    """Return x_1 and x_2 with the given sum by which both wheels slide alike.

    The larger x_1 is, the nearer A1 is to the pole and the farther A2: theta_12 at A1 only rises, theta_21 at A2 only
    falls, between the shifts that put A1 into N1 and A2 into N2; there may be none between.
    """
    wanted = ("l_N1N2", "d_b1", "d_b2", "d_a1", "d_a2", "alpha_w")
    sizes = geometry({**values, "x_1": 0.0, "x_2": x_sum}, wanted)
    _apart(values, x_sum, sizes["alpha_w"])
    ends = [math.hypot(2.0 * sizes["l_N1N2"], sizes[f"d_b{i}"]) - sizes[f"d_a{i}"] for i in WHEELS]
    low, high = least, most = -0.5 * ends[1] / values["m"], 0.5 * ends[0] / values["m"]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        found = geometry({**values, "x_1": middle, "x_2": x_sum - middle}, BALANCE)
        low, high = (middle, high) if found[BALANCE[0]] < found[BALANCE[1]] else (low, middle)
    if not least < low < high < most:
        raise InputError("gear-no-balance", x_sum=f"{x_sum:.6g}")
    return low, x_sum - low


def _meshes(values: Mapping[str, float], given: str) -> None:
    """Look whether the wheels have teeth, and whether these can touch; `given` is what the shifts are found by."""
    found = geometry(values, BASIC)
    _apart(values, found["x_sum"], found["inv_alpha_w"])
    for i in WHEELS:
        if not tooth_of(values, i).whole:
            said = {"name": f"x_{i}", "text": f"{values[f'x_{i}']:.6g}", "wheel": i}
            found_by = {"given": given} if given else {}
            raise InputError("gear-no-tooth-found" if given else "gear-no-tooth", **found_by, **said)
    line = geometry(values, ("g_alpha",))["g_alpha"]
    if not line > 0.0:
        raise InputError("gear-no-contact", gap=f"{-line * 1e3:.4g}")


def _apart(values: Mapping[str, Any], x_sum: float, angle: float) -> None:
    """Refuse a sum of shifts by which the centres come nearer than the base circles allow: there is no `angle`."""
    if angle > 0.0:
        return
    z_1, z_2, alpha = (values[name] for name in ("z_1", "z_2", "alpha"))
    least = float(LAWS["sum_of_shifts"](z_1, z_2, alpha, LAWS["involute"](alpha), np.float64(0.0)))
    raise InputError("gear-no-mesh", x_sum=f"{x_sum:.6g}", least=f"{least:.4g}")


# of the calculated quantities, each the steps of one part of the geometry
CALCULATED = ("sizes", "centres", "auxiliary", "quality", "engagement", "measures")
DRAWN = "drawn"
SECTIONS = (*CALCULATED, DRAWN, construction.SLIDING)


@cache
def _calculated() -> Mapping[str, str]:
    """Return the section of every calculated quantity."""
    parts = {section: (part,) for section, part in zip(CALCULATED, SIZES, strict=True)}
    return dict.fromkeys(("x_1", "x_2"), CALCULATED[0]) | calculated(parts)  # shifts that are found


def section_of(name: str) -> str:
    """Return the section of a quantity, of `SECTIONS`: what is not calculated is drawn, and of sliding what has points.

    >>> section_of("d_a1"), section_of("g_alpha_drawn"), section_of("theta_12_03")
    ('sizes', 'drawn', 'sliding')
    """
    if name in _calculated():
        return _calculated()[name]
    return construction.SLIDING if role(name).kind in ("y", "theta") or name in ("PW", "mu_rho", "mu_theta") else DRAWN


SAME_CENTRES = ("a_w_rolling", "a_w_shift", "a_w_tip1", "a_w_tip2")  # the distance of the centres in other ways
EPSILON = 1.2  # the least contact ratio advised for spur gears
ROUNDING = 1e-12  # part of a length by which two ways to it may differ, and a limit may be missed
SAME = 1e-9  # part of the active line: flanks that touch along all of it


def judged(name: str, quantity: str, sizes: Mapping[str, float], limit: float | str, relation: str) -> Check:
    """Return the check of a quantity against its limit, SI, another one by name or a number, rounding apart.

    Names are `undercut_1`, `interference_1`, `contact_ratio`, `contact_flanks`, `tip_1`, `centre_a_w_shift`, ...
    """
    of = limit if isinstance(limit, str) else ""
    value, bound = sizes[quantity], sizes[limit] if isinstance(limit, str) else limit
    room = ROUNDING * max(abs(value), abs(bound))
    return Check.of_value(name, value, relation, bound, unit_of(quantity), room, quantity=quantity, of=of)


def rule_of(check: Check) -> tuple[str, str]:
    """Return the rule that a check is of, and the wheel, if it is that of one."""
    name = role(check.name)
    return (name.kind, name.of) if name.of.isdigit() else (check.name, "")


def checks(pair: GearPair, sizes: Mapping[str, float]) -> list[Check]:
    """Return the checks of a pair with its quantities by name, in the order of the note.

    Interference is looked for where the rack has cut: the curvature at the lower point of contact must not be less than
    at the boundary point. Of an undercut tooth that is negative, and the check of undercutting tells it.
    """
    least_tip = pair.least_tip * sizes["m"]
    return [
        *(judged(f"centre_{name}", name, sizes, "a_w", EQUAL) for name in SAME_CENTRES),
        *_roots(sizes),
        judged("contact_ratio", "epsilon_alpha", sizes, EPSILON, AT_LEAST),
        *(judged(f"tip_{i}", f"s_a{i}", sizes, least_tip, AT_LEAST) for i in WHEELS),
    ]


def _roots(sizes: Mapping[str, float]) -> list[Check]:
    return [
        *(judged(f"undercut_{i}", f"x_{i}", sizes, f"x_min{i}", AT_LEAST) for i in WHEELS),
        *(judged(f"interference_{i}", f"rho_l{i}", sizes, f"rho_p{i}", AT_MOST) for i in WHEELS),
    ]


SCALES = {construction.MESHING: "mu_l", construction.SLIDING: "mu_rho", construction.THETA: "mu_theta"}
# the plan that shows a quantity as a segment, beside those that are read from one
SHOWN_ON = dict.fromkeys(
    (
        *("a_w", "g_alpha", "g_f", "g_a", "l_N1N2", "p_b", "g_alpha_drawn", "l_N1N2_drawn", "c_1", "c_2"),
        *(f"{name}{i}" for i in WHEELS for name in ("d_", "d_w", "d_b", "d_a", "d_f", "d_p")),
        *(f"{name}{i}" for i in WHEELS for name in ("r_p", "rho_p", "rho_l", "rho_w", "rho_a")),
    ),
    construction.MESHING,
)
LONGEST = 250.0  # mm, that N1N2 may be under the diagrams
# the three points of the table that stand in A1, P, A2, in the order in which these follow from N1 to N2
MARKS = tuple(POINTS[sum(n for _, n in DIVISIONS[: k + 1])] for k in range(3))


@dataclass(frozen=True, kw_only=True)
class SolvedGear(Solved):
    """A pair solved; `sizes` are its complete givens and all that is calculated of them, by name, SI."""

    pair: GearPair
    sizes: Mapping[str, float]
    layout: construction.Layout

    @cached_property
    def meshing(self) -> Meshing:
        """The teeth of both wheels with their exact outlines, and how they mesh; made when first asked for."""
        return meshing_of(self.sizes, self.pair.sense)

    @property
    def checks(self) -> tuple[Check, ...]:
        """What the pair is judged by; the teeth are made where they may have lost a part of their flanks."""
        found, sizes = checks(self.pair, self.sizes), self.sizes
        if not all(check.ok for check in _roots(sizes)) or any(sizes[f"s_a{i}"] < 0.0 for i in WHEELS):
            first, last = self.meshing.touching
            length = max(last - first, 0.0)
            if length < sizes["g_alpha"] * (1.0 - SAME):  # the formula of the contact ratio counts what is cut away
                place = 1 + [check.name for check in found].index("contact_ratio")
                left = {"epsilon_flanks": length / sizes["p_b"]}
                found.insert(place, judged("contact_flanks", "epsilon_flanks", left, EPSILON, AT_LEAST))
        return tuple(found)

    @property
    def edges(self) -> tuple[str, ...]:
        """The directions along which a drafting machine draws: tangent in the pole, line of centres, axes."""
        return construction.TANGENT, construction.CENTRES, construction.RIGHT, construction.UP

    @property
    def on_paper(self) -> tuple[str, ...]:
        """The diagrams of sliding, which are drawn in millimetres of paper."""
        return tuple(plan for plan in construction.DIAGRAMS if plan in self.scale_of_plan)


def solve_gear(pair: GearPair, values: Mapping[str, float], plans: Iterable[str] = PLANS) -> SolvedGear:
    """Solve a gear pair, whose senses and materials are chosen.

    The `values` are its numbers in SI by name, as `complete` takes them; the `plans` wanted, of `gear.PLANS`, come with
    those that they need. Raises InputError of numbers of which no pair can be made.
    """
    found = complete(values)
    sizes = geometry(found)
    layout = _layout_of(pair, sizes)
    program = construction.construct(layout, plans)
    sense, mu_rho = float(pair.sense), steps(sizes["l_N1N2"] / LONGEST)[0] / PAPER_MM
    givens = {
        **found,
        **PARTS,
        **NOTHING,
        **construction.NUMBERS,
        "_sense": sense,
        "_against": -sense,
        "mu_rho": mu_rho,
    }
    board = run(program, givens)
    slides = construction.SLIDING in program.plans
    results = quantities(program, board.values, {"PW": givens["PW"]} if slides else {}, unit_of)
    if slides:
        results = _with_ends(results)
        board.values |= dict.fromkeys(construction.ENDLESS, -math.inf)
    return SolvedGear(
        **found_on(board, program, SCALES, SHOWN_ON),
        quantities=in_sections(_stated(givens, {*program.plans}, values) | results, SECTIONS, section_of),
        givens=givens,
        pair=pair,
        sizes=sizes,
        layout=layout,
    )


def _layout_of(pair: GearPair, sizes: Mapping[str, float]) -> construction.Layout:
    """Return what the construction of a pair with these sizes depends on.

    Of three points of the table of sliding the second stands in P, unless A1 or A2 is beyond it.
    """
    before = sum(min(max(sizes[name], 0.0), sizes["l_N1N2"]) < sizes["rho_w1"] for name in ("rho_p1", "rho_a1"))
    first, second = (construction.rolling(sizes[f"rho_w{i}"], sizes[f"rho_a{i}"]) for i in WHEELS)
    return construction.Layout((first, second), pair.sense, MARKS[before])


def _stated(givens: Mapping[str, Any], drawn: set[str], values: Mapping[str, float]) -> dict[str, Quantity]:
    """Return what the board begins with and is a result: scale factors of diagrams, shifts that have been found."""
    units = {construction.SLIDING: "m/mm", construction.THETA: "1/mm"}
    scales = ((SCALES[plan], unit) for plan, unit in units.items() if plan in drawn)
    found = {name: Quantity(name, givens[name] * PAPER_MM, unit) for name, unit in scales}
    return found | {name: Quantity(name, givens[name], "1") for name in ("x_1", "x_2") if name not in values}


def _with_ends(results: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """Return the quantities with those of the table that are undefined, each beside the other one of its point."""
    found: dict[str, Quantity] = {}
    for name, quantity in results.items():
        ends = [Quantity(end, None, unit_of(end)) for end, other in construction.ENDLESS.items() if name == other]
        found |= {item.name: item for item in sorted((quantity, *ends), key=lambda item: item.name)}
    return found


WHOLE = ("z_1", "z_2")


def conditions_of(solved: SolvedGear) -> dict[str, Condition]:
    """Return the condition of every quantity; what is given has that of a number alone."""
    varied = [name for name in VALUES if solved.givens.get(name) and name not in WHOLE]
    slopes = derivatives(solved.program, solved.givens, varied)
    slopes |= {name: solved.givens[name] * np.eye(len(varied))[i] for i, name in enumerate(varied)}
    worst = worst_behind(solved.program, solved.sines)
    found = {}
    for name, quantity in solved.quantities.items():
        slope = slopes.get(name, 0.0 if name in solved.givens else np.nan)
        total, size = float(np.abs(slope).sum()), float(abs(solved.values[name]))
        if name in solved.shown_on and quantity.unit == "m":  # drawn: an error counts beside the module at least
            size = max(size, float(solved.givens["m"]))
        found[name] = Condition(ratio(total, size), worst.get(name, 1.0))
    return found


ANGULAR = tuple(f"{name}{i}{end}" for name, end in (("phi_alpha", "_drawn"), ("epsilon_alpha_arc", "")) for i in WHEELS)
# curvatures of both flanks at the ends of the active line
ENDS = {"A1": ("rho_p1", "rho_a2"), "A2": ("rho_a1", "rho_p2")}


def tolerances_of(solved: SolvedGear, paper: Paper, tolerance: Tolerance) -> dict[str, float]:
    """Return by how much quantities that hang on angles or diagrams of the drawing may differ, SI.

    A flank at the start of engagement stands as its mark on the line of action does, and as it is turned: such an angle
    may miss what all these errors add up to. Sliding at the ends of the active line can be calculated, but is taken
    from the diagram: it may miss what comes of both ordinates.
    """
    names, sizes = [name for name in ANGULAR if name in solved.quantities], solved.sizes
    found = added_up(paper, tolerance, names)
    found = {name: max(found[name], rounded(solved.values[name], tolerance)) for name in names}
    for end, rhos in ENDS.items():  # theta = 1 - y / y_own errs by what either segment may miss
        y = [sizes["PW"] / PAPER_MM * sizes[rho] / sizes[f"rho_w{i}"] for i, rho in zip(WHEELS, rhos, strict=True)]
        for i in WHEELS:
            name, own, mate = f"theta_{i}{3 - i}_{end}", y[i - 1], y[2 - i]
            if own > 0.0:
                missed = (tolerance.of_segment(mate) + mate / own * tolerance.of_segment(own)) / own
                found[name] = max(float(missed), rounded(sizes[name], tolerance))
    return found


# A hand errs by millimetres of paper, and by degrees; the larger the drawing, the less the former count, while the
# latter do not change: teeth are drawn five times as large as they are, hardly ever larger.
RATIOS = (1.0, 2.0, 2.5, 4.0, 5.0, 10.0, 20.0)  # millimetres of paper for one of the wheels, GOST 2.302
USUAL = ("epsilon_alpha_drawn", "epsilon_alpha_arc1", "c_1")
DRAWINGS, SEED = 400, 1
MILLI = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class ScaleErrors:
    """What 95 % of drawings keep, in parts of the exact value, by hand and quantity: one for each of the `ratios`."""

    exact: Mapping[str, float]  # the exact values, SI
    ratios: tuple[float, ...]  # scales of the meshing, M k : 1
    tooth: float  # depth of a tooth, m
    errors: Mapping[tuple[str, str], NDArray[np.float64]]  # by hand and quantity, in the order of `ratios`

    @property
    def quantities(self) -> tuple[str, ...]:
        """What is compared."""
        return tuple(self.exact)

    def enough(self, hand: str, quantity: str, part: float) -> float | None:
        """Return the smallest scale at which a hand misses by no more than a part; None where no scale does."""
        errors = zip(self.ratios, self.errors[hand, quantity], strict=True)
        return next((k for k, error in errors if error <= part), None)


def compared(solved: SolvedGear) -> tuple[str, ...]:
    """Return what can be compared: all that is measured on the meshing, or calculated from that."""
    return tuple(name for name in solved.program.names if name in solved.quantities and section_of(name) == DRAWN)


def scale_errors(solved: SolvedGear, hands: Mapping[str, Hand], quantities: Sequence[str] = ()) -> ScaleErrors:
    """Draw the meshing at one scale after the other, by hands of some names; `quantities` of `compared`, or the usual.

    Raises InputError with the key `chart-no-meshing` where the meshing is not among the plans.
    """
    if construction.MESHING not in solved.scale_of_plan:
        raise InputError("chart-no-meshing")
    wanted = tuple(quantities) or USUAL
    at_once = Hands.of(hands.values())
    errors = {(hand, name): np.empty(len(RATIOS)) for hand in hands for name in wanted}
    for i, k in enumerate(RATIOS):
        paper = drawing_of(solved, dict.fromkeys(solved.scale_of_plan, MILLI / k))
        paper = replace(paper, program=paper.program.needed_for(wanted))
        board = draw(paper, at_once, Alike(np.random.default_rng(SEED)), (len(hands), DRAWINGS))
        for name in wanted:
            exact = solved.values[name]
            missed = kept(np.broadcast_to(board.values[name], board.codes.shape), exact)
            for hand, off in zip(hands, missed, strict=True):
                errors[hand, name][i] = float(off) / abs(exact)
    exact_values = {name: float(solved.values[name]) for name in wanted}
    return ScaleErrors(exact_values, RATIOS, solved.sizes["h"], errors)
