"""What is looked at over a motion, column by column, and the extremes of a column."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray


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
