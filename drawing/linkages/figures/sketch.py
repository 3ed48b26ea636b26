"""Forces hung on what is drawn: arrows that are clear of one another, couples, arms; which of them are zero is said."""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from ....plans.board import POSITION
from ....plans.laws import cross
from ....plans.linkages.mechanism import Prismatic
from ....plans.names import role
from ...shapes import Arrow, Group, Head, Line, Pen, Shape
from ...symbols import arm, clear_ray, room_on, turning_arrow, unit
from ...view import Canvas, View
from ..scene import Scene
from .links import NEAR, Skeleton, Stroke, guide_of, letter_links, letter_point, rays_of

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


class Moment(NamedTuple):
    """The moment of a force about a point: the name of its arm, where the force acts, mm."""

    force: str
    arm: str
    at: complex
    about: complex


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
        ray, _ = clear_ray(e, lines, arrows)
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

        Returns
        -------
        complex
            The place where it acts.
        str
            The moment of a reaction that has no size: a couple, without an arm. Otherwise "".
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
        listed = [Moment(force, arm, mm(at), mm(about)) for force, arm, at, about in moments]
        acting = [moment for moment in listed if self.scene.direction(moment.force) != 0]
        self.zero += [moment.arm for moment in acting if self.scene.vanishes(moment.arm)]
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
