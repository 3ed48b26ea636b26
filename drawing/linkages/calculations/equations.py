"""Equations: underlines of known vectors, sums of products that recompute as they are printed; those of kinematics."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import accumulate, pairwise
from typing import Any

from ....plans.board import POSITION, Step
from ....plans.laws import form_of
from ....plans.linkages.compound import found_here
from ....plans.linkages.mechanism import ZERO, positive
from ....plans.linkages.parts import SYMBOLS
from ....plans.names import CORIOLIS, FORCES, NORMAL, POLE, role, vector
from ....plans.quantities import Quantity, unit_of
from ....scales.scale import Scale
from ...printed import (
    AS_PRINTED,
    AS_TOLD,
    POINT,
    READABLE,
    Fits,
    Input,
    Symbol,
    as_printed,
    calculation,
    laid_off,
    read_off,
    ruler_decimals,
    segment_text,
    shortest,
    value_text,
)
from ...words import Words
from ..figures.plan import enlarged
from ..reading import Reading
from ..scene import Scene, line_of

Lines = list[tuple[str, ...]]
DIRECTIONS = ("direction", "turn", "normal", "incline", "decline")  # verbs that make them
PLANS = ("velocity", "acceleration")
TOLD = ["circular_speed", "centripetal", "circular_acceleration", "normal_part", "turning", "coriolis"]
TRANSPORT = ("transport_speed", "transport_normal", "transport_tangential")  # of a rate and a distance
TOLD += TRANSPORT
STAGES = {"V": "velocity", "omega": "velocity", "a": "acceleration", "epsilon": "acceleration"}
BEFORE_MEETING = ("normal_part", "coriolis")
RATES = ("omega", "epsilon")
RECKONED = ("calc", "moment")  # verbs of numbers that others give
FURTHER = list[Callable[["Scene", Step], "Lines"]]()  # what tells a step of forces, whose module adds it


@dataclass(frozen=True, slots=True)
class Factor:
    """A factor of a product: its symbol, its size as it is printed, whether that is exact, its power 1, 2 or -1.

    A number that the sheet tells elsewhere is as `told`.
    """

    symbol: str
    value: float
    exact: bool = False
    power: int = 1
    told: str = ""

    @property
    def letter(self) -> Symbol:
        """Its symbol in a formula: the exponent of a square stands over the letter, before its index."""
        base, underscore, index = self.symbol.partition("_")
        return Symbol.of(self.symbol, *((f"({self.symbol})",) if "^" in self.symbol else (base, underscore + index)))

    @property
    def input(self) -> Input:
        """What goes into a calculation."""
        return Input(self.value, self.exact, fixed=True, told=self.told)

    @property
    def printed(self) -> float:
        """Its number as it is printed."""
        return self.input.printed(AS_TOLD)

    def text(self, words: Words) -> str:
        """Return its number as it is printed."""
        return self.input.text(words, AS_TOLD)


@dataclass(frozen=True, slots=True)
class Product:
    """A term of a sum: a sign and factors."""

    factors: tuple[Factor, ...]
    sign: float = 1.0

    @property
    def in_letters(self) -> Any:
        """The product as a formula."""
        return self.of([factor.letter for factor in self.factors])

    def of(self, values: Sequence[Any]) -> Any:
        """Return the signed product of other values of its factors, or of symbols."""
        sizes = [value if f.power == 1 else value**f.power for value, f in zip(values, self.factors, strict=True)]
        return math.copysign(1.0, self.sign) * math.prod(sizes)


def worked(
    words: Words,
    head: str,
    products: Iterable[Product],
    unit: str,
    divisor: Product | None = None,
    *,
    turn: float = 1.0,
    wanted: int | None = None,
    fits: Fits | None = None,
    same: str = "",
) -> tuple[str, ...]:
    """Return `head = formula = numbers = result unit` of a sum of products, all of them turned, perhaps divided.

    The result may be `AS_PRINTED`, or have as many digits as a segment `fits`, or as are those of the `same` number.
    """
    turned = (replace(product, sign=product.sign * turn) for product in products)
    return _by_law(words, head, _quotient, (divisor or Product(()), *turned), unit, wanted, fits, same)


def _quotient(divisor: Any, *terms: Any) -> Any:
    return sum(terms) / divisor


def reckoned(products: Sequence[Product], divisor: Product | None = None) -> float:
    """Return how large a sum of products, perhaps divided, is as its printed numbers give it."""
    operands = (divisor or Product(()), *products)
    return abs(as_printed(_of_factors(_quotient, operands), _inputs(operands)))


def _inputs(operands: Sequence[Product]) -> list[Input]:
    return [factor.input for product in operands for factor in product.factors]


def _of_factors(law: Callable[..., Any], operands: Sequence[Product]) -> Callable[..., Any]:
    """Return a law of products as one of all their factors."""

    ends = [0, *accumulate(len(operand.factors) for operand in operands)]

    def found(*x: Any) -> Any:
        return law(*[own.of(x[begin:end]) for own, (begin, end) in zip(operands, pairwise(ends), strict=True)])

    return found


def _by_law(
    words: Words,
    head: str,
    law: Callable[..., Any],
    operands: Sequence[Product],
    unit: str,
    wanted: int | None = None,
    fits: Fits | None = None,
    same: str = "",
) -> tuple[str, ...]:
    """Return `head = formula = numbers = result unit` of a law of operands each of which is a product."""
    factors = [factor for operand in operands for factor in operand.factors]
    found, inputs = _of_factors(law, operands), _inputs(operands)
    if unit == words.display.paper:
        wanted = ruler_decimals(words, found(*(factor.value for factor in factors)))
    texts, result = calculation(words, found, inputs, wanted, fits, same)
    formula, reckoned = found(*(factor.letter for factor in factors)).chunks, found(*map(Symbol.of, texts)).chunks
    formula[0] = f"{head} = {formula[0]}"
    formula[-1] += " ="
    reckoned[-1] += f" = {result} {words.unit(words.display.unit(unit))}".rstrip()  # no line breaks before the result
    return (*formula, *reckoned)


def operand(scene: Scene, name: str) -> Product:
    """Return an operand of a law: a value, an arm that was read off the plan of the mechanism, or a direction."""
    made = scene.made.get(name)
    if made is not None and made.verb in DIRECTIONS:
        return Product(())
    if made is not None and made.verb == "read" and made.plan == POSITION:
        return _distance(scene, made)
    return Product((factor(scene, name),))


def size_by_law(
    scene: Scene, head: str, step: Step, unit: str, operand: Callable[[Scene, str], Product] = operand
) -> tuple[str, ...]:
    """Return `head = formula = numbers = result unit` of the size that the law of a step of each `operand` gives."""

    def size(*x: Any) -> Any:
        value = form_of(step.law)(*x)
        return value.size if isinstance(value, Symbol) else abs(value)

    operands, fits = [operand(scene, name) for name in step.operands], fit_for(scene, step.name)
    wanted = AS_PRINTED if fits is None and is_fine(scene, step.name) else None
    return _by_law(scene.words, head, size, operands, unit, wanted, fits)


def _distance(scene: Scene, made: Step) -> Product:
    """Return a distance read on the plan of the mechanism as its millimetres and the scale factor."""
    words, size = scene.words, abs(scene.values[made.name])
    own = segment(scene, "".join(map(words.mark, made.operands)), POSITION, size, made.name)
    return Product((own, paper(words, scene.scales[POSITION])))


def size_of(scene: Scene, name: str) -> float:
    """Return the magnitude of a quantity or of a value of the construction; what its plan shows as a point is zero."""
    item, plan = scene.quantities.get(name), scene.figure_of(name)
    size = abs(scene.solved.size(name)) if item is None else abs(item.value or 0.0)
    return 0.0 if plan in scene.scales and size < POINT * scene.scales[plan].mu else size


def rate_of(scene: Scene, name: str) -> float:
    """Return an angular velocity or acceleration, zero where the vector that it is read from is a point of its plan."""
    step = scene.made.get(name)
    if step is not None and step.law == "same_turning":
        return rate_of(scene, step.operands[0])
    still = step is not None and step.law == "turning" and size_of(scene, step.operands[0]) == 0.0
    return 0.0 if still else float(scene.values[name])


def factor(scene: Scene, name: str, power: int = 1) -> Factor:
    """Return a value of the construction as a factor in the units shown, without its sign; a given is exact."""
    name = positive(name)
    words, plain = scene.words, role(name).shown
    value = words.display.value(size_of(scene, name), unit_of(plain))
    exact = is_given(scene, name)
    return Factor(words.symbol(plain), value, exact, power, "" if exact else number(scene, name))


def number(scene: Scene, name: str) -> str:
    """Return the size of a quantity as it is printed wherever it stands: as its plan shows it, or its equation."""
    item = scene.quantities.get(role(name).shown)
    if item is not None and (drawn_on(scene, item) in scene.scales or opposed(scene, item.name) is not None):
        return printed_segment(scene, item)[-1]
    size = size_of(scene, name) if item is None else abs(value_shown(scene, item))
    return result_of(scene, name) or value_text(scene.words, size)


def result_of(scene: Scene, name: str) -> str:
    """Return the size of a quantity as the equation prints it that it is calculated by; nothing where there is none."""
    names = (name, role(name).size, role(name).whole)
    steps = (scene.made[own] for own in names if own in scene.made)
    results = (scene.once(partial(_result, step=step), "result", step.name) for step in steps)
    return next(filter(None, results), "")


def _result(scene: Scene, step: Step) -> str:
    if step.law in TOLD:
        lines = [size_by_law(scene, "", step, unit_of(step.name))]
    elif step.law in ("signed", "same_turning") and role(step.name).kind in RATES:
        lines = turning_alike(scene, step)
    else:
        lines = [line for tell in FURTHER for line in tell(scene, step)]
    return _last_number(next(reversed(lines), ()))


def _last_number(line: Sequence[str]) -> str:
    """Return what an equation gives, without its sign; nothing where there is none."""
    found = re.search(r" = −?(\d+(?:[.,]\d+)?)[^=]*$", " ".join(line))
    return found[1] if found is not None else ""


def segment(scene: Scene, symbol: str, plan: str, size: float, name: str = "") -> Factor:
    """Return what a plan shows as a factor in the paper's unit, without its scale factor; as its `name` is read."""
    measured = scene.words.display.segment(size / scene.scales[plan].mu)
    told = segment_text(scene.words, measured, bool(name) and is_fine(scene, name))
    return Factor(symbol, measured, told=told)


