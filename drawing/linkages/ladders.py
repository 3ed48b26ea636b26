"""The scale factors of a linkage's plans: their ladders, and what every figure takes up at them."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations

from ...plans.board import POSITION, Step
from ...plans.linkages.compound import ACCELERATION, VELOCITY
from ...plans.linkages.mechanism import FRAME, Driver, Prismatic, Revolute
from ...plans.linkages.solved import DRIVER, SolvedLinkage
from ...plans.linkages.structure import TRIAD, Group
from ...plans.names import COUPLE, FORCES, LEVER, is_shown, role, scale_factor
from ...scales.choices import SIZES
from ...scales.errors import InputError
from ...scales.scale import UNITS, Choosers, CrankScale, Fixed, From, Round, Scale, steps
from ..extents import LONGER, Extent, Extents, Ladder, Rungs, Size, visible, ways
from ..formats import FORMATS, Format

ARMS = scale_factor("h")  # of Zhukovsky's lever: what is found as on the velocity plan is drawn larger
# mm, how long figures should be on A1, and the plan of forces on one link; by format, parts of that which they are at
# least and at most, on one page and on several
GOALS = {"l": 280.0, "group": 230.0, "V": 180.0, "a": 180.0, "F": 165.0, "h": 235.0}
ALONE = 115.0
PARTS = {
    "A1": ((0.33, 1.6), (0.25, 1.6)),
    "A2": ((0.3, 1.1), (0.25, 1.3)),
    "A3": ((0.3, 0.9), (0.25, 1.2)),
    "A4": ((0.25, 0.9), (0.25, 1.0)),
}
# moments on the lever of one group that one page holds; times as long plans are at least on one page where groups or
# moments are more: else two pages have larger plans, and room for their letters
FEW, CROWDED = 8, 1.8
# mm, how near points of a plan crowd; parts of its goal by which each pair of them, and all, make it larger
CLOSE_BY, CROWD, LARGER = 15.0, 0.1, 1.5
HUNG = 17.0  # mm that it is for each moment on Zhukovsky's lever: the more hang on it, the longer it is
PROPORTION = 3.2  # times as large as the velocity plan that a task fixes its lever and its forces may be
ROUNDING = 1e-9  # part of a scale factor by which two that are one may differ
ALIKE = 3.0  # times as long as the longest force of another plan, at most, where both are drawn to one scale factor
CRANK = 40.0  # mm, the least length of a crank drawn apart: with twice of it, too, the driver has room on A4
ZERO_LINE, ARC = 1.1, 0.45  # of the crank: how long the line is from which phi is measured, the radius of its arc
MARKS = ("place", "pole", "lay", "back", "chain", "meet", "arc", "divide", "similar", "same")
# mm that letters and the heading add to the lines of a figure, and what it takes at least
MOTION, POLYGON = (25.0, 48.0), (23.0, 48.0)  # plans of motion, and of forces
MECHANISM, GROUP = (40.0, 56.0), (56.0, 90.0)
AROUND_LEVER = (41.0, 70.0), (41.0, 105.0)  # of few moments, and of more
GROUPS = {"RRP": (64.0, 100.0), TRIAD: (62.0, 142.0)}  # beside a slider, about a special point
SPLIT = (150.0, 130.0)  # accelerations of compound motion, which stand on the mechanism
HEADING, WIDER, WIDEST = (72.0, 42.0), (84.0, 42.0), (140.0, 42.0)  # of plans of motion, of forces, of the lever
# a slider, the driver; of insets, for each force that would be a point, of so many at most
APART, CRANKS, INSET, TOGETHER = (66.0, 100.0), ((58.0, 64.0), (82.0, 104.0)), (58.0, 80.0), 8
RATES = frozenset(("velocity", "acceleration"))  # plans beside which nothing stands on the mechanism
SCHEME = (110.0, 80.0)  # mm of a scheme off which lengths are taken
ON_AXIS = 0.3  # tangent of the angle at which a pivot is seen from a slider that runs on its axis to there
STROKE = 1.3  # of the crank, how far a slider may run on both sides
SAME = 0.05  # of the distance within which points crowd: nearer ones share their letters
POINT, ZERO = 0.035, 1e-4  # parts of the longest vector below which another is a point, and is not drawn
# mm^2 of equations and tables: for the structure, a link, a quantity of a plan, the equations of moments of a group,
# a load diagram
STRUCTURE, LINK, DIAGRAM, HEADINGS = 17000.0, 1500.0, 12500.0, 3600.0
TEXTS = {"velocity": 3000.0, "acceleration": 3000.0, "forces": 4200.0, "lever": 1800.0}
TEXTS |= {VELOCITY: 8000.0, ACCELERATION: 8000.0}
MOMENTS = {"RRR": 16000.0, "RPR": 16000.0, TRIAD: 50000.0}


def first_scales(
    solved: SolvedLinkage, choosers: Choosers, plans: Sequence[str], paper: Format | None = None
) -> tuple[Format, dict[str, Scale]]:
    """Return the format and the scale factors by plan, as the sheet has them; on `paper` where that is said."""
    extents = extents_of(solved, choosers, plans)
    for symbol, ladder in extents.ladders.items():
        visible(choosers.get(symbol), symbol, ladder.values[0], _largest(solved, symbol), UNITS[role(symbol).of])
    sheet, rungs, _ = next(ways_of(extents, paper))
    return sheet, by_plan(solved, mus_of(extents, rungs))


def ways_of(extents: Extents, paper: Format | None) -> Iterator[tuple[Format, Rungs, int]]:
    """Go through formats, `paper` alone where that is said, rungs of the scale factors and numbers of pages."""
    return ways(extents, PARTS, [FORMATS[name] for name in SIZES] if paper is None else [paper])


def mus_of(extents: Extents, rungs: Rungs) -> dict[str, float]:
    """Return the scale factors by symbol."""
    return {symbol: extents.mu(symbol, rungs) for symbol in extents.ladders}


def extents_of(solved: SolvedLinkage, choosers: Choosers, plans: Sequence[str]) -> Extents:
    """Return what the figures of a linkage take up, what its texts do, and the ladders of its scale factors."""
    figures = tuple(_figures(solved, plans)) if POSITION in solved.scale_of_plan else ()  # a structure has no extent
    groups = solved.structure.groups
    simple = len(groups) == 1 and len(links_apart(solved, groups[0])) < 2 and len(_on_lever(solved)) <= FEW
    return Extents(figures, _texts(solved, plans), _ladders(solved, choosers, plans), 1.0 if simple else CROWDED)


def scheme_only(plans: Collection[str]) -> bool:
    """Whether the kinematic scheme of a blank is all that is drawn of the mechanism."""
    return {*plans} <= RATES


def scheme_mu(solved: SolvedLinkage, box: Size) -> float:
    """Return the scale factor at which the links fill a box, mm."""
    points = (point for link in solved.mechanism.links for point in link.points)
    places = [solved.point(point) for point in dict.fromkeys((*points, *solved.mechanism.frame_points))]
    sides = (max(of) - min(of) for of in zip(*((at.real, at.imag) for at in places), strict=True))
    return float(max(side / most for side, most in zip(sides, box, strict=True)))


def _ladders(solved: SolvedLinkage, choosers: Choosers, plans: Collection[str]) -> dict[str, Ladder]:
    """Return for each scale factor of the plans its values from the wanted one to ever coarser ones."""

    def value(name: str) -> float:
        item = solved.quantities.get(name)
        size = solved.values.get(name, 0.0) if item is None else item.value or 0.0
        size = longest[name] if name in longest else abs(float(size))
        if not size > 0.0:
            raise InputError("scale-of-zero", quantity=name)
        return size

    own = [ARMS] if LEVER in solved.scale_of_plan else []
    longest = {symbol: _largest(solved, symbol) for symbol in dict.fromkeys([*solved.scale_of_plan.values(), *own])}
    ladders: dict[str, Ladder] = {}
    measured = any(step.verb == "measure" and is_shown(step.name) for step in solved.program)
    for symbol, size in longest.items():
        chooser, kind, finer = choosers.get(symbol), role(symbol).of, tuple[float, ...]()
        if symbol == "mu_l" and chooser is None and scheme_only(plans) and measured:
            values = steps(scheme_mu(solved, SCHEME))[:1]  # lengths are taken off the scheme
        elif chooser is None:  # nobody has chosen: round, and any at all for a plan on which everything is zero
            usual = GOALS[kind] * PARTS["A1"][1][1]
            values = Round(symbol, usual).ladder(value) if size > 0.0 else (1.0,)
            finer = tuple(mu for mu in steps(size / (LONGER * usual) or 1.0) if mu < values[0])
        elif isinstance(chooser, CrankScale):
            values = chooser.ladder(value, ladders["mu_l"].values)
        else:
            values = chooser.ladder(value)
        wanted, values = values[0], (*finer, *values)
        # of what the task or the user has fixed several pages are better than a coarser one
        fixed = isinstance(chooser, Fixed) or (chooser is not None and chooser.firm)
        if not fixed and kind in "hF" and longest.get("mu_V"):  # in proportion to a velocity plan that the task fixes
            rate = ladders["mu_V"]
            finest = rate.values[rate.begin] * (size / longest["mu_V"] if kind == "F" else 1.0) / PROPORTION
            values = tuple(mu for mu in values if mu >= finest * (1.0 - ROUNDING)) or values[-1:]
        visible(chooser, symbol, values[0], size, UNITS[kind], on_paper=False)  # a sheet says what fits on it
        ladders[symbol] = Ladder(
            values,
            root="mu_l" if isinstance(chooser, CrankScale) else "",
            fixed=fixed,
            chosen=chooser is not None and not isinstance(chooser, From),
            begin=ladders["mu_l"].begin if isinstance(chooser, CrankScale) else sum(mu < wanted for mu in values[:-1]),
        )
    forces = [s for s in ladders if role(s).of == "F" and s not in choosers and longest[s] > 0.0]
    if forces:  # nearly as long as one another, they are drawn to one scale factor
        root = max(forces, key=lambda s: longest[s])
        alike = [s for s in forces if s != root and longest[root] <= ALIKE * longest[s]]
        ladders |= {s: replace(ladders[s], values=ladders[root].values, root=root) for s in alike}
    return ladders


def _on_lever(solved: SolvedLinkage) -> list[Step]:
    """Return the moments on Zhukovsky's lever."""
    return [step for step in solved.program.which(("moment",)) if role(step.operands[2]).plan == LEVER]


