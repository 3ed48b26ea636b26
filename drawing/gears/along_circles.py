"""Dimensions along circles: thickness of a tooth, space, pitch, angles of pitch and of action; and the radial gap."""

from __future__ import annotations

import cmath
from collections.abc import Sequence

from ..dimensions import linear
from ..shapes import Line, Pen
from ..symbols import angle_dimension
from ..view import Canvas
from .scene import GearScene
from .wheels import Wheel

INSIDE = 1.8  # heights of letters from the root circle to the arc of the pitch
TAU, PHI = 0.48, 0.76  # parts of the root's radius at which the angles of pitch and of action are dimensioned
CLOSE = 6.0  # radius of an arc in heights of letters
Ends = tuple[complex, complex]


def thickness(canvas: Canvas, scene: GearScene, wheel: Wheel) -> None:
    """Dimension on the reference circle a tooth beside the one in contact, away from N, and the space between both."""
    radius, i = wheel.radius(""), wheel.number
    tooth = wheel.at(radius, wheel.side), wheel.at(radius, wheel.side, active=False)
    along(canvas, scene, wheel, tooth, f"s_{i}")
    along(canvas, scene, wheel, (tooth[1], wheel.at(radius)), f"e_{i}")


def pitch(canvas: Canvas, scene: GearScene, wheel: Wheel, to_centre: bool) -> None:
    """Dimension the pitch below the root, on lines from the reference circle; these run `to_centre` with its angle."""
    i, radius = wheel.number, wheel.radius("")
    ends = wheel.at(radius, wheel.side), wheel.at(radius)
    low = wheel.radius("f") - INSIDE * scene.style.label
    foot = 0.0 if to_centre else (low - 0.4 * scene.style.label) / radius
    for end in ends:
        canvas.add(Line(end, wheel.centre + foot * (end - wheel.centre), Pen.THIN, role="extension", name=f"p_{i}"))
    along(canvas, scene, wheel, _on(wheel, ends, low), f"p_{i}")
    if to_centre:
        name = f"tau_{i}"
        along(canvas, scene, wheel, _on(wheel, ends, TAU * wheel.radius("f")), name)


def action(canvas: Canvas, scene: GearScene, pair: Sequence[Wheel]) -> None:
    """Dimension the angles by which the wheels turn while one pair of teeth touches, between rays to its flanks."""
    for wheel in pair:
        i = wheel.number
        ends = scene.mm(f"B{i}_start"), scene.mm(f"B{i}_end")
        for end in ends:
            canvas.add(Line(end, wheel.centre, Pen.THIN, role="ray", name=f"phi_alpha{i}"))
        name = f"phi_alpha{i}"
        along(canvas, scene, wheel, _on(wheel, ends, PHI * wheel.radius("f")), name)


def gaps(canvas: Canvas, scene: GearScene, pair: Sequence[Wheel]) -> None:
    """Dimension the radial gap on the line of centres at the root of both wheels."""
    text, height = f"{scene.words.symbol('c')}{scene.words.symbol('m')}", scene.style.text
    for wheel, mate in zip(pair, reversed(pair), strict=True):
        ends = scene.mm(f"C_f{wheel.number}"), scene.mm(f"C_a{mate.number}")
        linear(canvas, ends, 0j, "", f"gap_{wheel.number}")
        canvas.label(text, 0.5 * (ends[0] + ends[1]), prefer=complex(wheel.side, 0.0), clear=2.0, height=height)


def along(canvas: Canvas, scene: GearScene, wheel: Wheel, ends: Ends, name: str) -> None:
    """Dimension an arc about the wheel's centre between two points of it."""
    text, height = _text(scene, name), scene.style.text
    arms = [end - wheel.centre for end in ends]
    radius, start, sweep = abs(arms[0]), cmath.phase(arms[0]), cmath.phase(arms[1] / arms[0])
    canvas.add(angle_dimension(wheel.centre, radius, start, sweep, name, scene.style))
    out = cmath.rect(1.0, start + 0.5 * sweep)
    middle = wheel.centre + radius * out
    spare = text if radius < CLOSE * scene.style.label else ""  # near the centre there may be no room
    canvas.label(text, middle, prefer=-out, clear=1.0, height=height, spare=spare)


def _text(scene: GearScene, name: str) -> str:
    """Return what a dimension says; the pitch of both wheels is one."""
    if name.startswith(("tau_", "phi_")):
        return scene.angle(name)
    return scene.stated("p" if name.startswith("p_") else name)


def _on(wheel: Wheel, ends: Ends, radius: float) -> Ends:
    """Return the points of a circle about the centre that lie on the rays to the ends."""
    a, b = (wheel.centre + (end - wheel.centre) * (radius / abs(end - wheel.centre)) for end in ends)
    return a, b
