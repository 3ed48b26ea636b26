"""Compound motion drawn at the points themselves, told in words, and calculated.

One figure shows the velocities of all points, one the accelerations of each, both with the mechanism to scale. Links
are thin here, so that the vectors stand out; what is too short to be read stands once more in an inset, enlarged. At
every point of a coupler its parts are hung on one another.

Source: Bertyaev and others, Mechanics: course works with Mathcad, figs. 13-16.
"""

from __future__ import annotations

import math
from cmath import rect
from collections.abc import Iterator, Sequence
from dataclasses import replace

from ...plans.board import POSITION, Step
from ...plans.linkages.compound import ACCELERATION, COMPOUND, VELOCITY, Coupler
from ...plans.linkages.mechanism import ZERO
from ...plans.names import POLE, Name, mark, role, spelled
from ...plans.names import vector as vector_named
from ..figure import ANSWERS
from ..printed import Input, calculation
from ..shapes import Arrow, Group, Line, Pen, Shape, Vector
from ..symbols import clear_ray, turning_arrow, unit
from ..view import Canvas, View
from .calculations.equations import Factor, Product, by_direction, factor, known, line_of, noted, sensed, worked
from .calculations.tables import printed_segment
from .figures.inset import ACCELERATIONS, VELOCITIES, At, windows, with_insets
from .figures.links import Skeleton, draw_frame, draw_links, pins_of, rays_at, rays_of
from .figures.scheme import free_arc, obstacles
from .reading import Edge
from .scene import Scene
from .telling import Teller, Told

SIZES, SPREAD, UP = (0.5, 0.75, 1.0), 1.2, 0.5 * math.pi  # of arcs of turning: radii beyond the joint in arrows, angles
FAR = 0.75  # part of the mechanism's size within which an instant centre is drawn
Said = tuple[str, ...]
UNITS = {"V": "m/s", "a": "m/s^2", "omega": "rad/s", "epsilon": "rad/s^2"}


def velocity_figure(scene: Scene, couplers: Sequence[Coupler]) -> View:
    """Draw v = v^e + v^r at every point of the couplers, instant centres with their rays, and all rates of turning."""
    canvas = scene.canvas()
    figures = _mechanism(canvas, scene, [link.number for link in scene.mechanism.links])
    points = [At(scene, c, point, "V") for c in couplers for point in c.letters]
    shown = {at.point for at in points}  # a hinge may be a point of another coupler, which shows its velocity
    for hinge in dict.fromkeys(c.hinge for c in couplers if c.hinge not in shown):
        canvas.part(ANSWERS)
        edge = Edge(f"V_{hinge}", "velocity.p", f"velocity.{hinge}")
        _vector(canvas, scene, scene.vector(edge, at=scene.mm(hinge)))
    _at_points(canvas, scene, points)
    beyond = [note for c in couplers for note in _instant_centre(canvas, scene, c, figures)]
    for c in couplers:
        _turn(canvas, scene, c.omega_e, c.pivot)
        _turn(canvas, scene, f"omega_r_{c.number}", c.hinge)
    heading = scene.heading("heading.compound_velocity", POSITION, points[0].plan)
    return _finish(canvas, VELOCITIES, heading, points, beyond)


def acceleration_figure(scene: Scene, coupler: Coupler, point: str) -> View:
    """Draw the accelerations of one point of a coupler: the chain of its parts, closed by the absolute one."""
    canvas, at = scene.canvas(), At(scene, coupler, point, "a")
    group = next(g for g in scene.solved.structure.groups if coupler.number in g.links)
    # the link that carries the coupler, itself, the other of its group
    figures = _mechanism(canvas, scene, sorted({coupler.carrier.number, *group.links}))
    _at_points(canvas, scene, [at])
    _sliding_sense(canvas, scene, at, figures)
    for rate in (coupler.omega_e, coupler.epsilon_e):
        _turn(canvas, scene, rate, coupler.pivot)
    for kind in ("omega", "epsilon"):
        _turn(canvas, scene, f"{kind}_r_{coupler.number}", coupler.hinge)
    heading = scene.heading("heading.compound_acceleration", POSITION, at.plan, point=scene.words.mark(point))
    return _finish(canvas, f"{ACCELERATIONS}{at.letter}", heading, [at])


