"""Compound motion told in words and numbers: at every point of a coupler its parts are hung on one another."""

from __future__ import annotations

from collections.abc import Iterator

from ....plans.board import POSITION, Step
from ....plans.linkages.compound import ACCELERATION, COMPOUND, VELOCITY, Closing, Coupler
from ....plans.linkages.mechanism import ZERO
from ....plans.names import POLE, Name, role, spelled, vector
from ...printed import Input, calculation
from ..calculations.equations import (
    Factor,
    Product,
    by_direction,
    factor,
    known,
    line_note,
    line_of,
    noted,
    sensed,
    worked,
)
from ..calculations.tables import printed_segment
from ..figures.inset import At
from ..scene import Scene
from .teller import Teller, Told

Line = tuple[str, ...]
UNITS = {"V": "m/s", "a": "m/s^2", "omega": "rad/s", "epsilon": "rad/s^2"}


def compound_told(teller: Teller, view: str) -> Iterator[Told]:
    """Go through the steps of one figure: the mechanism once more, then the vectors of every point."""
    scene, points = teller.scene, teller.figures[view]
    first = scene.program.on(points[0].plan)[0]
    marks = (point for link in scene.mechanism.links for point in link.points)
    yield Told(first, teller.say("compound_mechanism"), others=tuple(marks))
    for at in points:
        if at.kind == "V":
            yield _distance(teller, at)
        for step in scene.program.on(at.plan):
            if step.verb in POINT_STEPS:
                yield from POINT_STEPS[step.verb](teller, at, step)
        if at.kind == "V" and at.point == [*at.coupler.letters][-1] and scene.defined(at.coupler.centre):
            yield _centre_told(teller, at.coupler)


def _distance(teller: Teller, at: At) -> Told:
    """Tell the arm of the transport rotation, which is measured on the drawing."""
    name = f"l_{at.coupler.pivot}{at.point}"
    step = teller.reading.made[name]
    start, end = (teller.mark(mark) for mark in step.operands)
    said = " ".join(measured(teller.scene, name, POSITION))
    return Told(step, teller.say("compound_distance", start=start, end=end, sum=said))


def _hung(teller: Teller, at: At, step: Step) -> Iterator[Told]:
    """Tell a part that is known in full."""
    start, vector = step.operands
    letter = teller.scene.letter(vector)
    if teller.scene.vanishes(vector):
        yield Told(step, teller.say("compound_zero", vector=letter))
        return
    parts = {"start": _start(teller, at, start), "line": teller.along(vector), "mm": teller.drawn(vector, at.plan)}
    yield Told(step, teller.say("compound_vector", vector=letter, **parts))


def _start(teller: Teller, at: At, mark: str) -> str:
    """Return in words where a vector or a line begins: in the point itself, or at the end of another vector."""
    if role(mark).kind == POLE:
        return teller.say("compound_point", point=teller.mark(at.point))
    before = teller.reading.made[mark]
    return teller.say("compound_end", vector=teller.scene.letter(before.operands[1]))


def _met(teller: Teller, at: At, step: Step) -> Iterator[Told]:
    """Tell the two lines that close the figure."""
    p, u, q, w = step.operands
    lines = [(teller.line(direction), _start(teller, at, mark)) for mark, direction in ((p, u), (q, w))]
    (one, first), (other, second) = lines
    whole = teller.scene.letter(f"{at.kind}_{at.point}")
    text = teller.say("compound_meet", one=one, first=first, other=other, second=second, whole=whole)
    yield Told(step, text)


def _measured(teller: Teller, at: At, step: Step) -> Iterator[Told]:
    """Tell what is measured: the part that was known by direction, then the whole."""
    found = {step.name: "compound_read"}
    if role(step.name).hidden:
        closing = _closing(at.coupler, at.point) if at.kind == "a" else None
        parts = [tangential(closing.normal)] if closing is not None and closing.normal is not None else []
        found = dict.fromkeys(parts, "compound_read") | {f"{at.kind}_{at.point}": "compound_whole"}
    for name, key in found.items():
        said = " ".join(measured(teller.scene, name, at.plan))
        text = teller.say(key, vector=teller.scene.letter(name), sum=said, point=teller.mark(at.point))
        yield Told(step, text, others=(name,))


POINT_STEPS = {"chain": _hung, "meet": _met, "read": _measured}


def _centre_told(teller: Teller, c: Coupler) -> Told:
    """Tell where the instant centre of a coupler stands."""
    scene, line = teller.scene, f"{teller.mark(c.pivot)}{teller.mark(c.hinge)}"
    symbol, said = scene.words.symbol(c.centre), " ".join(measured(scene, f"l_{c.hinge}P{c.number}", POSITION))
    text = teller.say("compound_centre", line=line, point=symbol, sum=said)
    return Told(teller.reading.made[c.centre], text)


