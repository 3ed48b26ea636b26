"""Sheets of special positions, of a part of the work, and at scale factors that a user asks for."""

from __future__ import annotations

import pytest

from kulman import sheet
from kulman.scales.errors import InputError
from kulman.tests.sheets.test_sheet_letters import page_faults, pen_faults, word_faults
from kulman.tests.sheets.test_sheet_points import symbol_of
from kulman.tests.support.overlaps import overlaps
from kulman.tests.support.printed_numbers import decimal, equation_faults, table_faults
from kulman.tests.support.readback import Sheet
from kulman.tests.support.sheet_cases import TASK, Case, drawn
from kulman.tests.support.sheet_points import mechanism_faults

SAID = {"uk": "= 0 (точка)", "en": "= 0"}


def special_faults(case: Case, read: Sheet) -> list[str]:
    """All faults of a sheet whose plans may have vectors of no length."""
    faults = [*mechanism_faults(case, read), *page_faults(case, read), *pen_faults(case, read)]
    faults += [*word_faults(case, read), *overlaps(read), *equation_faults(read)[1], *table_faults(read, case.lang, {})]
    for view in read.views:
        notes = " ".join(text.string for text in view.of("heading"))
        for vector in view.vectors:
            short = abs(vector.span) < 2.0
            if short and symbol_of(vector.quantity) not in notes:
                faults.append(f"{vector.quantity} is a point and not said to be")
            if vector.value == 0.0 and SAID[case.lang] not in notes:
                faults.append(f"{vector.quantity} is zero and not said to be")
            if short and [tip for tip in view.tips if ("vector", vector.quantity) in tip.path]:
                faults.append(f"{vector.quantity} is a point with an arrowhead")
    return [f"{case}: {fault}" for fault in faults]


def special_cases(steps: tuple[float, ...], sheets: tuple[tuple[str, str], ...]) -> list[Case]:
    return [
        Case(variant, name, lang, side, phi=base + step)
        for base in (0, 90, 180, 270)
        for step in steps
        for name in ("A1", "A4")
        for side in ("left", "right")
        for variant, lang in sheets
    ]


def half(cases: list[Case]) -> list[Case]:
    """Return every other case, so that each position has both formats and both sides; the soak has them all."""
    return [c for c in cases if ((c.format == "A1") + (c.side == "left") + round(c.phi or 0.0) // 90) % 2 == 0]


@pytest.mark.parametrize("case", half(special_cases((0.0, 1e-6), (("example", "uk"),))), ids=str)
def test_sheet_of_a_special_position_is_drawn_and_said_in_words(case: Case) -> None:
    assert special_faults(case, drawn(case)) == []


def test_a_zero_vector_is_a_point() -> None:
    view = drawn(Case(format="A1", phi=0.0))["velocity"]

    zero = view.vector("V_B")

    assert abs(zero.span) < 1e-6
    assert zero.value < 1e-12
    assert not [tip for tip in view.tips if ("vector", "V_B") in tip.path]
    assert any(("vector", "V_B") in ring.path for ring in view.rings)


@pytest.mark.parametrize(
    ("only", "there", "missing"),
    [
        (("velocity",), {"velocity", "equations_kinematics"}, {"acceleration", "group_23", "forces_23", "lever"}),
        (("position",), {"position"}, {"velocity", "acceleration", "forces_23", "lever"}),
        (("forces",), {"group_23", "forces_23", "driver"}, {"lever"}),
        (("lever",), {"lever", "equations_lever"}, {"group_23", "forces_23"}),
    ],
    ids=lambda value: "-".join(value) if isinstance(value, tuple) else "",
)
def test_only_the_plans_asked_for_are_drawn(only: tuple[str, ...], there: set[str], missing: set[str]) -> None:
    case = Case("3", only=only)

    read = drawn(case)

    assert there <= set(read.names)
    assert not missing & set(read.names)
    assert not [v.quantity for v in read.vectors if only == ("velocity",) and v.quantity[0] in "aFR"]
    assert overlaps(read) == []
    assert equation_faults(read)[1] == []
    assert list(table_faults(read, "uk", {})) == []


def test_the_scale_factor_asked_for_is_drawn() -> None:
    read = drawn(Case("3", "A1", scales=(("mu_V", "0.1"),)))

    assert {vector.mu for vector in read["velocity"].vectors} == {0.1}
    assert "μ_{V} = 0,1 (м/с)/мм" in [text.string for text in read["velocity"].of("heading")]


def test_the_segment_asked_for_is_drawn() -> None:
    pa = drawn(Case("3", "A1", scales=(("pa", "60"),)))["velocity"].vector("V_A")

    assert 55 < abs(pa.span) < 65


@pytest.mark.parametrize("lang", ["uk", "ru", "en"])
def test_too_fine_a_scale_factor_is_refused_with_what_fits(lang: str) -> None:
    with pytest.raises(InputError) as refused:
        sheet(TASK, "3", format="A4", scales={"mu_V": 0.001}, lang=lang)

    text = refused.value.text(lang)
    assert "A4" in text
    assert "\n" not in text
    fits = refused.value.data["fits"]
    assert decimal(str(fits), lang) in text
    assert sheet(TASK, "3", format="A4", scales={"mu_V": float(str(fits))}, lang=lang).pages
