"""What every subject is once it is solved: its construction, values and quantities, checks, columns over its motion."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self, TypeVar

from ..scales.errors import PositionError
from .board import Board, Program, RecordingBoard, recorded
from .boards.exact import ExactBoard, Status, Trouble
from .names import role
from .quantities import Quantity, shown_on

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

T = TypeVar("T")
PAPER_MM = 1e-3  # metres of paper in a millimetre: diagrams are drawn in these
# how a value has to stand to its limit; within: by its magnitude
AT_LEAST, MORE, AT_MOST, EQUAL, WITHIN = ("at-least", "more-than", "at-most", "equal", "within")
SIGNS = {AT_LEAST: "≥", MORE: ">", AT_MOST: "≤", EQUAL: "=", WITHIN: "∈ ±"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Solved:
    """A solved construction; `values` holds every name of it, `quantities` the results in SI.

    A linkage, a cam, a gear pair, a hoist add what they are solved from, and may say in their own words why there is no
    plan.
    """

    program: Program
    values: Mapping[str, Any]
    quantities: Mapping[str, Quantity]
    sines: Mapping[str, float]
    status: Status
    trouble: Trouble | None
    shown_on: Mapping[str, str]  # the first plan that shows each quantity as a segment
    scale_of_plan: Mapping[str, str]  # symbol of the scale factor of every plan
    givens: Mapping[str, Any]  # what the board began with, to run the program again

    @classmethod
    def of(cls, solved: Solved) -> Self:
        """Return what has been solved as what it is known to be: a cam, a linkage."""
        assert isinstance(solved, cls)
        return solved

    @property
    def scale_of_figure(self) -> Mapping[str, str]:
        """Symbols of the scale factors of figures apart that may show quantities larger than the plan."""
        return {}

    def point(self, mark: str) -> complex:
        """Return a mark of any plan, SI."""
        return complex(self.values[mark])

    def size(self, name: str) -> float:
        """Return the magnitude of a value."""
        value = self.values[name]
        return math.hypot(value.real, value.imag)

    def dense(self, construction: Callable[[Board], None], mark: str, **over: NDArray[np.float64]) -> NDArray[Any]:
        """Return a curve densely: places of a mark, complex128 of shape (N,), SI, NaN where there is none.

        The `construction` that makes the mark draws on a board, from all that is solved and from the variables `over`,
        float64 of shape (N,), of which it is a function.
        """
        (count,) = {len(values) for values in over.values()}
        import numpy as np  # reading a task needs no arrays

        from .boards.arrays import ArrayBoard

        board, recording = ArrayBoard({**self.values, **over}, count), RecordingBoard()
        construction(recording)
        with np.errstate(invalid="ignore", divide="ignore"):
            Program(recording.steps).needed_for([mark]).run(board)
        places: NDArray[Any] = np.broadcast_to(board.values[mark], (count,))
        return places

    def worst_sine(self) -> tuple[str, float]:
        """Return the worst intersection: the name of its mark and the sine of its angle."""
        return min(self.sines.items(), key=lambda item: item[1], default=("", 1.0))

    def worth(self, mus: Mapping[str, float]) -> dict[str, float]:
        """Return what a millimetre of every plan is worth to the board, SI, by the scale factors of the plans."""
        return {plan: PAPER_MM if plan in self.on_paper else mu for plan, mu in mus.items()}

    @property
    def on_paper(self) -> tuple[str, ...]:
        """Plans that are drawn in millimetres of paper, so that a segment is its own value."""
        return ()

    @property
    def edges(self) -> tuple[str, ...]:
        """Names of the directions of the sheet's edges, along which a drafting machine draws without an error."""
        return ()

    @property
    def ends(self) -> tuple[str, ...]:
        """Marks at which curves that are drawn bit by bit must come back to their axis, which is level."""
        return ()

    def error(self) -> PositionError | None:
        """Return why there is no plan, or None."""
        return None if self.trouble is None else self.reason(self.trouble)

    def reason(self, trouble: Trouble) -> PositionError:
        """Return why a step of the construction cannot be done."""
        return PositionError("singular-step", status_word=trouble.status, point=role(trouble.name).of)


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """A rule of good design, a condition of validity, or a second route beside the first; in SI."""

    name: str  # what is looked at: `undercut_1`, `strength`, `lever`
    ok: bool  # whether the value stands as it has to; what is undefined does not
    value: float
    limit: float
    relation: str  # how the value has to stand to its limit, one of `SIGNS`
    unit: str  # of both
    quantity: str = ""  # the quantity that is compared, where it is one
    of: str = ""  # the quantity that the limit is, or is a part of, if one

    @classmethod
    def of_value(
        cls, name: str, value: float, relation: str, limit: float, unit: str, room: float = 0.0, **more: Any
    ) -> Self:
        """Return the check of a value against its limit, SI, which rounding may pass by `room`; `more` are fields."""
        if relation in (AT_LEAST, AT_MOST):
            ok = value >= limit - room if relation == AT_LEAST else value <= limit + room
        else:
            ok = {MORE: value > limit, EQUAL: abs(value - limit) <= room, WITHIN: abs(value) < limit}[relation]
        return cls(name=name, ok=bool(ok), value=value, limit=limit, relation=relation, unit=unit, **more)

    @property
    def sign(self) -> str:
        """The relation as a sign."""
        return SIGNS[self.relation]

    def to_json(self) -> dict[str, Any]:
        """Return what is said of the check, for JSON; its name is the key."""
        compared = {"quantity": self.quantity} if self.quantity else {}
        sides = {"value": self.value, "limit": self.limit, "relation": self.relation, "unit": self.unit}
        return {"ok": self.ok, **compared, **sides}


