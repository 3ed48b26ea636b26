"""One four-bar and one slider-crank, the same angles, in one run: Kulman beside other packages and closed forms.

    python -m venv /tmp/peers && /tmp/peers/bin/pip install . "pylinkage[numba]" mechanism
    make bench PEERS=/tmp/peers/bin/python
    /tmp/peers/bin/python benchmarks/peers.py limits

Each contestant runs in a process of its own and is left out, with a word, where it is not installed. The second table,
`limits`, is of what is returned where the four-bar has no position, or two.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
import time
import warnings
from collections.abc import Callable

from contestants import CODES, CONTESTANTS, Motion
from mechanisms import CRANK, FRAME, MECHANISMS, ROCKER, ROD
from oracle import SAMPLES, worst

LONG = {"l_AB": 0.38}  # a crank with which B around 180 degrees is too far from D for BC and DC to meet
PARALLELOGRAM = {"l_BC": FRAME, "l_DC": CRANK}  # has its change points at 0 and 180 degrees
RUNS = 5


def timed(work: Callable[[], object], runs: int = RUNS) -> float:
    """Return the shortest time of a call on the processor: other users of the machine make it longer only."""
    times = []
    for _ in range(runs):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return min(times)


def speed(solve: Callable[..., Motion], count: int) -> list[str]:
    """Return for each mechanism positions per second with their worst error, and the same with derivatives."""
    cells = []
    for which in MECHANISMS:
        for motion in (False, True):
            solve(which, SAMPLES, motion)  # compiles where there is something to compile
            taken = timed(lambda: solve(which, count, motion))  # noqa: B023
            found = [values for values in solve(which, count, motion) if values is not None]
            cells.append(f"{count / taken:.2g} ({max(worst(tuple(found), which)):.0e})")
    return cells


def limits(solve: Callable[..., Motion], _: int) -> list[str]:
    """Return what a contestant says of links that do not reach, and of a change point."""
    return [beyond(solve), changing(solve)]


def beyond(solve: Callable[..., Motion]) -> str:
    """Say what a contestant returns where the links do not reach, at 180 degrees, and afterwards."""
    C = solve("four-bar", 360, False, **LONG)[0]
    back = "" if abs(abs(C[359] - FRAME) - ROCKER) < 1e-6 else ", and after it where they reach again"
    if math.isnan(abs(C[179])):
        return f"NaN{status(179)}{back}"
    rod, rocker = abs(C[179] + LONG["l_AB"]), abs(C[179] - FRAME)
    return f"links of {rod * 1e3:.0f} and {rocker * 1e3:.0f} mm instead of {ROD * 1e3:.0f} and {ROCKER * 1e3:.0f}{back}"


def changing(solve: Callable[..., Motion]) -> str:
    """Say what a contestant returns in the change point of a parallelogram, at 180 degrees, and after it."""
    C, V, _ = solve("four-bar", 360, True, **PARALLELOGRAM)
    speed = "V_C NaN" if math.isnan(abs(V[179])) else f"V_C {abs(V[179]):.4g} m/s"
    parallel = abs(C[269] - (FRAME - 1j * CRANK)) < 1e-6
    return f"{speed}{status(179)}; then {'parallel' if parallel else 'crossed'} links"


def status(index: int) -> str:
    """Return the status that Kulman gave to a position of its last run."""
    if not CODES:
        return ""
    from kulman.plans.boards.exact import STATUSES

    return f", status {STATUSES[CODES[-1][index]]}"


TABLES = {
    "speed": (
        speed,
        ("four-bar, positions/s", "with V and a", "slider-crank, positions/s", "with V and a"),
        "States per second on one core; in brackets the largest error of C, V_C, a_C as a part of the largest value.",
    ),
    "limits": (limits, ("links that do not reach", "change point of a parallelogram"), ""),
}


def contest(name: str, table: str) -> None:
    """Run one contestant and print its cells."""
    solve, count = CONTESTANTS[name]
    if name == "pylinkage":
        sys.modules["numba"] = None  # type: ignore[assignment]
    elif "numba" in name:
        import numba  # noqa: F401  without it the compiled pylinkage is not there
    warnings.simplefilter("ignore")
    print(json.dumps(TABLES[table][0](solve, count)))


def main(table: str) -> None:
    """Print one table."""
    _, heads, words = TABLES[table]
    print(f"{words}\n\n" if words else "", end="")
    print(f"| | {' | '.join(heads)} |\n|{'---|' * (len(heads) + 1)}")
    for name in CONTESTANTS:
        if table == "limits" and "hand" in name:
            continue
        done = subprocess.run([sys.executable, __file__, table, name], capture_output=True, text=True)
        if done.returncode:
            print(f"| {name} | not here: {done.stderr.strip().splitlines()[-1]} |{' |' * (len(heads) - 1)}")
            continue
        print(f"| {name} | {' | '.join(json.loads(done.stdout.splitlines()[-1]))} |", flush=True)


if __name__ == "__main__":
    wanted = sys.argv[1] if sys.argv[1:] else "speed"
    contest(sys.argv[2], wanted) if sys.argv[2:] else main(wanted)
