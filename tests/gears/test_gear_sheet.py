"""Points Z1 to Z5 of the examiner's list on sheets of gear pairs that were drawn and read back."""

from __future__ import annotations

import math
import re

import pytest
import shapely

from kulman.drawing.gears.scene import mu_ladder, near_ladder, rolled_ladder
from kulman.plans.gears.gear import GearPair
from kulman.plans.gears.solve import solve_gear
from kulman.plans.gears.teeth import meshing_of
from kulman.tests.support.gear_cases import GearCase, arc_of, crossings, mu, outline
from kulman.tests.support.gear_points import POINTS
from kulman.tests.support.overlaps import overlaps, view_faults
from kulman.tests.support.readback import Sheet, polygon, read

MADI = GearCase(only=None)
PLAIN = (("x_1", 0.0), ("x_2", 0.0))
CASES = (
    MADI,
    *(
        pytest.param(case, marks=pytest.mark.soak)
        for case in (
            GearCase(rotation="cw", lang="en"),
            GearCase(format="A3", lang="ru"),
            GearCase(format="A4"),
            GearCase((("z_1", 60.0), ("z_2", 60.0), *PLAIN)),
            GearCase((("z_1", 17.0), ("z_2", 45.0), ("x_1", 0.3), ("x_2", -0.3)), rotation="cw"),
            GearCase((("z_1", 12.0), ("z_2", 60.0), ("x_1", 0.5), ("x_2", 0.2)), "A2", "en"),
        )
    ),
)
ODD = (  # undercut; pointed; few teeth, with an active line that ends beyond N1
    GearCase((("z_1", 8.0), ("z_2", 30.0), *PLAIN)),
    GearCase((("z_1", 10.0), ("z_2", 12.0), ("x_1", 0.8), ("x_2", 0.3)), lang="ru"),
    GearCase((("z_1", 5.0), ("z_2", 7.0), ("x_1", 0.8), ("x_2", 0.6)), rotation="cw", lang="en"),
)


def faults(case: GearCase, sheet: Sheet, point: str) -> list[str]:
    return list(POINTS[point](case, sheet))


@pytest.mark.parametrize("point", POINTS)
@pytest.mark.parametrize("case", CASES, ids=str)
def test_sheet_of_a_pair_satisfies_the_points(case: GearCase, point: str) -> None:
    assert faults(case, case.sheet, point) == []


@pytest.mark.parametrize("case", [*CASES, *(pytest.param(case, marks=pytest.mark.soak) for case in ODD)], ids=str)
def test_letters_of_a_meshing_touch_nothing(case: GearCase) -> None:
    assert overlaps(case.sheet) == []


@pytest.mark.parametrize(
    "case",
    [
        MADI,
        *(
            pytest.param(GearCase(format=paper, lang=lang, only=None), marks=pytest.mark.soak)
            for paper, lang in (("A1", "ru"), ("A2", "en"), ("A3", "uk"), ("A3-portrait", "en"), ("A4", "ru"))
        ),
    ],
    ids=str,
)
def test_views_of_a_whole_sheet_stand_apart(case: GearCase) -> None:
    assert [fault for page in case.sheet.pages for fault in view_faults(page)] == []
    assert overlaps(case.sheet) == []


def test_a_sheet_has_the_scale_factors_that_it_prints() -> None:
    scales = {name: scale.mu for name, scale in MADI.drawn.scales.items()}

    assert scales["meshing"] == mu(MADI.sheet["meshing"])
    (heading,) = (t.string for t in MADI.sheet["sliding"].of("heading") if "μ" in t.string)
    printed = [float(number.replace(",", ".")) for number in re.findall(r" = (\d+,\d+)", heading)]
    assert printed == [scales["sliding"], scales["theta"]]


def test_all_that_is_drawn_of_madi_is_on_one_a1() -> None:
    drawn = {"meshing", "rolling", "action", "sliding", "data", "checks", "points"}

    assert {view.name for view in MADI.sheet.pages[0].views} >= drawn


@pytest.mark.soak
@pytest.mark.parametrize("point", ["Z2", "Z3", "Z4"])
@pytest.mark.parametrize("case", ODD[1:], ids=str)
def test_odd_teeth_are_drawn_as_they_are(case: GearCase, point: str) -> None:
    assert faults(case, case.sheet, point) == []


def test_involutes_are_constructed_by_rolling() -> None:
    """T1_k is on the base circle, T1_k E1_k touches it and is as long as P D1_k, and E1_k lies on the curve."""
    view = MADI.sheet["rolling"]

    for i in (1, 2):
        centre, base = arc_of(view, f"d_b{i}")
        places = {name: r.centre for r in view.rings for role, name in r.path if role == "division"}
        last = max(int(name.partition("_")[2]) for name in places if re.fullmatch(rf"D{i}_\d+", name))
        (curve,) = view.inside("curve", f"involute_{i}")
        line = shapely.LineString([(p.real, p.imag) for p in curve.points])
        parts = [abs(places[f"D{i}_{k}"] - view.point("P")) for k in range(last + 1)]
        assert parts == pytest.approx([k * parts[1] for k in range(last + 1)], abs=0.01)
        for k in range(last + 1):
            foot, end = places[f"T{i}_{k}"], places[f"E{i}_{k}"]
            assert abs(foot - centre) == pytest.approx(base, abs=0.01)
            assert ((end - foot) * (foot - centre).conjugate()).real == pytest.approx(0.0, abs=0.01 * base)
            assert abs(end - foot) == pytest.approx(k * parts[1], abs=0.01)
            assert line.distance(shapely.Point(end.real, end.imag)) < 0.01
        assert len(crossings(curve.points, centre, abs(view.point("P") - centre))) == 1


