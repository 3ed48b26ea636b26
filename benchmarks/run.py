"""Measure what is promised of speed (`make speed`), in ratios to a yardstick of the run. Alone: `million`, `states`."""

from __future__ import annotations

import math
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

RUNS = 7
MILLION, MANY = 1_000_000, 100_000
# as for a user: with compiled modules kept from run to run
ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}


def shell(*arguments: str) -> float:
    """Return the shortest time of a whole process on the processor, seconds."""
    import resource

    def spent() -> float:
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    times = []
    for _ in range(RUNS + 1):  # the first one warms the caches of the disk and writes bytecode
        start = spent()
        subprocess.run([sys.executable, *arguments], check=True, stdout=subprocess.DEVNULL, env=ENVIRONMENT)
        times.append(spent() - start)
    return min(times)


def in_turn(*works: Callable[[], object]) -> list[float]:
    """Return the shortest time of each of several calls on the processor, seconds: others on the machine add to it.

    They take turns, so that what slows the machine down for a while slows all of them.
    """
    times: list[list[float]] = [[] for _ in works]
    for _ in range(RUNS + 1):
        for work, taken in zip(works, times, strict=True):
            start = time.process_time()
            work()
            taken.append(time.process_time() - start)
    return [min(taken) for taken in times]


def shortest(work: Callable[[], object]) -> float:
    """Return the shortest time of a call on the processor, seconds."""
    return in_turn(work)[0]


KINEMATICS = ("V_B", "V_C", "a_B", "a_C", "a_S1", "a_S2", "a_S3", "omega_2", "omega_3", "epsilon_2", "epsilon_3")
FORCES = ("R_12", "R_03", "R_32", "R_01", "F_bal", "F_bal_lever")
BATCHES = {
    "slider-crank, balancing moments by plans and by the lever": ("nau-slider-crank", ("M_bal", "M_bal_lever"), 100),
    "four-bar, position, velocity and acceleration": ("madi-four-bar", KINEMATICS, 80),
    "four-bar, balancing forces by plans and by the lever": ("madi-four-bar", ("F_bal", "F_bal_lever"), 150),
    "four-bar, motion, reactions, balancing forces": ("madi-four-bar", KINEMATICS + FORCES, 150),
}


