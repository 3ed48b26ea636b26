"""Photographs of a student's sheets read: laid flat, print taken away, pencil lines as a drawing; what is sure of it.

The sheet is known: where its markers and poles are, what is printed, at which scale factors plans are drawn. What was
found wrong counts only where the pencil says so: the line that was read is there, and none where it should be.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...drawing.formats import FORMATS, Format, drawing_area, format_named, reserved_boxes
from ...drawing.markers import FREE, Place, stands
from ...drawing.page import Page
from ...drawing.shapes import Group, Shape, Vector
from ...drawing.writers import page_files
from ...plans.board import POSITION
from ...plans.marking.drawn import Found, FoundPlan, Recognised
from ...plans.marking.lines import Drawn
from ...plans.marking.ways import Shape as Way
from ...plans.marking.ways import edges_of, shape_of
from ...plans.names import LEVER, role
from ...scales.errors import LANGUAGES, InputError, KulmanError, Written
from ...scales.kept import Kept
from ...scales.numbers import SHOWN, quote
from ..case import Case, Request, plans_wanted
from ..marking.keyed import Keyed
from ..marking.reading import Ends, Reply
from ..marking.seen import Seen
from ..sheets import PAPER, drawing_for_print, scan_code, scannable_of_case
from .free import laid_flat, plans_on, quarters_of, turned, ways_of
from .matching import WHOLE, lines_of, matched
from .pictures import Photo, grey_of
from .straight import ASTRAY, PER_MM, flat, framed, straightened, without_worst
from .strokes import Ink, Stroke, strokes
from .traced import HIDES, Pencil, ends_at

APART = 1000.0  # mm between pages of a drawing
INKED = 200  # of 255: what is darker is print
POLE = 4.0  # mm from the printed pole within which a plan begins
COVERED = 0.85  # part of a vector along which the pencil must be seen
SHORT = 4.5  # mm of a vector that is read at the least: of one of 5 mm that may be read
OFF, ASTRAY_PART = 1.0, 0.02  # mm and part of a vector by which it may be beside where it should be
HAND = 0.4  # mm that the ends of a vector may lie beside its line, which turns short ones
CERTAIN = 0.75  # of a vector that may be a part of a longer line
QUALITY = 0.8  # part of a plan with a mistake that must be there
LONG, FEWEST = 15.0, 4  # mm of vectors that tell how large the sheet is printed; how many
LIKE, MISSED, ALIKE = 0.01, 0.6, 0.8  # part of each, and mm, by which they may differ; part of them that is alike
PRINTED, MOST = 0.012, 0.1  # parts by which a print that is told is smaller or larger
NEAR, AROUND = 3.0, 20.0  # mm from a pole, between which a plan that is drawn has lines
CLEAN, SPECKS = 12, 0.0005  # darkness below which paper is clean, part of it that may be darker where nothing is drawn


@dataclass(frozen=True, slots=True, eq=False)
class Flat:
    """A page laid flat: its picture, `PER_MM` pixels a mm, how dark the pencil is there, 0 to 254, how many lines."""

    number: int
    picture: NDArray[np.uint8]
    dark: NDArray[np.uint8]
    lines: int
    error: float

    def covered(self, tail: complex, tip: complex) -> float:
        """Return along which part of a way the pencil is seen, as far as print does not hide it."""
        count = max(int(abs(tip - tail) * 4), 4)
        at = tail + (tip - tail) * np.linspace(0.02, 0.98, count)
        side = 1j * (tip - tail) / abs(tip - tail)
        rows, columns = self.dark.shape
        best = np.zeros(count)
        hidden = np.zeros(count, bool)
        for off in np.arange(-0.4, 0.41, 0.1):
            z = (at + off * side) * PER_MM
            x = np.clip(z.real.astype(int), 0, columns - 1)
            y = np.clip((rows - z.imag).astype(int), 0, rows - 1)
            here = self.dark[y, x]
            hidden |= here == HIDES
            best = np.maximum(best, np.where(here == HIDES, 0, here))
        seen = (best > CLEAN) | hidden
        return float(seen.mean()) if not hidden.all() else 0.0

    def bare(self, pole: complex) -> bool:
        """Return whether nothing at all is drawn around a pole, where print leaves enough to see of the paper."""
        rows, columns = self.dark.shape
        x = (np.arange(columns) + 0.5) / PER_MM - pole.real
        y = (rows - np.arange(rows) - 0.5) / PER_MM - pole.imag
        across, up = np.abs(x) <= AROUND, np.abs(y) <= AROUND
        away = np.hypot(x[None, across], y[up, None])
        dark = self.dark[np.ix_(up, across)][(away >= NEAR) & (away <= AROUND)]
        paper = dark[dark != HIDES]
        return paper.size > dark.size / 2 and bool(np.mean(paper > CLEAN) <= SPECKS)


@dataclass(frozen=True, eq=False)
class _Blank:
    """A handout as it was printed: its pages; on which of them plans have their poles, and where; SI per mm of each."""

    case: Case
    pages: tuple[Page, ...]
    formats: tuple[Format, ...]
    poles: Mapping[str, tuple[int, complex]]
    mus: Mapping[str, float]

    @cached_property
    def codes(self) -> tuple[str, ...]:
        """What the QR codes of its pages say."""
        bare = (replace(page, shapes=tuple(s for s in page.shapes if not _added(s))) for page in self.pages)
        return tuple(scan_code(self.case, number, page) for number, page in enumerate(bare, 1))

    def made(self, code: Sequence[str]) -> bool:
        """Return whether a page of it has this code."""
        return ":".join(code) in self.codes

    @property
    def pages_with_plans(self) -> set[int]:
        """The numbers of pages on which plans are drawn."""
        return {number for number, _ in self.poles.values()}

    def stands(self, number: int) -> list[Place]:
        """Return where the markers of a page stand."""
        return stands(self.pages[number - 1])

    def printed(self, number: int) -> NDArray[np.bool_]:
        """Return where a page is printed, or no plan is drawn, `PER_MM` pixels per mm."""
        page, sheet = self.pages[number - 1], self.formats[number - 1]
        rows, columns = round(page.height * PER_MM), round(page.width * PER_MM)
        ink = np.zeros((rows, columns), bool)
        grey = rendered(page, grayscale=True)[:rows, :columns, 0]
        ink[: grey.shape[0], : grey.shape[1]] = grey < INKED
        x0, y0, x1, y1 = drawing_area(sheet, self.case.norm)
        outside = np.ones_like(ink)
        outside[rows - int(y1 * PER_MM) : rows - int(y0 * PER_MM), int(x0 * PER_MM) : int(x1 * PER_MM)] = False
        for box in reserved_boxes(sheet, self.case.norm, number == 1):
            a0, b0, a1, b1 = (int(edge * PER_MM) for edge in box)
            outside[rows - b1 : rows - b0, a0:a1] = True
        return np.asarray(ink | outside)


@dataclass(frozen=True, slots=True, eq=False)
class Sheets:
    """What photographs of a student show: the pages, the drawing on them, and what is to be said of it."""

    blank: _Blank
    pages: tuple[Flat, ...]
    drawn: Drawn
    notes: tuple[KulmanError, ...]
    printed: float = 1.0  # how many times as large as they are printed lengths on the sheet are
    believed: Mapping[str, Found] = field(default_factory=dict)  # vectors by name, also those that are not sure

    def bare(self) -> frozenset[str]:
        """Return the plans of a handout at whose poles nothing is drawn, though their pages are there."""
        pages = {page.number: page for page in self.pages if self.blank.pages}
        drawn = {one.plan for one in self.believed.values()}
        poles = ((plan, pages.get(number), at) for plan, (number, at) in self.blank.poles.items() if plan not in drawn)
        return frozenset(plan for plan, page, at in poles if page is not None and page.bare(at))

    def absent(self, handed_in: Collection[int]) -> frozenset[str]:
        """Return the plans that are on other pages of the handout than those of these numbers."""
        printed = self.blank.poles.items() if self.blank.pages else ()
        return frozenset(plan for plan, (page, _) in printed if page not in handed_in)


def rendered(page: Page, per_mm: float = PER_MM, **how: bool) -> NDArray[np.uint8]:
    """Return a page as pixels, so many a mm, of shape (rows, columns, channels)."""
    import pypdfium2

    ((_, data),) = page_files([page], Path("page.pdf"))
    document = pypdfium2.PdfDocument(data)
    # no row more, over which all would be stretched, where millimetres are not quite whole points
    bitmap = document[0].render(scale=per_mm * 25.4 / 72.0 * (1.0 - 1e-6), **how)
    pixels = np.atleast_3d(bitmap.to_numpy()).copy()
    bitmap.close()  # many megabytes, which else wait for the garbage to be collected
    document.close()
    return pixels


def _added(shape: Shape) -> bool:
    return isinstance(shape, Group) and shape.role in ("marker", "qr")


def _blank_of(request: Request, keyed: Keyed, language: str, paper: str) -> _Blank:
    """Make the handout anew that a student was given, in a language and on a format of paper."""
    solution = keyed.solution
    settings = solution.case.settings
    case = replace(request, variant=solution.variant, settings=settings, format=paper, language=language).case()
    drawing = drawing_for_print(case)
    pages = scannable_of_case(case, drawing).pages
    mus = {plan: scale.mu for plan, scale in drawing.scales.items()}
    poles = dict(_poles(plans_of(keyed), drawing.placed, mus))
    return _Blank(case, pages, drawing.sheets, poles, mus)


def plans_of(keyed: Keyed) -> dict[str, Way]:
    """Return the plans that are read, as they should be."""
    program, found = keyed.key.paper.program, dict[str, Way]()
    for plan in program.plans:
        way = shape_of(plan, edges_of(program, plan), keyed.key.values)
        if plan != POSITION and role(plan).kind != LEVER and way is not None and way.longest:
            found[plan] = way
    return found


def _poles(
    plans: Mapping[str, Way], placed: Sequence[Sequence[Group]], mus: Mapping[str, float]
) -> Iterator[tuple[str, tuple[int, complex]]]:
    """Go through the plans and where their poles are: on which page, from 1, and at which place, mm."""
    for plan, way in plans.items():
        found = (
            (number, vector.tail - complex(way.places[way.tails[at]]) / mus[plan])
            for number, views in enumerate(placed, start=1)
            for view in views
            if view.name == plan
            for vector in _vectors(view.shapes)
            if plan in mus and vector.quantity in way.names and abs(vector.mu - mus[plan]) <= 1e-6 * mus[plan]
            for at in [way.names.index(vector.quantity)]
            if _alike(vector, complex(way.places[way.tips[at]] - way.places[way.tails[at]]) / mus[plan])
        )
        first = next(found, None)
        if first is not None:
            yield plan, first


def _alike(vector: Vector, span: complex) -> bool:
    return abs(span) > 3.0 and abs(vector.tip - vector.tail - span) < 0.05


def _vectors(shapes: Sequence[Shape]) -> Iterator[Vector]:
    for shape in shapes:
        if isinstance(shape, Vector):
            yield shape
        elif isinstance(shape, Group):
            yield from _vectors(shape.shapes)


def photographed(photos: Sequence[Photo], request: Request, keyed: Keyed, kept: Kept[_Blank]) -> tuple[Sheets, Seen]:
    """Read the sheets of a student, and recognise what they show, as far as it is sure.

    Handouts that were made anew are `kept`.
    """
    name = keyed.solution.variant, *sorted(keyed.solution.case.settings.items())

    def blank(language: str, paper: str, only: tuple[str, ...] | None = None) -> _Blank:
        asked = replace(request, only=only or request.only)
        return kept.get((*name, language, paper, only), lambda: _blank_of(asked, keyed, language, paper))

    own = _of_ones_own(photos)
    codes = name, *(photo.code for photo in photos)
    fitting = None if own else kept.get(codes, lambda: _fitting(photos, request, blank))
    sheets = _own_sheets(photos, keyed) if fitting is None else _read_sheets(photos, fitting)
    found = _recognised(sheets, keyed)
    times = 1.0 if own else _print_scale(sheets, keyed, found)
    if times != 1.0:
        sheets = _shrunk(sheets, times)
        found = _recognised(sheets, keyed)
    sheets, found = replace(sheets, believed=found.vectors), _sure(sheets, keyed, found)
    mus = {plan: sheets.blank.mus[plan] for plan in found.plans}
    return sheets, Seen(found, mus, _printed(sheets.blank))


def _of_ones_own(photos: Sequence[Photo]) -> bool:
    """Return whether all these are sheets of one's own, with markers stuck on them."""
    return all(photo.number == FREE for photo in photos)


