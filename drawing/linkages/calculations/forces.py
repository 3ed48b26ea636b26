"""Equations of forces: loads and inertia, moments, force plans from the last group to the driver, its balance."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import chain

from ....plans.board import Step
from ....plans.linkages.mechanism import ZERO, Driver, Revolute
from ....plans.linkages.solved import SolvedLinkage
from ....plans.linkages.structure import Group
from ....plans.names import FORCES, role
from ....scales.display import AS_INSIDE
from ...printed import POINT, Symbol, value_text
from ..reading import Edge
from ..scene import Scene
from . import equations as eq

WHOLE, LOADS = "", "loads"


def force_parts(solved: SolvedLinkage) -> tuple[str, ...]:
    """Return into which blocks the equations are cut: one where there is one group, else loads, groups, driver."""
    groups = [group.name for group in reversed(solved.structure.groups)]
    return (WHOLE,) if len(groups) < 2 else (LOADS, *groups, str(solved.structure.driver))


def equations_heading(scene: Scene, part: str) -> str:
    """Return the heading of the equations of a part."""
    words, links = scene.words, {group.name: sorted(group.links) for group in scene.solved.structure.groups}
    if part in (WHOLE, LOADS):
        return words["heading.equations_loads" if part else "heading.equations_forces"]
    key = "heading.equations_links" if part in links else "heading.equations_link"
    return words[key].format(links=", ".join(map(str, links.get(part, ()))), link=part)


def force_lines(scene: Scene, part: str = WHOLE) -> eq.Lines:
    """Return the lines of the part in order of construction."""
    scene = replace(scene, words=scene.words.showing(AS_INSIDE))  # N and kg go with metres
    loads = (_load(scene, step) for step in scene.program if step.law in LOADING and part in (WHOLE, LOADS))
    forces = (lines for own, _, lines in _forces(scene) if part in (WHOLE, own))
    return [*chain.from_iterable(loads), *chain.from_iterable(forces)]


def _forces(scene: Scene) -> Iterator[tuple[str, Step, eq.Lines]]:
    """Go through the steps of the force plans that have equations, each with its part and these."""
    told = ((step, _force(scene, step)) for step in scene.program if step.law not in LOADING)
    return ((_part(scene, step), step, lines) for step, lines in told if lines)


def lines_by_plan(scene: Scene, apart: Collection[int] = ()) -> dict[str, eq.Lines]:
    """Return the equations that stand before each force plan, by plan: moments first, then the sums that it shows.

    What is found of a link after its plans stands with the figure of that link where it is `apart`, or else with the
    last plan of its group.
    """
    scene = replace(scene, words=scene.words.showing(AS_INSIDE))
    last, found, held = dict[str, str](), dict[str, eq.Lines](), dict[str, list[tuple[Step, eq.Lines]]]()
    for part, step, lines in _forces(scene):
        if step.verb == "pole":
            last[part] = plan = role(step.name).plan
            found[plan] = [*(line for _, told in held.pop(part, []) for line in told), *lines]
        else:
            held.setdefault(part, []).append((step, lines))
    for part, after in held.items():
        for step, lines in after:
            number = _link_of(scene, step.operands[1] if step.verb == "arm" else step.name)
            found.setdefault(f"link_{number}" if number in apart else last[part], []).extend(lines)
    return found


def _part(scene: Scene, step: Step) -> str:
    """Return the name of the group to which a step of the force plans belongs, or the number of the driver."""
    plan = drawn.of if (drawn := role(step.name).plan).kind == FORCES else ""
    known = [group.name for group in scene.solved.structure.groups]
    acting = step.operands[1] if step.verb == "arm" else step.name
    group = _group_of(scene, int(plan) if plan and plan not in known else _link_of(scene, acting))
    return plan if plan in known else str(scene.solved.structure.driver) if group is None else group.name


UNITS = {"mass_by_length": "kg", "inertia_by_length": "kg*m^2", "inertia_moment": "N*m"}
UNITS |= {"weight": "N", "inertia_force": "N"}
RESISTING = ("resisting_force", "resisting_along", "resisting_moment")
LOADING = (*UNITS, *RESISTING, "along", "signed", "sum")


def _load(scene: Scene, step: Step) -> eq.Lines:
    """Tell a mass, a load, a weight, a force or moment of inertia, or a sum of couples."""
    if role(step.name).hidden or not scene.defined(step.name):
        return []
    words, mechanism = scene.words, scene.mechanism
    if step.law in UNITS:
        return [eq.size_by_law(scene, words.symbol(step.name), step, UNITS[step.law])]
    if step.law == "sum":
        products = _terms(scene, step.operands)
        return [_solved_for(scene, step.name, products, 1.0) if products else (f"{words.symbol(step.name)} = 0",)]
    loads = {load.name: load.magnitude for load in mechanism.loads} | {c.name: c.magnitude for c in mechanism.couples}
    made = scene.made.get(step.operands[0])
    if step.name not in loads or (made is None and step.law not in RESISTING):
        return []
    notes = [words["said.diagram"]] if loads[step.name] in {d.name for d in mechanism.diagrams} else []
    size, unit = eq.size_of(scene, step.name), scene.quantities[step.name].unit
    if step.law in RESISTING and size > 0.0:
        against = words.symbol(step.operands[1], bar=step.law != "resisting_moment")
        notes.append(words["said.against"].format(motion=against))
    elif size == 0.0:
        notes.append(words["said.idle"])
    return [eq.noted((eq.stated(words, words.symbol(step.name), size, unit),), *notes)]


def _solved_for(scene: Scene, moment: str, products: Iterable[eq.Product], sign: float) -> tuple[str, ...]:
    """Return a moment as the sum of others, with numbers and its sense; `sign` is that of the sum in it."""
    words, value = scene.words, scene.values[moment]
    turn = math.copysign(sign, sign * value)
    return eq.noted(eq.worked(words, words.symbol(moment), eq.turned(products, turn), "N*m"), eq.sensed(words, value))


def _force(scene: Scene, step: Step) -> eq.Lines:
    """Tell a step of the force plans: a sum of moments, or the sums of forces of a plan."""
    if step.verb == "pole" and role(step.name).plan.kind == FORCES:
        return list(_closed(scene, role(step.name).plan))
    if step.law in SIGNS and role(step.operands[0]).kind != "V":  # of the lever
        return _for_a_force(scene, step)
    if step.law == "closing_moment":
        return _for_a_moment(scene, step, step)
    if step.law == "opposite" and _is_sum(step.operands[0]):
        return _for_a_moment(scene, step, scene.made[step.operands[0]])
    if step.verb == "arm" and role(step.operands[0]).kind == "M" and not role(step.operands[0]).hidden:
        return _arm(scene, step)
    return []


SIGNS = {"moment_equation": -1.0, "closing_force": 1.0}  # of the force's own moment in the sum


def _is_sum(moment: str) -> bool:
    return role(moment).kind == "M" and role(moment).hidden


def _head(scene: Scene, links: str, point: str) -> str:
    return f"ΣM_{{{scene.words.mark(point)}}}({links}) = 0:"


def _for_a_force(scene: Scene, step: Step) -> eq.Lines:
    """Tell the moments about a joint, solved for a force: drawn as it acts, its moment turns against the others."""
    words, reading = scene.words, scene.reading
    length, *moments = step.operands
    name, found = reading.visible(step.name), _terms(scene, moments)
    laid = next((s for s in reading.users(step.name) if s.verb in ("lay", "back")), None)
    point = _about(scene, step)
    if laid is not None and not any(map(_is_sum, moments)):
        point = eq.ends_of(reading, reading.made[laid.operands[1]].operands[0])[laid.verb == "lay"]
    head = _head(scene, _links_in(scene, _link_of(scene, step.name), point), point)
    arm = _reach(scene, name, length)
    own = Symbol.of(words.symbol(name)) * arm.in_letters
    if not found:
        return [(head, f"{own} = 0,", f"{words.symbol(name)} = 0")]
    values = scene.values
    sign, turn = math.copysign(SIGNS[step.law], SIGNS[step.law] * values[length]), math.copysign(1.0, values[step.name])
    return [
        (head, *eq.moments_in_letters(own * (sign * turn), found), "= 0"),
        eq.worked(words, words.symbol(name), eq.turned(found, -sign * turn), "N", arm),
    ]


def _reach(scene: Scene, name: str, length: str) -> eq.Product:
    """Return the arm of the force to be found: a length, or what was measured from the point to the force's line."""
    made = scene.made.get(length)
    if made is None or made.verb == "measure":
        return eq.Product((eq.factor(scene, length),))
    return eq.Product(_on_arm(scene, next(s.name for s in scene.program.which(("arm",)) if s.operands[1] == name)))


