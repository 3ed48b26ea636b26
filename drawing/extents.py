"""Format and scale factors from what figures take up, before anything is drawn: one rule for `solve` and for the sheet.

A subject says of each of its figures how large it is in the unit of its scale factor and how many millimetres letters
and heading add, and how many square millimetres equations and tables take. Then the smallest format is taken of which
one sheet can hold everything, and scale factors at which it can: as long as the estimate is too large, the plan that
takes most room with the longest segments becomes coarser by a step of the customary series. The largest format has as
many pages as it takes.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from ..scales.choices import SIZES
from ..scales.errors import InputError
from ..scales.scale import Chooser, Scale
from .formats import FORMATS, GAPS, Format, Norm, printable, room, usable

NORMS: tuple[Norm, ...] = ("gost", "iso")
# parts of a page that estimates may cover, since views leave gaps: of the only page, of each of two, of more
FILL, TWO, SHARED = 0.88, 0.81, 0.72
ALONE = 0.865  # of the only page, with the least segments: else two pages have larger plans
FIXED = 0.90  # of any page where all plans are fixed, and none can become smaller
# of these, and of the least segments, where what is drawn takes more pages than that
SHARES = (1.0, 0.95, 0.9, 0.85, 0.8, 0.7, 0.6)
SMALLER = {"A1": 1.0, "A2": 1.0, "A3": 0.7, "A4": 0.65}  # what letters take, in what they take on the largest format
BLOCK = 12000.0  # mm^2 of a page that its title block takes
SHORTEST = 1.0  # mm, the least that the longest segment of a plan may be
MOST = 100  # pages that there may be
# parts of the width and of the height of a page that one figure may take, so that others find room beside it
ONE = {"A1": 0.8, "A2": 0.85, "A3": 1.0, "A4": 1.0}
Size: TypeAlias = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Extent:
    """What a figure takes up: its `size` in the unit of its scale factor, and millimetres on A1 `around` it.

    It takes at least `least`, mm.
    """

    symbol: str
    size: Size
    around: Size
    least: Size = (0.0, 0.0)

    def on_paper(self, mu: float, letters: float) -> Size:
        """Return width and height in mm; `letters` is how large letters are, A1 being 1."""
        wide, high = (s / mu + letters * a for s, a in zip(self.size, self.around, strict=True))
        return max(wide, letters * self.least[0]), max(high, letters * self.least[1])


def visible(chooser: Chooser | None, symbol: str, mu: float, largest: float, unit: str) -> None:
    """Refuse a scale factor that a user has fixed and at which the `largest` quantity, in SI `unit`s, is a point."""
    if chooser is not None and chooser.firm:
        not_a_point(symbol, mu, largest, unit)


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

    `longest` is its longest segment in its unit; `weight` is how many times as long as others it may be, `share` how
    many times as long it is at least when there is no room. Before it is shorter than `kept`, mm on A1, others become
    smaller, those first that keep most of it, and what a task has `chosen` does so last. With a `root` it stands on
    the rung of another one.
    """

    values: tuple[float, ...]
    longest: float
    weight: float = 1.0
    share: float = 0.0
    kept: float = 0.0
    root: str = ""
    fixed: bool = False
    chosen: bool = False

    def next(self, rung: int, least: float) -> bool:
        """Whether the plan may be drawn at the rung after this one, its longest segment being `least` mm of paper."""
        return self.free and rung + 1 < len(self.values) and self.longest >= self.share * least * self.values[rung + 1]

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


