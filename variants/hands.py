"""What a hand makes of a solution: its errors, read from a word or from three numbers, and a table of what they do."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import asdict, astuple, dataclass
from types import MappingProxyType
from typing import Any

from ..drawing.words import Words
from ..plans.board import LINES, Program
from ..plans.hands.shaky import PRESETS, Hand, Tolerance, drawing_of, preset
from ..plans.hands.spread import DRAWINGS, SEED, Expectation, expectations
from ..plans.linkages.legs import guide_letters
from ..plans.names import role
from ..plans.quantities import Quantity
from ..plans.solved import Solved
from ..scales.errors import InputError
from ..scales.names import of_kind
from ..scales.numbers import quote
from ..scales.scale import Scale
from ..scales.units import parse, unit
from .case import Kind
from .tables import aligned

OWN = "own"
NONE: Mapping[str, Any] = MappingProxyType({})
BETWEEN = re.compile(r";|,\s+|(?<=[^\d\s]),")  # not a decimal comma
DIGITS = 4
STEP = 7  # the column of the worst step
LETTERED = ("diagram", "sizes", "plate", "rocker", "profile", "meshing", "sliding", "theta")  # as marks are named
PLANS = ("position", "velocity", "acceleration", "forces", "lever", *LETTERED)  # others are of compound motion
READINGS = ("read", "measure", "distance", "angle")


@dataclass(frozen=True, slots=True)
class Drawing:
    """A solution drawn by a hand: the hand by its name, what is let pass, what comes out by quantity, the steps."""

    name: str
    hand: Hand
    tolerance: Tolerance
    expected: Mapping[str, Expectation]
    program: Program

    def head(self) -> dict[str, Any]:
        """Return as JSON whose hand draws, and how often."""
        often = {"drawings": DRAWINGS, "seed": SEED}
        return {"name": self.name, **asdict(self.hand), "tolerance": asdict(self.tolerance), **often}

    def item(self, name: str) -> dict[str, Any]:
        """Return as JSON what the hand makes of a quantity; nothing for what is given."""
        return {"hand": self.expected[name].as_data()} if name in self.expected else {}


def is_own(text: str) -> bool:
    """Whether a text is to say a hand of one's own: three errors, and no name."""
    return re.search(r"\d", text) is not None


def _hand_of(text: str | Hand) -> tuple[str, Hand, Tolerance]:
    """Return the name, the errors and the tolerance of a hand: a preset, or three errors of one's own.

    Parameters
    ----------
    text : str or Hand
        `normal`, or the errors of marks, directions and readings, `0.2 mm, 0.5 deg, 0.2 mm`. Of one's own hand that is
        let pass which is of the first preset that errs no less, of the last one where none does.

    Raises
    ------
    InputError
        No such preset, not three errors, or one below zero.
    """
    of_kind("hand", text, (str, Hand), "str | Hand")
    if isinstance(text, str) and not is_own(text):
        found = preset(text.strip())
        return text.strip(), found.hand, found.tolerance
    hand = text
    if isinstance(hand, str):
        parts = BETWEEN.split(hand.strip())
        if len(parts) != 3:
            raise InputError("hand-three", text=quote(hand))
        mm, degree = unit("mm"), unit("deg")
        point, direction, reading = (parse(part, of, of) for part, of in zip(parts, (mm, degree, mm), strict=True))
        hand = Hand(mm.from_si(point), degree.from_si(direction), mm.from_si(reading))
    no_less = (p for p in PRESETS.values() if all(a <= b for a, b in zip(astuple(hand), astuple(p.hand), strict=True)))
    return OWN, hand, next(no_less, [*PRESETS.values()][-1]).tolerance


def drawing(kind: Kind[Any, Any], solved: Solved, scales: Mapping[str, Scale], text: str | Hand) -> Drawing | None:
    """Draw what is solved as a student does, with the hand that is named; nothing of a position without a plan.

    What goes by another name there is told by its own, too.
    """
    name, hand, tolerance = _hand_of(text)  # a wrong one is refused in any position
    if solved.trouble is not None:
        return None
    drawn, other_names = kind.as_drawn(solved)
    paper = drawing_of(drawn, {plan: scale.mu for plan, scale in scales.items()})
    expected = expectations(paper, hand, tolerance, kind.limits(drawn, paper, tolerance))
    expected |= {other: expected[own] for other, own in other_names.items() if own in expected}
    return Drawing(name, hand, tolerance, expected, paper.program)


