"""The sheet of all positions: their plans to one scale factor, and what is found over the cycle with its extremes."""

from __future__ import annotations

import math
import re
from functools import cache
from typing import Any

import numpy as np
import pytest
import shapely

from kulman import KulmanError, sheet, sweep
from kulman.tests.sheets.judge import overlaps
from kulman.tests.support.printed_numbers import half_digit, table, value
from kulman.tests.support.readback import Sheet, View, read
from kulman.variants.shelf import bundled

USUAL = ("nau-slider-crank",)
TASKS = [*USUAL, *(pytest.param(t, marks=pytest.mark.soak) for t in bundled("mechanism") if t not in USUAL)]
PLANS = ("velocity", "acceleration")
DOTS = 1e-3  # mm, the length of a vector that is no more than a point


@cache
def pages_of(task: str) -> tuple[str, ...]:
    made = sheet(task, positions=12)
    return tuple(made.svg(page + 1) for page in range(len(made.pages)))


@pytest.mark.parametrize("task", TASKS)
def test_a_sheet_of_positions_measures_what_the_sweep_says_and_nothing_touches(task: str) -> None:
    swept, made = sweep(task, positions=12), read(*pages_of(task))
    assert_plans(swept, made)
    assert_grid(made)
    assert_extremes(swept, made)
    assert [fault for fault in overlaps(made) if "_positions" in fault or "course" in fault] == []


@pytest.mark.parametrize("task", ["scheme-09-shaper", "scheme-13-toggle-press"])
def test_the_short_table_of_extremes_stands_on_one_page(task: str) -> None:
    tables = [view.name for page in pages_of(task) for view in read(page).views if view.name.startswith("extremes")]

    assert tables == ["extremes"]


def test_position_k_is_number_k_of_every_diagram() -> None:
    for task, turns in (("scheme-18-hydraulic-drive", False), ("nau-slider-crank", True)):
        swept, made = sweep(task, positions=12), read(*pages_of(task))
        times, known = [float(t) for t in swept["t"]], [str(k) for k in range(12 + turns)]
        for view in (view for view in made.views if view.name == "diagrams" or view.name.startswith("course_")):
            marks = [text for text in view.texts if text.string in known]
            first = marks[: len(known)]  # of the first diagram; beside its rays the numbers stand once more
            at = [0.5 * (text.box[0] + text.box[2]) for text in first]
            assert [text.string for text in first] == known, view.name
            section = (at[5] - at[0]) / 5
            assert np.diff(at) == pytest.approx(section, abs=4.0)  # the last one may give way to the letter of the axis
            if view.name == "diagrams":
                (mu,) = re.findall(r"μ_\{t\} = ([\d,]+)", " ".join(text.string for text in view.texts))
                assert section * value(mu) == pytest.approx(times[1], rel=0.01)


def assert_plans(swept: Any, made: Sheet) -> None:
    """Assert that the vectors of all plans are to one scale factor what the sweep says of the positions."""
    for plan in PLANS:
        view = made[f"{plan}_positions"]
        sizes: dict[str, list[float]] = {}
        for vector in view.vectors:
            assert abs(vector.span) * vector.mu == pytest.approx(vector.value, abs=0.01 * vector.mu), vector.quantity
            sizes.setdefault(vector.quantity, []).append(vector.value)
        assert len({vector.mu for vector in view.vectors}) == 1
        (mu,) = {vector.mu for vector in view.vectors}
        for name, found in sizes.items():
            if name in swept:
                known = np.abs(np.asarray(swept[name]))
                known = known[np.isfinite(known) & (known > DOTS * mu)]
                left = len(known) - len(found)
                # where it grows without limit a position is left out
                assert left <= 0 or (left <= 2 and any("без положень" in t.string for t in view.texts)), name
                usual = sorted(known)[: len(known) - max(left, 0)]
                assert sorted(v for v in found if v > DOTS * mu) == pytest.approx(usual, rel=1e-9), name


def assert_grid(made: Sheet) -> None:
    """Assert that the plans of each kind stand apart, in order on rows and columns, with their middles on these."""
    for plan in PLANS:
        view = made[f"{plan}_positions"]
        poles = [ring.centre for ring in view.rings if ring.radius > 0.4]
        lines = shapely.unary_union([shapely.LineString([(z.real, z.imag) for z in v]) for v in _ends(view)]).buffer(
            1.0
        )
        boxes = [next(g for g in lines.geoms if g.distance(shapely.Point(p.real, p.imag)) < 1.0).bounds for p in poles]
        columns, rows = ({round((box[i] + box[i + 2]) / 2) for box in boxes} for i in (0, 1))
        assert len(lines.geoms) == len(poles) > 8
        assert len(columns) * (len(rows) - 1) < len(poles) <= len(columns) * len(rows)


def _ends(view: View) -> list[tuple[complex, complex]]:
    return [(vector.tail, vector.tip) for vector in view.vectors]


def assert_extremes(swept: Any, made: Sheet) -> None:
    """Assert that the extremes of what is drawn over the cycle are printed, but those without a limit."""
    views = [view for view in made.views if view.name.startswith("course_")]
    rows = table(made["extremes"])
    assert views
    for view in views:
        said = [text.string for text in view.texts if text.role == "label"]
        for name in {stroke.name for stroke in view.strokes if stroke.role == "curve"} & {*swept}:
            known = np.asarray(swept[name])
            bounded = 8.0 * float(np.nanmedian(np.abs(known)))
            for end in swept.cycle.extremes([name])[name]:
                assert any(shows(text, end.value) for text in said) or abs(end.value) > bounded, (name, end.value, said)
                assert any(shows(cell, end.value) for row in rows for cell in row), name


def shows(text: str, number: float) -> bool:
    if "∞" in text or math.isinf(number):
        return text == ("∞" if number > 0.0 else "−∞")
    try:
        return abs(value(text) - number) <= half_digit(text)
    except (ValueError, IndexError):
        return False


def test_only_linkages_have_positions_and_three_at_least() -> None:
    with pytest.raises(KulmanError, match="positions is not available"):
        sheet("madi-gear", positions=12)
    with pytest.raises(KulmanError, match="positions"):
        sheet("nau-slider-crank", positions=2)


def test_a_sheet_of_positions_has_a_number_of_its_own_and_no_code() -> None:
    usual, own = sheet("nau-slider-crank").svg(), pages_of("nau-slider-crank")[0]
    assert ".001" in usual
    assert ".101" in own
    assert "Код аркуша" in usual
    assert "Код аркуша" not in own