@dataclass(frozen=True, slots=True, eq=False)
class Columned:
    """One column: its name, its SI unit, its values."""

    name: str
    unit: str
    values: NDArray[Any]


@dataclass(frozen=True, slots=True)
class Ends:
    """The largest and the smallest value of a column, SI, with the angles of what drives where they are, rad."""

    name: str
    unit: str
    most: float
    most_at: float
    least: float
    least_at: float


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """Pieces that formulas are of: where each begins, and the numbers that are given in it, a row for each piece."""

    starts: NDArray[Any]
    names: Sequence[str]
    rows: NDArray[Any]


AT = "_at"  # the place, counted from the beginning of the turn, as formulas of pieces are given it
FINE = 5e-7  # m, between an outline to be cut and its chords
Rows = tuple[list[str], Sequence[Columned]]  # what stands before the rows of a table, and its columns


class Course(ABC):
    """What is solved over its motion, column by column at places: what a sweep shows; `usual` are the places in files.

    A subject has one in its module `course`, called after its table: `CamCourse`.
    """

    usual: ClassVar[int]
    called: ClassVar[str] = "positions"  # what the places are

    @abstractmethod
    def places(self, count: int) -> Any:
        """Return so many places, evenly: an array of what drives."""

    @abstractmethod
    def columns(self, places: Any) -> Sequence[Columned]:
        """Return the columns at places."""

    @abstractmethod
    def formulas(self, given: Callable[[str], Any]) -> dict[str, Any]:
        """Return the columns at a place, by name, and points and directions that figures which move need.

        They follow from numbers that are `given` by name: the place, in the first column, and those of its piece. The
        numbers may be written down (`boards.batch`), or arrays.
        """

    def pieces(self) -> Pieces | None:
        """Return the pieces that the formulas are of, None where they hold everywhere."""
        return None

    @property
    def changeable(self) -> Mapping[str, float]:
        """The givens and sizes, SI, that the formulas ask for, so that others may stand in their place.

        The formulas of other numbers are right while all of their columns `limit.` are not negative at any place.
        """
        return {}

    @property
    def kept(self) -> Mapping[str, float]:
        """What is found again, as it is for the numbers of the course."""
        return {}

    def found_again(self, given: Callable[[str], Any]) -> Mapping[str, tuple[Any, Any, Any]]:
        """Return what other numbers make anew of names that the formulas ask for, too.

        Each is the one zero of a rising function: with its name go the value at the given number, and two places
        between which the zero is.
        """
        return {}

    def rows(self, count: int | None) -> Rows:
        """Return the rows of a table: so many places, without a number what is marked, or the usual ones."""
        places = self.places(count or self.usual)
        return list(map(str, range(len(places)))), self.columns(places)

    def extremes(self) -> Sequence[Ends]:
        """Return the extremes of columns, where they are told."""
        return ()

    def states(self, places: Any) -> Mapping[str, Sequence[str]]:
        """Return what is said of each place in files, by heading."""
        return {}

    def remarks(self) -> Iterable[tuple[str, Mapping[str, Any]]]:
        """Go through what is said below a table: keys of texts, what fills them, values with units."""
        return ()

    def data(self, places: Any) -> Mapping[str, Any]:
        """Return what JSON has beside columns and extremes, SI."""
        return {}

    def outlines(self) -> Mapping[str, NDArray[Any]]:
        """Return the closed outlines of parts to be cut, by name: points, m, about the axis, chords within `FINE`."""
        return {}


def found_on(
    board: ExactBoard, program: Program, scales: Mapping[str, str], shown: Mapping[str, str] = {}
) -> dict[str, Any]:
    """Return what a program has given on a board, by fields of what is solved.

    The `scales` are symbols of scale factors by plan; `shown` are plans that show quantities which none is read from.
    """
    found = {name: getattr(board, name) for name in ("values", "sines", "status", "trouble")}
    drawn = {name: plan for name, plan in shown.items() if plan in program.plans}
    of_plan = {plan: scales[plan] for plan in program.plans if plan in scales}
    return {**found, "program": program, "scale_of_plan": of_plan, "shown_on": shown_on(program) | drawn}


def calculated(programs: Mapping[str, Iterable[Callable[[Board], None]]]) -> dict[str, str]:
    """Return in which section of a note every calculated quantity stands: that whose `programs` have its step.

    >>> calculated({"speeds": (lambda board: board.calc("v", "product", "omega", "r"),)})
    {'v': 'speeds'}
    """
    found: dict[str, str] = {}
    for section, parts in programs.items():
        found |= dict.fromkeys((step.name for step in recorded(*parts)), section)
    return found


def in_sections(results: Mapping[str, T], sections: Sequence[str], section_of: Callable[[str], str]) -> dict[str, T]:
    """Return results by name section by section, in each in the order that they have."""
    return {name: results[name] for name in sorted(results, key=lambda name: sections.index(section_of(name)))}
