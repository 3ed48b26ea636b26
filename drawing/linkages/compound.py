"""Compound motion told in words, and calculated: at every point of a coupler its parts are hung on one another.

Source: Bertyaev and others, Mechanics: course works with Mathcad, section 4.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ...plans.board import POSITION, Step
from ...plans.linkages.compound import ACCELERATION, COMPOUND, VELOCITY, Coupler
from ...plans.linkages.mechanism import ZERO
from ...plans.names import POLE, Name, between, rate, role, spelled, vector
from ...plans.quantities import unit_of
from ..printed import Input, calculation
from .calculations.equations import (
    Factor,
    Product,
    factor,
    noted,
    operand,
    printed_segment,
    sensed,
    size_by_law,
    worked,
)
from .figures.compound import At
from .scene import Scene, line_of
from .telling import Teller, Told

Line = tuple[str, ...]


def compound_told(teller: Teller, points: Sequence[At]) -> Iterator[Told]:
    """Go through the steps of one figure: the mechanism once more, then the vectors of every point."""
    made, letter = teller.made, teller.letter
    yield Told(teller.program.on(points[0].plan)[0], teller.say("compound_mechanism"), others=tuple(teller.points))
    for at in points:
        c = at.coupler
        if at.kind == "V":
            ends = {"start": teller.mark(c.pivot), "end": teller.mark(at.point)}
            distance = made[between("l", c.pivot, at.point)]
            length = " ".join(_segment(teller, distance.name, POSITION))
            yield Told(distance, teller.say("compound_distance", sum=length, **ends))
        for step in teller.program.on(at.plan):
            if step.verb == "chain":
                start, vector = step.operands
                parts = {"start": _start(teller, at, start), "line": teller.along(vector)}
                key = "compound_zero" if teller.vanishes(vector) else "compound_vector"
                yield Told(step, teller.say(key, vector=letter(vector), mm=teller.drawn(vector, at.plan), **parts))
            elif step.verb == "meet":
                p, u, q, w = step.operands
                parts = {"first": _start(teller, at, p), "other": teller.line(w), "second": _start(teller, at, q)}
                whole = letter(f"{at.kind}_{at.point}")
                yield Told(step, teller.say("compound_meet", one=teller.line(u), whole=whole, **parts))
            elif step.verb == "read" and not role(step.name).hidden:
                yield _measured(teller, at, step, "read", step.name)
            elif step.verb == "read":  # the part that was known by direction, then the whole
                closing = c.closing if at.point == c.span.end and at.kind == "a" else None
                if closing is not None and closing.normal is not None:
                    yield _measured(teller, at, step, "read", _tangential(closing.normal))
                yield _measured(teller, at, step, "whole", f"{at.kind}_{at.point}")
        if at.kind == "V" and at.point == [*c.letters][-1] and teller.defined(c.centre):
            line = f"{teller.mark(c.pivot)}{teller.mark(c.hinge)}"
            length = " ".join(_segment(teller, f"l_{c.hinge}P{c.number}", POSITION))
            text = teller.say("compound_centre", line=line, point=teller.words.symbol(c.centre), sum=length)
            yield Told(made[c.centre], text)


def _start(teller: Teller, at: At, mark: str) -> str:
    """Return in words where a vector or a line begins: in the point itself, or at the end of another vector."""
    if role(mark).kind == POLE:
        return teller.say("compound_point", point=teller.mark(at.point))
    return teller.say("compound_end", vector=teller.letter(teller.made[mark].operands[1]))


def _measured(teller: Teller, at: At, step: Step, key: str, name: str) -> Told:
    """Tell what of a quantity is measured in a step."""
    parts = {"vector": teller.letter(name), "point": teller.mark(at.point)}
    text = teller.say(f"compound_{key}", sum=" ".join(_segment(teller, name, at.plan)), **parts)
    return Told(step, text, others=(name,))


def block_name(coupler: Coupler, kind: str) -> str:
    """Return the name of the view of a coupler's equations: of velocities (`kind` "V") or of accelerations ("a")."""
    return f"equations_compound_{kind}_{coupler.number}"


