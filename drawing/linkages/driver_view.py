"""The driver drawn apart with its forces, the arm of R_21 and the balancing moment."""

from __future__ import annotations

import math
from cmath import phase, rect

from ...plans.linkages.parts import arm_of
from ..shapes import Arrow, Group, Line, Shape
from ..symbols import fixed_pivot, force_arrow, link, revolute, turning_arrow
from ..view import Canvas, View
from .group_view import force_arm, letter_arrow, loads, zeros
from .scene import Scene


def driver_view(scene: Scene) -> View:
    """Draw the crank with R_21, R_01, M_bal and the arm h_21 measured from the pivot."""
    canvas = Canvas(scene.style)
    driver, words, style = scene.solved.mechanism.driver, scene.words, scene.style
    o, a = scene.mm(driver.pivot), scene.mm(driver.point)
    e = (a - o) / abs(a - o)
    canvas.add(link(o, a, str(driver.link), style))
    canvas.add(fixed_pivot(o, driver.pivot, style), revolute(a, driver.point, style))
    forces = [(f"R_{d.rod.number}{driver.link}", d.A) for d in scene.dyads if d.before == driver.link]
    forces += loads(scene, driver.link)
    for name, point in forces:
        if scene.direction(name) == 0 or point == driver.pivot:
            continue
        letter_arrow(canvas, scene, *force_arrow(scene.mm(point), scene.direction(name), name, [-e], [], style))
        force_arm(canvas, scene, [name], [arm_of(name, driver.link)], scene.mm(point), o)
    name = f"R_0{driver.link}"
    if scene.direction(name) != 0:
        letter_arrow(canvas, scene, *force_arrow(o, scene.direction(name), name, [e, -1j], [], style))
    _, height, base = style.pivot
    foot = o - 1j * (height + style.pair)
    canvas.keep_clear(foot - base / 2 - 1j * style.hatch[0], foot + base / 2)
    _balance(canvas, scene, o, e)
    for point in (driver.pivot, driver.point):
        canvas.label(words.mark(point), scene.mm(point), clear=style.pair + 0.8)
    canvas.label(str(driver.link), (o, a))
    arms = [arm_of(force, driver.link) for force, _ in forces if scene.direction(force) != 0]
    notes = (words["said.arrows"], *zeros(scene, [*(force for force, _ in forces), name, "M_bal"], arms))
    return canvas.finish("driver", scene.heading("heading.driver", "position"), notes)


def _balance(canvas: Canvas, scene: Scene, o: complex, e: complex) -> None:
    value = scene.solved.values.get("M_bal")
    if not value or value != value:
        return
    sense, radius = math.copysign(1.0, value), 0.62 * scene.style.force
    # on the freest side of O: the pivot's foot, the crank, the reaction and the arms of forces leave from there too
    ends = [end for shape in canvas.shapes for end in _ends(shape) if 0.1 < abs(end - o) < 3 * radius]
    busy = [-1j, 1 - 1.5j, -1 - 1.5j, e, *((end - o) / abs(end - o) for end in ends)]
    middle = max(
        (k * math.pi / 12 for k in range(24)),
        key=lambda angle: (round(min(abs(phase(rect(1.0, angle) / ray)) for ray in busy), 6), -angle),
    )
    canvas.add(turning_arrow(o, radius, middle, 1.5, sense, "M_bal"))
    canvas.label(scene.words.symbol("M_bal"), o + rect(radius, middle), prefer=rect(1.0, middle), clear=1.4)


def _ends(shape: Shape) -> tuple[complex, ...]:
    """Return the ends of an arrow, or of the line of an arm."""
    match shape:
        case Arrow(tail=tail, tip=tip):
            return tail, tip
        case Group(role="arm", shapes=(Line(a=a, b=b), *_)):
            return a, b
        case _:
            return ()
