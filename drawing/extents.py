"""Format and scale factors from what figures take up, before anything is drawn: one rule for `solve` and for the sheet.

A subject says of each of its figures how large it is in the unit of its scale factor and how many millimetres letters
and heading add, and how many square millimetres equations and tables take. Then the smallest format is taken of which
one sheet can hold everything, and scale factors at which it can: as long as the estimate is too large, plans become
coarser by steps of the customary series, so that all stay as near to their goals as they can. The largest format has
as many pages as it takes.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import TypeAlias

from ..scales.choices import SIZES
from ..scales.errors import InputError
from ..scales.scale import Chooser, Scale
from .formats import FORMATS, GAPS, Format, Norm, printable, room, usable

NORMS: tuple[Norm, ...] = ("gost", "iso")
# parts of a page that estimates may cover, since views leave gaps: of the only page, of each of two, of more
FILL, TWO, SHARED = 0.88, 0.84, 0.72
ALONE = 0.865  # of the only page, with the least segments: else two pages have larger plans
FIXED = 0.90  # of any page where all plans are fixed, and none can become smaller
# of these, and of the least segments, where what is drawn takes more pages than that
SHARES = (1.0, 0.95, 0.9, 0.85, 0.8, 0.7, 0.6)
SMALLER = {"A1": 1.0, "A2": 1.0, "A3": 0.7, "A4": 0.65}  # what letters take, in what they take on the largest format
# estimates of two pages, in pages, at which the second one is half empty, and the least at which it surely is not; how
# long plans are at most, in parts of what is most for them else, where they are larger for its sake
EMPTY, WHOLE, LONGER = (1.34, 1.54), 1.58, 1.15
BLOCK = 12000.0  # mm^2 of a page that its title block takes
SHORTEST = 1.0  # mm, the least that the longest segment of a plan may be
CHOSEN = 1e6  # times as much as what is off its goal a step counts that the task has chosen
OVER = 0.5  # times as much as what is smaller counts what is larger than its goal
MOST = 100  # pages that there may be
# parts of the width and of the height of a page that one figure may take, so that others find room beside it
ONE = {"A1": 0.8, "A2": 0.85, "A3": 1.0, "A4": 1.0}
Size: TypeAlias = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Extent:
    """What a figure takes up: its `size` in the unit of its scale factor, and millimetres on A1 `around` it.

    It takes at least `least`, mm. Its longer side should be `goal` mm long on paper; one without is as long as it is.
    """

    symbol: str
    size: Size
    around: Size
    least: Size = (0.0, 0.0)
    goal: float = 0.0

    def on_paper(self, mu: float, letters: float) -> Size:
        """Return width and height in mm; `letters` is how large letters are, A1 being 1."""
        wide, high = (s / mu + letters * a for s, a in zip(self.size, self.around, strict=True))
        return max(wide, letters * self.least[0]), max(high, letters * self.least[1])


def visible(
    chooser: Chooser | None, symbol: str, mu: float, largest: float, unit: str, *, on_paper: bool = True
) -> None:
    """Refuse a scale factor that a user has fixed and at which the `largest` quantity, in SI `unit`s, is a point.

    So is one at which it is longer than any sheet from corner to corner, unless whether it is `on_paper` is told later.
    """
    if chooser is None or not chooser.firm:
        return
    not_a_point(symbol, mu, largest, unit)
    if on_paper and largest > math.hypot(FORMATS[SIZES[-1]].width, FORMATS[SIZES[-1]].height) * mu:
        said = {"mu": f"{mu:g}", "unit": Scale(symbol, mu, unit).per_mm_unit, "size": f"{largest / mu:.3g}"}
        raise InputError("plan-too-long", symbol=symbol, **said)


def not_a_point(symbol: str, mu: float, largest: float, unit: str) -> None:
    """Refuse a scale factor at which what it sizes, `largest` in SI `unit`s, is a point.

    Raises InputError: it is shorter than `SHORTEST`.
    """
    if 0.0 < largest < SHORTEST * mu:
        said = {"mu": f"{mu:g}", "unit": Scale(symbol, mu, unit).per_mm_unit, "size": f"{largest / mu:.2g}"}
        raise InputError("plan-too-small", symbol=symbol, **said)


@dataclass(frozen=True, slots=True)
class Ladder:
    """The values that a scale factor may take, the wanted one first; one that is fixed stays.

    What a task has `chosen` becomes smaller after the others. With a `root` it stands on the rung of another one. The
    wanted one may be a later one, `begin`, before which stand finer ones that a page with much room has.
    """

    values: tuple[float, ...]
    root: str = ""
    fixed: bool = False
    chosen: bool = False
    begin: int = 0

    @property
    def free(self) -> bool:
        """Whether it has rungs of its own."""
        return not self.fixed and not self.root


Rungs: TypeAlias = dict[str, int]


@dataclass(frozen=True, slots=True)
class Extents:
    """The figures of a sheet, what its texts take in mm^2 on A1, and the ladders of its scale factors by symbol.

    Where one page would make segments shorter than `alone` times the least, two are taken.
    """

    figures: Sequence[Extent]
    texts: float
    ladders: Mapping[str, Ladder]
    alone: float = 1.0

    def root(self, symbol: str) -> str:
        """Return the scale factor on whose rung this one stands: itself, or that of lengths where V = omega l."""
        return (symbol and self.ladders[symbol].root) or symbol

    def mu(self, symbol: str, rungs: Rungs) -> float:
        """Return a scale factor on its rung."""
        return self.ladders[symbol].values[rungs[self.root(symbol)]] if symbol else 1.0

    def off_goals(self, symbol: str, rung: int) -> list[float]:
        """Return how far figures that a scale factor on this rung sizes are from their goals, as logarithms."""
        own = (f for f in self.figures if f.goal and max(f.size) > 0.0 and self.root(f.symbol) == symbol)
        return [math.log(max(f.size) / (self.mu(f.symbol, {symbol: rung}) * f.goal)) for f in own]

    def part(self, symbol: str, rung: int) -> float:
        """Return how large these figures are on the whole, as a part of their goals, else of the first rung."""
        off, values = self.off_goals(symbol, rung), self.ladders[symbol].values
        return math.exp(sum(off) / len(off)) if off else values[0] / values[rung]


def ways(
    extents: Extents, parts: Mapping[str, tuple[Size, Size]], formats: Sequence[Format]
) -> Iterator[tuple[Format, Rungs, int]]:
    """Go through formats, rungs of all scale factors and numbers of pages, the best first.

    One page is better than several, and of `formats` a smaller one, which come first; only the last may have several
    pages, and plans are made smaller for it. `parts` are, by format, how large figures are at least and at most, as
    parts of their goals: on one page, and on several. The number of pages follows from the estimate alone, whatever
    the language; what is drawn may turn out larger: the next way is a smaller one, below the least where it must be,
    and a page more only where nothing can become smaller.
    """
    *others, sheet = formats
    for less in others:
        (_, most), _ = parts[less.letters]
        rungs = _begun(extents, less, most)
        chosen = (symbol for symbol, ladder in extents.ladders.items() if ladder.chosen and ladder.free)
        # else what the task has chosen has no room
        if not any(rungs[symbol] for symbol in chosen) and _shrunk(extents, rungs, less, FILL * _page(less), math.inf):
            yield less, rungs, 1
    single, several = parts[sheet.letters]
    free, alone = any(ladder.free for ladder in extents.ladders.values()), ALONE * _page(sheet)
    count, fits = 0, False
    while count < MOST:
        (least, most), tried = several if count else (single[0] * extents.alone, single[1]), list[Rungs]()
        count += 1
        if count == 1 and free and not _shrunk(extents, _begun(extents, sheet, most), sheet, alone, least):
            continue
        for share, part in ((share, part) for share in SHARES for part in SHARES if part >= share):
            rungs = _begun(extents, sheet, most)
            room = part * _covered(extents, count) * count * _page(sheet)
            fits |= _shrunk(extents, rungs, sheet, room, share * least)
            if not fits:
                break
            first = fits and not tried and count == 2 and free and sheet.name == SIZES[-1]
            for some in (
                (_filling(extents, rungs, sheet, room, share * least, LONGER * most), rungs) if first else (rungs,)
            ):
                if some not in tried:
                    yield sheet, dict(some), count
                    tried.append(dict(some))
    if not fits:  # no number of pages is enough: what has no room is told when it is drawn
        yield sheet, _begun(extents, sheet, several[1]), MOST


def _begun(extents: Extents, sheet: Format, most: float) -> Rungs:
    """Return the rungs at which figures are so large at most, in parts of their goals, and each has room on a page."""
    rungs = {symbol: ladder.begin for symbol, ladder in extents.ladders.items() if not ladder.root}
    for symbol, ladder in extents.ladders.items():
        while ladder.free and not ladder.chosen and rungs[symbol] + 1 < len(ladder.values):
            if extents.part(symbol, rungs[symbol]) <= 1.0001 * most:
                break
            rungs[symbol] += 1
    for figure in extents.figures:
        symbol = extents.root(figure.symbol)
        while symbol and extents.ladders[symbol].free and rungs[symbol] + 1 < len(extents.ladders[symbol].values):
            if _has_room(extents, figure, rungs, sheet):
                break
            rungs[symbol] += 1
    return rungs


def _has_room(extents: Extents, figure: Extent, rungs: Rungs, sheet: Format) -> bool:
    """Whether a page has room for a figure, whatever its norm, and where printers do not reach the edges."""
    wide, high = (min(sides) for sides in zip(*(room(printable(sheet), norm, True) for norm in NORMS), strict=True))
    w, h = figure.on_paper(extents.mu(figure.symbol, rungs), SMALLER[sheet.letters])
    return bool(w <= ONE[sheet.letters] * wide and h <= ONE[sheet.letters] * high)


def _filling(extents: Extents, rungs: Rungs, sheet: Format, most: float, least: float, longest: float) -> Rungs:
    """Return rungs, a step off these at most, nearest to the goals of which the second of two pages is not half empty.

    All take `most` mm^2, and plans are from the part `least` of their goals, or from all of it where they are smaller
    for the sake of others, to the `longest`. Where no such steps help, or none are needed, these rungs stay.
    """
    texts, page = SMALLER[sheet.letters] ** 1.5 * extents.texts, _page(sheet)
    ways = [(0.0, texts + _area(extents, (f for f in extents.figures if not f.symbol), rungs, sheet), dict[str, int]())]
    for symbol, rung in rungs.items():
        own, ladder = [f for f in extents.figures if extents.root(f.symbol) == symbol], extents.ladders[symbol]
        steps = [(rung, 0.0, _area(extents, own, rungs, sheet))]
        for other in (rung - 1, rung + 1) if own and ladder.free and not ladder.chosen else ():
            part = extents.part(symbol, other) if 0 <= other < len(ladder.values) else 0.0
            if not (least if other < rung else 1.0) <= part <= longest:
                continue
            if all(_has_room(extents, figure, {symbol: other}, sheet) for figure in own):
                off = _off(extents.off_goals(symbol, other)) - _off(extents.off_goals(symbol, rung))
                steps.append((other, off, _area(extents, own, {symbol: other}, sheet)))
        ways = [(off + far, area + wide, {**some, symbol: k}) for off, area, some in ways for k, far, wide in steps]
    if not EMPTY[0] * page < ways[0][1] < EMPTY[1] * page:
        return rungs
    filled = (way for way in ways if EMPTY[1] * page <= way[1] <= most)
    return min(filled, key=lambda way: (way[1] < WHOLE * page, way[0]), default=ways[0])[2]


def _off(far: Iterable[float]) -> float:
    """Return how far figures are from their goals in all, from the logarithms of that."""
    return sum(own**2 * (1.0 if own < 0.0 else OVER) for own in far)


def _covered(extents: Extents, count: int) -> float:
    """Return the part of so many pages that an estimate may cover."""
    if not any(ladder.free for ladder in extents.ladders.values()):
        return FIXED
    return FILL if count == 1 else TWO if count == 2 else SHARED


def _area(extents: Extents, figures: Iterable[Extent], rungs: Rungs, sheet: Format) -> float:
    """Return what figures take with their gaps, mm^2."""
    letters, gap = SMALLER[sheet.letters], GAPS[sheet.letters]
    sizes = (figure.on_paper(extents.mu(figure.symbol, rungs), letters) for figure in figures)
    return sum((wide + gap) * (high + gap) for wide, high in sizes)


def _shrunk(extents: Extents, rungs: Rungs, sheet: Format, most: float, least: float) -> bool:
    """Make plans coarser, down to the part `least` of their goals, until all take `most` mm^2; tell whether they do.

    First what is least off its goal then, by the area that it spares; then one is finer, for which another one gives
    room, if need be, as long as all together are nearer to their goals.
    """
    ladders, letters, begun = extents.ladders, SMALLER[sheet.letters], dict(rungs)
    drawn = {extents.root(figure.symbol) for figure in extents.figures}
    free = [symbol for symbol, ladder in ladders.items() if ladder.free and symbol in drawn]

    @cache
    def area(symbol: str, rung: int) -> float:
        return _area(extents, (f for f in extents.figures if extents.root(f.symbol) == symbol), {symbol: rung}, sheet)

    @cache
    def off(symbol: str, rung: int) -> float:
        """Return how far figures are from their goals; what the task has chosen stays where it can."""
        if ladders[symbol].chosen:
            return CHOSEN * rung
        return _off(extents.off_goals(symbol, rung))

    @cache
    def may(symbol: str, rung: int) -> bool:
        return rung < len(ladders[symbol].values) and extents.part(symbol, rung) >= least

    def step(symbol: str, by: int) -> tuple[float, float]:
        """Return how much farther from its goals, and how much larger a step makes it."""
        was, now = rungs[symbol], rungs[symbol] + by
        return off(symbol, now) - off(symbol, was), area(symbol, now) - area(symbol, was)

    def worse(symbol: str) -> float:
        off, more = step(symbol, 1)
        return off / max(-more, 1.0)

    taken = sum(area(symbol, rungs.get(symbol, 0)) for symbol in {"", *rungs})
    left = most - letters**1.5 * extents.texts
    while taken > left:
        coarser = min((s for s in free if may(s, rungs[s] + 1)), key=worse, default=None)
        if coarser is None:
            return False
        taken += step(coarser, 1)[1]
        rungs[coarser] += 1
    while True:
        ups = [("", 0.0, 0.0), *((s, *step(s, -1)) for s in free if rungs[s] > begun[s])]
        downs = [("", 0.0, 0.0), *((s, *step(s, 1)) for s in free if may(s, rungs[s] + 1))]
        ways = ((a + b, up, down, x + y) for up, a, x in ups for down, b, y in downs if up != down)
        gain, up, down, more = min((way for way in ways if taken + way[3] <= left), default=(0.0, "", "", 0.0))
        if gain > -1e-9:
            return True
        rungs |= {s: rungs[s] + by for s, by in ((up, -1), (down, 1)) if s}
        taken += more


def _page(sheet: Format) -> float:
    x0, y0, x1, y1 = usable(printable(sheet), "gost")
    return (x1 - x0) * (y1 - y0) - BLOCK


def smallest(areas: Iterable[float]) -> Format:
    """Return the smallest format of which one page can hold drawings that take so many mm^2 on A1 in all."""
    area = sum(areas)
    names = (name for name in SIZES if SMALLER[name] ** 1.5 * area <= FILL * _page(FORMATS[name]))
    return FORMATS[next(names, SIZES[-1])]


def from_format(sheet: Format) -> list[Format]:
    """Return a format and the larger ones."""
    return [FORMATS[name] for name in SIZES[SIZES.index(sheet.letters) :]]