@pytest.mark.parametrize("m", [0.2e-3, 1e-3, 3e-3, 5e-3, 20e-3])
def test_meshings_are_drawn_to_scales_of_the_standard(m: float) -> None:
    enlargements = (2.0, 2.5, 4.0, 5.0, 10.0, 20.0, 40.0, 50.0, 100.0, 200.0)  # GOST 2.302; from 100:1 on by hundreds
    solved = solve_gear(GearPair(), {"m": m, "z_1": 15.0, "z_2": 20.0, "x_1": 0.2, "x_2": 0.85})

    for ladder in (mu_ladder(solved, {}), near_ladder(solved), rolled_ladder(solved)):
        ratios = [1e-3 / mu for mu in ladder if mu < 0.9e-3]
        assert all(any(math.isclose(ratio, known) for known in enlargements) for ratio in ratios)
    assert solved.sizes["h"] / near_ladder(solved)[0] >= 50.0


@pytest.mark.parametrize(
    "case",
    [
        MADI,
        pytest.param(GearCase((("z_1", 8.0), ("z_2", 30.0), *PLAIN), only="geometry"), marks=pytest.mark.soak),
        pytest.param(GearCase((("h_a", 0.8), ("h_l", 1.6)), "A4", "en", only="geometry"), marks=pytest.mark.soak),
    ],
    ids=str,
)
def test_the_rack_touches_the_pinion_that_it_cuts(case: GearCase) -> None:
    """Both profiles touch without overlap, the middle line is x m above the pitch line, B beyond N undercuts."""
    view = case.sheet["rack"]
    pole = view.point("P")
    centre, radius = arc_of(view, "d_1")
    wheel = polygon((*outline(view, "pinion"), centre))
    points = outline(view, "rack")
    high = max(p.imag for p in points) + 10.0
    rack = polygon((*points, complex(points[-1].real, high), complex(points[0].real, high)))
    pitch, middle = (view.lines("rack-line", name)[0].points[0].imag for name in ("pitch", "middle"))

    assert wheel.intersection(rack).area < 0.01
    assert wheel.distance(rack) < 0.01
    assert abs(pole - centre) == pytest.approx(radius, abs=0.01)
    assert pitch == pytest.approx(pole.imag, abs=0.01)
    assert (middle - pitch) * mu(view) == pytest.approx(case.given["x_1"] * case.given["m"], abs=0.01 * mu(view))
    undercut = abs(view.point("B") - pole) > abs(view.point("N") - pole)
    assert undercut == (case.given["x_1"] < case.sizes["x_min1"])


def test_only_what_is_left_of_undercut_flanks_is_thick_on_the_line_of_action() -> None:
    case = ODD[0]
    first, last = meshing_of(case.given).touching

    for name in ("meshing", "action"):
        view = case.sheet[name]
        (thick,) = view.lines("active", "A1A2")
        low, high = sorted(abs(end - view.point("N1")) * mu(view) for end in thick.points)
        assert (low, high) == pytest.approx((first, last), abs=1e-8)
        assert high - low < case.sizes["g_alpha"] - 1e-3


SPOILED = {  # one piece of the file of the sheet changed
    "Z1": (r'("pivot" data-name="O2">.*?)(<circle[^>]*cy=")(\d)', r"\g<1>\g<2>1\g<3>"),
    "Z2": (r'("circle" data-name="d_w1">\n<path class="extreme" d="M[\d.]+ [\d.]+A)(\d+)', r"\g<1>2\g<2>"),
    "Z3": (r'("line-of-action" data-name="N1N2"[^>]* y1=")(\d)', r"\g<1>1\g<2>"),
    "Z4": (r'("profile" data-name="teeth_1"[^>]*points="(?:[\d.]+,[\d.]+ ){300})([\d.]+),', r"\g<1>200,"),
    "Z5": (r'("active" data-name="A1A2"[^>]* x1=")(\d)', r"\g<1>1\g<2>"),
}


@pytest.mark.parametrize("point", POINTS)
def test_the_examiner_sees_a_spoiled_sheet_of_a_pair(point: str) -> None:
    page = MADI.pages[0]
    spoiled = re.sub(*SPOILED[point], page, count=1, flags=re.DOTALL)
    assert spoiled != page

    try:
        found = faults(MADI, read(spoiled), point)
    except (AssertionError, ValueError, KeyError) as stumbled:
        found = [str(stumbled)]

    assert found
