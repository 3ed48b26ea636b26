"""The plans of a linkage told step by step, in words, from the recorded program: for the explanatory note.

Compound motion is told first: at every point of a coupler its parts are hung on one another. Then follow all other
plans, with what they have shown.

Source: Bertyaev and others, Mechanics: course works with Mathcad, section 4, for compound motion.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence

from ...plans.board import POSITION, Step
from ...plans.boards.exact import SMALL
from ...plans.laws import dot
from ...plans.linkages.compound import ACCELERATION, COMPOUND, VELOCITY, Coupler
from ...plans.linkages.mechanism import MOMENT, ZERO, Driver
from ...plans.linkages.solved import disagreement
from ...plans.names import FORCES, POLE, Name, between, rate, role, spelled, vector
from ...plans.quantities import point_of, unit_of
from ..figure import GIVEN
from ..handouts import Shown
from ..notes.blocks import Block, Equations, Heading, Story
from ..printed import Input, calculation, number_of
from .asking import meanings
from .calculations.equations import (
    Factor,
    Product,
    factor,
    kinematics_lines,
    noted,
    number,
    operand,
    printed_segment,
    rate_of,
    sensed,
    size_by_law,
    size_of,
    worked,
)
from .calculations.forces import LOADS, differ, force_lines, force_parts, lines_by_plan
from .figures.compound import At, figures_of
from .figures.plan import ENLARGED
from .ladders import links_apart
from .scene import Scene, is_at_point, line_of, plan_heading
from .telling import Teller, Told, lever_told, tell

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
    same = number(scene, name) if name in scene.quantities else ""
    return worked(scene.words, scene.words.symbol(name), [Product(factors)], unit_of(name), same=same)


def _sum_of_rates(scene: Scene, name: str, first: str, second: str, sign: float) -> Line:
    """Return a rate as the algebraic sum of two others; one that is zero by the form of the mechanism is left out."""
    words, values = scene.words, scene.values
    terms = [(other, turn) for other, turn in ((first, 1.0), (second, sign)) if other != ZERO]
    signs = ["" if i == 0 and turn > 0 else "+ " if turn > 0 else "− " for i, (_, turn) in enumerate(terms)]
    formula = " ".join(f"{sign}{words.symbol(other)}" for sign, (other, _) in zip(signs, terms, strict=True))
    signed = [("−" * (float(values[other]) * turn < 0.0) + number(scene, other)) for other, turn in terms]
    inputs = [Input(number_of(text), fixed=True, told=text) for text in signed]
    texts, result = calculation(words, lambda *x: sum(x), inputs, same=number(scene, name))
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


SET = ("pole", "place")  # verbs that set a drawing up
PLANS = {"velocity": ("V", "omega"), "acceleration": ("a", "epsilon")}  # kinds of vectors and of rates
BALANCES = ("M_bal", "F_bal")
SAME = 1e-9  # part by which values may differ that are the same by construction
SMALL_ANGLE = 20  # degrees, as `SMALL`


def story(scene: Scene, texts: Mapping[str, str]) -> Story:
    """Return what the note of a linkage says, in sentences by key: equations and steps of plans, what numbers mean."""
    teller, lengths = Teller.of(scene, texts), set[str]()
    steps = {view: [told.text for told in told_of(teller, view)] for view in drawn_views(teller)}
    plans = [plan for plan in PLANS if plan in scene.scales]
    equations = {plan: kinematics_lines(scene, plan, lengths) for plan in plans}
    views = {"equations_kinematics", *(f"equations_{plan}" for plan in plans)}
    for view, points in figures_of(scene).items():
        equations[view] = [line for at in points for line in compound_lines(scene, at.coupler, at.kind, at.point)]
        views |= {block_name(at.coupler, at.kind) for at in points}
    before: dict[str, tuple[Block, ...]] = {}
    if any(role(plan).kind == FORCES for plan in steps):
        groups = scene.solved.structure.groups
        apart = {number for group in groups for number in links_apart(scene.solved, group)}
        equations |= lines_by_plan(scene, apart)
        views |= {"equations_forces", *(f"equations_forces_{part}" for part in force_parts(scene.solved))}
        loads = Heading(scene.words["heading.equations_loads"]), Equations(tuple(map(tuple, force_lines(scene, LOADS))))
        before[f"group_{groups[-1].name}"] = loads
    ends = tuple(_conclusions(teller))
    return Story(steps, equations, frozenset(views), ends, before, meanings=meanings(scene))


def drawn_views(teller: Teller) -> list[str]:
    """Return the views whose drawing is told step by step, in order: the plans, the figures of compound motion."""
    plans = [plan for plan in teller.program.plans if plan in teller.scales and not is_at_point(plan)]
    forces = next((at for at, plan in enumerate(plans) if role(plan).kind == FORCES), len(plans))
    return [*plans[:forces], *figures_of(teller), *plans[forces:]]


def told_of(teller: Teller, view: str) -> Iterator[Told]:
    """Return the steps of a view, each with its sentence."""
    if points := figures_of(teller).get(view):
        return compound_told(teller, points)
    return lever_told(teller) if view == "lever" else _plan(teller, view)


def _plan(teller: Teller, plan: str) -> Iterator[Told]:
    centres = {at.coupler.centre for points in figures_of(teller).values() for at in points}
    for step in teller.program.on(plan):
        hidden = role(step.name).hidden and step.verb not in ("place", "read")
        arm = plan == POSITION and step.verb == "read"  # that a calculation takes
        text = "" if hidden or arm or step.name in centres else tell(teller, step)
        if text:
            yield Told(step, text, before=step.verb in SET)


def begun(scene: Scene, steps: int, plans: Collection[str]) -> dict[str, Shown]:
    """Return for every view what its first steps draw, as the note numbers them; poles and pivots are there before.

    None is drawn before the views of the `plans` have found what it takes: an acceleration before its velocities.
    """
    teller = Teller.of(scene)
    every = {view: list(told_of(teller, view)) for view in drawn_views(teller)}
    parts = {
        view: FORCES if role(view).kind == FORCES else view if view in scene.scales else "compound" for view in every
    }
    done = dict.fromkeys(every, steps) | {view: len(every[view]) for view in every if parts[view] not in plans}
    before: dict[str, int] = {}
    while done != before:
        drawn = {view: drawn_by(teller, view, every[view], done[view]) for view in every}
        found = _found(teller, drawn)
        before, done = done, {}
        for view, told in every.items():
            left_out = (n for n, one in enumerate(told[: before[view]]) if one.step.name not in found)
            done[view] = next(left_out, before[view])
    seen = {view: [name for name, is_drawn in drawn[view].items() if is_drawn] for view in every}
    known = found.union(*seen.values()) - ({*teller.made} - found)
    return {view: _shown(known.intersection(seen[view]), len(every[view]) <= done[view]) for view in every}


def drawn_by(teller: Teller, view: str, every: Sequence[Told], steps: int) -> dict[str, bool]:
    """Return for the steps of a view by name whether they are among the first ones."""
    drawn, before = dict[str, bool](), ""
    for count, told in enumerate(every, 1):
        drawn |= dict.fromkeys((told.step.name, *told.others), told.before or count <= steps)
    for step in teller.program.on(view):  # what nothing is said of is drawn with what stands before it
        before = step.name if step.name in drawn else before
        drawn.setdefault(step.name, drawn.get(before, True))  # before all of them: it is given
    return drawn


def _found(teller: Teller, drawn: Mapping[str, Mapping[str, bool]]) -> set[str]:
    """Return what is known when so much is drawn: what is drawn, or calculated, from what is known."""
    known = dict[str, bool]()
    for marks in drawn.values():
        known |= {name: is_drawn and known.get(name, True) for name, is_drawn in marks.items()}
    found = set[str]()
    for step in teller.program:
        if known.get(step.name, True) and all(name in found or name not in teller.made for name in step.operands):
            found.add(step.name)
    return found


def _shown(drawn: set[str], whole: bool) -> Shown:
    # what is zero, or too short, is told when all is drawn, and drawn larger
    return Shown(frozenset(drawn | ({GIVEN, ENLARGED} if whole else {GIVEN})), notes=whole)


def _conclusions(teller: Teller) -> Iterator[str]:
    """Go through the sentences for the end of the note: what the plans that are drawn have shown."""
    for plan, (kind, turning) in PLANS.items():
        if plan in teller.scales:
            names = [name for name in teller.quantities if _of_point(name, kind)]
            yield from _extremes(teller, f"conclusion.{plan}", names)
            rates = [f"{turning}_{number}" for number in teller.numbers if number != teller.solved.structure.driver]
            values = {name: rate_of(teller, name) for name in rates if name in teller.quantities}
            fastest = max(values, key=lambda name: abs(values[name]), default="")
            if values.get(fastest):
                value, sense = _alike(teller, values, fastest), sensed(teller.words, values[fastest])
                yield teller.texts[f"conclusion.{turning}"].format(value=value, sense=sense)
    gap = disagreement(teller.solved)
    if gap is not None:  # by which the theorems of compound motion give what the plans give
        yield teller.texts["conclusion.compound"].format(part=teller.words.number(100.0 * gap, 2))
    if any(role(plan).kind == FORCES for plan in teller.scales):
        quantities = teller.quantities
        yield from _extremes(teller, "conclusion.reactions", [n for n in quantities if _pair(n)])
        for name in BALANCES:
            yield from _balance(teller, name)
    for name in BALANCES:
        yield from _compared(teller, name)
    yield from _angles(teller)


def _of_point(name: str, kind: str) -> bool:
    """Whether a quantity is the velocity or the acceleration of a point itself, such as `V_A3`; no part of one."""
    quantity = role(name)
    return quantity.kind == kind and not (quantity.hidden or quantity.about or quantity.part)


def _extremes(teller: Teller, key: str, names: Sequence[str]) -> Iterator[str]:
    """Tell the largest and the smallest of some vectors; of forces on one another only one."""
    pairs = filter(None, map(_pair, names))
    twice = {teller.mechanism.pair("R", pair[1], pair[0]) for pair in pairs}  # both are as large
    sizes = {n: size_of(teller, n) for n in names if not (n in twice and _pair(n)[0] > _pair(n)[1])}
    printed = {name: number_of(number(teller, name)) for name in sizes if sizes[name] > 0.0}
    moving = sorted(printed, key=lambda name: (printed[name], sizes[name]))
    if moving:
        low, high = (_alike(teller, sizes, name) for name in (moving[0], moving[-1]))
        one = math.isclose(sizes[moving[0]], sizes[moving[-1]], rel_tol=SAME)
        yield teller.texts[f"{key}_one" if one else key].format(value=low, high=high, low=low)


def _pair(name: str) -> tuple[int, ...]:
    """Return the links of a whole reaction, that which acts first; nothing where a quantity is none."""
    quantity = role(name)
    return quantity.links if quantity.kind == "R" and not quantity.part else ()


def _alike(teller: Teller, found: Mapping[str, float], name: str) -> str:
    """Return the symbols of all quantities that are as large as one, and printed so, with its value."""
    item, value = teller.quantities[name], number(teller, name)
    alike = [other for other in found if math.isclose(abs(found[other]), abs(found[name]), rel_tol=SAME)]
    symbol = " = ".join(dict.fromkeys(teller.words.symbol(other) for other in alike if number(teller, other) == value))
    return f"{symbol} = {value} {teller.words.unit(teller.words.display.unit(item.unit))}"


def _balance(teller: Teller, name: str) -> Iterator[str]:
    words = teller.words
    item, driver = teller.quantities.get(name), teller.mechanism.driver
    by_moment = isinstance(driver, Driver) and driver.balance == MOMENT
    if item is None or not item.value or by_moment != (name == "M_bal"):
        return
    speed = f"omega_{driver.link}" if by_moment else f"V_{driver.point}"
    force = item.value if by_moment else teller.values["_F_bal"]
    power = dot(complex(force), complex(teller.values[speed]))
    yield teller.texts[f"conclusion.{name}_{'drives' if power > 0.0 else 'brakes'}"].format(
        value=f"{words.symbol(name)} = {number(teller, name)} {words.unit(words.display.unit(item.unit))}",
        sense=sensed(words, item.value),
        symbol=words.symbol(name),
        speed=words.symbol(speed, bar=not by_moment),
    )


def _compared(teller: Teller, name: str) -> Iterator[str]:
    words, quantities, by_lever = teller.words, teller.quantities, f"{name}_lever"
    if name not in quantities or by_lever not in quantities:
        return
    found = {"value": number(teller, name), "lever": number(teller, by_lever)}
    if not any(map(number_of, found.values())):
        return
    said = {"symbol": words.symbol(name), "other": words.symbol(by_lever)}
    said |= {key: f"{text} {words.unit(quantities[name].unit)}" for key, text in found.items()}
    yield teller.texts["note.balance"].format(part=differ(teller)[0], **said)


def _angles(teller: Teller) -> Iterator[str]:
    """Tell where lines meet at less than 20 degrees, or at which angle the flattest ones do."""
    words = teller.words
    plans = {plan for plan in teller.scales if not is_at_point(plan)}  # compound motion meets the same lines
    drawn = {mark: sine for mark, sine in teller.solved.sines.items() if role(mark).plan in plans}
    flat = sorted((mark for mark in drawn if 0.0 < drawn[mark] < SMALL), key=lambda mark: drawn[mark])
    if flat:
        listed = "; ".join(_met(teller, mark, drawn[mark]) for mark in flat)
        loss = words.short(float(f"{1.0 / drawn[flat[0]]:.2g}"))
        yield teller.texts["conclusion.flat"].format(points=listed, loss=loss, limit=SMALL_ANGLE)
    elif drawn:
        mark = min(drawn, key=lambda mark: drawn[mark])
        yield teller.texts["conclusion.sharp"].format(point=_met(teller, mark, drawn[mark]), limit=SMALL_ANGLE)


def _met(teller: Teller, mark: str, sine: float) -> str:
    words, solved = teller.words, teller.solved
    heading = plan_heading(words, solved.structure, role(mark).plan)
    angle = words.short(math.degrees(math.asin(min(sine, 1.0))), 3)
    return f"{words.mark(point_of(solved.program, mark))} ({heading[:1].lower()}{heading[1:]}, {angle}°)"