def compound_lines(scene: Scene, c: Coupler, kind: str, only: str = "") -> Iterator[Line]:
    """Go through the equations of a coupler's velocities ("V") or accelerations ("a"), or those of the point `only`.

    What is said of the whole coupler stands before the first of its points: the split, and relative rates where no end
    is closed.
    """
    turning = ("omega", c.omega_e) if kind == "V" else ("epsilon", c.epsilon_e)
    for i, point in enumerate(c.letters):
        if only not in ("", point):
            continue
        if i == 0 and kind == "V":
            links = {"link": scene.link_name(c.number), "carrier": scene.link_name(c.carrier.number)}
            sentence = scene.words["said.split"].format(
                pivot=scene.words.mark(c.pivot), hinge=scene.words.mark(c.hinge), **links
            )
            yield tuple(sentence.split("|"))
        if i == 0 and c.closing is None:
            yield _sum_of_rates(scene, rate(turning[0], c.number, "r"), rate(turning[0], c.number), turning[1], -1.0)
            yield from _centre(scene, c) if kind == "V" else ()
        yield from _lines_of_point(scene, c, point, *turning)


def _lines_of_point(scene: Scene, c: Coupler, point: str, turning: str, carrier: str) -> Iterator[Line]:
    """Go through the vectors of a point as they are hung; where its end is closed they give the relative rate."""
    letter, closing = c.letters[point], c.closing if point == c.span.end else None
    kind = "V" if turning == "omega" else "a"
    plan, relative = spelled(VELOCITY if kind == "V" else ACCELERATION, letter), rate(turning, c.number, "r")
    normal = closing.normal if closing is not None and kind == "a" else None
    yield _vectors(scene, c, point, kind)
    if kind == "V":
        yield _segment(scene, between("l", c.pivot, point), POSITION)
    for part in (vector(kind, letter, part=part) for part in COMPOUND[kind]):
        step = scene.made[part]
        if step.verb == "calc":
            yield _by_law(scene, step)
            continue
        if normal is not None:
            group = next(group for group in scene.solved.structure.groups if c.number in group.links)
            link = scene.mechanism.link(next(number for number in group.links if number != c.number))
            pivot = next(point for point in link.points if point in scene.mechanism.frame_points)
            yield _product(scene, normal, factor(scene, f"omega_{link.number}", 2), _length(scene, pivot, c.span.end))
        yield _segment(scene, part, plan)
        if normal is not None:
            yield _segment(scene, _tangential(normal), plan)
        yield noted(_by_law(scene, scene.made[relative]), sensed(scene.words, scene.values[relative]))
        yield _sum_of_rates(scene, rate(turning, c.number), carrier, relative, 1.0)
        yield from _centre(scene, c) if kind == "V" else ()
    yield _segment(scene, f"{kind}_{point}", plan)


def _by_law(scene: Scene, step: Step) -> Line:
    """Return the size that the law of a step gives: arms are lengths here."""
    if ZERO in step.operands:
        return (f"{scene.words.symbol(step.name)} = 0",)

    def own(scene: Scene, name: str) -> Product:
        made = scene.made.get(name)
        arm = made is not None and made.verb == "read" and made.plan == POSITION
        return Product((_length(scene, *made.operands),)) if made is not None and arm else operand(scene, name)

    return size_by_law(scene, scene.words.symbol(step.name), step, unit_of(step.name), own)


def _tangential(normal: Name) -> Name:
    """Return the name of the tangential part that goes with a normal one."""
    return vector(normal.kind, normal.of, normal.about, "t")