def _finish(
    canvas: Canvas, name: str, heading: tuple[str, ...], points: Sequence[At], notes: Sequence[str] = ()
) -> View:
    """Finish a figure with the insets of its points; it says which vectors are zero."""
    every = ((at.scene, vector) for at in points for vector in at.vectors())
    zero = [scene.letter(vector.quantity) for scene, vector in every if abs(vector.tip - vector.tail) < 1e-6]
    said = (points[0].scene.words["said.zero"].format(vector=letter) for letter in zero)
    shown = [(at, window) for at in points for window in windows(at)]
    return with_insets(canvas, name, heading, (*notes, *said), shown)


def _mechanism(canvas: Canvas, scene: Scene, numbers: Sequence[int]) -> list[Skeleton]:
    start = len(canvas.shapes)
    figures = draw_links(canvas, scene, numbers)
    draw_frame(canvas, scene, numbers, figures)
    canvas.shapes[start:] = [_thin(shape) for shape in canvas.shapes[start:]]
    joints, style = {point for number in numbers for point in pins_of(scene, number)}, scene.style
    blocks = [block.at for figure in figures for block in figure.blocks]
    for point in dict.fromkeys(p for number in numbers for p in scene.mechanism.link(number).points):
        at = scene.mm(point)
        canvas.part(point)
        if point not in joints:
            canvas.add(scene.point(at, point))
        in_block = point in joints and any(abs(block - at) < style.pair for block in blocks)
        clear = (style.slider[1] / 2 if in_block else style.pair) + 0.8
        canvas.label(scene.words.mark(point), at, clear=clear, priority=1)
    return figures


def _thin(shape: Shape) -> Shape:
    match shape:
        case Group(shapes=parts):
            return replace(shape, shapes=tuple(_thin(part) for part in parts))
        case Line(pen=Pen.MAIN):
            return replace(shape, pen=Pen.THIN)
    return shape


def _at_points(canvas: Canvas, scene: Scene, points: Sequence[At]) -> None:
    """Draw the arms, the construction lines and the vectors at points; what an inset shows has its letters there."""
    rim = scene.style.pair
    for at in points:
        start, end, name = scene.mm(at.coupler.pivot), scene.mm(at.point), f"l_{at.coupler.pivot}{at.point}"
        if abs(end - start) > 4 * rim:
            e = unit(end - start)
            canvas.part(name)
            canvas.add(Line(start + e * rim, end - e * rim, Pen.AXIS, role="measured", name=name))
    for at in points:
        shown = windows(at)
        canvas.part(mark(at.plan, at.letter))
        for i, (tail, found, end, said) in enumerate(at.lines()):
            canvas.add(Line(tail, end, Pen.DASHED, role="construction", name=f"{at.plan}_{i + 1}"))
            if not any(window.shows(found) for window in shown):
                canvas.label(said, (found, end), clear=0.8)
    for at in points:
        shown = windows(at)
        for vector in at.vectors():
            canvas.part(at.drawn_with(vector.quantity))
            seen = any(window.shows(vector.tail, vector.tip) for window in shown)
            _vector(canvas, scene, vector, lettered=not seen)


def _vector(canvas: Canvas, scene: Scene, vector: Vector, lettered: bool = True) -> None:
    length = abs(vector.tip - vector.tail)
    canvas.add(replace(vector, head="none") if length < scene.style.arrow else vector)
    if lettered and length > 1e-6:
        symbol = scene.words.symbol(vector.quantity, bar=True)
        canvas.label(symbol, (vector.tail, vector.tip), clear=0.9, strict=True)


