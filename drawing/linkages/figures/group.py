"""A group, one of its links, and the driver drawn apart, with the forces that act on them hung clear of one another.

What acts on a link is as the program has it; which forces, couples and arms are zero is said.
"""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise, product
from typing import NamedTuple

import numpy as np
import shapely

from ....plans.board import POSITION
from ....plans.laws import cross
from ....plans.linkages.mechanism import FRAME, Driver, Pair, Prismatic
from ....plans.linkages.solved import DRIVER
from ....plans.linkages.structure import Group as LinkGroup
from ....plans.names import role
from ...areas import Shapes, lines
from ...formats import Style
from ...shapes import Arrow, Group, Head, Line, Pen, Shape
from ...symbols import arm as drawn_arm
from ...symbols import turning_arrow, unit
from ...view import Canvas, View
from ..calculations.equations import is_fine
from ..scene import Scene
from .links import NEAR, Skeleton, Stroke, draw_links, foot_of, guide_of, letter_links, letter_point, rays_of
from .scheme import special_points

LEAST, SHORT = 0.05, 2.2  # mm: a shorter arm is none; lengths of an arrow: beside a shorter one no number has room
APART = 0.25  # rad by which the arc of the balancing moment is shorter than the room for it
PAST = 4.0  # mm by which the line of a force runs past what it meets
SHORTER = 0.75  # part of its length that an arrow beside another one has
BESIDE, LED = 0.8, (0.9, 1.3)  # heights of a letter between two arrows side by side, and from the point along one
REACH = 0.345  # lengths of an arrow: from a point farther within a block it begins at the point itself
# heights of a letter around the outer part of an arrow that are enough, and that are no better; what it costs that an
# arrow pushes, that it stands beside its line, and there towards the middle of the figure, or far
CLEAR, WIDE, PUSHED, ASIDE, INWARD = 0.56, 0.8, 0.08, 0.42, 0.1
ALONGSIDE = math.sin(math.radians(6.0))  # arms that make a smaller angle are parallel to the eye
CLOSE = math.cos(math.radians(12.0))  # arms that make a smaller angle run into one another, or into a line there
STEP, TRIES = 2.4, 6  # heights of an arm's letters between arms that are staggered; how often one is moved
AROUND, ENDS = 2, 0.5  # steps more by which an arm is moved rather than cross another one; mm of it at both ends
TURNING = 2.0  # rad, the arrow of a couple
OUT = 2.5  # mm from a block of an arm that is moved out of it
OF_FOOT = 2  # steps by which an arm is moved past the foot of a pivot
LEANS = [0.14 * k for k in range(-5, 6)]  # rad from the middle of a foot, in which its lines leave the pivot
MANY = 3  # arms of a figure; of more the drawing has letters alone, and their millimetres stand in the table
SHARES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.12, 0.88)  # places on a link where a couple may stand


class _Arm(NamedTuple):
    """An arm: the forces on one line, the names of their arms, where they hang, their direction, the line's foot."""

    forces: list[str]
    names: list[str]
    at: complex
    along: complex
    foot: complex

    def draw(self, canvas: Canvas, scene: Scene, about: complex, shift: complex = 0j, alone: bool = False) -> None:
        """Draw the line of the forces, thin, from their point past its foot, and the arm from `about`, both shifted.

        Its letter may stand `alone`.
        """
        start, foot, name = about + shift, self.foot + shift, self.names[0]
        reach = ((foot - self.at) / self.along).real
        beyond = math.copysign(PAST, reach)
        line = (self.at - self.along * (beyond if abs(reach) < PAST else 0.0), foot + self.along * beyond)
        canvas.add(Line(*line, Pen.THIN, role="line-of-action", name=" ".join(self.forces)))
        if abs(self.foot - about) >= LEAST:
            if shift:
                end = about + shift * (1 + 1.5 / abs(shift))
                canvas.add(Line(about, end, Pen.THIN, role="extension", name=name))
            canvas.add(drawn_arm(start, foot, name, self.along, scene.style))
            # smaller than a node's letter: a number with its symbol is long, and arms lie close together
            letters = " = ".join(map(scene.words.symbol, dict.fromkeys(self.names)))
            text, small = f"{letters} = {scene.segment(name, fine=is_fine(scene, name))}", scene.style.text
            if alone or abs(foot - start) < SHORT * scene.style.arrow:  # led to where there is room
                canvas.label(letters if alone else text, (start, foot), clear=0.9, height=small, strict=True, last=text)
            else:
                canvas.label(text, (start, foot), clear=0.9, height=small, strict=True, spare=text)


