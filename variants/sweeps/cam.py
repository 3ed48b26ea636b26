"""A cam over its turn: section lines as a table, points of the profiles as CSV, all of it as JSON."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...drawing.words import Words
from ...plans.cams.course import columns, cut_at, extremes, lines, profiles
from ...plans.cams.motion import TURN
from ...plans.cams.solve import SolvedCam
from ...plans.solved import Columned, Ends
from .sweeps import Rows, SizedSweep, degrees, millimetres

TABLED = ("phi", "s", "ds", "d2s", "v", "a", "psi", "theta", "gamma", "theta_rocker", "gamma_rocker")
UNDERCUT = "undercut"


class CamSweep(SizedSweep):
    """A cam over its turn; `positions` divide it evenly, None for the section lines in the table, degrees in files."""

    usual, not_drawn = 360, "cam-sweep-drawing"  # one place a degree

    @property
    def solved(self) -> SolvedCam:
        """The cam."""
        return SolvedCam.of(self.case.solved)

    def _places(self, count: int) -> Any:
        return TURN * (np.arange(count) / count)

    def _columns(self, places: Any) -> list[Columned]:
        return columns(self.solved, places)

    def _rows(self) -> Rows:
        """Return the motion on the section lines, both limits at jumps."""
        if self.positions is not None:
            heads, rows = super()._rows()
        else:
            found = lines(self.solved)
            heads, phi = [str(number) for number, *_ in found], np.array([phi for _, phi, _ in found])
            after = np.array([side > 0 for *_, side in found])
            before_and_after = zip(*(columns(self.solved, phi, side) for side in (-1, 1)), strict=True)
            rows = [Columned(b.name, b.unit, np.where(after, b.values, a.values)) for a, b in before_and_after]
        return heads, [column for column in rows if column.name in TABLED]

    def _extremes(self) -> list[Ends]:
        return extremes(self.solved)

    def _remarks(self, words: Words) -> list[str]:
        """Say where profiles are curved most."""
        said = []
        for curve, _, profile in profiles(self.solved):
            least = profile.sharpest
            place = {"rho": millimetres(least.value, words), "at": degrees(least.phi, words)}
            said.append(words[f"sweep.sharpest.{curve}"].format(**place))
        return ["\n".join((*said, *self._warned(words)))]

    def _states(self, places: Any) -> Mapping[str, Sequence[str]]:
        cuts = cut_at(self.solved, places)
        return {"status": [f"{UNDERCUT}: {followers}" if followers else "ok" for followers in cuts]}

    def _data(self) -> dict[str, Any]:
        """Return columns, extremes, the least radii of curvature, jumps and what an undercut profile loses."""
        every = profiles(self.solved)
        return super()._data() | {
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


SWEEP = CamSweep
