"""Points Z1 to Z7 of the examiner's list on sheets of gear pairs that were drawn and read back."""

import math
import random
import re

import pytest
import shapely

from kulman import sheet
from kulman.drawing.formats import STYLES
from kulman.drawing.gears.action_view import _action_view
from kulman.drawing.gears.cutting_view import contour_view
from kulman.drawing.gears.meshing_view import BREAKS
from kulman.drawing.gears.scene import GearScene
from kulman.drawing.gears.sheet import _mu_ladder, _near_ladder, _rolled_ladder
from kulman.drawing.shapes import Line, Pen, Text
from kulman.drawing.text import lay_out
from kulman.drawing.words import Words
from kulman.plans.gears.course import GearCourse
from kulman.plans.gears.gear import GearPair
from kulman.plans.gears.solve import solve_gear
from kulman.plans.gears.teeth import meshing_of
from kulman.tests.sheets.judge import crossing, overlaps, thin_faults, view_faults
from kulman.tests.support.cases import some
from kulman.tests.support.gear_points import (
    POINTS,
    SLIDING_POINTS,
    GearCase,
    arc_of,
    crossings,
    faults,
    mu,
    number,
    outline,
    rows,
    scale,
)
from kulman.tests.support.gears import madi
from kulman.tests.support.readback import polygon, read, read_back

SEED = 1532
PARTS = "geometry,sliding"
WHOLE, SLIDING = GearCase(only=None), GearCase(only=PARTS)
PLAIN = (("x_1", 0.0), ("x_2", 0.0))
BOTH_SHIFTED = (("z_1", 17.0), ("z_2", 45.0), ("x_1", 0.3), ("x_2", -0.3))
LARGE_WHEEL = (("z_1", 12.0), ("z_2", 60.0), ("x_1", 0.5), ("x_2", 0.2))
MESHING_CASES = (
    GearCase(rotation="cw", lang="en"),
    GearCase(format="A3", lang="ru"),
    GearCase(format="A4"),
    GearCase((("z_1", 60.0), ("z_2", 60.0), *PLAIN)),
    GearCase(BOTH_SHIFTED, rotation="cw"),
    GearCase(LARGE_WHEEL, "A2", "en"),
)
ODD = (  # undercut; pointed; few teeth, with an active line that ends beyond N1
    GearCase((("z_1", 8.0), ("z_2", 30.0), *PLAIN)),
    GearCase((("z_1", 10.0), ("z_2", 12.0), ("x_1", 0.8), ("x_2", 0.3)), lang="ru"),
    GearCase((("z_1", 5.0), ("z_2", 7.0), ("x_1", 0.8), ("x_2", 0.6)), rotation="cw", lang="en"),
)
SLIDING_CASES = (
    GearCase(format="A3", lang="ru", only=PARTS),
    GearCase(format="A4", lang="en", only=PARTS),
    GearCase(BOTH_SHIFTED, rotation="cw", only=PARTS),
    GearCase((("z_1", 40.0), ("z_2", 25.0), ("x_1", 0.1), ("x_2", 0.2)), "A3", "en", only=PARTS),
    GearCase(LARGE_WHEEL, "A1", "ru", only=PARTS),
)
FORMATS = (("A1", "ru"), ("A2", "en"), ("A3", "uk"), ("A3-portrait", "en"), ("A4", "ru"))
ASKED = [
    *((WHOLE, point) for point in (*POINTS, *SLIDING_POINTS)),
    *(pytest.param(case, point, marks=pytest.mark.soak) for case in MESHING_CASES for point in POINTS),
    *(pytest.param(case, point, marks=pytest.mark.soak) for case in SLIDING_CASES for point in SLIDING_POINTS),
    *(pytest.param(case, point, marks=pytest.mark.soak) for case in ODD[1:] for point in ("Z2", "Z3", "Z4")),
]


@pytest.mark.parametrize(("case", "point"), ASKED, ids=str)
def test_sheet_of_a_pair_satisfies_the_points(case: GearCase, point: str) -> None:
    assert faults(case, case.sheet, point) == []


@pytest.mark.parametrize(
    "case", [WHOLE, *(pytest.param(case, marks=pytest.mark.soak) for case in MESHING_CASES)], ids=str
)
def test_speeds_stand_away_from_the_dimension_of_the_distance_of_centres(case: GearCase) -> None:
    meshing = case.sheet["meshing"]
    (dimension,) = (s for s in meshing.inside("dimension", "a_w") if abs(s.points[1] - s.points[0]) > 20.0)
    axis = meshing.lines("axis", "O1O2")[0].points[0].real
    speeds = [text for text in meshing.texts if re.match("ω_", text.string)]

    assert len(speeds) == 2
    for text in speeds:
        x0, _, x1, _ = text.box
        assert (x0 - axis) * (dimension.points[0].real - axis) < 0.0 > (x1 - axis) * (dimension.points[0].real - axis)


