"""A group, one of its links, and the driver drawn apart, with the forces that act on them hung clear of one another.

What acts on a link is as the program has it; which forces, couples and arms are zero is said.
"""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from ....plans.board import POSITION
from ....plans.laws import cross
from ....plans.linkages.mechanism import FRAME, Driver, Pair, Prismatic
from ....plans.linkages.structure import Group as LinkGroup
from ....plans.names import role
from ...shapes import Arrow, Group, Head, Line, Pen, Shape
from ...symbols import arm, clear_ray, room_on, turning_arrow, unit
from ...view import Canvas, View
from ..ladders import DRIVER
from ..scene import Scene
from .links import NEAR, Skeleton, Stroke, draw_links, foot_of, guide_of, letter_links, letter_point, rays_of
from .scheme import special_points

LEAST = 0.05  # mm: a shorter arm is none
PAST = 4.0  # mm by which the line of a force runs past what it meets
SHORTER = 0.6  # part of its length that an arrow beyond another one has
SPARE, ALONG = 1.2, 2.5  # mm between two arrows on a line, and beside one another where they count as on one
FARTHEST = 2.5  # lengths of an arrow that it may stand from its point
SHARES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.12, 0.88)  # places on a link where a couple may stand


class Arm(NamedTuple):
    """An arm: the forces on one line, the names of their arms, where they hang, their direction, the line's foot."""

    forces: list[str]
    names: list[str]
    at: complex
    along: complex
    foot: complex

    def draw(self, canvas: Canvas, scene: Scene, about: complex, shift: complex = 0j) -> None:
        """Draw the line of the forces, thin, from their arrow past its foot, and the arm from `about`, both shifted."""
        start, foot, reach, name = about + shift, self.foot + shift, 0.6 * scene.style.force, self.names[0]
        ends = sorted((-reach, reach, ((foot - self.at) / self.along).real))
        line = (self.at + self.along * (ends[0] - PAST), self.at + self.along * (ends[-1] + PAST))
        canvas.add(Line(*line, Pen.THIN, role="line-of-action", name=" ".join(self.forces)))
        if abs(self.foot - about) >= LEAST:
            if shift:
                beyond = about + shift * (1 + 1.5 / abs(shift))
                canvas.add(Line(about, beyond, Pen.THIN, role="extension", name=name))
            canvas.add(arm(start, foot, name, self.along, scene.style))
            # smaller than a node's letter: a number with its symbol is long, and arms lie close together
            text = " = ".join([*map(scene.words.symbol, dict.fromkeys(self.names)), scene.segment(name)])
            canvas.label(text, (start, foot), clear=0.9, height=scene.style.text, strict=True, spare=text)


Moment = tuple[str, str, complex, complex]  # a force, the name of its arm, where it acts, about which point, mm


def arms_of(scene: Scene, moments: Iterable[Moment]) -> list[tuple[complex, Arm]]:
    """Return the arms, each with the point from which it is drawn; forces on one line share theirs."""
    arms: list[tuple[complex, Arm]] = []
    for force, name, at, about in moments:
        e = scene.direction(force)
        if e == 0 or not scene.defined(name):
            continue
        foot = at + e * ((about - at) / e).real
        same = [own for pole, own in arms if pole == about and abs(own.foot - foot) < 1e-4]
        if same:
            same[0].forces.append(force)
            same[0].names.append(name)
        else:
            arms.append((about, Arm([force], [name], at, e, foot)))
    return arms


def _place(at: complex) -> complex:
    return complex(round(at.real, 2), round(at.imag, 2))


