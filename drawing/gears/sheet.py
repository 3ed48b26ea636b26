"""The sheet of a gear pair: what every view of it needs, its scale factors and their ladders, its figures and pages."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain, product
from typing import Any

from ...plans.gears.construction import MESHING, SLIDING, THETA
from ...plans.gears.gear import GEOMETRY_PART, MESHING_PART, SLIDING_PART
from ...plans.gears.geometry import POINTS
from ...plans.gears.solve import SAME, SCALES, SolvedGear
from ...plans.gears.teeth import Meshing, Wheel, wheels
from ...plans.solved import PAPER_MM
from ...scales.choose import Choosers, From
from ...scales.errors import InputError
from ...scales.scale import Scale, steps
from ..compose import BLOCK, TURNED, Nest, arrange, column, names, row, zoned
from ..extents import Rungs, not_a_point, smallest, visible
from ..figure import Figure, Fitting, Found, SheetContents, SubjectScene, pages
from ..formats import STYLES, Format, room
from ..packing import Placement
from ..pens import Norm
from ..table import note_block
from ..view import View
from ..words import Words

TALL = 7.0  # heights of letters that a tooth must have for what is measured on it
OF_POINTS = {"y_1": "y_{1}", "y_2": "y_{2}", "theta_12": "θ_{12}", "theta_21": "θ_{21}"}
# rho_1 of a place, its distance from N1: by the name of a quantity
PLACES = {"A1": "rho_p1", "P": "rho_w1", "A2": "rho_a1"}
NUMBERS = ("03", "06", "08")  # points of the table at the three places, in the order in which they lie
TOOTH = 50.0  # mm, by which a drawn tooth should be high at least
LONGEST = 230.0  # mm, that N1N2 may be where the involutes are constructed
FOREIGN = 4e-5  # m/mm, 25:1
# mm^2 of A1, of figures with their texts
AREAS = {GEOMETRY_PART: 2.6e5, MESHING_PART: 3e5, SLIDING_PART: 9e4}
# mm of the line of action and of the axis of specific sliding on the diagrams, by the height of letters
ALONG, HIGH = {5.0: 250.0, 3.5: 140.0}, {5.0: 125.0, 3.5: 62.0}
CURVES = {1: "theta_12", 2: "theta_21"}  # of specific sliding
ENDS = {"A1": "rho_p1", "A2": "rho_a1"}  # of the active line, and the quantities that are their distances from N1
CUTS = 2.0, 10.0  # the least and the greatest depth at which curves are cut off
USUAL = 5.0  # where sliding has no limit on the active line
ROOM = 1.25  # how far below the extremes
PARTS = 1.0, 0.8, 0.6, 0.5  # of the usual size of the diagrams of sliding
UNITS = {MESHING: "m", SLIDING: "m", THETA: "1"}


@dataclass(frozen=True, slots=True)
class GearScene(SubjectScene[SolvedGear]):
    """A solved pair on a certain format, in certain words.

    `mu_l` is the scale factor of the meshing with both centres, `near` that of its middle, which has a view of its own
    where teeth are too small beside their letters, `rolled` that of the construction of the involutes;
    m/mm. `part` is how much of their usual size the diagrams of sliding have; `close` is the scene of that middle.
    """

    mu_l: float = 1.0
    near: float = 1.0
    rolled: float = 1.0
    part: float = 1.0
    close: bool = False

    @property
    def meshing(self) -> Meshing:
        """The teeth and how they mesh."""
        return self.solved.meshing

    @property
    def apart(self) -> bool:
        """Whether the middle of the meshing has a view of its own."""
        return self.paper("h") < TALL * self.style.label

    @property
    def lacking(self) -> bool:
        """Whether undercut or pointed teeth lack a part of the flanks that would touch on the active line."""
        first, last = self.touching
        return last - first < self.size("g_alpha") * (1.0 - SAME)

    @property
    def touching(self) -> tuple[float, float]:
        """Between which rho_1 flanks touch, m; the same number twice where none do."""
        first, last = self.meshing.touching
        return first, max(first, last)

    def size(self, name: str) -> float:
        """Return a quantity, SI."""
        return float(self.solved.sizes[name])

    def paper(self, name: str) -> float:
        """Return a length as it is drawn in the meshing, mm."""
        return self.drawn(self.size(name))

    def drawn(self, length: float) -> float:
        """Return the millimetres that show a length of the meshing, m."""
        return length / self.mu_l

    def mm(self, mark: str) -> complex:
        """Return a mark of the meshing in mm from the pole."""
        return self.solved.point(f"{MESHING}.{mark}") * (1.0 / self.mu_l)

    def scale(self, plan: str) -> Scale:
        """Return the scale factor of a plan as it is drawn."""
        mu = self.mu_l if plan == MESHING else sliding_mu(self.solved, plan, self.style.label, self.part)
        return Scale(SCALES[plan], mu, UNITS[plan])

    def wheels(self, rho_1: float | None = None) -> tuple[Wheel, Wheel]:
        """Return both wheels on the paper while they touch at `rho_1`, m from N1; by default at the pole."""
        return wheels(self.meshing, self.solved.sizes, self.mu_l, rho_1)

    def factor(self, mu: float) -> str:
        """Return the scale of a view as drawings have it, and its scale factor: M 5:1; mu_l = 0.0002 m/mm."""
        return f"{self.words.drawn_at(mu)};  {self.words.scale(Scale('mu_l', mu, 'm'))}"

    def stated(self, name: str, decimals: int = 2) -> str:
        """Return a quantity in mm as a dimension has it: d_a1 = 86.53."""
        return f"{self.words.symbol(name)} = {self.length(self.size(name), decimals)}"

    def length(self, value: float, decimals: int = 2) -> str:
        """Return a length in mm."""
        return self.words.number(value * 1e3, decimals)

    def shift(self, name: str) -> str:
        """Return a profile shift with its letter: x_1 = 0.5."""
        return f"{self.words.symbol(name)} = {self.words.short(round(self.size(name), 4))}"

    def angle(self, name: str) -> str:
        """Return an angle with its letter: alpha_w = 26.65°."""
        return f"{self.words.symbol(name)} = {self.degrees(self.size(name))}"


def lettered(words: Words) -> Words:
    """Return the words with the letters of a gear pair; what is of a point of the sliding table has its number."""
    table = words.letters_of("gears")
    for name, letter in OF_POINTS.items():
        table |= {f"{name}_{point}": f"{letter}({int(point)})" for point in POINTS}
    return words.lettered(table)


def places(values: Mapping[str, Any]) -> dict[str, float]:
    """Return the named places in their order on the line of action: their distances from N1, m.

    A1 and A2 lie between N1 and N2 in a pair without interference.
    """
    line = float(values["l_N1N2"])
    found = {"N1": 0.0, **{name: float(values[rho]) for name, rho in PLACES.items()}, "N2": line}
    return dict(sorted(found.items(), key=lambda item: item[1]))


def marks(values: Mapping[str, Any]) -> dict[str, str]:
    """Return the points of the table that stand at the named places, by the names of these."""
    line = float(values["l_N1N2"])
    inner = sorted(PLACES, key=lambda name: min(max(float(values[PLACES[name]]), 0.0), line))
    return {"N1": POINTS[0], **dict(zip(inner, NUMBERS, strict=True)), "N2": POINTS[-1]}


def mu_ladder(solved: SolvedGear, choosers: Choosers) -> tuple[float, ...]:
    """Return the scale factors of the meshing, the one wanted first: where nothing is said, teeth of 50 mm."""
    wanted = choosers.get("mu_l", From(_finest(solved)))
    first, *others = wanted.ladder(lambda name: solved.sizes.get(name, solved.sizes["a_w"]))
    if MESHING in solved.scale_of_plan:
        visible(wanted, "mu_l", first, solved.sizes["a_w"], "m")
    return first, *_standard(others)


def near_ladder(solved: SolvedGear, least: float = 0.0) -> tuple[float, ...]:
    """Return the scale factors, from a least one on, of the middle of a meshing that is drawn apart."""
    return _standard(From(max(_finest(solved), least)).ladder(lambda _: solved.sizes["a_w"]))


def rolled_ladder(solved: SolvedGear) -> tuple[float, ...]:
    """Return the scale factors of the construction of the involutes and of the line of action straightened."""
    return near_ladder(solved, _standard(steps(solved.sizes["l_N1N2"] / LONGEST))[0])


def _finest(solved: SolvedGear) -> float:
    most = solved.sizes["h"] / TOOTH
    return max(mu for mu in _standard(steps(most / 10.0)) if mu <= most * (1.0 + 1e-9))


def _standard(mus: Iterable[float]) -> tuple[float, ...]:
    """Return the scale factors that GOST 2.302 has: 2,5:1 is one of its enlargements, 25:1 is not."""
    return tuple(mu for mu in mus if not math.isclose(mu, FOREIGN))


def first_scales(solved: SolvedGear, choosers: Choosers, plans: Sequence[str]) -> tuple[Format, dict[str, Scale]]:
    """Return the format and the scale factors by plan: the given ones, or coarser ones where diagrams have no room."""
    sheet = smallest(AREAS[plan] for plan in plans)
    values = {MESHING: mu_ladder(solved, choosers)[0]}
    if SLIDING in solved.scale_of_plan:
        height, part = STYLES[sheet.letters].label, parts_of(plans)[0]
        values |= {plan: sliding_mu(solved, plan, height, part) for plan in (SLIDING, THETA)}
    return sheet, {plan: Scale(symbol, values[plan], UNITS[plan]) for plan, symbol in solved.scale_of_plan.items()}


def parts_of(plans: Sequence[str]) -> tuple[float, ...]:
    """Return what diagrams of sliding may have of their usual size, the wanted part first: beside the meshing less."""
    return PARTS[1:] if {MESHING_PART, SLIDING_PART} <= {*plans} else PARTS


def sliding_mu(solved: SolvedGear, plan: str, letters: float, part: float) -> float:
    """Return the scale factor of a diagram of sliding, the given one or a coarser one of its series, SI per mm.

    `letters` are so high, mm; diagrams have `part` of their usual size. Raises InputError where the given one of
    specific sliding is so coarse that the diagram is a line.
    """
    wanted = float(solved.values[SCALES[plan]]) * PAPER_MM
    if plan == SLIDING:
        return steps(max(wanted, solved.sizes["l_N1N2"] / (ALONG[letters] * part)))[0]
    depth = 1.0 - cut_of(solved)
    not_a_point(SCALES[plan], wanted, depth, UNITS[plan])
    return steps(max(depth / (HIGH[letters] * part), wanted * (1.0 - 1e-9)))[0]


def cut_of(solved: SolvedGear) -> float:
    """Return the value at which the curves are cut off: a whole number below both extremes of the active line."""
    lowest = min(solved.sizes[f"{name}_{end}"] for name in CURVES.values() for end in ENDS)
    if not math.isfinite(lowest):
        return -USUAL
    return -min(max(math.ceil(-ROOM * lowest), CUTS[0]), CUTS[1])


Way = Callable[[list[View], Format, Norm], list[Placement] | None]
BESIDE = ("rolled", "part")  # ladders of what stands beside the meshing
# rungs further at which a page is tried
SMALLER = [dict(zip(BESIDE, steps, strict=True)) for steps in sorted(product(range(3), repeat=len(BESIDE)), key=sum)]
LEAST = 0.25  # part of the area that what stands beside the meshing keeps at the last of these
FULL = 0.75  # part of a format that views may cover
GearFigure = Figure[GearScene]


def _page(*below: Nest) -> Nest:
    """Return a page with the meshing on the left, and so much below the involutes and the data."""
    return row(column(TURNED, "meshing"), column(row("rolling", "data"), row(*below)))


# everything on one page, for sheets without the worked formulas
LAYOUTS = (_page(column("action", "sliding"), column("points", "checks", "contour", BLOCK)),)
# what is drawn, where the calculations need a further page; where it has no room, the meshing with what belongs to it
FIRST_PAGES = (
    _page(column("action", "checks", "points"), column("sliding", BLOCK)),
    _page(column("action", "contour"), column("checks", BLOCK)),
)


class GearFitting(Fitting[SolvedGear, GearScene]):
    """Draws what the sheet of a gear pair shows."""

    first_scales = staticmethod(first_scales)

    def __init__(self, contents: SheetContents[SolvedGear]) -> None:
        solved = contents.solved
        ladders = {
            "mu_l": mu_ladder(solved, contents.choosers),
            "near": near_ladder(solved),
            "rolled": rolled_ladder(solved),
            "part": parts_of(contents.plans),
        }
        super().__init__(contents, lettered(contents.words), ladders)

    def scene(self, sheet: Format, rungs: Rungs) -> GearScene:
        """Return the scene of a sheet on a format."""
        mus: dict[str, Any] = {name: self.ladders[name][rung] for name, rung in rungs.items()}
        return GearScene(self.contents.solved, self.words, STYLES[sheet.letters], self.contents.givens, **mus)

    def figures(self, scene: GearScene, width: float) -> Iterator[GearFigure]:
        """Go through the figures of a sheet in the order of the work; lines of text are at most `width` mm long."""
        from . import action_view, cutting_view, meshing_view, text

        note, plans = self.contents.note, self.contents.plans
        if note:
            yield Figure("note", lambda scene: note_block(scene.words, note, scene.style, width))
        if GEOMETRY_PART in plans:
            yield Figure("data", text.data_table)
        if MESHING_PART in plans:
            yield meshing_view.FIGURE
            if scene.apart:
                yield meshing_view.NEAR
            yield from (cutting_view.FIGURE, action_view.ACTION_FIGURE)
        if GEOMETRY_PART in plans:
            yield Figure("checks", text.checks_table)
            yield Figure("contour", cutting_view.contour_view)
            yield Figure("rack", cutting_view.rack_view, ("near",))
            for name in text.CALCULATED:
                yield Figure(f"equations_{name}", partial(text.calculations_block, name=name, width=width))
        if SLIDING_PART in plans:
            yield action_view.SLIDING_FIGURE
            yield Figure("points", text.points_table)

    def scales(self, sheet: Format, rungs: Rungs) -> dict[str, Scale]:
        """Return the scale factors of the plans as they are drawn."""
        scene = self.scene(sheet, rungs)
        return {plan: scene.scale(plan) for plan in self.contents.solved.scale_of_plan}

    def on_a_page(self, sheet: Format, last: bool) -> Found | None:
        """Place everything on one page as large as wanted; on the `last` format it is tried with several pages."""
        return None if last else self.placed(sheet, self.wanted, LAYOUTS, any_order=False)

    def on_pages(self, sheet: Format) -> Found:
        """Take one page, with what is beside the meshing smaller where it must be, or several."""
        first = self.fitted(sheet, self._least(sheet))
        last = {ladder: len(self.ladders[ladder]) - 1 for ladder in BESIDE}
        smaller = [
            first | {ladder: min(first[ladder] + steps[ladder], last[ladder]) for ladder in BESIDE} for steps in SMALLER
        ]
        area = 0.0  # of the views at the last of these
        for view, figure in self.sized(sheet, first):
            area += view.size[0] * view.size[1] * (LEAST if {*figure.ladders} & {*BESIDE} else 1.0)
        one = smaller if area < FULL * sheet.width * sheet.height else []
        on_one = (self.placed(sheet, rungs, LAYOUTS, any_order=False) for rungs in one)
        ways = [partial(_on_the_first_page, layout) for layout in FIRST_PAGES]
        on_more = (self._placed(sheet, rungs, way) for way in ways for rungs in smaller)
        found = next(filter(None, chain(on_one, on_more)), None)
        while found is None:  # the first page has less room than the others
            found = self._placed(sheet, first, _in_order)
            if found is None and not self.has_next(first, "mu_l"):
                raise InputError("sheet-too-small", format=sheet.name)
            first = self.lower(first, "mu_l")
        return found

    def _least(self, sheet: Format) -> Rungs:
        """Return the first rungs at which the lines that size the views have room, before any view is drawn."""
        wide, high = room(sheet, self.contents.norm)
        rungs, sizes = dict(self.wanted), self.contents.solved.sizes
        lines = {"mu_l": (sizes["a_w"], high), "near": (2.0 * sizes["p"], wide), "rolled": (sizes["l_N1N2"], wide)}
        for name, (length, most) in lines.items():
            rungs[name] = next((k for k, mu in enumerate(self.ladders[name]) if length / mu < most), 0)
        return rungs

    def _placed(self, sheet: Format, rungs: Rungs, way: Way) -> Found | None:
        views = self.views(sheet, rungs)
        places = way(views, sheet, self.contents.norm)
        return None if places is None else (rungs, views, places)


def _in_order(views: list[View], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Place views on as many pages as they need, the data before or after the meshing."""
    orders = views, sorted(views, key=lambda view: view.name != MESHING)
    found = []
    for order in orders:
        places = arrange([view.size for view in order], sheet, norm, None)
        if places is not None:
            by_name = {view.name: place for view, place in zip(order, places, strict=True)}
            found.append([by_name[view.name] for view in views])
    return min(found, key=pages, default=None)


def _on_the_first_page(layout: Nest, views: list[View], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Place what a layout names in its zones, the rest on following pages."""
    names_there = set(names((layout,)))
    here = [view for view in views if view.name in names_there]
    rest = [view for view in views if view.name not in names_there]
    own = zoned((layout,), here, sheet, norm) if here and rest else None
    others = arrange([view.size for view in rest], sheet, norm, None, first=False) if own is not None else None
    if own is None or others is None:
        return None
    places = iter(own), (replace(place, page=place.page + 1) for place in others)
    return [next(places[view.name not in names_there]) for view in views]
