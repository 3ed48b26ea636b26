"""Compound motion, told: at every point of a coupler its parts are hung on one another, as one draws them there."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from ....plans.board import POSITION, Step
from ....plans.linkages.compound import Coupler
from ....plans.names import POLE, role
from ..at_point import At
from ..calculations.compound import block_name, compound_lines, measured, tangential
from ..calculations.equations import Lines
from .teller import Teller, Told


def compound_equations(teller: Teller) -> dict[str, Lines]:
    """Return the equations that stand before the steps of each figure of compound motion, by the name of its view."""
    return {
        view: [line for at in points for line in compound_lines(teller.scene, at.coupler, at.kind, at.point)]
        for view, points in teller.figures.items()
    }


def compound_blocks(teller: Teller) -> frozenset[str]:
    """Return the names of the views of the sheet whose equations stand with the steps."""
    return frozenset(block_name(at.coupler, at.kind) for points in teller.figures.values() for at in points)


def compound_told(teller: Teller, view: str) -> Iterator[Told]:
    """Go through the steps of one figure: the mechanism once more, then the vectors of every point."""
    scene, points = teller.scene, teller.figures[view]
    first = scene.solved.program.on(points[0].plan)[0]
    marks = {point for link in scene.solved.mechanism.links for point in link.points}
    links = frozenset(f"link:{link.number}" for link in scene.solved.mechanism.links)
    letters = frozenset(scene.words.mark(mark) for mark in marks)
    yield Told(first, teller.say("compound_mechanism"), names=links | marks, letters=letters)
    for at in points:
        yield from _at(teller, at)
        if at.kind == "V" and at.point == [*at.coupler.letters][-1]:
            yield from _centre(teller, at.coupler)


def _at(teller: Teller, at: At) -> Iterator[Told]:
    """Go through the steps of one point."""
    if at.kind == "V":
        yield _distance(teller, at)
    for step in teller.scene.solved.program.on(at.plan):
        if step.verb == "chain":
            yield _hung(teller, at, step)
        elif step.verb == "meet":
            yield _met(teller, at, step)
        elif step.verb == "read":
            yield from _measured(teller, at, step)


def _distance(teller: Teller, at: At) -> Told:
    """Tell the arm of the transport rotation, which is measured on the drawing."""
    name = f"l_{at.coupler.pivot}{at.point}"
    step = teller.reading.made[name]
    start, end = (teller.mark(mark) for mark in step.operands)
    said = " ".join(measured(teller.scene, name, POSITION))
    text = teller.say("compound_distance", start=start, end=end, sum=said)
    return Told(step, text, names=frozenset((name,)))


def _hung(teller: Teller, at: At, step: Step) -> Told:
    """Tell a part that is known in full."""
    start, vector = step.operands
    letter = teller.vector(vector)
    if teller.scene.vanishes(vector):
        return Told(step, teller.say("compound_zero", vector=letter))
    mm = teller.drawn(vector, at.plan)
    begin = _start(teller, at, start)
    text = teller.say("compound_vector", start=begin, line=teller.along(vector), vector=letter, mm=mm)
    return _drawn(step, text, vector, letter)


def _start(teller: Teller, at: At, mark: str) -> str:
    """Return in words where a vector or a line begins: in the point itself, or at the end of another vector."""
    if role(mark).kind == POLE:
        return teller.say("compound_point", point=teller.mark(at.point))
    before = teller.reading.made[mark]
    return teller.say("compound_end", vector=teller.vector(before.operands[1]))


def _met(teller: Teller, at: At, step: Step) -> Told:
    """Tell the two lines that close the figure."""
    p, u, q, w = step.operands
    lines = [(teller.line(direction), _start(teller, at, mark)) for mark, direction in ((p, u), (q, w))]
    (one, first), (other, second) = lines
    text = teller.say("compound_meet", one=one, first=first, other=other, second=second, whole=_whole(teller, at))
    letters = frozenset(said for *_, said in at.lines())
    return Told(step, text, names=frozenset(f"{at.plan}_{i}" for i in (1, 2)), letters=letters)


def _whole(teller: Teller, at: At) -> str:
    return teller.vector(f"{at.kind}_{at.point}")


def _measured(teller: Teller, at: At, step: Step) -> Iterator[Told]:
    """Tell what is measured: the part that was known by direction, then the whole."""
    say = partial(_reading, teller, at, step)
    if not role(step.name).hidden:
        yield say(step.name, "compound_read")
        return
    closing = at.coupler.closing if at.point == at.coupler.span.end else None
    if at.kind == "a" and closing is not None and closing.normal is not None:
        yield say(tangential(closing.normal), "compound_read")
    yield say(f"{at.kind}_{at.point}", "compound_whole")


def _reading(teller: Teller, at: At, step: Step, name: str, key: str) -> Told:
    vector = teller.vector(name)
    said = " ".join(measured(teller.scene, name, at.plan))
    text = teller.say(key, vector=vector, sum=said, point=teller.mark(at.point))
    return _drawn(step, text, name, vector)


def _drawn(step: Step, text: str, vector: str, letter: str) -> Told:
    return Told(step, text, names=frozenset((vector,)), letters=frozenset((letter,)))


def _centre(teller: Teller, c: Coupler) -> Iterator[Told]:
    """Tell where the instant centre of a coupler stands, where it has one."""
    scene = teller.scene
    if not scene.defined(c.centre):
        return
    symbol, step = scene.words.symbol(c.centre), teller.reading.made[c.centre]
    name = f"l_{c.hinge}P{c.number}"
    said = " ".join(measured(scene, name, POSITION))
    text = teller.say("compound_centre", line=f"{teller.mark(c.pivot)}{teller.mark(c.hinge)}", point=symbol, sum=said)
    names = frozenset((c.centre, *(f"{c.centre}_{joint}" for joint in (c.hinge, c.span.end))))
    yield Told(step, text, names=names, letters=frozenset((symbol,)))
