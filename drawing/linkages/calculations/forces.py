"""Equations of forces: loads and inertia, moments, force plans from the last group to the driver, its balance."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import chain
from typing import NamedTuple

from ....plans.board import Step
from ....plans.linkages.mechanism import ZERO, Driver, Revolute
from ....plans.linkages.solved import SolvedLinkage
from ....plans.linkages.structure import Group
from ....plans.names import COUPLE, FORCES, by_lever, role
from ....plans.quantities import F_BAL, M_BAL
from ....scales.scale import AS_INSIDE
from ...printed import AS_PRINTED, DIGITS, POINT, READABLE, Symbol, decimals_for, number_of
from ...words import Words
from ..reading import Edge, ends_of
from ..scene import Scene
from . import equations
from .equations import (
    Factor,
    Lines,
    Product,
    factor,
    fit_for,
    line_note,
    noted,
    number,
    reckoned,
    segment,
    size_by_law,
    size_of,
    stated,
    worked,
)

ARMS = 8  # moments on a lever; where there are more, the arm of a couple is the line between its forces
POLE = "lever.p"
BALANCE = ("_F_bal_lever", "_F_bal")  # the balancing force of the lever, where a force balances and where a moment
WHOLE, LOADS = "", "loads"
BALANCING = (M_BAL, F_BAL, by_lever(M_BAL), by_lever(F_BAL))
FAINT = 0.02  # part of the largest moment on the lever alone; what balances less is told beside it, not in parts


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


def force_lines(scene: Scene, part: str = WHOLE) -> Lines:
    """Return the lines of the part in order of construction."""
    scene = replace(scene, words=scene.words.showing(AS_INSIDE))  # N and kg go with metres
    loads = (_load(scene, step) for step in scene.program if step.law in LOADING and part in (WHOLE, LOADS))
    forces = (lines for own, _, lines in _forces(scene) if part in (WHOLE, own))
    return [*chain.from_iterable(loads), *chain.from_iterable(forces)]


def _forces(scene: Scene) -> Iterator[tuple[str, Step, Lines]]:
    """Go through the steps of the force plans that have equations, each with its part and these."""
    told = ((step, _force(scene, step)) for step in scene.program if step.law not in LOADING)
    return ((_part(scene, step), step, lines) for step, lines in told if lines)


def lines_by_plan(scene: Scene, apart: Collection[int] = ()) -> dict[str, Lines]:
    """Return the equations that stand before each force plan, by plan: moments first, then the sums that it shows.

    What is found of a link after its plans stands with the figure of that link where it is `apart`, or else with the
    last plan of its group.
    """
    scene = replace(scene, words=scene.words.showing(AS_INSIDE))
    last, found, held = dict[str, str](), dict[str, Lines](), dict[str, list[tuple[Step, Lines]]]()
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


def _load(scene: Scene, step: Step) -> Lines:
    """Tell a mass, a load, a weight, a force or moment of inertia, or a sum of couples."""
    if role(step.name).hidden or not scene.defined(step.name):
        return []
    words, mechanism = scene.words, scene.mechanism
    if step.law in UNITS:
        return [size_by_law(scene, words.symbol(step.name), step, UNITS[step.law])]
    if step.law == "sum":
        products = _terms(scene, step.operands)
        return [_solved_for(scene, step.name, products, 1.0) if products else (f"{words.symbol(step.name)} = 0",)]
    loads = {load.name: load.magnitude for load in mechanism.loads} | {c.name: c.magnitude for c in mechanism.couples}
    made = scene.made.get(step.operands[0])
    if step.name not in loads or (made is None and step.law not in RESISTING):
        return []
    notes = [words["said.diagram"]] if loads[step.name] in {d.name for d in mechanism.diagrams} else []
    size, unit = size_of(scene, step.name), scene.quantities[step.name].unit
    if step.law in RESISTING and size > 0.0:
        against = words.symbol(step.operands[1], bar=step.law != "resisting_moment")
        notes.append(words["said.against"].format(motion=against))
    elif size == 0.0:
        notes.append(words["said.idle"])
    return [noted((stated(words, words.symbol(step.name), size, unit),), *notes)]


def _decimals(name: str) -> int | None:
    """Return what decimals a result has: of what balances the driver what printed numbers give, to be compared."""
    return AS_PRINTED if name in BALANCING else None


def _solved_for(scene: Scene, moment: str, products: Iterable[Product], sign: float) -> tuple[str, ...]:
    """Return a moment as the sum of others, with numbers and its sense; `sign` is that of the sum in it."""
    words, value, turn = scene.words, scene.values[moment], math.copysign(sign, sign * scene.values[moment])
    line = worked(words, words.symbol(moment), products, "N*m", turn=turn, wanted=_decimals(moment))
    return noted(line, equations.sensed(words, value))


def _force(scene: Scene, step: Step) -> Lines:
    """Tell a step of the force plans: a sum of moments, or the sums of forces of a plan."""
    return scene.once(partial(_told, step=step), "force", step.name)


def _told(scene: Scene, step: Step) -> Lines:
    words, first = scene.words, step.operands[0] if step.operands else ""
    if step.verb == "pole" and role(step.name).plan.kind == FORCES:
        return list(_closed(scene, role(step.name).plan))
    if step.law in SIGNS and role(first).kind != "V":  # of the lever
        return _for_a_force(scene, step)
    if step.law == "closing_moment":
        return [_for_a_moment(scene, step, step)]
    if step.law == "opposite" and _is_sum(first):
        return [_for_a_moment(scene, step, scene.made[first])]
    # what is zero has been told with the moment
    if step.verb == "arm" and role(first).kind == "M" and not role(first).hidden and scene.values[first] != 0.0:
        reaction = step.operands[1]
        if not scene.defined(step.name):
            return [(f"{words.symbol(reaction)} = 0:", words["said.couple"].format(moment=words.symbol(first)))]
        quotient = Product((factor(scene, first), factor(scene, reaction, -1)))
        return [worked(words, words.symbol(step.name), [quotient], "m")]
    return []


def _told_of(scene: Scene, step: Step) -> Lines:
    """Tell a load, a step of the force plans or of the lever."""
    scene = replace(scene, words=scene.words.showing(AS_INSIDE))
    return _load(scene, step) if step.law in LOADING else _on_lever(scene, step) or _force(scene, step)


equations.FURTHER.append(_told_of)
SIGNS = {"moment_equation": -1.0, "closing_force": 1.0}  # of the force's own moment in the sum


def _is_sum(moment: str) -> bool:
    return role(moment).kind == "M" and role(moment).hidden


def _for_a_force(scene: Scene, step: Step) -> Lines:
    """Tell the moments about a joint, solved for a force: drawn as it acts, its moment turns against the others."""
    words, reading, values = scene.words, scene.reading, scene.values
    length, *moments = step.operands
    name, point, made = reading.visible(step.name), _about(scene, step), scene.made
    known = _terms(scene, moments)
    laid = next((s for s in reading.users(step.name) if s.verb in ("lay", "back")), None)
    if laid is not None and not any(map(_is_sum, moments)):
        point = ends_of(reading, made[laid.operands[1]].operands[0])[laid.verb == "lay"]
    if length not in made or made[length].verb == "measure":
        arm = Product((factor(scene, length),))
    else:  # measured from the point to the line of the force
        arm = Product(_on_arm(scene, next(s.name for s in scene.program.which(("arm",)) if s.operands[1] == name)))
    # about a point that is not the link's the inner reactions of the group would have moments, too
    number = _link_of(scene, step.name)
    group, links = _group_of(scene, number), [number]
    if group is not None and point not in scene.mechanism.link(number).points:
        links = sorted(group.links)
    head = f"ΣM_{{{words.mark(point)}}}({', '.join(map(str, links))}) = 0:"
    if not known:
        own = Symbol.of(words.symbol(name)) * arm.in_letters
        return [(head, f"{own} = 0,", f"{words.symbol(name)} = 0")]
    sign = math.copysign(SIGNS[step.law], SIGNS[step.law] * values[length]) * math.copysign(1.0, values[step.name])
    return _moments(scene, head, name, arm, known, sign)


def _moments(scene: Scene, head: str, force: str, arm: Product, known: Sequence[Product], sign: float) -> Lines:
    """Return the sum of the moment of a force, with its sign, and of others, and that solved for the force."""
    words = scene.words
    own = Symbol.of(words.symbol(force)) * arm.in_letters
    line = (head, *sum((product.in_letters for product in known), own * sign).chunks, "= 0")
    if not known:
        return [line]
    found = worked(
        words, words.symbol(force), known, "N", arm, turn=-sign, wanted=_decimals(force), fits=fit_for(scene, force)
    )
    return [line, found]


def _for_a_moment(scene: Scene, step: Step, sum_of: Step) -> tuple[str, ...]:
    """Tell the moments about a joint, solved for a moment: of a guide's reaction, or the balancing one."""
    symbol, known = scene.words.symbol, _terms(scene, sum_of.operands)
    head = f"ΣM_{{{scene.words.mark(_about(scene, sum_of))}}}({_link_of(scene, step.name)}) = 0:"
    if known:
        return (head, *_solved_for(scene, step.name, known, -1.0))
    arm = next((s for s in scene.reading.users(step.name) if s.verb == "arm"), None)
    zeros = (f"{symbol(arm.operands[1])}·{symbol(arm.name)} = 0,", symbol(arm.name)) if arm else (symbol(step.name),)
    return (head, *zeros[:-1], f"{zeros[-1]} = 0")