Moment = tuple[str, str, complex, complex]  # a force, the name of its arm, where it acts, about which point, mm


def arms_of(scene: Scene, moments: Iterable[Moment]) -> list[tuple[complex, _Arm]]:
    """Return the arms, each with the point from which it is drawn; forces on one line share theirs."""
    arms: list[tuple[complex, _Arm]] = []
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
            arms.append((about, _Arm([force], [name], at, e, foot)))
    return arms


def _staggered(
    pole: complex, arms: Sequence[_Arm], middle: complex, style: Style, rays: Sequence[complex] = (), past: int = 1
) -> Mapping[int, complex]:
    """Return by how much arms are moved along the lines of their forces; the shortest of those side by side stays.

    Arms are side by side when they make a small angle; each is moved away from the middle of the figure. None stays
    upon a line that leaves the pole in one of the directions `rays`, but is moved by `past` steps and more.
    """
    shifts, bundles = dict[int, complex](), dict[complex, int]()  # how many, by the direction of the shortest of them
    for reach, i in sorted((abs(own.foot - pole), i) for i, own in enumerate(arms) if abs(own.foot - pole) >= LEAST):
        way = (arms[i].foot - pole) * (1.0 / reach)
        first = next((other for other in bundles if (way.conjugate() * other).real > CLOSE), way)
        if first not in bundles and any((way.conjugate() * ray).real > CLOSE for ray in rays):
            bundles[first] = past
        if first in bundles:
            shifts[i] = outward(arms[i], pole, middle) * STEP * style.text * bundles[first]
        bundles[first] = bundles.get(first, 0) + 1
    return shifts


def outward(arm: _Arm, pole: complex, middle: complex) -> complex:
    """Return the direction along the line of a force in which its arm is moved: away from the middle of the figure."""
    return arm.along * (-1.0 if (arm.along.conjugate() * (middle - pole)).real > 0 else 1.0)


def _as_lines(strokes: Sequence[Stroke]) -> Shapes:
    return lines(*np.array(strokes, dtype=complex).reshape(-1, 2).T)


def _place(at: complex) -> complex:
    return complex(round(at.real, 2), round(at.imag, 2))


def _chords(centre: complex, middle: complex) -> list[Stroke]:
    """Return the arrow of a couple about a centre, whose middle stands there, as chords."""
    return list(pairwise(centre + middle * rect(1.0, 0.25 * TURNING * k) for k in range(-2, 3)))


