"""Simulate students for the tables of the guide to marking: `.venv/bin/python docs/marking_tables.py [count]`.

`count` students a mistake, 40 when left out, on two processes. What is counted is told in
tests/support/students.py; the same seeds draw the same students.
"""

from __future__ import annotations

import random
import sys
from collections import defaultdict
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from kulman.tests.support.students import SEED, SLIPS, Outcome, marked, population, share
from kulman.variants.marking.wording import mistake_texts

DOCUMENT = Path(__file__).resolve().parent.parent / "variants" / "guides" / "marking.en.md"
BEGIN, END = "<!-- students: docs/marking_tables.py -->", "<!-- end -->"
PARTS = 8  # of the variants, marked one after the other
TASKS = ("nau-slider-crank", "scheme-09-shaper")  # with several variants
AIMS = {
    "lines of honest students that pass": "at least 99.5",
    "first wrong step": "at least 96",
    "mistake named first": "at least 85",
    "a wrong name first": "at most 4",
    "unnoticed": "at most 2",
    "two mistakes: both named first": "at least 80",
    "without directions: first wrong step": "at least 85",
    "random numbers: mark of 100": "at most 10",
    "another variant's sheet: mark of 100": "at most 20",
    "another variant's sheet: said so": "always",
}


Found = dict[str, dict[str, list[Outcome]]]  # by group, by mistake or task


def job(of: tuple[int, int]) -> list[tuple[str, str, Outcome]]:
    """Draw and mark the students who have a part of the variants: how many a mistake, number of the part."""
    count, part = of
    ids = sorted({slip.id for slips in SLIPS.values() for slip in slips}, key=lambda id: int(id[1:]))
    each, some = -(-count // PARTS), -(-count // (4 * PARTS))
    kinds = [("one", id, each) for id in ids] + [("sizes", id, some) for id in ids]
    kinds += [(group, task, 2 * each) for task in SLIPS for group in ("honest", "two", "random")]
    kinds += [("other", task, 2 * each) for task in TASKS]
    drawn = [
        (group, name, student)
        for group, name, number in kinds
        for student in population(group, name, number, random.Random(f"{SEED} {group} {name} {part}"), (part, PARTS))
    ]
    outcomes = marked(student for *_, student in drawn)
    return [(group, name, outcome) for (group, name, _), outcome in zip(drawn, outcomes, strict=True)]


def measured(count: int) -> Found:
    """Return what became of all students by group and kind."""
    found: Found = defaultdict(lambda: defaultdict(list))
    with ProcessPoolExecutor(2) as processes:
        for outcomes in processes.map(job, [(count, part) for part in range(PARTS)]):
            for group, name, outcome in outcomes:
                found[group][name].append(outcome)
    return found


def rates(found: Found) -> dict[str, float]:
    """Return what is promised, in the order of AIMS, in percent or marks."""
    flat = {group: [one for some in by_name.values() for one in some] for group, by_name in found.items()}
    honest, one, other = flat["honest"], flat["one"], flat["other"]
    numbers = (
        100.0 * sum(x.passed for x in honest) / sum(x.lines for x in honest),
        share(one, lambda x: x.step),
        share(one, lambda x: x.named),
        share(one, lambda x: bool(x.names) and not x.named),
        share(one, lambda x: not x.first),
        share(flat["two"], lambda x: x.named),
        share(flat["sizes"], lambda x: x.step),
        sum(x.mark for x in flat["random"]) / len(flat["random"]),
        sum(x.mark for x in other) / len(other),
        share(other, lambda x: bool(x.fits)),
    )
    return dict(zip(AIMS, numbers, strict=True))


def table(found: Found) -> str:
    """Return both tables."""
    flat = {group: sum(map(len, by_name.values())) for group, by_name in found.items()}
    rows = [
        f"{sum(flat.values())} students, of whom {flat['one']} with one mistake and {flat['honest']} without any.",
        "",
    ]
    rows += ["| | reached | wanted |", "|---|---|---|"]
    rows += [f"| {name} | {value:.1f} | {AIMS[name]} |" for name, value in rates(found).items()]
    rows += ["", "| mistake | students | first step | named | wrong name | unnoticed |", "|---|---|---|---|---|---|"]
    rows += [_row(id, outcomes) for id, outcomes in found["one"].items()]
    return "\n".join(rows)


def _row(id: str, outcomes: Sequence[Outcome]) -> str:
    shares = (
        share(outcomes, lambda x: x.step),
        share(outcomes, lambda x: x.named),
        share(outcomes, lambda x: bool(x.names) and not x.named),
        share(outcomes, lambda x: not x.first),
    )
    text = mistake_texts("en").get(id, "")
    return f"| {f'{id} {text}'.strip()} | {len(outcomes)} | {' | '.join(f'{x:.0f}' for x in shares)} |"


def main(count: int = 40) -> None:
    """Rewrite what stands between the marks."""
    text = DOCUMENT.read_text(encoding="utf-8")
    head, _, rest = text.partition(BEGIN)
    _, _, tail = rest.partition(END)
    DOCUMENT.write_text(f"{head}{BEGIN}\n{table(measured(count))}\n{END}{tail}", encoding="utf-8")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
