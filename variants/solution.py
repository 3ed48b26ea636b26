"""A task solved: quantities by name, their scale factors, status and reason, as JSON and as a table."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..drawing.linkages.ladders import first_scales
from ..drawing.linkages.scene import Given
from ..drawing.words import Words
from ..plans.linkages.chain import PLANS
from ..plans.linkages.solved import Solved, solve_linkage
from ..plans.quantities import Quantity, measured
from ..scales.choose import Chooser, chooser, segment_symbol
from ..scales.errors import InputError, PositionError
from ..scales.scale import Scale
from .reader import load_task
from .task import LocatedError, Task, unknown

DRAWN_ANGLE = math.radians(20.0)  # lines that meet at a smaller angle make a drawing lose digits
Settings = Mapping[str, str | float]


@dataclass(frozen=True, slots=True)
class Solution:
    """The answer to one variant of a task.

    `solution["V_B"]` is a `Quantity`; `reason` says why a position has no plan.
    """

    task: Task
    variant: str
    solved: Solved
    quantities: Mapping[str, Quantity]
    scales: Mapping[str, Scale]
    reason: PositionError | None
    warnings: tuple[InputError, ...]
    words: Words

    @property
    def status(self) -> str:
        """`ok`, `ill-conditioned`, `singular` or `no-assembly`."""
        return self.solved.status

    def __getitem__(self, name: str) -> Quantity:
        """Return a quantity by its name."""
        if name not in self.quantities:
            raise unknown("quantity-unknown", name, self.quantities)
        return self.quantities[name]

    def to_json(self) -> dict[str, Any]:
        """Return what `kulman solve --json` prints."""
        return {
            "task": self.task.id,
            "variant": self.variant,
            "status": self.status,
            "warnings": [warning.text(self.words.language) for warning in self.warnings],
            "checks": self._checks(),
            "scales": {s.symbol: {"value": s.mu, "unit": s.per_mm_unit} for s in self.scales.values()},
            "quantities": {name: quantity.to_json() for name, quantity in self.quantities.items()},
        }

    def _checks(self) -> dict[str, dict[str, Any]]:
        delta = self.quantities.get("delta_M_bal")
        if delta is None or delta.value is None:
            return {}
        return {"lever": {"ok": abs(delta.value) < 1e-6, "value": delta.value, "unit": "%"}}

    def table(self, language: str | None = None) -> str:
        """Return the quantities as a readable table."""
        words = self.words if language is None else Words.of(language, self.task.notation)
        rows = [_row(words, quantity) for quantity in self.quantities.values()]
        widths = [max(len(row[i]) for row in rows) for i in range(5)]
        lines = [
            "  ".join(
                [row[0].ljust(widths[0]), *(cell.rjust(w) for cell, w in zip(row[1:3], widths[1:3], strict=True))]
            ).rstrip()
            + f" {row[3]:{widths[3]}}  {row[4]}".rstrip()
            for row in rows
        ]
        return "\n".join(line.rstrip() for line in lines)

    def _repr_svg_(self) -> str:
        """Show the sheet in a notebook."""
        from .sheets import sheet

        return sheet(self.task, self.variant).svg()


def _row(words: Words, q: Quantity) -> tuple[str, str, str, str, str]:
    unit = words.unit(q.unit).replace("^{2}", "²").replace("^{−1}", "⁻¹").replace("^{−2}", "⁻²")
    if q.kind == "point":
        place = "–" if q.x is None or q.y is None else f"({words.short(q.x, 6)}; {words.short(q.y, 6)})"
        return q.name, place, unit, "", ""
    value = "–" if q.value is None else words.short(q.value, 6)
    if q.kind == "vector" and q.x is not None and q.y is not None:
        components = f"({words.short(q.x, 6)}; {words.short(q.y, 6)})"
    else:
        components = ""
    mm = "" if q.mm is None else f"{words.short(round(q.mm, 2))} {words['unit.mm']}"
    return q.name, value, unit, components, mm


def read_choosers(task: Task, scales: Settings | None, solved: Solved) -> dict[str, Chooser]:
    """Return how each scale factor is chosen: as the task says, unless the user says otherwise."""
    choosers = {symbol: chooser(symbol, text) for symbol, text in task.scales.items()}
    structure = solved.structure
    known = [
        "mu_l",
        "mu_V",
        "mu_a",
        *(f"mu_F_{name}" for name in (structure.driver, *(g.name for g in structure.groups))),
    ]
    for name, text in (scales or {}).items():
        if name.startswith("mu_") and name not in known:
            raise unknown("scale-unknown", name, known, task=task.id)
        try:
            symbol = name if name.startswith("mu_") else segment_symbol(name)
            choosers[symbol] = chooser(symbol, str(text) if symbol == name else f"{name}={text}", firm=True)
        except InputError as error:
            raise LocatedError(name, error) from error
    return choosers


def solve_variant(
    task: str | os.PathLike[str] | Task,
    variant: str | None = None,
    settings: Settings | None = None,
    only: Sequence[str] | None = None,
) -> tuple[Task, str, Solved]:
    """Read a task and solve one variant for the plans wanted."""
    task = task if isinstance(task, Task) else load_task(task)
    row = task.variant(variant)
    plans = tuple(only or task.plans)
    for plan in plans:
        if plan not in PLANS:
            raise unknown("plan-unknown", plan, PLANS)
    return task, row.id, solve_linkage(task.mechanism, task.values(row.id, settings), plans)


def solve(
    task: str | os.PathLike[str] | Task,
    variant: str | None = None,
    *,
    set: Settings | None = None,
    only: Sequence[str] | None = None,
    scales: Settings | None = None,
    notation: str | None = None,
    lang: str | None = None,
) -> Solution:
    """Solve one variant of a task.

    Parameters
    ----------
    task : str, path or Task
        A bundled id such as `nau-slider-crank`, or a TOML file.
    variant : str, optional
        Without it the first variant.
    set : mapping, optional
        Other values for givens: `{"l_OA": "55 mm", "n_1": 765}`.
    only : sequence of str, optional
        The plans wanted, `["velocity"]`; only they and what they need are built.
    scales : mapping, optional
        Scale factors: `{"mu_V": 0.05}` or a segment in mm, `{"pa": 80}`.
    notation, lang : str, optional
        Notation profile and language of the words.

    Returns
    -------
    Solution
        Also for a position without a plan: then `status` and `reason` say so.

    Raises
    ------
    InputError
        An unknown task, variant, given, plan, scale factor, language or notation, or a value of the wrong kind.

    >>> from kulman import solve
    >>> round(solve("nau-slider-crank", "example")["V_B"].value, 4)
    2.7614
    """
    found, name, solved = solve_variant(task, variant, set, only)
    words = Words.of(lang or "en", notation or found.notation)
    choosers = read_choosers(found, scales, solved)
    by_plan = first_scales(solved, choosers) if solved.trouble is None else {}
    items = measured(solved.quantities, solved.shown_on, by_plan)
    used = {scale.symbol: scale for scale in by_plan.values()}
    return Solution(found, name, solved, items, used, solved.error(), warnings_of(solved), words)


def warnings_of(solved: Solved) -> tuple[InputError, ...]:
    """Return what a user should know of a position that has a plan: lines that meet at a small angle."""
    if solved.trouble is not None:
        return ()
    mark, sine = solved.worst_sine()
    if sine >= math.sin(DRAWN_ANGLE):
        return ()
    point = mark.rpartition(".")[2]
    angle = math.degrees(math.asin(sine))
    return (InputError("small-angle", point=point, angle=f"{angle:.3g}", loss=f"{1.0 / sine:.3g}"),)


def givens_of(task: Task, variant: str, settings: Settings | None) -> dict[str, Given]:
    """Return the givens of a variant as the task states them, each in its own unit."""
    stated = {}
    for name, value in task.resolve(variant, settings).items():
        unit = task.givens[name].unit
        if isinstance(value, str) or unit is None:
            stated[name] = Given(str(value))
        else:
            stated[name] = Given(float(f"{unit.from_si(value):.12g}"), unit.name)
    return stated
