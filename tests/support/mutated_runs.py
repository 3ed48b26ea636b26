"""Runs mutated cases in process, one after another, with bounds on time and memory, and says which of them fail.

The whole, on one core:

    python -m kulman.tests.support.mutated_runs --cases 200000
    python -m kulman.tests.support.mutated_runs --cases 5000 --family drawn
    python -m kulman.tests.support.mutated_runs --cases 5000 --family classes

Each fault is shown with the number of its case; `--case N` (and its family) writes the files of a case into the folder
where it runs, shows the command, and runs it.
"""

from __future__ import annotations

import argparse
import io
import json
import multiprocessing
import os
import resource
import signal
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import chdir
from dataclasses import dataclass
from pathlib import Path
from types import FrameType

from kulman import cli
from kulman.plans.lab.race import FULL
from kulman.tests.support import mutated
from kulman.tests.support.mutated import FAMILIES, Case, lay_out, made
from kulman.variants.making import new_variants

SECONDS = 5.0  # of processor time
MEMORY = 500_000_000  # bytes
TRIES = 2  # sets of data, each drawn, until the search for good exercises gives up
SHOWN = 1000  # cases after which a long run says how far it is
CHUNK = 250  # cases a process, so that what one leaves behind is not another's


class TooLongError(BaseException):
    """A case has taken more processor time than it may; not caught by what catches exceptions."""


@dataclass(frozen=True)
class Fault:
    """What is wrong with a case: one line, and where it was raised."""

    n: int
    what: str
    where: str
    line: str
    trace: str = ""


def run(case: Case) -> tuple[int, str, str]:
    """Run a case in the working folder: its status, its output, its errors.

    Warnings are errors.
    """
    out, err = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8", newline="") for _ in range(2))
    kept, os.environ["LC_ALL"] = (sys.stdout, sys.stderr), case.language
    sys.stdout, sys.stderr = out, err
    status: object = None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            cli.main(case.arguments)
    except SystemExit as stopped:
        status = stopped.code
    finally:
        sys.stdout, sys.stderr = kept
    for stream in (out, err):
        stream.flush()
    said, errors = (stream.buffer.getvalue().decode("utf-8", "surrogatepass") for stream in (out, err))  # type: ignore[attr-defined]
    return status if isinstance(status, int) else -1, said, errors


def judged(case: Case, status: int, out: str, err: str) -> str:
    """Return what is wrong with how a case ended; nothing where all is well."""
    if status not in (0, 2, 3, 4):
        return f"status {status}"
    if status and not err.strip():
        return "refused without a word"
    if any(len(line) > 2000 for line in err.splitlines()):
        return "a line of errors that nobody reads"
    if "Traceback" in err or "Warning" in err:
        return "a traceback or a warning on stderr"
    if "--json" in case.arguments and out:
        json.loads(out)  # alone on stdout
    return ""


def tried(n: int, family: str, seconds: float) -> Fault | None:
    """Run case `n` in a folder of its own: its fault, None where it is well and takes no more processor time."""

    def stop(number: int, frame: FrameType | None) -> None:
        raise TooLongError

    case = made(n, family)
    signal.signal(signal.SIGPROF, stop)
    what = where = trace = ""
    with tempfile.TemporaryDirectory() as folder, chdir(folder):
        lay_out(case, Path())
        signal.setitimer(signal.ITIMER_PROF, seconds)
        try:
            what = judged(case, *run(case))
        except (Exception, TooLongError) as problem:
            places = [f"{frame.filename}:{frame.lineno}" for frame in traceback.extract_tb(problem.__traceback__)]
            what, where = (
                f"{type(problem).__name__}: {problem}"[:200],
                next((place for place in reversed(places) if "kulman" in place or "/tests/" not in place), ""),
            )
            trace = "".join(traceback.format_exception(problem)[-12:])
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0.0)
    return Fault(n, what, where, case.line, trace) if what else None


def _data() -> int:
    """Return the bytes of data that this process has."""
    status = Path("/proc/self/status").read_text(encoding="ascii")
    return next(int(line.split()[1]) * 1024 for line in status.splitlines() if line.startswith("VmData"))


def _chunk(numbers: range, family: str, seconds: float) -> list[Fault]:
    most_data = _data() + MEMORY  # beside what the forked process has of its parent
    resource.setrlimit(resource.RLIMIT_DATA, (most_data, most_data))
    most = int(seconds * (len(numbers) + 2) + time.process_time())
    resource.setrlimit(resource.RLIMIT_CPU, (most, most))  # of what does not even hear the alarm
    new_variants.TRIES = TRIES
    object.__setattr__(FULL, "batches", (1, 10, 100))  # races are run at length, to measure times
    object.__setattr__(FULL, "at_once", 100)
    return [fault for n in numbers if (fault := tried(n, family, seconds)) is not None]


def faults(
    numbers: range, family: str = "solved", method: str = "forkserver", seconds: float = SECONDS
) -> Iterator[Fault]:
    """Run the cases with these numbers, a process for each `CHUNK` of them, started by this method of Python's.

    A plain fork of a process that has written a note waits for ever: the threads of typst are not in the copy.
    """
    context = multiprocessing.get_context(method)
    context.set_forkserver_preload(["kulman.cli", mutated.__name__, new_variants.__name__])  # not this: it may be run
    size = CHUNK if family == "solved" else CHUNK // 5
    for start in range(numbers.start, numbers.stop, size):
        with ProcessPoolExecutor(1, mp_context=context) as pool:
            chunk = range(start, min(start + size, numbers.stop))
            yield from pool.submit(_chunk, chunk, family, seconds).result()


def _alone(n: int, family: str) -> None:
    """Write the files of a case here, show its command, run it."""
    case = made(n, family)
    lay_out(case, Path())
    print(case.line, flush=True)
    print(*run(case), sep="\n")


def main() -> None:
    """Run cases as the command line says, and count their faults by kind."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=1000, help="how many")
    parser.add_argument("--first", type=int, default=0, help="the number of the first")
    parser.add_argument("--case", type=int, help="this one alone, here")
    parser.add_argument("--family", choices=FAMILIES, default="solved", help="those that calculate, or others")
    said = parser.parse_args()
    if said.case is not None:
        return _alone(said.case, said.family)
    kinds: Counter[tuple[str, str]] = Counter()
    last = said.first + said.cases
    for start in range(said.first, last, SHOWN):
        for fault in faults(range(start, min(start + SHOWN, last)), said.family):
            kind = fault.what.partition(":")[0], fault.where
            kinds[kind] += 1
            more = f"\n    {fault.line}\n{fault.trace}" if kinds[kind] == 1 else ""
            print(f"case {fault.n}: {fault.what} ({fault.where}){more}", flush=True)
        print(f"{min(start + SHOWN, last) - said.first} cases, {sum(kinds.values())} faults", flush=True)
    for (what, where), count in kinds.most_common():
        print(f"{count:6} {what}  {where}")


if __name__ == "__main__":
    main()
