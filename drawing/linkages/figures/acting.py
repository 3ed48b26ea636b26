"""What acts on each link, and where, as the program has it: loads, reactions, couples, arms; all of it on the lever."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations, pairwise
from math import cos, radians
from typing import NamedTuple

from ....plans.board import Step
from ....plans.linkages.mechanism import Pair, Prismatic
from ....plans.linkages.structure import Group
from ....plans.names import COUPLE, lever_arm, role, spelled
from ...shapes import Arrow, Line, Pen
from ...symbols import arm, clear_ray, room_on
from ...view import Canvas, View
from ..reading import Edge
from ..scene import Scene
from .inset import letter_marks
from .links import Stroke, rays_of

Hung = list[tuple[str, str]]  # force, mark of the point where it acts
LEAST = 0.05  # mm: a shorter arm is none
PAST = 4.0  # mm by which the line of a force runs past what it meets
SHORTER = 0.6  # part of its length that an arrow beyond another one has
SPARE, ALONG = 1.2, 2.5  # mm between two arrows on a line, and beside one another where they count as on one
FARTHEST = 2.5  # lengths of an arrow that it may stand from its point
BALANCE = ("_F_bal_lever", "_F_bal")  # the balancing force of the lever, where a force balances and where a moment
BESIDE = cos(radians(12.0))  # arms that make a smaller angle run into one another
STEP = 2.4  # heights of an arm's letters between arms that are staggered


class Moment(NamedTuple):
    """The moment of a force about a joint, and the name of its arm."""

    force: str
    arm: str
    at: str
    about: str


def loads(scene: Scene, number: int) -> Hung:
    """Return (force, point) of the loads on a link: inertia force, weight, then outer ones."""
    mechanism, link = scene.mechanism, scene.mechanism.link(number)
    own = [(name, str(link.centre)) for name in (f"F_i{number}", f"G_{number}") if name in scene.solved.quantities]
    return own + [(load.name, load.point) for load in mechanism.loads_on(number)]


def handed(scene: Scene, number: int) -> Hung:
    """Return (force, point) of the reactions of groups attached to a link, the last group first."""
    at = {moment.force: moment.at for moment in moments_of(scene, (number,))}
    attached = ((f"R_{scene.mechanism.index(own, number)}", g.pin(pair)) for g, pair, own in _attached(scene, number))
    return [(force, at.get(force) or pin) for force, pin in attached if scene.defined(force)]


def _attached(scene: Scene, number: int) -> Iterator[tuple[Group, Pair, int]]:
    """Go through the pairs by which later groups hang on a link: group, pair, the group's own link in it."""
    for group in reversed(scene.solved.structure.groups):
        for pair, before in zip(group.outer, group.before, strict=True):
            if before == number:
                yield group, pair, next(n for n in pair.links if n in group.links)


def couples(scene: Scene, number: int) -> list[str]:
    """Return the names of the couples on a link: of inertia, outer ones, and those that guides on it hand on."""
    mechanism = scene.mechanism
    names = [f"M_i{number}", *(couple.name for couple in mechanism.couples if couple.link == number)]
    for own in (own for _, pair, own in _attached(scene, number) if isinstance(pair, Prismatic)):
        handed_on = (f"M_{mechanism.index(own, number)}", f"_M_{own}")
        names += [name for name in handed_on if scene.defined(name)][:1]
    return [name for name in names if scene.defined(name)]


def reactions(scene: Scene, group: Group) -> list[tuple[Pair, int, list[str]]]:
    """Return the outer pairs of a group, its own link in each, and the reaction's name, or those of its two parts."""
    own = [next(number for number in pair.links if number in group.links) for pair in group.outer]
    wholes = [f"R_{scene.mechanism.index(*links)}" for links in zip(group.before, own, strict=True)]
    parts = [[name for name in (f"{whole}_n", f"{whole}_t") if name in scene.solved.values] for whole in wholes]
    return [(pair, n, p or [w]) for pair, n, p, w in zip(group.outer, own, parts, wholes, strict=True)]


def moments_of(scene: Scene, numbers: tuple[int, ...]) -> list[Moment]:
    """Return the moments that the construction takes of forces on these links, each arm once."""
    taken = {step.name: step.operands for step in scene.program.which(("moment",))}
    found: dict[str, Moment] = {}
    for step in scene.program.which(("arm",)):
        if step.operands[0] in taken:
            force, at, about = taken[step.operands[0]]
            if role(about).plan != "lever" and _link_of(scene, force) in numbers:
                found.setdefault(step.name, Moment(force, step.name, at, about))
    return list(found.values())