def _sliding_sense(canvas: Canvas, scene: Scene, at: At, figures: Sequence[Skeleton]) -> None:
    """Show the sense of the relative velocity, which turned by 90 degrees gives that of Coriolis.

    The arrow leaves the point or ends at it, on the side where there is more room.
    """
    name, start, length = f"V_{at.letter}_r", scene.mm(at.point), 0.6 * scene.style.force
    e = scene.direction(name)
    if not e:
        return
    vectors = [(vector.tail, vector.tip) for vector in at.vectors()]
    side, _ = clear_ray(e, [*rays_at(start, figures), *rays_of(start, vectors)], [])
    near, far = start + side * scene.style.pair, start + side * (length + scene.style.pair)
    tail, tip = (near, far) if side == e else (far, near)
    canvas.part(ANSWERS)
    canvas.add(Arrow(tail, tip, Pen.THIN, name=name))
    canvas.label(scene.words.symbol(name, bar=True), ((near + far) / 2, far), clear=0.9)


def _instant_centre(canvas: Canvas, scene: Scene, c: Coupler, figures: Sequence[Skeleton]) -> Iterator[str]:
    """Mark the instant centre and the rays to it; say in words that it lies far away, or nowhere."""
    symbol, ends = scene.words.symbol(c.centre), [e for figure in figures for stroke in figure.strokes for e in stroke]
    size = max((abs(a - b) for a in ends for b in ends), default=0.0)
    if not scene.defined(c.centre):
        yield scene.words["said.no_centre"].format(link=_name(scene, c.number))
        return
    P = scene.mm(c.centre)
    if min((abs(P - end) for end in ends), default=0.0) > FAR * size:
        yield scene.words["said.far_centre"].format(centre=symbol)
        return
    canvas.part(c.centre)
    for joint in (c.hinge, c.span.end):
        way = P - scene.mm(joint)
        if abs(way) > 2 * scene.style.pair:  # it may stand in the joint itself
            rim = way / abs(way) * scene.style.pair
            canvas.add(Line(scene.mm(joint) + rim, P, Pen.AXIS, role="ray", name=f"{c.centre}_{joint}"))
    canvas.add(scene.point(P, c.centre))
    canvas.label(symbol, P, clear=1.2, priority=1)
    _turn(canvas, scene, f"omega_{c.number}", c.centre)


def _turn(canvas: Canvas, scene: Scene, rate: str, centre: str) -> None:
    value = scene.solved.values.get(rate)
    if not value or value != value:
        return
    c, style = scene.mm(centre), scene.style
    canvas.part(ANSWERS)
    radii = tuple(style.pair + size * style.force for size in SIZES)
    radius, middle = free_arc(c, radii, SPREAD, UP, list(obstacles(canvas.shapes)))
    canvas.add(turning_arrow(c, radius, middle, SPREAD, math.copysign(1.0, value), rate))
    canvas.label(scene.words.symbol(rate), c + rect(radius, middle), prefer=rect(1.0, middle), clear=1.2)


def compound_told(teller: Teller, view: str) -> Iterator[Told]:
    """Go through the steps of one figure: the mechanism once more, then the vectors of every point."""
    scene, points = teller.scene, teller.figures[view]
    marks = tuple(point for link in scene.mechanism.links for point in link.points)
    yield Told(scene.program.on(points[0].plan)[0], teller.say("compound_mechanism"), others=marks)
    for at in points:
        if at.kind == "V":
            name = f"l_{at.coupler.pivot}{at.point}"
            step, said = teller.reading.made[name], " ".join(measured(scene, name, POSITION))
            start, end = map(teller.mark, step.operands)
            yield Told(step, teller.say("compound_distance", start=start, end=end, sum=said))
        for step in scene.program.on(at.plan):
            if step.verb in POINT_STEPS:
                yield from POINT_STEPS[step.verb](teller, at, step)
        if at.kind == "V" and at.point == [*at.coupler.letters][-1] and scene.defined(at.coupler.centre):
            yield _centre_told(teller, at.coupler)