def numbered(photos: Sequence[Photo]) -> Iterator[tuple[int, Photo]]:
    """Go through photographs and the numbers of their pages: sheets of one's own are counted."""
    own = _of_ones_own(photos)
    return ((number if own else photo.number, photo) for number, photo in enumerate(photos, start=1))


def _printed(blank: _Blank) -> frozenset[str]:
    """Return the plans whose scale factors are printed: none on sheets of one's own."""
    return frozenset(blank.mus if blank.pages else ())


def _own_sheets(photos: Sequence[Photo], keyed: Keyed) -> Sheets:
    """Read the pencil lines on photographs of a student's own sheets, which have markers stuck on them."""
    ways = ways_of(keyed)
    sheets = [laid_flat(photo, ways) for photo in photos]
    plans = plans_on(sheets, keyed, APART)
    quarters = [
        quarters_of([plan for plan in plans.values() if math.floor(plan.pole.real / APART) == number])
        for number in range(1, len(sheets) + 1)
    ]
    if any(quarters):
        sheets = [turned(sheet, by) if by else sheet for sheet, by in zip(sheets, quarters, strict=True)]
        plans = plans_on(sheets, keyed, APART)
    on = {plan: math.floor(one.pole.real / APART) for plan, one in plans.items()}
    poles = {plan: (on[plan], one.pole - APART * on[plan]) for plan, one in plans.items()}
    blank = _Blank(keyed.solution.case, (), (), poles, {plan: one.mu for plan, one in plans.items()})
    pages, ends = list[Flat](), list[tuple[complex, complex]]()
    for number, sheet in enumerate(sheets, start=1):
        pages.append(Flat(number, sheet.picture, _dark(sheet.ink), len(sheet.lines), sheet.error))
        ends += [(line.tail + APART * number, line.tip + APART * number) for line in sheet.lines]
    lines = np.array(ends, complex).reshape(-1, 2)
    notes = (
        InputError("photo-own", file=quote(photo.source, SHOWN), n=len(photo.markers), mm=Written(f"{page.error:.2f}"))
        for photo, page in zip(photos, pages, strict=True)
    )
    return Sheets(blank, tuple(pages), Drawn(lines[:, 0], lines[:, 1]), tuple(notes))


