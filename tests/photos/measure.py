"""How well photographs are read: `make photos`, or `python -m kulman.tests.photos.measure [STUDENTS] [TASK ...]`.

Students draw all plans of a task, some with one mistake of the book; their sheets are photographed at three qualities
and marked. Printed are, by quality and by task: pages found; vectors of 5 mm and more that were read; how far their
ends are from where their strokes end on paper; vectors read confidently and wrongly; lines of honest students that are
right; mistakes that are named first, of all and of those that exact readings name; time of the processor for reading
and marking a page.
"""

from __future__ import annotations

import math
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from kulman.plans.marking.answers import Verdict
from kulman.plans.marking.ways import RIGHT, Shape
from kulman.scales.errors import KulmanError
from kulman.tests.photos.synthesiser import QUALITIES, Random, Sheet, Truth, drawn, photographed, sheet_for
from kulman.variants.marking.checks import check
from kulman.variants.marking.marked import Desk, Marked
from kulman.variants.photos.pictures import read_photos
from kulman.variants.photos.reading import on_page
from kulman.variants.shelf import bundled

LONG, WRONG = 5.0, 1.5  # mm: vectors that must be found; how far an end that is read wrongly lies from where it is
CLEAR = 2.0  # tolerances by which a mistake moves a line at least, or it cannot be seen
PLANTED = 0.4  # part of the students that make a mistake


@dataclass
class Figures:
    """What is counted."""

    pages: int = 0
    found_pages: int = 0
    vectors: int = 0
    read: int = 0
    wrong: int = 0
    misses: list[float] = field(default_factory=list)
    honest: int = 0
    honest_right: int = 0
    planted: int = 0
    named: int = 0
    tellable: int = 0  # planted mistakes that are named first where every vector is told as it was drawn
    told: int = 0  # of these named first
    alarms: int = 0
    students: int = 0
    seconds: float = 0.0

    def add(self, other: Figures) -> None:
        for name in self.__dataclass_fields__:
            setattr(self, name, getattr(self, name) + getattr(other, name))

    def __str__(self) -> str:
        part = lambda a, b: f"{100 * a / b:5.1f}" if b else "    –"  # noqa: E731
        miss = f"{np.percentile(self.misses, 50):.2f} {np.percentile(self.misses, 95):.2f}" if self.misses else "–"
        return (
            f"{self.students:3} students, pages {part(self.found_pages, self.pages)} % of {self.pages:3}, "
            f"vectors {part(self.read, self.vectors)} % of {self.vectors:4}, ends 50/95 % {miss} mm, "
            f"wrongly {part(self.wrong, self.read)} %, honest right {part(self.honest_right, self.honest)} %, "
            f"named first {part(self.named, self.planted)} % of {self.planted:2}, of tellable ones "
            f"{part(self.told, self.tellable)} % of {self.tellable:2}, false alarms {self.alarms}, "
            f"{self.seconds / max(self.pages, 1):.1f} s a page"
        )


def chosen_ways(sheet: Sheet, mistake: int) -> dict[str, Shape]:
    """Return each plan as it is drawn with a mistake, by its number in the book."""
    ways = {plan: sheet.ways(plan, mistake != RIGHT) for plan in sheet.plans}
    return {plan: next((way for way in some if way.explained(mistake)), some[0]) for plan, some in ways.items()}


def look_alike(sheet: Sheet, one: int, other: int) -> bool:
    """Whether all plans look the same with two mistakes: each line of the one is a line of the other, as hands draw.

    The vectors have no names on paper.
    """
    ways, others, tolerance = chosen_ways(sheet, one), chosen_ways(sheet, other), sheet.keyed.key.tolerance
    for plan in sheet.plans:
        ends = [np.stack((w.places[w.tails], w.places[w.tips])) / sheet.mus[plan] for w in (ways[plan], others[plan])]
        apart = np.abs(ends[0][:, :, None] - ends[1][:, None, :]).max(axis=0)
        for way, nearest in ((ends[0], apart.min(axis=1)), (ends[1], apart.min(axis=0))):
            if (nearest > CLEAR * np.maximum(tolerance.mm, tolerance.part * np.abs(way[1] - way[0]))).any():
                return False
    return True


def visible(sheet: Sheet, mistake: int) -> bool:
    """Whether a mistake changes clearly what is drawn of some plan, and leaves all on their pages."""
    for plan, way in chosen_ways(sheet, mistake).items():
        page, pole = sheet.poles[plan]
        ends = pole + way.places / sheet.mus[plan]
        size = sheet.pages[page].width, sheet.pages[page].height
        if not ((ends.real > 22) & (ends.real < size[0] - 10) & (ends.imag > 32) & (ends.imag < size[1] - 10)).all():
            return False
    return not look_alike(sheet, mistake, RIGHT)


def mistakes_of(sheet: Sheet) -> list[int]:
    """Return the numbers of mistakes that can be planted."""
    return [number for number in range(len(sheet.keyed.book.signatures)) if visible(sheet, number)]


