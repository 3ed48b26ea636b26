"""The driver drawn apart with its forces, their arms, and what balances it: a moment, or a force."""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterator, Mapping
from dataclasses import replace

from ....plans.board import POSITION
from ....plans.linkages.mechanism import FRAME, Driver, Prismatic
from ....scales.scale import Scale
from ...shapes import Arrow, Group, Line, Shape
from ...symbols import turning_arrow
from ...view import Canvas, View
from ..scene import DRIVER, Scene
from ..skeleton import guide_of
from .acting import Contact, couples, handed, loads, moments_of
from .group import Sketch
from .links import draw_frame, draw_links, foot_of, letter_links


class Apart(Mapping[str, Scale]):
    """Scale factors by plan, that of the driver's own figure in the place of that of the mechanism."""

    def __init__(self, scales: Mapping[str, Scale]) -> None:
        self._scales = scales

    def __getitem__(self, plan: str) -> Scale:
        """Return the scale factor of a plan."""
        return self._scales[DRIVER if plan == POSITION and DRIVER in self._scales else plan]

    def __iter__(self) -> Iterator[str]:
        """Go through the plans."""
        return iter(self._scales)

    def __len__(self) -> int:
        """Return the number of plans."""
        return len(self._scales)


def driver_view(scene: Scene) -> View:
    """Draw the driver with all reactions on it, its own loads, R_01, what balances it, and the arms of the forces."""
    scene = replace(scene, scales=Apart(scene.scales))
    canvas, number = Canvas(scene.style), scene.solved.structure.driver
    figures = draw_links(canvas, scene, (number,))
    draw_frame(canvas, scene, (number,), figures)
    sketch = Sketch(canvas, scene, figures)
    hung = [*handed(scene, number), *loads(scene, number)]
    for name, point in hung:
        if point not in scene.solved.mechanism.frame_points:
            sketch.force(name, scene.mm(point))
    sketch.letter_others(point for _, point in hung)
    sketch.arms(moments_of(scene, (number,)))
    driver = scene.solved.mechanism.driver
    if isinstance(driver, Driver):
        _crank(sketch, driver)
    else:
        _slider(sketch, number)
    for name in couples(scene, number):
        sketch.couple(name, figures[0])
    letter_links(canvas, scene, (number,), figures)
    return canvas.finish("driver", scene.heading("heading.driver", POSITION), sketch.notes())


def _crank(sketch: Sketch, driver: Driver) -> None:
    """Hang R_01 on the pivot, loads that stand there, and what balances the crank."""
    scene, o = sketch.scene, sketch.scene.mm(driver.pivot)
    foot = foot_of(scene, driver.pivot, sketch.figures)
    sketch.arrows.bar(o, (foot * rect(1.0, lean) for lean in (-0.5, 0.0, 0.5)))
    sketch.force(f"R_{scene.solved.mechanism.index(FRAME, driver.link)}", o)
    for name, point in loads(scene, driver.link):
        if point in scene.solved.mechanism.frame_points:
            sketch.force(name, scene.mm(point))
    if "M_bal" in scene.solved.values:
        _balance(sketch, o)
    else:
        sketch.force("_F_bal", scene.mm(driver.point))


def _slider(sketch: Sketch, number: int) -> None:
    """Hang the guide's reaction where it acts, and the balancing force along the guide."""
    scene = sketch.scene
    pair = next(p for p in scene.solved.mechanism.pairs if isinstance(p, Prismatic) and number in p.links)
    index = scene.solved.mechanism.index(FRAME, number)
    pin, u, reaction = scene.mm(pair.point), guide_of(scene, pair), f"R_{index}"
    sketch.force("_F_bal", pin)
    moment, size = scene.solved.values[f"M_{index}"], scene.direction(reaction)
    across = ((complex(scene.solved.values[reaction]) / u).imag) if size != 0 else 0.0
    couple = f"M_{index}" if across == 0.0 and moment != 0.0 else ""
    found = Contact(f"h_{index}", pair.point, u, moment / across if across else 0.0, couple)
    sketch.force(reaction, sketch.contact(found, reaction))
    if couple:
        sketch.couple(couple, sketch.figures[0])


def _balance(sketch: Sketch, o: complex) -> None:
    """Draw M_bal about the pivot."""
    scene, canvas = sketch.scene, sketch.canvas
    value = scene.solved.values["M_bal"]
    if value != value or scene.vanishes("M_bal"):
        sketch.zero.append("M_bal")
        return
    sense, radius = math.copysign(1.0, value), 0.62 * scene.style.force
    # on the freest side of O: the pivot's foot, the crank, the reaction and the arms of forces leave from there too
    ends = [end for shape in canvas.shapes for end in _ends(shape) if 0.1 < abs(end - o) < 3 * radius]
    rays = [end - o for figure in sketch.figures for stroke in figure.strokes for end in stroke if abs(end - o) > 0.1]
    busy = [-1j, 1 - 1.5j, -1 - 1.5j, *rays, *((end - o) / abs(end - o) for end in ends)]
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