def _dark(ink: Ink) -> NDArray[np.uint8]:
    """Return how dark the pencil is, 0 to 254, and where print hides it."""
    return np.where(ink.printed > 0, np.uint8(HIDES), ink.soft)


def _recognised(sheets: Sheets, keyed: Keyed) -> Recognised:
    """Return which lines of the sheets are which vectors, at places of the drawing."""
    tails, tips = sheets.drawn.tails, sheets.drawn.tips
    pages = {
        page.number: lines_of(tails[own], tips[own], Pencil(page.dark, APART * page.number, sheets.printed))
        for page in sheets.pages
        for own in [_on(tails, page.number)]
    }
    poles = {plan: (page, APART * page + place / sheets.printed) for plan, (page, place) in sheets.blank.poles.items()}
    return matched(pages, poles, sheets.blank.mus, keyed)


def _on(places: NDArray[np.complex128], page: int) -> NDArray[np.bool_]:
    return np.asarray(np.floor(places.real / APART) == page)


def _fitting(photos: Sequence[Photo], request: Request, blank: Callable[..., _Blank]) -> _Blank:
    """Return the handout that was photographed: its QR code tells how it was printed, else where its markers are.

    Which plans it is for, where it is not for those that are asked for, is found out: all, or some that follow.
    """
    told = next((photo.code for photo in photos if photo.code), ())
    if told and told[5].lower() in LANGUAGES and told[6] in FORMATS:
        how, plans = (told[5].lower(), told[6]), plans_wanted(None, request.task)
        asked = blank(*how)
        if asked.made(told):
            return asked
        for n in (len(plans), *range(1, len(plans))):
            for run in (plans[at : at + n] for at in range(len(plans) - n + 1)):
                with suppress(KulmanError):  # a scale factor is asked for that these plans do not have
                    if run != asked.case.plans and (other := blank(*how, run)).made(told):
                        return other
        return asked
    paper = format_named(request.format or PAPER).name
    own = blank(request.language, paper)
    if all(_fits(photo, own) for photo in photos):
        return own
    ways = [own, *(blank(language, paper) for language in LANGUAGES if language != request.language)]
    return max(ways, key=lambda way: sum(_fits(photo, way) for photo in photos))


