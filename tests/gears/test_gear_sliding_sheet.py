"""Points Z6 and Z7 of the examiner's list: sliding, tables, checks and calculations on sheets that were read back."""

from __future__ import annotations

import random
import re

import pytest

from kulman.tests.support.gear_cases import GearCase
from kulman.tests.support.gear_sliding_points import SLIDING_POINTS, scale
from kulman.tests.support.gear_tables import number, rows
from kulman.tests.support.overlaps import overlaps
from kulman.tests.support.readback import Sheet, read

SEED = 1532
PARTS = "geometry,sliding"
MADI = GearCase(only=PARTS)
CASES = (
    MADI,
    *(
        pytest.param(case, marks=pytest.mark.soak)
        for case in (
            GearCase(format="A3", lang="ru", only=PARTS),
            GearCase(format="A4", lang="en", only=PARTS),
            GearCase((("z_1", 17.0), ("z_2", 45.0), ("x_1", 0.3), ("x_2", -0.3)), rotation="cw", only=PARTS),
            GearCase((("z_1", 40.0), ("z_2", 25.0), ("x_1", 0.1), ("x_2", 0.2)), "A3", "en", only=PARTS),
            GearCase((("z_1", 12.0), ("z_2", 60.0), ("x_1", 0.5), ("x_2", 0.2)), "A1", "ru", only=PARTS),
        )
    ),
)


def faults(case: GearCase, drawn: Sheet, point: str) -> list[str]:
    return list(SLIDING_POINTS[point](case, drawn))


@pytest.mark.parametrize("point", SLIDING_POINTS)
@pytest.mark.parametrize("case", CASES, ids=str)
def test_sheet_of_a_pair_satisfies_the_points(case: GearCase, point: str) -> None:
    assert faults(case, case.sheet, point) == []


@pytest.mark.parametrize("case", CASES, ids=str)
def test_letters_of_sliding_and_tables_touch_nothing(case: GearCase) -> None:
    assert overlaps(case.sheet) == []


@pytest.mark.soak
def test_sheets_of_random_pairs_satisfy_the_points() -> None:
    choose, judged = random.Random(SEED), 0
    while judged < 8:
        teeth = {"z_1": float(choose.randint(8, 40)), "z_2": float(choose.randint(10, 90))}
        shifts = {"x_1": round(choose.uniform(-0.1, 0.9), 2), "x_2": round(choose.uniform(-0.3, 0.9), 2)}
        formats, languages = choose.choice(("A1", "A3", "A4")), choose.choice(("uk", "ru", "en"))
        case = GearCase((*teeth.items(), *shifts.items()), formats, languages, choose.choice(("ccw", "cw")), PARTS)
        if min(case.sizes[name] for name in ("rho_p1", "rho_p2", "g_alpha")) > 0.0:  # without interference
            judged += 1
            assert {point: faults(case, case.sheet, point) for point in SLIDING_POINTS} == {"Z6": [], "Z7": []}, case
            assert overlaps(case.sheet) == [], case


def test_a_broken_limit_is_told_in_the_table_of_checks() -> None:
    case = GearCase((("x_1", 0.1), ("x_2", 0.2)), lang="en", only=PARTS)

    table = {tuple(row[:2]): row[-1] for row in rows(case.sheet["checks"])[1:]}

    assert faults(case, case.sheet, "Z7") == []
    assert table["Undercutting, z_{1}", "x_{1} ≥ x_{min 1}"] == "not satisfied"
    assert table["Undercutting, z_{2}", "x_{2} ≥ x_{min 2}"] == "satisfied"


def test_the_contact_ratio_of_cut_flanks_is_told_in_the_table_of_checks() -> None:
    case = GearCase((("z_1", 8), ("z_2", 25), ("x_1", 0), ("x_2", 0)), lang="en", only=PARTS)

    table = {tuple(row[:2]): row[2:] for row in rows(case.sheet["checks"])[1:]}

    assert faults(case, case.sheet, "Z7") == []
    letters = [row[1] for row in rows(case.sheet["points"])[1:] if row[1][0].isalpha()]
    assert letters == ["N_{1}", "P", "A_{2}", "N_{2}"]  # A_1 is beyond N_1
    assert table["Contact ratio", "ε_{α} ≥ 1.2"] == ["1.4593", "1.2000", "satisfied"]
    assert table["Contact ratio", "ε'_{α} ≥ 1.2"] == ["0.9127", "1.2000", "not satisfied"]


def test_the_contour_holds_the_chosen_shifts_where_the_axes_say() -> None:
    view = MADI.sheet["contour"]
    mu = scale(view, "μ_{x}")
    numbers = {number(t.string): t for t in view.of("number")}

    (window,) = view.lines("window")
    left, low = min(p.real for p in window.points), min(p.imag for p in window.points)
    feet = [s.points for s in view.lines("division")]
    upright = sorted({a.real for a, _ in feet if abs(a.imag - low) < 0.01})
    level = sorted({a.imag for a, _ in feet if abs(a.real - left) < 0.01})

    at = view.point("chosen")
    assert 0.0 in numbers
    assert (at.real - upright[0]) * mu == pytest.approx(0.2, abs=0.01 * mu)  # the lowest division of x_1 is 0
    zero = next(y for y in level if abs(y - next(s.points[0].imag for s in view.lines("axis") if s.dashed)) < 0.01)
    assert (at.imag - zero) * mu == pytest.approx(0.85, abs=0.01 * mu)
    sides = {name for s in view.strokes for role, name in s.path if role == "contour"}
    assert sides == {"undercut_1", "undercut_2", "interference_1", "interference_2", "contact_1"}


SPOILED = {  # one piece of the file of the sheet changed
    "Z6": [
        r'("curve" data-name="V_k1">\n<line class="main"[^>]* y1=")(\d)',
        r'("node" data-name="theta_12_04">\n<circle class="thin"[^>]* cy=")(\d)',
    ],
    "Z7": [r"(>)(92),000 мм", r"(>)(1),2048"],
}


@pytest.mark.parametrize(
    ("point", "piece"), [(point, piece) for point, pieces in SPOILED.items() for piece in pieces], ids=str
)
def test_the_examiner_sees_a_spoiled_sheet_of_sliding(point: str, piece: str) -> None:
    pages = list(MADI.pages)
    spoiled = [re.sub(piece, r"\g<1>7", page, count=1) for page in pages]
    assert spoiled != pages

    try:
        found = faults(MADI, read(*spoiled), point)
    except (AssertionError, ValueError, KeyError) as stumbled:
        found = [str(stumbled)]

    assert found