def ways(
    extents: Extents, segments: Mapping[str, tuple[Size, Size]], formats: Sequence[Format]
) -> Iterator[tuple[Format, Rungs, int]]:
    """Go through formats, rungs of all scale factors and numbers of pages, the best first.

    One page is better than several, and of `formats` a smaller one, which come first; only the last may have several
    pages, and plans are made smaller for it. `segments` are, by format, how long the longest segment of a plan is at
    least and at most, mm: on one page, and on several. The number of pages follows from the estimate alone, whatever
    the language; what is drawn may turn out larger: the next way is a smaller one, below the least where it must be,
    and a page more only where nothing can become smaller.
    """
    *others, sheet = formats
    for less in others:
        (_, most), _ = segments[less.letters]
        rungs = _begun(extents, less, most)
        chosen = (symbol for symbol, ladder in extents.ladders.items() if ladder.chosen and ladder.free)
        # else what the task has chosen has no room
        if not any(rungs[symbol] for symbol in chosen) and _shrunk(extents, rungs, less, FILL * _page(less), math.inf):
            yield less, rungs, 1
    single, several = segments[sheet.letters]
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
            if rungs not in tried:
                yield sheet, dict(rungs), count
                tried.append(dict(rungs))
    if not fits:  # no number of pages is enough: what has no room is told when it is drawn
        yield sheet, _begun(extents, sheet, several[1]), MOST


def _begun(extents: Extents, sheet: Format, longest: float) -> Rungs:
    """Return the rungs at which segments are so long at most and every figure has room on a page."""
    rungs = dict.fromkeys((symbol for symbol, ladder in extents.ladders.items() if not ladder.root), 0)
    for symbol, ladder in extents.ladders.items():
        most = 1.0001 * longest * ladder.weight
        while ladder.free and not ladder.chosen and ladder.longest > most * ladder.values[rungs[symbol]]:
            if rungs[symbol] + 1 == len(ladder.values):
                break
            rungs[symbol] += 1
    # the largest view that a page can hold, whatever its norm, and where printers do not reach the edges
    wide, high = (min(sides) for sides in zip(*(room(printable(sheet), norm, True) for norm in NORMS), strict=True))
    part = ONE[sheet.letters]
    for figure in extents.figures:
        symbol = extents.root(figure.symbol)
        while symbol and extents.ladders[symbol].free and rungs[symbol] + 1 < len(extents.ladders[symbol].values):
            w, h = figure.on_paper(extents.mu(figure.symbol, rungs), SMALLER[sheet.letters])
            if w <= part * wide and h <= part * high:
                break
            rungs[symbol] += 1
    return rungs


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
    """Make long and large plans coarser, down to `least` mm, until all has an area of `most`; tell whether it has.

    What is finer again with the room that is left then is finer.
    """
    ladders, letters = extents.ladders, SMALLER[sheet.letters]
    by_symbol: dict[str, list[Extent]] = {}
    for figure in extents.figures:
        by_symbol.setdefault(extents.root(figure.symbol), []).append(figure)

    def worth(symbol: str) -> tuple[bool, float, float]:
        ladder = ladders[symbol]
        coarser = ladder.values[min(rungs[symbol] + 1, len(ladder.values) - 1)]
        kept = ladder.kept * sheet.width / FORMATS["A1"].width * coarser
        left = min(1.0, ladder.longest / kept) if kept else 1.0  # of the length that it should keep
        long = ladder.longest / extents.mu(symbol, rungs) / ladder.weight
        return not ladder.chosen, left, areas[symbol] * long / ladder.weight

    def area(symbol: str, finer: int = 0) -> float:
        return _area(extents, by_symbol[symbol], rungs | {symbol: rungs[symbol] - finer} if finer else rungs, sheet)

    def fits_finer(symbol: str) -> bool:
        return rungs[symbol] > begun[symbol] and sum(areas.values()) - areas[symbol] + area(symbol, finer=1) <= left

    areas, begun = {symbol: area(symbol) for symbol in by_symbol}, dict(rungs)
    left = most - letters**1.5 * extents.texts
    while sum(areas.values()) > left:
        free = [s for s in by_symbol if s and ladders[s].next(rungs[s], least)]
        if not free:
            return False
        coarser = max(free, key=worth)
        rungs[coarser] += 1
        areas[coarser] = area(coarser)
    while finer := [s for s in rungs if fits_finer(s)]:
        symbol = min(finer, key=worth)
        rungs[symbol] -= 1
        areas[symbol] = area(symbol)
    return True


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