def _terms(scene: Scene, names: Iterable[str]) -> list[Product]:
    """Return the moments that are not zero, each with its sign, counter-clockwise positive."""
    found = []
    for name, value in _acting(scene, names):
        factors = _factors(scene, name) if value != 0.0 else ()
        # a force whose line passes through the point has no moment but rounding
        if factors and min(factor.value for factor in factors if not factor.exact) >= POINT:
            found.append(Product(factors, math.copysign(1.0, value)))
    return found


def _acting(scene: Scene, names: Iterable[str]) -> Iterator[tuple[str, float]]:
    """Go through moments with their values; a couple with one arm is told by its first moment."""
    couples = couples_on_lever(scene)
    others = {moment for couple in couples.values() for moment in couple.moments[1:]}
    for name in (name for name in names if name not in others):
        moments = couples[name].moments if name in couples else (name,)
        yield name, 0.0 if name == ZERO else sum(scene.values[moment] for moment in moments)


def _factors(scene: Scene, name: str) -> tuple[Factor, ...]:
    """Return what makes a moment: a force and its arm, a couple's power, or a couple that is known."""
    step, couple = scene.made.get(name), couples_on_lever(scene).get(name)
    if couple is not None:
        between = segment(scene, "".join(couple.letters(scene)), "lever", couple.arm(scene))
        return factor(scene, couple.forces[0]), between
    if step is not None and step.verb == "moment":
        arm = next(user.name for user in scene.reading.users(name) if user.verb == "arm")
        return factor(scene, step.operands[0]), *_on_arm(scene, arm)
    if step is not None and step.law == "couple_on_lever":
        scale = equations.paper(scene.words, scene.scales["lever"])
        over = Factor(scale.symbol, scale.value, scale.exact, -scale.power)
        return factor(scene, step.operands[0]), factor(scene, step.operands[1]), over
    return (factor(scene, name),)