def _figures(solved: SolvedLinkage, plans: Sequence[str]) -> Iterator[Extent]:
    """Go through the figures that scale factors size."""
    symbols, whole, slots = solved.scale_of_plan, _mechanism(solved), _slots(solved)
    if POSITION in plans or "structure" in plans:
        yield Extent("mu_l", whole, MECHANISM, goal=GOALS["l"])
    for plan in ("velocity", "acceleration"):
        if plan in plans:
            yield from _plan(solved, plan)
    if "compound" in plans:
        yield Extent("mu_l", whole, GROUP)
        yield from (
            Extent(symbols[p], _around(marks_on(solved, p)), SPLIT, goal=GOALS["a"])
            for p in symbols
            if role(p).kind == ACCELERATION
        )
    if "forces" in plans:
        for group in solved.structure.groups:
            links = [link for link in solved.mechanism.links if link.number in group.links]
            places = [solved.point(point) for link in links for point in link.points]
            places += [place for link in links for place in slots.get(link.number, ())]
            size = _around([*places, *_special_points(solved, group.links)])
            yield Extent("mu_l", size, GROUPS.get(group.kind, GROUP), goal=GOALS["group"])
            for n in links_apart(solved, group):  # a yoke is as long as its slot, which its block goes through twice
                own = [*(solved.point(p) for p in solved.mechanism.link(n).points), *slots.get(n, ())]
                yield Extent("mu_l", _around(own), APART)
        for plan in (plan for plan in symbols if role(plan).kind == FORCES):
            yield from _plan(solved, plan)
        driver = [*solved.mechanism.link(solved.structure.driver).points]
        yield Extent("mu_l", _around([solved.point(point) for point in driver]), *CRANKS)
    if "lever" in plans:
        around = AROUND_LEVER[len(_on_lever(solved)) > FEW]
        goal = max(GOALS["h"], HUNG * len(_on_lever(solved)))
        yield Extent(ARMS, _around([*_images(solved), *_feet(solved)]), around, WIDEST, goal)