@dataclass(slots=True)
class Sketch:
    """Main lines `strokes`, or links drawn apart, with forces: what lies at each place is known."""

    canvas: Canvas
    scene: Scene
    strokes: Sequence[Stroke]
    figures: Sequence[Skeleton] = ()
    zero: list[str] = field(default_factory=list)  # forces, couples and arms that the figure cannot show
    _hung: list[str] = field(default_factory=list)
    _ends: dict[complex, list[complex]] = field(default_factory=dict)  # of arrows at each place, from there
    _lying: list[Stroke] = field(default_factory=list)
    _barred: dict[complex, list[complex]] = field(default_factory=dict)
    _turning: list[complex] = field(default_factory=list)  # places of couples

    def bar(self, at: complex, directions: Iterable[complex]) -> None:
        """Let no arrow leave a place in these directions."""
        self._barred.setdefault(_place(at), []).extend(directions)

    def hang(self, name: str, at: complex) -> None:
        """Draw the arrow of a force at a point, or beyond what stands there, and letter it; once.

        It lies on that side of the point where it is clear of all on its own line.
        """
        if name in self._hung or not self.scene.defined(name):
            return
        self._hung.append(name)
        e = self.scene.direction(name)
        if e == 0:
            self.zero.append(name)
            return
        gap, length = self._gap(at, e), self.scene.style.force
        arrows = self._ends.setdefault(_place(at), [])
        lines = [*rays_of(at, self.strokes), *self._barred.get(_place(at), ())]
        ray = clear_ray(e, lines, arrows)
        start, other = self._start(at, ray, gap), self._start(at, -ray, gap)
        if start - other > 0.6 * length and room_on(-ray, lines, arrows) > 0.35:
            ray, start = -ray, other
        if start >= gap + FARTHEST * length:  # far from its point it would not be found: then it lies on the link
            start = gap
        near, far = at + ray * start, at + ray * (start + length * (SHORTER if start > gap else 1.0))
        arrows.append(far - at)
        self._lying.append((near, far))
        self.canvas.add(Arrow(*((near, far) if abs(ray - e) < 1.0 else (far, near)), Pen.MAIN, name=name))
        # its letter stands beside its outer half
        self.canvas.label(self.scene.letter(name), (far - ray * 0.55 * length, far), clear=0.9)

    def _gap(self, at: complex, e: complex) -> float:
        """Return where an arrow along `e` may begin beside a block at its point."""
        gaps = [0.0]
        for block in (block for figure in self.figures for block in figure.blocks):
            away, (length, height) = abs(at - block.at), block.size
            if abs(((at - block.at) / block.u).imag) < NEAR and away < self.scene.style.slider[0] / 2:
                ahead = 2 * away if abs((e / block.u).real) > abs((e / block.u).imag) else 0.0
                gaps.append(block._replace(size=(length + ahead, height)).rim(e))
        return max(gaps)

    def _start(self, at: complex, ray: complex, start: float) -> float:
        """Return where on a ray there is room for an arrow: beyond links and arrows that lie along it."""
        first, taken, length = start, [], self.scene.style.force
        lying = [(stroke, self.scene.style.pair + 1.0, 0.5) for stroke in self.strokes]
        for stroke, spare, aside in [*lying, *((stroke, SPARE, ALONG) for stroke in self._lying)]:
            ends = [(end - at) / ray for end in stroke]
            if all(abs(end.imag) < aside for end in ends):
                taken.append((*sorted(end.real for end in ends), spare))
        for low, high, spare in sorted(taken):
            if low < start + length * (SHORTER if start > first else 1.0) - 0.5 and high > start + 0.5:
                start = high + spare
        return start

    def couple(self, name: str, figure: Skeleton) -> None:
        """Draw the turning arrow of a couple about the middle of a link, round those that stand there already."""
        value, scene = self.scene.values[name], self.scene
        if scene.vanishes(name):
            self.zero.append(name)
            return
        at, along = self._free_place(figure)
        radius = scene.style.force * (0.5 + 0.25 * self._turning.count(at))
        self._turning.append(at)
        self.canvas.add(turning_arrow(at, radius, phase(along), 2.0, math.copysign(1.0, value), name))
        # that of a guide on link 3 is written M_43, also where it was a sum
        couple = role(name)
        written = scene.mechanism.pair("M", couple.links[0], figure.number) if couple.hidden else name
        self.canvas.label(scene.words.symbol(written), at + along * radius, clear=1.2)

    def _free_place(self, figure: Skeleton) -> tuple[complex, complex]:
        """Return the place on a link farthest from its joints, forces and couples so far, and the link's direction."""
        if not figure.strokes:
            return figure.blocks[0][:2] if figure.blocks else (figure.pins[0], 1 + 0j)
        a, b = max(figure.strokes, key=lambda stroke: round(abs(stroke[1] - stroke[0]), 3))
        busy = [*((other, 2.0) for other in (*figure.nodes, *self._ends)), *((other, 1.0) for other in self._turning)]

        def room(at: complex) -> float:
            return round(min(times * abs(other - at) / self.scene.style.force for other, times in busy), 3)

        places = (a + (b - a) * share for share in SHARES)
        return max(places, key=lambda at: min(room(at), 1.5)), unit(b - a)

    def contact(self, pin: str, pair: Prismatic, number: int) -> tuple[complex, str]:
        """Draw how far from a pin along the guide the reaction on a link acts, with its millimetres.

        Returned are the place where it acts, and the moment of a reaction that has no size: a couple, without an arm.
        """
        scene, start, u = self.scene, self.scene.mm(pin), guide_of(self.scene, pair)
        other = next(n for n in pair.links if n != number)
        indices = {scene.mechanism.index(*links) for links in ((other, number), (number, other))}
        arms = (s for s in scene.program.which(("arm",)) if s.operands[1] in {f"R_{index}" for index in indices})
        step = next((s for s in arms if s.name in {f"h_{index}" for index in indices}), None)
        if step is None:
            return start, ""
        (moment, reaction), name, values = step.operands, step.name, scene.values
        size = cross(u, complex(values[reaction])) if scene.direction(reaction) != 0 else 0.0
        if size == 0.0 and not scene.vanishes(moment):
            return start, moment
        # the moment of the loads, which the reaction balances, or that of the reaction itself
        turning = -float(values[moment]) if role(moment).hidden else float(values[moment])
        end = start + u * ((turning / size if size else 0.0) / scene.scales[POSITION].mu)
        if abs(end - start) > LEAST:
            e, parts = unit(end - start), list[Shape]([Line(start, end, Pen.THIN)])
            parts += [Head(end, e), Head(start, -e)] if abs(end - start) > 2.2 * scene.style.arrow else []
            self.canvas.add(Group(tuple(parts), "arm", name))
            text = f"{scene.words.symbol(name)} = {scene.segment(name)}"
            self.canvas.label(text, (start, end), clear=0.9, height=scene.style.text, strict=True, spare=text)
        elif scene.defined(name) and scene.direction(reaction) != 0:
            self.zero.append(name)
        return end, ""

    def arms(self, moments: Iterable[tuple[str, str, str, str]]) -> None:
        """Draw the arm of each force: its name, that of the arm, where it acts, the joint of its moment."""
        mm = self.scene.mm
        acting = [(f, arm, mm(at), mm(about)) for f, arm, at, about in moments if self.scene.direction(f) != 0]
        self.zero += [arm for _, arm, *_ in acting if self.scene.vanishes(arm)]
        for about, own in arms_of(self.scene, acting):
            own.draw(self.canvas, self.scene, about)

    def letter_others(self, points: Iterable[str]) -> None:
        """Letter the points of other links at which their forces act on these: pins that slide along their guides."""
        mechanism = self.scene.mechanism
        own = {p for figure in self.figures for p in mechanism.link(figure.number).points} | {*mechanism.frame_points}
        for point in dict.fromkeys(points):
            if point not in own:
                letter_point(self.canvas, self.scene, point)

    def finish(self, name: str, heading: tuple[str, ...]) -> View:
        """Letter the links, and close the view; it says that arrows have no scale, and what is zero."""
        letter_links(self.canvas, self.scene, self.figures)
        return self.canvas.finish(name, heading, (self.scene.words["said.arrows"], *zeros(self.scene, self.zero)))


