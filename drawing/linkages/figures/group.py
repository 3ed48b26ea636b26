"""A group drawn apart with all its forces, and one of its links drawn apart with its own."""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

from ....plans.board import POSITION
from ....plans.laws import cross
from ....plans.linkages.mechanism import FRAME, Driver, Pair, Prismatic
from ....plans.linkages.structure import Group
from ....plans.names import role
from ...shapes import Arrow, Head, Line, Pen, Shape
from ...shapes import Group as Shapes
from ...symbols import turning_arrow
from ...view import View
from ..ladders import DRIVER
from ..scene import Scene
from .acting import LEAST, Arm, Arrows, Moment, couples, handed, loads, moments_of, reactions, zeros
from .links import NEAR, Skeleton, draw_links, foot_of, guide_of, letter_links
from .scheme import special_points

SHARES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.12, 0.88)  # places on a link where a couple may stand


@dataclass(slots=True)
class Sketch(Arrows):
    """A part of the mechanism drawn apart, on which forces are hung: what lies at each place is known."""

    figures: Sequence[Skeleton] = ()
    turning: list[complex] = field(default_factory=list)  # places of couples

    def _gap(self, at: complex, e: complex) -> float:
        """Return where an arrow along `e` may begin beside a block at its point."""
        gaps = [0.0]
        for figure in self.figures:
            for centre, u, (length, height) in figure.blocks:
                if abs(((at - centre) / u).imag) < NEAR and abs(at - centre) < self.scene.style.slider[0] / 2:
                    along, across = abs((e / u).real), abs((e / u).imag)
                    ahead = length / 2 + abs(at - centre) if along > across else length / 2
                    gaps.append(min(ahead / max(along, 1e-9), height / 2 / max(across, 1e-9)))
        return max(gaps)

    def couple(self, name: str, figure: Skeleton) -> None:
        """Draw the turning arrow of a couple about the middle of a link, `number` others being there already."""
        value = self.scene.solved.values[name]
        if self.scene.vanishes(name):
            self.zero.append(name)
            return
        at, along = self._free_place(figure)
        radius = self.scene.style.force * (0.5 + 0.25 * self.turning.count(at))  # round those that stand there already
        self.turning.append(at)
        self.canvas.add(turning_arrow(at, radius, phase(along), 2.0, math.copysign(1.0, value), name))
        # that of a guide on link 3 is written M_43, also where it was a sum
        couple, pair = role(name), self.scene.mechanism.pair
        written = pair("M", couple.links[0], figure.number) if couple.hidden else name
        self.canvas.label(self.scene.words.symbol(written), at + along * radius, clear=1.2)

    def _free_place(self, figure: Skeleton) -> tuple[complex, complex]:
        """Return the place on a link farthest from its joints, forces and couples so far, and the link's direction."""
        if not figure.strokes:
            return figure.blocks[0][:2] if figure.blocks else (figure.pins[0], 1 + 0j)
        a, b = max(figure.strokes, key=lambda stroke: round(abs(stroke[1] - stroke[0]), 3))
        busy = [*((other, 2.0) for other in (*figure.nodes, *self.at)), *((other, 1.0) for other in self.turning)]

        def room(at: complex) -> float:
            return round(min(times * abs(other - at) / self.scene.style.force for other, times in busy), 3)

        places = (a + (b - a) * share for share in SHARES)
        return max(places, key=lambda at: min(room(at), 1.5)), (b - a) / abs(b - a)

    def contact(self, pin: str, pair: Prismatic, number: int) -> tuple[complex, str]:
        """Draw how far from a pin along the guide the reaction on a link acts, with its millimetres.

        Returns
        -------
        complex
            The place where it acts.
        str
            The moment of a reaction that has no size: a couple, without an arm. Otherwise "".
        """
        scene, start, u = self.scene, self.scene.mm(pin), guide_of(self.scene, pair)
        other = next(n for n in pair.links if n != number)
        named = {scene.mechanism.index(*links) for links in ((other, number), (number, other))}
        arms = (s for s in scene.program.which(("arm",)) if s.operands[1] in {f"R_{index}" for index in named})
        step = next((s for s in arms if s.name in {f"h_{index}" for index in named}), None)
        if step is None:
            return start, ""
        (moment, reaction), name, values = step.operands, step.name, scene.solved.values
        size = cross(u, complex(values[reaction])) if scene.direction(reaction) != 0 else 0.0
        if size == 0.0 and not scene.vanishes(moment):
            return start, moment
        # the moment of the loads, which the reaction balances, or that of the reaction itself
        turning = -float(values[moment]) if role(moment).hidden else float(values[moment])
        at = start + u * ((turning / size if size else 0.0) / scene.scales[POSITION].mu)
        if abs(at - start) > LEAST:
            self._arm_along(name, start, at)
        elif scene.defined(name) and scene.direction(reaction) != 0:
            self.zero.append(name)
        return at, ""

    def _arm_along(self, name: str, start: complex, end: complex) -> None:
        scene, e, parts = self.scene, (end - start) / abs(end - start), list[Shape]([Line(start, end, Pen.THIN)])
        if abs(end - start) > 2.2 * scene.style.arrow:
            parts += [Head(end, e), Head(start, -e)]
        self.canvas.add(Shapes(tuple(parts), "arm", name))
        text = f"{scene.words.symbol(name)} = {scene.segment(name)}"
        self.canvas.label(text, (start, end), clear=0.9, height=scene.style.text, strict=True, spare=text)

    def arms(self, moments: Iterable[Moment]) -> None:
        """Draw the arm of each force from the joint about which its moment is taken."""
        scene, arms = self.scene, dict[tuple[str, complex], tuple[Moment, complex, list[Moment]]]()
        for moment in moments:
            e, at, about = scene.direction(moment.force), scene.mm(moment.at), scene.mm(moment.about)
            if e == 0:
                continue
            foot = at + e * ((about - at) / e).real
            if scene.vanishes(moment.arm):
                self.zero.append(moment.arm)
            key = moment.about, complex(round(foot.real, 3), round(foot.imag, 3))
            arms.setdefault(key, (moment, foot, []))[2].append(moment)
        for first, foot, sharing in arms.values():
            if scene.defined(first.arm):
                names = tuple(dict.fromkeys(moment.arm for moment in sharing))
                forces, e = tuple(moment.force for moment in sharing), scene.direction(first.force)
                arm = Arm(forces, names, scene.mm(first.at), e, foot)
                arm.draw(self.canvas, scene, scene.mm(first.about))

    def letter_others(self, points: Iterable[str]) -> None:
        """Letter the points of other links at which their forces act on these: pins that slide along their guides."""
        mechanism = self.scene.mechanism
        own = {p for figure in self.figures for p in mechanism.link(figure.number).points} | {*mechanism.frame_points}
        for point in dict.fromkeys(points):
            if point not in own:
                at = self.scene.mm(point)
                self.canvas.add(self.scene.point(at, point))
                self.canvas.label(self.scene.words.mark(point), at, clear=self.scene.style.node + 0.8)

    def finish(self, name: str, heading: tuple[str, ...]) -> View:
        """Letter the links, and close the view; it says that arrows have no scale, and what is zero."""
        letter_links(self.canvas, self.scene, self.figures)
        notes = self.scene.words["said.arrows"], *zeros(self.scene, self.zero)
        return self.canvas.finish(name, heading, notes)


