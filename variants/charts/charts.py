"""Charts of a task, those that its kind has: tables, files, JSON."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...drawing.charts.paper import SUFFIXES as PICTURES
from ...drawing.charts.paper import saved
from ...drawing.words import Words
from ...drawing.writers import save_all
from ...scales.arguments import of_kind
from ...scales.errors import InputError, KulmanError
from ...scales.numbers import quote
from ...scales.units import parse, unit
from ..case import Case, Settings, all_known, names_of, positions_of, solve_case
from ..task import LocatedError, Task
from .data import Chart, ChartRequest, Gallery, Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SUFFIXES = (*PICTURES, ".csv")
PAGED = ".pdf"  # one file holds all pictures
TOLERANCE = 1.0  # per cent
HAND = "normal"
WRONG = ("quantity-unknown", "quantity-unknown-like")  # what is wrong on every chart


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Charts:
    """Charts of one variant of a task, by name: of a linkage `accuracy`, `stability`, `depth`.

    `warnings` say which chart has been left out, and why, and what changes nothing on those that are wanted.
    """

    case: Case
    words: Words
    charts: dict[str, Chart]
    warnings: tuple[KulmanError, ...] = ()

    def __getitem__(self, name: str) -> Chart:
        """Return a chart by its name."""
        return self.charts[name]

    def table(self, language: str | None = None) -> str:
        """Return all charts as text."""
        words = self.words if language is None else self.words.speaking(language)
        parts = (f"{words[chart.heading]}\n\n{chart.table(words)}" for chart in self.charts.values())
        return "\n\n\n".join(parts)

    def to_json(self) -> dict[str, Any]:
        """Return what `kulman chart --json` prints: everything in SI."""
        head = {"task": self.case.task.id, "variant": self.case.variant}
        return head | {name: chart.to_json() for name, chart in self.charts.items()}

    def save(self, *paths: str | os.PathLike[str]) -> list[Path]:
        """Write the charts to each of `paths`; the suffix says how.

        A PDF has a page for each chart; of other kinds there is a file for each, `x-accuracy.svg`, `x-stability.svg`,
        `x-depth.svg`, or `x.svg` where there is one chart only.

        Returns
        -------
        list of Path
            The files written.

        Raises
        ------
        InputError
            An unknown suffix, two outputs of one name, or a file that cannot be written: then none is.
        """
        drawn = cache(self._figures)  # once for all files, and only where one of them shows it
        return save_all(paths, SUFFIXES, lambda path: self._files(path, drawn))

    def _figures(self) -> list[Figure]:
        return [chart.figure(self.words) for chart in self.charts.values()]

    def _files(self, path: Path, figures: Callable[[], Sequence[Figure]]) -> Iterator[tuple[Path, bytes]]:
        """Make the files that `path` stands for."""
        suffix = path.suffix.lower()
        names = list(self.charts)
        several = len(names) > 1 and suffix != PAGED
        targets = [path.with_name(f"{path.stem}-{name}{path.suffix}") for name in names] if several else [path]
        csv = [chart.csv(self.words) for chart in self.charts.values()] if suffix == ".csv" else None
        data = saved(figures(), suffix) if csv is None else csv
        yield from zip(targets, data, strict=True)

    def __repr__(self) -> str:
        """Return task, variant and the names of the charts."""
        return f"<Charts {self.case.task.id} {self.case.variant}: {', '.join(self.charts)}>"

    def _repr_html_(self) -> str:
        """Show the tables in a notebook."""
        from html import escape

        return f"<pre>{escape(self.table())}</pre>"


def chart(
    task: str | os.PathLike[str] | Task,
    variant: str | None = None,
    *,
    set: Settings | None = None,
    only: str | Iterable[str] | None = None,
    scales: Settings | None = None,
    chart: str | Iterable[str] | None = None,
    positions: int | None = None,
    quantities: str | Iterable[str] | None = None,
    tolerance: str | float = TOLERANCE,
    hand: str = HAND,
    notation: str | None = None,
    lang: str | None = None,
) -> Charts:
    """Measure one variant of a task.

    Parameters
    ----------
    task, variant, set, only, scales, notation, lang
        As for `solve`.
    chart : str or iterable of str, optional
        Of a linkage `accuracy`, `stability`, `depth`, of a cam `sections`, `accuracy`, `stability`, of gears
        `scale`, of a hoist `accuracy`, `stability`, `roots`, `depth`, `choice`; all when left out.
    positions : int, optional
        Positions of the cycle of a linkage that are looked at: 36 for `accuracy`, else 360 when left out.
    quantities : str or iterable of str, optional
        Names of quantities, `"V_B,a_B,M_bal"`; when left out all that can be compared, for `stability` of a linkage the
        motion of the output and what balances the driver.
    tolerance : str or number
        Per cent by which a simpler model may miss.
    hand : str
        Preset of the hand that draws: `cad`, `careful`, `normal`, `lenient`.

    Returns
    -------
    Charts

    Raises
    ------
    InputError
        As for `solve`; also an unknown chart, quantity or hand, a number of positions that makes no cycle.
    PositionError
        The mechanism cannot be assembled in any position.

    >>> from kulman.variants.charts.charts import chart
    >>> chart("nau-slider-crank", "example", chart="depth", positions=36)["depth"].found.needed
    ('F_i2', 'M_i2', 'F_i3')
    """
    case = solve_case(task, variant, set, only, scales)
    gallery = case.kind.gallery(case.task)
    names, wanted = names_of("chart", chart), names_of("quantities", quantities)
    all_known("chart-unknown", names, gallery.charts)
    if positions is not None:
        positions_of("positions", positions)
    most = _per_cent(tolerance)
    words = case.words(lang, notation)
    of_kind("hand", hand, (str,), "str")
    scene = Scene(case, words, hand)
    arguments = {"quantities": bool(wanted), "hand": hand != HAND, "tolerance": most != TOLERANCE}
    arguments["positions"] = positions is not None
    changed = [argument for argument, other in arguments.items() if other]
    made = names or gallery.charts
    used = {argument for argument, charts in gallery.used_by.items() if not frozenset(charts).isdisjoint(made)}
    unused = [InputError("chart-unused", name=one, charts=", ".join(made)) for one in changed if one not in used]
    found = _made(gallery, scene, names, ChartRequest(wanted, positions, most))
    return replace(found, warnings=(*unused, *found.warnings))


def _per_cent(tolerance: str | float) -> float:
    """Return a tolerance in per cent, zero or more."""
    of_kind("tolerance", tolerance, (str, int, float), "float")
    per_cent = unit("%")
    try:
        most = parse(tolerance, per_cent, per_cent) * 100.0 if isinstance(tolerance, str) else float(tolerance)
    except InputError as error:
        raise LocatedError("tolerance", error) from error
    if not (math.isfinite(most) and most >= 0.0):
        raise LocatedError("tolerance", InputError("negative", text=quote(tolerance)))
    return most


def _made(gallery: Gallery, scene: Scene, names: tuple[str, ...], asked: ChartRequest) -> Charts:
    """Make the charts; of all of them one that the task cannot have is left out."""
    charts: dict[str, Chart] = {}
    warnings: list[KulmanError] = []
    for name in names or gallery.charts:
        try:
            charts[name] = gallery.make(name, scene, asked)
        except InputError as error:
            if names or error.key in WRONG:
                raise
            warnings.append(error)
    if not charts:
        raise warnings[0]
    return Charts(scene.case, scene.words, charts, tuple(warnings))