def block_name(coupler: Coupler, kind: str) -> str:
    """Return the name of the view of a coupler's equations: of velocities (`kind` "V") or of accelerations ("a")."""
    return f"equations_compound_{kind}_{coupler.number}"


def compound_heading(scene: Scene, c: Coupler, kind: str) -> str:
    """Return the heading of a coupler's equations."""
    return scene.words[f"heading.equations_compound_{kind}"].format(link=_name(scene, c.number))


def compound_lines(scene: Scene, c: Coupler, kind: str, only: str = "") -> list[Line]:
    """Return the equations of a coupler's velocities ("V") or accelerations ("a"), all or those of the point `only`.

    What is said of the whole coupler stands before the first of its points.
    """
    points = [point for point in c.letters if only in ("", point)]
    lines = list(_of_the_whole(scene, c, kind)) if next(iter(c.letters)) in points else []
    return [*lines, *(line for point in points for line in _lines_of_point(scene, c, point, kind))]


def _of_the_whole(scene: Scene, c: Coupler, kind: str) -> Iterator[Line]:
    """Go through what is known before any point: the split, and relative rates where no end is closed."""
    words = scene.words
    if kind == "V":
        links = {"link": _name(scene, c.number), "carrier": _name(scene, c.carrier.number)}
        said = words["said.split"].format(pivot=words.mark(c.pivot), hinge=words.mark(c.hinge), **links)
        yield tuple(said.split("|"))
    if c.closing is None:
        whole, carrier = _rates(c, kind)
        yield _sum_of_rates(scene, f"{whole}_r_{c.number}", f"{whole}_{c.number}", carrier, -1.0)
        if kind == "V":
            yield from _centre(scene, c)


def _lines_of_point(scene: Scene, c: Coupler, point: str, kind: str) -> Iterator[Line]:
    """Go through the vectors of a point as they are hung; where its end is closed they give the relative rate."""
    letter, closing, (whole, carrier) = c.letters[point], _closing(c, point), _rates(c, kind)
    plan, rate = spelled(VELOCITY if kind == "V" else ACCELERATION, letter), f"{whole}_r_{c.number}"
    relative = f"V_{letter}_r" if kind == "V" else f"a_{letter}_rt"
    yield _vectors(scene, c, point, kind)
    if kind == "V":
        distance = f"l_{c.pivot}{point}"
        yield measured(scene, distance, POSITION)
        yield _product(scene, f"V_{letter}_e", factor(scene, c.omega_e), factor(scene, distance))
    else:
        yield from _known_parts(scene, c, point)
    if closing is None:
        yield _product(scene, relative, factor(scene, rate), _length(scene, c.hinge, point))
    else:
        normal = closing.normal if kind == "a" else None
        if normal is not None:
            yield _normal(scene, c, normal)
        yield measured(scene, relative, plan)
        if normal is not None:
            yield measured(scene, tangential(normal), plan)
        yield _product(scene, rate, factor(scene, relative), _length(scene, c.hinge, point, -1))
        yield _sum_of_rates(scene, f"{whole}_{c.number}", carrier, rate, 1.0)
        yield from _centre(scene, c) if kind == "V" else ()
    yield measured(scene, f"{kind}_{point}", plan)


def _rates(c: Coupler, kind: str) -> tuple[str, str]:
    """Return the kind of rates that go with velocities or accelerations, and that of the carrier."""
    return ("omega", c.omega_e) if kind == "V" else ("epsilon", c.epsilon_e)


def _closing(c: Coupler, point: str) -> Closing | None:
    return c.closing if point == c.span.end else None


def _known_parts(scene: Scene, c: Coupler, point: str) -> Iterator[Line]:
    """Go through the parts that the velocities give: normal ones, the tangential one of transport, Coriolis."""
    letter, distance = c.letters[point], factor(scene, f"l_{c.pivot}{point}")
    yield _product(scene, f"a_{letter}_rn", factor(scene, f"omega_r_{c.number}", 2), _length(scene, c.hinge, point))
    yield _product(scene, f"a_{letter}_en", factor(scene, c.omega_e, 2), distance)
    if c.epsilon_e == ZERO:
        yield (f"{scene.words.symbol(f'a_{letter}_et')} = 0",)
    else:
        yield _product(scene, f"a_{letter}_et", factor(scene, c.epsilon_e), distance)
    two = Factor("2", 2.0, exact=True)
    yield _product(scene, f"a_{letter}_k", two, factor(scene, c.omega_e), factor(scene, f"V_{letter}_r"))


