"""Zhukovsky's lever: the turned velocity plan with all forces hung on it, and every arm."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations, pairwise
from math import cos, radians

from ....plans.names import COUPLE, lever_arm, role, spelled
from ...shapes import Line, Pen
from ...view import View
from ..reading import Edge
from ..scene import Scene
from ..skeleton import rays_of
from .acting import LEAST, Arm, Arrows
from .group import zeros
from .inset import letter_marks

BALANCE = ("_F_bal_lever", "_F_bal")  # the balancing force of the lever, where a force balances and where a moment
BESIDE = cos(radians(12.0))  # arms that make a smaller angle run into one another
STEP = 2.4  # heights of an arm's letters between arms that are staggered


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
    for number, arm in enumerate(arms):
        canvas.part(scene.last(canvas.parts[force] for force in arm.forces))
        arm.draw(canvas, scene, pole, shifts.get(number, 0j))
    text, ends = driven(scene), (pole, image(scene, f"lever.{point}"))
    canvas.part(hung[-1][0])
    canvas.label(text, ends, clear=0.9, height=scene.style.text, spare=text)
    letters = {mark: letter_of(scene, mark) for mark in marks} | {"lever.p": words.mark("lever.p")}
    letter_marks(canvas, scene, letters, places, ("lever.p",))
    gone = [arm_of(name) for name, _ in hung if scene.direction(name) != 0]
    zero = zeros(scene, [*arrows.zero, *gone])
    return canvas.finish("lever", scene.heading("heading.lever", "lever"), (words["said.lever"], *zero))


def drawn_with(scene: Scene) -> dict[str, str]:
    """Return the step in which each force and each image is drawn that is drawn with another.

    A force is hung with the first one on its mark; an image on which nothing hangs is turned with the last one.
    """
    first: dict[str, str] = {}
    found: dict[str, str] = {}
    for step in scene.program.which(("moment",)):
        force, mark, about = step.operands
        if about == "lever.p":
            found[force] = first.setdefault(mark, step.name)
    couples = {role(name).of: stage for name, stage in reversed(found.items()) if role(name).part == COUPLE}
    found |= {
        name: couples[role(name).of]
        for name, _ in hung_on_lever(scene)
        if role(name).of in couples and name not in found
    }
    last = [step.name for step in scene.program.on("lever") if step.verb == "normal"][-1]
    marks = (*images(scene), *(end for line in lines_of_lever(scene) for end in (line.tail, line.tip)))
    return found | {mark: last for mark in marks if mark not in scene.reading.made}


def driven(scene: Scene) -> str:
    """Return what is written on the velocity of the driver's point, the arm of the force that balances."""
    words, point = scene.words, scene.mechanism.driver.point
    return f"{words.mark('velocity.p')}{words.mark(f'velocity.{point}')} = {scene.segment(f'V_{point}')}"


def letter_of(scene: Scene, mark: str) -> str:
    """Return the letter of a mark of the lever: that of the velocity plan."""
    return scene.words.mark(f"velocity.{role(mark).of}")


def arms_on_lever(scene: Scene) -> list[Arm]:
    """Return the arms; forces on one line share theirs."""
    p, feet = image(scene, "lever.p"), dict[complex, list[tuple[str, complex]]]()
    for name, mark in hung_on_lever(scene):
        e, at = scene.direction(name), image(scene, mark)
        if e != 0 and name not in BALANCE and scene.defined(arm_of(name)):
            foot = at + e * (((p - at) / e).real)
            same = next((other for other in feet if abs(other - foot) < 1e-4), foot)
            feet.setdefault(same, []).append((name, at))
    return [
        Arm(tuple(n for n, _ in sharing), tuple(arm_of(n) for n, _ in sharing), sharing[0][1], along, foot)
        for foot, sharing in feet.items()
        for along in [scene.direction(sharing[0][0])]
    ]


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
    mechanism, names = scene.mechanism, set(scene.program.names)
    found = []
    for link in mechanism.links:
        joints = [p.point for p in mechanism.pairs if link.number in p.links and p.point in link.points]
        over = [p.point + str(link.number) for p in mechanism.pairs if link.number in p.links]
        found.append([point for point in dict.fromkeys((*joints, *over)) if f"velocity.{point}" in names])
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
        images = (image(scene, mark) for mark in (line.tail, line.tip))
        places = frozenset(complex(round(at.real, 4), round(at.imag, 4)) for at in images)
        if len(places) == 2:
            kept.setdefault(places, line)
    return list(kept.values())


def hung_on_lever(scene: Scene) -> list[tuple[str, str]]:
    """Return (force, mark) of all that hangs on the lever, the balancing force last."""
    hung = [
        (step.operands[0], step.operands[1])
        for step in scene.program
        if step.verb == "moment" and step.operands[2] == "lever.p"
    ]
    # of a couple on a link that turns about a pivot the second force stands at the pole: it has no moment
    pulling = {name for name, _ in hung}
    made = (step.name for step in scene.program if role(step.name).part == COUPLE and step.law in ("along", "opposite"))
    hung += [(name, "lever.p") for name in made if name not in pulling]
    balance = next(name for name in BALANCE if name in scene.solved.values)
    return [*hung, (balance, f"lever.{scene.mechanism.driver.point}")]


def arm_of(force: str) -> str:
    """Return the arm's name: of `F_i2` it is `h_lever_F_i2`, of the couple `F_i2_couple_B` `h_lever_M_i2_B`."""
    acting = role(force)
    return (
        lever_arm(spelled("M", acting.of, links=acting.links), acting.about)
        if acting.part == COUPLE
        else lever_arm(force)
    )


def staggered(pole: complex, arms: Sequence[Arm], middle: complex, step: float) -> Mapping[int, complex]:
    """Return by how much arms are moved along the lines of their forces; the shortest of those side by side stays.

    Arms are side by side when they make a small angle; each is moved away from the middle of the figure.
    """
    shifts: dict[int, complex] = {}
    by_length = sorted((abs(each.foot - pole), i) for i, each in enumerate(arms) if abs(each.foot - pole) >= LEAST)
    bundles: list[tuple[complex, list[int]]] = []  # direction of the shortest of them, their numbers
    for reach, i in by_length:
        way = (arms[i].foot - pole) * (1.0 / reach)
        bundle = next((numbers for other, numbers in bundles if (way.conjugate() * other).real > BESIDE), None)
        if bundle is None:
            bundles.append((way, [i]))
            continue
        outward = arms[i].along
        outward *= -1.0 if (outward.conjugate() * (middle - pole)).real > 0 else 1.0
        shifts[i] = outward * step * len(bundle)
        bundle.append(i)
    return shifts