def _link_of(scene: Scene, force: str) -> int | None:
    own = (load.link for load in scene.mechanism.loads if load.name == force)
    acted = (link.number for link in scene.mechanism.links if link.number in role(force).links[-1:])
    return next(own, None) or next(acted, None)


@dataclass(slots=True)
class Arrows:
    """Arrows on a figure of main lines `strokes`; it remembers what lies at each place, and which forces are zero."""

    canvas: Canvas
    scene: Scene
    strokes: Sequence[Stroke]
    zero: list[str] = field(default_factory=list)
    hung: list[str] = field(default_factory=list)
    at: dict[complex, list[complex]] = field(default_factory=dict)  # ends of the arrows at each place, from there
    _lying: list[Stroke] = field(default_factory=list)
    _barred: dict[complex, list[complex]] = field(default_factory=dict)

    def hang(self, name: str, at: complex) -> None:
        """Draw the arrow of a force at a point, or beyond what stands there, and letter it; once."""
        if name in self.hung or not self.scene.defined(name):
            return
        self.hung.append(name)
        e = self.scene.direction(name)
        if e == 0:
            self.zero.append(name)
            return
        gap = self._gap(at, e)
        ray, start = self._where(at, e, gap)
        near, far = at + ray * start, at + ray * (start + self._length(start > gap))
        self.at.setdefault(_place(at), []).append(far - at)
        self._lying.append((near, far))
        tail, tip = (near, far) if abs(ray - e) < 1.0 else (far, near)
        self.canvas.add(Arrow(tail, tip, Pen.MAIN, name=name))  # its letter stands beside its outer half
        self.canvas.label(self.scene.letter(name), (far - ray * 0.55 * self.scene.style.force, far), clear=0.9)

    def _gap(self, at: complex, e: complex) -> float:
        return 0.0

    def bar(self, at: complex, directions: Iterable[complex]) -> None:
        """Let no arrow leave a place in these directions."""
        self._barred.setdefault(_place(at), []).extend(directions)

    def _where(self, at: complex, e: complex, gap: float) -> tuple[complex, float]:
        """Choose the side of a point on which an arrow lies, and how far from it, clear of all on its own line."""
        length, arrows = self.scene.style.force, self.at.get(_place(at), [])
        lines = [*rays_of(at, self.strokes), *self._barred.get(_place(at), ())]
        ray, _ = clear_ray(e, lines, arrows)
        start, other = self._start(at, ray, gap), self._start(at, -ray, gap)
        if start - other > 0.6 * length and room_on(-ray, lines, arrows) > 0.35:
            ray, start = -ray, other
        # far from its point it would not be found: then it lies on the link
        return (ray, start) if start < gap + FARTHEST * length else (ray, gap)

    def _start(self, at: complex, ray: complex, start: float) -> float:
        """Return where on a ray there is room for an arrow: beyond links and arrows that lie along it."""
        first, taken, spare = start, [], self.scene.style.pair + 1.0
        lying = [*((s, spare, 0.5) for s in self.strokes), *((s, SPARE, ALONG) for s in self._lying)]
        for stroke, spare, aside in lying:
            ends = [(end - at) / ray for end in stroke]
            if all(abs(end.imag) < aside for end in ends):
                taken.append((*sorted(end.real for end in ends), spare))
        for low, high, spare in sorted(taken):
            if low < start + self._length(start > first) - 0.5 and high > start + 0.5:
                start = high + spare
        return start

    def _length(self, beyond: bool) -> float:
        return self.scene.style.force * (SHORTER if beyond else 1.0)


def _place(at: complex) -> complex:
    return complex(round(at.real, 2), round(at.imag, 2))


class Arm(NamedTuple):
    """An arm: the forces on one line, the names of their arms, where they hang, their direction, the line's foot."""

    forces: tuple[str, ...]
    names: tuple[str, ...]
    at: complex
    along: complex
    foot: complex

    def draw(self, canvas: Canvas, scene: Scene, about: complex, shift: complex = 0j) -> None:
        """Draw the line of the forces, thin, from their arrow past its foot, and the arm from `about`, both shifted."""
        start, foot, reach = about + shift, self.foot + shift, 0.6 * scene.style.force
        ends = sorted((-reach, reach, ((foot - self.at) / self.along).real))
        line = (self.at + self.along * (ends[0] - PAST), self.at + self.along * (ends[-1] + PAST))
        canvas.add(Line(*line, Pen.THIN, role="line-of-action", name=" ".join(self.forces)))
        if abs(self.foot - about) >= LEAST:
            if shift:
                beyond = about + shift * (1 + 1.5 / abs(shift))
                canvas.add(Line(about, beyond, Pen.THIN, role="extension", name=self.names[0]))
            canvas.add(arm(start, foot, self.names[0], self.along, scene.style))
            # smaller than a node's letter: a number with its symbol is long, and arms lie close together
            symbols = " = ".join(scene.words.symbol(name) for name in self.names)
            text, height = f"{symbols} = {scene.segment(self.names[0])}", scene.style.text
            canvas.label(text, (start, foot), clear=0.9, height=height, strict=True, spare=text)