def _plan(solved: SolvedLinkage, plan: str) -> Iterator[Extent]:
    """Return the figure of a plan, and insets for the forces in it that would be points."""
    symbol, forces = solved.scale_of_plan[plan], role(plan).kind == FORCES
    around, least = (POLYGON, WIDER) if forces else (MOTION, HEADING)
    alone = forces and plan not in {f"{FORCES}_{group.name}" for group in solved.structure.groups}
    goal, marks = ALONE if alone else GOALS[role(symbol).of], marks_on(solved, plan)
    if not forces:
        goal *= min(LARGER, 1.0 + CROWD * _close_by(marks, CLOSE_BY * _largest(solved, symbol) / goal))
    yield Extent(symbol, _around(marks), around, least, goal)
    shown = {name for name in solved.quantities if solved.shown_on.get(name) == plan}
    hung = {step.operands[1] for step in solved.program.on(plan) if step.verb == "chain"}  # those of another plan, too
    sizes = [solved.size(name) for name in shown | hung]
    points = sum(ZERO * max(sizes) < size < POINT * max(sizes) for size in sizes)
    if forces and points > 1:
        yield Extent("", (0.0, 0.0), (min(points, TOGETHER) * INSET[0], INSET[1]))


def _close_by(places: Sequence[complex], distance: float) -> int:
    """Return how many pairs of places are nearer to one another than a distance, but not in one place."""
    return sum(SAME * distance < abs(a - b) < distance for a, b in combinations(places, 2))


