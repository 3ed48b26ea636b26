"""Cases as tests want them: solved, and drawn in a language; what a sheet draws beside what is solved."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any

import pytest

import kulman
from kulman.drawing.shapes import Group, Shape, Vector
from kulman.variants.case import Case, Request, Settings
from kulman.variants.reader import load_task
from kulman.variants.sheets import Sheet
from kulman.variants.sheets import draw_case as drawn
from kulman.variants.solution import Solution
from kulman.variants.task import Task

SAME = 0.01  # mm


def some(cases: Iterable[Any], *now: int) -> list[Any]:
    """Return the cases of one law as parameters: those at these places run by default, the others in the soak.

    A tuple is the arguments of a case.
    """
    params = []
    for at, case in enumerate(cases):
        values = case if isinstance(case, tuple) else (case,)
        made = case if hasattr(case, "marks") else pytest.param(*values)
        late = [] if at in now else [pytest.mark.soak]
        params.append(pytest.param(*made.values, marks=[*made.marks, *late], id=made.id))
    return params


def solve_case(
    task: str | os.PathLike[str] | Task,
    variant: str | None = None,
    settings: Settings | None = None,
    only: str | Iterable[str] | None = None,
    scales: Settings | None = None,
) -> Case:
    return Request(load_task(task), variant, settings, only, scales).case()


def draw_case(case: Case, lang: str) -> Sheet:
    return drawn(replace(case, language=lang))


def vectors(shapes: tuple[Shape, ...]) -> Iterator[Vector]:
    for shape in shapes:
        if isinstance(shape, Vector):
            yield shape
        elif isinstance(shape, Group):
            yield from vectors(shape.shapes)


def lengths(sheet: Sheet) -> dict[str, list[float]]:
    """Return how long each quantity is drawn, on its plan and in insets."""
    found: dict[str, list[float]] = {}
    for page in sheet.pages:
        for vector in vectors(page.shapes):
            assert abs(vector.tip - vector.tail) == pytest.approx(vector.value / vector.mu, abs=1e-6)
            found.setdefault(vector.quantity, []).append(vector.value / vector.mu)
    return found


def mus(of: Sheet | Solution) -> dict[str, float]:
    return {scale.symbol: scale.mu for scale in of.scales.values()}


def other_lengths(solution: Solution, sheet: Sheet) -> dict[str, object]:
    """Return the quantities that a sheet draws as no such segments as are solved."""
    drawn, items = lengths(sheet), solution.to_json()["quantities"]
    shown = {name: items[name]["mm"] for name in drawn if items.get(name, {}).get("mm")}
    assert shown or solution.task.kind != "mechanism"
    return {n: (mm, drawn[n]) for n, mm in shown.items() if all(abs(mm - length) > SAME for length in drawn[n])}


def same_scales(solution: Solution, sheet: Sheet) -> bool:
    drawn = mus(sheet)
    return all(drawn[symbol] == mu for symbol, mu in mus(solution).items())


def as_drawn(solution: Solution, sheet: Sheet) -> Solution:
    """What a sheet shows: what is solved, or, where it is smaller so as to have no more pages and says so, on it."""
    if same_scales(solution, sheet):
        return solution
    (warning,) = [warning for warning in sheet.warnings if warning.key.startswith("scales-")]
    changed = {symbol for symbol, mu in mus(solution).items() if mu != mus(sheet)[symbol]}
    assert set(re.findall(r"mu_\w+", warning.text("en"))) == changed
    return kulman.solve(solution.task.id, solution.variant, format=sheet.format)
