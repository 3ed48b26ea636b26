"""A gear pair solved: its construction, values and quantities together, and its teeth when they are asked for."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ...scales.scale import steps
from ..boards.exact import run
from ..check import Check
from ..quantities import Quantity, quantities, shown_on
from ..solved import PAPER_MM, Solved
from .checks import checks, cut, on_flanks
from .construction import (
    CENTRES,
    DIAGRAMS,
    ENDLESS,
    MESHING,
    NUMBERS,
    RIGHT,
    SLIDING,
    TANGENT,
    THETA,
    UP,
    Layout,
    construct,
    rolling,
)
from .gear import PLANS, WHEELS, GearPair, unit_of
from .geometry import DIVISIONS, NOTHING, PARTS, POINTS, geometry
from .givens import complete
from .meshing import Meshing, meshing_of
from .sections import place_of

SCALES = {MESHING: "mu_l", SLIDING: "mu_rho", THETA: "mu_theta"}
# the plan that shows a quantity as a segment, beside those that are read from one
SHOWN_ON = dict.fromkeys(
    (
        *("a_w", "g_alpha", "g_f", "g_a", "l_N1N2", "p_b", "g_alpha_drawn", "l_N1N2_drawn", "c_1", "c_2"),
        *(f"{name}{i}" for i in WHEELS for name in ("d_", "d_w", "d_b", "d_a", "d_f", "d_p")),
        *(f"{name}{i}" for i in WHEELS for name in ("r_p", "rho_p", "rho_l", "rho_w", "rho_a")),
    ),
    MESHING,
)
LONGEST = 250.0  # mm, that N1N2 may be under the diagrams
# the three points of the table that stand in A1, P, A2, in the order in which these follow from N1 to N2
MARKS = tuple(POINTS[sum(n for _, n in DIVISIONS[: k + 1])] for k in range(3))


@dataclass(frozen=True, kw_only=True)
class SolvedGear(Solved):
    """A pair solved; `sizes` are its complete givens and all that is calculated of them, by name, SI."""

    pair: GearPair
    sizes: Mapping[str, float]
    layout: Layout

    @cached_property
    def meshing(self) -> Meshing:
        """The teeth of both wheels with their exact outlines, and how they mesh; made when first asked for."""
        return meshing_of(self.sizes, self.pair.sense)

    @property
    def checks(self) -> tuple[Check, ...]:
        """What the pair is judged by; the teeth are made where they may have lost a part of their flanks."""
        found = checks(self.pair, self.sizes)
        if not cut(self.sizes):
            return tuple(found)
        place = 1 + [check.name for check in found].index("contact_ratio")
        return (*found[:place], *on_flanks(self.sizes, self.meshing.touching), *found[place:])

    @property
    def edges(self) -> tuple[str, ...]:
        """The directions along which a drafting machine draws: tangent in the pole, line of centres, axes."""
        return TANGENT, CENTRES, RIGHT, UP

    @property
    def on_paper(self) -> tuple[str, ...]:
        """The diagrams of sliding, which are drawn in millimetres of paper."""
        return tuple(plan for plan in DIAGRAMS if plan in self.scale_of_plan)

    def worth(self, mus: Mapping[str, float]) -> dict[str, float]:
        """Return what a millimetre of every plan is worth to the board: the diagrams are drawn in paper itself."""
        return {plan: PAPER_MM if plan in DIAGRAMS else mu for plan, mu in mus.items()}


def solve_gear(pair: GearPair, values: Mapping[str, float], plans: Iterable[str] = PLANS) -> SolvedGear:
    """Solve a gear pair.

    Parameters
    ----------
    pair : GearPair
        Senses and materials, all chosen.
    values : mapping of str to float
        Its numbers in SI by name, as `givens.complete` takes them.
    plans : iterable of str
        Plans wanted, of `gear.PLANS`; those they need are built too, no others.

    Raises
    ------
    InputError
        Numbers of which no pair can be made.
    """
    found = complete(values)
    sizes = geometry(found)
    layout = layout_of(pair, sizes)
    program = construct(layout, plans)
    givens = {**found, **board_givens(pair, sizes)}
    board = run(program, givens)
    drawn = {*program.plans}
    results = quantities(program, board.values, _lengths(givens, drawn), unit_of)
    if SLIDING in drawn:
        results = _with_ends(results)
    return SolvedGear(
        program=program,
        values={**board.values, **(dict.fromkeys(ENDLESS, -math.inf) if SLIDING in drawn else {})},
        quantities=_in_sections(_stated(givens, drawn, values) | results),
        sines=board.sines,
        status=board.status,
        trouble=board.trouble,
        shown_on=shown_on(program) | {name: plan for name, plan in SHOWN_ON.items() if plan in drawn},
        scale_of_plan={plan: SCALES[plan] for plan in program.plans if plan in SCALES},
        givens=givens,
        pair=pair,
        sizes=sizes,
        layout=layout,
    )


def layout_of(pair: GearPair, sizes: Mapping[str, float]) -> Layout:
    """Return what the construction of a pair with these sizes depends on."""
    first, second = (rolling(sizes[f"rho_w{i}"], sizes[f"rho_a{i}"]) for i in WHEELS)
    return Layout((first, second), pair.sense, point_at_pole(sizes))


def point_at_pole(sizes: Mapping[str, float]) -> str:
    """Return the point of the table of sliding that stands in P: the second of three, unless A1 or A2 is beyond it."""
    before = sum(min(max(sizes[name], 0.0), sizes["l_N1N2"]) < sizes["rho_w1"] for name in ("rho_p1", "rho_a1"))
    return MARKS[before]


def board_givens(pair: GearPair, sizes: Mapping[str, float]) -> dict[str, float]:
    """Return what the board begins with beside the numbers of the pair: senses, numbers, the scale of the diagrams."""
    sense = float(pair.sense)
    mu_rho = steps(sizes["l_N1N2"] / LONGEST)[0]
    return {**PARTS, **NOTHING, **NUMBERS, "_sense": sense, "_against": -sense, "mu_rho": mu_rho / PAPER_MM}


def _stated(givens: Mapping[str, Any], drawn: set[str], values: Mapping[str, float]) -> dict[str, Quantity]:
    """Return what the board begins with and is a result: scale factors of diagrams, shifts that have been found."""
    units = {SLIDING: ("mu_rho", "m/mm"), THETA: ("mu_theta", "1/mm")}
    scales = (item for plan, item in units.items() if plan in drawn)
    found = {name: Quantity(name, givens[name] * PAPER_MM, unit) for name, unit in scales}
    return found | {name: Quantity(name, givens[name], "1") for name in ("x_1", "x_2") if name not in values}


def _in_sections(results: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """Return the quantities section by section, in each in the order of construction."""
    return {name: results[name] for name in sorted(results, key=place_of)}


def _with_ends(results: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """Return the quantities with those of the table that are undefined, each beside the other one of its point."""
    found: dict[str, Quantity] = {}
    for name, quantity in results.items():
        ends = [Quantity(end, None, unit_of(end)) for end, other in ENDLESS.items() if name == other]
        found |= {item.name: item for item in sorted((quantity, *ends), key=lambda item: item.name)}
    return found


def _lengths(givens: Mapping[str, Any], drawn: set[str]) -> dict[str, float]:
    """Return the given lengths that are results, too."""
    return {"PW": givens["PW"]} if SLIDING in drawn else {}
