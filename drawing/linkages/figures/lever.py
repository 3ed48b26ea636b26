"""Zhukovsky's lever: the velocity plan turned by 90 degrees, all forces hung on its ends, their arms about its pole."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from itertools import combinations, pairwise

from ....plans.names import COUPLE, lever_arm, role, spelled
from ...shapes import Line, Pen
from ...symbols import SQUARE, right_angle, unit
from ...view import View
from ..calculations.forces import BALANCE, POLE, couples_on_lever, hung_on_lever, letter_of, moments_on_lever
from ..reading import Edge
from ..scene import Scene
from .group import MANY, Sketch, arms_of, zeros
from .links import rays_of
from .plan import letter_marks


def lever_view(scene: Scene) -> View:
    """Draw the lever: forces keep their directions, couples hang as pairs, arms run from the pole."""
    words, driven, hung, lines = scene.words, scene.mechanism.driver.point, hung_on_lever(scene), lever_lines(scene)
    paired = {force for couple in couples_on_lever(scene).values() for force in couple.forces}
    single = [(name, mark) for name, mark in hung if name not in paired]
    images = [step.name for step in scene.program.on("lever") if step.verb == "normal"]
    marks = (POLE, *dict.fromkeys((*images, *(f"lever.{p}" for points in _joints(scene) for p in points))))
    canvas = scene.canvas(_drawn_with(scene, hung, (*marks, *(end for line in lines for end in (line.tail, line.tip)))))
    strokes = [(_image(scene, line.tail), _image(scene, line.tip)) for line in lines]
    for stroke, line in zip(strokes, lines, strict=True):
        canvas.part(scene.last(canvas.parts.get(mark, mark) for mark in (line.tail, line.tip)))
        canvas.add(Line(*stroke, Pen.MAIN if is_main(scene, line) else Pen.THIN, role="lever", name=line.name))
    sketch, places, pole = (
        Sketch(canvas, scene, strokes),
        {m: _image(scene, m) for m in marks},
        _image(scene, POLE),
    )
    sides = dict[str, complex]()
    for name, mark in hung:
        at = _image(scene, mark)
        canvas.part(name)
        sketch.bar(at, rays_of(at, strokes))
        sides[name] = sketch.hang(name, at, scene.hung(scene.letter(name), f"velocity.{role(mark).of}"))
    for name, mark, other in _along_lines(scene, hung):
        at, to = _image(scene, mark), _image(scene, other)
        if sides[name] and abs(to - at) > SQUARE[1]:
            canvas.part(name)
            canvas.add(right_angle(at, unit(to - at), sides[name], SQUARE[1]))
    moments = [(name, _arm_of(name), _image(scene, mark), pole) for name, mark in single if name not in BALANCE]
    arms = [own for _, own in arms_of(scene, moments)]
    alone = len(arms) > MANY
    shifts = sketch.shifts(pole, arms, sum(places.values()) / len(places))
    for number, own in enumerate(arms):
        canvas.part(scene.last(canvas.parts[force] for force in own.forces))
        own.draw(canvas, scene, pole, shifts.get(number, 0j), alone)
    balance, mark = hung[-1]
    canvas.part(balance)  # the velocity of the driver's point is the arm of the force that balances
    text = f"{words.mark('velocity.p')}{words.mark(f'velocity.{driven}')} = {scene.segment(f'V_{driven}', 'lever')}"
    canvas.label(text, (pole, _image(scene, mark)), clear=0.9, height=scene.style.text, spare=text)
    letters = {mark: letter_of(scene, mark) for mark in marks} | {POLE: words.mark(POLE)}
    ways = {m: f"{letters['lever.p']}{letters[m]} = {scene.length(abs(places[m] - pole))}" for m in marks[1:]}
    letter_marks(canvas, scene, letters, places, (POLE,), ways)
    gone = [_arm_of(name) for name, _ in single if scene.direction(name) != 0]
    said = ("said.lever", *sketch.said, *["said.arms"] * alone, *["said.couples"] * bool(paired))
    turned = replace(scene.scales["lever"], symbol=scene.scales["velocity"].symbol)  # it is a plan of velocities
    heading = words["heading.lever"], words.scale(turned)
    notes = (*(words[key] for key in said), *zeros(scene, [*sketch.zero, *gone]))
    return canvas.finish("lever", heading, notes, joined=True)


def _along_lines(scene: Scene, hung: Sequence[tuple[str, str]]) -> Iterator[tuple[str, str, str]]:
    """Go through the forces whose arm is a line of the lever itself: each, its mark, and the other end of the arm."""
    for couple in couples_on_lever(scene).values():
        marks = couple.marks
        yield from zip(couple.forces, marks, marks[::-1], strict=True)
    balance, mark = hung[-1]
    yield balance, mark, POLE


def _drawn_with(scene: Scene, hung: Sequence[tuple[str, str]], marks: Collection[str]) -> dict[str, str]:
    """Return the step in which each force and each image is drawn that is drawn with another.

    A force is hung with the first one on its mark; an image on which nothing hangs is turned with the last one.
    """
    first, parts = dict[str, str](), dict[str, str]()
    pairs = couples_on_lever(scene)
    together = {force: moment for moment, couple in pairs.items() for force in couple.forces}
    for step in moments_on_lever(scene):
        force, mark = step.operands[:2]
        parts[force] = together[force] if force in together else first.setdefault(mark, step.name)
    couples = {role(name).of: step for name, step in reversed(parts.items()) if role(name).part == COUPLE}
    parts |= {name: couples[role(name).of] for name, _ in hung if name not in parts and role(name).of in couples}
    last = [step.name for step in scene.program.on("lever") if step.verb == "normal"][-1]
    return parts | {mark: last for mark in marks if mark not in scene.made}


def _image(scene: Scene, mark: str) -> complex:
    """Return a mark of the lever, mm: that of the velocity plan turned by +90 degrees where nothing hangs on it."""
    at = scene.solved.point(mark if mark in scene.values else f"velocity.{role(mark).of}")
    return (at if mark in scene.values else at * 1j) * (1.0 / scene.scales["lever"].mu)


def _joints(scene: Scene) -> Iterator[list[str]]:
    """Go through the letters of the joints of each link, and of its points over others, that have marks of velocity."""
    for link in scene.mechanism.links:
        pairs = [pair for pair in scene.mechanism.pairs if link.number in pair.links]
        joints = [pair.point for pair in pairs if pair.point in link.points]
        points = dict.fromkeys((*joints, *(f"{pair.point}{link.number}" for pair in pairs)))
        yield [point for point in points if f"velocity.{point}" in scene.made]


def lever_lines(scene: Scene) -> list[Edge]:
    """Return the lines of the turned velocity plan: all its vectors, and those between images of each link's joints."""
    ends = [(role(edge.tail).of, role(edge.tip).of, edge.name) for edge in scene.reading.on("velocity")]
    for points in _joints(scene):
        ways = combinations(points, 2) if len(points) < 4 else pairwise([*points, points[0]])
        ends += [(a, b, a + b) for a, b in ways]
    kept: dict[frozenset[complex], Edge] = {}
    for start, end, name in ends:
        line = Edge(name, f"lever.{start}", f"lever.{end}")
        both = (_image(scene, mark) for mark in (line.tail, line.tip))
        places = frozenset(complex(round(at.real, 4), round(at.imag, 4)) for at in both)
        if len(places) == 2:
            kept.setdefault(places, line)
    return list(kept.values())


def is_main(scene: Scene, line: Edge) -> bool:
    """Whether a line of the lever joins joints; one to a centre of mass is thin, as forces lie beside it."""
    joints = {"p", *(point for points in _joints(scene) for point in points)}
    return {role(line.tail).of, role(line.tip).of} <= joints


def _arm_of(force: str) -> str:
    """Return the arm's name: of `F_i2` it is `h_lever_F_i2`, of the couple `F_i2_couple_B` `h_lever_M_i2_B`."""
    acting = role(force)
    if acting.part != COUPLE:
        return lever_arm(force)
    return lever_arm(spelled("M", acting.of, links=acting.links), acting.about)