def value_shown(scene: Scene, q: Quantity) -> float:
    """Return a result in the unit in which it is shown."""
    turning = role(q.name).kind in RATES
    return rate_of(scene, q.name) if turning else scene.words.display.value(q.value or 0.0, q.unit)


def drawn_on(scene: Scene, q: Quantity) -> str:
    """Return the plan or figure on which a result is a segment, or nothing."""
    return POSITION if role(q.name).kind == "l" else scene.figure_of(q.name)


def printed_segment(scene: Scene, q: Quantity, plan: str = "") -> tuple[str, str, str]:
    """Return how a segment on a plan is printed, with its scale factor and its value.

    If no plan is said it is its own; a force that is too short there may be read in a detail of another one. What can
    be read nowhere, or is on no plan, is no text. A reaction has the number of the one that it opposes.
    """
    return scene.once(partial(_printed_segment, q=q, plan=plan), "segment", q.name, plan)


def _printed_segment(scene: Scene, q: Quantity, plan: str) -> tuple[str, str, str]:
    if plan not in ("", drawn_on(scene, q)) and not scene.words.ruler:
        return _segment_on(scene, q, plan, printed_segment(scene, q)[-1])
    if not scene.words.ruler and opposed(scene, q.name) is None and not result_of(scene, q.name):
        first = _there(scene, q.name)[0]
        if first != q.name and (found := printed_segment(scene, scene.quantities[first], plan))[0]:
            return found
    return _segment_on(scene, q, plan or _shown_on(scene, q))