def student(sheet: Sheet, quality: str, random: Random, mistake: int, folder: Path, stem: str = "student") -> Figures:
    """Draw, photograph and mark the sheets of one student."""
    ways, files, truth = chosen_ways(sheet, mistake), list[Path](), dict[str, Truth]()
    for number in sorted({page for page, _ in sheet.poles.values()}):
        ink, own = drawn(sheet, number, random, ways)
        truth |= own
        files.append(folder / f"{stem}-{number + 1}.jpg")
        files[-1].write_bytes(photographed(ink, random, quality))
    figures = Figures(students=1, pages=len(files))
    ready = check(sheet.case.task, sheet.case.variant, lang="en")
    desk = Desk(ready)
    begun = time.process_time()
    found = [photo for file in files for photo in read_photos(file)]
    figures.found_pages = len(found)
    answers = replace(ready.read(str(files[0]))[0], photos=tuple(found))
    try:
        marked = desk.mark(answers)
    except KulmanError as error:
        print("   ", stem, quality, error, file=sys.stderr)
        marked = None
    figures.seconds = time.process_time() - begun
    compared(figures, sheet, truth, marked, mistake)
    if mistake != RIGHT and marked is not None:
        ends = {name: (one.tail, one.tip) for name, one in truth.items() if name in sheet.keyed.key.questions}
        figures.tellable = is_named(sheet, mistake, desk.mark(replace(answers, told=ends)))
        figures.told = figures.tellable * figures.named
        planted = sheet.keyed.book.signatures[mistake].broken
        print("    planted", planted.mistake, figures.named, figures.tellable, file=sys.stderr)
    return figures


def is_named(sheet: Sheet, mistake: int, marked: Marked | None) -> bool:
    """Whether a mistake is named first, or one that answers cannot tell from it, or that is drawn as it is."""
    if not marked or not marked.candidates:
        return False
    first, signatures = marked.candidates[0], sheet.keyed.book.signatures
    if signatures[mistake].broken.mistake in {one.mistake for one in first.mistakes} | first.ids:
        return True
    places = {one.place for one in first.mistakes} if len(first.mistakes) == 1 else ()
    return any(one.broken.place in places and look_alike(sheet, mistake, n) for n, one in enumerate(signatures))


def compared(figures: Figures, sheet: Sheet, truth: dict[str, Truth], marked: Marked | None, mistake: int) -> None:
    """Count what was read of what was drawn."""
    read = marked.seen.recognised.vectors if marked and marked.seen else {}
    verdicts = {line.name: line.verdict for line in marked.lines} if marked else {}
    for name, one in truth.items():
        question = sheet.keyed.key.questions.get(name)
        if abs(one.tip - one.tail) < LONG or question is None or not question.vector:  # a moment's force is a number
            continue
        figures.vectors += 1
        if name not in read or read[name].plan != one.plan or not marked or not marked.sheets:
            continue
        figures.read += 1
        ends = [on_page(marked.sheets, end) for end in (read[name].tail, read[name].tip)]
        off = [abs(at - end) for (_, at), end in zip(ends, (one.tail, one.tip), strict=True)]
        span = abs((ends[1][1] - ends[0][1]) - (one.tip - one.tail))
        figures.misses += off
        if span > WRONG:
            figures.wrong += 1
            print("    wrong", name, one, ends, file=sys.stderr)
        if mistake == RIGHT and name in verdicts:
            figures.honest += 1
            good = verdicts[name] in (Verdict.RIGHT, Verdict.CARRIED, Verdict.SMALL)
            figures.honest_right += good
            if not good:
                line = next(line for line in marked.lines if line.name == name)
                print(
                    "    honest",
                    name,
                    line.verdict,
                    line.about,
                    round(abs(one.tip - one.tail), 1),
                    off,
                    file=sys.stderr,
                )
    if mistake == RIGHT:
        figures.alarms += bool(marked and marked.candidates and marked.candidates[0].mistakes)
    else:
        figures.planted += 1
        figures.named += is_named(sheet, mistake, marked)


def measured(tasks: list[str], count: int, seed: int = 1) -> Iterator[tuple[str, str, Figures]]:
    """Go through so many students: task, quality, figures of each."""
    random = np.random.default_rng(seed)
    with tempfile.TemporaryDirectory() as folder:
        for number in range(count):
            turn = number // math.lcm(len(tasks), len(QUALITIES))  # so that every task comes at every quality
            task, quality = tasks[number % len(tasks)], QUALITIES[(number + turn) % len(QUALITIES)]
            sheet, mistake = sheet_for(task), RIGHT
            if random.random() < PLANTED and (some := mistakes_of(sheet)):
                kinds = [sheet.keyed.book.signatures[one].broken.mistake for one in some]
                kind = random.choice(sorted({*kinds}))
                mistake = int(random.choice([one for one, own in zip(some, kinds, strict=True) if own == kind]))
            for file in Path(folder).iterdir():
                file.unlink()
            yield task, quality, student(sheet, quality, random, mistake, Path(folder), f"student{number}")


def linkages() -> list[str]:
    """Return the bundled tasks about linkages."""
    return [*bundled("mechanism")]


def main(count: str = "30", *tasks: str) -> None:
    """Measure and print."""
    by_quality, by_task = defaultdict[str, Figures](Figures), defaultdict[str, Figures](Figures)
    for task, quality, figures in measured(list(tasks) or linkages(), int(count)):
        print(f"{task:24} {quality:10} {figures}", flush=True)
        by_quality[quality].add(figures)
        by_task[task].add(figures)
    for name, figures in (*by_quality.items(), *by_task.items()):
        print(f"{name:24} {figures}")


if __name__ == "__main__":
    main(*sys.argv[1:])
