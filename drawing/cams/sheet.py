"""The sheet of a cam: the smallest format of which one sheet holds everything, or several pages of a given one."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import product

from ...plans.cams.cam import DIAGRAMS_PART, PLATE, PRESSURE_PART, PROFILE_PART, ROCKER, ROLLER, SIZES_PART
from ...plans.cams.solve import EQUAL, SolvedCam, reduced
from ...scales.scale import Choosers, Fixed, From, Scale, rounded, steps
from ..extents import Rungs, not_a_point, smallest, visible
from ..figure import Figure, Fitting, Found, SheetContents, may_fit
from ..formats import STYLES, Format, room
from .scene import CamScene, lettered

GIVING = ("mu_l", "reduction", *EQUAL)  # what may be drawn smaller for the sake of one page
RUNGS = 2  # by how many rungs
# mm of the least radius and the stroke on a plan, so that it can be read: on S over ds/dphi more numbers stand closely
LEGIBLE = {"mu_s_ds": 60.0, "mu_s_d2s": 50.0}
REDUCTIONS = (1.0, 0.8, 0.5, 0.4, 0.25, 0.2, 0.1)  # of the lengths that the task has on the diagrams
NARROW = 0.65  # part of the width of lines that those on the sizes of a cam may have
MU_L = 0.001  # m/mm, M 1:1
SMALL = 0.030  # m, the least radius below which a cam is drawn at M 2:1 where nothing is said
COARSER = (1.0, 2.0, 2.5, 4.0, 5.0, 8.0, 10.0, 20.0, 25.0)  # of a plan with equal scale factors, in the finest one
FINER = (0.5, 0.4, 0.25, 0.2, 0.1)  # the same of one that would be too small
LEAST = 60.0  # mm of the least radius and the stroke on such a plan, where there is room
LARGEST = 150.0  # mm of the least radius and the stroke on a plan, where nothing is said
DIGITS = 5  # of a scale factor that is chosen, not found
AREAS = {DIAGRAMS_PART: 2.3e5, SIZES_PART: 9e4, PROFILE_PART: 9e4, PRESSURE_PART: 1.5e4}  # mm^2 of A1, with texts
RADII = {"mu_s_ds": "r_0", "mu_s_d2s": "r_0_flat"}  # least radii that plans with equal scale factors show
SYMBOLS = ("mu_l", *EQUAL)  # what may be chosen: the others follow from the drawn amplitude and the pole distances


def _ladder(solved: SolvedCam, choosers: Choosers, symbol: str) -> tuple[float, ...]:
    """Return the scale factors of `symbol`, one of `SYMBOLS`, the one wanted first.

    A plan that is made of two diagrams is drawn to the scale factor of one of them, or to a multiple of it.
    """
    across, chooser = _size_of(solved, symbol), choosers.get(symbol)
    if chooser is not None and symbol in solved.scale_of_plan.values():
        visible(chooser, symbol, chooser.ladder(lambda _: across)[0], across, "m")
    if symbol not in EQUAL:
        # M 2:1 of a small cam, else M 1:1 or less
        radii = (solved.values[name] for name in RADII.values() if name in solved.values)
        usual = max(MU_L / 2.0 if max(radii, default=SMALL) < SMALL else MU_L, steps(across / LARGEST)[0])
        return (chooser or From(usual)).ladder(lambda _: 2.0 * across)
    if chooser is not None:
        return chooser.ladder(lambda _: across)
    finest = float(solved.values[EQUAL[symbol]]) if EQUAL[symbol] in solved.values else MU_L
    rungs = [rounded(finest * times, DIGITS) for times in COARSER]
    if across < LEAST * finest:  # of diagrams that are drawn smaller
        finer = (rounded(finest * times, DIGITS) for times in FINER)
        rungs.insert(0, next((mu for mu in finer if across >= LEAST * mu), rungs[0]))
    return tuple(mu for mu in rungs if across <= LARGEST * mu) or (steps(across / LARGEST)[0],)


def first_scales(solved: SolvedCam, choosers: Choosers, plans: Sequence[str]) -> tuple[Format, dict[str, Scale]]:
    """Return the format and the scale factors by plan: those of the diagrams follow from the construction."""
    if "mu_phi" in solved.givens:
        not_a_point("mu_phi", solved.givens["mu_phi"], math.tau, "rad")
    values = {**solved.values, **{symbol: rungs[0] for symbol, rungs in _chosen(solved, choosers).items()}}
    scales = {plan: Scale(symbol, float(values[symbol]), "m") for plan, symbol in solved.scale_of_plan.items()}
    return smallest(AREAS[plan] for plan in plans), scales


def _size_of(solved: SolvedCam, symbol: str) -> float:
    """Return the largest size that plans of a scale factor show, m: to the cam's centre from the follower's top."""
    names = (RADII[symbol],) if symbol in RADII else RADII.values()
    sizes = [float(solved.values[name]) + solved.motion.h for name in names if name in solved.values]
    if solved.layout.rocks:
        sizes = [solved.values["l_OC"]] if symbol == "mu_l" and solved.rocker is not None else []
    return max(sizes, default=MU_L)


class CamFitting(Fitting[SolvedCam, CamScene]):
    """Draws what the sheet of a cam shows: its diagrams may be reduced, and with them the plans made of them."""

    first_scales = staticmethod(first_scales)

    def __init__(self, contents: SheetContents[SolvedCam]) -> None:
        self._scenes: dict[tuple[str, tuple[int, ...]], CamScene] = {}
        ladders = {"reduction": REDUCTIONS, **_chosen(contents.solved, contents.choosers)}
        super().__init__(contents, lettered(contents.words), ladders)

    def scene(self, sheet: Format, rungs: Rungs) -> CamScene:
        """Return the scene of a sheet on a format: of the construction with lengths as they are drawn there."""
        key, contents = (sheet.letters, tuple(rungs.values())), self.contents
        if key not in self._scenes:
            part = self.part(rungs)
            solved = reduced(contents.solved, part)
            # coarser diagrams leave no fewer rungs to the plans made of them
            chosen = _chosen(solved, contents.choosers)
            mus = {symbol: values[rungs[symbol]] for symbol, values in chosen.items()}
            self._scenes[key] = CamScene(solved, self.words, STYLES[sheet.letters], contents.givens, mus, part)
        return self._scenes[key]

    def figures(self, scene: CamScene, width: float) -> Iterator[Figure[CamScene]]:
        """Go through the figures of a sheet in the order of the work; lines of text are at most `width` mm long."""
        from . import diagrams_view, profile_view, sizes_view, text

        solved, narrow = self.contents.solved, NARROW * width
        plans = self.contents.plans
        drawn = DIAGRAMS_PART in plans
        followers = [follower for follower in (ROLLER, ROCKER, PLATE) if getattr(solved, follower)]
        wide = {PLATE: width}
        equations = {
            own: Figure(
                f"equations_{own}",
                partial(text.sizes_block, follower=own, width=wide.get(own, narrow)),
                about=sizes_view.FIGURES[own].name,
            )
            for own in (followers if SIZES_PART in plans else ())
        }
        if drawn:
            yield diagrams_view.DIAGRAMS_FIGURE
        for follower in followers if PROFILE_PART in plans else ():
            yield replace(profile_view.FIGURES[follower], about=sizes_view.FIGURES[follower].name)
        yield from (sizes_view.FIGURES[own] for own in equations if own != PLATE)
        yield from (figure for own, figure in equations.items() if own == PLATE)
        if drawn:
            yield Figure("motion", text.motion_table, about=DIAGRAMS_PART)
        yield from (figure for own, figure in equations.items() if own != PLATE)
        if drawn:
            yield Figure("givens", partial(text.data_table, stated=self.stated), about=DIAGRAMS_PART)
            yield Figure("choices", partial(text.choices_block, width=narrow), ("reduction",), about=DIAGRAMS_PART)
        if PRESSURE_PART in plans and solved.rolling is not None:
            yield diagrams_view.PRESSURE_FIGURE
        yield from (sizes_view.FIGURES[own] for own in equations if own == PLATE)
        if drawn:
            scales = partial(text.scales_block, width=width)
            yield Figure("equations_scales", scales, ("reduction",), about=DIAGRAMS_PART)

    def part(self, rungs: Rungs) -> float:
        """Return what a millimetre of the task's diagrams is on the sheet."""
        return REDUCTIONS[rungs["reduction"]]

    def enlarged(self, sheet: Format, rungs: Rungs, first: bool) -> Rungs:
        """Return rungs at which plans made of two diagrams are as large as a page has room for; these are small now."""
        wide, high = room(sheet, self.contents.norm, first)
        for name in EQUAL:
            for rung in range(rungs[name]):
                larger = rungs | {name: rung}
                sizes = [view.size for view, figure in self.sized(sheet, larger) if name in figure.ladders]
                if all(own[0] <= wide and own[1] <= high for own in sizes):
                    rungs = larger
                    break
        return rungs

    def on_a_page(self, sheet: Format, last: bool) -> Found | None:
        """Try one page as large as wanted, then with plans and, on the `last` format, diagrams and profiles smaller."""
        wanted, *smaller = self._ways(last)
        found = self.placed(sheet, wanted)
        if found is None and last:
            self.refuse_smaller(sheet)
        if found is not None or not smaller or not may_fit(self.views(sheet, smaller[-1]), sheet):
            return found
        tried = (self.placed(sheet, rungs) for rungs in smaller if self._legible(sheet, rungs))
        return next((page for page in tried if page is not None), None)

    def _ways(self, last: bool) -> list[Rungs]:
        """Return rungs to be tried: first what is least missed gives way, what the task asks for at the end."""
        asked = ["mu_l"] * isinstance(self.contents.choosers.get("mu_l"), Fixed)
        giving = [name for name in GIVING if name not in asked and (last or name in EQUAL)]
        ranges = (range(min(RUNGS + 1, len(self.ladders[name]))) for name in giving)
        ways = (self.wanted | dict(zip(giving, rungs, strict=True)) for rungs in product(*ranges))
        return sorted(ways, key=_missed)

    def _legible(self, sheet: Format, rungs: Rungs) -> bool:
        """Whether no plan made of two diagrams becomes too small to be read for the sake of one page."""
        scene = self.scene(sheet, rungs)
        smaller = (name for name in EQUAL if rungs[name])
        return all(_size_of(scene.solved, name) >= LEGIBLE[name] * scene.mus[name] for name in smaller)


def _chosen(solved: SolvedCam, choosers: Choosers) -> dict[str, tuple[float, ...]]:
    return {symbol: _ladder(solved, choosers, symbol) for symbol in SYMBOLS}


def _missed(rungs: Rungs) -> tuple[int, int]:
    """Return how much is given up at these rungs; of equal losses that of the diagrams is the least."""
    return 3 * (rungs["mu_l"] + rungs["reduction"]) + sum(rungs[name] for name in EQUAL), rungs["mu_l"]