def _on_arm(scene: Scene, arm: str) -> tuple[Factor, ...]:
    """Return an arm in mm, and the scale factor unless the plan's own cancels, as on the lever."""
    plan = scene.figure_of(arm)
    own = segment(scene, scene.words.symbol(arm), plan, size_of(scene, arm), arm)
    return (own,) if plan == "lever" else (own, equations.paper(scene.words, scene.scales[plan]))


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
    return numbers[-1] if {*scene.numbers} & {*numbers[-1:]} else scene.solved.structure.driver


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
    notes = [line_note(scene, edge.name, along) for edge, along in lines if edge is not None]
    by_moments = next((e for e in edges if {e.tail, e.tip} & {p, q} and role(e.name).part == "m"), None)
    if by_moments is not None:
        whole, along = role(by_moments.name).whole, next(line for edge, line in lines if edge is None)
        # by its parts along and across its link, and along and across another line
        ways = ((f"{whole}_t", found[0].name), (f"{whole}_m", f"{whole}_p"))
        first, second = (f"= {scene.letter(one, 2)} + {scene.letter(other, 1)}" for one, other in ways)
        yield noted((f"{scene.letter(whole)} {first}", second), notes[0], line_note(scene, f"{whole}_p", along))
        edges = tuple(sorted((e for e in edges if e is not by_moments), key=lambda e: e.name != whole))
        yield from _chords(scene, edges, [*firm, *found], ())
        return
    yield noted(_zero(scene, _path(firm, q, p), [edge.name for edge in found], ""), *notes)
    yield from _chords(scene, edges, [*firm, *found], edges)


def found_by(scene: Scene, step: Step) -> tuple[str, ...]:
    """Return the vector equation that a step solves in which two lines of a plan meet; nothing if none is printed."""
    if step.plan in equations.PLANS:
        return equations.meeting(scene, step)
    return next(iter(_closed(scene, step.plan)), ()) if role(step.plan).kind == FORCES else ()


