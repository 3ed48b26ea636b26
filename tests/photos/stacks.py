"""A stack of photographed sheets as a teacher gets it, and the same answers typed into a table."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from kulman.plans.marking.ways import RIGHT
from kulman.tests.photos.measure import chosen_ways
from kulman.tests.photos.synthesiser import SCANNER, Truth, drawn, photographed, sheet_for

TASK = "nau-slider-crank"
PAGE = 1  # from 0, on which the plans of velocities and accelerations are
MISTAKE = "M24"
SMALL = {"І. Петренко": ("3", ""), "О. Коваль": ("7", MISTAKE)}  # variant and mistake of each student
LETTERS = "АБВГДЕЖЗИКЛМНОПРСТУФХЦЧШЮЯ"  # of students of whom there are thirty pictures
VARIANTS = "012345789"  # of which both plans are on one page
WRONG = "27"  # of which the plans stay on the paper with that mistake
CLASS = {
    f"Студент {one}": (VARIANTS[n % 9], MISTAKE if VARIANTS[n % 9] in WRONG else "") for n, one in enumerate(LETTERS)
}


@dataclass(frozen=True)
class Stack:
    """Files: pictures of a page of each student, the first one twice, some without a name, some that cannot be read.

    `whose` are the numbers in the roster of students whose pictures have no name; `typed` are the same answers typed.
    """

    folder: Path
    pictures: list[Path]
    roster: Path
    typed: Path
    truth: dict[str, dict[str, Truth]]
    whose: dict[str, int]


def stack_of(
    folder: Path, students: dict[str, tuple[str, str]], nameless: int = 1, blurred: int = 1, seed: int = 20
) -> Stack:
    """Draw and photograph a page of each of the students; the last ones have forgotten their names.

    The `seed` is one of which something is asked of the first student of the small stack.
    """
    random, truth, made = np.random.default_rng(seed), dict[str, dict[str, Truth]](), dict[str, bytes]()
    named, whose = len(students) - nameless, dict[str, int]()
    for number, (student, (variant, mistake)) in enumerate(students.items()):
        sheet = sheet_for(TASK, variant)
        names = {sheet.keyed.book.signatures[n].broken.mistake: n for n in range(len(sheet.keyed.book.signatures))}
        ink, truth[student] = drawn(sheet, PAGE, random, chosen_ways(sheet, names[mistake] if mistake else RIGHT))
        name = f"{student}-2.jpg" if number < named else f"IMG_{2001 + number - named}.jpg"
        made[name] = photographed(ink, random, SCANNER)
        if number == 0:
            made[f"{student}-2 (1).jpg"] = photographed(ink, random, SCANNER)
        if number >= named:
            whose[name] = number
    grey = cv2.imdecode(np.frombuffer(made[name], np.uint8), cv2.IMREAD_GRAYSCALE)
    for number in range(blurred):
        faint = cv2.GaussianBlur(cv2.resize(grey, None, fx=0.3, fy=0.3), (0, 0), 12 + number)
        made[f"IMG_{2001 + nameless + number}.jpg"] = bytes(cv2.imencode(".jpg", faint)[1].tobytes())
    pictures = [folder / name for name in made]
    for file in pictures:
        file.write_bytes(made[file.name])
    listed = "".join(f"{student};АТ-301;{variant}\n" for student, (variant, _) in students.items())
    (roster := folder / "roster.csv").write_text(f"student;group;variant\n{listed}", encoding="utf-8")
    (typed := folder / "typed.csv").write_text(_typed(students, truth), encoding="utf-8")
    return Stack(folder, pictures, roster, typed, truth, whose)


def _typed(students: dict[str, tuple[str, str]], truth: dict[str, dict[str, Truth]]) -> str:
    """What these students have drawn, measured and typed: segments and directions, with the scale factors printed."""
    sheets = {student: sheet_for(TASK, variant) for student, (variant, _) in students.items()}
    first = next(iter(sheets.values()))
    plan_of = {name: one.plan for own in truth.values() for name, one in own.items()}
    names = [name for name in plan_of if first.keyed.key.questions.get(name)]
    plans = sorted({plan_of[name] for name in names})
    scales = {plan: first.keyed.solution.solved.scale_of_plan[plan] for plan in plans}
    rows = [["student", *scales.values(), *(head for name in names for head in (f"{name}.mm", f"{name}.dir"))]]
    for student, sheet in sheets.items():
        row = [student, *(f"{sheet.mus[plan]:g}" for plan in plans)]
        for name in names:
            own = truth[student].get(name)  # a plan may be on another page
            way = own.tip - own.tail if own else None
            row += [f"{abs(way):.1f}", f"{math.degrees(cmath.phase(way)) % 360:.0f}"] if way is not None else ["", ""]
        rows.append(row)
    return "".join(";".join(row) + "\n" for row in rows)