def _for_a_moment(scene: Scene, step: Step, sum_of: Step) -> eq.Lines:
    """Tell the moments about a joint, solved for a moment: of a guide's reaction, or the balancing one."""
    words = scene.words
    found, point = _terms(scene, sum_of.operands), _about(scene, sum_of)
    head = _head(scene, str(_link_of(scene, step.name)), point)
    if not found:
        arm = next((s for s in scene.reading.users(step.name) if s.verb == "arm"), None)
        zeros = [f"{words.symbol(arm.operands[1])}·{words.symbol(arm.name)}", words.symbol(arm.name)] if arm else []
        return [(head, *(f"{zero} = 0," for zero in zeros[:-1]), f"{[words.symbol(step.name), *zeros][-1]} = 0")]
    return [(head, *_solved_for(scene, step.name, found, -1.0))]


def _arm(scene: Scene, step: Step) -> eq.Lines:
    words, (moment, reaction) = scene.words, step.operands
    if scene.values[moment] == 0.0:
        return []  # told with the moment
    if not scene.defined(step.name):
        return [(f"{words.symbol(reaction)} = 0:", words["said.couple"].format(moment=words.symbol(moment)))]
    product = eq.Product((eq.factor(scene, moment), eq.factor(scene, reaction, -1)))
    return [eq.worked(words, words.symbol(step.name), [product], "m")]


