"""What every chart is, what is asked of charts, and who makes those of a kind of tasks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

from ...drawing.words import Words
from .data import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Chart(Protocol):
    """One chart of a variant: a table, rows, data, a picture; `heading` is the key of what it shows."""

    heading: ClassVar[str]

    def table(self, words: Words) -> str:
        """Return it as text."""

    def csv(self, words: Words) -> bytes:
        """Return all its rows."""

    def to_json(self) -> dict[str, Any]:
        """Return it as data in SI."""

    def figure(self, words: Words) -> Figure:
        """Draw the picture."""


@dataclass(frozen=True, slots=True)
class ChartRequest:
    """What is asked of charts: quantities (none: all), positions of the cycle (None: the chart's own), per cent."""

    quantities: tuple[str, ...]
    positions: int | None
    tolerance: float


class Gallery(Protocol):
    """The charts that tasks of a kind have, and which of them each argument changes."""

    charts: ClassVar[tuple[str, ...]]
    used_by: ClassVar[Mapping[str, tuple[str, ...]]]

    def make(self, name: str, scene: Scene, asked: ChartRequest) -> Chart:
        """Make the chart `name`.

        Raises
        ------
        InputError
            The case cannot have it.
        """
