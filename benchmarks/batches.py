"""What `kulman batch` takes for a student, sheet as SVG and PDF and the note: `make speed` shows it.

Alone it draws a whole class, on one core and on two: `python benchmarks/batches.py 1000`; with `own` behind it
everybody has other data.
"""

from __future__ import annotations

import csv
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

TASK = "nau-slider-crank"
VARIANTS = 10  # of which the last digit of a record book chooses one
STUDENTS, OWN = 110, 17
ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}


@dataclass(frozen=True, slots=True)
class Spent:
    """Seconds of the processor and of the clock, and the peak memory of the largest process, MB."""

    processor: float
    clock: float
    memory: float


def roster(file: Path, count: int, own: bool) -> Path:
    """Write a roster: all variants in turn by record books; with `own` everybody has another angle of the crank."""
    with file.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, delimiter=";")
        writer.writerow(["студент", "група", "залікова книжка", *(["phi [град]"] if own else [])])
        for number in range(1, count + 1):
            angle = [f"{30.0 + 0.01 * number:.2f}"] if own else []
            writer.writerow([f"Студент {number:04d}", f"АКФ-{301 + number % 4}", f"КБ-{20230000 + number}", *angle])
    return file


def drawn(folder: Path, count: int, jobs: int, own: bool = False) -> Spent:
    """Draw a class into a folder."""
    import resource

    file = roster(folder / f"class-{count}-{own}.csv", count, own)
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    out = folder / f"{count}-{jobs}-{own}"
    command = (
        sys.executable,
        "-m",
        "kulman",
        "batch",
        TASK,
        "--roster",
        str(file),
        "--out",
        str(out),
        "--jobs",
        str(jobs),
    )
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=ENVIRONMENT)
    clock, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    assert len(list(out.glob("*.pdf"))) == 2 * count
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Spent(processor, clock, after.ru_maxrss / 1024)


def each(folder: Path, count: int, own: bool = False) -> tuple[Spent, Spent, float]:
    """Draw a class on one core and on two; return both, and the seconds of the processor for a student.

    Those of a class of one student of each variant are taken off, so that neither start-up counts nor the drawings that
    the others share; where nobody shares anything, those of a class of one.
    """
    one, two = (drawn(folder, count, jobs, own) for jobs in (1, 2))
    few = 1 if own else VARIANTS
    return one, two, (one.processor - drawn(folder, few, 1, own).processor) / (count - few)


def students() -> Iterator[tuple[str, float, float]]:
    """Go through the classes: what they are, the seconds that a student takes, how many times two cores are as fast."""
    with tempfile.TemporaryDirectory() as folder:
        for count, own, kind in ((STUDENTS, False, "a variant each"), (OWN, True, "data of one's own")):
            one, two, taken = each(Path(folder), count, own)
            yield f"`kulman batch`, SVG, PDF and note of a student, {kind}", taken, one.clock / two.clock


def main(count: int, own: bool) -> None:
    """Draw a class and print what it takes."""
    with tempfile.TemporaryDirectory() as folder:
        one, two, taken = each(Path(folder), count, own)
    for jobs, spent in ((1, one), (2, two)):
        said = f"{spent.processor:.1f} s of the processor, {spent.clock:.1f} s, {spent.memory:.0f} MB"
        print(f"{count} students, {jobs} at a time: {said}; {spent.processor / count * 1e3:.1f} ms each")
    print(f"a further student: {taken * 1e3:.1f} ms of the processor; two cores: {one.clock / two.clock:.2f} times one")


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2:] == ["own"])