def _sketch(scene: Scene, numbers: Sequence[int], framed: bool = False) -> Sketch:
    """Draw these links apart, with the pivots on which they turn where they are `framed`."""
    canvas = scene.canvas()
    figures = draw_links(canvas, scene, numbers, framed)
    return Sketch(canvas, scene, [stroke for figure in figures for stroke in figure.strokes], figures=figures)


def group_view(scene: Scene, group: Group) -> View:
    """Draw a group without the links before it: its loads, reactions at its outer pairs, the arm of each moment."""
    sketch = _sketch(scene, group.links)
    for pair, own, names in reactions(scene, group):
        _react(sketch, group.pin(pair), pair, own, names)
    _load(sketch, group.links)
    moments = moments_of(scene, group.links)
    special_points(sketch.canvas, scene, {moment.about for moment in moments})
    sketch.arms(moments)
    heading = scene.heading("heading.group", POSITION, links=", ".join(map(str, group.links)))
    return sketch.finish(f"group_{group.name}", heading)


def _react(sketch: Sketch, pin: str, pair: Pair, own: int, names: list[str]) -> None:
    scene, on_guide = sketch.scene, sketch.scene.mm(pair.point)
    if not isinstance(pair, Prismatic):
        for name in names:
            sketch.hang(name, on_guide)
        return
    (at, couple), u = sketch.contact(pin, pair, own), guide_of(scene, pair)
    for name in names:
        sketch.hang(name, on_guide + u * ((at - on_guide) / u).real)
    if couple:
        sketch.couple(couple, next(figure for figure in sketch.figures if figure.number == own))