def _chords(
    scene: Scene, edges: Sequence[Edge], ready: list[Edge], others: Sequence[Edge]
) -> Iterable[tuple[str, ...]]:
    """Go through the sums of forces that the chords of a plan show, by what is ready before each, or by all others."""
    for chord in (e for e in edges if e not in ready):
        parts = _path(ready, chord.tail, chord.tip)
        if parts and all(role(part).whole == chord.name != part for part in parts):  # of one reaction
            yield equations.summed(scene, chord.name, parts)
        else:
            around = _path([e for e in others or ready if e is not chord], chord.tip, chord.tail)
            yield _zero(scene, around, (), chord.name)
        if not others:
            ready = [*ready, chord]


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


def lever_lines(scene: Scene, with_loads: bool = False) -> Lines:
    """Return the moments on Zhukovsky's lever and what balances the driver by it; where that is wanted, loads first."""
    lines = force_lines(scene, LOADS) if with_loads else []
    scene = replace(scene, words=scene.words.showing(AS_INSIDE))  # N and kg go with metres
    return [*lines, *(line for step in scene.program for line in _on_lever(scene, step))]


def _on_lever(scene: Scene, step: Step) -> Lines:
    """Tell a couple on the lever, the moments on it, what balances the driver by it, by how much that differs."""
    symbol = scene.words.symbol
    if step.law == "couple" and scene.defined(step.name):
        pair = [s.name for s in scene.program if role(s.name).whole == step.name != s.name]
        return [size_by_law(scene, " = ".join(dict.fromkeys(map(symbol, pair))), step, "N")]
    if step.law == "moment_equation" and role(step.operands[0]).kind == "V":
        # each force times its arm in mm, solved for the balancing force: that has along the line of its point's
        # velocity the moment -F * V, with the signs of both
        sign = -math.copysign(1.0, scene.values[step.name] * scene.values[step.operands[0]])
        head, terms = f"ΣM_{{{scene.words.mark('lever.p')}}} = 0:", _terms(scene, step.operands[1:])
        return _moments(scene, head, step.name, Product((_own_arm(scene, step),)), terms, sign)
    if step.law == "crank_moment":
        product = Product(tuple(factor(scene, name) for name in step.operands))
        return [worked(scene.words, symbol(step.name), [product], "N*m", wanted=AS_PRINTED)]
    return _difference(scene, step) if step.law == "difference" else []


def _own_arm(scene: Scene, step: Step) -> Factor:
    """Return the arm of the balancing force on the lever, the velocity of its point turned."""
    laid = next(s for s in scene.reading.users(step.operands[0]) if s.verb in ("lay", "back"))
    letters = scene.words.mark(laid.operands[0]) + scene.words.mark(laid.name)
    return segment(scene, letters, "lever", size_of(scene, step.operands[0]))


def _difference(scene: Scene, step: Step) -> Lines:
    """Tell by how much both ways differ as printed."""
    (a, b), (first, second) = (map(of, step.operands) for of in (partial(number, scene), scene.words.symbol))
    if number_of(a) == number_of(b) == 0.0:
        return []
    (difference, relative), head = differ(scene), f"{scene.words.symbol(step.name)} = "
    if relative:
        return [(f"{head}({first} − {second})/{first}·100 % =", f"({a} − {b})/{a}·100 % =", difference)]
    return [(f"{head}{first} − {second} =", f"{a} − {b} =", difference)]


def differ(scene: Scene) -> tuple[str, bool]:
    """Return by how much both ways differ as printed, with its unit, and whether that is in parts of the first.

    It is not where what balances is small beside what a load would take alone, at its arm or at the least that can be
    read, as near a dead position.
    """
    words, names = scene.words, next(step.operands for step in scene.program if step.law == "difference")
    lever = next(step for step in scene.program if step.law == "moment_equation" and step.name in BALANCING)
    arm = Product((_own_arm(scene, lever),))
    acting = [_factors(scene, acting) for acting, _ in _acting(scene, lever.operands[1:]) if acting != ZERO]
    shortest = [Product((force, replace(own[0], value=READABLE))) for force, *own in acting if len(own) == 1]
    largest = max((reckoned([term], arm) for term in (*_terms(scene, lever.operands[1:]), *shortest)), default=0.0)
    a, b = (number_of(number(scene, name)) for name in names)
    if number_of(number(scene, lever.name)) > FAINT * largest:
        return f"{words.number((a - b) / a * 100.0, 2)} %", True
    places = max(decimals_for(size, DIGITS + 1) for size in (a, b))
    return f"{words.number(a - b, places)} {words.unit(scene.quantities[names[1]].unit)}", False