def _vectors(scene: Scene, c: Coupler, point: str, kind: str) -> Line:
    """Return the vector equation of a point, and along which lines its unknown vectors lie."""
    closing, whole, notes = c.closing if point == c.span.end else None, scene.letter(f"{kind}_{point}"), list[str]()
    *parts, last = (vector(kind, c.letters[point], part=part) for part in COMPOUND[kind])
    if closing is not None:
        normal = closing.normal if kind == "a" else None
        # with a normal part only the tangential one of the whole is known by direction
        unknown = _tangential(normal) if normal is not None else f"{kind}_{point}"
        lines = ((last, c.span.n), (unknown, closing.direction))
        notes = [f"{scene.letter(name)} {line_of(scene, direction)}" for name, direction in lines]
        whole = " + ".join([*([scene.letter(normal, 2)] if normal is not None else []), scene.letter(unknown, 1)])
    first, *others = (*(scene.letter(part, 2) for part in parts), scene.letter(last, 2 if closing is None else 1))
    return noted((f"{whole} = {first}", *(f"+ {term}" for term in others)), *notes)


def _centre(scene: Scene, c: Coupler) -> Iterator[Line]:
    words = scene.words
    if not scene.defined(c.centre):
        yield tuple(words["said.no_centre"].format(link=scene.link_name(c.number)).split("|"))
        return
    pivot, hinge = (words.symbol(f"l_{end}P{c.number}") for end in (c.pivot, c.hinge))
    law = f"{pivot}·{words.symbol(c.omega_e)} = {hinge}·{words.symbol(f'omega_r_{c.number}')}"
    rates = factor(scene, c.omega_e), factor(scene, f"omega_{c.number}", -1)
    yield f"{law},", *_product(scene, f"l_{c.hinge}P{c.number}", _length(scene, c.pivot, c.hinge), *rates)


def _product(scene: Scene, name: str, *factors: Factor) -> Line:
    """Return a quantity as a product of magnitudes."""
    return worked(scene.words, scene.words.symbol(name), [Product(factors)], unit_of(name))


def _sum_of_rates(scene: Scene, name: str, first: str, second: str, sign: float) -> Line:
    """Return a rate as the algebraic sum of two others; one that is zero by the form of the mechanism is left out."""
    words, values = scene.words, scene.values
    terms = [(other, turn) for other, turn in ((first, 1.0), (second, sign)) if other != ZERO]
    signs = ["" if i == 0 and turn > 0 else "+ " if turn > 0 else "− " for i, (_, turn) in enumerate(terms)]
    formula = " ".join(f"{sign}{words.symbol(other)}" for sign, (other, _) in zip(signs, terms, strict=True))
    inputs = [Input(float(values[other]) * turn) for other, turn in terms]
    texts, result = calculation(words, lambda *x: sum(x), inputs)
    numbers = " ".join([texts[0], *(f"− {text[1:]}" if text.startswith("−") else f"+ {text}" for text in texts[1:])])
    head = f"{words.symbol(name)} = {formula} =", *([f"{numbers} ="] if len(terms) > 1 else [])
    return noted((*head, f"{result} {words.unit(unit_of(name))}"), sensed(words, float(values[name])))


def _segment(scene: Scene, name: str, plan: str) -> Line:
    """Return what was measured: the segment and the scale factor."""
    words, item = scene.words, scene.quantities[name]
    segment, number, value = printed_segment(scene, item, plan)
    product = f" {segment}{'/' if words.per_unit else '·'}{number} =" if segment else ""  # of what can be read
    return f"{words.symbol(name)} ={product}", f"{value} {words.unit(words.display.unit(item.unit))}"


def _length(scene: Scene, start: str, end: str) -> Factor:
    words, name = scene.words, f"l_{start}{end}"
    if name in scene.quantities:  # which is measured
        return factor(scene, name)
    size = words.display.value(abs(scene.solved.point(end) - scene.solved.point(start)), "m")
    exact = name in scene.givens
    return Factor(words.symbol(name), float(f"{size:.12g}") if exact else size, exact)
