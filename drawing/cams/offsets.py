"""At a given r_0: the circle on which the cam's centre lies, and the part of it that keeps the limits."""

from __future__ import annotations

import math

from ..shapes import Arc, Group, Line, Pen
from ..view import Canvas
from .scene import CamScene

OVER = math.radians(4.0)  # of the circle beyond the permitted part
TICK = 2.0  # mm to both sides of the circle


def permitted_offsets(canvas: Canvas, scene: CamScene, mu: float) -> None:
    """Draw the circle of a given r_0 about the lowest place of the roller's centre, its permitted part thick."""
    roller = scene.solved.roller
    if roller is None or roller.offsets is None:
        return
    radius, found = roller.sizes.r_0, roller.offsets
    low, high = (math.asin(e / radius) - math.pi / 2 for e in (found.least, found.most))
    at = math.asin(roller.sizes.e / radius) - math.pi / 2
    first, last = min(low, at) - OVER, max(high, at) + OVER
    canvas.add(Arc(0j, radius / mu, first, last - first, Pen.AXIS, role="circle", name="r_0"))
    canvas.add(Group((Arc(0j, radius / mu, low, high - low, Pen.MAIN),), "offsets", "e"))
    for name, angle, side in (("e_least", low, -1.0), ("e_most", high, 1.0)):
        out = complex(math.cos(angle), math.sin(angle))
        end = out * (radius / mu)
        canvas.add(Line(end - TICK * out, end + TICK * out, Pen.THIN, role="offset", name=name))
        canvas.label(scene.words.symbol(name), end, prefer=complex(side, -1.0), height=scene.style.text)


def offsets_line(scene: CamScene) -> list[str]:
    """Return the offsets permitted at a given r_0, and the one chosen."""
    roller, words = scene.solved.roller, scene.words
    if roller is None or roller.offsets is None:
        return []
    found, e = roller.offsets, roller.sizes.e
    sizes = {"e_least": found.least, "e": e, "e_most": found.most}
    least, chosen, most = (f"{words.symbol(n)} = {scene.length(size)} {words.unit('mm')}" for n, size in sizes.items())
    if e < found.least:
        return [f"{chosen} < {least}"]
    return [f"{chosen} > {most}" if e > found.most else f"{least} ≤ {chosen} ≤ {most}"]