def _fits(photo: Photo, blank: _Blank) -> bool:
    """Whether the markers on a photograph stand where they do on a handout."""
    if photo.number > len(blank.pages):
        return False
    return straightened(photo.markers, blank.stands(photo.number), photo.centre).error <= ASTRAY


def _read_sheets(photos: Sequence[Photo], blank: _Blank) -> Sheets:
    """Read the pencil lines on the photographs of a student's sheets.

    Pages whose markers do not lie as they were printed, or that were printed from other data, are not read: a note says
    so.
    """
    pages, notes = list[Flat](), list[KulmanError]()
    ends: list[tuple[complex, complex]] = []
    for photo in photos:
        try:
            page, lines = _read(photo, blank)
        except InputError as note:
            notes.append(note)
            continue
        by = APART * photo.number
        ends += [(line.tail + by, line.tip + by) for line in lines]
        pages.append(page)
    both = np.array(ends, complex).reshape(-1, 2)
    return Sheets(blank, tuple(pages), Drawn(both[:, 0], both[:, 1]), tuple(notes))


def _read(photo: Photo, blank: _Blank) -> tuple[Flat, list[Stroke]]:
    """Lay a page of a handout flat, and read the lines on it."""
    place = {"file": quote(photo.source, SHOWN), "page": photo.number}
    if photo.number > len(blank.pages) or (photo.code and ":".join(photo.code) != blank.codes[photo.number - 1]):
        raise InputError("photo-other", **place)
    markers, stands_at = photo.markers, blank.stands(photo.number)
    way = straightened(markers, stands_at, photo.centre)
    if way.error > ASTRAY:
        markers = without_worst(markers, stands_at, photo.centre)
        way = straightened(markers, stands_at, photo.centre)
    if way.error > ASTRAY:
        raise InputError("photo-crooked", **place)
    page = blank.pages[photo.number - 1]
    grey = grey_of(photo)
    edges = framed(grey, way, drawing_area(blank.formats[photo.number - 1], blank.case.norm))
    way = straightened(markers, stands_at, photo.centre, edges)
    picture = flat(grey, way, page.width, page.height)
    poles = [at for number, at in blank.poles.values() if number == photo.number]
    if not poles:
        return Flat(photo.number, picture, np.zeros((1, 1), np.uint8), 0, way.error), []
    ink = Ink(picture, blank.printed(photo.number))
    found = strokes(ink, poles)
    return Flat(photo.number, picture, _dark(ink), len(found), way.error), found


