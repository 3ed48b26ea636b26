"""The scheme of the hoist to scale, beams, load, drum and rope, and its dynamic model: a mass between two springs."""

from __future__ import annotations

from dataclasses import replace

from ...plans.hoist.construction import SCHEME
from ..dimensions import linear
from ..figure import Figure, stages
from ..hardware import COILS, coils
from ..page import Layer
from ..shapes import Arrow, Circle, Group, Head, Line, Pen, Polyline, Text
from ..symbols import fixed_pivot, hatching, unit
from ..text import lay_out
from ..view import Canvas, View
from .scene import HoistScene

LOAD = 0.45  # of the rope's length, the height of the load at most
BOX = 12.0  # mm, the load's height at most
DRUM = 3.0  # mm, radius
SPRING, HALF = 26.0, 4.0  # mm: length of a spring, half its width
MASS = 11.0, 13.0  # mm: half the width and the height of the mass
LEG = 4.0  # mm, straight ends of a spring
FORCE = 13.0  # mm, an arrow
BEAMS = {"0": "support", "2": "bridge"}  # stages


def scheme_view(scene: HoistScene) -> View:
    """Draw the scheme with its dimensions."""
    canvas, words, style = SCHEME_FIGURE.canvas(scene), scene.words, scene.style
    at = {mark: scene.mm(f"{SCHEME}.{mark}") for mark in ("O1", "O2", "A0", "A2", "B1", "B2")}
    rope = abs(at["A2"] - at["A0"])
    canvas.part("support")
    tall = min(BOX, LOAD * rope)
    corners = tuple(at["A0"] + complex(x * 0.8 * tall, y * tall) for x, y in ((-1, 0), (1, 0), (1, 1), (-1, 1)))
    canvas.add(Group((Polyline(corners, Pen.MAIN, closed=True, fill="white"),), "link", "1"))
    canvas.part("rope")
    canvas.add(Line(at["A0"] + 1j * tall, at["A2"], Pen.MAIN, role="rope", name="L"))
    canvas.add(Group((Circle(at["A2"], DRUM, Pen.MAIN, fill="white"),), "drum", "A2"))
    for left, right, number in (("O1", "O2", "0"), ("B1", "B2", "2")):
        canvas.part(BEAMS[number])
        canvas.add(Group((Line(at[left], at[right]),), "link", number))
        supports = fixed_pivot(at[left], left, style), rolling_support(at[right], right, scene)
        canvas.add(*(replace(one, layer=Layer.RESULT.value) for one in supports))  # they cover the ends of the beam
    for mark, letter in (("A0", "A_{0}"), ("A2", "A_{2}")):
        canvas.part("support" if mark == "A0" else "rope")
        canvas.label(letter, at[mark], prefer=(1.0 + 1j) if mark == "A2" else (1.0 - 1j), clear=DRUM)
    canvas.keep_clear(*corners)
    canvas.part("support")
    h, name = style.label, words.symbol("G_1")
    if tall > 1.5 * h and 1.6 * tall > lay_out(name, h).width + 1.0:
        canvas.add(Text(at["A0"] + complex(0.0, 0.5 * (tall - h) + 0.1 * h), name, h, "middle", role="label"))
    else:
        canvas.label(name, at["A0"] + complex(0.8 * tall, 0.5 * tall), prefer=1.0 + 0j, clear=1.0)
    _dimensions(canvas, scene, at)
    ratio = f"{words.drawn_at(scene.mus['mu_l'])};  {scene.factors('mu_l')}"
    return canvas.finish("scheme", (words["heading.hoist_scheme"], ratio))


def _dimensions(canvas: Canvas, scene: HoistScene, at: dict[str, complex]) -> None:
    """Dimension spans, the places of load and drum from the nearer ends, and the rope."""
    layout, drop = scene.solved.layout, -1j * (scene.style.pivot[1] + 2.0 * scene.style.pair + 8.0)
    step = -1j * 3.2 * scene.style.text
    for i, ends, mark in ((0, ("O1", "O2"), "A0"), (2, ("B1", "B2"), "A2")):
        canvas.part(BEAMS[str(i)])
        near = ends[0] if layout.near[i // 2] == "left" else ends[1]
        pair = tuple(sorted((at[near], at[mark]), key=lambda p: p.real))
        linear(canvas, (pair[0], pair[1]), drop, scene.stated(f"b_{i}", unit="m"), f"b_{i}")
        linear(canvas, (at[ends[0]], at[ends[1]]), drop + step, scene.stated(f"l_{i}", unit="m"), f"l_{i}")
    canvas.part("rope")
    far = max(at["O2"].real, at["B2"].real) + scene.style.pivot[2]
    linear(canvas, (at["A0"], at["A2"]), complex(far - at["A0"].real), scene.stated("L", unit="m"), "L")


def rolling_support(at: complex, name: str, scene: HoistScene) -> Group:
    """Return a support that can roll: circle, triangle, rollers on a hatched line."""
    width, height, base = scene.style.pivot
    pivot = fixed_pivot(at, name, scene.style)
    foot = at - 1j * (height + scene.style.pair)
    radius = 0.14 * height
    below = foot - 2j * radius
    rollers = tuple(Circle(foot + complex(x * 0.3 * width, -radius), radius, Pen.THIN) for x in (-1, 0, 1))
    ends = below - 0.5 * base, below + 0.5 * base
    kept = tuple(shape for shape in pivot.shapes if not (isinstance(shape, Line) and shape.role == "hatch"))
    ground = Line(*ends), *hatching(*ends, -1j, scene.style)
    return Group((Group(kept, "pivot", name), Group((*rollers, *ground), "rollers", name)), "support", name)


SCHEME_FIGURE = Figure("scheme", scheme_view, ("mu_l",), stages("blank", "support", "rope", "bridge"), "hoist.scheme")


def model_view(scene: HoistScene) -> View:
    """Draw the model with its axis, springs, forces."""
    canvas, words = MODEL.canvas(scene), scene.words
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
    leg = LEG * unit(b - a)
    step = (b - a - 2.0 * leg) / (2 * COILS)
    bends = coils([a + leg + step * (k + 0.5) for k in range(2 * COILS)], -HALF)
    return Group((Polyline((a, a + leg, *bends, b - leg, b), Pen.THIN),), "spring", name)


MODEL = Figure("model", model_view, stages=stages("blank", "model"), key="hoist.model")
