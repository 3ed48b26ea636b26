"""Measure what the README promises: `make bench`. Every row is a ratio to a yardstick of the same run, too."""

from __future__ import annotations

import math
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

RUNS = 7
MILLION = 1_000_000
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


def shortest(work: Callable[[], object], runs: int = RUNS) -> float:
    """Return the shortest time of a call on the processor, seconds: others on the machine make it longer only."""
    times = []
    for _ in range(runs + 1):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return min(times)


def closed_form(phi, values):
    """Return M_bal of the slider-crank by virtual power, written by hand for this one mechanism."""
    import numpy as np

    r, length, part = values["l_OA"], values["l_AB"], values["l_AS2"] / values["l_AB"]
    omega = values["n_1"] * values["sense_1"]
    crank = r * np.exp(1j * phi)
    height = crank.imag
    reach = -np.sqrt(length**2 - height**2)
    rod = reach - 1j * height
    rate = -omega * crank.real / reach
    v_b = (1j * omega * crank + 1j * rate * rod).real
    epsilon = (omega**2 * crank.imag + rate**2 * rod.imag) / rod.real
    a_a = -(omega**2) * crank
    a_ba = (1j * epsilon - rate**2) * rod
    v_s, a_s, a_b = 1j * omega * crank + 1j * rate * rod * part, a_a + a_ba * part, (a_a + a_ba).real
    power = (np.conj(v_s) * (-values["m_2"] * a_s)).real + v_b * (values["F_3"] - values["m_3"] * a_b)
    return -(power - values["J_S2"] * epsilon * rate) / omega


def four_bar_motion(phi, values):
    """Return velocities and accelerations of the four-bar, written by hand for this one mechanism."""
    import numpy as np

    omega = values["n_1"] * values["sense_1"]
    B = values["l_AB"] * np.exp(1j * phi)
    way = values["l_AD"] - B
    square = (way * way.conj()).real
    part = 0.5 * (square + values["l_BC"] ** 2 - values["l_DC"] ** 2) / square
    rod = way * (part + 1j * np.sqrt(values["l_BC"] ** 2 / square - part * part))
    rocker = B + rod - values["l_AD"]
    sine = (rod.conj() * rocker).imag
    V_B, a_B = 1j * omega * B, -(omega**2) * B
    omega_2, omega_3 = -(V_B.conj() * rocker).real / sine, -(V_B.conj() * rod).real / sine
    rest = a_B - omega_2**2 * rod + omega_3**2 * rocker
    epsilon_2, epsilon_3 = -(rest.conj() * rocker).real / sine, -(rest.conj() * rod).real / sine
    a_C = (1j * epsilon_3 - omega_3**2) * rocker
    parts = (
        values[f"l_{name}"] / values[f"l_{whole}"] for name, whole in (("AS1", "AB"), ("BS2", "BC"), ("DS3", "DC"))
    )
    first, second, third = parts
    centres = a_B * first, a_B + (a_C - a_B) * second, a_C * third
    return V_B, 1j * omega_3 * rocker, a_B, a_C, *centres, omega_2, omega_3, epsilon_2, epsilon_3


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

    from kulman.plans.batch import batch, settle_heap
    from kulman.plans.linkages.chain import construct
    from kulman.plans.linkages.givens import board_givens
    from kulman.variants import load_task

    settle_heap()
    phi = np.linspace(0.0, 2.0 * math.pi, MILLION, endpoint=False)
    chunks = np.array_split(phi, MILLION // 16384)
    for key, wanted, _ in BATCHES.values():
        task = load_task(key)
        _, program = construct(task.mechanism)
        values = task.values(next(iter(task.variants)))
        givens = board_givens(task.mechanism, {**values, "phi": phi})
        by_hand = closed_form if "M_bal" in wanted else four_bar_motion
        ours = shortest(lambda: batch(program, givens, wanted))  # noqa: B023
        if "M_bal" in wanted:
            memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        hand = shortest(lambda: [by_hand(part, values) for part in chunks])  # noqa: B023
        results, codes = batch(program, givens, wanted)
        exact = by_hand(phi, values) if "V_B" in wanted else [closed_form(phi, values)] if "M_bal" in wanted else []
        assert not codes.any()
        for name, true in zip(wanted, exact, strict=False):
            assert np.abs(results[name] - true).max() < 1e-12 * np.abs(true).max(), name
        print(ours / MILLION * 1e9, hand / MILLION * 1e9, memory)


def row(name: str, value: float, unit: str, goal: float, ratio: str) -> None:
    """Print one line of the table."""
    print(f"| {name} | {value:.3g} {unit} | {goal:g} {unit} | {ratio} |")


def main() -> None:
    """Print the table."""
    import numpy as np

    import kulman
    from kulman.plans.exact import run
    from kulman.plans.linkages.chain import construct
    from kulman.plans.linkages.givens import board_givens

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
    _, program = construct(task.mechanism)
    givens = board_givens(task.mechanism, task.values("example"))
    one = shortest(lambda: [run(program, givens) for _ in range(200)]) / 200
    values = task.values("example")
    hand = shortest(lambda: [closed_form(values["phi"], values) for _ in range(200)]) / 200
    row("one position, the full chain", one * 1e6, "us", 100, f"{one / hand:.1f} times a hand-written closed form")
    row("recording the construction", shortest(lambda: construct(task.mechanism)) * 1e3, "ms", 1, "")
    output = subprocess.run([sys.executable, __file__, "million"], check=True, capture_output=True, text=True).stdout
    for (name, (_, _, goal)), line in zip(BATCHES.items(), output.splitlines(), strict=True):
        ours, hand, memory = map(float, line.split())
        ratio = f"{ours / hand:.2f} times a hand-written closed form"
        row(f"{name}, a million times, each", ours, "ns", goal, ratio)
        if goal == 100:
            row("peak memory of that run", memory, "MB", 150, "")


if __name__ == "__main__":
    million() if sys.argv[1:] == ["million"] else main()
