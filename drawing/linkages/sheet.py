"""The sheet of a linkage: its figures in the order of the work, at the scale factors that follow from its extents."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations, product
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from ...plans.board import POSITION
from ...plans.linkages.chain import hinged
from ...plans.linkages.compound import Coupler
from ...plans.linkages.cycle import slider_runs
from ...plans.linkages.solved import SolvedLinkage
from ...plans.linkages.structure import Group
from ...plans.names import role, scale_factor
from ...plans.quantities import plans_of
from ...scales.choices import SIZES
from ...scales.errors import InputError
from ...scales.scale import UNITS, Fixed, Scale, Segment, steps
from ..compose import (
    GROUP,
    PART,
    PIECES,
    TEXT,
    Drawn,
    Pages,
    arrange,
    begins_of,
    compose,
    in_any_order,
    last,
    on_one_page,
)
from ..extents import Rungs
from ..figure import Figure, SheetContents
from ..formats import FORMATS, STYLES, Format, Norm, printable, room
from ..packing import Placement, Size
from ..page import DATA, STATEMENT, TASK
from ..tables import narrower, paged, part_of, text_block
from ..view import View, numbered
from .calculations.equations import PLANS, kinematics_text
from .calculations.forces import LOADS, WHOLE, equations_heading, force_lines, force_parts, lever_lines
from .calculations.tables import givens_table, results_parts, results_table, structure_lines
from .figures.group import driver_view, group_view, link_view
from .figures.lever import lever_view
from .figures.plan import plan_view
from .figures.scheme import scheme
from .ladders import ARMS, by_plan, extents_of, links_apart, marks_on, mus_of, scheme_only, ways_of
from .reading import lettered
from .scene import Scene

if TYPE_CHECKING:
    from ...plans.linkages.cycle import Cycle

LinkageFigure = Figure[Scene]
# views with which the part of the forces, and then one of its groups, begins
OF_FORCES = ("load_", "equations_forces_loads", "group_", "driver", "lever")

Found = tuple[list[View], Rungs, list[Placement]]
GROUPS_APART = 2  # from so many groups on each plan has equations and tables of its own
TEXT_WIDTH = {"A1": 235.0, "A2": 190.0, "A3": 150.0, "A4": 175.0}
MOST = 2  # texts and tables that may stand beside the statement of a task
NARROWER = 0.85, 0.7, 0.6, 0.5  # of their usual width may texts have that stand beside plans on a page of their own
WRITTEN = 8.0  # mm of a row in which an answer is written by hand
LEAF, COARSER = 2, 4  # pages of a leaf; scale factors that are tried for them
ROUNDS = 2  # of changes that are tried of each plan for the sake of even pages
MUCH = 2.5 + 1e-9  # times as coarse as for its plan alone: rather than more a blank has a page for each plan
SURELY = 0.85  # part of the excess of a view that certainly comes from what is drawn to scale


@dataclass(frozen=True, slots=True)
class Contents(SheetContents[SolvedLinkage]):
    """What the sheet of a linkage shows; its whole cycle, too, where that is wanted."""

    cycle: Cycle | None = None
    dead: Sequence[SolvedLinkage] = ()  # where the working stroke begins, and where it ends
    courses: bool = False  # whether the sheet is that of all positions, each with its plans
    variant: str = ""  # as the statement of a task calls it


def _figures(contents: Contents, width: float) -> Iterator[LinkageFigure]:
    """Go through the figures of a sheet in the order of the work; lines of text are at most `width` long.

    The ladders of a figure are the scale factors that size it; vectors that stand on the mechanism have two.
    """
    solved, plans = contents.solved, contents.plans
    yield from _kinematics(solved, plans, width, contents.dead)
    own, forces = (tuple(kind for kind in part if kind in plans) for part in (PLANS, ("forces", "lever")))
    single = len(solved.structure.groups) < GROUPS_APART and contents.cycle is None  # all tables together
    if not single:
        yield from _results(solved, own)
    if "compound" in plans:
        compound = [*_compound(solved, width)]
        yield from compound
        yield from _results(
            solved, ("compound",), {figure.ladders[0]: figure.name for figure in compound if figure.ladders}
        )
    if contents.cycle is not None:
        # a sheet of one position does not pay for the import
        from .figures.cycle import coupler, diagrams_view, field_view, main_output, positions_view

        yield Figure("positions", partial(positions_view, cycle=contents.cycle), ("mu_l",))
        if main_output(contents.cycle) is not None:
            yield Figure("diagrams", partial(diagrams_view, cycle=contents.cycle))
        if contents.courses:
            yield from _courses(contents.cycle)
        elif (link := coupler(solved)) is not None:
            yield Figure("field", partial(field_view, link=link), ("mu_l",))
    if "forces" in plans:
        yield from _forces(solved, width)
    if "lever" in plans:
        yield Figure("lever", lever_view, (ARMS,))
        lines = partial(lever_lines, with_loads="forces" not in plans)
        yield _text("equations_lever", lines, width, "heading.equations_lever")
    yield from _results(solved, (*own, *forces) if single else forces)


def _courses(cycle: Cycle) -> Iterator[LinkageFigure]:
    """Go through the diagrams of what is found over the cycle, and the plans of all positions."""
    from .figures.course import course_of, course_view, extremes_table, plans_view

    for names in course_of(cycle):
        yield Figure(f"course_{names[0]}", partial(course_view, cycle=cycle, names=names))
    yield Figure("extremes", partial(extremes_table, cycle=cycle))
    for plan in (plan for plan in PLANS if plan in cycle.program.plans):
        yield Figure(f"{plan}_positions", partial(plans_view, cycle=cycle, plan=plan))


def _text(
    name: str, lines: Callable[[Scene], Iterable[tuple[str, ...]]], width: float, heading: str | Callable[[Scene], str]
) -> LinkageFigure:
    """Return lines of text with their heading, or with that of this key."""

    def draw(scene: Scene) -> View:
        said = scene.words[heading] if isinstance(heading, str) else heading(scene)
        return text_block(name, said, [*lines(scene)], scene.style, width)

    return Figure(name, draw)


def _results(
    solved: SolvedLinkage, kinds: Sequence[str], views: Mapping[str, str] = MappingProxyType({})
) -> Iterator[LinkageFigure]:
    """Go through tables, each about the last plan that it was measured on; `views` call it so by its scale factor."""
    plans, order = plans_of(solved.program), solved.program.plans
    for part in (part for part in results_parts(solved) if part.kind in kinds):
        measured = max((plans[name] for name in part.names if name in plans), key=order.index, default="")
        about = views.get(solved.scale_of_plan.get(measured, ""), measured)
        yield Figure(part.name, partial(results_table, part=part), about=about)


def _plan(solved: SolvedLinkage, plan: str) -> LinkageFigure:
    return Figure(plan, partial(plan_view, plan=plan), (solved.scale_of_plan[plan],))


def _kinematics(
    solved: SolvedLinkage, plans: Sequence[str], width: float, dead: Sequence[SolvedLinkage]
) -> Iterator[LinkageFigure]:
    """Go through what is given, the mechanism, its plans, and their equations: for each plan where groups are many."""
    if "structure" in plans:
        yield Figure("givens", givens_table)
        yield _text("structure", structure_lines, width, "heading.structure")
    if "position" in plans or dead:
        yield Figure("position", partial(scheme, dead=dead), ("mu_l",))
    drawn = [plan for plan in PLANS if plan in plans]
    single = len(solved.structure.groups) < GROUPS_APART
    for i, plan in enumerate(drawn):
        yield _plan(solved, plan)
        if single and plan != drawn[-1]:
            continue
        own = drawn if single else [plan]
        about, heading = ("kinematics" if whole else plan for whole in (single, len(own) > 1))
        lines = partial(kinematics_text, plans=own, before=() if single else drawn[:i])
        yield _text(f"equations_{about}", lines, width, f"heading.equations_{heading}")


def _compound(solved: SolvedLinkage, width: float) -> Iterator[LinkageFigure]:
    # a sheet without compound motion does not pay for the imports
    from .figures.compound import ACCELERATIONS, VELOCITIES, acceleration_figure, velocity_figure
    from .steps import block_name, compound_lines

    couplers = hinged(solved.mechanism, solved.structure)

    def text(coupler: Coupler, kind: str) -> LinkageFigure:
        def heading(scene: Scene) -> str:
            return scene.words[f"heading.equations_compound_{kind}"].format(link=scene.link_name(coupler.number))

        lines = partial(compound_lines, c=coupler, kind=kind)
        return _text(block_name(coupler, kind), lines, width, heading)

    if couplers:
        yield Figure(VELOCITIES, partial(velocity_figure, couplers=couplers), ("mu_V", "mu_l"))
    yield from (text(coupler, "V") for coupler in couplers)
    for coupler in couplers:
        for point, letter in coupler.letters.items():
            draw = partial(acceleration_figure, coupler=coupler, point=point)
            yield Figure(f"{ACCELERATIONS}{letter}", draw, (scale_factor("a", letter), "mu_l"))
        yield text(coupler, "a")


def _forces(solved: SolvedLinkage, width: float) -> Iterator[LinkageFigure]:
    """Go through the force plans from the last group to the driver, with their equations.

    These are one text after the figures of the only group, or one for each group after its own.
    """
    if solved.mechanism.diagrams:
        from .figures.cycle import load_diagram

        yield from (Figure(f"load_{d.name}", partial(load_diagram, diagram=d)) for d in solved.mechanism.diagrams)

    def equations(*parts: str) -> Iterator[LinkageFigure]:
        for part in (part for part in force_parts(solved) if part in parts):
            name = f"equations_forces_{part}" if part else "equations_forces"
            yield _text(name, partial(force_lines, part=part), width, partial(equations_heading, part=part))

    yield from equations(LOADS)
    for group in reversed(solved.structure.groups):
        yield from _group(solved, group)
        yield from equations(group.name)
    yield from equations(WHOLE)
    driver = str(solved.structure.driver)
    yield Figure("driver", driver_view, ("mu_l",))
    yield _plan(solved, f"forces_{driver}")
    yield from equations(driver)


def _group(solved: SolvedLinkage, group: Group) -> Iterator[LinkageFigure]:
    """Go through a group, its plans of forces in the order of construction, and its sliders apart.

    A slider whose plan the construction draws stands before it; that of a rod beside it stands after the plans.
    """
    sliders = {
        f"forces_{n}": Figure(f"link_{n}", partial(link_view, group=group, number=n), ("mu_l",))
        for n in links_apart(solved, group)
    }
    own = {f"forces_{n}" for n in (group.name, *group.links)}
    yield Figure(f"group_{group.name}", partial(group_view, group=group), ("mu_l",))
    for plan in sorted(own.intersection(solved.scale_of_plan), key=solved.program.plans.index):
        if plan in sliders:
            yield sliders.pop(plan)
        yield _plan(solved, plan)
    yield from sliders.values()


def draw(contents: Contents, sheet: Format | None = None) -> Drawn:
    """Draw the sheet at the scale factors that follow from its extents, on `sheet` or on the format that does.

    Where what is drawn takes more pages than was estimated, it becomes smaller, or the format larger; where a view has
    no room on a page of its own, its scale factor becomes coarser.

    Raises InputError: a plan cannot fit at the scale factor that was asked for; it names what would fit.
    """
    fitting, fewest = _Fitting(contents), None
    # on paper of which printers do not reach the edges plans are as large as on the whole of it
    whole = None if sheet is None else FORMATS[sheet.letters]
    if sheet is not None and whole is not None and (blank := _as_blank(contents, whole)) is not None:
        if sheet != whole:
            return _composed(*blank, sheet)
        if (same := _on_pages(fitting, whole, blank[1][1], count=1)) is not None:
            return _composed(fitting, same, sheet)
    for way, rungs, pages in ways_of(fitting.extents, whole):
        if fewest is not None and last(fewest[1][2]) < pages:
            # one page in reading order rather than one in another order, if only the next plans are smaller
            if pages > 1 or on_one_page(*_page(fitting, fewest[1][0], way)) or fewest[0] != way:
                break
            with suppress(InputError):
                found = _on_a_page(fitting, way, rungs, mixed=False)
                fewest = fewest if found is None else (way, found)
            break
        try:
            found = (_on_a_page if pages == 1 else partial(_on_pages, count=pages))(fitting, way, rungs)
        except InputError:
            if sheet is not None or way.name == SIZES[-1]:
                raise
            continue  # a larger format may hold it
        if found is not None and (fewest is None or last(found[2]) < last(fewest[1][2])):
            fewest = way, found
    if fewest is None:
        raise InputError("sheet-too-small", format=way.name)
    way, (views, rungs, places) = fewest
    if whole is None:
        drawn = _composed(fitting, fewest[1], way, smaller=True)
        return drawn if not drawn.short else _composed(fitting, _resized(fitting, way, fewest[1])[0], way, smaller=True)
    if last(places) > 0:
        found, drawn = _resized(fitting, whole, fewest[1])
        if sheet == whole:
            return drawn
        rungs = found[1]
    if sheet is not None and sheet != whole:
        fitting = _Fitting(contents, stated=True)
        stated = _stated(fitting, sheet, rungs)
        if stated is None:
            raise InputError("sheet-too-small", format=sheet.name)
        way, (views, rungs, places) = sheet, stated
    return _composed(fitting, (views, rungs, places), way)


def _composed(fitting: _Fitting, found: Found, sheet: Format, smaller: bool = False) -> Drawn:
    contents, (views, rungs, places) = fitting.contents, found
    goes_on = contents.words["heading.continued"]
    return compose(views, places, fitting.scales(rungs), sheet, contents.norm, goes_on, smaller=smaller)


def _resized(fitting: _Fitting, sheet: Format, found: Found) -> tuple[Found, Drawn]:
    """Draw several pages; where some are too empty one plan after the other is larger or, where none helps, smaller.

    It stays so as long as pages are less empty then, and no more of them.
    """
    drawn = _composed(fitting, found, sheet)
    ladders = fitting.extents.ladders
    # what the task fixes keeps its scale factor where that has room
    own = (
        s for s, ladder in ladders.items() if not ladder.root and (found[1][s] or not (ladder.fixed or ladder.chosen))
    )
    larger = [(symbol, -1) for symbol in own]
    tries = [*larger, *((symbol, 1) for symbol, _ in reversed(larger))]
    turns = iter(tries)  # anew after each that helps
    for _ in range(ROUNDS * len(tries)):
        symbol, step = next(turns, ("", 0))
        if not drawn.short or not symbol:
            break
        rungs = found[1] | {symbol: found[1][symbol] + step}
        if not 0 <= rungs[symbol] < len(ladders[symbol].values):
            continue
        with suppress(InputError):
            other = _on_pages(fitting, sheet, rungs, last(found[2]) + 1)
            if other is not None and other[1] == rungs and last(other[2]) <= last(found[2]):
                again = _composed(fitting, other, sheet)
                if again.short < drawn.short and len(again.sheets) <= len(drawn.sheets):
                    found, drawn, turns = other, again, iter(tries)
    return found, drawn


def _as_blank(contents: Contents, sheet: Format) -> tuple[_Fitting, Found] | None:
    """Place a blank of few plans on a leaf: at the scale factors that `solve` shows, or at the next ones.

    Where a plan would be much smaller than alone there is a page for each. The sheet on the same format has these scale
    factors, too.
    """
    if sheet.letters != SIZES[0] or not {*contents.plans} <= {POSITION, *PLANS} or contents.cycle or contents.dead:
        return None
    fitting = _Fitting(contents, stated=True)
    _, wanted, _ = next(ways_of(fitting.extents, None))
    ladders = fitting.extents.ladders
    plans = {contents.solved.scale_of_plan[plan]: plan for plan in contents.plans}
    alone, steps_of = dict[str, float](), dict[str, Sequence[float]]()
    for symbol in dict.fromkeys(map(fitting.extents.root, plans)):
        if ladders[symbol].free:
            plan = plans.get(symbol, POSITION)
            figure = replace(extents_of(contents.solved, contents.choosers, (plan,)), texts=0.0)
            alone[symbol] = figure.mu(symbol, next(ways_of(figure, None))[1])
            values = ladders[symbol].values[wanted[symbol] :]
            steps_of[symbol] = [mu for k, mu in enumerate(values) if k < COARSER or mu <= MUCH * alone[symbol]]

    def coarser(by: Sequence[int]) -> list[float]:
        return sorted((mus[k] / alone[s] for k, (s, mus) in zip(by, steps_of.items(), strict=True)), reverse=True)

    every = sorted(product(*(range(len(mus)) for mus in steps_of.values())), key=coarser)
    near = [by for by in every if max(coarser(by), default=1.0) <= MUCH]
    # a leaf, or a page for each plan where plans would be much smaller on it, or whatever a leaf can hold
    ways = (near, LEAF, False), (near, LEAF, True), (near, 1 + len(contents.plans), False), (every, LEAF, True)
    for tried, pages, parted in ways:
        for by in tried:
            rungs = wanted | {symbol: wanted[symbol] + k for symbol, k in zip(steps_of, by, strict=True)}
            with suppress(InputError):
                found = _stated(fitting, printable(sheet), rungs, parted)
                if found is not None and last(found[2]) < pages and found[1] == rungs:
                    return fitting, found
    return None


def _on_a_page(fitting: _Fitting, sheet: Format, rungs: Rungs, mixed: bool = True) -> Found | None:
    """Try one page, where its views have no room in reading order `mixed` ones."""
    views, taken = fitting.fitted(sheet, rungs)
    page = _page(fitting, views, sheet)
    places = on_one_page(*page) or (in_any_order(*page) if mixed else None)
    return None if places is None else (views, taken, places)


def _page(fitting: _Fitting, views: Sequence[View], sheet: Format) -> tuple[list[Size], Format, Norm, list[int]]:
    """Return what tells where the views of a page have room."""
    return [view.size for view in views], sheet, fitting.contents.norm, begins_of(views)


def _stated(fitting: _Fitting, sheet: Format, rungs: Rungs, parted: bool = False) -> Found | None:
    """Place the statement of the task before the work: on one page, on two, or on as many as they take.

    Of two the first has the statement, the second one the plans, their tables and as many texts as it has room for,
    which become narrower, if need be. Where that is not enough, and they may be `parted` from their plans, these texts,
    too, stand or begin on the first.
    """
    work, taken = fitting.fitted(sheet, rungs)
    stated = [*fitting.statements(sheet, taken)]
    works = [work] + [
        [narrower(view, part * view.size[0]) if view.lines else view for view in work]
        for part in (NARROWER if any(view.lines for view in work) else ())
    ]
    every = [[*views, *some] for some in works for views in stated]
    begins, norm = begins_of(every[0]), fitting.contents.norm
    ways = [Pages([view.size for view in views], sheet, norm, begins) for views in every]
    order = [*range(len(begins))]
    if (places := on_one_page(ways[0].sizes, sheet, norm, begins)) is not None:
        return every[0], taken, places
    told = [i for i in order[len(STATEMENT) :] if parted and every[0][i].lines]
    texts = [i for i in order[len(STATEMENT) :] if begins[i] == TEXT or i in told]
    beside = (some for count in range(MOST + 1) for some in combinations(texts, count))
    for some, (views, pages) in product(beside, zip(every, ways, strict=True)):
        first = [i for i in order if i < len(STATEMENT) or i in some]
        rest = [i for i in order if i not in first]
        if (own := pages.tried(first, 0)) is not None and (others := pages.tried(rest, 1)) is not None:
            placed = dict(zip((*first, *rest), (*own, *others), strict=True))
            return views, taken, [placed[i] for i in order]
    goes_on = fitting.contents.words["heading.continued"]
    for views, i in product(every[: len(stated)], told):
        for begun in _begun(views, i, goes_on):
            pages, lead = Pages([view.size for view in begun], sheet, norm, begins_of(begun)), len(STATEMENT) + 1
            if (own := pages.tried(range(lead), 0)) is not None:  # as much of it as there is room for
                if (others := pages.tried(range(lead, len(begun)), 1)) is not None:
                    return begun, taken, own + others
                break
    usual = zip(every[: len(stated)], ways, strict=False)
    found = next((views for views, pages in usual if pages.tried(order[:3], 0)), every[len(stated) - 1])
    places = arrange([view.size for view in found], sheet, norm, begins)
    return None if places is None else (found, taken, places)


def _begun(views: Sequence[View], i: int, goes_on: str) -> Iterator[list[View]]:
    """Go through the views with first lines of a text after the statement, the most first, its rest at its place."""
    text, begin = views[i], len(STATEMENT)
    heading = "".join(text.heading)
    for count in range(text.pieces - PIECES, PIECES - 1, -1):
        rest = part_of(text, count, text.pieces, goes_on.format(heading=heading))
        yield [*views[:begin], part_of(text, 0, count, heading), *views[begin:i], rest, *views[i + 1 :]]


def _begins(views: Sequence[View]) -> list[int]:
    """Return for each view what begins with it: the part of the forces, one of its groups, or its own."""
    found, forces = begins_of(views), PART
    for i, view in enumerate(views):
        if view.name.startswith(OF_FORCES):
            found[i], forces = forces, GROUP
    return found


def _on_pages(fitting: _Fitting, sheet: Format, rungs: Rungs, count: int) -> Found | None:
    """Place the views on `count` pages, or on more: forces begin on one of their own where that leaves none half empty.

    They come in reading order, the larger ones smaller if the first page cannot hold them; where a fixed plan is too
    large for it, the first view that it can hold begins.
    """
    norm = fitting.contents.norm

    def placed(views: Sequence[View]) -> list[Placement] | None:
        return arrange([view.size for view in views], sheet, norm, _begins(views), count)

    for first in (False, True):
        try:
            views, taken = fitting.fitted(sheet, rungs, first)
        except InputError:
            if not first:
                raise
            break
        if first and any(taken[s] > rung and fitting.extents.ladders[s].fixed for s, rung in rungs.items()):
            break
        if (places := placed(views)) is not None:
            return views, taken, places
    views, taken = fitting.fitted(sheet, rungs)
    wide, high = room(sheet, norm, first=True)
    begin = next((view for view in views if view.size[0] <= wide and view.size[1] <= high), None)
    views = [begin, *(view for view in views if view is not begin)] if begin is not None else []
    places = placed(views) if views else None
    return None if places is None else (views, taken, places)


class _Fitting:
    """Builds the views of `contents` for any format, each only once; `extents` is what figures take up.

    With `stated` they follow the statement of the task, and tables have rows to be written in.
    """

    def __init__(self, contents: Contents, stated: bool = False) -> None:
        self.contents, self.runs, self.stated = contents, slider_runs(contents.solved), stated
        self.extents = extents_of(contents.solved, contents.choosers, contents.plans)
        self._found: dict[str, dict[Hashable, Any]] = {}  # by format

    def fitted(self, sheet: Format, rungs: Rungs, first: bool = False) -> tuple[list[View], Rungs]:
        """Return views and rungs for pages of `sheet`: these rungs, coarser ones where they must be.

        What is fixed, too, becomes coarser only where a page cannot hold it alone. With `first` all have room even on
        the first page.

        Raises InputError: a view has no room on a page even at the last rung.
        """
        norm = self.contents.norm
        own, printed = room(sheet, norm, first), room(printable(sheet), norm, first)
        rooms = {  # what may be coarser is so on any printer: a handout has the scale factors of the sheet
            symbol: own if ladder.fixed else (min(own[0], printed[0]), min(own[1], printed[1]))
            for symbol, ladder in self.extents.ladders.items()
        }
        rungs = dict(rungs)
        while True:
            built = self.build(sheet, rungs)
            sized = [(s, view, max(view.size[0] / rooms[s][0], view.size[1] / rooms[s][1])) for view, s in built if s]
            too_large = {symbol: (view, excess) for symbol, view, excess in sized if excess > 1.0}
            if not too_large:
                return self._paged([view for view, _ in built], sheet), rungs
            for symbol, (view, excess) in too_large.items():
                rungs[symbol] = self._next(symbol, rungs[symbol], excess)
                if rungs[symbol] >= len(self.extents.ladders[symbol].values):
                    raise self._does_not_fit(sheet, symbol, view.size)

    def _paged(self, views: Sequence[View], sheet: Format) -> list[View]:
        """Return views with their numbers, texts that are higher than a page in parts.

        Raises InputError: what no scale factor makes smaller has no room on a page.
        """
        wide, high = room(sheet, self.contents.norm)
        least = min(high, room(printable(sheet), self.contents.norm)[1])
        goes_on = self.contents.words["heading.continued"]
        parts = [part for view in views for part in paged(view, least, goes_on)]
        if any(part.size[0] > wide or part.size[1] > high for part in parts):
            raise InputError("sheet-too-small", format=sheet.name)
        return numbered(parts)

    def _next(self, symbol: str, rung: int, excess: float) -> int:
        """Return the next rung worth drawing for a view that is `excess` times as large as its room.

        Letters keep their size, so that a view shrinks by less than its scale factor grows; even if they find better
        places, so far off no rung fits. Where none can be right, the last one shows how far off it is.
        """
        ladder = self.extents.ladders[symbol].values
        wanted = ladder[rung] * excess * SURELY
        return next((k for k in range(rung + 1, len(ladder)) if ladder[k] >= wanted), max(rung + 1, len(ladder) - 1))

    def scales(self, rungs: Rungs) -> dict[str, Scale]:
        """Return the scale factors on these rungs, by plan."""
        return by_plan(self.contents.solved, mus_of(self.extents, rungs))

    def build(self, sheet: Format, rungs: Rungs) -> list[tuple[View, str]]:
        """Draw all figures with the scale factors on these rungs; each with the ladder that sizes it, or ""."""
        contents, solved, mus = self.contents, self.contents.solved, mus_of(self.extents, rungs)
        text_width = min(TEXT_WIDTH[sheet.letters], room(printable(sheet), contents.norm)[0])
        words, style = lettered(contents.words, solved), STYLES[sheet.letters]
        style = replace(style, row=WRITTEN) if self.stated else style
        found = self._found.setdefault(sheet.name, {})
        scene = Scene(solved, words, style, contents.givens, self.scales(rungs), self.runs, found=found)
        built = []
        for figure in _figures(contents, text_width):
            if self.stated and figure.name == DATA:
                continue
            # of two scale factors the one with the longer lines makes the figure as large as it is
            symbol = next(iter(figure.ladders), "")
            if len(figure.ladders) > 1:
                symbol = max(figure.ladders, key=lambda s: _reach(solved, s) / mus[s])
            view = scene.once(figure.draw, "figure", figure.name)
            built.append((replace(view, about=figure.about), self.extents.root(symbol)))
        return built

    def statements(self, sheet: Format, rungs: Rungs) -> Iterator[list[View]]:
        """Go through the views of the statement of the task with ever smaller schemes."""
        from .statement import statements  # most sheets have none

        contents = self.contents
        words, style = lettered(contents.words, contents.solved), STYLES[sheet.letters]
        found = self._found.setdefault(f"{sheet.name}, {TASK}", {})
        scene = Scene(contents.solved, words, style, contents.givens, self.scales(rungs), self.runs, found=found)
        width = min(TEXT_WIDTH[sheet.letters], room(sheet, contents.norm)[0])
        other = not scheme_only(contents.plans)  # plans on which groups and the driver stand, too
        scales = dict.fromkeys(
            scale for plan, scale in scene.scales.items() if plan in contents.plans or (other and plan != POSITION)
        )
        fixed = [scale for scale in scales if isinstance(contents.choosers.get(scale.symbol), Fixed | Segment)]
        return statements(scene, contents.plans, contents.variant, width, fixed)

    def _does_not_fit(self, sheet: Format, symbol: str, size: tuple[float, float]) -> InputError:
        """Say which format, or which scale factor, would do."""
        norm, mu = self.contents.norm, self.extents.ladders[symbol].values[-1]
        width, height = room(sheet, norm)
        fits = steps(mu * max(size[0] / width, size[1] / height) * 1.1)[0]
        rooms = {name: room(FORMATS[name], norm) for name in SIZES}
        larger = next((name for name, (w, h) in rooms.items() if w >= size[0] and h >= size[1]), "")
        key = "plan-too-large" if larger else "plan-too-large-everywhere"
        unit = Scale(symbol, mu, UNITS[role(symbol).of])
        said = {"mu": f"{mu:g}", "unit": unit.per_mm_unit, "format": sheet.name}
        return InputError(key, symbol=symbol, fits=f"{fits:g}", larger=larger, **said)


def _reach(solved: SolvedLinkage, symbol: str) -> float:
    """Return the longest distance between marks of the plans that a scale factor sizes, in its own unit."""
    plans = (marks_on(solved, plan) for plan, name in solved.scale_of_plan.items() if name == symbol)
    return max((abs(a - b) for marks in plans for a in marks for b in marks), default=0.0)