def _hung(teller: Teller, at: At, step: Step) -> Iterator[Told]:
    start, vector = step.operands
    letter = teller.scene.letter(vector)
    if teller.scene.vanishes(vector):
        yield Told(step, teller.say("compound_zero", vector=letter))
    else:
        parts = {"start": _start(teller, at, start), "line": teller.along(vector), "mm": teller.drawn(vector, at.plan)}
        yield Told(step, teller.say("compound_vector", vector=letter, **parts))


def _start(teller: Teller, at: At, mark: str) -> str:
    """Return in words where a vector or a line begins: in the point itself, or at the end of another vector."""
    if role(mark).kind == POLE:
        return teller.say("compound_point", point=teller.mark(at.point))
    before = teller.reading.made[mark]
    return teller.say("compound_end", vector=teller.scene.letter(before.operands[1]))


def _met(teller: Teller, at: At, step: Step) -> Iterator[Told]:
    p, u, q, w = step.operands
    (one, first), (other, second) = ((teller.line(line), _start(teller, at, mark)) for mark, line in ((p, u), (q, w)))
    whole = teller.scene.letter(f"{at.kind}_{at.point}")
    text = teller.say("compound_meet", one=one, first=first, other=other, second=second, whole=whole)
    yield Told(step, text)


def _measured(teller: Teller, at: At, step: Step) -> Iterator[Told]:
    """Tell what is measured: the part that was known by direction, then the whole."""
    found = {step.name: "compound_read"}
    if role(step.name).hidden:
        closing = at.coupler.closing if at.point == at.coupler.span.end and at.kind == "a" else None
        parts = [tangential(closing.normal)] if closing is not None and closing.normal is not None else []
        found = dict.fromkeys(parts, "compound_read") | {f"{at.kind}_{at.point}": "compound_whole"}
    for name, key in found.items():
        said = " ".join(measured(teller.scene, name, at.plan))
        text = teller.say(key, vector=teller.scene.letter(name), sum=said, point=teller.mark(at.point))
        yield Told(step, text, others=(name,))


POINT_STEPS = {"chain": _hung, "meet": _met, "read": _measured}


def _centre_told(teller: Teller, c: Coupler) -> Told:
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


def compound_lines(scene: Scene, c: Coupler, kind: str, only: str = "") -> list[Said]:
    """Return the equations of a coupler's velocities ("V") or accelerations ("a"), all or those of the point `only`.

    What is said of the whole coupler stands before the first of its points.
    """
    points = [point for point in c.letters if only in ("", point)]
    whole = _of_the_whole(scene, c, kind) if next(iter(c.letters)) in points else ()
    return [*whole, *(line for point in points for line in _lines_of_point(scene, c, point, kind))]


def _of_the_whole(scene: Scene, c: Coupler, kind: str) -> Iterator[Said]:
    """Go through what is known before any point: the split, and relative rates where no end is closed."""
    words = scene.words
    if kind == "V":
        links = {"link": _name(scene, c.number), "carrier": _name(scene, c.carrier.number)}
        said = words["said.split"].format(pivot=words.mark(c.pivot), hinge=words.mark(c.hinge), **links)
        yield tuple(said.split("|"))
    if c.closing is None:
        whole, carrier = ("omega", c.omega_e) if kind == "V" else ("epsilon", c.epsilon_e)
        yield _sum_of_rates(scene, f"{whole}_r_{c.number}", f"{whole}_{c.number}", carrier, -1.0)
        if kind == "V":
            yield from _centre(scene, c)


def _lines_of_point(scene: Scene, c: Coupler, point: str, kind: str) -> Iterator[Said]:
    """Go through the vectors of a point as they are hung; where its end is closed they give the relative rate."""
    letter, closing = c.letters[point], c.closing if point == c.span.end else None
    whole, carrier = ("omega", c.omega_e) if kind == "V" else ("epsilon", c.epsilon_e)
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


