"""What acts on each link, as the program has it: a group, one of its links, and the driver drawn apart with it."""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from ....plans.board import POSITION
from ....plans.linkages.mechanism import FRAME, Driver, Pair, Prismatic
from ....plans.linkages.structure import Group
from ....plans.names import role
from ...shapes import Arrow, Line, Shape
from ...shapes import Group as Shapes
from ...symbols import turning_arrow, unit
from ...view import View
from ..ladders import DRIVER
from ..scene import Scene
from .links import draw_links, foot_of, guide_of
from .scheme import special_points
from .sketch import Sketch

Hung = list[tuple[str, str]]  # force, mark of the point where it acts
Reaction = tuple[str, Pair, int, list[str]]  # pin, pair, own link in it, names of the force or its parts


def _loads(scene: Scene, number: int) -> Hung:
    """Return (force, point) of the loads on a link: inertia force, weight, then outer ones."""
    mechanism, centre = scene.mechanism, str(scene.mechanism.link(number).centre)
    own = [(name, centre) for name in (f"F_i{number}", f"G_{number}") if name in scene.quantities]
    return own + [(load.name, load.point) for load in mechanism.loads_on(number)]


def _attached(scene: Scene, number: int) -> Iterator[tuple[Pair, int, str]]:
    """Go through the pairs by which later groups, the last first, hang on a link: the group's own link, its pin."""
    for group in reversed(scene.solved.structure.groups):
        for pair, before in zip(group.outer, group.before, strict=True):
            if before == number:
                yield pair, next(n for n in pair.links if n in group.links), group.pin(pair)


def _handed(scene: Scene, number: int) -> Hung:
    """Return (force, point) of the reactions of groups attached to a link, the last group first."""
    places = {force: at for force, _, at, _ in _moments(scene, (number,))}
    attached = ((f"R_{scene.mechanism.index(own, number)}", pin) for _, own, pin in _attached(scene, number))
    return [(force, places.get(force) or pin) for force, pin in attached if scene.defined(force)]


def _couples(scene: Scene, number: int) -> list[str]:
    """Return the names of the couples on a link: of inertia, outer ones, and those that guides on it hand on."""
    mechanism = scene.mechanism
    names = [f"M_i{number}", *(couple.name for couple in mechanism.couples if couple.link == number)]
    for own in (own for pair, own, _ in _attached(scene, number) if isinstance(pair, Prismatic)):
        handed_on = (f"M_{mechanism.index(own, number)}", f"_M_{own}")
        names += [name for name in handed_on if scene.defined(name)][:1]
    return [name for name in names if scene.defined(name)]


def _reactions(scene: Scene, group: Group) -> Iterator[Reaction]:
    """Go through the reactions at the outer pairs of a group."""
    for pair, before in zip(group.outer, group.before, strict=True):
        own = next(number for number in pair.links if number in group.links)
        whole = f"R_{scene.mechanism.index(before, own)}"
        parts = [name for name in (f"{whole}_n", f"{whole}_t") if name in scene.values]
        yield group.pin(pair), pair, own, parts or [whole]


def _moments(scene: Scene, numbers: Sequence[int]) -> list[tuple[str, str, str, str]]:
    """Return the moments that are taken of forces on these links: force, its arm, where it acts, about which point."""
    taken = {step.name: step.operands for step in scene.program.which(("moment",))}
    moments: dict[str, tuple[str, str, str, str]] = {}
    for step in scene.program.which(("arm",)):
        force, at, about = taken.get(step.operands[0], ("", "", "lever.p"))
        own = [load.link for load in scene.mechanism.loads if load.name == force] or role(force).links[-1:]
        if role(about).plan != "lever" and {*own} & {*numbers}:
            moments.setdefault(step.name, (force, step.name, at, about))
    return list(moments.values())


def _sketch(scene: Scene, numbers: Sequence[int], framed: bool = False) -> Sketch:
    """Draw these links apart, with the pivots on which they turn where they are `framed`."""
    canvas = scene.canvas()
    figures = draw_links(canvas, scene, numbers, framed)
    return Sketch(canvas, scene, [stroke for figure in figures for stroke in figure.strokes], figures)


def group_view(scene: Scene, group: Group) -> View:
    """Draw a group without the links before it: its loads, reactions at its outer pairs, the arm of each moment."""
    sketch, moments = _sketch(scene, group.links), _moments(scene, group.links)
    for reaction in _reactions(scene, group):
        _react(sketch, *reaction)
    _load(sketch, group.links)
    special_points(sketch.canvas, scene, {about for *_, about in moments})
    sketch.arms(moments)
    heading = scene.heading("heading.group", POSITION, links=", ".join(map(str, group.links)))
    return sketch.finish(f"group_{group.name}", heading)


