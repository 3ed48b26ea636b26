"""The sheet of a gear pair: its figures, the ladders of their scale factors, the pages on which they stand."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import product
from typing import Any

from ...plans.gears.construction import MESHING, SLIDING, THETA
from ...plans.gears.gear import GEOMETRY_PART, MESHING_PART, SLIDING_PART
from ...plans.gears.solve import SolvedGear
from ...scales.errors import InputError
from ...scales.scale import Choosers, Fixed, From, Scale, steps
from ..compose import last
from ..extents import Rungs, smallest, visible
from ..figure import Figure, Fitting, Found, SheetContents
from ..formats import FORMATS, STYLES, Format, room
from .scene import TOOTH, UNITS, GearScene, lettered, sliding_mu

LONGEST = 230.0  # mm, that N1N2 may be where the involutes are constructed
FOREIGN = 4e-5  # m/mm, 25:1
# mm^2 of A1, of figures with their texts
AREAS = {GEOMETRY_PART: 2.6e5, MESHING_PART: 3e5, SLIDING_PART: 9e4}
PARTS = 1.0, 0.8, 0.6, 0.5  # of the usual size of the diagrams of sliding
BESIDE = ("rolled", "part")  # ladders of what stands beside the meshing
# rungs further at which a page is tried
SMALLER = [dict(zip(BESIDE, more, strict=True)) for more in sorted(product(range(3), repeat=len(BESIDE)), key=sum)]
GearFigure = Figure[GearScene]


def _mu_ladder(solved: SolvedGear, choosers: Choosers) -> tuple[float, ...]:
    """Return the scale factors of the meshing, the one wanted first: where nothing is said, teeth of 50 mm."""
    wanted = choosers.get("mu_l", From(_finest(solved)))
    first, *others = wanted.ladder(lambda name: solved.sizes.get(name, solved.sizes["a_w"]))
    if MESHING in solved.scale_of_plan:
        visible(wanted, "mu_l", first, solved.sizes["a_w"], "m")
    return first, *_standard(others)


def _near_ladder(solved: SolvedGear, least: float = 0.0) -> tuple[float, ...]:
    """Return the scale factors, from a least one on, of the middle of a meshing that is drawn apart."""
    return _standard(From(max(_finest(solved), least)).ladder(lambda _: solved.sizes["a_w"]))


def _rolled_ladder(solved: SolvedGear) -> tuple[float, ...]:
    """Return the scale factors of the construction of the involutes and of the line of action straightened."""
    return _near_ladder(solved, _standard(steps(solved.sizes["l_N1N2"] / LONGEST))[0])


def _finest(solved: SolvedGear) -> float:
    most = solved.sizes["h"] / TOOTH
    return max(mu for mu in _standard(steps(most / 10.0)) if mu <= most * (1.0 + 1e-9))


def _standard(mus: Iterable[float]) -> tuple[float, ...]:
    """Return the scale factors that GOST 2.302 has: 2,5:1 is one of its enlargements, 25:1 is not."""
    return tuple(mu for mu in mus if not math.isclose(mu, FOREIGN))


def first_scales(solved: SolvedGear, choosers: Choosers, plans: Sequence[str]) -> tuple[Format, dict[str, Scale]]:
    """Return the format and the scale factors by plan: the given ones, or coarser ones where diagrams have no room."""
    sheet, mus = smallest(AREAS[plan] for plan in plans), {MESHING: _mu_ladder(solved, choosers)[0]}
    if SLIDING in solved.scale_of_plan:
        size = STYLES[sheet.letters].label, _parts_of(plans)[0]
        mus |= {plan: sliding_mu(solved, plan, *size) for plan in (SLIDING, THETA)}
    return sheet, {plan: Scale(symbol, mus[plan], UNITS[plan]) for plan, symbol in solved.scale_of_plan.items()}


def _parts_of(plans: Sequence[str]) -> tuple[float, ...]:
    """Return what diagrams of sliding may have of their usual size, the wanted part first: beside the meshing less."""
    return PARTS[1:] if {MESHING_PART, SLIDING_PART} <= {*plans} else PARTS


class GearFitting(Fitting[SolvedGear, GearScene]):
    """Draws what the sheet of a gear pair shows."""

    first_scales = staticmethod(first_scales)

    def __init__(self, contents: SheetContents[SolvedGear]) -> None:
        solved = contents.solved
        ladders = {
            "mu_l": _mu_ladder(solved, contents.choosers),
            "near": _near_ladder(solved),
            "rolled": _rolled_ladder(solved),
            "part": _parts_of(contents.plans),
        }
        super().__init__(contents, lettered(contents.words), ladders)

    def scene(self, sheet: Format, rungs: Rungs) -> GearScene:
        """Return the scene of a sheet on a format."""
        mus: dict[str, Any] = {name: self.ladders[name][rung] for name, rung in rungs.items()}
        return GearScene(self.contents.solved, self.words, STYLES[sheet.letters], self.contents.givens, **mus)

    def figures(self, scene: GearScene, width: float) -> Iterator[GearFigure]:
        """Go through the figures of a sheet in the order of the work; lines of text are at most `width` mm long."""
        from . import action_view, cutting_view, meshing_view, text

        plans = self.contents.plans
        if MESHING_PART in plans:
            yield meshing_view.FIGURE
            if scene.apart:
                yield meshing_view.NEAR
            yield cutting_view.FIGURE
        if GEOMETRY_PART in plans:
            yield Figure("data", text.data_table)
        if MESHING_PART in plans:
            yield action_view.ACTION_FIGURE
        if GEOMETRY_PART in plans:
            yield Figure("checks", text.checks_table)
        if SLIDING_PART in plans:
            yield from (Figure("points", text.points_table), action_view.SLIDING_FIGURE)
        if GEOMETRY_PART in plans:
            yield Figure("contour", cutting_view.contour_view)
            yield Figure("rack", cutting_view.rack_view, ("near",))
            for name in text.CALCULATED:
                yield Figure(f"equations_{name}", partial(text.calculations_block, name=name, width=width))

    def on_a_page(self, sheet: Format, last: bool) -> Found | None:
        """Place everything on one page as large as wanted; on the `last` format it is tried with several pages."""
        return None if last else self.placed(sheet, self.wanted)

    def on_pages(self, sheet: Format) -> Found:
        """Take as few pages as there can be, with what is beside the meshing smaller where that helps."""
        # the pages of a handout, with another frame, have what those of the sheet have
        (wide, high), usual = room(sheet, self.contents.norm), FORMATS[sheet.name]
        first, sizes = dict(self.wanted), self.contents.solved.sizes
        # the first rungs at which the lines that size the views have room, before any view is drawn
        lines = {"mu_l": (sizes["a_w"], high), "near": (2.0 * sizes["p"], wide), "rolled": (sizes["l_N1N2"], wide)}
        for name, (length, most) in lines.items():
            first[name] = next((k for k, mu in enumerate(self.ladders[name]) if length / mu < most), 0)
        first = self._as_wanted(self.fitted(sheet, self._as_wanted(first, sheet)), sheet)
        while True:
            ways = [own for more in SMALLER if (own := self.arranged(usual, self._lowered(first, more)))]
            rungs = min(ways, key=lambda found: last(found[2]))[0] if ways else first
            if ways and (found := self.arranged(sheet, rungs)):
                return found
            if not self.has_next(first, "mu_l"):
                raise InputError("sheet-too-small", format=sheet.name)
            first = self.lower(first, "mu_l")  # the first page has less room than the others

    def _as_wanted(self, rungs: Rungs, sheet: Format) -> Rungs:
        """Return rungs; where all is to be drawn as wanted they are refused if the task's own scale is given up."""
        if rungs["mu_l"] and isinstance(self.contents.choosers.get("mu_l"), Fixed):
            self.refuse_smaller(sheet)
        return rungs

    def _lowered(self, rungs: Rungs, further: Mapping[str, int]) -> Rungs:
        """Return rungs so many steps further, as far as there are any."""
        return rungs | {name: min(rungs[name] + step, len(self.ladders[name]) - 1) for name, step in further.items()}
