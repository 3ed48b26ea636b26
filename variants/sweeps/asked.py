"""What is asked of a sweep."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Asked:
    """Positions, points, where a driver begins and ends; None for what is not said."""

    positions: int | None
    points: str | Iterable[str] | None
    start: str | float | None
    end: str | float | None