def _there(scene: Scene, name: str) -> list[str]:
    """Return the vectors of its plan that are drawn between the ends of one, in their order; itself, if on no plan."""
    plan, point, found = scene.figure_of(name), scene.solved.point, list[str]()
    edges = [edge for edge in scene.reading.on(plan) if edge.name in scene.quantities] if plan in scene.scales else []
    own = next((edge for edge in edges if edge.name == name), None)
    if own is None or size_of(scene, name) == 0.0:
        return [name]
    near, ends = POINT * scene.scales[plan].mu, (point(own.tail), point(own.tip))
    for edge in edges:
        other = point(edge.tail), point(edge.tip)
        if any(max(abs(a - b) for a, b in zip(ends, way, strict=True)) < near for way in (other, other[::-1])):
            found.append(edge.name)
    return found


def _shown_on(scene: Scene, q: Quantity) -> str:
    """Return the plan on which a vector is read: its own, for a short force one that has it in a detail."""
    own = drawn_on(scene, q)
    long = own in scene.scales and abs(q.value or 0.0) >= scene.style.arrow * scene.scales[own].mu
    if role(own).kind != FORCES or long or (own in scene.scales and enlarged(scene, q.name, own) > 1.0):
        return own
    others = (other for other in scene.scales if role(other).kind == FORCES and enlarged(scene, q.name, other) > 1.0)
    return next(others, own)