def _terms(scene: Scene, names: Iterable[str]) -> list[eq.Product]:
    """Return the moments that are not zero, each with its sign, counter-clockwise positive."""
    found = []
    for name in names:
        value = 0.0 if name == ZERO else scene.values[name]
        factors = _factors(scene, name) if value != 0.0 else ()
        # a force whose line passes through the point has no moment but rounding
        if factors and min(factor.value for factor in factors if not factor.exact) >= POINT:
            found.append(eq.Product(factors, math.copysign(1.0, value)))
    return found


def _factors(scene: Scene, name: str) -> tuple[eq.Factor, ...]:
    """Return what makes a moment: a force and its arm, a couple's power, or a couple that is known."""
    step = scene.made.get(name)
    if step is not None and step.verb == "moment":
        arm = next(user.name for user in scene.reading.users(name) if user.verb == "arm")
        return eq.factor(scene, step.operands[0]), *_on_arm(scene, arm)
    if step is not None and step.law == "couple_on_lever":
        scale = eq.paper(scene.words, scene.scales["lever"])
        over = eq.Factor(scale.symbol, scale.value, scale.exact, -scale.power)
        return eq.factor(scene, step.operands[0]), eq.factor(scene, step.operands[1]), over
    return (eq.factor(scene, name),)


def _on_arm(scene: Scene, arm: str) -> tuple[eq.Factor, ...]:
    """Return an arm in mm, and the scale factor unless the plan's own cancels, as on the lever."""
    plan = scene.figure_of(arm)
    own = eq.segment(scene, scene.words.symbol(arm), plan, eq.size_of(scene, arm))
    return (own,) if plan == "lever" else (own, eq.paper(scene.words, scene.scales[plan]))


