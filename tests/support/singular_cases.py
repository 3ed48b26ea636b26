"""Positions in which something vanishes, coincides, is parallel or out of reach; what is to be said; their limits."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from mpmath import mp, mpf

from kulman.plans.board import Program
from kulman.plans.boards.precision import _FiftyDigits
from kulman.plans.linkages.mechanism import ZERO, Load, Mechanism, Pair, Prismatic
from kulman.plans.linkages.solved import SolvedLinkage
from kulman.tests.support.linkages import BENT, DEAD, PARALLELOGRAM, PRESS_VALUES
from kulman.tests.support.mechanisms import (
    CRANK,
    ORIGIN,
    bodies,
    general_slider_crank,
    nau_slider_crank,
    nau_values,
    pins,
    twin,
    twin_values,
)
from kulman.variants.reader import load_task

PI = math.pi
EVERYTHING = "everything"
NOWHERE = math.nan  # a quantity that has no limit here, or not the same from both sides
Number = Callable[[], Any]
RIGHT: Mapping[str, Number] = {"phi": lambda: mp.pi / 2}
STRAIGHT: Mapping[str, Number] = {"phi": lambda: mp.pi}
SIXTH: Mapping[str, Number] = {"phi": lambda: mp.pi / 6}

VALUES = {
    **{"phi": 0.7, "l_OA": 0.1, "n_1": 10.0, "sense_1": 1.0, "l_OC": 0.3, "e": 0.0, "l_AB": 0.25, "l_CB": 0.2},
    **{"branch": 1.0, "m": 2.0, "J": 0.03, "l_S": 0.15, "F": 50.0, "alpha": 0.3, "up": PI / 2, "gamma": 0.0},
}


def loaded(second: str, third: str, *pairs: Pair) -> Mechanism:
    """Return a crank and two more links, a force on the last."""
    return Mechanism(bodies("O A:l_OA", second, third), pairs, CRANK, (Load("F", 3, "S", "F", "alpha"),))


GUIDE, SLOT = Prismatic("S", (3, 0), ORIGIN, ZERO), Prismatic("A", (2, 3), ORIGIN, "up")
LEVER_SLOT = Prismatic("A", (2, 3), ORIGIN, ZERO, "e", "branch")
FOUR_BAR = loaded("A B:l_AB", "C B:l_CB S:l_S / S m J", *pins("O01 A12 B23:branch C30@l_OC"))
WEIGHTLESS = replace(
    FOUR_BAR, links=(*FOUR_BAR.links[:2], replace(FOUR_BAR.links[2], centre=None, mass=None, inertia=None))
)
SLOTTED_LEVER = loaded("A", "C S:l_S / S m J", *pins("O01 A12 C30@l_OC"), LEVER_SLOT)
SCOTCH_YOKE = loaded("A", "S / S m", *pins("O01 A12"), SLOT, GUIDE)
TANGENT = loaded(  # a slider on the crank, a slider on the frame, a common pin
    "B",
    "B S:l_S / S m",
    *pins("O01 B23"),
    Prismatic("B", (2, 1), ORIGIN, ZERO),
    Prismatic("B", (3, 0), ("l_OC", ZERO), "gamma"),
)


@dataclass(frozen=True, eq=False)
class Case:
    """One position.

    `says` is the key of the reason and what it names; `lost` and `kept` are some of the quantities that are undefined
    and defined; `limits` what some tend to from both sides, magnitudes of vectors; `hidden` the lost ones that tend to
    something all the same. `exact` are givens with all digits; `along` what is moved to come near.
    """

    name: str
    of: Mechanism
    values: Mapping[str, float]
    status: str
    says: tuple[str, dict[str, Any]] | None = None
    lost: str = ""
    kept: str = ""
    limits: Mapping[str, float] = field(default_factory=dict)
    hidden: str = ""
    exact: Mapping[str, Number] = field(default_factory=dict)
    along: str = "phi"

    def __str__(self) -> str:
        return self.name


# Limits from both sides, with a hundred digits and on data that are exact.
DIGITS = 100
STEPS = (mpf(10) ** -18, mpf(10) ** -21)
CLOSE = 1e-7  # part of a value within which two are one: towards a limit of reach it comes as the root of the step
NOTHING = 1e-12  # SI, in mechanisms of about a metre, what vanishes


class NearBoard(_FiftyDigits):
    """As many digits as one likes, without the thresholds of double precision: as near to a position as one likes."""

    parallel = folded = mpf(10) ** -60
    touching = mpf(10) ** -90
    corrections = 16

    def _upright(self, component: Any) -> Any:
        return component


@dataclass(frozen=True, slots=True)
class Limit:
    """What a quantity tends to from each side, None from a side on which the mechanism cannot be assembled."""

    below: complex | None
    above: complex | None
    unique: bool

    @property
    def value(self) -> complex | None:
        """The limit, None where there is none."""
        one = self.above if self.below is None else self.below
        return one if self.unique else None


def limits(solved: SolvedLinkage, along: str, exact: Mapping[str, Number]) -> dict[str, Limit]:
    """Return the limits of all quantities, as `along` goes to its value in the solved position."""
    with mp.workdps(DIGITS):
        givens = {name: mpf(repr(x)) if isinstance(x, float) else mpf(x) for name, x in solved.givens.items()}
        givens |= {name: number() for name, number in exact.items()}
        sides = [[_run(solved.program, {**givens, along: givens[along] + s * d}) for d in STEPS] for s in (-1, 1)]
    if all(values is None for side in sides for values in side):
        return {}
    names = [name for name in solved.quantities if name in solved.program.names]
    return {name: _limit(name, sides) for name in names}


def _run(program: Program, givens: Mapping[str, Any]) -> Mapping[str, Any] | None:
    board = NearBoard(givens)
    program.run(board)
    return None if board.trouble is not None else board.values


def _limit(name: str, sides: list[list[Mapping[str, Any] | None]]) -> Limit:
    found = [[complex(values[name]) for values in side if values is not None] for side in sides]
    every = [value for side in found for value in side]
    most = max(map(abs, every))
    spread = max(abs(value - every[0]) for value in every)
    unique = most <= NOTHING or spread <= CLOSE * most
    below, above = (side[-1] if side else None for side in found)
    return Limit(below, above, unique)


# Cases.
def crank(name: str, status: str, changed: Mapping[str, float], **more: Any) -> Case:
    """A central slider-crank, l_OA = 50 mm, l_AB = 130 mm."""
    return Case(name, nau_slider_crank(), nau_values(**changed), status, **more)


def oblique(name: str, changed: Mapping[str, float], limits: Mapping[str, float]) -> Case:
    """The same on a guide at 0.7 rad, crank and rod in line."""
    plain = ("x_O", "y_O", "x_g", "y_g", "e", "m_1", "F_1", "F_C", "F_B", "alpha_F1", "alpha_FC", "alpha_FB")
    values = {**nau_values(), **dict.fromkeys(plain, 0.0), "gamma": 0.7, "l_AC": 0.1, "phi": 0.7, **changed}
    return Case(name, general_slider_crank(), values, "ok", limits=limits)


def bars(name: str, status: str, changed: Mapping[str, float], of: Mechanism = FOUR_BAR, **more: Any) -> Case:
    """A four-bar linkage, OA = 0.1, AB = 0.25, CB = 0.2, OC = 0.3 m."""
    # across a link in line there is a reaction all the same: it follows from the moments of that link alone
    return Case(name, of, {**VALUES, **changed}, status, **{"hidden": "R_03_t R_12_t R_03_m R_12_m", **more})


def guided(name: str, status: str, of: Mechanism, changed: Mapping[str, float], **more: Any) -> Case:
    """A slotted lever, OA = 0.1, OC = 0.3 m; a Scotch yoke, OA = 0.1 m; a slotted crank."""
    exact = {"up": lambda: mp.pi / 2} if of is SCOTCH_YOKE and "up" not in changed else {}
    return Case(name, of, {**VALUES, **changed}, status, exact={**exact, **more.pop("exact", {})}, **more)


def triad(name: str, status: str, changed: Mapping[str, float], of: Mechanism = BENT, **more: Any) -> Case:
    """A central link on three legs of equal length and direction."""
    return Case(name, of, {**PRESS_VALUES, **PARALLELOGRAM, **changed}, status, **more)


def concurrent(outer: complex) -> dict[str, float]:
    """Return values of a triad with joints at 0, j, 1 - 0.3j whose legs, 0.3 m long, all point to `outer`."""
    joints = (0j, 1j, 1.0 - 0.3j)
    a, e, f = (place - 0.3 * (outer - place) / abs(outer - place) for place in joints)
    lengths = {"l_OA": abs(a), "l_AB": 0.3, "l_EC": 0.3, "l_FD": 0.3, "x_C": 0.0, "y_C": 1.0, "x_D": 1.0, "y_D": -0.3}
    places = {"x_E": e.real, "y_E": e.imag, "x_F": f.real, "y_F": f.imag, "phi": cmath.phase(a)}
    return {**lengths, **places, "phi_0": cmath.phase(a), "x_0": 0.0, "y_0": 0.0, "angle_0": 0.0}


def hydraulic(name: str, status: str, travel: float, **more: Any) -> Case:
    """A tipper whose cylinder drives A along x; AB and CB, together 500 mm, lie in line at 100 mm."""
    task = load_task("scheme-18-hydraulic-drive")
    changed = {"s": travel, "l_AB": 270, "l_CB": 230, "x_C": 500, "y_C": -300}
    return Case(name, task.mechanism, task.values("0", changed), status, along="s", **more)


def velocity(point: str, first: str, second: str) -> tuple[str, dict[str, Any]]:
    """Return the reason where two lines of a velocity plan are parallel."""
    return "singular-velocity", {"point": point, "first": first, "second": second}


def apart(**named: str) -> tuple[str, dict[str, Any]]:
    return "no-assembly-here", named


ROD_UPRIGHT, IN_LINE = velocity("B", "⊥AB", "∥x–x"), velocity("B", "⊥AB", "⊥CB")
LEGS = ("singular-triad", {"link": 3, "legs": "2, 4, 5"})
MOTION = "V_B a_B R_12 M_bal"
OMEGA = 765 * PI / 30
EQUAL = {"l_OA": 0.07, "l_AB": 0.31, "l_CB": 0.07, "l_OC": 0.31}
SWING = {"l_OA": 0.2, "l_CB": 0.1}
BEYOND: Mapping[str, Number] = {"phi": lambda: mp.acos(mpf("0.0075") / mpf("0.12"))}
ACROSS: Mapping[str, Number] = {"phi": lambda: mp.acos(mpf(1) / 3)}
TURNING = {"omega_2": NOWHERE, "omega_3": NOWHERE}
PASSING = "V_A3C V_A3A2 V_A3 omega_3 omega_2 a_A3C_n a_A3A2_k a_A3A2_r R_12_n"
SECOND_ROD = {"gamma": 0.0, "phi": PI / 2, "gamma_5": 0.0, "e_5": 0.0, "l_4": 0.05}

# fmt: off
CRANKS = (  # dead positions, then the rod normal to the guide
    crank("outer dead position", "ok", {"phi": 0.0}, limits={"V_B": 0.0, "omega_2": -OMEGA * 5 / 13, "M_bal": 0.0}),
    crank("inner dead position", "ok", {"phi": PI}, exact=STRAIGHT, limits={"V_B": 0.0, "omega_2": OMEGA * 5 / 13}),
    oblique("dead position on an oblique guide", {}, {"V_B": 0.0, "epsilon_2": 0.0, "R_12_t": 0.0}),
    crank("crank across the guide", "ok", {"phi": PI / 2}, exact=RIGHT, limits={"V_BA": 0.0, "a_BA_n": 0.0}),
    oblique("force along the rod has no arm", {"F_C": 10.0, "alpha_FC": 0.7}, {"h_F_C": 0.0, "R_12_t": 0.0}),
    oblique("offset of the guide that is next to nothing", {"e": 1e-18}, {"V_B": 0.0}),
    crank("rod shorter than the crank, normal to the guide", "singular", {"l_OA": 0.1, "l_AB": 0.05, "phi": PI / 6},
        exact=SIXTH, says=ROD_UPRIGHT, lost=MOTION, kept="B S2 V_A a_A F_3",
        limits={"V_B": NOWHERE, "omega_2": NOWHERE}),
    crank("rod as long as the crank, both upright", "singular", {"l_AB": 0.05, "phi": PI / 2}, exact=RIGHT,
        says=ROD_UPRIGHT, lost=MOTION, kept="B", hidden="a_BA_n a_BA a_S2 F_i2",
        limits={"V_B": NOWHERE, "a_BA_n": OMEGA**2 * 0.05}),
    crank("rod as long as the crank, elsewhere", "ok", {"l_AB": 0.05, "phi": PI / 6}, exact=SIXTH),
    crank("rod as long as the crank, stretched", "ok", {"l_AB": 0.05, "phi": 0.0}, limits={"V_B": 0.0}),
    crank("rod as long as the crank, folded", "ok", {"l_AB": 0.05, "phi": PI, "side": "right"}, exact=STRAIGHT),
    crank("rod longer by 1e-8 of itself", "ill-conditioned", {"l_AB": 0.05 * (1 + 1e-8), "phi": PI / 2}),
    crank("rod longer by 1e-14 of itself", "ill-conditioned", {"l_AB": 0.05 * (1 + 1e-14), "phi": PI / 2}),
    crank("rod shorter by a last digit", "singular", {"l_AB": 0.05 - 6e-18, "phi": PI / 2}, says=ROD_UPRIGHT),
    crank("rod too short by 1e-9 of itself", "no-assembly", {"l_AB": 0.05 * (1 - 1e-9), "phi": PI / 2},
        says=apart(point="B", gap="5e-08"), lost=f"B {MOTION}", kept="A V_A a_A F_3"),
    crank("rod too short by 1e-15 of itself", "no-assembly", {"l_AB": 0.05 * (1 - 1e-15), "phi": PI / 2},
        says=apart(point="B", low="90", high="90")),
)
BARS = (
    bars("stretched: the rocker drives from a dead point", "singular", {"phi": PI, "l_AB": 0.2}, exact=STRAIGHT,
        says=IN_LINE, lost=f"omega_3 {MOTION}", kept="B V_A a_A"),
    bars("folded", "singular", {"phi": 0.0, "l_AB": 0.4}, says=IN_LINE, lost=MOTION, kept="B"),
    bars("sum that rounds", "singular", {"phi": PI, "l_AB": 0.17, "l_CB": 0.23}, exact=STRAIGHT, says=IN_LINE),
    bars("limit of assembly of a double rocker", "singular", {**SWING, "phi": math.acos(0.0075 / 0.12)}, exact=BEYOND,
        says=IN_LINE, lost=MOTION, kept="B S", limits=TURNING),
    bars("a millionth of a degree beyond", "no-assembly", {**SWING, "phi": math.acos(0.0075 / 0.12) + 1.7e-8},
        says=apart(point="B"), lost=f"B {MOTION}", kept="A V_A"),
    bars("Grashof's limit, away from the change point", "ok", {"l_OC": 0.35, "phi": 0.0}),
    bars("Grashof's limit, at the change point", "singular", {"l_OC": 0.35, "phi": PI}, exact=STRAIGHT, says=IN_LINE),
    bars("parallelogram at its change point", "singular", {"l_AB": 0.3, "l_CB": 0.1, "phi": 0.0}, says=IN_LINE,
        lost=MOTION, kept="B S", limits=TURNING),
    bars("parallelogram of uneven numbers, folded", "singular", {**EQUAL, "phi": PI}, exact=STRAIGHT, says=IN_LINE),
    bars("anti-parallelogram, folded", "singular", {**EQUAL, "phi": PI, "branch": -1.0}, exact=STRAIGHT, says=IN_LINE),
    bars("parallelogram a millionth of a radian on", "ill-conditioned", {"l_AB": 0.3, "l_CB": 0.1, "phi": 1e-6}),
    bars("parallelogram upright: the coupler does not turn", "ok", {"l_AB": 0.3, "l_CB": 0.1, "phi": PI / 2},
        exact=RIGHT, limits={"omega_2": 0.0, "epsilon_2": 0.0, "V_BA": 0.0}),
    bars("kite, all links in line", "singular", {"l_AB": 0.1, "l_CB": 0.3, "phi": 0.0}, says=IN_LINE, kept="B"),
    bars("kite, pins coincide", "singular", {"l_OA": 0.3, "l_AB": 0.1, "l_CB": 0.1, "phi": 0.0},
        says=("singular-pins", {"first": "A", "second": "C"}), lost=f"B {MOTION}", kept="V_A a_A"),
    bars("pins coincide, links unequal", "no-assembly", {"l_OA": 0.3, "l_AB": 0.1, "phi": 0.0},
        says=apart(point="B", gap="100")),
    bars("two links too short", "no-assembly", {"phi": PI, "l_AB": 0.15}, says=apart(point="B", gap="50")),
    bars("one link too long", "no-assembly", {"phi": 0.0, "l_AB": 0.45}, says=apart(point="B", gap="50")),
    bars("both pivots in one point", "ok", {"l_OC": 0.0, "branch": -1.0}, limits={"omega_3": 10.0}),
    bars("both pivots in one point, links in line", "singular", {"l_OC": 0.0, "l_CB": 0.35}, says=IN_LINE),
    bars("force plan whose unknowns are parallel", "singular", {"phi": PI, "l_AB": 0.2}, WEIGHTLESS, exact=STRAIGHT,
        says=IN_LINE, lost="R_12_n R_12 R_32 R_03 M_bal", hidden="R_03_m R_12_m", kept="F h_F R_03_t R_12_t B",
        limits={"R_12_n": NOWHERE, "R_12_t": 0.0}),
)
GUIDES = (  # slotted links, then two guides
    guided("slider at the pivot of its lever", "singular", SLOTTED_LEVER, {"l_OC": 0.1, "phi": 0.0},
        says=("singular-pins", {"first": "C", "second": "A"}), lost="S V_A3 R_12 M_bal", kept="V_A a_A",
        limits={"omega_3": 5.0, "V_A3A2": 1.0, "a_A3A2_k": 10.0, "V_S": NOWHERE}, hidden=PASSING),
    guided("slider nearly at the pivot", "ill-conditioned", SLOTTED_LEVER, {"l_OC": 0.1, "phi": 1e-5}),
    guided("no sliding: crank in line with the pivots", "ok", SLOTTED_LEVER, {"phi": PI}, exact=STRAIGHT,
        limits={"V_A3A2": 0.0, "a_A3A2_k": 0.0, "omega_3": 2.5}),
    guided("lever at rest: crank across the slot", "ok", SLOTTED_LEVER, {"phi": math.acos(1 / 3)}, exact=ACROSS,
        limits={"omega_3": 0.0, "a_A3A2_k": 0.0, "V_A3": 0.0}),
    guided("offset as large as the way to the pin", "singular", SLOTTED_LEVER, {"phi": 0.0, "e": 0.2},
        says=velocity("A3", "⊥CA", "∥x–x"), lost="omega_3 V_A3 M_bal", kept="S V_A", hidden="R_12_t"),
    guided("offset larger by 1e-9 of it", "no-assembly", SLOTTED_LEVER, {"phi": 0.0, "e": 0.2 * (1 + 1e-9)},
        says=apart(point="A", gap="2e-07")),
    guided("yoke at the end of its stroke", "ok", SCOTCH_YOKE, {"phi": 0.0}, limits={"V_S": 0.0, "a_S": 10.0}),
    guided("yoke without acceleration", "ok", SCOTCH_YOKE, {"phi": PI / 2}, exact=RIGHT,
        limits={"a_S": 0.0, "F_i3": 0.0}),
    guided("slot along the guide", "singular", SCOTCH_YOKE, {"up": 0.0},
        says=("singular-position", {"point": "S", "first": "∥y–y", "second": "∥x–x"}), lost="S V_A3 R_03", kept="A V_A",
        hidden="M_03 F_i3", along="up"),
    guided("slot nearly along the guide", "ill-conditioned", SCOTCH_YOKE, {"up": 1e-6}),
    guided("guides of crank and frame parallel", "singular", TANGENT, {"gamma": 0.7},
        says=("singular-position", {"point": "B", "first": "∥x–x", "second": "∥y–y"}), lost=f"B {MOTION}",
        kept="omega_1 F", hidden="M_03", along="gamma"),
    guided("guides nearly parallel", "ill-conditioned", TANGENT, {"gamma": 0.7 + 1e-6}),
    guided("parallel guides in one line", "singular", TANGENT, {"gamma": 0.0, "phi": 0.0, "l_OC": 0.0},
        says=("singular-position", {"point": "B"}), lost="B V_B", hidden="B S V_B1 V_B a_B M_03"),
    guided("force that resists a yoke at rest", "ok", replace(SCOTCH_YOKE, loads=(Load("F", 3, "S", "F"),)),
        {"phi": 0.0}, limits={"V_S": 0.0}, kept="F R_03 M_bal", exact={"up": lambda: mp.pi / 2}),
)
TRIADS = (
    triad("legs of a triad parallel: its dead position", "singular", {"phi": DEAD}, says=LEGS, lost="D V_D M_bal",
        kept="A V_A", hidden="B C D S3"),
    triad("legs of a triad meet in one point", "singular", concurrent(0.4 + 0.2j), says=LEGS, lost="D V_D R_12 M_bal",
        kept="A V_A a_A", hidden=EVERYTHING),
    triad("triad a billionth of a radian before", "ill-conditioned", {"phi": DEAD - 1e-9}),
    triad("triad a billionth of a radian beyond", "no-assembly", {"phi": DEAD + 1e-9}, says=("no-way", {"link": 3})),
    triad("two legs of a triad parallel", "ok", {"phi": 0.2}, limits={"omega_3": 0.0, "epsilon_3": 0.0}),
    triad("special point asked of two parallel legs", "singular", {"phi": 0.2},
        of=replace(BENT, starts=(replace(BENT.starts[0], legs=(4, 5)),)),
        says=("singular-position", {"point": "X3", "first": "∥EC", "second": "∥FD"}), lost="X3 V_D", kept="B C D S3",
        hidden=EVERYTHING),
)
OTHERS = (  # a group that fails leaves what others give; a driver that slides
    Case("second rod upright on the same pin", twin(False), {**twin_values(), **SECOND_ROD}, "singular",
        says=velocity("D", "⊥AD", "∥y–y"), lost="V_D R_14 R_05 R_01 M_bal", kept="V_B a_B R_12 R_03 D",
        hidden="a_DA_n a_DA a_S4 F_i4", exact=RIGHT),
    hydraulic("piston at its stop", "singular", 100, says=IN_LINE, lost="V_B omega_3 F_bal", kept="B D V_A",
        limits={"omega_3": NOWHERE}),
    hydraulic("piston a nanometre beyond", "no-assembly", 100 - 1e-6, says=("no-assembly-slide", {"point": "B"})),
    hydraulic("piston a nanometre before", "ill-conditioned", 100 + 1e-6),
)
# fmt: on
CASES: tuple[Case, ...] = (*CRANKS, *BARS, *GUIDES, *TRIADS, *OTHERS)
