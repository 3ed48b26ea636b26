"""A cam over its turn: section lines as a table, points of the profiles as CSV, all of it as JSON."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...drawing.words import Words
from ...plans.cams.course import columns, cut_at, extremes, lines, profiles
from ...plans.cams.motion import TURN
from ...plans.cams.solve import SolvedCam
from ...plans.solved import Columned
from .sweeps import (
    SizedSweep,
    column_table,
    columns_csv,
    columns_json,
    degrees,
    extremes_json,
    extremes_table,
    millimetres,
)

TABLED = ("phi", "s", "ds", "d2s", "v", "a", "psi", "theta", "gamma", "theta_rocker", "gamma_rocker")
UNDERCUT = "undercut"


@dataclass(frozen=True, slots=True, repr=False)
class CamSweep(SizedSweep):
    """A cam over its turn; `positions` divide it evenly, None for the section lines in the table, degrees in files."""

    usual, not_drawn = 360, "cam-sweep-drawing"  # one place a degree

    @property
    def solved(self) -> SolvedCam:
        """The cam."""
        return SolvedCam.of(self.case.solved)

    def table(self, language: str | None = None) -> str:
        """Return the motion on the section lines, both limits at jumps, then extremes and the least radii."""
        words = self._words(language)
        if self.positions is None:
            found = lines(self.solved)
            rows = _joined(self.solved, [(phi, side) for _, phi, side in found])
            heads = [str(number) for number, _, _ in found]
        else:
            rows = columns(self.solved, self._angles())
            heads = [str(k) for k in range(self.positions)]
        parts = [
            column_table([column for column in rows if column.name in TABLED], heads, words),
            extremes_table(extremes(self.solved), words),
            "\n".join((*self._sharpest(words), *self._warned(words))),
        ]
        return "\n\n".join(part for part in parts if part)

    def _sharpest(self, words: Words) -> Iterator[str]:
        """Say where profiles are curved most."""
        for curve, _, profile in profiles(self.solved):
            least = profile.sharpest
            said = {"rho": millimetres(least.value, words), "at": degrees(least.phi, words)}
            yield words[f"sweep.sharpest.{curve}"].format(**said)

    def csv(self, language: str | None = None) -> str:
        """Return all columns as CSV."""
        phi = self._angles()
        status = [f"{UNDERCUT}: {followers}" if followers else "ok" for followers in cut_at(self.solved, phi)]
        return columns_csv(columns(self.solved, phi), self._words(language), {"status": status})

    def _data(self) -> dict[str, Any]:
        """Return columns, extremes, the least radii of curvature, jumps and what an undercut profile loses."""
        every = profiles(self.solved)
        return {
            "columns": columns_json(columns(self.solved, self._angles())),
            "extremes": extremes_json(extremes(self.solved)),
            "rho_min": {curve: {"value": p.sharpest.value, "at": p.sharpest.phi} for curve, _, p in every},
            "jumps": [
                {"at": jump.phi, "of": "ds" if jump.order == 1 else "d2s", "before": jump.before, "after": jump.after}
                for jump in self.solved.motion.jumps
            ],
            "undercut": [
                {"follower": follower, "from": cut.start, "to": cut.end, "lost": cut.lost, "at": cut.phi_lost}
                for _, follower, profile in every
                for cut in profile.undercuts
            ],
        }

    def _angles(self) -> Any:
        return TURN * (np.arange(self.count) / self.count)


def _joined(solved: SolvedCam, places: list[tuple[float, int]]) -> list[Columned]:
    """Return the columns at places, each a limit from its side."""
    phi = np.array([at for at, _ in places])
    left, right = (columns(solved, phi, side) for side in (-1, 1))
    after = np.array([side > 0 for _, side in places])
    return [Columned(b.name, b.unit, np.where(after, b.values, a.values)) for a, b in zip(left, right, strict=True)]


SWEEP = CamSweep
