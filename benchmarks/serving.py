"""How long thirty sheets take that are asked for at once, in times of one: `python benchmarks/serving.py`.

Thirty students have the ten variants of a task; then all thirty sheets are different, which on two cores takes 15 times
one at the very least. The goal is 15, whatever the machine: a ratio in the same run, of whole answers as a browser
gets them.
"""

from __future__ import annotations

import re
import subprocess
import sys
import time
import urllib.request
from concurrent.futures import ThreadPoolExecutor
from statistics import fmean

TASK, VARIANTS, ANGLES, GOAL = "scheme-09-shaper", range(10), (40, 75, 130), 15.0
PAIRS = [(variant, angle) for variant in VARIANTS for angle in ANGLES]


def ask(address: str) -> float:
    """Ask for a sheet; return how long it took, seconds."""
    begun = time.perf_counter()
    with urllib.request.urlopen(address, timeout=600) as answer:
        page = answer.read()
    assert b"page.svg" in page, address
    return time.perf_counter() - begun


def main() -> None:
    """Measure, and tell."""
    words = [sys.executable, "-m", "kulman", "serve", "--port", "0", "--lang", "en"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as server:
        try:
            assert server.stdout is not None
            found = re.search(r"http://\S+", server.stdout.readline())
            assert found is not None
            sheets = f"{found[0]}task/{TASK}?v={{0}}&of={{0}}&g.phi={{1}}"
            with ThreadPoolExecutor(30) as many:
                [*many.map(ask, (sheets.format(name, 11) for name in VARIANTS))]  # all processes are at work
                # what one takes hangs on its position: the same angles, less one degree
                alone = fmean(ask(sheets.format(name, angle - 1)) for name, angle in PAIRS)
                print(f"one sheet {alone:.2f} s; thirty at once, goal {GOAL:g} times one:")
                for what, asked in (
                    ("of ten variants", [(name, 90) for name in 3 * [*VARIANTS]]),
                    ("all different", PAIRS),
                ):
                    begun = time.perf_counter()
                    [*many.map(ask, (sheets.format(*pair) for pair in asked))]
                    together = time.perf_counter() - begun
                    print(f"  {what} {together:.2f} s, {together / alone:.1f} times one")
        finally:
            server.terminate()


if __name__ == "__main__":
    main()