def _segment_on(scene: Scene, q: Quantity, plan: str, told: str = "") -> tuple[str, str, str]:
    words, value, acting = scene.words, value_shown(scene, q), opposed(scene, q.name)
    known = told or ("" if acting is None else printed_segment(scene, acting)[-1])
    if not known and not words.ruler:  # it is laid off by its number, since it is given or has been calculated
        known = words.short(abs(value)) if is_given(scene, q.name) else result_of(scene, q.name)
    if plan not in scene.scales:
        return "", "", known
    number, mu = _factor_on(scene, q, plan)
    if known:
        return laid_off(words, value, mu, known), number, known
    if words.ruler and _is_laid(scene, q.name):  # it is as long as a ruler can lay it off
        return segment_text(words, abs(value) / mu), number, result_of(scene, q.name) or value_text(words, abs(value))
    # of an arm nothing is known but its segment
    readable = 0.0 if role(q.name).kind == "h" else READABLE
    mm, product = read_off(words, value, mu, readable, fine=is_fine(scene, q.name))
    return mm, number, product


def is_fine(scene: Scene, name: str) -> bool:
    """Whether a number has a digit more than usual: without it what is laid off by it would have no segment."""
    rough = scene.words.ruler or scene.rough
    return not rough and scene.once(partial(_is_fine, name=name), "fine", name)


def _is_fine(scene: Scene, name: str) -> bool:
    rough = replace(scene, rough=True)
    return any(_misses(rough, q) for own in _there(scene, name) for q in _laid_by(scene, own, set()))


def _misses(scene: Scene, q: Quantity) -> bool:
    """Whether a vector that is drawn long enough to be read has no segment that shows its number."""
    plan = _shown_on(scene, q)
    long = plan in scene.scales and abs(value_shown(scene, q)) >= READABLE * _factor_on(scene, q, plan)[1]
    return long and not printed_segment(scene, q)[0]


def _laid_by(scene: Scene, name: str, seen: set[str]) -> Iterator[Quantity]:
    """Go through the vectors that are laid off by what is reckoned with a number, or with an arm."""
    made = scene.made.get(name)
    for step in scene.reading.users(made.operands[0] if made is not None and made.verb == "arm" else name):
        if step.name in seen or step.verb not in RECKONED:
            continue
        seen.add(step.name)
        drawn = scene.quantities.get(scene.reading.visible(step.name))
        if drawn is not None and drawn_on(scene, drawn) in scene.scales and step.law != "opposite":
            yield drawn
        else:
            yield from _laid_by(scene, step.name, seen)