def _about(scene: Scene, step: Step) -> str:
    """Return the point about which the moments of a calculation are taken."""
    made = (scene.made.get(name) for name in step.operands)
    point = next((moment.operands[2] for moment in made if moment is not None and moment.verb == "moment"), "")
    if point:
        return point
    # about which a link without loads would turn: its pin in the group, or the group's only one
    number = _link_of(scene, step.name)
    group, driver = _group_of(scene, number), scene.mechanism.driver
    if group is None:
        return driver.pivot if isinstance(driver, Driver) else driver.point
    pins = [pair for pair in (*group.inner, *group.outer) if isinstance(pair, Revolute)]
    return next((pair.point for pair in pins if number in pair.links), pins[0].point)


def _group_of(scene: Scene, number: int) -> Group | None:
    """Return the group of a link; None for the driver."""
    return next((group for group in scene.solved.structure.groups if number in group.links), None)


def _link_of(scene: Scene, name: str) -> int:
    """Return the link on which a reaction or the moment of one acts: 2 of `R_12_t`, 3 of `_M_3`; else the driver."""
    numbers = role(name).links if role(name).kind in ("R", "M") else ()
    moving = {link.number for link in scene.mechanism.links}
    return numbers[-1] if moving.intersection(numbers[-1:]) else scene.solved.structure.driver


def _links_in(scene: Scene, number: int, point: str) -> str:
    """Return the links whose moments a sum about a point has: the link's own, or those of the whole group.

    About a point that is not the link's the inner reactions of the group would have moments, too.
    """
    group = _group_of(scene, number)
    if group is None or point in scene.mechanism.link(number).points or len(group.links) < 2:
        return str(number)
    return ", ".join(map(str, sorted(group.links)))


def _closed(scene: Scene, plan: str) -> Iterable[tuple[str, ...]]:
    """Go through the sums of forces of a plan: the one that closes it, then those that its chords show."""
    reading = scene.reading
    edges = reading.on(plan)
    meet = next((step for step in scene.program.on(plan) if step.verb == "meet"), None)
    if meet is None:
        last = edges[-1]
        around = _path([e for e in edges if e is not last], last.tip, last.tail)
        yield _zero(scene, around, (), last.name)
        return
    p, u, q, w = meet.operands
    firm = [e for e in edges if reading.is_hung(e)]
    lines = ((reading.between(p, meet.name), u), (reading.between(meet.name, q), w))
    found = [edge for edge, _ in lines if edge is not None]
    notes = [eq.line_note(scene, edge.name, along) for edge, along in lines if edge is not None]
    by_moments = next((e for e in edges if {e.tail, e.tip} & {p, q} and role(e.name).part == "m"), None)
    if by_moments is not None:
        whole, along = role(by_moments.name).whole, next(line for edge, line in lines if edge is None)
        yield _two_ways(scene, whole, found[0].name, notes[0], along)
        edges = tuple(sorted((e for e in edges if e is not by_moments), key=lambda e: e.name != whole))
        yield from _chords(scene, edges, [*firm, *found], ())
        return
    yield eq.noted(_zero(scene, _path(firm, q, p), [edge.name for edge in found], ""), *notes)
    yield from _chords(scene, edges, [*firm, *found], edges)


def _chords(
    scene: Scene, edges: Sequence[Edge], ready: list[Edge], others: Sequence[Edge]
) -> Iterable[tuple[str, ...]]:
    """Go through the sums of forces that the chords of a plan show, by what is ready before each, or by all others."""
    for chord in (e for e in edges if e not in ready):
        parts = _path(ready, chord.tail, chord.tip)
        if parts and all(role(part).whole == chord.name != part for part in parts):  # of one reaction
            yield eq.summed(scene, chord.name, parts)
        else:
            around = _path([e for e in others or ready if e is not chord], chord.tip, chord.tail)
            yield _zero(scene, around, (), chord.name)
        if not others:
            ready = [*ready, chord]