def _known_parts(scene: Scene, c: Coupler, point: str) -> Iterator[Said]:
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


def _normal(scene: Scene, c: Coupler, normal: Name) -> Said:
    group = next(group for group in scene.solved.structure.groups if c.number in group.links)
    link = scene.mechanism.link(next(number for number in group.links if number != c.number))
    pivot = next(point for point in link.points if point in scene.mechanism.frame_points)
    return _product(scene, normal, factor(scene, f"omega_{link.number}", 2), _length(scene, pivot, c.span.end))


def tangential(normal: Name) -> Name:
    """Return the name of the tangential part that goes with a normal one."""
    return vector_named(normal.kind, normal.of, normal.about, "t")


def _vectors(scene: Scene, c: Coupler, point: str, kind: str) -> Said:
    """Return the vector equation of a point, and along which lines its unknown vectors lie."""
    closing, letter = c.closing if point == c.span.end else None, c.letters[point]
    *parts, last = (scene.letter(vector_named(kind, letter, part=part)) for part in COMPOUND[kind])
    whole, notes = scene.letter(f"{kind}_{point}"), list[str]()
    if closing is not None:
        normal, unknown = closing.normal if kind == "a" else None, whole
        if normal is not None:  # then only the tangential part of the whole is known by direction
            unknown = scene.letter(tangential(normal))
        notes = [f"{last} {line_of(scene, c.span.n)}", f"{unknown} {line_of(scene, closing.direction)}"]
        whole = (f"{known(scene.letter(normal))} + " if normal is not None else "") + by_direction(unknown)
    first, *others = (*map(known, parts), known(last) if closing is None else by_direction(last))
    return noted((f"{whole} = {first}", *(f"+ {term}" for term in others)), *notes)


def _centre(scene: Scene, c: Coupler) -> Iterator[Said]:
    words = scene.words
    if not scene.defined(c.centre):
        yield tuple(words["said.no_centre"].format(link=_name(scene, c.number)).split("|"))
        return
    pivot, hinge = (words.symbol(f"l_{end}P{c.number}") for end in (c.pivot, c.hinge))
    law = f"{pivot}·{words.symbol(c.omega_e)} = {hinge}·{words.symbol(f'omega_r_{c.number}')}"
    rates = factor(scene, c.omega_e), factor(scene, f"omega_{c.number}", -1)
    yield f"{law},", *_product(scene, f"l_{c.hinge}P{c.number}", _length(scene, c.pivot, c.hinge), *rates)


def _product(scene: Scene, name: str, *factors: Factor) -> Said:
    """Return a quantity as a product of magnitudes; of a rate the sense, too."""
    kind = role(name).kind
    line = worked(scene.words, scene.words.symbol(name), [Product(factors)], UNITS.get(kind, "m"))
    return noted(line, sensed(scene.words, scene.solved.values[name]) if kind in ("omega", "epsilon") else "")


def _sum_of_rates(scene: Scene, name: str, first: str, second: str, sign: float) -> Said:
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


def measured(scene: Scene, name: str, plan: str) -> Said:
    """Return what was measured: the segment and the scale factor."""
    words, item = scene.words, scene.solved.quantities[name]
    segment, number, value = printed_segment(scene, item, plan)
    head = f"{words.symbol(name)} = {segment}{'/' if words.per_unit else '·'}{number} ="
    return head, f"{value} {words.unit(words.display.unit(item.unit))}"


def _length(scene: Scene, start: str, end: str, power: int = 1) -> Factor:
    words, name = scene.words, f"l_{start}{end}"
    size = words.display.value(abs(scene.solved.point(end) - scene.solved.point(start)), "m")
    exact = name in scene.givens
    return Factor(words.symbol(name), float(f"{size:.12g}") if exact else size, exact, power)


def _name(scene: Scene, number: int) -> str:
    return scene.words.ends.get(str(number), str(number))