class _OnLever(NamedTuple):
    """A row of the lever's table: what acts, its arm, its moment from the printed numbers, counter-clockwise positive.

    A couple of which only the power is known has no arm; `name` is the quantity by which it is looked up.
    """

    name: str
    symbol: str
    size: str
    arm: Factor | None
    moment: float


def on_lever(scene: Scene) -> Iterator[_OnLever]:
    """Go through what acts on the lever, with what balances it."""
    scene = replace(scene, words=scene.words.showing(replace(AS_INSIDE, paper=scene.words.display.paper)))
    words = scene.words
    balanced = next(step for step in scene.program if step.law == "moment_equation" and step.name in BALANCING)
    for name, value in _acting(scene, balanced.operands[1:]):
        factors, turn = _factors(scene, name), math.copysign(1.0, value)
        arms = [user.name for user in scene.reading.users(name) if user.verb == "arm"]
        moment = math.prod(factor.printed**factor.power for factor in factors)
        if moment != moment or min(factor.value for factor in factors) < POINT:
            moment = 0.0
        yield _OnLever(arms[0] if arms else balanced.name, *_named(words, factors), turn * moment)
    force, arm = factor(scene, balanced.name), _own_arm(scene, balanced)
    sign = -math.copysign(1.0, scene.values[balanced.name] * scene.values[balanced.operands[0]])
    yield _OnLever(balanced.name, force.symbol, force.text(words), arm, sign * force.printed * arm.printed)


def _named(words: Words, factors: Sequence[Factor]) -> tuple[str, str, Factor | None]:
    """Return the symbol and the size of a force, and its arm where it has one."""
    force, *rest = factors
    return force.symbol, force.text(words), rest[0] if len(rest) == 1 else None


class Couple(NamedTuple):
    """A couple on a lever of many forces: these, their moments about the pole, the marks between which its arm is."""

    forces: tuple[str, ...]
    moments: tuple[str, ...]
    marks: tuple[str, str]

    def letters(self, scene: Scene) -> list[str]:
        """Return the letters of the ends of its arm, the pole first."""
        pole = letter_of(scene, POLE)
        return sorted((letter_of(scene, mark) for mark in self.marks), key=lambda letter: (letter != pole, letter))

    def arm(self, scene: Scene) -> float:
        """Return how long its arm is on the plan of velocities, in the unit of that."""
        start, end = (f"velocity.{'p' if mark == POLE else role(mark).of}" for mark in self.marks)
        return scene.span(start, end, "lever")


def couples_on_lever(scene: Scene) -> dict[str, Couple]:
    """Return the couples that have one arm, by the first of their moments; all others follow it."""
    return scene.once(_couples_on_lever, "couples_on_lever")


def _couples_on_lever(scene: Scene) -> dict[str, Couple]:
    steps = [*moments_on_lever(scene)]
    if len(steps) <= ARMS:
        return {}
    marks, couples = dict(hung_on_lever(scene)), dict[str, Couple]()
    halves = [name for name in marks if role(name).part == COUPLE]
    for force in halves:
        both = tuple(name for name in halves if role(name).whole == role(force).whole)
        moments = tuple(step.name for step in steps if step.operands[0] in both)
        couples[moments[0]] = Couple(both, moments, (marks[both[0]], marks[both[-1]]))
    return couples


def hung_on_lever(scene: Scene) -> list[tuple[str, str]]:
    """Return (force, mark) of all that hangs on the lever, the balancing force last."""
    hung = {step.operands[0]: step.operands[1] for step in moments_on_lever(scene)}
    # of a couple on a link that turns about a pivot the second force stands at the pole: it has no moment
    for step in scene.program:
        if role(step.name).part == COUPLE and step.law in ("along", "opposite"):
            hung.setdefault(step.name, POLE)
    balance = next(name for name in BALANCE if name in scene.values)
    return [*hung.items(), (balance, f"lever.{scene.mechanism.driver.point}")]


def moments_on_lever(scene: Scene) -> Iterator[Step]:
    """Go through the moments that are taken about the pole of the lever."""
    return (step for step in scene.program.which(("moment",)) if step.operands[2] == POLE)


def letter_of(scene: Scene, mark: str) -> str:
    """Return the letter of a mark of the lever: that of the velocity plan."""
    return scene.words.mark("velocity.p" if mark == POLE else f"velocity.{role(mark).of}")
