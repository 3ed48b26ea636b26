"""Pages of a sheet: fixed scale factors are kept, views stand in reading order, pages are well used."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import pytest

import kulman
from kulman.drawing.page import Page, extent
from kulman.drawing.shapes import Group
from kulman.scales.errors import InputError
from kulman.variants.sheets import Sheet
from kulman.variants.solution import Solution

MADI = {"mu_l": 0.0025, "mu_V": 0.189, "mu_a": 21.318, "mu_F_23": 33.154, "mu_F_1": 54.373}
KINEMATICS = {"givens", "structure", "position", "velocity", "acceleration", "equations_kinematics"}


def mus(drawn: Sheet) -> dict[str, float]:
    return {scale.symbol: scale.mu for scale in drawn.scales.values()}


def mus_of(solved: Solution) -> dict[str, float]:
    return {symbol: scale.mu for symbol, scale in solved.scales.items()}


def views(page: Page) -> Iterator[Group]:
    yield from (shape for shape in page.shapes if isinstance(shape, Group) and shape.role == "view")


def used(page: Page) -> float:
    """Part of the page that the boxes of its views cover."""
    boxes = [extent(view.shapes) for view in views(page)]
    return sum((c - a) * (d - b) for a, b, c, d in boxes) / (page.width * page.height)


def test_scale_factors_that_the_task_fixes_are_kept() -> None:
    drawn = kulman.sheet("madi-four-bar")

    assert mus(drawn) == MADI
    assert drawn.warnings == ()


@pytest.mark.parametrize(("symbol", "mu"), [("mu_F_23", 15.0), pytest.param("mu_a", 8.0, marks=pytest.mark.soak)])
def test_scale_factors_that_the_user_fixes_are_kept_on_more_pages(symbol: str, mu: float) -> None:
    drawn = kulman.sheet("madi-four-bar", scales={symbol: mu}, format="A1")

    assert mus(drawn) == {**MADI, symbol: mu}
    assert len(drawn.pages) == 2


def test_a_fixed_scale_factor_takes_a_larger_format_where_none_is_asked_for() -> None:
    drawn = kulman.sheet("nau-slider-crank", only="velocity", scales={"mu_V": 0.015})

    assert mus(drawn)["mu_V"] == 0.015
    assert drawn.format != "A4"


def test_a_plan_too_large_for_the_first_page_stands_on_the_second() -> None:
    drawn = kulman.sheet("nau-slider-crank", only="velocity", scales={"mu_V": 0.02}, format="A4")

    assert mus(drawn)["mu_V"] == 0.02
    assert "velocity" not in {view.name for view in views(drawn.pages[0])}


def test_compound_motion_is_drawn_on_pages_of_any_format() -> None:
    drawn = kulman.sheet("bertyaev-six-bar", only="compound", format="A4")

    assert len(drawn.pages) > 3
    assert {error.key for error in drawn.warnings} == {"scale-coarser"}


def test_a_plan_that_fits_on_no_page_is_refused() -> None:
    with pytest.raises(InputError) as caught:
        kulman.sheet("nau-slider-crank", only="velocity", scales={"mu_V": 0.006}, format="A4")

    assert caught.value.key == "plan-too-large-everywhere"


@lru_cache
def two_pages(task: str) -> Sheet:
    return kulman.sheet(task, "6", format="A1")


@pytest.mark.parametrize(
    "task", ["scheme-10-shaper-two-blocks", pytest.param("scheme-04-v-engine", marks=pytest.mark.soak)]
)
def test_two_pages_are_read_in_order_and_used(task: str) -> None:
    drawn = two_pages(task)

    names = [[view.name for view in views(page)] for page in drawn.pages]
    assert len(names) == 2
    assert KINEMATICS & {*names[0]}
    assert not KINEMATICS & {*names[1]}
    assert names[0][:2] == ["givens", "structure"]
    assert all(used(page) > 0.4 for page in drawn.pages)


def test_plans_are_drawn_larger_where_pages_have_room() -> None:
    drawn = mus(two_pages("scheme-10-shaper-two-blocks"))
    solved = kulman.solve("scheme-10-shaper-two-blocks", "6")

    longest = {
        symbol: max(q.mm or 0.0 for name, q in solved.quantities.items() if q.scale == symbol and q.kind == "vector")
        for symbol in ("mu_V", "mu_a", "mu_F_23")
    }
    assert {symbol: drawn[symbol] for symbol in longest} == {s: mu for s, mu in mus_of(solved).items() if s in longest}
    assert all(80.0 < millimetres < 300.0 for millimetres in longest.values())
