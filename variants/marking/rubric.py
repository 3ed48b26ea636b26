"""The rubric: what each quantity weighs, what each verdict is worth, what is asked, and what tolerance holds."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Collection, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from operator import itemgetter
from pathlib import Path
from typing import Any

from ...plans.hands.shaky import Tolerance, preset
from ...plans.marking.answers import Answer, Line, Verdict
from ...plans.marking.key import Question
from ...plans.quantities import unit_of
from ...scales.errors import InputError
from ...scales.names import all_known, unknown
from ...scales.numbers import SHOWN, quote
from ..checks.basics import Checker, EnoughError, Field, Places, Read, one_of, record, trying
from .cells import Asked, value

WORTH = {
    Verdict.RIGHT: 1.0,
    Verdict.CARRIED: 1.0,
    Verdict.ARITHMETIC: 0.5,
    Verdict.SCALE: 0.5,
    Verdict.WRONG: 0.0,
    Verdict.UNCOUNTED: 0.0,
    Verdict.MISSING: 0.0,
}
DIRECTIONS = ("optional", "required", "ignored")
SIZE_ALONE = 0.5  # part of a line's worth where a direction or sense is required and left out
NEEDED = 3.0  # how many times a line counts more on which all later ones hang
NOTHING = 1e-6  # part of a tolerance that is rounding
SIGNED = ("rad/s", "rad/s^2", "N*m")  # units of scalars that have a sense
LARGEST = 100_000  # bytes


@dataclass(frozen=True, slots=True)
class Rubric:
    """How answers are marked.

    Of `directions` and senses holds: "required", a line without its own is worth less; "optional", what is said of one
    is compared; "ignored", sizes alone are.
    """

    tolerance: Tolerance
    out_of: float = 100.0  # the full mark
    # what quantities weigh; those that are not named weigh one, and where none is, lines count as `parts` says
    weights: Mapping[str, float] = field(default_factory=dict)
    worth: Mapping[Verdict, float] = field(default_factory=lambda: WORTH)  # of verdicts, in parts of the weight
    asked: tuple[str, ...] = ()  # the quantities; all when empty
    limits: Mapping[str, float] = field(default_factory=dict)  # tolerances of single quantities, SI
    directions: str = DIRECTIONS[0]

    def parts(
        self, lines: Collection[Line], by_plan: Mapping[str, str], needed: Mapping[str, float]
    ) -> dict[str, float]:
        """Return what part of the full mark each line is: by the rubric's weights, or else by plans.

        A line counts the more the more of the later ones hang on it, `needed` being their part, and nothing where zero
        is right; a plan (or section of the form) counts as the root of what its lines come to, so that of four times as
        many lines each counts half as much.
        """
        if self.weights:
            shares = {line.name: self.weights.get(line.name, 1.0) for line in lines}
        else:
            zero = {line.name for line in lines if abs(line.right) <= NOTHING * line.allowed}
            shares = {line.name: 1.0 + NEEDED * needed[line.name] for line in lines} | dict.fromkeys(zero, 0.0)
            whole = dict.fromkeys(by_plan.values(), 0.0)
            for name, share in shares.items():
                whole[by_plan[name]] += share
            shares = {name: share / math.sqrt(whole[by_plan[name]] or 1.0) for name, share in shares.items()}
        total = sum(shares.values())
        return {name: share / total if total else 1.0 / len(shares) for name, share in shares.items()}

    def mark(self, lines: Iterable[Line], parts: Mapping[str, float]) -> float:
        """Return the mark, to a tenth."""

        def earned(line: Line) -> float:
            less = self.directions == "required" and wants_direction(line)
            return parts[line.name] * (self.worth[line.verdict] * (SIZE_ALONE if less else 1.0))

        return round(self.out_of * sum(map(earned, lines)), 1)

    def compared(self, answer: Answer, question: Question) -> Answer:
        """Return what counts of an answer; the sign of a number without a unit is no sense."""
        if self.directions != "ignored":
            return answer
        signed = answer.value is None or (question.unit == "1" and not question.vector)
        value = answer.value if signed else abs(answer.value or 0.0)
        return replace(answer, value=value, direction=None, sense=None, plus=False)


def wants_direction(line: Line) -> bool:
    """Whether an answer leaves out the direction of a vector, or the sense of a scalar that has one."""
    answer = line.answer
    if answer is None or answer.empty or not line.right:
        return False
    if isinstance(line.right, complex):
        return answer.direction is None
    return has_sense(line.name) and answer.sense is None and not answer.plus and not (answer.value or 0.0) < 0.0


def has_sense(name: str) -> bool:
    """Whether a scalar turns one way or the other: an angular velocity or acceleration, a moment."""
    return unit_of(name) in SIGNED


def read_rubric(file: str | Path | None, preset_name: str, asked: Asked, directions: str | None = None) -> Rubric:
    """Read a rubric, a small TOML file; without weights of its own quantities count as `Rubric.parts` says.

    `directions` takes the place of what the file says of them.

        out_of = 100
        asked = ["V_B", "omega_2", "a_B"]
        directions = "required"

        [weights]
        a_B = 3

        [worth]
        carried = 0.8

        [tolerance]
        mm = 2
        percent = 5
        degrees = 1

        [limits]
        V_B = "0.1 m/s"

    Raises
    ------
    InputError
        The file cannot be read, or holds what no rubric has; with file and key; or `directions` is unknown.
    """
    if directions is not None and directions not in DIRECTIONS:
        raise unknown("choice-unknown", directions, DIRECTIONS)
    usual = preset(preset_name).tolerance
    rubric = Rubric(usual) if file is None else _read(file, usual, asked)
    return rubric if directions is None else replace(rubric, directions=directions)


def _read(file: str | Path, usual: Tolerance, asked: Asked) -> Rubric:
    """Return what a rubric's file says; what it leaves out of the tolerance is as usual."""
    path, shown, read = Path(file), quote(file, SHOWN), dict[str, Any]()
    try:
        text = (path.read_bytes() if path.stat().st_size <= LARGEST else b"\0").decode("utf-8-sig")
        raw, checker = tomllib.loads(text), Checker(shown, Places(text))
    except FileNotFoundError:
        raise InputError("file-missing", file=shown) from None
    except OSError:
        raise InputError("file-unreadable", file=shown) from None
    except (ValueError, RecursionError):
        raise InputError("rubric-toml", file=shown) from None
    with suppress(EnoughError):
        read = record(checker, (), raw, _fields(asked))
    if checker.faults:
        raise min(checker.faults, key=itemgetter(0, 1))[2]
    own, worth = read.get("tolerance", {}), {Verdict(name): part for name, part in read.pop("worth", {}).items()}
    part = own["percent"] / 100.0 if "percent" in own else usual.part
    tolerance = Tolerance(own.get("mm", usual.mm), part, own.get("degrees", usual.degrees))
    return Rubric(**{**read, "tolerance": tolerance, "worth": {**WORTH, **worth}})


