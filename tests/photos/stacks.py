"""A small stack of photographed sheets as a teacher gets it, and the same answers typed into a table."""

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
ROSTER = "student;group;variant\nІ. Петренко;АТ-301;3\nО. Коваль;АТ-301;7\n"
PAGE = 1  # from 0, on which the plans of velocities and accelerations are
MISTAKE = "M24"


@dataclass(frozen=True)
class Stack:
    """Files: two photographs of one page, one without a name, one that cannot be read; a roster; the same typed."""

    folder: Path
    pictures: list[Path]
    roster: Path
    typed: Path
    truth: dict[str, dict[str, Truth]]


def small_stack(folder: Path) -> Stack:
    """Draw and photograph it."""
    random, truth, inks = np.random.default_rng(11), dict[str, dict[str, Truth]](), {}
    for variant, mistake in (("3", ""), ("7", MISTAKE)):
        sheet = sheet_for(TASK, variant)
        names = {sheet.keyed.book.signatures[n].broken.mistake: n for n in range(len(sheet.keyed.book.signatures))}
        ways = chosen_ways(sheet, names[mistake] if mistake else RIGHT)
        inks[variant], truth[variant] = drawn(sheet, PAGE, random, ways)
    made = {
        "І. Петренко-2.jpg": photographed(inks["3"], random, SCANNER),
        "І. Петренко-2 (1).jpg": photographed(inks["3"], random, SCANNER),
        "IMG_2001.jpg": photographed(inks["7"], random, SCANNER),
    }
    grey = cv2.imdecode(np.frombuffer(made["IMG_2001.jpg"], np.uint8), cv2.IMREAD_GRAYSCALE)
    blurred = cv2.GaussianBlur(cv2.resize(grey, None, fx=0.3, fy=0.3), (0, 0), 12)
    made["IMG_2002.jpg"] = bytes(cv2.imencode(".jpg", blurred)[1].tobytes())
    pictures = [folder / name for name in made]
    for file in pictures:
        file.write_bytes(made[file.name])
    (roster := folder / "roster.csv").write_text(ROSTER, encoding="utf-8")
    (typed := folder / "typed.csv").write_text(_typed(truth), encoding="utf-8")
    return Stack(folder, pictures, roster, typed, truth)


def _typed(truth: dict[str, dict[str, Truth]]) -> str:
    """What these students have drawn, measured and typed: segments and directions, with the scale factors printed."""
    names = [name for name in truth["3"] if name in truth["7"] and sheet_for(TASK, "3").keyed.key.questions.get(name)]
    plans = sorted({truth["3"][name].plan for name in names})
    scales = {plan: sheet_for(TASK, "3").keyed.solution.solved.scale_of_plan[plan] for plan in plans}
    rows = [["student", *scales.values(), *(head for name in names for head in (f"{name}.mm", f"{name}.dir"))]]
    for student, variant in (("І. Петренко", "3"), ("О. Коваль", "7")):
        row = [student, *(f"{sheet_for(TASK, variant).mus[plan]:g}" for plan in plans)]
        for name in names:
            way = truth[variant][name].tip - truth[variant][name].tail
            row += [f"{abs(way):.1f}", f"{math.degrees(cmath.phase(way)) % 360:.0f}"]
        rows.append(row)
    return "".join(";".join(row) + "\n" for row in rows)