def zeros(scene: Scene, names: Iterable[str]) -> tuple[str, ...]:
    """Say in one line which of these forces, couples and arms are zero: the figure cannot show them."""
    w, couples = scene.words, {couple.name for couple in scene.mechanism.couples}
    gone = [name for name in dict.fromkeys(names) if scene.defined(name) and scene.vanishes(name)]
    parts = [w.symbol(role(name).shown, bar=role(name).kind not in ("M", "h") and name not in couples) for name in gone]
    return (f"{' = '.join(parts)} = 0",) if parts else ()


def lever_view(scene: Scene) -> View:
    """Draw the lever: forces keep their directions, couples hang as pairs, arms run from the pole."""
    canvas = scene.canvas(drawn_with(scene))
    words, point = scene.words, scene.mechanism.driver.point
    marks = dict.fromkeys(("lever.p", *images(scene)))
    lines, hung = lines_of_lever(scene), hung_on_lever(scene)
    strokes = [(image(scene, line.tail), image(scene, line.tip)) for line in lines]
    for stroke, line in zip(strokes, lines, strict=True):
        canvas.part(scene.last(canvas.parts.get(mark, mark) for mark in (line.tail, line.tip)))
        canvas.add(Line(*stroke, Pen.MAIN, role="lever", name=line.name))
    arrows = Arrows(canvas, scene, strokes)
    for name, mark in hung:
        at = image(scene, mark)
        canvas.part(name)
        arrows.bar(at, rays_of(at, strokes))
        arrows.hang(name, at)
    places = {mark: image(scene, mark) for mark in marks}
    pole, arms = image(scene, "lever.p"), arms_on_lever(scene)
    shifts = staggered(pole, arms, sum(places.values()) / len(places), STEP * scene.style.text)
    for number, each in enumerate(arms):
        canvas.part(scene.last(canvas.parts[force] for force in each.forces))
        each.draw(canvas, scene, pole, shifts.get(number, 0j))
    canvas.part(hung[-1][0])  # the velocity of the driver's point is the arm of the force that balances
    text = f"{words.mark('velocity.p')}{words.mark(f'velocity.{point}')} = {scene.segment(f'V_{point}')}"
    canvas.label(text, (pole, image(scene, hung[-1][1])), clear=0.9, height=scene.style.text, spare=text)
    letters = {mark: letter_of(scene, mark) for mark in marks} | {"lever.p": words.mark("lever.p")}
    letter_marks(canvas, scene, letters, places, ("lever.p",))
    gone = [arm_of(name) for name, _ in hung if scene.direction(name) != 0]
    zero = zeros(scene, [*arrows.zero, *gone])
    return canvas.finish("lever", scene.heading("heading.lever", "lever"), (words["said.lever"], *zero))


def drawn_with(scene: Scene) -> dict[str, str]:
    """Return the step in which each force and each image is drawn that is drawn with another.

    A force is hung with the first one on its mark; an image on which nothing hangs is turned with the last one.
    """
    first, found = dict[str, str](), dict[str, str]()
    for step in moments_on_lever(scene):
        found[step.operands[0]] = first.setdefault(step.operands[1], step.name)
    couples = {role(name).of: step for name, step in reversed(found.items()) if role(name).part == COUPLE}
    at_pole = [role(name) for name, _ in hung_on_lever(scene) if name not in found]
    found |= {name: couples[name.of] for name in at_pole if name.of in couples}
    last = [step.name for step in scene.program.on("lever") if step.verb == "normal"][-1]
    marks = (*images(scene), *(end for line in lines_of_lever(scene) for end in (line.tail, line.tip)))
    return found | {mark: last for mark in marks if mark not in scene.reading.made}


def letter_of(scene: Scene, mark: str) -> str:
    """Return the letter of a mark of the lever: that of the velocity plan."""
    return scene.words.mark(f"velocity.{role(mark).of}")


def arms_on_lever(scene: Scene) -> list[Arm]:
    """Return the arms; forces on one line share theirs."""
    p, feet = image(scene, "lever.p"), dict[complex, tuple[complex, complex, list[str]]]()
    for name, mark in hung_on_lever(scene):
        e, at = scene.direction(name), image(scene, mark)
        if e != 0 and name not in BALANCE and scene.defined(arm_of(name)):
            foot = at + e * (((p - at) / e).real)
            same = next((other for other in feet if abs(other - foot) < 1e-4), foot)
            feet.setdefault(same, (at, e, []))[2].append(name)
    return [Arm(tuple(own), tuple(map(arm_of, own)), at, e, foot) for foot, (at, e, own) in feet.items()]