def million() -> None:
    """Solve a million positions of each batch; print nanoseconds each, the yardstick's, and the peak memory in MB."""
    import resource

    import numpy as np
    from by_hand import four_bar_motion, slider_crank_moment

    from kulman import load_task
    from kulman.plans.boards.batch import batch, settle_heap
    from kulman.plans.linkages.chain import construct
    from kulman.plans.linkages.solved import board_givens

    settle_heap()
    phi = np.linspace(0.0, 2.0 * math.pi, MILLION, endpoint=False)
    chunks = np.array_split(phi, MILLION // 16384)
    for key, wanted, _ in BATCHES.values():
        task = load_task(key)
        _, program = construct(task.mechanism)
        values = task.values(next(iter(task.variants)))
        givens = board_givens(task.mechanism, {**values, "phi": phi})
        by_hand = slider_crank_moment if "M_bal" in wanted else four_bar_motion
        results, codes = batch(program, givens, wanted)
        if "M_bal" in wanted:
            memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        ours, hand = in_turn(
            lambda: batch(program, givens, wanted),  # noqa: B023
            lambda: [by_hand(part, values) for part in chunks],  # noqa: B023
        )
        exact = [by_hand(phi, values)] if "M_bal" in wanted else by_hand(phi, values) if "V_B" in wanted else []
        assert not codes.any()
        for name, true in zip(wanted, exact, strict=False):
            assert np.abs(results[name] - true).max() < 1e-12 * np.abs(true).max(), name
        print(ours / MILLION * 1e9, hand / MILLION * 1e9, memory)


def states() -> None:
    """Solve 100,000 states by `solve_many`, beside the bare batch: as numpy, pandas, CSV."""
    import numpy as np

    import kulman
    from kulman.plans.boards.batch import batch
    from kulman.plans.linkages.chain import constructed
    from kulman.plans.linkages.solved import board_givens

    task, phi = kulman.load_task("nau-slider-crank"), np.linspace(0.0, 2.0 * math.pi, MANY)
    for wanted, goal in (("", 60), ("V_B,M_bal", 15)):
        many = kulman.solve_many(task, phi=phi, names=wanted)
        _, program = constructed(task.mechanism, many.case.plans)
        givens, names = board_givens(task.mechanism, {**many.case.values, "phi": phi}, program), tuple(many.values)
        works: list[Callable[[], object]] = [
            lambda: batch(program, givens, names),  # noqa: B023
            lambda: kulman.solve_many(task, phi=phi, names=wanted),  # noqa: B023
        ]
        if find_spec("pandas"):
            works.append(lambda: kulman.solve_many(task, phi=phi, names=wanted).to_dataframe())  # noqa: B023
        bare, ours, *framed = in_turn(*works)
        row(f"{MANY:,} states of {len(names)} names", ours * 1e3, "ms", goal, f"{ours / bare:.2f} times the bare batch")
        for frame in framed:
            row("the same as a data frame", frame * 1e3, "ms", 2 * goal, f"{frame / bare:.2f} times the bare batch")
    turn = np.linspace(0.0, 2.0 * math.pi, 361)
    for name, goal, asked in (
        (
            "361 positions of 100 shapers",
            60,
            {"task": "scheme-09-shaper", "phi": turn, "l_DE": np.linspace(0.17, 0.3, 100)[:, None]},
        ),
        ("one of 3,610 compressors", 600, {"task": "scheme-01-compressor", "l_AB": np.linspace(0.34, 0.4, 3610)}),
    ):
        taken = shortest(lambda: kulman.solve_many(**asked, names="M_bal"))  # noqa: B023
        states_of = int(np.prod(np.broadcast_shapes(*(np.shape(value) for value in asked.values()))))
        row(f"{name}, M_bal", taken * 1e3, "ms", goal, f"{taken / states_of * 1e6:.1f} us a state")
    text = shortest(many.csv)
    row("these as CSV", text, "s", 0.25, f"{text / bare:.0f} times the bare batch, {text / MANY * 1e6:.1f} us a state")


def row(name: str, value: float, unit: str, goal: float, ratio: str) -> None:
    """Print one line of the table."""
    print(f"| {name} | {value:.3g} {unit} | {goal:g} {unit} | {ratio} |")


def main() -> None:
    """Print the table."""
    import numpy as np
    from by_hand import slider_crank_moment

    import kulman
    from kulman.plans.boards.exact import run
    from kulman.plans.hands.shaky import Paper, draw, preset
    from kulman.plans.linkages.chain import construct
    from kulman.plans.linkages.solved import board_givens

    versions = f"Python {sys.version.split()[0]}, numpy {np.__version__}, {os.cpu_count()} cores"
    print(f"{versions}; processor time, the shortest of {RUNS} runs\n")
    print("| what | measured | goal | ratio in the same run |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        svg, pdf = (str(Path(folder) / f"sheet.{suffix}") for suffix in ("svg", "pdf"))
        bare = shell("-c", "pass")
        sheet = ("-m", "kulman", "sheet", "nau-slider-crank", "-v", "3")
        for name, goal, arguments in (
            ("`kulman list`", 0.12, ("-m", "kulman", "list")),
            ("`kulman solve nau-slider-crank -v 3`", 0.3, ("-m", "kulman", "solve", "nau-slider-crank", "-v", "3")),
            ("SVG sheet from the shell", 0.4, (*sheet, "-o", svg)),
            ("SVG and PDF from the shell", 0.6, (*sheet, "-o", svg, "-o", pdf)),
        ):
            taken = shell(*arguments)
            row(name, taken, "s", goal, f"{taken / bare:.1f} starts of Python")
        once = shortest(lambda: kulman.sheet("nau-slider-crank", "3").save(svg, pdf))
        row("SVG and PDF, warm", once * 1e3, "ms", 60, f"{once / bare:.2f} starts of Python")
    task = kulman.load_task("nau-slider-crank")
    swept = shortest(lambda: kulman.sweep(task, positions=360))
    row("a cycle of 360 positions", swept * 1e3, "ms", 25, f"{swept / bare:.2f} starts of Python")
    _, program = construct(task.mechanism)
    givens = board_givens(task.mechanism, task.values("example"))
    values = task.values("example")
    one, hand = in_turn(
        lambda: [run(program, givens) for _ in range(200)],
        lambda: [slider_crank_moment(values["phi"], values) for _ in range(200)],
    )
    row(
        "one position, the full chain", one / 200 * 1e6, "us", 100, f"{one / hand:.1f} times a hand-written closed form"
    )
    row("recording the construction", shortest(lambda: construct(task.mechanism)) * 1e3, "ms", 1, "")
    paper, shaky = Paper(program, givens, dict.fromkeys(program.plans, 1.0)), preset("normal").hand
    drawn = shortest(lambda: draw(paper, shaky, np.random.default_rng(1), 1000))
    row("a thousand drawings by hand to the lever", drawn * 1e3, "ms", 100, "")
    output = subprocess.run([sys.executable, __file__, "million"], check=True, capture_output=True, text=True).stdout
    for (name, (_, _, goal)), line in zip(BATCHES.items(), output.splitlines(), strict=True):
        ours, hand, memory = map(float, line.split())
        ratio = f"{ours / hand:.2f} times a hand-written closed form"
        row(f"{name}, a million times, each", ours, "ns", goal, ratio)
        if goal == 100:
            row("peak memory of that run", memory, "MB", 150, "")
    states()
    from classes import students

    for name, taken, solutions in students():  # 40 ms on each of two cores: a class of 1,000 in 20 s
        row(name, taken * 1e3, "ms", 40, f"{solutions:.1f} solutions of the task")
    from batches import students as drawn

    for name, taken, cores in drawn():
        row(name, taken * 1e3, "ms", 120, f"{taken / bare:.2f} starts of Python; two cores {cores:.2f} times one")


if __name__ == "__main__":
    {"million": million, "states": states}.get(" ".join(sys.argv[1:]), main)()
