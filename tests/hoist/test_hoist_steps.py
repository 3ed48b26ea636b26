"""Notes and handouts of hoists: every step draws its part of a view, formulas with their numbers give the results."""

from __future__ import annotations

from functools import lru_cache
from itertools import chain

import pytest

from kulman import note
from kulman.drawing.handouts import begun_pages
from kulman.drawing.hoist.text import BENT, HANGING, LIFTED, RATES, REDUCED, SLACK, STARTED, TOLD_BY
from kulman.drawing.notes.blocks import Equations, Steps
from kulman.drawing.shapes import Line, Text
from kulman.plans.hoist.forces import forces
from kulman.plans.laws import form_of
from kulman.scales.packaged import packaged
from kulman.tests.support.cases import draw_case, solve_case
from kulman.tests.support.shapes import leaves
from kulman.variants.case import Case
from kulman.variants.sheets import Sheet

TASK = "karpenko-hoist"
MOVED = {"V_0": "4 m/s"}  # the load comes back on its support


@lru_cache(maxsize=4)
def drawn(variant: str, moved: bool = False) -> tuple[Case, Sheet]:
    case = solve_case(TASK, variant, MOVED if moved else None)
    return case, draw_case(case, "en")


def test_a_blank_has_axes_symbols_and_units_but_no_result() -> None:
    case, sheet = drawn("V04")
    shown = case.kind.begun(case, sheet.scales, case.words("en"), 0)
    blank = [*leaves(shape for page in begun_pages(sheet.pages, sheet.views, shown, 0) for shape in page.shapes)]
    said, results = {text.markup for text in blank if isinstance(text, Text)}, case.solved.quantities
    for name in ("t_1", "T_1", "P_12_max", "F_12_t1", "C_01", "C_12", "k", "R"):
        number = case.words("en").number(abs(results[name].value or 0.0), 3)[:5].rstrip(".")
        assert not [text for text in said if f"= {number}" in text or text == number], name
    assert not {"satisfied", "not satisfied"} & said
    assert {"t, s", "F, N", "P_{12}, N"} <= said
    roles = {line.role for line in blank if isinstance(line, Line)}
    assert {"axis", "division"} <= roles
    assert not {"level", "time", "projection", "deflection"} & roles
    head, *rows = next(view for view in sheet.views if view.name == "results").rows
    assert head[:3] == head[3:]
    for row in rows:  # symbol, number, unit, twice
        assert {row[0], row[3], row[2], row[5]} - {""} <= said
        assert not ({row[1], row[4]} & said) - {"0", "1", "1.25"}, row


def test_every_sentence_about_a_figure_is_that_of_a_stage() -> None:
    views = {view.name: view for moved in (False, True) for view in drawn("V04", moved)[1].views if view.stages}
    told = {key for moved in (False, True) for view in drawn("V04", moved)[1].views for key in view.stages.values()}
    prefixes = tuple(f"hoist.{name}." for name in views)

    assert {key for key in packaged("kulman.drawing.notes", "texts", "en") if key.startswith(prefixes)} == told - {""}


@pytest.mark.parametrize("variant", ["V01", "V03", "V04", "V09", "V10"])
def test_expressions_that_are_printed_give_the_results(variant: str) -> None:
    solved = solve_case(TASK, variant, {"slack": "0.03 m"}).solved
    found = {**solved.values, **forces(solved.givens).found}
    for told in (*REDUCED, SLACK, *LIFTED, *STARTED, *RATES, "D_1", "R", *HANGING, *BENT):
        step = solved.program.by_name[told]
        law, names = TOLD_BY.get(told) or (step.law, step.operands)
        value = form_of(law)(*(found[name] for name in names))
        assert value == pytest.approx(found[told], rel=1e-12, abs=1e-300), told


def test_what_a_hoist_has_not_is_not_told() -> None:
    def told(variant: str, **settings: str) -> str:
        blocks = note(TASK, variant, set=settings, lang="en").document.blocks
        lines = chain.from_iterable(block.lines for block in blocks if isinstance(block, Equations))
        steps = chain.from_iterable(block.texts for block in blocks if isinstance(block, Steps))
        return "\n".join([*map(" ".join, lines), *steps])

    rigid, moved, slack = told("V03", I_0="inf", I_2="inf"), told("V04", V_0="4 m/s"), told("V03", slack="0.03 m")
    assert "C_{01} = 3·E_{0}·I_{0}·α_{0}/l_{0}^{3} = ∞ N/m [1, (5)]" in rigid
    assert not [word for word in ("nan", "inf", "w_{0 max}", "V_{t} = √(") if word in rigid]
    assert "V_{t} = √(" in slack
    assert "The closed formulas are not valid here" in moved
    assert "P_{12 max} = P_{m} + R" not in moved
    assert "(11)" not in moved.partition("Divide")[0]