@dataclass(slots=True)
class Sketch:
    """Main lines `strokes`, or links drawn apart, with forces: what lies at each place is known."""

    canvas: Canvas
    scene: Scene
    strokes: Sequence[Stroke]
    figures: Sequence[Skeleton] = ()
    zero: list[str] = field(default_factory=list)  # forces, couples and arms that the figure cannot show
    alone: bool = False  # letters of arms
    _hung: list[str] = field(default_factory=list)
    _lying: list[Stroke] = field(default_factory=list)
    _led: list[Stroke] = field(default_factory=list)  # ends of lines that lead to arrows beside theirs
    _barred: dict[complex, list[complex]] = field(default_factory=dict)
    _turning: list[Stroke] = field(default_factory=list)  # arrows of couples, as chords
    _arms: list[Stroke] = field(default_factory=list)

    def bar(self, at: complex, directions: Iterable[complex]) -> None:
        """Let no arrow leave a place in these directions."""
        self._barred.setdefault(_place(at), []).extend(directions)

    def shifts(self, pole: complex, arms: Sequence[_Arm], middle: complex, past: int = 1) -> Mapping[int, complex]:
        """Return by how much arms about a point are moved along the lines of their forces: as far as no force lies.

        Of those side by side each is moved farther than shorter ones, wherever these have room.
        """
        style, rays = self.scene.style, [*self._barred.get(_place(pole), ()), *rays_of(pole, self.strokes)]
        least, settled = _staggered(pole, arms, middle, style, rays, past), dict[int, float]()  # by how many steps
        shifts = dict[int, complex]()
        order = sorted((reach, i) for i, arm in enumerate(arms) if (reach := abs(arm.foot - pole)) >= LEAST)
        for reach, i in order:
            way, step = (arms[i].foot - pole) / reach, outward(arms[i], pole, middle) * STEP * style.text
            beside = [k for _, k in order if (way.conjugate() * unit(arms[k].foot - pole)).real > CLOSE]
            begin = max((settled[k] + 1.0 for k in beside if k in settled), default=0.0)
            begin = max(begin, abs(least.get(i, 0j) / step), self._out_of_block(pole, reach * way, step))
            taken = [*self._arms, *((pole + by, arms[k].foot + by) for k, by in shifts.items())]
            lies = [(pole + k * step, arms[i].foot + k * step) for k in (begin + n for n in range(TRIES))]
            free = [n for n, ends in enumerate(lies) if not self._upon(*ends, taken)]
            behind = sum(k not in settled for k in beside)  # itself, and those that are moved with it
            costs = [n * behind + AROUND * self._crossed(*ends, taken) for n, ends in enumerate(lies)]
            settled[i] = begin + min(free, key=costs.__getitem__, default=0)
            shifts[i] = settled[i] * step
        return {i: by for i, by in shifts.items() if by}

    def _out_of_block(self, pole: complex, reach: complex, step: complex) -> float:
        """Return by how many steps an arm is moved that would lie within a block, where nobody could letter it."""
        blocks = (block for figure in self.figures for block in figure.blocks if abs(block.at - pole) < NEAR)
        rims = (block.rim(unit(step)) for block in blocks if abs(reach) < block.rim(unit(reach)))
        return max((rim + OUT for rim in rims), default=0.0) / abs(step)

    def _upon(self, a: complex, b: complex, arms: Sequence[Stroke]) -> bool:
        """Whether a line runs along a force, a side of a block, or one of these arms, or close beside one of them."""
        letter, way = self.scene.style.label, unit(b - a)
        beside = [(c, d) for c, d in arms if abs(cross(way, unit(d - c))) < ALONGSIDE]
        for strokes, apart in (([*self._lying, *self._edges(), *arms], 0.25), (beside, BESIDE)):
            along = shapely.intersection(shapely.buffer(_as_lines(strokes), apart * letter), lines([a], [b])[0])
            if (shapely.length(along) > 0.9 * letter).any():
                return True
        return False

    def _crossed(self, a: complex, b: complex, arms: Sequence[Stroke]) -> int:
        """Return how many of these arms a line crosses, and of forces twice as many, those apart on which it ends."""
        way = ENDS * unit(b - a)
        crossed = shapely.crosses(lines([a + way], [b - way]), _as_lines([*self._lying, *self._lying, *arms]))
        return int(crossed.sum())

    def hang(self, name: str, at: complex, said: str = "") -> complex:
        """Draw the arrow of a force at a point, or beyond what stands there, and letter it; once.

        It lies on that side of the point where it is clear of all on its own line, which is returned as a direction, no
        force being 0. Where its letter has no room the notes have what is `said`.
        """
        if name in self._hung or not self.scene.defined(name):
            return 0j
        self._hung.append(name)
        e = self.scene.direction(name)
        if e == 0:
            self.zero.append(name)
            return 0j
        near, far = self._free(at, e)
        self._lying.append((near, far))
        ray = unit(far - near)
        if abs(((near - at) / ray).imag) > NEAR:  # beside its line: a short line leads to its point
            self.canvas.thin("extension", name, at, near)
            self._led.append((near, near))
        self.canvas.add(Arrow(*((near, far) if abs(ray - e) < 1.0 else (far, near)), Pen.MAIN, name=name))
        # its letter stands beside its outer half
        self.canvas.label(self.scene.letter(name), (far - 0.55 * (far - near), far), clear=0.9, last=said)
        return ray

    def _free(self, at: complex, e: complex) -> Stroke:
        """Return where an arrow along `e` lies at a point: its end there, and its outer one.

        It begins or ends at the point, whichever leaves it more room. Where links and other arrows take both, it stands
        beside its own line.
        """
        letter, length = self.scene.style.label, self.scene.style.force
        long = [(at, at + ray * length) for ray in self._barred.get(_place(at), ())]
        things = [*self.strokes, *self._edges(at), *self._lying, *long], self._lying, self._led
        around, forces, led = map(_as_lines, things)
        ends = [end for stroke in self.strokes for end in stroke]
        middle = sum(ends) / len(ends) if ends else at
        best: tuple[float, Stroke] = (-math.inf, (at, at))
        for beside, lead in ((0.0, 0.0), *((k * BESIDE, out) for k, out in product((1.0, -1.0, 2.0, -2.0), LED))):
            cost = ASIDE * (beside != 0.0) + INWARD * (abs(beside) > BESIDE)
            cost += INWARD * (beside * cross(e, middle - at) > 0.0)
            ways = [self._lies(at, ray, lead * letter, 1j * e * beside * letter) for ray in (e, -e)]
            rooms = self._rooms(ways, around, forces, led, beside != 0.0)
            for stroke, room, pushed in zip(ways, rooms, (0.0, PUSHED), strict=True):
                worth = room - pushed - cost
                if worth > best[0]:
                    best = worth, stroke
            if best[0] >= CLEAR - PUSHED:
                break
        return best[1]

    def _lies(self, at: complex, ray: complex, lead: float, aside: complex) -> Stroke:
        """Return where an arrow lies on a ray from a point, moved along it and aside: never far from the point.

        The line that leads to its point leans, and can be seen.
        """
        length = self.scene.style.force
        most = math.sqrt(max((REACH * length) ** 2 - abs(aside) ** 2, 0.0))
        near = at + ray * min(max(self._gap(at, ray), lead), most) + aside
        return near, near + ray * length * (SHORTER if aside else 1.0)

    def _rooms(self, ways: Sequence[Stroke], around: Shapes, forces: Shapes, led: Shapes, aside: bool) -> list[float]:
        """Return the heights of a letter free around the outer part of arrows; less if one lies on another.

        One that stands aside crosses no line; it begins on no other force, nor where a line has `led` to an arrow.
        """
        letter = self.scene.style.label
        near, far = np.array(ways).T
        start = near + 0.35 * (far - near)
        outer, begin, end, whole = lines([start, start, far, near], [far, start, far, far])
        rooms = shapely.distance(around[:, None], outer).min(axis=0, initial=WIDE * letter) / letter
        from_ends = np.maximum(shapely.distance(forces[:, None], begin), shapely.distance(forces[:, None], end))
        lies = from_ends.min(axis=0, initial=letter) < 0.3 * letter
        lies |= shapely.distance(led[:, None], whole).min(axis=0, initial=letter) < 0.3 * letter
        if aside:
            lies |= shapely.distance(forces[:, None], whole).min(axis=0, initial=letter) < 0.45 * letter
            lies |= shapely.crosses(around[:, None], whole).any(axis=0)
        return [room - float(on) for room, on in zip(rooms.tolist(), lies.tolist(), strict=True)]

    def _edges(self, at: complex | None = None) -> list[Stroke]:
        """Return the sides of the blocks, or of those that do not hold a point."""
        sides = list[Stroke]()
        for block in (block for figure in self.figures for block in figure.blocks):
            if at is not None and ((off := at - block.at) == 0 or abs(off) <= max(NEAR, block.rim(unit(off)))):
                continue
            x, y = block.u * block.size[0] / 2, 1j * block.u * block.size[1] / 2
            corners = [block.at + x + y, block.at - x + y, block.at - x - y, block.at + x - y]
            sides += zip(corners, [*corners[1:], corners[0]], strict=True)
        return sides

    def _gap(self, at: complex, e: complex) -> float:
        """Return where an arrow along `e` may begin beside the circle of a pair, or a block, at its point."""
        circles = (pin for figure in self.figures for pin in figure.pins)
        gaps = [max((self.scene.style.pair for pin in circles if abs(pin - at) < NEAR), default=0.0)]
        for block in (block for figure in self.figures for block in figure.blocks):
            away, (length, height) = abs(at - block.at), block.size
            if abs(((at - block.at) / block.u).imag) < NEAR and away < self.scene.style.slider[0] / 2:
                ahead = 2 * away if abs((e / block.u).real) > abs((e / block.u).imag) else 0.0
                gaps.append(block._replace(size=(length + ahead, height)).rim(e))
        return gap if (gap := max(gaps)) <= REACH * self.scene.style.force else 0.0

    def couple(self, name: str, figure: Skeleton) -> None:
        """Draw the turning arrow of a couple about the middle of a link, round those that stand there already."""
        value, scene = self.scene.values[name], self.scene
        if scene.vanishes(name):
            self.zero.append(name)
            return
        at, along, radius = self._free_place(figure)
        sense = math.copysign(1.0, value)
        self.canvas.add(turning_arrow(at, radius, phase(along), TURNING, sense, name))
        # that of a guide on link 3 is written M_43, also where it was a sum
        couple = role(name)
        written = scene.mechanism.pair("M", couple.links[0], figure.number) if couple.hidden else name
        beside = along * rect(1.0, -0.6 * sense)  # not where the arc crosses the link
        self.canvas.label(scene.words.symbol(written), at + beside * radius, prefer=beside, clear=1.2)

    def _free_place(self, figure: Skeleton) -> tuple[complex, complex, float]:
        """Return where the arrow of a couple stands: its centre on a link, the direction of its middle, its radius.

        It is clear of joints, forces, and couples so far.
        """
        a, b = max(figure.strokes, key=lambda stroke: round(abs(stroke[1] - stroke[0]), 3), default=(0j, 0j))
        centres, along = [a + (b - a) * share for share in SHARES], unit(b - a) if a != b else 1 + 0j
        if a == b:
            at, along = figure.blocks[0][:2] if figure.blocks else (figure.pins[0], along)
            centres = [at]
        nodes = [(node, node) for own in self.figures for node in own.nodes]
        taken = lines(*np.array([*nodes, *self._lying, *self._turning], dtype=complex).T)
        best, found = -math.inf, (centres[0], along, 0.0)
        for part, at, way in product((0.5, 0.75), centres, (along, -along)):
            chords = _chords(at, way * part * self.scene.style.force)
            room = float(shapely.distance(lines(*np.array(chords).T)[:, None], taken).min())
            off = a != b and not 0.0 <= ((at + way * part * self.scene.style.force - a) / (b - a)).real <= 1.0
            if (worth := round(min(room, WIDE * self.scene.style.label), 2) - part - off) > best:
                best, found = worth, (at, way, part * self.scene.style.force)
        self._turning += _chords(found[0], found[1] * found[2])
        return found

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
            text = f"{scene.words.symbol(name)} = {scene.segment(name, fine=is_fine(scene, name))}"
            self.canvas.label(text, (start, end), clear=0.9, height=scene.style.text, strict=True, spare=text)
            self.canvas.add(scene.point(end, name))
        elif scene.defined(name) and scene.direction(reaction) != 0:
            self.zero.append(name)
        return end, ""

    def arms(self, moments: Iterable[tuple[str, str, str, str]]) -> None:
        """Draw the arm of each force: its name, that of the arm, where it acts, the joint of its moment."""
        mm = self.scene.mm
        acting = [(f, arm, mm(at), mm(about)) for f, arm, at, about in moments if self.scene.direction(f) != 0]
        self.zero += [arm for _, arm, *_ in acting if self.scene.vanishes(arm)]
        arms = arms_of(self.scene, acting)
        self.alone = len(arms) > MANY
        nodes = [node for figure in self.figures for node in figure.nodes]
        for about in dict.fromkeys(about for about, _ in arms):
            own = [arm for centre, arm in arms if centre == about]
            shifts = self.shifts(about, own, sum(nodes) / len(nodes), OF_FOOT if _place(about) in self._barred else 1)
            for i, arm in enumerate(own):
                arm.draw(self.canvas, self.scene, about, shifts.get(i, 0j), self.alone)
                if abs(arm.foot - about) >= LEAST:
                    self._arms.append((about + shifts.get(i, 0j), arm.foot + shifts.get(i, 0j)))

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
        said = (self.scene.words[key] for key in (*self.said, *["said.arms"] * self.alone))
        return self.canvas.finish(name, heading, (*said, *zeros(self.scene, self.zero)), joined=True)

    @property
    def said(self) -> tuple[str, ...]:
        """Keys of what is said of the arrows: that they have no scale, and what those beside their lines mean."""
        return ("said.arrows", *["said.aside"] * bool(self._led))


