"""Sheets of all bundled linkages: the examiner's points L1 to L13 against constraint equations, nothing touches."""

from __future__ import annotations

import pytest

from kulman.tests.support.linkage_cases import Linkage
from kulman.tests.support.linkage_points import linkage_faults
from kulman.variants.shelf import bundled, summary

TASKS = {task: tuple(summary(task)["variants"]) for task in bundled("mechanism") if task != "nau-slider-crank"}
SAMPLE = [Linkage(task, variants[k % len(variants)], format="A1") for k, (task, variants) in enumerate(TASKS.items())]


@pytest.mark.parametrize("case", SAMPLE[::6], ids=str)
def test_sheet_of_a_scheme_is_without_fault(case: Linkage) -> None:
    assert linkage_faults(case) == []


@pytest.mark.soak
@pytest.mark.parametrize("task", TASKS)
def test_every_variant_of_a_scheme_has_a_sheet_without_fault(task: str) -> None:
    cases = [Linkage(task, variant, format="A1") for variant in TASKS[task]]

    assert [fault for case in cases for fault in linkage_faults(case)] == []


@pytest.mark.soak
@pytest.mark.parametrize("task", TASKS)
@pytest.mark.parametrize(("lang", "format"), [("en", "A3"), ("ru", "A2"), ("uk", "A4")])
def test_sheets_of_a_scheme_on_other_formats_are_without_fault(task: str, lang: str, format: str) -> None:
    case = Linkage(task, TASKS[task][0], lang, format)

    assert linkage_faults(case) == []
