"""Answers that are odd as a whole: exchanged columns, a wrong scale factor, those of another variant."""

from __future__ import annotations

from pathlib import Path

import pytest

from kulman import check
from kulman.variants.marking.answers import Answers

TASK = "nau-slider-crank"
HEAD = "величина;відрізок, мм;масштаб;значення;одиниця;напрям\n"


def read(tmp_path: Path, rows: str, variant: str = "example") -> Answers:
    """Return the answers of a form with these rows."""
    file = tmp_path / "answers.csv"
    file.write_text(HEAD + rows, encoding="utf-8")
    return check(TASK, variant).read(str(file))[0]


def test_columns_that_changed_places_are_put_back_by_scale_factors_in_rows_of_their_own(tmp_path: Path) -> None:
    scales, rows = "mu_V;;0,05;;;\nmu_a;;4;;;\n", "V_B;2,76;;55,2;;\nV_A;4;;80;;\nV_BA;2,1;;42;;\na_B;220;;55;;\n"
    lone = "omega_1;;;50;;-\na_A;50;;;;\nV_S2;3,26;;;;\n"  # a value, a segment, a value

    found = read(tmp_path, scales + rows + lone)

    assert found.lines["V_B"].mm == pytest.approx(55.2)
    assert found.lines["V_B"].value == pytest.approx(2.76)
    assert (found.lines["omega_1"].mm, found.lines["omega_1"].value) == (None, pytest.approx(50.0))
    assert (found.lines["a_A"].mm, found.lines["a_A"].value) == (pytest.approx(50.0), None)
    assert (found.lines["V_S2"].mm, found.lines["V_S2"].value) == (None, pytest.approx(3.26))
    assert "each other's place" in found.problems[0].text("en")
