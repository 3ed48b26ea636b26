"""A cam over its turn: section lines as a table, points of the profiles as CSV, all of it as JSON."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...drawing.words import Words
from ...drawing.writers import Files, save_all
from ...plans.cams.course import columns, cut_at, extremes, lines, sharpest, undercuts
from ...plans.cams.motion import TURN
from ...plans.cams.solve import SolvedCam
from ...plans.columned import Columned
from ...scales.errors import InputError, PositionError
from ...scales.units import format_unit, unit
from ..case import Case
from ..kinds.cam import cam
from ..tables import Cell, csv_bytes, csv_text
from .asked import Asked, OfCase
from .data import numbers
from .sized import DIGITS, column_table, csv_head, degrees, extremes_table, in_degrees_and_millimetres

POSITIONS = 360  # of the files: one a degree
TABLED = ("phi", "s", "ds", "d2s", "v", "a", "psi", "theta", "gamma", "theta_rocker", "gamma_rocker")
SUFFIXES = (".csv",)
OK, UNDERCUT = "ok", "undercut"


@dataclass(frozen=True, slots=True, repr=False)
class CamSweep(OfCase):
    """A cam over its turn; `positions` divide it evenly, None for the section lines in the table, degrees in files."""

    solved: SolvedCam
    words: Words
    positions: int | None

    @property
    def status(self) -> str:
        """`ok`: a cam that is solved turns round."""
        return OK

    @property
    def reason(self) -> PositionError | None:
        """None: a cam that is solved turns round."""
        return None

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
            _profiles(self.case, self.solved, words),
        ]
        return "\n\n".join(part for part in parts if part)

    def csv(self, language: str | None = None) -> str:
        """Return all columns as CSV: for `uk` and `ru` with `;` and decimal commas, for `en` with `,` and points."""
        words, phi = self._words(language), self._angles()
        shown = [in_degrees_and_millimetres(column) for column in columns(self.solved, phi)]
        head = ["k", *csv_head(shown, words), "status"]
        cut = cut_at(self.solved, phi)
        status = [f"{UNDERCUT}: {followers}" if followers else OK for followers in cut]
        rows: list[list[Cell]] = [
            [k, *(float(column.values[k]) for column in shown), said] for k, said in enumerate(status)
        ]
        return csv_text(head, rows, words.language)

    def to_json(self) -> dict[str, Any]:
        """Return what `kulman sweep --json` prints: everything in SI."""
        found = columns(self.solved, self._angles())
        return {
            "task": self.task.id,
            "variant": self.variant,
            "status": self.status,
            "columns": {column.name: {"unit": column.unit, "value": numbers(column.values)} for column in found},
            "extremes": {
                e.name: {
                    "unit": e.unit,
                    "max": {"value": e.most, "at": e.most_at},
                    "min": {"value": e.least, "at": e.least_at},
                }
                for e in extremes(self.solved)
            },
            "rho_min": {one.curve: {"value": one.rho, "at": one.phi} for one in sharpest(self.solved)},
            "jumps": [
                {"at": jump.phi, "of": "ds" if jump.order == 1 else "d2s", "before": jump.before, "after": jump.after}
                for jump in self.solved.motion.jumps
            ],
            "undercut": [
                {"follower": follower, "from": cut.start, "to": cut.end, "lost": cut.lost, "at": cut.phi_lost}
                for follower, cut in undercuts(self.solved)
            ],
        }

    def save(self, *paths: str | os.PathLike[str]) -> list[Path]:
        """Write the columns to each of `paths`.

        Raises
        ------
        InputError
            A file that is not a .csv: the drawing of a cam is its sheet.
        """

        def files(path: Path) -> Files:
            return [(path, csv_bytes(self.csv(), self.words.language))]

        for path in map(Path, paths):
            if path.suffix.lower() not in SUFFIXES:
                raise InputError("cam-sweep-drawing", task=self.task.id, file=path.name)
        return save_all(paths, SUFFIXES, files)

    def _angles(self) -> Any:
        count = self.positions or POSITIONS
        return TURN * (np.arange(count) / count)

    def __repr__(self) -> str:
        """Return task, variant and the number of positions."""
        return f"<CamSweep {self.task.id} {self.variant}: {self.positions or POSITIONS} positions>"

    def _repr_html_(self) -> str:
        """Show the table in a notebook."""
        from html import escape

        return f"<pre>{escape(self.table())}</pre>"

    def _words(self, language: str | None) -> Words:
        return self.words if language is None else self.words.speaking(language)


def _joined(solved: SolvedCam, places: list[tuple[float, int]]) -> list[Columned]:
    """Return the columns at places, each a limit from its side."""
    phi = np.array([at for at, _ in places])
    left, right = (columns(solved, phi, side) for side in (-1, 1))
    after = np.array([side > 0 for _, side in places])
    return [Columned(b.name, b.unit, np.where(after, b.values, a.values)) for a, b in zip(left, right, strict=True)]


def _profiles(case: Case, solved: SolvedCam, words: Words) -> str:
    """Say where profiles are curved most, and what a user should know of them."""
    millimetre = unit("mm")
    said = []
    for one in sharpest(solved):
        rho = f"{words.short(millimetre.from_si(one.rho), DIGITS)} {format_unit('mm', words.language)}"
        said.append(words[f"sweep.sharpest.{one.curve}"].format(rho=rho, at=degrees(one.phi, words)))
    return "\n".join((*said, *(warning.text(words.language) for warning in case.warnings)))


def cam_sweep(case: Case, words: Words, asked: Asked) -> CamSweep:
    """Look at a cam over its turn.

    Raises
    ------
    InputError
        Points, a beginning or end of the motion, or chords are asked for: a cam has none; its diagrams by chords are
        on its sheet, their errors in its chart.
    """
    unused = {"--points": asked.points, "--from": asked.start, "--to": asked.end, "--chords": asked.chords}
    for option, value in unused.items():
        if value is not None:
            raise InputError("kind-without", task=case.task.id, text=option)
    return CamSweep(case, cam(case.solved), words, asked.positions)
