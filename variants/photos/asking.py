"""What is asked of photographs: whose a page is, which of two counts, where a vector ends that is not sure.

A page goes by a digest of its picture, a file that cannot be read by its name. What is not answered stays as it is: a
page is that of a stranger, a vector is neither right nor wrong.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...drawing.markers import FREE
from ...plans.laws import cross, dot
from ...plans.marking.drawn import MEASURED
from ...plans.marking.ways import Shape as Way
from ...scales.errors import KulmanError
from ..crew import digest_of
from ..marking.marked import Desk, surely
from ..marking.reading import Answers, Ends, stem_of
from ..marking.seen import heading
from ..roster import Roster, Who
from .matching import LONG
from .pictures import PICTURES, Photo, grey_of
from .reading import Flat, Sheets, numbered, on_page, plans_of
from .straight import PER_MM

OUT = "-"  # what is said of a page that is left out
ENTRY = "#"  # begins the place of a student in the roster
SMALL = 900  # pixels of the longer side of a page that is shown whole
GREYS = 16  # of a picture: more of them only show noise
AROUND, LEAST = 15.0, 60.0  # mm shown around a plan; mm of a side
BESIDE = 2.5  # mm beyond their ends at which lines cross
SINE = 0.1  # between lines that cross
SAME = 0.8  # mm between spots that are one
SPOTS = 40
SNAP = 2.0  # mm from a spot that is meant


@dataclass(frozen=True, slots=True)
class Told:
    """What has been answered: whose pages are, by page; of vectors, by page and name, their ends, mm, or none.

    Questions about pages that have been `passed`, by their names, are not asked once more.
    """

    pages: Mapping[str, str] = field(default_factory=dict)
    ends: Mapping[tuple[str, str], Ends | None] = field(default_factory=dict)
    passed: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class PageAsk:
    """A question about pages: `unread`, `whose` they are, `which` of them counts; small pictures of them, if any."""

    kind: str
    pages: tuple[str, ...]
    sources: tuple[str, ...]
    number: int = 0
    who: str = ""
    reason: KulmanError | None = None
    pictures: tuple[bytes, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """What this question about each of its pages is called."""
        return tuple(f"{self.kind} {page}" for page in self.pages)


@dataclass(frozen=True, slots=True)
class EndAsk:
    """A question about a vector of a plan: where it begins and ends, as far as is believed, mm of the page, y up.

    `marks` are the points of the plan that it joins, `places` where they are that are sure; `spots` are ends and
    crossings of lines, `others` vectors of the plan that are sure; `box` is what `picture` shows.
    """

    page: str
    source: str
    who: str
    plan: str
    name: str
    symbol: str
    tail: complex | None
    tip: complex | None
    marks: tuple[int, int]
    spots: tuple[complex, ...]
    others: tuple[Ends, ...]
    box: tuple[float, float, float, float]
    picture: str

    def snapped(self, place: complex) -> complex:
        """Return the spot that is meant by a place, or the place where there is none near it."""
        near = min(self.spots, key=lambda spot: abs(spot - place), default=place)
        return near if abs(near - place) <= SNAP else place


@dataclass(frozen=True, slots=True)
class Asking:
    """All that is asked of what has been handed in, pictures of plans, PNG, by their names; what could not be read."""

    pages: tuple[PageAsk, ...] = ()
    ends: tuple[EndAsk, ...] = ()
    pictures: Mapping[str, bytes] = field(default_factory=dict)
    notes: tuple[KulmanError, ...] = ()


# Whose pages are.


def gathered(
    found: Iterable[Answers], roster: Roster | None, told: Told, alone: bool = False
) -> tuple[list[Answers], list[PageAsk]]:
    """Return answers with the pages of each student together, as far as that is known, and what is asked of pages.

    Of a student who is `alone` all pages are.
    """
    answers, asks, by_who = list[Answers](), list[PageAsk](), dict[str, list[Answers]]()
    known, twice = [*found], set[str]()
    often = Counter(one.source for one in known if one.photos)
    for one in known:
        if one.unread is not None and Path(one.source).suffix.lower() in (*PICTURES, ".pdf"):
            said = told.pages.get(one.source, "")
            if not said and not alone:
                asks.append(PageAsk("unread", (one.source,), (one.source,), reason=one.unread))
            if said != OUT and not alone:
                whose = replace(one, who=_who(said, roster)) if said else one
                by_who.setdefault(_called(whose, roster) or said or one.source, []).append(whose)
            continue
        if not one.photos:
            answers.append(one)
            continue
        pages = {page: photo for photo in one.photos if (page := page_of(photo)) not in twice}
        twice |= {*pages}
        own = tuple(photo for page, photo in pages.items() if told.pages.get(page) != OUT)
        if not own:
            continue
        said = next((who for page in pages if (who := told.pages.get(page, OUT)) != OUT), "")
        if said:
            one = replace(one, who=_who(said, roster))
        name = _called(one, roster) or said
        if roster is None and not said and often[one.source] == 1:
            name = f"{stem_of(one.source)} {one.about.get('sheet', '')}"
        one = replace(one, photos=own)
        if name or alone:
            by_who.setdefault("" if alone else name, []).append(one)
        else:
            small = tuple(map(_small, own[:1]))
            asks.append(PageAsk("whose", (*pages,), (one.source,), own[0].number, pictures=small))
            answers.append(one)
    for several in by_who.values():
        merged, again = _together(several)
        answers += merged
        asks += again
    return [_with(one, told) for one in answers], [one for one in asks if not told.passed.issuperset(one.names)]


def page_of(photo: Photo) -> str:
    """Return what a page goes by."""
    return digest_of(photo.picture)[:24]


def _called(answers: Answers, roster: Roster | None) -> str:
    """Return the place in the roster of a student, where there is one."""
    entry = None if roster is None else roster.find(answers.who, answers.about.get("variant", ""))
    return "" if entry is None else entry.place


def _who(said: str, roster: Roster | None) -> Who:
    number = said.removeprefix(ENTRY)
    if said.startswith(ENTRY) and roster is not None and number.isdecimal() and int(number) < len(roster.entries):
        return roster.entries[int(number)].who
    return Who(student=said)


def _together(several: Sequence[Answers]) -> tuple[list[Answers], list[PageAsk]]:
    """Return the answers of a student with all pages in one, or apart where one comes twice, and what is asked then."""
    by_number = dict[int, list[tuple[Answers, Photo]]]()
    unread = [one.unread for one in several if one.unread is not None]
    photographed = [replace(one, problems=(*one.problems, *unread)) for one in several if one.photos]
    for one in photographed:
        for photo in one.photos:
            by_number.setdefault(photo.number, []).append((one, photo))
    again = {number: pages for number, pages in by_number.items() if len(pages) > 1 and number != FREE}
    if again:
        asks = [
            PageAsk(
                "which",
                tuple(page_of(photo) for _, photo in pages),
                tuple(one.source for one, _ in pages),
                number,
                pages[0][0].who.student,
                pictures=tuple(_small(photo) for _, photo in pages),
            )
            for number, pages in again.items()
        ]
        return photographed, asks
    if not photographed:
        return [*several], []
    first = photographed[0]
    about = next((one.about for one in photographed if one.about), first.about)
    photos = tuple(photo for number in sorted(by_number) for _, photo in by_number[number])  # FREE ones in their order
    return [replace(first, photos=photos, about=about)], []


def _with(answers: Answers, told: Told) -> Answers:
    """Return answers with what has been told of their vectors."""
    own = {page_of(photo) for photo in answers.photos}
    return replace(answers, told={name: ends for (page, name), ends in told.ends.items() if page in own})


def _small(photo: Photo) -> bytes:
    import cv2

    grey = grey_of(photo)
    times = SMALL / max(grey.shape)
    return _png(cv2.resize(grey, None, fx=times, fy=times, interpolation=cv2.INTER_AREA) if times < 1.0 else grey)


def _png(grey: Any) -> bytes:
    import cv2

    step = 255 // (GREYS - 1)
    few = (np.minimum(grey.astype(np.uint16) + step // 2, 255) // step * step).astype(np.uint8)
    return bytes(cv2.imencode(".png", few, [cv2.IMWRITE_PNG_COMPRESSION, 6])[1].tobytes())


# Where vectors end.


def ends_asked(desk: Desk, answers: Answers) -> tuple[list[EndAsk], dict[str, bytes]]:
    """Return what is asked of the vectors of a student that are not sure, and pictures of their plans.

    Raises
    ------
    InputError, PositionError
        The student's variant or data have no answer key, or the sheets cannot be read.
    """
    entry, key, _ = desk.of(answers)
    sheets, found = desk.photographed(answers, key)
    sure = surely(answers, key, sheets, found, desk.terms.rubric).recognised
    wanted = desk.terms.rubric.asked or {question.name for part in key.parts for question in part.asked}
    asks, pictures, ways = list[EndAsk](), dict[str, bytes](), plans_of(key)
    digests = {number: page_of(photo) for number, photo in numbered(answers.photos)}
    flats, bare = {page.number: page for page in sheets.pages}, sheets.bare()
    for plan, (number, pole) in sheets.blank.poles.items():
        way, mu = ways[plan], sheets.blank.mus[plan] / sheets.printed
        names = [
            name
            for name, question in key.key.questions.items()
            if name in wanted and question.plan == plan and question.vector and question.step.law != "opposite"
            if name not in sure.vectors and name not in answers.told and name in way.names
            if abs(key.key[name]) >= MEASURED * mu
        ]
        if not names or number not in flats or plan in bare:
            continue
        ends = {name: _on_page(sheets, one.tail, one.tip) for name, one in sheets.believed.items() if one.plan == plan}
        mistaken = plan not in sure.plans or bool(sure.plans[plan].mistake)
        places = {} if mistaken else dict(_places(way, {n: e for n, e in ends.items() if n in sure.vectors}))
        places[int(np.abs(way.places).argmin())] = pole
        box = _box(
            flats[number], [pole + z for z in (way.places / mu).tolist()] + [z for e in ends.values() for z in e]
        )
        picture = f"{digests[number]}-{len(pictures)}"
        pictures[picture] = _cut(flats[number], box)
        spots = _spots(sheets, number, box, pole)
        others = tuple(ends[name] for name in ends if name in sure.vectors)
        for name in names:
            at = way.names.index(name)
            marks = int(way.tails[at]), int(way.tips[at])
            tail, tip = ends.get(name) or (places.get(marks[0]), places.get(marks[1]))
            said = heading(key, plan), name, key.symbol(name), tail, tip, marks, spots, others, box, picture
            asks.append(EndAsk(digests[number], answers.source, "" if entry is None else entry.who.student, *said))
    return asks, pictures


def _on_page(sheets: Sheets, *places: complex) -> Any:
    return tuple(on_page(sheets, place)[1] for place in places)


def _places(way: Way, ends: Mapping[str, Ends]) -> Iterator[tuple[int, complex]]:
    """Go through the points of a plan that vectors tell, and where they are."""
    for name, both in ends.items():
        if name in way.names:
            at = way.names.index(name)
            yield from zip((int(way.tails[at]), int(way.tips[at])), both, strict=True)


def _box(page: Flat, places: Sequence[complex]) -> tuple[float, float, float, float]:
    """Return what is shown of a page, whole millimetres."""
    rows, columns = page.picture.shape
    every, edges = np.array(places), list[tuple[float, float]]()
    for values, most in ((every.real, columns / PER_MM), (every.imag, rows / PER_MM)):
        low, high = float(values.min()) - AROUND, float(values.max()) + AROUND
        more = max(LEAST - (high - low), 0.0) / 2.0
        edges.append((float(max(np.floor(low - more), 0.0)), float(min(np.ceil(high + more), np.floor(most)))))
    (x0, x1), (y0, y1) = edges
    return x0, y0, x1, y1


def _cut(page: Flat, box: tuple[float, float, float, float]) -> bytes:
    x0, y0, x1, y1 = (round(edge * PER_MM) for edge in box)
    rows = page.picture.shape[0]
    return _png(page.picture[rows - y1 : rows - y0, x0:x1])


def _spots(sheets: Sheets, number: int, box: tuple[float, float, float, float], pole: complex) -> tuple[complex, ...]:
    """Return where lines of a page end or cross in a box, the pole first, then those at which most lines meet."""
    lines = np.array(
        [
            _on_page(sheets, tail, tip)
            for tail, tip in zip(sheets.drawn.tails.tolist(), sheets.drawn.tips.tolist(), strict=True)
            if on_page(sheets, tail)[0] == number
        ],
        complex,
    ).reshape(-1, 2)
    long = lines[np.abs(lines[:, 1] - lines[:, 0]) >= LONG]
    every = np.concatenate((_crossings(long), long.ravel()))
    x0, y0, x1, y1 = box
    every = every[(every.real > x0) & (every.real < x1) & (every.imag > y0) & (every.imag < y1)]
    meet = (np.abs(every[:, None] - every[None, :]) <= SAME).sum(axis=1)
    found = [complex(pole)]
    for place in every[np.argsort(-meet, kind="stable")].tolist():
        if len(found) < SPOTS and min(abs(place - other) for other in found) > SAME:
            found.append(place)
    return tuple(found)


def _crossings(lines: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Return where lines cross, or nearly do, complex of shape (N,); `lines` are their ends, shape (M, 2)."""
    one, other = np.triu_indices(len(lines), 1)
    spans = lines[:, 1] - lines[:, 0]
    sizes = np.abs(spans)
    units = spans / np.maximum(sizes, 1e-9)
    sine = cross(units[one], units[other])
    steep = np.abs(sine) >= SINE
    one, other, sine = one[steep], other[steep], sine[steep]
    apart = lines[other, 0] - lines[one, 0]
    at = lines[one, 0] + units[one] * (cross(apart, units[other]) / sine)
    keep = np.ones(len(at), bool)
    for line in (one, other):
        along = dot(units[line], at - lines[line, 0])
        keep &= (along >= -BESIDE) & (along <= sizes[line] + BESIDE)
    return np.asarray(at[keep])