def zeros(scene: Scene, names: Iterable[str]) -> tuple[str, ...]:
    """Say in one line which of these forces, couples and arms are zero: the figure cannot show them."""
    words, couples = scene.words, {couple.name for couple in scene.mechanism.couples}
    gone = [role(name) for name in dict.fromkeys(names) if scene.defined(name) and scene.vanishes(name)]
    symbols = [words.symbol(name.shown, bar=name.kind not in ("M", "h") and name not in couples) for name in gone]
    return (f"{' = '.join(symbols)} = 0",) if symbols else ()


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


def _reactions(scene: Scene, group: LinkGroup) -> Iterator[Reaction]:
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


def group_view(scene: Scene, group: LinkGroup) -> View:
    """Draw a group without the links before it: its loads, reactions at its outer pairs, the arm of each moment."""
    sketch, moments = _sketch(scene, group.links), _moments(scene, group.links)
    for reaction in _reactions(scene, group):
        _react(sketch, *reaction)
    _load(sketch, group.links)
    special_points(sketch.canvas, scene, {about for *_, about in moments})
    sketch.arms(moments)
    heading = scene.heading("heading.group", POSITION, links=", ".join(map(str, group.links)))
    return sketch.finish(f"group_{group.name}", heading)


def link_view(scene: Scene, group: LinkGroup, number: int) -> View:
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
        case Arrow(tail=tail, tip=tip) | Group(role="arm", shapes=(Line(a=tail, b=tip), *_)):
            return tail, tip
    return ()
