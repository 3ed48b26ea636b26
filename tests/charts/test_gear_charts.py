"""The chart of gears: what hands make of the meshing at one scale after the other."""

from __future__ import annotations

import csv
import io
import json
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from kulman import chart, solve
from kulman.plans.gears.solve import RATIOS, USUAL, ScaleErrors, SolvedGear, compared, scale_errors
from kulman.plans.hands.shaky import PRESETS, Hand
from kulman.scales.errors import LANGUAGES, InputError

TASK = "madi-gear"


@pytest.fixture(scope="module")
def solved() -> SolvedGear:
    found = solve(TASK).solved
    assert isinstance(found, SolvedGear)
    return found


@pytest.fixture(scope="module")
def found(solved: SolvedGear) -> ScaleErrors:
    return scale_errors(solved, {name: preset.hand for name, preset in PRESETS.items()})


def test_errors_of_marks_fall_as_the_drawing_grows_and_those_of_directions_stay(solved: SolvedGear) -> None:
    hands = {"marks": Hand(0.2, 0.0, 0.2), "directions": Hand(0.0, 0.5, 0.0)}

    errors = scale_errors(solved, hands, ("g_alpha_drawn", "phi_alpha1_drawn")).errors

    for name in ("g_alpha_drawn", "phi_alpha1_drawn"):
        # the same errors at every scale: in millimetres of paper they are worth less the larger the drawing
        assert np.allclose(errors["marks", name] * RATIOS, errors["marks", name][-1] * RATIOS[-1], rtol=0.06)
        assert np.allclose(errors["directions", name], errors["directions", name][0], rtol=1e-9)


def test_better_hands_err_less_at_every_scale(found: ScaleErrors) -> None:
    assert found.quantities == USUAL
    for name in USUAL:
        columns = [found.errors[hand, name] for hand in ("cad", "careful", "normal", "lenient")]
        assert all(np.all(a < b) for a, b in pairwise(columns))
        assert all(np.all(np.diff(column) < 0.0) for column in columns)


def test_smallest_scale_that_is_enough_is_the_first_with_so_small_an_error(found: ScaleErrors) -> None:
    errors = found.errors["normal", "epsilon_alpha_drawn"]

    assert found.enough("normal", "epsilon_alpha_drawn", 0.05) == next(
        ratio for ratio, error in zip(RATIOS, errors.tolist(), strict=True) if error <= 0.05
    )
    assert found.enough("normal", "epsilon_alpha_drawn", 0.0) is None


def test_table_csv_json_and_pictures_tell_the_same(tmp_path: Path) -> None:
    charts = chart(TASK, lang="en", quantities="r_p1")

    rows = list(csv.reader(io.StringIO(charts["scale"].data(charts.words).csv())))
    data = json.loads(json.dumps(charts.to_json()))["scale"]

    assert len(rows) == 1 + len(PRESETS) * len(RATIOS) == 1 + len(data["errors"])
    for row, item in zip(rows[1:], data["errors"], strict=True):
        assert (row[0], float(row[1])) == (item["drawn_by"], item["scale"])
        assert float(row[5]) == pytest.approx(100.0 * item["error"], rel=1e-12)
    for language in LANGUAGES:
        assert all(
            f"{ratio:g}:1".replace(".", "," if language != "en" else ".") in charts.table(language) for ratio in RATIOS
        )
    (path,) = charts.save(tmp_path / "x.svg")
    assert path.stat().st_size > 10_000


def test_what_cannot_be_compared_is_refused(solved: SolvedGear) -> None:
    assert "g_alpha_drawn" in compared(solved)
    assert "g_alpha" not in compared(solved)
    with pytest.raises(InputError) as unknown:
        chart(TASK, quantities="g_alpha")
    with pytest.raises(InputError) as undrawn:
        chart(TASK, only="sliding")
    assert unknown.value.key.startswith("quantity-unknown")
    assert undrawn.value.key == "chart-no-meshing"