def _factor_on(scene: Scene, q: Quantity, plan: str) -> tuple[str, float]:
    """Return the scale factor with which a vector is drawn on a plan, in a detail if it is there, and its value."""
    words, scale = scene.words, scene.scales[plan]
    short = abs(q.value or 0.0) < scene.style.arrow * scale.mu  # what is longer is in no inset
    times = enlarged(scene, q.name, plan) if short else 1.0
    number = words.factor(Scale(scale.symbol, float(f"{scale.mu / times:.12g}"), scale.unit))
    return words.short(number), 1.0 / number if words.per_unit else number


def fit_for(scene: Scene, name: str) -> Fits | None:
    """Return whether a segment on its plan can show a number of a vector, or of those made by a rate; else None."""
    item = scene.quantities.get(role(name).shown)
    plan = "" if item is None or scene.words.ruler else _shown_on(scene, item)
    if item is None or plan not in scene.scales:
        return None if scene.words.ruler else _fit_of_users(scene, name)
    mu, value = _factor_on(scene, item, plan)[1], value_shown(scene, item)
    return lambda text, readable: bool(laid_off(scene.words, value, mu, text, readable))


def _fit_of_users(scene: Scene, name: str) -> Fits | None:
    """Return whether a rate gives to the vectors that it makes of distances numbers that their segments show."""
    steps = (step for step in scene.reading.users(name) if step.law in TRANSPORT and name == step.operands[0])
    found = [(step, fit) for step in steps if (fit := fit_for(scene, step.name)) is not None]

    def shows(step: Step, fit: Fits, text: str, readable: bool) -> bool:
        def told(scene: Scene, one: str) -> Product:
            return Product((Factor("", scene.values[name], told=text),)) if one == name else operand(scene, one)

        return fit(_last_number(size_by_law(scene, "", step, unit_of(step.name), told)), readable)

    if not found:
        return None
    return lambda text, readable: all(shows(step, fit, text, readable) for step, fit in found)


def _is_laid(scene: Scene, name: str) -> bool:
    """Whether a vector is laid off on its plan by a number that has been calculated, perhaps under another name."""
    step = scene.made.get(role(name).size) or scene.made.get(name)
    if scene.words.ruler and step is not None and step.verb == "read":
        edge = scene.reading.between(*step.operands)
        return edge is not None and scene.reading.is_hung(edge)
    return step is not None and step.verb == "calc"


def opposed(scene: Scene, name: str) -> Quantity | None:
    """Return the reaction that one, found on another plan, is the opposite of, where it was read off a plan.

    That is so, too, of one that closes a plan of two forces.
    """
    step = scene.made.get(name)
    if step is None or role(name).kind != "R":
        return None
    acting = scene.quantities.get(step.operands[0] if step.law == "opposite" else _other_of_two(scene, name))
    return acting if acting is not None and drawn_on(scene, acting) in scene.scales else None


def _other_of_two(scene: Scene, name: str) -> str:
    """Return the reaction known before that is the only other force on the plan of one; else nothing."""
    names = {edge.name for edge in scene.reading.on(scene.figure_of(name))} if name in scene.quantities else set()
    others = [other for other in names - {name} if role(other).kind == "R" and scene.made[other].law == "opposite"]
    return others[0] if len(names) == len(others) + 1 == 2 else ""


def is_given(scene: Scene, name: str) -> bool:
    """Whether a value is stated by the task, not constructed."""
    return name in scene.values and name not in scene.made


def paper(words: Words, scale: Scale) -> Factor:
    """Return the factor that makes millimetres of a plan the value that they show: μ, below the bar if mm per unit."""
    return Factor(words.symbol(scale.symbol), words.factor(scale), exact=True, power=-1 if words.per_unit else 1)


def noted(line: Sequence[str], *notes: str) -> tuple[str, ...]:
    """Return a line with notes behind it, commas between; empty notes are none."""
    *before, end = line
    *parted, last = (end, *filter(None, notes))
    return (*before, *(f"{chunk}," for chunk in parted), last)


