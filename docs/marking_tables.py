"""Simulate students for the tables of the guide to marking: `.venv/bin/python docs/marking_tables.py [count]`.

`count` students a mistake, 40 when left out, on two processes. What is counted is told in
tests/support/students.py; the same seeds draw the same students.
"""

from __future__ import annotations

import random
import re
import sys
from collections import defaultdict
from concurrent.futures import ProcessPoolExecutor

from kulman.docs.refresh import GUIDES, language
from kulman.tests.support.students import SEED, SLIPS, Outcome, marked, population, share
from kulman.variants.marking.wording import mistake_texts

DOCUMENTS = [path for path in GUIDES if path.name.startswith("marking.")]
RATES, MISTAKES, END = "<!-- rates: docs/marking_tables.py -->\n", "<!-- mistakes -->\n", "<!-- end -->"
PARTS = 8  # of the variants, marked one after the other
TASKS = ("nau-slider-crank", "scheme-09-shaper")  # with several variants


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


def rates(found: Found) -> list[float]:
    """Return what is promised, in the order of the rows of the guides, in percent or marks."""
    flat = {group: [one for some in by_name.values() for one in some] for group, by_name in found.items()}
    honest, one, other = flat["honest"], flat["one"], flat["other"]
    return [
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
    ]


def filled(text: str, found: Found, language: str) -> str:
    """Return a guide with the numbers of today: in its own rows of rates, and in a row for each mistake."""
    numbers = iter(f"{value:.1f}" if language == "en" else f"{value:.1f}".replace(".", ",") for value in rates(found))
    head, _, rest = text.partition(RATES)
    table, _, rest = rest.partition(END)
    between, _, rest = rest.partition(MISTAKES)
    title, tail = rest[: rest.index("| M")], rest.partition(END)[2]
    table = re.sub(r"(?<=\| )[\d.,]+(?= \| )", lambda _: next(numbers), table)
    rows = [
        f"| {id} {words} | {_shares(found['one'].get(id, []))} |\n" for id, words in mistake_texts(language).items()
    ]
    return "".join((head, RATES, table, END, between, MISTAKES, title, *rows, END, tail))


def _shares(outcomes: list[Outcome]) -> str:
    shares = (share(outcomes, lambda x: x.step), share(outcomes, lambda x: x.named)) if outcomes else ()
    return " | ".join(f"{x:.0f}" for x in shares) or "– | –"


def main(count: int = 40) -> None:
    """Rewrite what stands between the marks of the guides."""
    found = measured(count)
    for path in DOCUMENTS:
        path.write_text(filled(path.read_text(encoding="utf-8"), found, language(path)), encoding="utf-8")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