def _texts(solved: SolvedLinkage, plans: Sequence[str]) -> float:
    """Return what equations and tables take, mm^2 on A1."""
    area = STRUCTURE + LINK * len(solved.mechanism.links) if "structure" in plans else 0.0
    shown = (role(solved.shown_on.get(name, "")) for name in solved.quantities)
    count = Counter(plan.kind or plan for plan in shown)
    for plan in ("velocity", "acceleration", VELOCITY, ACCELERATION):
        area += TEXTS[plan] * count[plan] + HEADINGS * (count[plan] > 0)
    for plan in {"forces", "lever"} & {*plans}:
        area += TEXTS[plan] * count[plan] + 2.0 * HEADINGS
    if "forces" in plans:
        area += DIAGRAM * len(solved.mechanism.diagrams)
        area += sum(MOMENTS.get(group.kind, 0.0) for group in solved.structure.groups)
    return area


def _mechanism(solved: SolvedLinkage) -> Size:
    places = [solved.point(point) for link in solved.mechanism.links for point in link.points]
    places += [place for ends in _slots(solved).values() for place in ends]
    places += _special_points(solved, [link.number for link in solved.mechanism.links])
    places += _axes(solved)
    if isinstance(driver := solved.mechanism.driver, Driver):  # the direction from which phi is measured, and its arc
        o, phi = solved.point(driver.pivot), math.remainder(solved.values[driver.angle], 2.0 * math.pi)
        quarters = range(math.floor(2.0 * (phi % (2.0 * math.pi)) / math.pi) + 1)
        places += [o + ZERO_LINE * _crank(solved), *(o + ARC * _crank(solved) * 1j**k for k in quarters)]
    return _around(places)


def _special_points(solved: SolvedLinkage, links: Collection[int]) -> list[complex]:
    """Return the special points of groups that are drawn with these links: they may lie far from all joints."""
    meets = (step.name for step in solved.program.on(POSITION) if step.verb == "meet")
    return [solved.point(name) for name in meets if not role(name).hidden and {*role(name).links} & {*links}]


def _axes(solved: SolvedLinkage) -> list[complex]:
    """Return the ends of the axes of the frame's guides: pivots near them, else as far as sliders may run."""
    ends: list[complex] = []
    for pair in solved.mechanism.pairs:
        if isinstance(pair, Prismatic) and pair.links[1] == FRAME:
            at, along = solved.point(pair.point), solved.point(solved.guide_name(pair))
            feet = ((solved.point(point) - at) / along for point in solved.mechanism.frame_points)
            near = [foot.real for foot in feet if abs(foot.imag) < ON_AXIS * abs(foot.real)]
            ends += [at + way * along for way in near[:1] or (-STROKE * _crank(solved), STROKE * _crank(solved))]
    return ends


def _slots(solved: SolvedLinkage) -> dict[int, list[complex]]:
    """Return by the moving links on which sliders run where their ways may end: as long as a crank drives them.

    That of a link that only slides is as far on both sides of the crank's pivot.
    """
    ends: dict[int, list[complex]] = {}
    driver, pairs = solved.mechanism.driver, solved.mechanism.pairs
    for pair in pairs:
        if isinstance(pair, Prismatic) and (number := pair.links[1]) != FRAME:
            at, along = solved.point(pair.point), solved.point(solved.guide_name(pair))
            turns = any(isinstance(other, Revolute) and number in other.links for other in pairs)
            if isinstance(driver, Driver) and not turns:
                at += along * ((solved.point(driver.pivot) - at) * along.conjugate()).real
            ends.setdefault(number, []).extend(at + side * _crank(solved) * along for side in (-1.0, 1.0))
    return ends