def _print_scale(sheets: Sheets, keyed: Keyed, found: Recognised) -> float:
    """Return how many times as large as they should be lengths on the sheets are, 1 where nothing tells.

    A sheet that was printed smaller has its markers smaller, too; the student's ruler is as it was.
    """
    mus = sheets.blank.mus
    wrong = (mus[name] / plan.mu for name, plan in found.plans.items() if plan.mistake and plan.quality >= WHOLE)
    if any(abs(times - 1.0) <= PRINTED for times in wrong):  # larger forces may follow from a mistake
        return 1.0
    right = {name for name, plan in found.plans.items() if name in mus and not (plan.mistake or plan.alone)}
    long = [(name, one) for name, one in found.vectors.items() if one.plan in right and abs(one.tip - one.tail) >= LONG]
    if len(long) < FEWEST:
        return 1.0
    sizes = np.array([abs(one.tip - one.tail) for _, one in long])
    wanted = np.array([abs(keyed.key[name]) / mus[one.plan] for name, one in long])
    middle = float(np.median(sizes / wanted))
    alike = np.mean(np.abs(sizes - middle * wanted) <= np.maximum(LIKE * sizes, MISSED)) >= ALIKE
    return middle if alike and PRINTED < abs(middle - 1.0) < MOST else 1.0


def _shrunk(sheets: Sheets, by: float) -> Sheets:
    """Return sheets whose lengths are as the student's ruler shows them, with a note that says so."""
    drawn = sheets.drawn
    note = InputError("photo-printed", percent=Written(f"{100.0 / by:.1f}"))
    smaller = Drawn(_by(drawn.tails, by), _by(drawn.tips, by))
    return replace(sheets, drawn=smaller, notes=(*sheets.notes, note), printed=by)