def sensed(words: Words, value: float) -> str:
    """Return the sense of a turning or of a moment in words; nothing for zero."""
    return "" if value == 0.0 else words["said.ccw" if value > 0 else "said.cw"]


def stated(words: Words, symbol: str, value: float, unit: str) -> str:
    """Return `symbol = number unit` of a value in SI."""
    shown = words.display.unit(unit)
    return f"{symbol} = {value_text(words, words.display.value(value, unit))} {words.unit(shown)}"


def meeting(scene: Scene, step: Step) -> tuple[str, ...]:
    """Return the equation that two lines of a plan solve, and along which lines its unknown vectors lie.

    Both sides lead from the pole to the point where the lines meet; its absolute vector stands before them unless it is
    itself the unknown of one side.
    """
    reading, (p, u, q, w), sides = scene.reading, step.operands, list[tuple[list[str], str, str]]()
    for start, direction in ((p, u), (q, w)):
        edge = reading.between(start, step.name)
        knowns = [before.name for before in reading.way(start, reading.number[step.name])]
        sides.append((knowns, edge.name if edge is not None else _named(reading, start, step.name), direction))
    sides.sort(key=lambda side: len(side[0]))
    whole = reading.absolute(step.name)
    texts = [" + ".join((*(scene.letter(k, 2) for k in knowns), scene.letter(last, 1))) for knowns, last, _ in sides]
    if whole is not None and all(knowns or last != whole.name for knowns, last, _ in sides):
        texts.insert(0, scene.letter(whole.name))
    notes = (line_note(scene, last, direction) for _, last, direction in sides)
    return noted((texts[0], *(f"= {text}" for text in texts[1:])), *notes)


def _named(reading: Reading, start: str, tip: str) -> str:
    """Return the name of a vector that is drawn but not read: `V_XA` from a to x.

    From the end n of normal parts it is the tangential part `a_XA_t`, from that of Coriolis the sliding one `a_XB4_r`.
    """
    begin, end, part = role(start), role(tip), ""
    while begin.kind in (NORMAL, CORIOLIS):
        part = "r" if begin.kind == CORIOLIS else part or "t"
        begin = role(reading.made[begin].operands[0])
    return vector(SYMBOLS.get(end.plan, "V"), end.of, "" if begin.kind == POLE else begin.of, part)


def summed(scene: Scene, whole: str, parts: Sequence[str]) -> tuple[str, ...]:
    """Return `whole = a + b` of parts that are known in full."""
    first, *rest = (scene.letter(part, 2) for part in parts)
    return (f"{scene.letter(whole)} = {first}", *(f"+ {text}" for text in rest))


def line_note(scene: Scene, vector: str, direction: str) -> str:
    """Say along which line a vector lies: `V_BA ⊥ AB`."""
    return f"{scene.letter(vector)} {line_of(scene, direction)}"


def _line_through(scene: Scene, point: str, direction: str) -> str:
    """Return the line through a point: AB, or (B ⊥ x–x)."""
    line = line_of(scene, direction)
    return line.removeprefix("∥ ") if line.startswith("∥ ") else f"({scene.words.mark(point)} {line})"


def kinematics_text(scene: Scene, plans: Sequence[str], before: Sequence[str]) -> Lines:
    """Return the equations of plans; lengths that those of the plans `before` take have been told with these."""
    steps = [step for step in scene.program if step.law]
    told = {name for step in steps if _stage_of(step) in before for name in step.operands}
    lines = [line for plan in plans for line in kinematics_lines(scene, plan, told)]
    if "velocity" in (*plans, *before):
        return lines
    given = (step for step in steps if step.law == "signed" and role(step.name).kind == "omega")
    return [*(line for step in given for line in turning_alike(scene, step)), *lines]  # the crank's omega alone


