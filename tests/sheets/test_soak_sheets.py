"""All sheets of the bundled task: every variant, both sides, every format, every language."""

from __future__ import annotations

import itertools

import pytest

from kulman.tests.sheets.test_sheet_files import pdf_faults, scale_faults
from kulman.tests.sheets.test_sheet_letters import page_faults, pen_faults, word_faults
from kulman.tests.sheets.test_sheet_points import number_faults
from kulman.tests.sheets.test_sheet_special import special_cases, special_faults
from kulman.tests.support.mechanisms import NAU_VARIANTS
from kulman.tests.support.overlaps import overlaps
from kulman.tests.support.sheet_cases import FORMATS, Case, drawn
from kulman.tests.support.sheet_points import mechanism_faults

pytestmark = pytest.mark.soak
SIDES = ("left", "right")


def all_faults(case: Case) -> list[str]:
    read = drawn(case)
    faults = [*overlaps(read), *page_faults(case, read), *pen_faults(case, read), *word_faults(case, read)]
    faults = [f"{case}: {fault}" for fault in faults]
    in_pdf = pdf_faults(case) if (case.lang, case.rotation) == ("uk", "cw") else []
    return [*faults, *mechanism_faults(case, read), *number_faults(case, read), *scale_faults(case), *in_pdf]


@pytest.mark.parametrize("variant", NAU_VARIANTS)
@pytest.mark.parametrize("lang", ["uk", "en", "ru"])
def test_every_sheet_of_a_variant_is_without_fault(variant: str, lang: str) -> None:
    rotations = ("cw", "ccw") if lang == "uk" else ("cw",)

    faults = [
        fault
        for name, side, rotation in itertools.product(FORMATS, SIDES, rotations)
        for fault in all_faults(Case(variant, name, lang, side, rotation))
    ]

    assert faults == []


@pytest.mark.parametrize("variant", NAU_VARIANTS)
def test_every_iso_sheet_of_a_variant_is_without_fault(variant: str) -> None:
    cases = [Case(variant, name, "en", side, norm="iso") for name in FORMATS for side in SIDES]

    assert [fault for case in cases for fault in all_faults(case)] == []


@pytest.mark.parametrize("base", [0, 90, 180, 270])
def test_sheets_near_a_special_position_are_without_fault(base: int) -> None:
    steps = (0.0, 1e-6, -1e-6, 1e-3, -1e-3)
    cases = [c for c in special_cases(steps, (("example", "uk"), ("0", "en"))) if abs((c.phi or 0.0) - base) < 1]

    assert [fault for case in cases for fault in special_faults(case, drawn(case))] == []


@pytest.mark.parametrize("phi", range(0, 360, 15))
def test_sheets_all_round_the_circle_are_without_fault(phi: int) -> None:
    cases = [
        Case(variant, name, "uk", side, rotation, phi=phi + 0.5)
        for variant, name in (("example", "A1"), ("4", "A3"))
        for side in SIDES
        for rotation in ("cw", "ccw")
    ]

    assert [fault for case in cases for fault in special_faults(case, drawn(case))] == []
