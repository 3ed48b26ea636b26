"""The judge of drawn sheets: reads nothing but their SVG and counts what a strict examiner would cross out.

    python -m kulman.tests.sheets.judge [TASK or FILE.svg...] [--format A3] [--lang uk] [--variants all] [-v]

Without a task it judges all that are bundled, of each its first variant. The line of a sheet says what was found of
what was looked at; `-v` adds every finding with its place, mm from the left and from the top edge, and its page.
Shapely tells what touches; letters are measured on the fonts that the file embeds.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
import shapely
import shapely.ops

from kulman.tests.support.readback import Page, Ring, Sheet, Stroke, Text, View, boxes, polygon, read, read_back

TINY = 1e-6
VISIBLE = 0.1  # mm by which a letter must be nearer to a foreign thing to be taken for its letter
WIDE = 3.0  # mm, the radius from which letters may stand inside a circle that is no node
REACH = 9.0  # mm from a force to the point at which it acts
END = 0.5  # mm at both ends of a leader, where it touches what it joins
BLOCKS = {"form-1", "form-2a", "iso-7200", "column-26"}  # in which no view may stand
DESIGNATIONS = ("designation", "identification")  # in the title blocks of GOST and of ISO
FORCE = re.compile(r"_?[FGRPQ](_|$)")
KINDS = ("overlaps", "struck", "nodes", "vectors", "leaders", "forces", "anonymous", "page", "pens", "words")
FILL = {"A4": 0.50, "A3": 0.65, "A2": 0.65, "A1": 0.65}  # part of the area inside the frame that views should take
EMPTY = 0.12  # of it that may be one bare rectangle
SIDES = {297: "A4", 420: "A3", 594: "A2", 841: "A1"}
PAGES = {(841.0, 594.0), (594.0, 420.0), (420.0, 297.0), (297.0, 420.0), (210.0, 297.0)}
THINNEST = {841.0: 0.3, 594.0: 0.25, 420.0: 0.25, 297.0: 0.25, 210.0: 0.2}  # lines, by widths of pages
HEIGHTS = (2.5, 3.5, 5.0, 7.0, 10.0)  # of capitals
SCRIPTS = dict(zip(HEIGHTS, (1.8, *HEIGHTS), strict=False))  # the next smaller ones
FOREIGN = {"uk": "[ыэъёЫЭЪЁ]", "ru": "[іїєґІЇЄҐ]", "en": "[а-яА-ЯіїєґІЇЄҐёЁ]"}
OTHERS = {  # words of the neighbouring language that pass the alphabet
    "uk": "Лист|Листов|Подп|Утв|Пров|Изм|сила|Разраб",
    "ru": "Аркуш|Арк|Затв|Перев|Розроб|швидкостей|прискорень|сил групи|ланки|ланка",
    "en": "(?!)",
}
# what has no place among Cyrillic letters
LATIN = re.compile(r"\b(?!const|arcsin|arccos|arctg)[A-Za-z]{4,}\b|\b(RR[RP]|R?PR|PRP|RPP)\b")


class Finding(NamedTuple):
    """A fault: its kind, the page counted from 1, the view, what it is and where, mm with y up."""

    kind: str
    page: int
    view: str
    said: str
    at: complex


@dataclass(frozen=True)
class Sight:
    """What is seen of one page; `looked` counts what was looked at, by kind."""

    format: str
    findings: list[Finding]
    looked: Counter[str]
    fill: float
    empty: float


def judged(sheet: Sheet) -> list[Sight]:
    """Look at every page of a sheet."""
    return [_sight(page) for page in sheet.pages]


def overlaps(sheet: Sheet) -> list[str]:
    """All that touches on a sheet: letters that cover something, views on each other, on the frame or the block."""
    return [f"{finding.view}: {finding.said}" for page in sheet.pages for finding in touching(page)]


def looks(sheet: Sheet) -> list[str]:
    """All that is wrong with paper, pens and words."""
    found = (finding for page in sheet.pages for seen in (paper, pens, words) for finding in seen(page))
    return [f"{finding.view}: {finding.said}" for finding in found]


def faults(sheet: Sheet) -> list[str]:
    """All in which a sheet falls short of what is asked of every one."""
    sights = judged(sheet)
    found = [f"page {f.page}, {f.kind}: {f.view}: {f.said}" for sight in sights for f in sight.findings]
    for number, sight in enumerate(sights[:-1] or sights, start=1):  # a last page has what is left
        if sight.fill < FILL.get(sight.format, 1.0):
            found.append(f"page {number} is filled to {sight.fill:.0%}")
        if sight.empty > EMPTY:
            found.append(f"page {number} has a bare rectangle of {sight.empty:.0%}")
    return found


def _sight(page: Page) -> Sight:
    looked: Counter[str] = Counter()
    found = list(touching(page))
    for view in page.all:
        looked["overlaps"] += len(view.texts)
        looked["struck"] += len(view.texts)
        struck = {id(text): (text, stroke) for text, stroke in thin_faults(view)}
        for text, stroke in struck.values():
            said = f"{text.string!r} is struck by thin line {_called(stroke)}"
            found.append(_finding("struck", view, said, _middle(text)))
        others = (("leaders", crossing(view)), ("forces", detached(view)))
        for kind, fault in (*astray(view), *((kind, fault) for kind, faults_in in others for fault in faults_in)):
            looked[kind] += 1
            found += [fault] if fault else []
    for kind, faults_in in (("anonymous", anonymous), ("page", paper), ("pens", pens), ("words", words)):
        looked[kind] = 1
        found += faults_in(page)
    return Sight(SIDES.get(round(max(page.width, page.height)), "?"), found, looked, *_room(page))


def touching(page: Page) -> Iterator[Finding]:
    """Texts of a page that cover something, views that are not where they may be."""
    for view in page.all:
        yield from text_faults(view)
    yield from view_faults(page)


def text_faults(view: View) -> Iterator[Finding]:
    """Texts of a view that touch a text, a circle, an arrowhead or a main line."""
    texts = view.texts
    areas = np.array([text.area for text in texts])
    tree = shapely.STRtree(areas)

    def fault(i: int, what: str) -> Finding:
        return _finding("overlaps", view, f"{texts[i].string!r} on {what}", _middle(texts[i]))

    for i, j in tree.query(areas, predicate="intersects").T.tolist():
        if i < j and shapely.area(shapely.intersection(areas[i], areas[j])) > TINY:
            yield fault(i, repr(texts[j].string))
    for thing, name in _things(view):
        for i in tree.query(thing, predicate="intersects").tolist():
            yield fault(i, name)
    if corners := [(p.real, p.imag) for stroke in view.lines("inset") for p in stroke.points]:
        frame = shapely.MultiPoint(corners).envelope
        for i, text in enumerate(texts):
            if text.role == "label" and not frame.contains_properly(areas[i]):
                yield fault(i, "the frame of a detail, or outside of it")


def _finding(kind: str, view: View, said: str, at: complex) -> Finding:
    return Finding(kind, view.page, view.name or "frame", said, at)


def _middle(text: Text) -> complex:
    x0, y0, x1, y1 = text.box
    return complex(x0 + x1, y0 + y1) / 2


def _things(view: View) -> Iterator[tuple[shapely.Geometry, str]]:
    for stroke in _main(view):
        yield stroke.ink, f"main line {_called(stroke)}"
    main = max((s.width for s in view.strokes), default=0.0)
    for ring in view.rings:
        round_it = ring.radius > WIDE and ring.fill == "none" and ring not in view.nodes
        if not round_it or ring.width == main:
            yield _disc(ring).boundary if round_it else _disc(ring), f"circle {ring.path[-1][1] if ring.path else ''}"
    for tip in view.tips:
        yield polygon(tip.corners), f"arrowhead {tip.path[-1][1] if tip.path else ''}"


def _main(view: View) -> list[Stroke]:
    """The widest lines of a view."""
    main = max((s.width for s in view.strokes), default=0.0)
    return [s for s in view.strokes if s.width == main and s.width > 0]


def _disc(ring: Ring) -> shapely.Geometry:
    return shapely.Point(ring.centre.real, ring.centre.imag).buffer(ring.radius + ring.width / 2, quad_segs=16)


def _called(stroke: Stroke) -> str:
    return "/".join(filter(None, (*(name for _, name in stroke.path), stroke.role, stroke.name)))


def thin_faults(view: View) -> Iterator[tuple[Text, Stroke]]:
    """Texts that a thin line runs through: allowed by G5, but no pleasure to read."""
    main = max((s.width for s in view.strokes), default=0.0)
    areas = [text.area for text in view.texts]
    if not areas:
        return
    tree = shapely.STRtree(areas)
    for stroke in view.pieces:
        if 0 < stroke.width < main:
            for i in tree.query(stroke.ink, predicate="intersects").tolist():
                yield view.texts[i], stroke


def view_faults(page: Page) -> Iterator[Finding]:
    """Views that leave the frame, lie on the title block or on each other."""
    areas = boxes([view.box for view in page.views])
    for i, view in enumerate(page.views):
        for j in np.flatnonzero(shapely.area(shapely.intersection(areas[i], areas)) > TINY).tolist():
            if i < j:
                yield _finding("overlaps", view, f"view on view {page.views[j].name}", _corner(view))
    inner = _inside(page)
    obstacles = [shapely.box(*block) for block in _blocks(page)]
    for view, area in zip(page.views, areas, strict=True):
        if not inner.contains(area):
            yield _finding("overlaps", view, "view leaves the frame", _corner(view))
        if any(shapely.area(shapely.intersection(area, block)) > TINY for block in obstacles):
            yield _finding("overlaps", view, "view on the title block", _corner(view))
        for text in view.texts:
            if not inner.contains(text.area):
                yield _finding("overlaps", view, f"{text.string!r} leaves the frame", _middle(text))


def _corner(view: View) -> complex:
    return complex(view.box[0], view.box[3])


def _inside(page: Page) -> shapely.Geometry:
    """The area inside the frame."""
    (frame,) = [s for s in page.rest.strokes if s.role == "frame"]
    xs, ys = [p.real for p in frame.points], [p.imag for p in frame.points]
    half = frame.width / 2
    return shapely.box(min(xs) + half, min(ys) + half, max(xs) - half, max(ys) - half)


def _blocks(page: Page) -> Iterator[tuple[float, float, float, float]]:
    """Boxes of the blocks drawn in the corners of the frame, from their own lines."""
    names = {s.path[0][1] for s in page.rest.strokes if s.path} & BLOCKS
    for name in sorted(names):
        points = [p for s in page.rest.strokes if s.path and s.path[0][1] == name for p in s.points]
        xs, ys = [p.real for p in points], [p.imag for p in points]
        yield min(xs), min(ys), max(xs), max(ys)


def astray(view: View) -> Iterator[tuple[str, Finding | None]]:
    """Letters of nodes and of vectors, and which stand nearer to a foreign one: a leader is a part of its letter."""
    nodes = [(ring.path[-1][1], _disc(ring)) for ring in view.nodes]
    vectors = [(name, _line(*ends)) for name, ends in _vectors(view)]
    about = [(name, line.buffer(VISIBLE)) for name, line in vectors]
    for text, letter in _letters(view):
        own = shapely.MultiPoint([(p.real, p.imag) for p in text.of])
        at_node = [name for name, disc in nodes if len(text.of) == 1 and disc.covers(own)]
        kind, things = ("nodes", nodes) if at_node else ("vectors", vectors)
        belongs = at_node or [name for name, area in about if area.covers(own)]
        if not belongs:
            continue
        far = min(letter.distance(thing) for name, thing in things if name in belongs)
        near, name = min(
            ((letter.distance(thing), name) for name, thing in things if name not in belongs), default=(far, "")
        )
        said = f"{text.string!r} of {belongs[0]}, {far:.1f} mm away, is {near:.1f} mm from {name}"
        yield kind, _finding(kind, view, said, _middle(text)) if near < far - VISIBLE else None


def _line(*points: complex) -> shapely.Geometry:
    return shapely.LineString([(p.real, p.imag) for p in points])


def _vectors(view: View) -> Iterator[tuple[str, tuple[complex, complex]]]:
    """Names and ends of all straight arrows of a view, and of what an inset shows of vectors."""
    yield from ((vector.quantity, (vector.tail, vector.tip)) for vector in view.vectors)
    yield from ((arrow.name, (arrow.tail, arrow.tip)) for arrow in view.arrows)
    for stroke in view.inside("cut"):
        yield stroke.path[-1][1], (stroke.points[0], stroke.points[-1])


def _letters(view: View) -> Iterator[tuple[Text, shapely.Geometry]]:
    """Texts that letter something, each with its leader."""
    leaders = view.lines("leader")
    nearest = [min(range(len(view.texts)), key=lambda i, s=s: _gap(view.texts[i], s)) for s in leaders]
    for i, text in enumerate(view.texts):
        if text.of:
            own = [_line(*leaders[k].points) for k, of in enumerate(nearest) if of == i]
            yield text, shapely.union_all([text.area, *own])


def _gap(text: Text, leader: Stroke) -> float:
    """How far the nearer end of a leader is from a text."""
    return min(text.area.distance(shapely.Point(p.real, p.imag)) for p in (leader.points[0], leader.points[-1]))


def crossing(view: View) -> Iterator[Finding | None]:
    """Leaders that cross a main line or run through a node on their way."""
    main = [(_called(s), shapely.LineString([(p.real, p.imag) for p in s.points])) for s in _main(view)]
    main += [(f"node {ring.path[-1][1]}", _disc(ring)) for ring in view.nodes]
    for leader in view.lines("leader"):
        whole = _line(*leader.points)
        cut = min(END / whole.length, 0.5)
        line = shapely.ops.substring(whole, cut, 1.0 - cut, normalized=True)
        crossed = [(name, line.intersection(thing)) for name, thing in main if line.intersects(thing)]
        if crossed:
            at = crossed[0][1].representative_point()
            said = f"leader of {leader.name} crosses {', '.join(dict.fromkeys(name for name, _ in crossed))}"
            yield _finding("leaders", view, said, complex(at.x, at.y))
        else:
            yield None


def detached(view: View) -> Iterator[Finding | None]:
    """Arrows of forces that stand away from every node; a leader may join them to one."""
    nodes = [ring.centre for ring in view.nodes]
    led = [leader.points for leader in view.lines("leader")]
    for arrow in view.arrows:
        if not (FORCE.match(arrow.name) and nodes):
            continue
        ends = [arrow.tail, arrow.tip]
        ends += [q for p, *_, q in (*led, *(line[::-1] for line in led)) if min(abs(p - end) for end in ends) < END]
        far = min(abs(end - node) for end in ends for node in nodes)
        said = f"{arrow.name} stands {far:.1f} mm from every node"
        yield _finding("forces", view, said, arrow.tail) if far > REACH else None


def anonymous(page: Page) -> Iterator[Finding]:
    """A page whose title block has no designation."""
    block = [t for t in page.rest.texts if t.path and t.path[0][0] == "titleblock"]
    if not any(text.name in DESIGNATIONS and text.string.strip() for text in block):
        yield _finding("anonymous", page.rest, "no designation", 0j)


def paper(page: Page) -> Iterator[Finding]:
    """G1: one format, millimetres, nothing transformed. G2: the frame."""
    size, root = (page.width, page.height), page.root
    (frame,) = [s for s in page.rest.strokes if s.role == "frame"]
    xs, ys = sorted({p.real for p in frame.points}), sorted({p.imag for p in frame.points})
    margin = 10.0 if any(("titleblock", "iso-7200") in s.path for s in page.rest.strokes) else 5.0
    wanted = [20.0, page.width - margin, margin, page.height - margin]
    vectors = root.xpath("//*[@class='vector' or @class='arrow']")
    family = [e for v in vectors for e in (v, *v.iterancestors(), *v.iterdescendants())]
    millimetres = f"{page.width:g}mm", f"{page.height:g}mm"
    for bad, said in (
        (size not in PAGES, f"page of {size}"),
        ((root.get("width"), root.get("height")) != millimetres, "width and height are not the viewBox in mm"),
        (any(e.get("transform") for e in family), "a transformed vector"),
        (max(abs(a - b) for a, b in zip((*xs, *ys), wanted, strict=True)) > 0.01, f"frame {xs} {ys}"),
        (frame.width < 0.5, "a thin frame"),
    ):
        if bad:
            yield _finding("page", page.rest, said, frame.points[0])


def pens(page: Page) -> Iterator[Finding]:
    """G4: weights of strokes, heights of capitals, arrowheads. G7: nothing lighter than 50 % grey."""
    widths = {s.width for v in page.all for s in v.strokes} | {r.width for v in page.all for r in v.rings}
    main, thin = max(widths), min(widths)
    if len(widths) > 3 or not main / 3 - 0.02 <= thin <= main / 2 + 1e-9 or thin < THINNEST[page.width] - 0.001:
        yield _finding("pens", page.rest, f"weights {sorted(widths)}", 0j)
    for view in page.all:
        for text in view.texts:
            yield from (_finding("pens", view, said, _middle(text)) for said in _heights(text, page.width > 800))
    heads = {round(tip.length, 3) for v in page.all for tip in v.tips}
    if len(heads) > 1 or min(heads, default=3.0) < 2.499:
        yield _finding("pens", page.rest, f"arrowheads {heads}", 0j)
    colours = {(key, e.get(key, "none")) for e in page.root.iter() for key in ("stroke", "fill")}
    for key, colour in sorted(colours - {("stroke", "none"), ("fill", "none"), ("fill", "#fff")}):
        if not dark(colour):
            yield _finding("pens", page.rest, f"{key} {colour}", 0j)


def _heights(text: Text, large: bool) -> Iterator[str]:
    capitals = {run.cap for run in text.runs}
    body = max(capitals)
    known = next((height for height in HEIGHTS if abs(body - height) < 0.01), 0.0)
    if not known:
        yield f"{text.string!r} is {body:.2f} high"
    for small in capitals - {body}:
        if abs(small - SCRIPTS.get(known, 0.0)) > 0.001 or small < (2.5 if large else 1.75) - 0.001:
            yield f"a script of {text.string!r} is {small:.2f} high"


def dark(colour: str) -> bool:
    """Whether a colour is still seen when it is printed in grey."""
    digits = colour.lstrip("#")
    digits = "".join(d * 2 for d in digits) if len(digits) == 3 else digits
    r, g, b = (int(digits[i : i + 2], 16) for i in (0, 2, 4))
    return 0.299 * r + 0.587 * g + 0.114 * b <= 128


def words(page: Page) -> Iterator[Finding]:
    """G3: nothing unfilled, one language. G6: its decimal sign, headings, scale factors with number and unit."""
    language = page.root.get("{http://www.w3.org/XML/1998/namespace}lang", "uk")
    for view in page.all:
        for text in view.texts:
            yield from (_finding("words", view, said, _middle(text)) for said in _wording(text, language))
    for view in page.views:
        headings = [t.string for t in view.of("heading")]
        if not headings:
            yield _finding("words", view, "no heading", _corner(view))
        if view.vectors and not any(re.match(r"[^\W\d]_\{\w+\} = [\d,.]+ \(?[^\d\s]", h) for h in headings):
            yield _finding("words", view, f"no scale factor: {headings}", _corner(view))


def _wording(text: Text, language: str) -> Iterator[str]:
    shown = " ".join(run.string for run in text.runs)
    if re.search(r"None|TODO|nan|inf\b|[{}\\]", shown):
        yield f"unfilled: {shown!r}"
    if re.search(FOREIGN[language], shown):
        yield f"foreign letters: {shown!r}"
    if language != "en" and LATIN.search(shown):
        yield f"a Latin word: {shown!r}"
    if re.search(rf"(?<!\w)({OTHERS[language]})(?!\w)", shown):
        yield f"a foreign word: {shown!r}"
    dated = re.search(r"\d\.\d+\.|\.\d+\.", text.string) or text.name in (*DESIGNATIONS, "designation_turned")
    if text.role != "label" and not dated and re.search(r"\d,\d" if language == "en" else r"\d\.\d", text.string):
        yield f"decimal sign: {text.string!r}"


def _room(page: Page) -> tuple[float, float]:
    """How much of the area inside the frame views and blocks take, and the largest bare rectangle in it."""
    inner = _inside(page)
    taken = [*(view.box for view in page.views), *_blocks(page)]
    fill = shapely.union_all(boxes(taken)).intersection(inner).area / inner.area
    return fill, _bare(inner.bounds, np.array(taken)) / inner.area


def _bare(inner: tuple[float, float, float, float], taken: np.ndarray) -> float:
    """Area of the largest rectangle that none of the boxes touches: its sides lie on theirs, or on the frame."""
    x0, y0, x1, y1 = inner
    best = 0.0
    for left in {x0, *taken[:, 2].tolist()}:
        for right in {x1, *taken[:, 0].tolist()}:
            if right <= left or (right - left) * (y1 - y0) <= best:
                continue
            inside = taken[(taken[:, 0] < right) & (taken[:, 2] > left)]
            inside = inside[inside[:, 1].argsort()]
            tops = np.maximum.accumulate(np.append(y0, inside[:, 3]))
            best = max(best, (right - left) * float((np.append(inside[:, 1], y1) - tops).max()))
    return best


def line_of(name: str, sights: Sequence[Sight]) -> str:
    """What a sheet has, in one line."""
    counts = Counter(f.kind for sight in sights for f in sight.findings)
    looked = sum((sight.looked for sight in sights), Counter[str]())
    fills = "/".join(f"{100 * sight.fill:.0f}" for sight in sights)
    bare = "/".join(f"{100 * sight.empty:.0f}" for sight in sights)
    said = " ".join(f"{kind} {counts[kind]}/{looked[kind]}" for kind in KINDS)
    return f"{name:42} {'+'.join(s.format for s in sights):8} fill {fills:8} bare {bare:8} {said}"


def _sheets(asked: argparse.Namespace) -> Iterator[tuple[str, Sheet]]:
    """Read files, or draw what is asked for and read that."""
    import kulman
    from kulman.variants.reader import load_task
    from kulman.variants.shelf import bundled

    if any(task.endswith(".svg") for task in asked.tasks):
        yield asked.tasks[0], read(*(Path(task).read_bytes() for task in asked.tasks))
        return
    for task in asked.tasks or bundled():
        every = list(load_task(task).variants)
        variants = every if asked.variants == "all" else asked.variants.split(",") if asked.variants else every[:1]
        for variant in variants:
            for language in asked.lang.split(","):
                drawn = kulman.sheet(task, variant, lang=language, format=asked.format)
                yield f"{task} {variant} {language}", read_back(drawn)


def main() -> int:
    """Judge; the status is 1 where a sheet has a fault."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tasks", nargs="*", metavar="TASK")
    parser.add_argument("--format", choices=sorted(FILL))
    parser.add_argument("--lang", default="uk", help="one, or several with commas")
    parser.add_argument("--variants", default="", help="all, or names with commas")
    parser.add_argument("-v", dest="each", action="store_true", help="every finding")
    asked = parser.parse_args()
    total: list[Sight] = []
    bad = 0
    for name, sheet in _sheets(asked):
        sights = judged(sheet)
        total += sights
        bad += bool(faults(sheet))
        print(line_of(name, sights), flush=True)
        if asked.each:
            for page, sight in zip(sheet.pages, sights, strict=True):
                for f in sight.findings:
                    print(f"    {f.at.real:6.1f} {page.height - f.at.imag:6.1f}  {f.page} {f.kind} {f.view}: {f.said}")
    counts = Counter(f.kind for sight in total for f in sight.findings)
    print(f"{bad} sheets with faults, {len(total)} pages:", *(f"{kind} {counts[kind]}" for kind in KINDS))
    return bool(bad)


if __name__ == "__main__":
    sys.exit(main())
