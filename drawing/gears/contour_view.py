"""The blocking contour: the plane of both shifts with the curves that bound them, and the shifts of the pair."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ...plans.gears.blocking import BLOCKING, CURVES, OF_CURVE, RATIOS, Plane, plane_of
from ...scales.scale import Scale, steps
from ..diagram import Axis, Field, divisions
from ..figure import GIVEN
from ..shapes import Circle, Group, Head, Line, Pen, Polyline, Text
from ..thinning import freest, thinned
from ..view import Canvas, View
from .sheet import GearScene

SIDE = {5.0: 200.0, 3.5: 80.0}  # mm of the longer side of the window, by the height of letters
FINE = 0.05  # mm by which a chord may miss its curve: places between are left out
APART = 4.2  # heights of numbers at least between divisions
REACH = 4.0  # mm of a curve to both sides of the place where its name stands
PAST = 1.6  # heights of letters by which arrows run past the window
EACH = 0.7  # of the longer side of the window: a curve has a number for each such part of it
LEAST = 0.2  # of the longer side: shorter curves in a corner of the window, which bound nothing, are left out
IN_A_LINE = 3  # entries of the legend
STEP = 2.0  # mm between places that are looked at
Runs = list[tuple[complex, ...]]  # of a curve that passes through the window several times


def contour_view(scene: GearScene) -> View:
    """Draw the window round the contour of the wheels."""
    plane = plane_of(scene.solved.givens, scene.solved.pair.least_tip)
    canvas, words = Canvas(scene.style), scene.words
    field = _field(scene, plane)
    _frame(canvas, scene, field)
    sides = plane.contour()
    curves = {name: [_thinned(field, run) for run in plane.curve(name)] for name in CURVES}
    least = LEAST * SIDE[scene.style.label]
    for name in set(CURVES).difference(name for name, _ in sides):
        curves[name] = [run for run in curves[name] if abs(run[-1] - run[0]) >= least]
    for name, runs in curves.items():
        pen = Pen.THIN if name in BLOCKING else Pen.DASHED
        canvas.add(Group(tuple(Polyline(run, pen) for run in runs), "limit", name))
    for name, side in sides:
        canvas.add(Group((Polyline(_thinned(field, side), Pen.MAIN),), "contour", name))
    _chosen(canvas, scene, field)
    _numbers(canvas, scene, curves)
    mu = f"{words.symbol('mu_x')} = {words.short(field.x.scale.mu)} {words.unit('mm')}^{{−1}}"
    texts = [f"{n}: {limit(scene, name)}" for n, name in enumerate(seen(curves), start=1)]
    legend = (";  ".join(texts[k : k + IN_A_LINE]) for k in range(0, len(texts), IN_A_LINE))
    notes = words["gear.contour_lines"], *legend, f"●  {';  '.join(map(scene.shift, ('x_1', 'x_2')))}"
    return canvas.finish("contour", (words["heading.gear_contour"], mu), notes)


def _field(scene: GearScene, plane: Plane) -> Field:
    """Return the plane on the paper, equal scale factors on both axes."""
    size, words = plane.high - plane.low, scene.words
    mu = steps(max(size.real, size.imag) / SIDE[scene.style.label])[0]
    scale = Scale("mu_x", mu, "1")
    ends = ((plane.low.real, plane.high.real), (plane.low.imag, plane.high.imag))
    axes = []
    for i, (low, high) in enumerate(ends, start=1):
        numbers = (*divisions(high, low, mu, APART * scene.style.text), 0.0)
        axes.append(Axis(words.symbol(f"x_{i}"), scale, low, high, {v: words.short(v) for v in numbers}))
    return Field(0j, *axes)


def _frame(canvas: Canvas, scene: GearScene, field: Field) -> None:
    """Draw the sides of the window with divisions below and on the left, the axes where they pass through it."""
    x, y, height = field.x, field.y, scene.style.text
    corners = tuple(field.at(*at) for at in ((x.low, y.low), (x.high, y.low), (x.high, y.high), (x.low, y.high)))
    canvas.add(Polyline(corners, Pen.THIN, closed=True, role="window"))
    tick = 0.4 * height
    for value, text in x.divisions.items():
        if x.low <= value <= x.high:
            foot = field.at(value, y.low)
            canvas.add(Line(foot, foot + 1j * tick, Pen.THIN, role="division"))
            canvas.add(Text(foot - 1.6j * height, text, height, "middle", role="number"))
    for value, text in y.divisions.items():
        if y.low <= value <= y.high:
            foot = field.at(x.low, value)
            canvas.add(Line(foot, foot + tick, Pen.THIN, role="division"))
            canvas.add(Text(foot - 0.6 * height - 0.5j * height, text, height, "right", role="number"))
    before = canvas.part(GIVEN)
    if y.low < 0.0 < y.high:
        canvas.add(Line(field.at(x.low, 0.0), field.at(x.high, 0.0), Pen.AXIS, role="axis"))
    if x.low < 0.0 < x.high:
        canvas.add(Line(field.at(0.0, y.low), field.at(0.0, y.high), Pen.AXIS, role="axis"))
    canvas.part(before)
    label = scene.style.label
    for end, along, letter, aside in (
        (corners[1], 1 + 0j, x.letter, complex(0.0, 0.6 * label)),
        (corners[3], 1j, y.letter, complex(0.8 * label, -0.5 * label)),
    ):
        tip = end + PAST * label * along
        canvas.add(Line(end, tip, Pen.THIN, role="axis"), Head(tip, along))
        canvas.add(Text(tip + aside, letter, label, "middle" if along == 1 else "left"))
    canvas.bounds = (corners[0].real, corners[0].imag, corners[2].real, corners[2].imag)


def _thinned(field: Field, run: Iterable[complex]) -> tuple[complex, ...]:
    """Return places of a curve on the paper, those left out that a chord passes closely."""
    return thinned([field.at(place.real, place.imag) for place in run], FINE)


def _chosen(canvas: Canvas, scene: GearScene, field: Field) -> None:
    """Mark the shifts of the pair."""
    x_1, x_2 = scene.size("x_1"), scene.size("x_2")
    at = field.at(x_1, x_2)
    for foot in (field.at(x_1, field.y.low), field.at(field.x.low, x_2)):
        canvas.add(Line(at, foot, Pen.DASHED, role="projection"))
    canvas.add(Group((Circle(at, 1.5 * scene.style.node, Pen.MAIN, fill="black"),), "point", "chosen"))


def _numbers(canvas: Canvas, scene: GearScene, curves: Mapping[str, Runs]) -> None:
    """Number the curves that pass through the window, long ones in several places, where they are far from others."""
    dense = [(name, run) for name, runs in curves.items() for run in runs]
    numbers = {name: str(n) for n, name in enumerate(seen(curves), start=1)}
    for n, at, along in freest([run for _, run in dense], STEP, EACH * SIDE[scene.style.label]):
        ends = at - REACH * along, at + REACH * along
        canvas.label(numbers[dense[n][0]], ends, clear=0.8, height=scene.style.text)


def seen(curves: Mapping[str, Runs]) -> list[str]:
    """Return the names of the curves that pass through the window."""
    return [name for name, runs in curves.items() if runs]


def limit(scene: GearScene, name: str) -> str:
    """Return what a curve stands for, in symbols."""
    words = scene.words
    kind, of = OF_CURVE[name]
    if kind == "contact":
        return f"{words.symbol('epsilon_alpha')} = {words.short(RATIOS[name])}"
    if kind in ("pointed", "thin"):
        least = "0" if kind == "pointed" else f"{words.short(scene.solved.pair.least_tip)}m"
        return f"{words.symbol(f's_a{of}')} = {least}"
    first, second = {"undercut": ("x_", "x_min"), "interference": ("rho_l", "rho_p")}[kind]
    return f"{words.symbol(f'{first}{of}')} = {words.symbol(f'{second}{of}')}"
