"""Kinds of tasks: loaded by their table alone, and refusing in one line what they do not have."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.commands.test_layers import loaded
from kulman.tests.support.cases import solve_case
from kulman.variants.case import Case, Kind, beside, kind_of
from kulman.variants.kinds import KINDS, MODULES


class Bare(Kind[Any, Any]):
    """A kind that has nothing but what it must have."""

    table, plans = "bare", ()

    def read(self, *args: Any) -> Any: ...
    def fits(self, *args: Any) -> None: ...
    def solve(self, *args: Any) -> Any: ...
    def scale_symbols(self, *args: Any) -> Any: ...
    def first_scales(self, *args: Any) -> Any: ...
    def conditions(self, *args: Any) -> Any: ...
    def draw(self, *args: Any, **kwargs: Any) -> Any: ...


@pytest.fixture(scope="module")
def case() -> Case:
    return solve_case("nau-slider-crank", None, None, "position", None)


@pytest.mark.parametrize(
    ("asked", "named"),
    [
        pytest.param(lambda case: beside(replace(case.task, kind="bare"), "charts"), "chart", id="chart"),
        pytest.param(lambda case: replace(case.task, subject=None).mechanism, "mechanism", id="sweep of a cycle"),
    ],
)
def test_what_a_kind_has_not_is_refused_in_one_line(asked: Callable[[Case], Any], named: str, case: Case) -> None:
    with pytest.raises(InputError) as refused:
        asked(case)

    assert refused.value.key == "kind-without"
    for language in LANGUAGES:
        line = refused.value.text(language)
        assert line.startswith("nau-slider-crank: ")
        assert line.split().count(named) == 1
        assert "\n" not in line


def test_a_bare_kind_warns_of_nothing_checks_nothing_and_asks_everything(case: Case) -> None:
    bare = Bare()

    assert (bare.warnings(case.solved), bare.checks(case.solved), bare.course(case.solved)) == ((), (), None)
    assert bare.asks(case.solved, None) is True  # type: ignore[arg-type]
    assert bare.plan_heading(case.solved, "velocity", case.words("en")) == case.words("en")["heading.velocity"]


def test_a_kind_without_its_seven_methods_cannot_be_made() -> None:
    class Unfinished(Kind[Any, Any]):
        table, plans = "unfinished", ()

    with pytest.raises(TypeError, match=r"conditions.*draw.*first_scales.*fits.*read.*scale_symbols.*solve"):
        Unfinished()  # type: ignore[abstract]


def test_every_table_leads_to_its_kind() -> None:
    assert {table: kind_of(table).table for table in MODULES} == {table: table for table in MODULES}
    assert len(set(KINDS)) == len(MODULES)


@pytest.mark.parametrize("task", ["madi-cam", "madi-gear"])
def test_reading_a_task_about_a_cam_or_gears_needs_no_arrays(task: str) -> None:
    assert loaded(f"from kulman import load_task; load_task('{task}')") == set()