@pytest.mark.parametrize(
    "case",
    [
        WHOLE,
        SLIDING,
        *(pytest.param(case, marks=pytest.mark.soak) for case in (*MESHING_CASES, *SLIDING_CASES, *ODD)),
        *(
            pytest.param(GearCase(format=paper, lang=lang, only=None), marks=pytest.mark.soak)
            for paper, lang in FORMATS
        ),
    ],
    ids=str,
)
def test_letters_touch_nothing_and_views_stand_apart(case: GearCase) -> None:
    assert overlaps(case.sheet) == []
    assert [fault for page in case.sheet.pages for fault in view_faults(page)] == []


@pytest.mark.parametrize("case", some([WHOLE, GearCase(format="A4")], 0), ids=str)
def test_leaders_cross_no_main_line_also_where_there_is_little_room(case: GearCase) -> None:
    assert [fault for view in case.sheet.views for fault in crossing(view) if fault is not None] == []


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


def test_all_that_is_drawn_of_madi_is_on_one_a1_with_the_scale_factors_that_it_prints() -> None:
    drawn = {"meshing", "rolling", "action", "sliding", "data", "checks", "points"}
    scales = {name: scale.mu for name, scale in WHOLE.drawn.scales.items()}
    assert {view.name for view in WHOLE.sheet.pages[0].views} >= drawn
    assert scales["meshing"] == mu(WHOLE.sheet["meshing"])
    (heading,) = (t.string for t in WHOLE.sheet["sliding"].of("heading") if "μ" in t.string)
    printed = [float(number.replace(",", ".")) for number in re.findall(r" = (\d+,\d+)", heading)]
    assert printed == [scales["sliding"], scales["theta"]]


def test_involutes_are_constructed_by_rolling() -> None:
    """T1_k is on the base circle, T1_k E1_k touches it and is as long as P D1_k, and E1_k lies on the curve."""
    view = WHOLE.sheet["rolling"]

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
        (line_of_action,) = (
            shapely.LineString([(p.real, p.imag) for p in s.points]) for s in view.lines("line-of-action", "N1N2")
        )
        ends = [shapely.Point(end.real, end.imag) for end in (places[f"D{i}_{last}"], view.point("P"))]
        assert all(line_of_action.distance(end) < 0.01 for end in ends)  # it goes past what is laid off on it
        assert all(line_of_action.boundary.distance(end) > 1.0 for end in ends)


@pytest.mark.parametrize("m", [0.2e-3, 1e-3, 3e-3, 5e-3, 20e-3])
def test_meshings_are_drawn_to_scales_of_the_standard(m: float) -> None:
    enlargements = (2.0, 2.5, 4.0, 5.0, 10.0, 20.0, 40.0, 50.0, 100.0, 200.0)  # GOST 2.302; from 100:1 on by hundreds
    solved = solve_gear(GearPair(), {"m": m, "z_1": 15.0, "z_2": 20.0, "x_1": 0.2, "x_2": 0.85})
    for ladder in (_mu_ladder(solved, {}), _near_ladder(solved), _rolled_ladder(solved)):
        ratios = [1e-3 / mu for mu in ladder if mu < 0.9e-3]
        assert all(any(math.isclose(ratio, known) for known in enlargements) for ratio in ratios)
    assert solved.sizes["h"] / _near_ladder(solved)[0] >= 50.0