def _by(places: NDArray[np.complex128], by: float) -> NDArray[np.complex128]:
    pages = np.floor(places.real / APART) * APART
    return np.asarray(pages + (places - pages) / by)


def on_page(sheets: Sheets, place: complex) -> tuple[int, complex]:
    """Return on which page a place of the drawing is, and where there."""
    number = math.floor(place.real / APART)
    return number, (place - number * APART) * sheets.printed


def directed(lines: Mapping[str, Reply], keyed: Keyed, degrees: float) -> dict[str, Reply]:
    """Return answers without directions that differ from the right ones by no more than short vectors may be turned."""
    found = dict[str, Reply]()
    for name, line in lines.items():
        right = keyed.key[name]
        if line.direction is not None and line.mm and isinstance(right, complex) and right:
            off = abs(cmath.phase(cmath.rect(1.0, line.direction) / right))
            if math.radians(degrees) < off <= math.radians(degrees) + math.atan(HAND / line.mm):
                line = replace(line, direction=None)
        found[name] = line
    return found


def settled(sheets: Sheets, keyed: Keyed, found: Seen, told: Mapping[str, Ends | None]) -> Seen:
    """Return what was recognised with the vectors that somebody has shown: where they end, mm of their page.

    One that has no ends is not drawn.
    """
    plans, vectors, blank = dict(found.recognised.plans), dict(found.recognised.vectors), sheets.blank
    for name, ends in told.items():
        question, own = keyed.key.questions.get(name), vectors.pop(name, None)
        plan = own.plan if own is not None else question.plan if question is not None else ""
        if ends is not None and plan in blank.poles:
            number, pole = blank.poles[plan]
            tail, tip, at = (APART * number + place / sheets.printed for place in (*ends, pole))
            plans[plan] = replace(plans.get(plan) or FoundPlan(blank.mus[plan], 0.0, at, 1.0), quality=1.0)
            vectors[name] = Found(tail, tip, plan, 1.0)
    missing = (name for name in (*found.recognised.missing, *told) if name not in vectors)
    mus = {plan: blank.mus[plan] for plan in plans}
    return Seen(Recognised(plans, vectors, tuple(dict.fromkeys(missing))), mus, _printed(blank) & {*mus})


def _sure(sheets: Sheets, keyed: Keyed, found: Recognised) -> Recognised:
    """Return what was recognised without what is not sure, which is then missing.

    A plan must begin at its printed pole; a vector must be drawn in pencil; one that is wrong must not be there as it
    should be, too, nor belong to a plan of which much is missing.
    """
    by_number = {page.number: page for page in sheets.pages}
    plans, vectors = dict(found.plans), dict(found.vectors)
    for plan, one in found.plans.items():
        number, at = on_page(sheets, one.pole)
        own = sheets.blank.poles.get(plan)
        astray = own is None or own[0] != number or abs(own[1] - at) > POLE
        if astray or (one.mistake and one.quality < QUALITY):
            plans.pop(plan)
    for name, vector in found.vectors.items():
        doubt = vector.plan not in plans or _doubtful(sheets, keyed, found, name, vector, by_number)
        if doubt:
            vectors.pop(name)
    gone = tuple(name for name in found.vectors if name not in vectors)
    return Recognised(plans, vectors, (*found.missing, *gone))


def _doubtful(
    sheets: Sheets, keyed: Keyed, found: Recognised, name: str, vector: Found, pages: Mapping[int, Flat]
) -> bool:
    """Whether a vector may have been misread."""
    number, tail = on_page(sheets, vector.tail)
    _, tip = on_page(sheets, vector.tip)
    page, way = pages.get(number), tip - tail
    if page is None or not vector.certainty or abs(way) < SHORT or page.covered(tail, tip) < COVERED:
        return True
    right = complex(keyed.key[name]) / sheets.blank.mus[vector.plan] * sheets.printed
    if abs(way - right) <= OFF + ASTRAY_PART * abs(right):
        return False
    plan = found.plans[vector.plan]
    if plan.mistake and plan.quality >= WHOLE:  # all of a plan tells more than what else lies on the right place
        return False
    if abs(right) < SHORT or page.covered(tail, tail + right) < COVERED:
        return False
    return vector.certainty < CERTAIN or not ends_at(Pencil(page.dark), tail, tip, tail + right)