def _load(sketch: Sketch, numbers: Iterable[int]) -> None:
    for number, figure in zip(numbers, sketch.figures, strict=True):
        for name, point in (*loads(sketch.scene, number), *handed(sketch.scene, number)):
            sketch.hang(name, sketch.scene.mm(point))
        for name in couples(sketch.scene, number):
            sketch.couple(name, figure)
    sketch.letter_others(point for number in numbers for _, point in handed(sketch.scene, number))


def link_view(scene: Scene, group: Group, number: int) -> View:
    """Draw a link of a group apart with all its forces, reactions of the rest of the group among them."""
    sketch = _sketch(scene, (number,))
    for pair in (p for p in group.inner if number in p.links):
        other = next(n for n in pair.links if n != number)
        _react(sketch, group.pin(pair), pair, number, [f"R_{scene.mechanism.index(other, number)}"])
    _load(sketch, (number,))
    for pair, own, names in reactions(scene, group):
        if own == number:
            _react(sketch, group.pin(pair), pair, own, names)
    return sketch.finish(f"link_{number}", scene.heading("heading.link", POSITION, link=str(number)))


def driver_view(scene: Scene) -> View:
    """Draw the driver with all reactions on it, its own loads, R_01, what balances it, and the arms of the forces."""
    scene = replace(scene, scales={**scene.scales, POSITION: scene.scales[DRIVER]})
    number = scene.solved.structure.driver
    sketch = _sketch(scene, (number,), framed=True)
    hung = [*handed(scene, number), *loads(scene, number)]
    for name, point in hung:
        if point not in scene.mechanism.frame_points:
            sketch.hang(name, scene.mm(point))
    sketch.letter_others(point for _, point in hung)
    sketch.arms(moments_of(scene, (number,)))
    driver = scene.mechanism.driver
    if isinstance(driver, Driver):
        _crank(sketch, driver)
    else:
        pair = next(p for p in scene.mechanism.pairs if isinstance(p, Prismatic) and number in p.links)
        sketch.hang("_F_bal", scene.mm(pair.point))
        _react(sketch, pair.point, pair, number, [f"R_{scene.mechanism.index(FRAME, number)}"])
    for name in couples(scene, number):
        sketch.couple(name, sketch.figures[0])
    return sketch.finish("driver", scene.heading("heading.driver", POSITION))


def _crank(sketch: Sketch, driver: Driver) -> None:
    scene, o = sketch.scene, sketch.scene.mm(driver.pivot)
    foot = foot_of(scene, driver.pivot, sketch.figures)
    sketch.bar(o, (foot * rect(1.0, lean) for lean in (-0.5, 0.0, 0.5)))
    sketch.hang(f"R_{scene.mechanism.index(FRAME, driver.link)}", o)
    for name, point in loads(scene, driver.link):
        if point in scene.mechanism.frame_points:
            sketch.hang(name, scene.mm(point))
    if "M_bal" in scene.solved.values:
        _balance(sketch, o)
    else:
        sketch.hang("_F_bal", scene.mm(driver.point))


def _balance(sketch: Sketch, o: complex) -> None:
    scene, canvas = sketch.scene, sketch.canvas
    value = scene.solved.values["M_bal"]
    if value != value or scene.vanishes("M_bal"):
        sketch.zero.append("M_bal")
        return
    sense, radius = math.copysign(1.0, value), 0.62 * scene.style.force
    # on the freest side of O: the pivot's foot, the crank, the reaction and the arms of forces leave from there too
    ends = [end for shape in canvas.shapes for end in _ends(shape) if 0.1 < abs(end - o) < 3 * radius]
    rays = [end - o for stroke in sketch.strokes for end in stroke if abs(end - o) > 0.1]
    busy = [-1j, 1 - 1.5j, -1 - 1.5j, *rays, *((end - o) / abs(end - o) for end in ends)]
    middle = max(
        (k * math.pi / 12 for k in range(24)),
        key=lambda angle: (round(min(abs(phase(rect(1.0, angle) / ray)) for ray in busy), 6), -angle),
    )
    canvas.add(turning_arrow(o, radius, middle, 1.5, sense, "M_bal"))
    canvas.label(scene.words.symbol("M_bal"), o + rect(radius, middle), prefer=rect(1.0, middle), clear=1.4)


def _ends(shape: Shape) -> tuple[complex, ...]:
    match shape:
        case Arrow(tail=tail, tip=tip):
            return tail, tip
        case Shapes(role="arm", shapes=(Line(a=a, b=b), *_)):
            return a, b
        case _:
            return ()
