"""The dynamic model: ground, spring of the support, reduced mass, spring of rope and bridge, the moving end."""

from __future__ import annotations

from ..figure import Figure, stages
from ..shapes import Arrow, Group, Head, Line, Pen, Polyline, Text
from ..symbols import hatching
from ..view import Canvas, View
from .scene import COARSE, HoistScene

SPRING, COILS, HALF = 26.0, 5, 4.0  # mm: length of a spring, its coils, half its width
MASS = 11.0, 13.0  # mm: half the width and the height of the mass
LEG = 4.0  # mm, straight ends of a spring
FORCE = 13.0  # mm, an arrow


def model_view(scene: HoistScene) -> View:
    """Draw the model with its axis, springs, forces."""
    canvas, words = MODEL.canvas(scene, COARSE), scene.words
    canvas.part("model")
    half, tall = MASS
    bottom = 1j * SPRING
    top = bottom + 1j * tall
    end = top + 1j * SPRING
    canvas.add(Group((Line(-14.0 + 0j, 14.0 + 0j), *hatching(-14.0 + 0j, 14.0 + 0j, -1j, scene.style)), "ground", "0"))
    canvas.add(spring(0j, bottom, "C_01"), spring(top, end, "C_12"))
    box = tuple(complex(x, y) for x, y in ((-half, SPRING), (half, SPRING), (half, top.imag), (-half, top.imag)))
    canvas.add(Group((Polyline(box, Pen.MAIN, closed=True, fill="white"),), "link", "m"), Line(end - 9.0, end + 9.0))
    h = scene.style.label
    canvas.add(Text(0.5 * (bottom + top) - 0.35j * h, "m", h, "middle", role="label"))
    for name, at in (("C_01", 0.28 * bottom), ("C_12", 0.5 * (top + end))):
        canvas.label(words.symbol(name), at - HALF, prefer=-1.0 + 0j, clear=1.0)
    _arrow(canvas, end + 6.0, end + 6.0 + 1j * FORCE, f"{words.symbol('V_t')}, a")
    _arrow(canvas, top + 6.0, top + 6.0 + 1j * FORCE, words.symbol("F_12"))
    _arrow(canvas, bottom + 6.0, bottom + 6.0 - 1j * FORCE, words.symbol("F_01"))
    _arrow(canvas, bottom - 8.5, bottom - 8.5 - 1j * FORCE, "mg")
    axis = complex(half + 12.0, 0.0)
    canvas.add(
        Line(axis, axis + end, Pen.THIN, role="axis"), Head(axis + end, 1j), Line(axis - 2.0, axis + 2.0, Pen.THIN)
    )
    canvas.label("s", axis + end, prefer=1.0 + 0j, clear=1.2)
    return canvas.finish("model", (words["heading.hoist_model"],))


def _arrow(canvas: Canvas, tail: complex, tip: complex, letter: str) -> None:
    canvas.add(Arrow(tail, tip, name=letter))
    canvas.label(letter, tip, prefer=(1.0 + 0j) if tip.real > 0.0 else (-1.0 + 0j), clear=1.2)


def spring(a: complex, b: complex, name: str) -> Group:
    """Return a spring from `a` to `b`."""
    along = (b - a) / abs(b - a)
    inner = abs(b - a) - 2.0 * LEG
    places = [a, a + along * LEG]
    for k in range(2 * COILS):
        side = HALF if k % 2 == 0 else -HALF
        places.append(a + along * (LEG + inner * (k + 0.5) / (2 * COILS)) + 1j * along * side)
    return Group((Polyline((*places, b - along * LEG, b), Pen.THIN),), "spring", name)


MODEL = Figure("model", model_view, stages=stages("blank", "model"), key="hoist.model")