def _crank(solved: SolvedLinkage) -> float:
    """Return the length of the crank that drives, or zero."""
    driver = solved.mechanism.driver
    return abs(solved.point(driver.point) - solved.point(driver.pivot)) if isinstance(driver, Driver) else 0.0


def marks_on(solved: SolvedLinkage, plan: str) -> list[complex]:
    """Return the places of the marks of a plan, but of an instant centre: where it is far its figure says so."""
    drawn = (step.name for step in solved.program.on(plan) if step.verb in MARKS)
    return [solved.point(name) for name in drawn if not role(name).hidden and role(name).kind != "P"]


def _images(solved: SolvedLinkage) -> list[complex]:
    """Return the corners of the lever: the ends of the velocity plan of all lettered points, and its pole, turned."""
    points = (f"velocity.{point}" for link in solved.mechanism.links for point in link.points)
    ends = [*marks_on(solved, "velocity"), *(solved.point(point) for point in points if point in solved.values)]
    return [end * 1j for end in ends]


def _feet(solved: SolvedLinkage) -> Iterator[complex]:
    """Go through the feet of arms on the lever; of many the arm of a couple is the line between its forces."""
    steps = _on_lever(solved)
    drawn = (step for step in steps if len(steps) <= FEW or role(step.operands[0]).part != COUPLE)
    for force, mark, pole in (step.operands[:3] for step in drawn):
        along, at, about = map(solved.point, (force, mark, pole))
        if along:
            yield at + along * ((about - at) / along).real


def _around(places: Sequence[complex]) -> Size:
    across, up = [z.real for z in places] or [0.0], [z.imag for z in places] or [0.0]
    return max(across) - min(across), max(up) - min(up)


def links_apart(solved: SolvedLinkage, group: Group) -> tuple[int, ...]:
    """Return the sliders of a group that have figures of their own: those with plans, or else that of a rod beside one.

    None has, where no link of the group has a plan of its own.
    """
    pairs = (pair for pair in (*group.inner, *group.outer) if isinstance(pair, Prismatic))
    sliding = {number for pair in pairs for number in pair.links if number in group.links}
    alone = {number for number in group.links if f"forces_{number}" in solved.scale_of_plan}
    shown = sliding & alone or (sliding if alone else set())
    return tuple(number for number in group.links if number in shown)


def _largest(solved: SolvedLinkage, symbol: str) -> float:
    """Return the largest quantity on the plans of a scale factor, the size of the mechanism on its own plan."""
    plans, shown = solved.scale_of_plan, solved.shown_on
    if symbol == ARMS:  # of the whole velocity plan, turned
        return math.hypot(*_around(_images(solved)))
    if symbol == plans[POSITION]:  # on which all lengths are
        return solved.extent
    on = {name: POSITION if role(name).kind == "l" else shown.get(name, "") for name in solved.quantities}
    drawn = (q.value or 0.0 for name, q in solved.quantities.items() if plans.get(on[name]) == symbol)
    return max(map(abs, drawn), default=0.0)


def by_plan(solved: SolvedLinkage, mus: Mapping[str, float]) -> dict[str, Scale]:
    """Return the scale factors of the plans from their values by symbol."""
    plans = solved.scale_of_plan.items()
    scales = {plan: Scale(symbol, mus[symbol], UNITS[role(symbol).of]) for plan, symbol in plans}
    if LEVER in scales:
        scales[LEVER] = Scale(ARMS, mus[ARMS], UNITS[role(ARMS).of])
    if POSITION not in scales:  # of a structure alone nothing is drawn to scale
        return scales
    scale, crank = scales[POSITION], _crank(solved)
    scales[DRIVER] = scale
    if 0.0 < crank < CRANK * scale.mu:  # short on the plan: drawn apart, it is larger
        finer = [mu for mu in steps(crank / CRANK / 10.0) if mu <= crank / CRANK]
        scales[DRIVER] = Scale(solved.scale_of_figure[DRIVER], finer[-1], scale.unit)
    return scales