def zeros(scene: Scene, names: Iterable[str]) -> tuple[str, ...]:
    """Return in one line which of these forces, moments and arms, each kind apart, are 0: no figure can show them."""
    words, couples = scene.words, {couple.name for couple in scene.mechanism.couples}
    kinds: dict[str, list[str]] = {"": [], "M": [], "h": []}
    for name in (role(name) for name in dict.fromkeys(names) if scene.defined(name) and scene.vanishes(name)):
        kind = "M" if name in couples else name.kind if name.kind in kinds else ""
        kinds[kind].append(words.symbol(name.shown, bar=not kind))
    said = {kind: f"{' = '.join(symbols)} = 0" for kind, symbols in kinds.items() if symbols}
    return ("; ".join(said.values()),) if said else ()


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
        sketch.letter_others([group.pin(pair)])
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
            sketch.hang(name, scene.mm(point), scene.hung(scene.letter(name), point))
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
    if isinstance(driver, Driver):
        o, foot = scene.mm(driver.pivot), foot_of(scene, driver.pivot, sketch.figures)
        sketch.bar(o, (foot * rect(1.0, lean) for lean in LEANS))
    sketch.arms(_moments(scene, (number,)))
    if isinstance(driver, Driver):
        sketch.hang(frame, o)
        for name, point in _loads(scene, number):
            if point in still:
                sketch.hang(name, scene.mm(point))
        if "M_bal" in scene.values:
            _balance(sketch, o, foot)
        else:
            sketch.hang("_F_bal", scene.mm(driver.point))
    else:
        pair = scene.sliding(number)[0]
        sketch.hang("_F_bal", scene.mm(pair.point))
        _react(sketch, pair.point, pair, number, [frame])
    for name in _couples(scene, number):
        sketch.couple(name, sketch.figures[0])
    return sketch.finish("driver", scene.heading("heading.driver", POSITION))


