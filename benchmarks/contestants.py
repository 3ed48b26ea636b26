"""Who takes a turn of the crank: Kulman, pylinkage with and without numba, mechanism, and closed forms by hand.

Each returns position, velocity and acceleration of C, complex arrays of shape (N,), at N angles of a turn.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from mechanisms import CRANK, FRAME, OMEGA, ROCKER, ROD

Motion = tuple[Any, Any, Any]  # velocity and acceleration are None where they are not asked for
CODES: list[Any] = []  # of Kulman's runs


def kulman(which: str, count: int, motion: bool, **lengths: float) -> Motion:
    """The general engine: structure, constructions, batch."""
    import numpy as np

    from kulman.plans.boards.batch import batch
    from kulman.plans.linkages.chain import construct

    values = {"l_AD": FRAME, "l_AB": CRANK, "l_BC": ROD, "l_DC": ROCKER, **lengths}
    _, program = construct(_mechanism(which), ("position", "velocity", "acceleration"))
    phi = np.arange(1, count + 1) * (math.tau / count)
    givens = {**values, "branch": 1.0, "n_1": abs(OMEGA), "sense_1": math.copysign(1.0, OMEGA), "phi": phi}
    results, codes = batch(program, givens, ["B", "C", "V_B", "V_C", "a_B", "a_C"] if motion else ["B", "C"])
    CODES.append(codes)
    return results["C"], results.get("V_C"), results.get("a_C")


def _mechanism(which: str) -> Any:
    from kulman.plans.linkages.mechanism import ZERO, Driver, Link, Mechanism, Prismatic, Revolute

    origin = (ZERO, ZERO)
    crank, rod = Link(1, {"A": origin, "B": ("l_AB", ZERO)}, "A"), Link(2, {"B": origin, "C": ("l_BC", ZERO)}, "B")
    pins = Revolute("A", (0, 1), origin), Revolute("B", (1, 2))
    driver = Driver(1, "A", "B", "phi", "n_1", "sense_1")
    if which == "slider-crank":
        guide = Prismatic("C", (3, 0), origin, ZERO, ZERO, "branch")
        return Mechanism((crank, rod, Link(3, {"C": origin}, "C")), (*pins, Revolute("C", (2, 3)), guide), driver)
    rocker = Link(3, {"D": origin, "C": ("l_DC", ZERO)}, "D")
    others = Revolute("C", (2, 3), None, "branch"), Revolute("D", (3, 0), ("l_AD", ZERO))
    return Mechanism((crank, rod, rocker), (*pins, *others), driver)


def closed_form(which: str, count: int, motion: bool) -> Motion:
    """Closed forms in numpy, in chunks that fit the cache, all of B and C kept as the others do."""
    import numpy as np
    from by_hand import four_bar_place, four_bar_rates, slider_crank_place, slider_crank_rates

    np.empty(31 << 20, np.uint8)  # as Kulman does, lest glibc gives memory back after every large temporary
    phi = np.arange(1, count + 1) * (math.tau / count)
    kept = [np.empty(count, complex) for _ in range(6 if motion else 2)]
    for start in range(0, count, 16384):
        part = slice(start, start + 16384)
        if which == "four-bar":
            B, C, BC, DC = four_bar_place(phi[part], CRANK, ROD, ROCKER, FRAME)
            rates = four_bar_rates(OMEGA, B, BC, DC)[:4] if motion else ()
        else:
            B, C, BC = slider_crank_place(phi[part], CRANK, ROD)
            rates = slider_crank_rates(OMEGA, B, BC) if motion else ()
        for array, values in zip(kept, (B, C, *rates), strict=True):
            array[part] = values
    return kept[1], kept[3] if motion else None, kept[5] if motion else None


def pylinkage(
    which: str, count: int, motion: bool, l_AB: float = CRANK, l_BC: float = ROD, l_DC: float = ROCKER
) -> Motion:
    """Its solver on arrays of joints; compiled where numba is installed."""
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import RRPDyad, RRRDyad
    from pylinkage.simulation import Linkage

    A, D = Ground(0.0, 0.0, name="A"), Ground(FRAME, 0.0, name="D")
    crank = Crank(anchor=A, radius=l_AB, angular_velocity=math.tau / count, initial_angle=0.0)
    if which == "four-bar":
        dyad, start = RRRDyad(crank.output, D, distance1=l_BC, distance2=l_DC), _start(l_AB, l_BC, l_DC)
    else:
        dyad, start = RRPDyad(crank.output, A, D, distance=l_BC), complex(l_AB + l_BC)
    linkage = Linkage([A, D, crank, dyad])
    linkage.rebuild([(0.0, 0.0), (FRAME, 0.0), (l_AB, 0.0), (start.real, start.imag)])
    linkage.set_input_velocity(crank, OMEGA)
    if not motion:
        return _complex(linkage.step_fast(count)[:, 3]), None, None
    place, velocity, acceleration = (_complex(array[:, 3]) for array in linkage.step_fast_with_kinematics(count))
    return place, velocity, acceleration


def mechanism(
    which: str, count: int, motion: bool, l_AB: float = CRANK, l_BC: float = ROD, l_DC: float = ROCKER
) -> Motion:
    """Loop equations by fsolve, one position after another."""
    import numpy as np
    from mechanism import Mechanism, Vector, get_joints

    A, B, C, D = get_joints("A B C D")
    a, b = Vector((A, B), r=l_AB), Vector((B, C), r=l_BC)
    phi = np.arange(1, count + 1) * (math.tau / count)
    if which == "four-bar":
        c, d = Vector((A, D), r=FRAME, theta=0.0), Vector((D, C), r=l_DC)
        start = _start(l_AB, l_BC, l_DC)
        guess, vectors = np.angle([start - l_AB, start - FRAME]), (a, b, c, d)
        loops = lambda x, i: a(i) + b(x[0]) - c() - d(x[1])  # noqa: E731
    else:
        d = Vector((A, C), theta=0.0)
        guess, vectors = np.array([0.0, l_AB + l_BC]), (a, b, d)
        loops = lambda x, i: a(i) + b(x[0]) - d(x[1])  # noqa: E731
    known = {"vel": np.full(count, OMEGA), "acc": np.zeros(count)} if motion else {}
    guesses = (guess, np.array([1.0, 1.0]), np.array([1.0, 1.0]))
    solved = Mechanism(vectors=vectors, origin=A, loops=loops, pos=phi, guess=guesses, **known)
    solved.iterate()
    place = C.x_positions + 1j * C.y_positions
    if not motion:
        return place, None, None
    return place, C.x_velocities + 1j * C.y_velocities, C.x_accelerations + 1j * C.y_accelerations


CONTESTANTS: dict[str, tuple[Callable[..., Motion], int]] = {
    "kulman": (kulman, 1_000_000),
    "closed form by hand, numpy": (closed_form, 1_000_000),
    "pylinkage[numba]": (pylinkage, 1_000_000),
    "pylinkage": (pylinkage, 10_000),
    "mechanism": (mechanism, 1_000),
}


def _complex(pairs: Any) -> Any:
    return pairs[:, 0] + 1j * pairs[:, 1]


def _start(crank: float, rod: float, rocker: float) -> complex:
    """Return C at the angle 0, the left one of two."""
    way = FRAME - crank
    part = (way**2 + rod**2 - rocker**2) / (2.0 * way**2)
    return crank + way * complex(part, math.sqrt(max((rod / way) ** 2 - part**2, 0.0)))
