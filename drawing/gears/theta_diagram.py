"""Specific sliding over the line of action: both curves, cut off at a stated value, their active part hatched."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ...plans.gears.geometry import POINTS
from ...scales.scale import Scale
from ..areas import strokes
from ..diagram import Axis, Field, curve, divisions
from ..figure import ANSWERS
from ..shapes import Circle, Group, Line, Pen, Text
from ..view import Canvas
from ..words import Words
from .ladders import CURVES, ENDS, cut_of, theta_mu
from .scene import GearScene

APART = 1.6  # heights of letters between lines of text
PLACES = 240  # of a curve
HATCH = 2.5  # mm between strokes


def place(scene: GearScene, point: str) -> float:
    """Return how far a point of the table is from N1, m."""
    return float(scene.solved.values[f"_rho_1_{point}"])


def theta_scale(scene: GearScene) -> Scale:
    """Return the scale factor of specific sliding."""
    return Scale("mu_theta", theta_mu(scene.solved, scene.style.label, scene.part), "1")


def theta_said(words: Words, mu: float) -> str:
    """Return the scale factor of specific sliding, which has no unit of its own."""
    return f"{words.symbol('mu_theta')} = {words.short(mu)} {words.unit('mm')}^{{−1}}"


def theta_field(scene: GearScene, above: Field, apart: float) -> Field:
    """Return the axes of specific sliding under those of the velocities."""
    words, low, scale = scene.words, cut_of(scene.solved), theta_scale(scene)
    marks = {value: words.short(value) for value in divisions(1.0, low, scale.mu, 9.0)}
    origin = above.origin - 1j * (apart + 1.0 / scale.mu)
    return Field(origin, replace(above.x, letter=""), Axis(words.symbol("theta"), scale, low, 1.0, marks))


def theta_diagram(canvas: Canvas, scene: GearScene, field: Field) -> None:
    """Draw both curves with the points of the table, the active part hatched, its extremes with their values."""
    canvas.part("sliding")
    for i, name in CURVES.items():
        places = _places(scene, i, field.y.low)
        curve(canvas, field, places, name)
        points = ((p, place(scene, p), scene.size(f"{name}_{p}")) for p in POINTS)
        canvas.add(
            *(
                Group((Circle(field.at(rho, value), scene.style.node, Pen.THIN, fill="white"),), "node", f"{name}_{p}")
                for p, rho, value in points
                if value >= field.y.low
            )
        )
        _active(canvas, scene, field, i)
        canvas.label(scene.words.symbol(name), _free(scene, field, i), prefer=1j, clear=1.0)
    canvas.part(ANSWERS)
    _extremes(canvas, scene, field)


def sliding_at(scene: GearScene, i: int, rho_1: np.ndarray) -> np.ndarray:
    """Return specific sliding of a wheel at distances from N1, m."""
    rho_2 = scene.size("l_N1N2") - rho_1
    u = scene.size("u")
    with np.errstate(divide="ignore"):
        return np.asarray(1.0 - rho_2 / (u * rho_1) if i == 1 else 1.0 - u * rho_1 / rho_2)


def _places(scene: GearScene, i: int, low: float) -> list[tuple[float, float]]:
    """Return places of a curve from where it is cut off to the end of the line of action, close where it is steep."""
    line, u = scene.size("l_N1N2"), scene.size("u")
    ratio = u if i == 1 else 1.0 / u
    first = line / (1.0 + ratio * (1.0 - low))  # own curvature there
    own = first * (line / first) ** np.linspace(0.0, 1.0, PLACES)
    own[-1] = line
    rho_1 = own if i == 1 else line - own
    theta = 1.0 - (line - own) / (ratio * own)
    return list(zip(rho_1.tolist(), theta.tolist(), strict=True))


def _active(canvas: Canvas, scene: GearScene, field: Field, i: int) -> None:
    """Hatch the area between a curve and the axis over the active line, with lines at both ends."""
    line = scene.size("l_N1N2")
    first, last = (min(max(scene.size(name), 0.0), line) for name in ("rho_p1", "rho_a1"))
    rho = np.linspace(first, last, PLACES)[1:-1] if last > first else np.array([])
    theta = np.maximum(sliding_at(scene, i, rho), field.y.low)
    inner = [field.at(x, y) for x, y in zip(rho.tolist(), theta.tolist(), strict=True)]
    if not inner:
        return
    outline = [field.at(first, 0.0), *inner, field.at(last, 0.0)]
    along = cmath.rect(1.0, math.pi / 4.0 if i == 1 else 3.0 * math.pi / 4.0)
    canvas.add(Group(tuple(strokes(outline, along, HATCH)), "active", CURVES[i]))


def _free(scene: GearScene, field: Field, i: int) -> tuple[complex, complex]:
    """Return a part of a curve above the axis, between lines that are far apart: room for its letter."""
    pole, side = scene.size("rho_w1"), 1.0 if i == 1 else -1.0
    beyond = [p for p in POINTS if (place(scene, p) - pole) * side >= 0.0]
    return widest([field.at(place(scene, p), scene.size(f"{CURVES[i]}_{p}")) for p in beyond], field.at(pole, 0.0))


def widest(tips: Sequence[complex], pole: complex) -> tuple[complex, complex]:
    """Return the two neighbours that are farthest apart across, but for those beside the pole."""
    pairs = sorted(pairwise(tips), key=lambda ends: abs((ends[0] + ends[1]).real - 2.0 * pole.real))
    return max(pairs[1:] or pairs, key=lambda ends: abs((ends[1] - ends[0]).real))


def _extremes(canvas: Canvas, scene: GearScene, field: Field) -> None:
    """Carry the ends of the active part of both curves to the right of the diagram, where their values stand."""
    words, height = scene.words, scene.style.text
    right = field.at(field.x.high, 0.0).real
    shown = []
    for end, rho in ENDS.items():
        values = {name: scene.size(f"{name}_{end}") for name in CURVES.values()}
        seen = {name: value for name, value in values.items() if field.y.low <= value <= 1.0}
        tips = [field.at(scene.size(rho), value) for value in (*seen.values(), 0.0)]
        low, high = (pick(tips, key=lambda tip: tip.imag) for pick in (min, max))
        if high != low:
            canvas.add(Line(low, high, Pen.MAIN, role="end", name=end))
        for (name, value), at in zip(seen.items(), tips, strict=False):
            canvas.add(Group((Circle(at, scene.style.node, Pen.THIN, fill="black"),), "extreme", f"{name}_{end}"))
            shown.append((at, f"{words.symbol(f'{name}_{end}')} = {words.number(value, 2)}"))
    levels = spread([at.imag for at, _ in shown], field.origin.imag, APART * height)
    for (at, text), level in zip(shown, levels, strict=True):
        corner, start = complex(right + 1.5, at.imag), complex(right + 1.5 + 0.8 * height, level)
        canvas.add(Line(at, corner, Pen.DASHED, role="projection"), Line(corner, start, Pen.THIN, role="leader"))
        canvas.add(Text(start + complex(0.4 * height, -0.5 * height), text, height, role="extreme"))


def spread(levels: Sequence[float], axis: float, apart: float) -> list[float]:
    """Return levels of texts, in the order given, so far apart, and from the axis: moved away from this."""
    found = dict.fromkeys(range(len(levels)), 0.0)
    for side in (1.0, -1.0):
        last = axis
        for n in sorted(range(len(levels)), key=lambda n: side * levels[n]):
            if side * (levels[n] - axis) >= 0.0 and (side > 0.0 or levels[n] < axis):
                last = side * max(side * levels[n], side * last + apart)
                found[n] = last
    return list(found.values())