def link_view(scene: Scene, group: Group, number: int) -> View:
    """Draw a link of a group apart with all its forces, reactions of the rest of the group among them."""
    sketch = _sketch(scene, (number,))
    for pair in (pair for pair in group.inner if number in pair.links):
        other = next(n for n in pair.links if n != number)
        _react(sketch, group.pin(pair), pair, number, [f"R_{scene.mechanism.index(other, number)}"])
    _load(sketch, (number,))
    for reaction in _reactions(scene, group):
        if reaction[2] == number:
            _react(sketch, *reaction)
    return sketch.finish(f"link_{number}", scene.heading("heading.link", POSITION, link=str(number)))


def _react(sketch: Sketch, pin: str, pair: Pair, own: int, names: Iterable[str]) -> None:
    scene, at, couple = sketch.scene, sketch.scene.mm(pair.point), ""
    if isinstance(pair, Prismatic):
        (contact, couple), u = sketch.contact(pin, pair, own), guide_of(scene, pair)
        at += u * ((contact - at) / u).real
    for name in names:
        sketch.hang(name, at)
    if couple:
        sketch.couple(couple, next(figure for figure in sketch.figures if figure.number == own))


def _load(sketch: Sketch, numbers: Iterable[int]) -> None:
    scene = sketch.scene
    for number, figure in zip(numbers, sketch.figures, strict=True):
        for name, point in (*_loads(scene, number), *_handed(scene, number)):
            sketch.hang(name, scene.mm(point))
        for name in _couples(scene, number):
            sketch.couple(name, figure)
    sketch.letter_others(point for number in numbers for _, point in _handed(scene, number))


def driver_view(scene: Scene) -> View:
    """Draw the driver with all reactions on it, its own loads, R_01, what balances it, and the arms of the forces."""
    scene = replace(scene, scales={**scene.scales, POSITION: scene.scales[DRIVER]})
    number, driver, still = scene.solved.structure.driver, scene.mechanism.driver, scene.mechanism.frame_points
    sketch = _sketch(scene, (number,), framed=True)
    loads, frame = [*_handed(scene, number), *_loads(scene, number)], f"R_{scene.mechanism.index(FRAME, number)}"
    for name, point in loads:
        if point not in still:
            sketch.hang(name, scene.mm(point))
    sketch.letter_others(point for _, point in loads)
    sketch.arms(_moments(scene, (number,)))
    if isinstance(driver, Driver):
        o, foot = scene.mm(driver.pivot), foot_of(scene, driver.pivot, sketch.figures)
        sketch.bar(o, (foot * rect(1.0, lean) for lean in (-0.5, 0.0, 0.5)))
        sketch.hang(frame, o)
        for name, point in _loads(scene, number):
            if point in still:
                sketch.hang(name, scene.mm(point))
        if "M_bal" in scene.values:
            _balance(sketch, o)
        else:
            sketch.hang("_F_bal", scene.mm(driver.point))
    else:
        pair = scene.sliding(number)[0]
        sketch.hang("_F_bal", scene.mm(pair.point))
        _react(sketch, pair.point, pair, number, [frame])
    for name in _couples(scene, number):
        sketch.couple(name, sketch.figures[0])
    return sketch.finish("driver", scene.heading("heading.driver", POSITION))


def _balance(sketch: Sketch, o: complex) -> None:
    """Draw the balancing moment on the freest side of O: foot, crank, reaction and arms leave from there, too."""
    scene, canvas, value = sketch.scene, sketch.canvas, sketch.scene.values["M_bal"]
    if value != value or scene.vanishes("M_bal"):
        sketch.zero.append("M_bal")
        return
    radius = 0.62 * scene.style.force
    ends = [end for shape in canvas.shapes for end in _ends(shape) if 0.1 < abs(end - o) < 3 * radius]
    rays = [end - o for stroke in sketch.strokes for end in stroke if abs(end - o) > 0.1]
    busy = [-1j, 1 - 1.5j, -1 - 1.5j, *rays, *(unit(end - o) for end in ends)]
    middle = max(
        (k * math.pi / 12 for k in range(24)),
        key=lambda angle: (round(min(abs(phase(rect(1.0, angle) / ray)) for ray in busy), 6), -angle),
    )
    canvas.add(turning_arrow(o, radius, middle, 1.5, math.copysign(1.0, value), "M_bal"))
    canvas.label(scene.words.symbol("M_bal"), o + rect(radius, middle), prefer=rect(1.0, middle), clear=1.4)


def _ends(shape: Shape) -> tuple[complex, ...]:
    match shape:
        case Arrow(tail=tail, tip=tip) | Shapes(role="arm", shapes=(Line(a=tail, b=tip), *_)):
            return tail, tip
    return ()
