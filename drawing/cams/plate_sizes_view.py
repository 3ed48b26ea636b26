"""The plan of S over d2s/dphi2: the tangent at 45 degrees to the negative branch, the smallest cam for a plate."""

from __future__ import annotations

from itertools import pairwise

from ...plans.cams.construction import PLATE_SIZES
from ...plans.cams.dense import over_acceleration, touch_of_plate
from ..diagram import small
from ..dimensions import angle, linear
from ..figure import Figure, Stage
from ..shapes import Circle, Group, Head, Line, Pen, Polyline
from ..symbols import unit
from ..text import lay_out
from ..view import Canvas, View
from .diagrams_view import SAME
from .scene import CamScene, given
from .sizes_view import on_lines
from .text import transfer

PAST = 8.0  # mm by which axes run past the curve
OUT = {"r_0_flat_min": 14.0, "r_0_flat": 46.0}  # mm from the axis to the dimensions
ALONG = unit(-1.0 + 1.0j)  # up the tangent
LINE = 12.0  # mm by which the tangent runs past the place where it touches


def plate_sizes_view(scene: CamScene) -> View:
    """Draw the diagram, and what it gives: r_0min, and r_0 with the radius of curvature wanted."""
    solved, words = scene.solved, scene.words
    plate = solved.plate
    assert plate is not None
    canvas = FIGURE.canvas(scene)
    canvas.part("points")
    outline = _curve(canvas, scene)
    left, right = (end(p.real for p in outline) for end in (min, max))
    top, foot = max(p.imag for p in outline), -scene.drawn(plate.sizes.r_0, PLATE_SIZES)
    canvas.part("axes")
    for a, b in ((complex(left - PAST, 0.0), complex(right + PAST, 0.0)), (1j * (foot - PAST), 1j * (top + PAST))):
        canvas.add(Line(a, b, Pen.THIN, role="axis"), Head(b, b - a))
    canvas.label(words.symbol("s"), 1j * (top + PAST), prefer=1 + 0j, clear=1.2)
    canvas.label(words.symbol("d2s"), complex(right + PAST, 0.0), prefer=-1j, clear=1.2)
    canvas.part("tangent")
    _tangent(canvas, scene, -1j * scene.drawn(plate.sizes.r_0_min, PLATE_SIZES))
    canvas.part("points")
    _nodes(canvas, scene)
    canvas.part("centre")
    _sizes(canvas, scene)
    heading = words["heading.cam_plate_sizes"], scene.factor(scene.scale(PLATE_SIZES))
    return canvas.finish("plate_sizes", heading, transfer(scene, PLATE_SIZES))


def _curve(canvas: Canvas, scene: CamScene) -> list[complex]:
    """Draw the exact curve by smooth pieces, and the lines across where the acceleration jumps."""
    motion = scene.solved.motion
    every: list[complex] = []
    for phase in (motion.rise, motion.fall):
        curves = [scene.curve(piece, PLATE_SIZES) for piece in over_acceleration(scene.solved, phase)]
        canvas.add(Group(tuple(Polyline(points, Pen.MAIN) for points in curves), "curve", phase.name))
        ends = [(complex(0.0, curves[0][0].imag),), *curves, (complex(0.0, curves[-1][-1].imag),)]
        steps = [(a[-1], b[0]) for a, b in pairwise(ends) if abs(b[0] - a[-1]) > SAME]
        for k, (a, b) in enumerate(steps, start=1):
            canvas.add(Group((Line(a, b, Pen.MAIN),), "jump", f"{phase.name}.{k}"))
        every += [point for points in curves for point in points]
    return every


def _tangent(canvas: Canvas, scene: CamScene, foot: complex) -> None:
    """Draw the tangent at 45 degrees from past the place where it touches to its foot on the axis, with its angle."""
    touch = scene.drawn(touch_of_plate(scene.solved), PLATE_SIZES)
    canvas.add(Line(touch + ALONG * LINE, foot - ALONG * LINE, Pen.THIN, role="limit", name="convex"))
    canvas.add(scene.node(touch, "convex", "touch", filled=True))
    angle(canvas, foot, (1j, ALONG), 3.0 * scene.style.label, "tangent", "45°")


def _nodes(canvas: Canvas, scene: CamScene) -> None:
    """Mark and number the points on the section lines; at a jump both ends."""
    shared: dict[complex, list[str]] = {}
    for i, _ in on_lines(scene):
        for end in ("before", "after"):
            mark = f"{PLATE_SIZES}.{i}_{end}"
            if mark not in scene.solved.values:
                continue
            at = scene.mm(mark)
            key = next((other for other in shared if abs(other - at) < 2.5 * scene.style.node), at)
            if str(i) not in shared.setdefault(key, []):
                shared[key].append(str(i))
                canvas.add(scene.node(at, f"{i}_{end}"))
    for at, numbers in shared.items():
        canvas.label(", ".join(numbers), at, prefer=1j, clear=0.8, height=small(scene.style.text))


def _sizes(canvas: Canvas, scene: CamScene) -> None:
    """Dimension r_0min and r_0 downwards from the lowest place of the plate."""
    words, style, plate = scene.words, scene.style, scene.solved.plate
    assert plate is not None
    low, centre = (-1j * scene.drawn(size, PLATE_SIZES) for size in (plate.sizes.r_0_min, plate.sizes.r_0))
    canvas.add(Group((Circle(centre, 1.5 * style.node, Pen.MAIN, fill="white"),), "point", "O"))
    canvas.label("O", centre, prefer=1 - 1j, clear=1.0)
    sizes = ((low, "r_0_flat_min", plate.sizes.r_0_min), (centre, "r_0_flat", plate.sizes.r_0))
    for at, name, size in sizes:
        symbol = words.symbol(name)
        text = f"{symbol} = {scene.length(size)}"
        between = abs(at) - 2.0 * style.arrow
        if lay_out(text, style.text).width >= between > lay_out(symbol, style.text).width:
            text = symbol  # the number stands with the calculations
        linear(canvas, (at, 0j), complex(OUT[name], 0.0), text, name)


FIGURE = Figure(
    PLATE_SIZES,
    plate_sizes_view,
    ("mu_s_d2s", "reduction"),
    (
        Stage("axes", "plate_sizes.#"),
        Stage("points", "plate_sizes.#_before"),
        Stage("tangent", "plate_sizes.T"),
        Stage("centre", variant=given("r_0_flat")),
    ),
    "cam.plate_sizes",
)