def _fields(asked: Asked) -> dict[str, Field]:
    """Return how the keys of a rubric are read, none of which must be there."""
    quantities = asked.quantities

    def names(raw: object) -> tuple[str, ...]:
        if not isinstance(raw, list) or not all(isinstance(name, str) for name in raw):
            raise InputError("rubric-names")
        all_known("quantity-unknown", raw, quantities)
        return tuple(raw)

    def number(raw: object) -> float:
        if isinstance(raw, bool) or not isinstance(raw, (int, float)) or not 0.0 <= raw < 1e9:
            raise InputError("rubric-number", text=quote(raw))
        return float(raw)

    def limit(raw: object, name: str) -> float:
        return value(str(raw), "", name, asked)

    def optional(readers: Mapping[str, Read]) -> dict[str, Field]:
        return {key: Field(read, required=False) for key, read in readers.items()}

    tables: dict[str, dict[str, Read]] = {
        "weights": dict.fromkeys(quantities, trying(number)),
        "worth": dict.fromkeys(map(str, Verdict), trying(number)),
        "tolerance": dict.fromkeys(("mm", "percent", "degrees"), trying(number)),
        "limits": {name: trying(partial(limit, name=name)) for name in quantities},
    }
    return optional({
        "out_of": trying(number),
        "asked": trying(names),
        "directions": one_of("choice-unknown", lambda: DIRECTIONS),
        **{table: partial(record, fields=optional(readers)) for table, readers in tables.items()},
    })  # fmt: skip