def kinematics_lines(scene: Scene, plan: str, told: set[str] | None = None) -> Lines:
    """Return the equations of one plan in order of construction, the vector equation of a group before its numbers.

    `told` are the lengths of which other lines have told already.
    """
    told, apart = told if told is not None else set(), found_here(scene.program)
    lines, held = Lines(), Lines()  # these of a group's known parts, which come after its vector equation
    for step in (s for s in scene.program if _stage_of(s) == plan and s.name not in apart):
        if step.verb == "meet":
            lines += [*_special_point(scene, step), meeting(scene, step), *held]
            held.clear()
        elif step.law in TOLD:
            here = held if step.law in BEFORE_MEETING or _is_met(scene, step) else lines
            here += [*_lengths(scene, step, told), _formula(scene, step)]
        elif step.law == "given":
            lines.append(_given(scene, step))
        elif step.law in ("signed", "same_turning"):
            lines += turning_alike(scene, step)
        elif step.verb in ("divide", "similar"):
            lines += _similarity(scene, step)
        elif step.verb == "read":
            lines += _absolute(scene, step)
        if role(step.name).kind == "epsilon" and step.law != "same_turning":
            lines.append(_comparison(scene, step.name))
    return lines


def _stage_of(step: Step) -> str:
    """Return the plan to which a step of the kinematics belongs; nothing for other steps."""
    if step.plan != POSITION or step.verb == "read":
        return step.plan
    return STAGES.get(role(step.name).kind, "") if step.verb == "calc" else ""


def _is_met(scene: Scene, step: Step) -> bool:
    """Whether a line that finds a point begins at the end of the vector of a step, where no point has its end."""
    users, absolute = scene.reading.users, scene.reading.absolute
    ends = (user.name for user in users(step.name) if user.verb == "chain" and absolute(user.name) is None)
    return any(user.verb == "meet" for end in ends for user in users(end))


def _lengths(scene: Scene, step: Step, told: set[str]) -> Iterator[tuple[str, ...]]:
    """Go through the lengths for a step that are not given, each told once.

    They are measured on the plan of the mechanism, or follow from the coordinates of a link's joints.
    """
    measured = (made for name in step.operands if (made := scene.made.get(name)) and made.verb == "measure")
    for name, made in ((made.name, made) for made in measured if made.name not in told):
        told.add(name)
        symbol = scene.words.symbol(role(name).shown)
        if role(made.operands[0]).hidden:
            yield (stated(scene.words, symbol, size_of(scene, name), "m"),)
        else:
            yield worked(scene.words, symbol, [_distance(scene, made)], "m", same=number(scene, name))


def _formula(scene: Scene, step: Step) -> tuple[str, ...]:
    """Return what a law gives, with its numbers, and how the vector lies.

    It says in which sense a link turns, which way a normal part is laid off, how that of Coriolis is turned.
    """
    words, reading, name = scene.words, scene.reading, scene.reading.visible(step.name)
    line = size_by_law(scene, words.symbol(name), step, unit_of(name))
    if step.law == "turning":
        return noted(line, sensed(words, rate_of(scene, name)))
    if step.law == "normal_part":
        back = next(s for s in reading.users(step.name) if s.verb == "back")
        start, end = (words.mark(point) for point in reading.made[back.operands[1]].operands[:2])
        return noted(line, f"{scene.letter(name)} ∥ {start}{end} ({end} → {start})")
    if step.law == "coriolis":
        omega, v = step.operands
        parts = {"part": scene.letter(name), "vector": scene.letter(v), "omega": words.symbol(omega)}
        first, *rest = words["said.coriolis"].format(**parts).split("|")
        return (*noted(line, first), *rest)
    return line


def turning_alike(scene: Scene, step: Step) -> Lines:
    """Return a rate that is given, from revolutions per minute where it is so, or that of another link."""
    words, value, given = scene.words, rate_of(scene, step.name), scene.givens.get(step.operands[0])
    symbol, of, unit = words.symbol(step.name), words.symbol(step.operands[0]), unit_of(step.name)
    if given is not None and given.unit == "rpm" and not isinstance(given.value, str):
        texts, result = calculation(words, lambda n: math.pi * n / 30.0, [Input(given.value, exact=True, fixed=True)])
        line = [f"{symbol} = π{of}/30 =", f"π·{texts[0]}/30 =", f"{result} {words.unit(unit)}"]
    else:
        head, size = symbol, shortest(words, abs(value))
        if step.law == "same_turning":
            head, size = f"{symbol} = {of}", number(scene, step.operands[0])
        line = [f"{head} = {size} {words.unit(unit)}"]
    return [noted(line, sensed(words, value))]


