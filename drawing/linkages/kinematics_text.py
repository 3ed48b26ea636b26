"""Equations of velocities and accelerations, with their numbers."""

from __future__ import annotations

import math
from collections.abc import Callable

from ...plans.linkages.rrp import Dyad
from ..printed import calculation, value_text
from ..table import text_block
from ..view import View
from .equations import Lines, by_direction, calculated, given, known, size_of
from .scene import Scene


def kinematics_block(scene: Scene, width: float, plans: tuple[str, ...]) -> View:
    """Return the equations of the plans wanted, of velocities, of accelerations or of both."""
    lines: Lines = [_speed_line(scene)]
    if "velocity" in plans:
        lines.append(_pin_line(scene, "V", "{omega}", "{}·{}", lambda omega, length: omega * length))
    if "acceleration" in plans:
        lines.append(_pin_line(scene, "a", "{omega}^{{2}}", "{}^{{2}}·{}", lambda omega, length: omega**2 * length))
    for d in scene.dyads:
        lines += _velocity_lines(scene, d) if "velocity" in plans else []
        lines += _acceleration_lines(scene, d) if "acceleration" in plans else []
    drawn = [plan for plan in ("velocity", "acceleration") if plan in plans]
    key = "kinematics" if len(drawn) > 1 else drawn[0]
    return text_block("equations_kinematics", scene.words[f"heading.equations_{key}"], lines, scene.style, width)


def _speed_line(scene: Scene) -> tuple[str, ...]:
    """Return omega_1 from revolutions per minute, or as it is given."""
    w, s = scene.words, scene.solved
    driver = s.mechanism.driver
    omega = s.values[f"omega_{driver.link}"]
    symbol, unit = w.symbol(f"omega_{driver.link}"), w.unit("rad/s")
    sense = w["said.ccw" if omega > 0 else "said.cw"]
    stated = scene.givens.get(driver.speed)
    if stated is None or stated.unit != "rpm" or isinstance(stated.value, str):
        return f"{symbol} = {value_text(w, abs(omega))} {unit},", sense
    texts, result = calculation(w, lambda n: math.pi * n / 30.0, [(stated.value, True)])
    return f"{symbol} = π{w.symbol(driver.speed)}/30 =", f"π·{texts[0]}/30 =", f"{result} {unit},", sense


def _pin_line(scene: Scene, kind: str, factor: str, pattern: str, law: Callable[..., float]) -> tuple[str, ...]:
    """Return velocity or acceleration of the crank's pin from omega_1 and the crank's length."""
    w, s = scene.words, scene.solved
    driver = s.mechanism.driver
    omega, length = f"omega_{driver.link}", s.mechanism.link(driver.link).points[driver.point][0]
    letter, index = w.symbol(omega).split("_", 1)
    formula = f"{factor.format(omega=letter)}_{index}·{w.symbol(length)}"
    inputs = (abs(s.values[omega]), False), given(scene, length)
    return calculated(scene, f"{kind}_{driver.point}", formula, pattern, law, *inputs)


def _velocity_lines(scene: Scene, d: Dyad) -> Lines:
    w = scene.words
    V, Va, Vba = (w.symbol(name, bar=True) for name in (f"V_{d.B}", f"V_{d.A}", f"V_{d.B}{d.A}"))
    directions = _directions(scene, d, f"V_{d.B}", f"V_{d.B}{d.A}")
    lines: Lines = [(f"{by_direction(V)} = {known(Va)} + {by_direction(Vba)},", *directions)]
    lines += _similarity_lines(scene, d, "velocity", f"V_{d.B}{d.A}")
    rate = f"omega_{d.rod.number}"
    v, size = f"V_{d.B}{d.A}", abs(scene.solved.values[rate])
    line = _rate_line(scene, rate, v, d, size)
    return [*lines, line]


def _rate_line(scene: Scene, rate: str, v: str, d: Dyad, size: float) -> tuple[str, ...]:
    w = scene.words
    length = given(scene, d.length)
    texts, result = calculation(w, lambda x, y: x / y, [(size_of(scene, v), False), length])
    unit = w.unit(scene.solved.quantities[rate].unit)
    sense = "" if size == 0.0 else w["said.ccw" if scene.solved.values[rate] > 0 else "said.cw"]
    head = f"{w.symbol(rate)} = {w.symbol(v)}/{w.symbol(d.length)} ="
    return head, f"{texts[0]}/{texts[1]} =", f"{result} {unit}{',' if sense else ''}", sense


def _directions(scene: Scene, d: Dyad, along: str, across: str) -> tuple[str, ...]:
    w = scene.words
    return (f"{w.symbol(along, bar=True)} ∥ x–x,", f"{w.symbol(across, bar=True)} ⊥ {d.AB}")


def _similarity_lines(scene: Scene, d: Dyad, plan: str, relative: str) -> Lines:
    w = scene.words
    lines: Lines = []
    for point, (part, _) in d.rod.points.items():
        if point in (d.A, d.B):
            continue
        a, b, s = (w.mark(f"{plan}.{letter}") for letter in (d.A, d.B, point))
        ab = size_of(scene, relative) / scene.scales[plan].mu
        law = lambda x, y, z: x * y / z  # noqa: E731
        texts, result = calculation(w, law, [(ab, False), given(scene, part), given(scene, d.length)])
        ratio = f"{w.symbol(part)}/{w.symbol(d.length)}"
        mm = w["unit.mm"]
        lines.append((f"{a}{s} = {a}{b}·{ratio} =", f"{texts[0]}·{texts[1]}/{texts[2]} =", f"{result} {mm}"))
    return lines


def _acceleration_lines(scene: Scene, d: Dyad) -> Lines:
    w = scene.words
    aB, aA, n, t = (w.symbol(name, bar=True) for name in (f"a_{d.B}", f"a_{d.A}", f"a_{d.B}{d.A}_n", f"a_{d.B}{d.A}_t"))
    normal = f"a_{d.B}{d.A}_n"
    v = f"V_{d.B}{d.A}"
    lines: Lines = [
        (
            f"{by_direction(aB)} = {known(aA)} + {known(n)} + {by_direction(t)},",
            f"{n} ∥ {d.AB} ({d.B} → {d.A}),",
            f"{t} ⊥ {d.AB}",
        ),
        calculated(
            scene,
            normal,
            f"{w.symbol(v).replace('_', '^{2}_', 1)}/{w.symbol(d.length)}",
            "{}^{{2}}/{}",
            lambda x, y: x * x / y,
            (size_of(scene, v), False),
            given(scene, d.length),
        ),
        *_similarity_lines(scene, d, "acceleration", f"a_{d.B}{d.A}"),
    ]
    rate, speed = f"epsilon_{d.rod.number}", f"omega_{d.rod.number}"
    lines.append(_rate_line(scene, rate, f"a_{d.B}{d.A}_t", d, abs(scene.solved.values[rate])))
    omega, epsilon = scene.solved.values[speed], scene.solved.values[rate]
    still = "said.translates" if omega == 0.0 else "said.steady"
    key = still if omega * epsilon == 0.0 else "said.speeds_up" if omega * epsilon > 0 else "said.slows_down"
    text = w[key].format(link=d.rod.number, omega=w.symbol(speed), epsilon=w.symbol(rate))
    lines.append(tuple(text.split("|")))
    return lines