@pytest.mark.parametrize(
    "case",
    [
        WHOLE,
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


def test_broken_limits_and_the_contact_ratio_of_cut_flanks_are_told_in_the_table_of_checks() -> None:
    undercut = GearCase((("x_1", 0.1), ("x_2", 0.2)), lang="en", only=PARTS)
    cut = GearCase((("z_1", 8), ("z_2", 25), ("x_1", 0), ("x_2", 0)), lang="en", only=PARTS)
    broken, lacking = ({tuple(row[:2]): row[2:] for row in rows(case.sheet["checks"])[1:]} for case in (undercut, cut))
    assert faults(undercut, undercut.sheet, "Z7") == faults(cut, cut.sheet, "Z7") == []
    assert broken["Undercutting, z_{1}", "x_{1} ≥ x_{min 1}"][-1] == "not satisfied"
    assert broken["Undercutting, z_{2}", "x_{2} ≥ x_{min 2}"][-1] == "satisfied"
    letters = [row[1] for row in rows(cut.sheet["points"])[1:] if row[1][0].isalpha()]
    assert letters == ["N_{1}", "P", "A_{2}", "N_{2}"]  # A_1 is beyond N_1
    assert lacking["Contact ratio", "ε_{α} ≥ 1.2"] == ["1.4593", "1.2000", "satisfied"]
    assert lacking["Contact ratio", "ε'_{α} ≥ 1.2"] == ["0.9127", "1.2000", "not satisfied"]


def test_the_contour_holds_the_chosen_shifts_where_the_axes_say() -> None:
    view = SLIDING.sheet["contour"]
    mu = scale(view, "μ_{x}")

    (window,) = view.lines("window")
    left, low = min(p.real for p in window.points), min(p.imag for p in window.points)
    feet = [s.points for s in view.lines("division")]
    upright = sorted({a.real for a, _ in feet if abs(a.imag - low) < 0.01})
    level = sorted({a.imag for a, _ in feet if abs(a.real - left) < 0.01})

    at = view.point("chosen")
    assert 0.0 in {number(t.string) for t in view.of("number")}
    assert (at.real - upright[0]) * mu == pytest.approx(0.2, abs=0.01 * mu)  # the lowest division of x_1 is 0
    zero = next(y for y in level if abs(y - next(s.points[0].imag for s in view.lines("axis") if s.dashed)) < 0.01)
    assert (at.imag - zero) * mu == pytest.approx(0.85, abs=0.01 * mu)
    sides = {name for s in view.strokes for role, name in s.path if role == "contour"}
    assert sides == {"undercut_1", "undercut_2", "interference_1", "interference_2", "contact_1"}
    # x_1 = 0 would run less than 1 mm beside the side of the window
    assert [abs((s.points[1] - s.points[0]).real) > 1.0 for s in view.lines("axis") if s.dashed] == [True]


def scene(format: str, rolled: float = 1e-3, **others: float) -> GearScene:
    solved = solve_gear(GearPair(), madi(**others))
    return GearScene(solved, Words.of("en", "nau"), STYLES[format], {}, rolled=rolled)


@pytest.mark.parametrize(("z_2", "axes"), [(30.0, {"x_1", "x_2"}), (40.0, {"x_1"})])  # 3.4 and 2.7 mm from the side
def test_an_axis_of_the_contour_is_told_apart_from_a_side_more_than_3_mm_away(z_2: float, axes: set[str]) -> None:
    dashed = [s for s in contour_view(scene("A3", z_1=17.0, z_2=z_2)).shapes if isinstance(s, Line)]
    drawn = [s.b - s.a for s in dashed if s.pen is Pen.AXIS]
    assert {"x_1" if way.imag == 0.0 else "x_2" for way in drawn} == axes


def test_the_number_of_pairs_stands_in_its_zone_where_a_millimetre_is_free_beside_it_else_above() -> None:
    first, last, count = GearCourse(scene("A1").solved).zones[1]
    for spare in (2.4, 1.6):
        width = lay_out(str(count), STYLES["A1"].label).width
        view = _action_view(scene("A1", rolled=(last - first) / (width + spare)))
        (number,) = (s for s in view.shapes if isinstance(s, Text) and (s.role, s.name) == ("zone", "2"))
        (zone,) = (s for s in view.shapes if (getattr(s, "role", ""), getattr(s, "name", "")) == ("zone", f"2_{count}"))
        top = max(point.imag for shape in zone.shapes for point in shape.points)
        assert (number.at.imag < top) == (spare > 2.0)


SPOILED = [  # one piece of the file of a sheet changed
    ("Z1", r'("pivot" data-name="O2">.*?)(<circle[^>]*cy=")(\d)', r"\g<1>\g<2>1\g<3>"),
    ("Z2", r'("circle" data-name="d_w1">\n<path class="extreme" d="M[\d.]+ [\d.]+A)(\d+)', r"\g<1>2\g<2>"),
    ("Z3", r'("line-of-action" data-name="N1N2"[^>]* y1=")(\d)', r"\g<1>1\g<2>"),
    ("Z4", r'("profile" data-name="teeth_1"[^>]*points="(?:[\d.]+,[\d.]+ ){300})([\d.]+),', r"\g<1>200,"),
    ("Z5", r'("active" data-name="A1A2"[^>]* x1=")(\d)', r"\g<1>1\g<2>"),
    ("Z6", r'("curve" data-name="V_k1">\n<line class="main"[^>]* y1=")(\d)', r"\g<1>7"),
    ("Z6", r'("node" data-name="theta_12_04">\n<circle class="thin"[^>]* cy=")(\d)', r"\g<1>7"),
    ("Z7", r"(>)(92),000 мм", r"\g<1>7"),
    ("Z7", r"(>)(1),2048", r"\g<1>7"),
]


@pytest.mark.parametrize(("point", "piece", "other"), SPOILED, ids=lambda text: text[:2])
def test_the_examiner_sees_a_spoiled_sheet_of_a_pair(point: str, piece: str, other: str) -> None:
    case = WHOLE if point in POINTS else SLIDING
    spoiled = [re.sub(piece, other, page, count=1, flags=re.DOTALL) for page in case.pages]
    assert spoiled != [*case.pages]
    assert faults(case, read(*spoiled), point)


@pytest.mark.parametrize("seed", some(range(20), 1))
def test_no_circle_or_ray_runs_through_a_letter_of_the_meshing_of_a_random_pair(seed: int) -> None:
    chance = random.Random(seed)
    changes = {
        "z_1": chance.randrange(13, 22),
        "z_2": chance.randrange(18, 34),
        "x_1": round(chance.uniform(0.2, 0.6), 2),
    }
    language = chance.choice(("uk", "ru", "en"))
    drawn = sheet("madi-gear", set=changes, only="meshing", lang=language, format="A1")
    views = [v for page in read_back(drawn).pages for v in page.all]

    struck = [
        (view.name, text.string, line.role)
        for view in views
        if view.name in ("meshing", "near")
        for text, line in thin_faults(view)
        if {line.role, *(role for role, _ in line.path)} & {*BREAKS}
    ]

    assert struck == []
