"""A student's answers: who gave them, for which sheet, and of each quantity millimetres, scale, value, direction."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ...plans.marking.answers import nearest
from ...plans.quantities import Quantity
from ...scales.display import Display
from ...scales.errors import KulmanError
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
    """One answered quantity.

    Parameters
    ----------
    place : str
        Where it stands: file and row, or file and cell.
    mm : float, optional
        The segment on paper, millimetres.
    decimals : int
        Decimals with which the segment was written.
    value : float, optional
        SI, signed as written.
    direction : float, optional
        Radians from the x axis, counter-clockwise.
    sense : int, optional
        1 counter-clockwise or along the axis, -1 the other way: what words, arrows, or a column of senses say.
    plus : bool
        Whether the value is written with a plus: its sense is said, too.
    rounded : float, optional
        Half of the last digit of the value as written, SI.
    """

    name: str
    place: str
    mm: float | None = None
    decimals: int = 0
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
