"""Forces of very different size on one plan: the small ones stand in insets, enlarged, and can be measured there."""

from __future__ import annotations

import pytest

from kulman.drawing.formats import STYLES
from kulman.tests.support.linkage_cases import Linkage
from kulman.tests.support.printed_numbers import numbers_of, table
from kulman.tests.support.readback import View
from kulman.tests.support.sheet_geometry import NEAR, parallel

ARROW = STYLES["A1"].arrow
NUMERALS = ("I", "II", "III", "IV", "V")
CASES = [
    Linkage("scheme-13-toggle-press", "1", format="A1"),
    pytest.param(Linkage("scheme-18-hydraulic-drive", "1", format="A1"), marks=pytest.mark.soak),
    pytest.param(Linkage("scheme-20-press-automaton", "1", format="A1"), marks=pytest.mark.soak),
]


def plans(case: Linkage) -> list[View]:
    return [view for view in case.sheet.views if view.name.startswith("forces_")]


@pytest.mark.parametrize("case", CASES, ids=str)
def test_at_most_one_force_of_a_plan_is_a_point(case: Linkage) -> None:
    for plan in plans(case):
        enlarged = {v.quantity for inset in plan.insets for v in inset.vectors if abs(v.span) >= ARROW}
        short = {v.quantity for v in plan.vectors if NEAR < abs(v.span) < ARROW}
        assert len(short - enlarged) <= 1, plan.name


@pytest.mark.parametrize("case", CASES, ids=str)
def test_insets_measure_what_the_plan_shows(case: Linkage) -> None:
    assert [inset for plan in plans(case) for inset in plan.insets]
    for plan in plans(case):
        for inset in plan.insets:
            (heading,) = [text.string for text in inset.of("heading")]
            mu = numbers_of(heading.partition("=")[2], case.lang)[0]
            for vector in inset.vectors:
                drawn = plan.vector(vector.quantity)
                assert vector.mu == pytest.approx(mu)
                assert abs(vector.span) * mu == pytest.approx(drawn.value, abs=NEAR * mu)
                assert vector.value == drawn.value
                assert abs(drawn.span) < NEAR or parallel(vector.span, drawn.span, 0.01)


@pytest.mark.parametrize("case", CASES, ids=str)
def test_every_inset_has_its_frame_in_the_plan_or_in_a_coarser_inset(case: Linkage) -> None:
    for plan in plans(case):
        frames = [s.name for view in (plan, *plan.insets) for s in view.lines("window")]
        assert sorted(frames) == sorted(inset.name for inset in plan.insets)
        assert len([t for view in (plan, *plan.insets) for t in view.of("label") if t.string in NUMERALS]) == len(
            frames
        )


@pytest.mark.parametrize("case", CASES, ids=str)
def test_tables_give_the_millimetres_of_the_insets(case: Linkage) -> None:
    rows = [row for view in case.sheet.views if view.name.startswith("results_forces") for row in table(view)]
    read = [(numbers_of(row[1], case.lang), numbers_of(row[2], case.lang)) for row in rows]
    found = {(mm[0], mu[0]) for mm, mu in read if mm and mu}

    for plan in plans(case):
        for name in ("F_i2", "F_i3", "F_i4", "R_12_t", "R_34_t", "G_2", "G_4"):
            here = [v for inset in plan.insets for v in inset.vectors if v.quantity == name and abs(v.span) >= ARROW]
            if here and abs(plan.vector(name).span) < ARROW:
                assert any((round(abs(v.span), 2), v.mu) in found for v in here), name