def image(scene: Scene, mark: str) -> complex:
    """Return a mark of the lever, mm: that of the velocity plan turned by +90 degrees where nothing hangs on it."""
    if mark in scene.solved.values:
        return scene.mm(mark)
    return scene.mm(f"velocity.{role(mark).of}") * 1j


def images(scene: Scene) -> list[str]:
    """Return the marks of the lever: those on which something hangs, and the images of all joints."""
    hung = [step.name for step in scene.program.on("lever") if step.verb == "normal"]
    joints = [f"lever.{point}" for points in _joints(scene) for point in points]
    return [*hung, *joints]


def _joints(scene: Scene) -> list[list[str]]:
    """Return for each link the letters of its joints, and of its points over others, that have marks of velocity."""
    made, found = scene.reading.made, []
    for link in scene.mechanism.links:
        pairs = [pair for pair in scene.mechanism.pairs if link.number in pair.links]
        joints = [pair.point for pair in pairs if pair.point in link.points]
        over = [f"{pair.point}{link.number}" for pair in pairs]
        found.append([point for point in dict.fromkeys((*joints, *over)) if f"velocity.{point}" in made])
    return found


def lines_of_lever(scene: Scene) -> list[Edge]:
    """Return the lines of the turned velocity plan: all its vectors, and those between images of each link's joints."""
    ends = [(role(edge.tail).of, role(edge.tip).of, edge.name) for edge in scene.reading.on("velocity")]
    for points in _joints(scene):
        ways = combinations(points, 2) if len(points) < 4 else pairwise([*points, points[0]])
        ends += [(a, b, a + b) for a, b in ways]
    kept: dict[frozenset[complex], Edge] = {}
    for start, end, name in ends:
        line = Edge(name, f"lever.{start}", f"lever.{end}")
        both = (image(scene, mark) for mark in (line.tail, line.tip))
        places = frozenset(complex(round(at.real, 4), round(at.imag, 4)) for at in both)
        if len(places) == 2:
            kept.setdefault(places, line)
    return list(kept.values())


def hung_on_lever(scene: Scene) -> list[tuple[str, str]]:
    """Return (force, mark) of all that hangs on the lever, the balancing force last."""
    hung = [(step.operands[0], step.operands[1]) for step in moments_on_lever(scene)]
    # of a couple on a link that turns about a pivot the second force stands at the pole: it has no moment
    pulling = {name for name, _ in hung}
    made = (step.name for step in scene.program if role(step.name).part == COUPLE and step.law in ("along", "opposite"))
    hung += [(name, "lever.p") for name in made if name not in pulling]
    balance = next(name for name in BALANCE if name in scene.solved.values)
    return [*hung, (balance, f"lever.{scene.mechanism.driver.point}")]


def moments_on_lever(scene: Scene) -> Iterator[Step]:
    """Go through the moments that are taken about the pole of the lever."""
    return (step for step in scene.program.which(("moment",)) if step.operands[2] == "lever.p")


def arm_of(force: str) -> str:
    """Return the arm's name: of `F_i2` it is `h_lever_F_i2`, of the couple `F_i2_couple_B` `h_lever_M_i2_B`."""
    acting = role(force)
    couple = (spelled("M", acting.of, links=acting.links), acting.about)
    return lever_arm(*couple) if acting.part == COUPLE else lever_arm(force)


def staggered(pole: complex, arms: Sequence[Arm], middle: complex, step: float) -> Mapping[int, complex]:
    """Return by how much arms are moved along the lines of their forces; the shortest of those side by side stays.

    Arms are side by side when they make a small angle; each is moved away from the middle of the figure.
    """
    shifts, bundles = dict[int, complex](), dict[complex, int]()  # how many, by the direction of the shortest of them
    for reach, i in sorted((abs(each.foot - pole), i) for i, each in enumerate(arms) if abs(each.foot - pole) >= LEAST):
        way, outward = (arms[i].foot - pole) * (1.0 / reach), arms[i].along
        first = next((other for other in bundles if (way.conjugate() * other).real > BESIDE), way)
        outward *= -1.0 if (outward.conjugate() * (middle - pole)).real > 0 else 1.0
        if first in bundles:
            shifts[i] = outward * step * bundles[first]
        bundles[first] = bundles.get(first, 0) + 1
    return shifts
