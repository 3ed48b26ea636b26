"""What acts on each link, and where: loads, reactions of other groups, couples and arms, as the program has them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from ....plans.laws import cross
from ....plans.linkages.mechanism import Pair, Prismatic
from ....plans.linkages.structure import Group
from ....plans.names import role
from ...shapes import Arrow, Line, Pen
from ...symbols import arm, clear_ray, room_on
from ...view import Canvas
from ..scene import Scene
from ..skeleton import Stroke, rays_of

Hung = list[tuple[str, str]]  # force, mark of the point where it acts
LEAST = 0.05  # mm: a shorter arm is none
PAST = 4.0  # mm by which the line of a force runs past what it meets
SHORTER = 0.6  # part of its length that an arrow beyond another one has
SPARE, ALONG = 1.2, 2.5  # mm between two arrows on a line, and beside one another where they count as on one
FARTHEST = 2.5  # lengths of an arrow that it may stand from its point


@dataclass(frozen=True, slots=True)
class Moment:
    """The moment of a force about a joint, and the name of its arm."""

    force: str
    arm: str
    at: str
    about: str


@dataclass(frozen=True, slots=True)
class Contact:
    """Where the reaction of a guide acts: the arm's name, the pin from which it is counted, along `u`, metres.

    `couple` names the moment of a reaction that has no size: then there is a couple and no arm.
    """

    arm: str
    pin: str
    u: complex
    offset: float
    couple: str


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
    for _, pair, own in _attached(scene, number):
        if isinstance(pair, Prismatic):
            handed_on = (f"M_{mechanism.index(own, number)}", f"_M_{own}")
            names += [name for name in handed_on if scene.defined(name)][:1]
    return [name for name in names if scene.defined(name)]


def reactions(scene: Scene, group: Group) -> list[tuple[Pair, int, list[str]]]:
    """Return the outer pairs of a group, its own link in each, and the reaction's name, or those of its two parts."""
    found = []
    for pair, before in zip(group.outer, group.before, strict=True):
        own = next(number for number in pair.links if number in group.links)
        whole = f"R_{scene.mechanism.index(before, own)}"
        parts = [f"{whole}_{part}" for part in ("n", "t") if f"{whole}_{part}" in scene.solved.values]
        found.append((pair, own, parts or [whole]))
    return found


def moments_of(scene: Scene, numbers: tuple[int, ...]) -> list[Moment]:
    """Return the moments that the construction takes of forces on these links, each arm once."""
    taken = {step.name: step.operands for step in scene.program if step.verb == "moment"}
    found: dict[str, Moment] = {}
    for step in scene.program:
        if step.verb == "arm" and step.operands[0] in taken:
            force, at, about = taken[step.operands[0]]
            if role(about).plan != "lever" and _link_of(scene, force) in numbers:
                found.setdefault(step.name, Moment(force, step.name, at, about))
    return list(found.values())


def _link_of(scene: Scene, force: str) -> int | None:
    """Return the link on which a force acts."""
    own = [load.link for load in scene.mechanism.loads if load.name == force]
    moving = {link.number for link in scene.mechanism.links}
    return next(iter(own + [on for on in role(force).links[-1:] if on in moving]), None)


