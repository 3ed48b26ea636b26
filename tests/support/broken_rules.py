"""A slider-crank and a slotted lever in closed forms of a few lines, and the same constructions with a rule broken."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from kulman.plans.boards.exact import run
from kulman.plans.hands.shaky import Paper
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import ZERO, Driver, Link, Mechanism, Prismatic, Revolute
from kulman.plans.linkages.solved import board_givens
from kulman.plans.mistakes.book import broken
from kulman.plans.mistakes.rules import Broken, Scene
from kulman.tests.support.mechanisms import ORIGIN

CRANK, PHI, OMEGA = 0.08, math.radians(60.0), 20.0
ROD, OFFSET = 0.30, 0.02
N_1 = OMEGA * 30.0 / math.pi  # rpm
MUS = {"position": 0.002, "velocity": 0.02, "acceleration": 0.4}


@dataclass(frozen=True)
class Motion:
    """Rates of a link, and velocity and acceleration of its slider along the guide, or of the sliding."""

    omega: float
    v: float
    epsilon: float
    a: float


def cross(u: complex, w: complex) -> float:
    return u.real * w.imag - u.imag * w.real


def dot(u: complex, w: complex) -> float:
    return u.real * w.real + u.imag * w.imag


def rod(
    crank: float = CRANK,
    phi: float = PHI,
    offset: float = OFFSET,
    omega: float = OMEGA,
    normal: Callable[[float, float], float] = lambda v, omega: omega * omega * ROD,
) -> Motion:
    """Return the motion of the rod and the slider of a slider-crank; `normal` gives the part from B to A."""
    A = cmath.rect(crank, phi)
    u = complex(math.sqrt(ROD**2 - (offset - A.imag) ** 2), offset - A.imag) / ROD
    rate = -(1j * omega * A).imag / (1j * u).imag / ROD
    speed = (1j * omega * A + rate * ROD * 1j * u).real
    known = -(omega**2) * A - normal(speed, rate) * u
    change = -known.imag / (1j * u).imag / ROD
    return Motion(rate, speed, change, (known + change * ROD * 1j * u).real)


LEVER, DISTANCE = 0.10, 0.35


def lever(
    coriolis: Callable[[complex, float, complex], complex] = lambda k, omega, v: 2j * omega * v * k,
    normal: float = 1.0,
) -> Motion:
    """Return the motion of a slotted lever about a pivot below the crank's; `coriolis` of u, omega_3, v_r."""
    A = cmath.rect(LEVER, PHI)
    arm = A + 1j * DISTANCE
    length, u = abs(arm), arm / abs(arm)
    rate = dot(1j * OMEGA * A, 1j * u) / length
    slide = -dot(1j * OMEGA * A, u)
    known = -(OMEGA**2) * A + coriolis(u, rate, slide) + u * rate**2 * length * normal
    return Motion(rate, slide, dot(known, 1j * u) / length, -dot(known, u))


@cache
def slider_crank() -> Scene:
    mechanism = Mechanism(
        links=(
            Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}),
            Link(2, {"A": ORIGIN, "B": ("l_AB", ZERO), "S2": ("l_AS2", ZERO), "E": ("x_E", "y_E")}, "S2", "m_2", "J_2"),
            Link(3, {"B": ORIGIN}, "B", "m_3"),
        ),
        pairs=(
            Revolute("O", (0, 1), ORIGIN),
            Revolute("A", (1, 2)),
            Revolute("B", (2, 3)),
            Prismatic("B", (3, 0), ORIGIN, ZERO, "e", "side"),
        ),
        driver=Driver(1, "O", "A", "phi", "n_1", "sense"),
        gravity="g",
    )
    lengths = {"l_OA": CRANK, "l_AB": ROD, "e": OFFSET, "l_AS2": 0.1, "x_E": 0.12, "y_E": 0.05}
    loads = {"m_2": 2.0, "J_2": 0.015, "m_3": 1.5, "g": 9.81}
    return scene(mechanism, {**lengths, **loads, "side": 1.0})


@cache
def slotted_lever() -> Scene:
    mechanism = Mechanism(
        links=(
            Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}),
            Link(2, {"A": ORIGIN}),
            Link(3, {"C": ORIGIN, "S3": ("l_CS3", ZERO)}, "S3", "m_3", "J_3"),
        ),
        pairs=(
            Revolute("O", (0, 1), ORIGIN),
            Revolute("A", (1, 2)),
            Revolute("C", (0, 3), (ZERO, "y_C")),
            Prismatic("A", (2, 3), ORIGIN, ZERO),
        ),
        driver=Driver(1, "O", "A", "phi", "n_1", "sense"),
    )
    return scene(mechanism, {"l_OA": LEVER, "y_C": -DISTANCE, "l_CS3": 0.2, "m_3": 3.0, "J_3": 0.1})


def scene(mechanism: Mechanism, values: Mapping[str, float]) -> Scene:
    _, program = construct(mechanism)
    givens = board_givens(mechanism, {**values, "phi": PHI, "n_1": OMEGA, "sense": 1.0, "zero": 0.0}, program)
    mus = {plan: MUS.get(plan, 5.0) for plan in program.plans} | {"lever": MUS["velocity"]}
    return Scene(Paper(program, givens, mus), run(program, givens).values)


def ways(where: Scene, id: str, at: str = "", how: str = "") -> list[Broken]:
    """Return the ways to break the rule of a mistake, at a place, in a way."""
    return [b for b in broken(where.paper, where.values, (id,)) if at in ("", b.at) and b.change.how.startswith(how)]


def after(where: Scene, id: str, at: str = "", how: str = "") -> Mapping[str, Any]:
    """Return the values that a broken construction gives."""
    found = ways(where, id, at, how)
    assert len(found) == 1, [b.place for b in found]
    return run(found[0].program, found[0].givens).values


def motion(values: Mapping[str, Any]) -> Motion:
    """Return the motion of rod and slider, signed along the guide."""
    return Motion(values["omega_2"], values["V_B"].real, values["epsilon_2"], values["a_B"].real)


def lever_motion(values: Mapping[str, Any]) -> Motion:
    u = values["u_23"]
    return Motion(values["omega_3"], dot(values["V_A3A2"], u), values["epsilon_3"], dot(values["a_A3A2_r"], u))


def close(found: Motion, wanted: Motion) -> bool:
    pairs = zip(vars(found).values(), vars(wanted).values(), strict=True)
    return all(math.isclose(x, y, rel_tol=1e-9, abs_tol=1e-9) for x, y in pairs)