def _two_ways(scene: Scene, whole: str, normal: str, note: str, along: str) -> tuple[str, ...]:
    """Return the equation of a reaction by its parts along and across its link, and along and across another line."""
    ways = ((f"{whole}_t", normal), (f"{whole}_m", f"{whole}_p"))
    first, second = (f"= {scene.letter(x, 2)} + {scene.letter(y, 1)}" for x, y in ways)
    return eq.noted((f"{scene.letter(whole)} {first}", second), note, eq.line_note(scene, f"{whole}_p", along))


def _path(edges: Iterable[Edge], start: str, end: str) -> list[str]:
    """Return the shortest way of vectors, tip to tail, from one mark to another."""
    ways, every = {start: list[str]()}, list(edges)
    for mark in (queue := [start]):
        for edge in (edge for edge in every if edge.tail == mark and edge.tip not in ways):
            ways[edge.tip] = [*ways[mark], edge.name]
            queue.append(edge.tip)
    return ways.get(end, [])


def _zero(scene: Scene, knowns: Sequence[str], lines: Sequence[str], unknown: str) -> tuple[str, ...]:
    """Return a sum of forces that is zero: known in full, known by direction, to be found."""
    texts = [scene.letter(name, 2) for name in knowns] + [scene.letter(name, 1) for name in lines]
    texts += [scene.letter(unknown)] if unknown else []
    return (texts[0], *(f"+ {text}" for text in texts[1:]), "= 0")


def lever_lines(scene: Scene, with_loads: bool = False) -> eq.Lines:
    """Return the moments on Zhukovsky's lever and what balances the driver by it; where that is wanted, loads first."""
    lines = force_lines(scene, LOADS) if with_loads else []
    scene = replace(scene, words=scene.words.showing(AS_INSIDE))  # N and kg go with metres
    for step in scene.program:
        if step.law in TOLD and (step.law != "moment_equation" or role(step.operands[0]).kind == "V"):
            lines += TOLD[step.law](scene, step)
    return lines


def _couple(scene: Scene, step: Step) -> eq.Lines:
    pair = [s.name for s in scene.program if role(s.name).whole == step.name != s.name]
    symbols = " = ".join(dict.fromkeys(map(scene.words.symbol, pair)))
    return [eq.size_by_law(scene, symbols, step, "N")] if scene.defined(step.name) else []


def _sum(scene: Scene, step: Step) -> eq.Lines:
    """Sum of moments about the pole, each force times its arm in mm, solved for the balancing force."""
    words = scene.words
    speed, *moments = step.operands
    found = _terms(scene, moments)
    laid = next(s for s in scene.reading.users(speed) if s.verb in ("lay", "back"))
    reach = eq.segment(scene, words.mark(laid.operands[0]) + words.mark(laid.name), "lever", eq.size_of(scene, speed))
    # the balancing force along the line of its point's velocity has the moment -F * V, with the signs of both
    turn = math.copysign(1.0, scene.values[step.name] * scene.values[speed])
    symbol = words.symbol(step.name)
    own = Symbol.of(symbol) * reach.letter * -turn
    lines: eq.Lines = [(f"ΣM_{{{words.mark('lever.p')}}} = 0:", *eq.moments_in_letters(own, found), "= 0")]
    if found:
        lines.append(eq.worked(words, symbol, eq.turned(found, turn), "N", eq.Product((reach,))))
    return lines


def _difference(scene: Scene, step: Step) -> eq.Lines:
    words, values = scene.words, scene.values
    lever, plan = (abs(values[name]) for name in step.operands)
    if lever == 0.0:
        return []
    (a, b), (first, second) = (value_text(words, size) for size in (lever, plan)), map(words.symbol, step.operands)
    head = f"{words.symbol(step.name)} = ({first} − {second})/{first}·100 % ="
    return [(head, f"({a} − {b})/{a}·100 % =", f"{words.number(values[step.name], 2)} %")]


TOLD: dict[str, Callable[[Scene, Step], eq.Lines]] = {
    "couple": _couple,
    "moment_equation": _sum,
    "crank_moment": lambda scene, step: [eq.size_by_law(scene, scene.words.symbol(step.name), step, "N*m")],
    "difference": _difference,
}