def contact(scene: Scene, group: Group, pair: Prismatic, number: int, other: int) -> Contact | None:
    """Return where the reaction R of link `other` on `number` in a prismatic pair acts, both ways of naming tried."""
    for first, second in ((other, number), (number, other)):
        index = scene.mechanism.index(first, second)
        step = next((s for s in scene.program if s.verb == "arm" and s.name == f"h_{index}"), None)
        if step is not None and step.operands[1] == f"R_{index}":
            break
    else:
        return None
    moment, reaction = step.operands
    pin = group.pin(pair)
    u = scene.solved.point(scene.solved.guide_name(pair))
    value = float(scene.solved.values[moment])
    # the moment of the loads, which the reaction balances, or that of the reaction itself
    turning = -value if role(moment).hidden else value
    size = cross(u, complex(scene.solved.values[reaction])) if scene.direction(reaction) != 0 else 0.0
    couple = moment if size == 0.0 and not scene.vanishes(moment) else ""
    return Contact(step.name, pin, u, turning / size if size else 0.0, couple)


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

    def hang(self, name: str, at: complex, gap: float = 0.0) -> None:
        """Draw the arrow of a force at a point, `gap` mm from it or more, and letter it; once."""
        if name in self.hung or not self.scene.defined(name):
            return
        self.hung.append(name)
        e = self.scene.direction(name)
        if e == 0:
            self.zero.append(name)
            return
        ray, start = self._where(at, e, gap)
        near, far = at + ray * start, at + ray * (start + self._length(start > gap))
        self.at.setdefault(_place(at), []).append(far - at)
        self._lying.append((near, far))
        tail, tip = (near, far) if abs(ray - e) < 1.0 else (far, near)
        self.canvas.add(Arrow(tail, tip, Pen.MAIN, name=name))  # its letter stands beside its outer half
        self.canvas.label(self.scene.letter(name), (far - ray * 0.55 * self.scene.style.force, far), clear=0.9)

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
        first, taken = start, []
        lying = [(s, self.scene.style.pair + 1.0, 0.5) for s in self.strokes]
        lying += [(s, SPARE, ALONG) for s in self._lying]
        for (a, b), spare, aside in lying:
            ends = [(end - at) / ray for end in (a, b)]
            if all(abs(end.imag) < aside for end in ends):
                low, high = sorted(end.real for end in ends)
                taken.append((low, high, spare))
        for low, high, spare in sorted(taken):
            if low < start + self._length(start > first) - 0.5 and high > start + 0.5:
                start = high + spare
        return start

    def _length(self, beyond: bool) -> float:
        """Return the length of an arrow, one `beyond` another on its line being shorter, to stay near its point."""
        return self.scene.style.force * (SHORTER if beyond else 1.0)


def _place(at: complex) -> complex:
    return complex(round(at.real, 2), round(at.imag, 2))


@dataclass(frozen=True, slots=True)
class Arm:
    """An arm: the forces on one line, the names of their arms, where they hang, their direction, the line's foot."""

    forces: tuple[str, ...]
    names: tuple[str, ...]
    at: complex
    along: complex
    foot: complex

    def said(self, scene: Scene) -> str:
        """Return what is written on the arm."""
        symbols = " = ".join(scene.words.symbol(name) for name in self.names)
        return f"{symbols} = {scene.segment(self.names[0])}"

    @property
    def line(self) -> str:
        """The name of the line on which the forces act."""
        return " ".join(self.forces)

    def draw(self, canvas: Canvas, scene: Scene, about: complex, shift: complex = 0j) -> None:
        """Draw the line of the forces, thin, from their arrow past its foot, and the arm from `about`, both shifted."""
        start, foot, reach = about + shift, self.foot + shift, 0.6 * scene.style.force
        ends = sorted((-reach, reach, ((foot - self.at) / self.along).real))
        line = (self.at + self.along * (ends[0] - PAST), self.at + self.along * (ends[-1] + PAST))
        canvas.add(Line(*line, Pen.THIN, role="line-of-action", name=self.line))
        if abs(self.foot - about) >= LEAST:
            if shift:
                beyond = about + shift * (1 + 1.5 / abs(shift))
                canvas.add(Line(about, beyond, Pen.THIN, role="extension", name=self.names[0]))
            canvas.add(arm(start, foot, self.names[0], self.along, scene.style))
            # smaller than a node's letter: a number with its symbol is long, and arms lie close together
            text, height = self.said(scene), scene.style.text
            canvas.label(text, (start, foot), clear=0.9, height=height, strict=True, spare=text)