def _balance(sketch: Sketch, o: complex, foot: complex) -> None:
    """Draw the balancing moment on the freest side of O: foot, crank, reaction and arms leave from there, too."""
    scene, canvas, value = sketch.scene, sketch.canvas, sketch.scene.values["M_bal"]
    if value != value or scene.vanishes("M_bal"):
        sketch.zero.append("M_bal")
        return
    radius = 0.62 * scene.style.force
    ends = [end for shape in canvas.shapes for end in _ends(shape) if 0.1 < abs(end - o) < 3 * radius]
    rays = [end - o for stroke in sketch.strokes for end in stroke if abs(end - o) > 0.1]
    busy = [*(foot * ray for ray in (1, 1.5 + 1j, 1.5 - 1j)), *rays, *(unit(end - o) for end in ends)]
    free = {k * math.pi / 12: min(abs(phase(rect(1.0, k * math.pi / 12) / ray)) for ray in busy) for k in range(24)}
    middle = max(free, key=lambda angle: (round(free[angle], 6), -angle))
    spread = min(max(2 * free[middle] - APART, 0.9), 1.5)
    canvas.add(turning_arrow(o, radius, middle, spread, math.copysign(1.0, value), "M_bal"))
    canvas.label(scene.words.symbol("M_bal"), o + rect(radius, middle), prefer=rect(1.0, middle), clear=1.4)


def _ends(shape: Shape) -> tuple[complex, ...]:
    match shape:
        case Arrow(tail=tail, tip=tip) | Group(role="arm", shapes=(Line(a=tail, b=tip), *_)):
            return tail, tip
    return ()
