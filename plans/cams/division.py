"""How the turn of a cam is divided for its drawing: section lines, numbered from the start of the rise."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise


@dataclass(frozen=True, slots=True)
class Division:
    """Numbers of section lines: the rise runs from 0 to `top`, the upper dwell to `leave`, the fall to `last`.

    The lower dwell is the rest of the turn; nothing changes in it, so that it has no sections. `jumps` are the lines
    within a phase at which the acceleration jumps.
    """

    top: int
    leave: int
    last: int
    jumps: tuple[int, ...] = ()

    @property
    def lines(self) -> range:
        """All section lines."""
        return range(self.last + 1)

    @property
    def sections(self) -> range:
        """All sections; each has the number of the line at its end."""
        return range(1, self.last + 1)

    @property
    def rise(self) -> range:
        """Lines of the rise, both ends among them."""
        return range(self.top + 1)

    @property
    def fall(self) -> range:
        """Lines of the fall, both ends among them."""
        return range(self.leave, self.last + 1)

    def pieces(self, phase: str) -> tuple[range, ...]:
        """Return the lines of the `rise` or the `fall`, between jumps: of each piece both ends are among them."""
        lines = self.rise if phase == "rise" else self.fall
        ends = sorted({lines[0], *(line for line in self.jumps if line in lines), lines[-1]})
        return tuple(range(a, b + 1) for a, b in pairwise(ends))