def _normal(scene: Scene, c: Coupler, normal: Name) -> Line:
    """Return the normal part on the circle of the end, which the other link of the group draws."""
    group = next(group for group in scene.solved.structure.groups if c.number in group.links)
    link = scene.mechanism.link(next(number for number in group.links if number != c.number))
    pivot = next(point for point in link.points if point in scene.mechanism.frame_points)
    return _product(scene, normal, factor(scene, f"omega_{link.number}", 2), _length(scene, pivot, c.span.end))


def tangential(normal: Name) -> Name:
    """Return the name of the tangential part that goes with a normal one."""
    return vector(normal.kind, normal.of, normal.about, "t")


def _vectors(scene: Scene, c: Coupler, point: str, kind: str) -> Line:
    """Return the vector equation of a point, and along which lines its unknown vectors lie."""
    closing, letter = _closing(c, point), c.letters[point]
    *parts, last = (scene.letter(vector(kind, letter, part=part)) for part in COMPOUND[kind])
    whole, notes = scene.letter(f"{kind}_{point}"), list[str]()
    if closing is not None:
        notes = [f"{last} {line_of(scene, c.span.n)}", f"{whole} {line_of(scene, closing.direction)}"]
        whole = by_direction(whole)
    if closing is not None and kind == "a" and closing.normal is not None:
        across = tangential(closing.normal)
        notes[1] = line_note(scene, across, closing.direction)
        whole = f"{known(scene.letter(closing.normal))} + {by_direction(scene.letter(across))}"
    first, *others = (*map(known, parts), known(last) if closing is None else by_direction(last))
    return noted((f"{whole} = {first}", *(f"+ {term}" for term in others)), *notes)


def _centre(scene: Scene, c: Coupler) -> Iterator[Line]:
    """Go through what places the instant centre: the two rotations cancel there."""
    words = scene.words
    if not scene.defined(c.centre):
        yield tuple(words["said.no_centre"].format(link=_name(scene, c.number)).split("|"))
        return
    pivot, hinge = (words.symbol(f"l_{end}P{c.number}") for end in (c.pivot, c.hinge))
    law = f"{pivot}·{words.symbol(c.omega_e)} = {hinge}·{words.symbol(f'omega_r_{c.number}')}"
    rates = factor(scene, c.omega_e), factor(scene, f"omega_{c.number}", -1)
    yield f"{law},", *_product(scene, f"l_{c.hinge}P{c.number}", _length(scene, c.pivot, c.hinge), *rates)


def _product(scene: Scene, name: str, *factors: Factor) -> Line:
    """Return a quantity as a product of magnitudes; of a rate the sense, too."""
    head = role(name).kind
    line = worked(scene.words, scene.words.symbol(name), [Product(factors)], UNITS.get(head, "m"))
    sense = sensed(scene.words, scene.solved.values[name]) if head in ("omega", "epsilon") else ""
    return noted(line, sense)


def _sum_of_rates(scene: Scene, name: str, first: str, second: str, sign: float) -> Line:
    """Return a rate as the algebraic sum of two others; one that is zero by the form of the mechanism is left out."""
    words, values = scene.words, scene.solved.values
    terms = [(other, turn) for other, turn in ((first, 1.0), (second, sign)) if other != ZERO]
    signs = ["" if i == 0 and turn > 0 else "+ " if turn > 0 else "− " for i, (_, turn) in enumerate(terms)]
    formula = " ".join(f"{sign}{words.symbol(other)}" for sign, (other, _) in zip(signs, terms, strict=True))
    inputs = [Input(float(values[other]) * turn) for other, turn in terms]
    texts, result = calculation(words, lambda *x: sum(x), inputs)
    numbers = " ".join([texts[0], *(f"− {text[1:]}" if text.startswith("−") else f"+ {text}" for text in texts[1:])])
    head = f"{words.symbol(name)} = {formula} =", *([f"{numbers} ="] if len(terms) > 1 else [])
    last = f"{result} {words.unit(UNITS[role(name).kind])}"
    return noted((*head, last), sensed(words, float(values[name])))


def measured(scene: Scene, name: str, plan: str) -> Line:
    """Return what was measured: the segment and the scale factor."""
    words, item = scene.words, scene.solved.quantities[name]
    segment, number, value = printed_segment(scene, item, plan)
    head = f"{words.symbol(name)} = {segment}{'/' if words.per_unit else '·'}{number} ="
    return head, f"{value} {words.unit(words.display.unit(item.unit))}"


def _length(scene: Scene, start: str, end: str, power: int = 1) -> Factor:
    """Return the distance of two points of a link; one that the task gives is exact."""
    words, name = scene.words, f"l_{start}{end}"
    size = words.display.value(abs(scene.solved.point(end) - scene.solved.point(start)), "m")
    exact = name in scene.givens
    return Factor(words.symbol(name), float(f"{size:.12g}") if exact else size, exact, power)


def _name(scene: Scene, number: int) -> str:
    """Return a link by its ends."""
    return scene.words.ends.get(str(number), str(number))