def _special_point(scene: Scene, step: Step) -> Lines:
    """Say where a point stands that no link has, such as Assur's special point, when it is found for the first time."""
    point, made = role(step.name).of, scene.made.get(role(step.name).of)
    if step.plan != "velocity" or made is None or made.verb != "meet" or point in scene.points:
        return []
    p, u, q, w = made.operands
    lines = f"{_line_through(scene, p, u)} ∩ {_line_through(scene, q, w)}"
    return [(scene.words["said.special_point"].format(point=scene.words.mark(point)), lines)]


def _given(scene: Scene, step: Step) -> tuple[str, ...]:
    words, name, given = scene.words, scene.reading.visible(step.name), step.operands[0]
    if given == ZERO:
        return (f"{words.symbol(name)} = 0",)
    head = " = ".join(dict.fromkeys((words.symbol(name), words.symbol(given))))
    line = stated(words, head, float(scene.values[given]), unit_of(name))
    laid = next(user for user in scene.reading.users(step.name) if user.verb == "lay")
    return noted((line,), line_note(scene, name, laid.operands[1]))


def triangles(scene: Scene, step: Step) -> tuple[str, str]:
    """Return the triangle on a plan that is similar to one of a link, and that one, by the letters of their corners."""
    words, plan = scene.words, (step.operands[0], step.operands[1], step.name)
    return "".join(map(words.mark, plan)), "".join(map(words.mark, scene.reading.on_link(plan)))


def _similarity(scene: Scene, step: Step) -> Lines:
    words, (start, end, first, second) = scene.words, step.operands
    if step.verb == "similar":
        plan, link = triangles(scene, step)
        return [tuple(words["said.similar"].format(plan=plan, link=link).split("|"))]
    if size_of(scene, first) == 0.0:
        return []
    a, b, s = map(words.mark, (start, end, step.name))
    whole = scene.reading.between(start, end)
    ab = segment(scene, f"{a}{b}", step.plan, scene.span(start, end, step.plan), "" if whole is None else whole.name)
    if positive(first) == positive(second):  # on the other side, as far away
        return [(f"{a}{s} = {a}{b} = {ab.told} {words.unit(words.display.paper)}",)]
    ratio = Product((ab, factor(scene, first), factor(scene, second, -1)))
    edge = scene.reading.between(start, step.name)
    drawn = None if edge is None else scene.quantities.get(edge.name)
    same = "" if drawn is None else printed_segment(scene, drawn)[0]
    return [worked(words, f"{a}{s}", [ratio], words.display.paper, same=same)]


def _absolute(scene: Scene, step: Step) -> Lines:
    """Return the absolute vector of a point that was hung from parts, or moves like another."""
    reading, (tail, tip) = scene.reading, step.operands
    made, whole = reading.made[tip], reading.absolute(tip)
    if role(tail).kind != POLE or made.name == tail:
        return []
    if made.verb == "same":
        other = reading.absolute(made.operands[0])
        parts = [] if other is None else [other]
    else:
        parts = reading.parts(whole) if whole is not None and whole.name == step.name else []
    return [summed(scene, step.name, [edge.name for edge in parts])] if parts else []


def _comparison(scene: Scene, rate: str) -> tuple[str, ...]:
    words, link = scene.words, role(rate).of
    omega, epsilon = rate_of(scene, f"omega_{link}"), rate_of(scene, rate)
    still = "said.translates" if omega == 0.0 else "said.steady"
    key = still if omega * epsilon == 0.0 else "said.speeds_up" if omega * epsilon > 0 else "said.slows_down"
    symbols = {"omega": words.symbol(f"omega_{link}"), "epsilon": words.symbol(rate)}
    return tuple(words[key].format(link=link, **symbols).split("|"))
