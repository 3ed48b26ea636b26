"""One four-bar, the same angles, in one run: Kulman beside the packages pylinkage and mechanism.

    python -m venv /tmp/peers && /tmp/peers/bin/pip install . mpmath "pylinkage[numba]" mechanism
    make bench PEERS=/tmp/peers/bin/python

Each contestant runs in a process of its own and is left out, with a word, where it is not installed.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
import time
import warnings
from collections.abc import Callable
from typing import Any

FRAME, CRANK, ROD, ROCKER = 0.51, 0.12, 0.48, 0.38  # AD, AB, BC, DC of tests/test_dyads_madi.py, m
OMEGA = -30.0 * math.pi
SAMPLES = 100  # angles of a turn that are compared with fifty digits
LONG = {"crank": 0.38}  # around 180 degrees B is too far from D for BC and DC to meet
PARALLELOGRAM = {"rod": FRAME, "rocker": CRANK}  # has its change points at 0 and 180 degrees
CODES: list[Any] = []  # of Kulman's runs
Motion = tuple[Any, Any, Any]  # position, velocity, acceleration of C, each complex of shape (N,)


def kulman(count: int, motion: bool, crank: float = CRANK, rod: float = ROD, rocker: float = ROCKER) -> Motion:
    """The general engine: structure, constructions, batch."""
    import numpy as np

    from kulman.plans.batch import batch
    from kulman.plans.linkages.chain import construct
    from kulman.plans.linkages.mechanism import ZERO, Driver, Link, Mechanism, Revolute

    origin = (ZERO, ZERO)
    four_bar = Mechanism(
        links=(
            Link(1, {"A": origin, "B": ("l_AB", ZERO)}, "A"),
            Link(2, {"B": origin, "C": ("l_BC", ZERO)}, "B"),
            Link(3, {"D": origin, "C": ("l_DC", ZERO)}, "D"),
        ),
        pairs=(
            Revolute("A", (0, 1), origin),
            Revolute("B", (1, 2)),
            Revolute("C", (2, 3), None, "branch"),
            Revolute("D", (3, 0), ("l_AD", ZERO)),
        ),
        driver=Driver(1, "A", "B", "phi", "n_1", "sense_1"),
    )
    _, program = construct(four_bar, ("position", "velocity", "acceleration"))
    lengths = {"l_AD": FRAME, "l_AB": crank, "l_BC": rod, "l_DC": rocker}
    phi = np.arange(1, count + 1) * (math.tau / count)
    givens = {**lengths, "branch": 1.0, "n_1": abs(OMEGA), "sense_1": math.copysign(1.0, OMEGA), "phi": phi}
    results, codes = batch(program, givens, ["B", "C", "V_B", "V_C", "a_B", "a_C"] if motion else ["B", "C"])
    CODES.append(codes)
    return results["C"], results.get("V_C"), results.get("a_C")


def pylinkage(count: int, motion: bool, crank: float = CRANK, rod: float = ROD, rocker: float = ROCKER) -> Motion:
    """Its solver on arrays of joints; compiled where numba is installed."""
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import RRRDyad
    from pylinkage.simulation import Linkage

    A, D = Ground(0.0, 0.0, name="A"), Ground(FRAME, 0.0, name="D")
    first = Crank(anchor=A, radius=crank, angular_velocity=math.tau / count, initial_angle=0.0)
    above = RRRDyad(first.output, D, distance1=rod, distance2=rocker)
    linkage = Linkage([A, D, first, above])
    start = circles(complex(crank), rod, complex(FRAME), rocker)
    linkage.rebuild([(0.0, 0.0), (FRAME, 0.0), (crank, 0.0), (start.real, start.imag)])
    linkage.set_input_velocity(first, OMEGA)
    if not motion:
        return complex_of(linkage.step_fast(count)[:, 3]), None, None
    place, velocity, acceleration = (complex_of(array[:, 3]) for array in linkage.step_fast_with_kinematics(count))
    return place, velocity, acceleration


def mechanism(count: int, motion: bool, crank: float = CRANK, rod: float = ROD, rocker: float = ROCKER) -> Motion:
    """Loop equations by fsolve, one position after another."""
    import numpy as np
    from mechanism import Mechanism, Vector, get_joints

    A, B, C, D = get_joints("A B C D")
    a, b, d = Vector((A, B), r=crank), Vector((B, C), r=rod), Vector((D, C), r=rocker)
    c = Vector((A, D), r=FRAME, theta=0.0)
    phi = np.arange(1, count + 1) * (math.tau / count)
    start = circles(complex(crank), rod, complex(FRAME), rocker)
    guess = np.angle([start - crank, start - FRAME])
    known = {"vel": np.full(count, OMEGA), "acc": np.zeros(count)} if motion else {}
    four_bar = Mechanism(
        vectors=(a, b, c, d),
        origin=A,
        loops=lambda x, i: a(i) + b(x[0]) - c() - d(x[1]),
        pos=phi,
        guess=(guess, np.array([1.0, 1.0]), np.array([1.0, 1.0])),
        **known,
    )
    four_bar.iterate()
    place = C.x_positions + 1j * C.y_positions
    if not motion:
        return place, None, None
    return place, C.x_velocities + 1j * C.y_velocities, C.x_accelerations + 1j * C.y_accelerations


CONTESTANTS: dict[str, tuple[Callable[..., Motion], int]] = {
    "kulman": (kulman, 1_000_000),
    "pylinkage[numba]": (pylinkage, 1_000_000),
    "pylinkage": (pylinkage, 10_000),
    "mechanism": (mechanism, 1_000),
}


def complex_of(pairs: Any) -> Any:
    return pairs[:, 0] + 1j * pairs[:, 1]


def circles(p: complex, r: float, q: complex, s: float) -> complex:
    """Return the left one of the points at `r` from `p` and at `s` from `q`."""
    way = q - p
    part = (abs(way) ** 2 + r**2 - s**2) / (2.0 * abs(way) ** 2)
    return p + way * complex(part, math.sqrt(max((r / abs(way)) ** 2 - part**2, 0.0)))


def oracle() -> list[tuple[complex, complex, complex]]:
    """Return position, velocity and acceleration of C at the samples, from fifty digits."""
    import mpmath

    with mpmath.workdps(50):
        AD, AB, BC, DC, omega = map(mpmath.mpf, (FRAME, CRANK, ROD, ROCKER, OMEGA))
        motions = []
        for sample in range(1, SAMPLES + 1):
            B = AB * mpmath.expjpi(mpmath.mpf(2 * sample) / SAMPLES)
            way = AD - B
            part = (abs(way) ** 2 + BC**2 - DC**2) / (2 * abs(way) ** 2)
            C = B + way * mpmath.mpc(part, mpmath.sqrt((BC / abs(way)) ** 2 - part**2))
            rod, rocker = C - B, C - AD
            closure = mpmath.matrix([[rod.imag, -rocker.imag], [-rod.real, rocker.real]])  # of both links' turning
            V_B, a_B = 1j * omega * B, -(omega**2) * B
            omega_2, omega_3 = mpmath.lu_solve(closure, mpmath.matrix([V_B.real, V_B.imag]))
            rest = a_B - omega_2**2 * rod + omega_3**2 * rocker
            _, epsilon_3 = mpmath.lu_solve(closure, mpmath.matrix([rest.real, rest.imag]))
            motions.append((C, 1j * omega_3 * rocker, (1j * epsilon_3 - omega_3**2) * rocker))
        return [tuple(map(complex, motion)) for motion in motions]  # type: ignore[misc]


def worst(found: Motion) -> list[float]:
    """Return the largest error of each part of a motion, as a part of its largest value."""
    errors = []
    for values, true in zip(found, zip(*oracle(), strict=True), strict=True):
        step = len(values) // SAMPLES
        misses = [abs(values[step * (k + 1) - 1] - true[k]) for k in range(SAMPLES)]
        errors.append(float(max(misses) / max(map(abs, true))))
    return errors


def timed(work: Callable[[], object], runs: int = 5) -> float:
    """Return the shortest time of a call on the processor: other users of the machine make it longer only."""
    times = []
    for _ in range(runs):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return min(times)


def beyond(solve: Callable[..., Motion]) -> str:
    """Say what a contestant returns where the links do not reach, at 180 degrees, and afterwards."""
    C = solve(360, False, **LONG)[0]
    back = "" if abs(abs(C[359] - FRAME) - ROCKER) < 1e-6 else ", and after it where they reach again"
    if math.isnan(abs(C[179])):
        return f"NaN{status(179)}{back}"
    rod, rocker = abs(C[179] + LONG["crank"]), abs(C[179] - FRAME)
    return f"links of {rod * 1e3:.0f} and {rocker * 1e3:.0f} mm instead of {ROD * 1e3:.0f} and {ROCKER * 1e3:.0f}{back}"


def changing(solve: Callable[..., Motion]) -> str:
    """Say what a contestant returns in the change point of a parallelogram, at 180 degrees, and after it."""
    C, V, _ = solve(360, True, **PARALLELOGRAM)
    speed = "V_C NaN" if math.isnan(abs(V[179])) else f"V_C {abs(V[179]):.4g} m/s"
    parallel = abs(C[269] - (FRAME - 1j * CRANK)) < 1e-6
    return f"{speed}{status(179)}; then {'parallel' if parallel else 'crossed'} links"


def status(index: int) -> str:
    """Return the status that Kulman gave to a position of its last run."""
    if not CODES:
        return ""
    from kulman.plans.exact import STATUSES

    return f", status {STATUSES[CODES[-1][index]]}"


def contest(name: str) -> None:
    """Run one contestant and print what came out."""
    solve, count = CONTESTANTS[name]
    if name == "pylinkage":
        sys.modules["numba"] = None  # type: ignore[assignment]
    elif "numba" in name:
        import numba  # noqa: F401  without it the compiled pylinkage is not there
    warnings.simplefilter("ignore")
    start = time.perf_counter()
    solve(SAMPLES, True)
    first = time.perf_counter() - start
    places = timed(lambda: solve(count, False))
    motions = timed(lambda: solve(count, True))
    report = {"first": first, "places": count / places, "motions": count / motions, "worst": worst(solve(count, True))}
    print(json.dumps({**report, "beyond": beyond(solve), "changing": changing(solve)}))


def main() -> None:
    """Print the table."""
    print("| | positions/s | with velocities, accelerations | largest errors of C, V_C, a_C | first call |")
    print("|---|---|---|---|---|")
    words = []
    for name in CONTESTANTS:
        done = subprocess.run([sys.executable, __file__, name], capture_output=True, text=True)
        if done.returncode:
            print(f"| {name} | not here: {done.stderr.strip().splitlines()[-1]} | | | |")
            continue
        report = json.loads(done.stdout.splitlines()[-1])
        errors = ", ".join(f"{error:.1g}" for error in report["worst"])
        print(f"| {name} | {report['places']:.2g} | {report['motions']:.2g} | {errors} | {report['first']:.2g} s |")
        words.append(f"| {name} | {report['beyond']} | {report['changing']} |")
    print("\n| | links that do not reach | change point of a parallelogram |\n|---|---|---|")
    print("\n".join(words))


if __name__ == "__main__":
    contest(sys.argv[1]) if sys.argv[1:] else main()
