"""A student's answers: who gave them, for which sheet, and of each quantity millimetres, scale, value, direction."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

from ...plans.marking.answers import nearest
from ...plans.quantities import Quantity
from ...scales.display import Display
from ...scales.errors import KulmanError
from ...scales.units import unit
from ..roster import Who
from ..task import LocatedError


@dataclass(frozen=True, slots=True)
class Mu:
    """A scale factor in SI per millimetre; `sure` when its unit says which way it is meant.

    Without a unit 0.05 may be metres per second to a millimetre, or millimetres to a metre per second.
    """

    value: float
    sure: bool = False

    @property
    def ways(self) -> tuple[float, ...]:
        """The factor as value per mm, in each way in which it may be meant."""
        return (self.value,) if self.sure else (self.value, 1.0 / self.value)

    def nearest(self, ours: float) -> float:
        """Return the factor in the way that is nearer to ours in ratio."""
        return nearest(self.ways, ours)


@dataclass(frozen=True, slots=True)
class Line:
    """One answered quantity: what an `Answer` of plans has, SI, as it stands in a file."""

    name: str
    place: str  # file and row, or file and cell
    mm: float | None = None
    decimals: int = 0  # with which the segment was written
    mu: Mu | None = None
    value: float | None = None
    direction: float | None = None
    sense: int | None = None
    plus: bool = False
    rounded: float | None = None


@dataclass(frozen=True, slots=True)
class Answers:
    """All answers of one student; `about` is what the file says of task, variant and sheet id, as written.

    `problems` are cells that could not be read; what stands beside them is marked all the same. `columns` are the
    quantities that a class was asked, nothing for a form of one's own. `unread` is why a file could not be read, which
    is a student without a mark, not one who has handed in nothing.
    """

    source: str
    who: Who
    about: Mapping[str, str]
    lines: Mapping[str, Line]
    scales: Mapping[str, Mu]
    problems: tuple[LocatedError, ...] = ()
    columns: tuple[str, ...] = ()
    unread: KulmanError | None = None

    @property
    def empty(self) -> bool:
        """Whether nothing at all has been answered."""
        return not self.lines


@dataclass(frozen=True, slots=True)
class Asked:
    """What can be answered in a task: its quantities, its scale factors, and the units in which it shows results.

    `others` are names of plans that are not marked now; answers to them are passed over.
    """

    quantities: Mapping[str, Quantity]
    scales: Mapping[str, str]  # SI unit of what a scale factor draws, by symbol
    display: Display = field(default_factory=Display)
    others: frozenset[str] = frozenset()

    @property
    def names(self) -> tuple[str, ...]:
        """All names that an answer may have."""
        return (*(name for name, q in self.quantities.items() if q.kind != "point"), *self.scales)

    def unit(self, name: str) -> str:
        """Return the unit in which a quantity is asked for."""
        return self.display.unit(self.quantities[name].unit)


NEAR = 0.05  # part by which a product may differ from what it should be
FEWEST = 3  # lines that must tell
CLEAR = math.log(3.0)  # by how much nearer to the task's size a value must be


def put_back(lines: Mapping[str, Line], scales: Mapping[str, Mu], asked: Asked) -> dict[str, Line] | None:
    """Return the lines with segments and values exchanged where nearly all of them only then agree; else None.

    `scales` are the factors that stand in rows of their own, by symbol.
    """
    told = [verdict for line in lines.values() for verdict in _told(line, scales, asked)]
    if len(told) < FEWEST or sum(told) < 0.8 * len(told):
        return None
    return {name: _in_place(line, asked) for name, line in lines.items()}


def _in_place(line: Line, asked: Asked) -> Line:
    """Return a line exchanged; of a lone number the size tells what it is, for what is calculated has no segment."""
    if line.mm is not None and line.value is not None:
        return _exchanged(line, asked)
    lone = line.value if line.mm is None else unit(asked.unit(line.name)).to_si(line.mm)
    if not lone:
        return line
    quantity = asked.quantities[line.name]
    segment = quantity.mm and unit(asked.unit(line.name)).to_si(quantity.mm)
    is_value = not segment or apart(lone, quantity.value) <= apart(lone, segment)
    return line if is_value is (line.mm is None) else _exchanged(line, asked)


def apart(number: float, other: float | None) -> float:
    """Return the logarithm of the ratio of two magnitudes."""
    return abs(math.log(abs(number / other))) if other else math.inf


def _told(line: Line, scales: Mapping[str, Mu], asked: Asked) -> Iterator[bool]:
    """Say of a line with segment, scale and value whether it is right only when exchanged; nothing where none agrees.

    A scale factor without a unit agrees either way, as value per millimetre and as millimetres per unit: then that
    value is meant which is of the size of the task's.
    """
    quantity = asked.quantities[line.name]
    mu, size = line.mu or scales.get(quantity.scale or ""), abs(quantity.value or 0.0)
    if mu is None or not line.mm or not line.value or not size:
        return
    other = _exchanged(line, asked)
    agrees, instead = _agrees(line, mu), _agrees(other, mu)
    if agrees != instead:
        yield instead
    elif agrees:
        off, then = (apart(one.value or size, size) for one in (line, other))
        if abs(off - then) > CLEAR:
            yield then < off


def _agrees(line: Line, mu: Mu) -> bool:
    """Whether millimetres times the scale factor, or over it, are the value."""
    mm, value = line.mm or 0.0, abs(line.value or 0.0)
    return any(abs(mm * way - value) <= NEAR * value for way in mu.ways)


def _exchanged(line: Line, asked: Asked) -> Line:
    """Return a line with the two numbers exchanged, each read in the unit of its new column."""
    own = unit(asked.unit(line.name))
    value = None if line.mm is None else own.to_si(line.mm)
    mm = None if line.value is None else abs(own.from_si(line.value))
    return replace(line, mm=mm, value=value, rounded=None)