def table(
    drawn: Drawing, quantities: Iterable[Quantity], words: Words, conditions: Mapping[str, tuple[str, str]] = NONE
) -> str:
    """Return a table: value, interval of drawings, half of it on paper and in per cents, what to let pass, worst step.

    Quantities that are only given are left out. `conditions` have K and the sine of the worst intersection of each, as
    texts: two columns before the worst step.
    """
    paper = words.spelled(words.display.paper)
    heads = ("name", "value", "unit", "interval", "paper", "percent", "pass", "step")
    rows = [[words[f"hand.{key}"].format(paper=paper) for key in heads]]
    for quantity in quantities:
        expected = drawn.expected.get(quantity.name)
        if expected is not None:
            rows.append(_row(quantity, expected, drawn.program, words))
            if conditions:
                rows[-1][STEP:STEP] = conditions.get(quantity.name, ("", ""))
    if conditions:
        rows[0][STEP:STEP] = ("K", "sin")
    lines = ["", aligned(rows, (0, len(rows[0]) - 1))]
    worst = max((item.spread.undrawn for item in drawn.expected.values() if item.spread.exact is not None), default=0.0)
    if 0.0 < worst < math.inf:
        lines += ["", words["hand.undrawn"].format(percent=words.short(100.0 * worst, 2))]
    numbers = {**asdict(drawn.hand), **asdict(drawn.tolerance), "part": drawn.tolerance.part * 100.0, "n": DRAWINGS}
    shown = {name: words.short(value, DIGITS) for name, value in numbers.items()}
    return "\n".join((words["hand.heading"].format(hand=words[f"hand.{drawn.name}"], **shown), *lines))


def _row(quantity: Quantity, expected: Expectation, program: Program, words: Words) -> list[str]:
    def shown(value: float | None) -> str:
        return "–" if value is None else words.short(words.display.value(value, quantity.unit) + 0.0, DIGITS)

    spread = expected.spread
    value = _place(quantity, words) if quantity.kind == "point" else shown(quantity.value)
    if quantity.kind == "point":
        interval = ""
    elif spread.low is None or spread.low == spread.high:
        interval = shown(spread.low)
    else:
        interval = "–" if spread.high is None else f"{shown(spread.low)} … {shown(spread.high)}"
    errs = expected.errs
    paper = "" if expected.mm is None or not errs else words.number(words.display.segment(expected.mm), 2)
    part = "" if expected.percent is None or not errs else _two(expected.percent, words)
    degrees = "" if expected.degrees is None else f"; {_two(expected.degrees, words)}°"
    allowed = f"{shown(expected.allowed)}{degrees}" if expected.allowed is not None and errs else ""
    unit = words.spelled(words.display.unit(quantity.unit))
    return [quantity.name, value, unit, interval, paper, part, allowed, _worst(expected, program, words)]


def _two(value: float, words: Words) -> str:
    """Return a number with two digits, or without decimals."""
    return words.number(value, 0) if value >= 10.0 else words.short(value, 2)


def _place(quantity: Quantity, words: Words) -> str:
    if quantity.x is None or quantity.y is None:
        return "–"
    x, y = (words.short(words.display.value(part, quantity.unit), DIGITS) for part in (quantity.x, quantity.y))
    return f"({x}; {y})"


def _worst(expected: Expectation, program: Program, words: Words) -> str:
    """Say which step errs most: a mark, a line, a reading or an arm, and its part."""
    if expected.step is None:
        return ""
    step = program.by_name[expected.step]
    share = "" if expected.share is None else words.number(expected.share, 2)
    if step.verb in READINGS:
        said = words["hand.reading"].format(name=role(step.name).shown)
    elif step.verb == "moment":
        force, _, about = step.operands
        said = words["hand.arm"].format(name=f"{force}, {_plain(words.mark(about))}")
    elif step.verb in LINES:
        # a link has the name of its ends, a guide its letters, or the pins on it
        own = "".join(step.operands[:2]) if step.verb == "tangent" else role(step.name).shown.letters
        said = words["hand.line"].format(name=guide_letters(program).get(step.name, own))
    else:
        plan = step.plan.kind
        where = words[f"hand.plan.{plan if plan in PLANS else 'compound'}"]
        mark = role(step.name).of if plan in LETTERED else _plain(words.mark(step.name))
        said = f"{words['hand.mark'].format(name=mark)}, {where}"
    return f"{said} {share}".rstrip()


def _plain(markup: str) -> str:
    """Return a letter without the signs that lower and raise its indices."""
    return re.sub(r"[_^{}]", "", markup)
