"""Points C1 to C8 of the examiner's list on sheets of cams, those with rockers each place after formulas of its own."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable, Iterator
from functools import partial
from itertools import pairwise
from random import Random

import numpy as np
import pytest
import shapely

from kulman import sheet, solve
from kulman.drawing.cams import profile_view
from kulman.drawing.cams.inversion import PARTS
from kulman.drawing.formats import STYLES
from kulman.drawing.shapes import Arc, Group, Text
from kulman.drawing.view import Canvas
from kulman.plans.cams.cam import LAWS
from kulman.plans.laws import LAWS as LAWS_OF_BOARD
from kulman.scales.errors import LANGUAGES
from kulman.tests.sheets.judge import thin_faults
from kulman.tests.support.cam_points import (
    NEAR,
    POINTS,
    STEEP,
    CamCase,
    Faults,
    apart,
    measured,
    mu_l,
    node,
    ring,
    unless,
)
from kulman.tests.support.cams import ROCKER
from kulman.tests.support.cases import solve_case, some
from kulman.tests.support.readback import Sheet, View, angle, cross, polygon, read, read_back
from kulman.variants.kinds.cam import RULES

MADI = CamCase()
CLOCKWISE = CamCase((("rotation", "cw"),), only="sizes,profile,pressure")
OTHER = CamCase((("rotation", "cw"), ("law", "sine"), ("u", "0.5"), ("phi_upper", "30 deg")), "A3", "ru")
JUMPS = CamCase((("law", "constant"), ("fall", "same"), ("limits", "two-sided"), ("u", "0.4")), "A1", "en")
CASES = (MADI, pytest.param(OTHER, marks=pytest.mark.soak), pytest.param(JUMPS, marks=pytest.mark.soak))


@pytest.mark.parametrize("point", POINTS)
@pytest.mark.parametrize("case", CASES, ids=str)
def test_sheet_of_a_cam_satisfies_the_points(case: CamCase, point: str) -> None:
    assert [*POINTS[point](case, case.sheet)] == []


@pytest.mark.parametrize(
    ("settings", "paper"),
    [  # one by default
        pytest.param(settings, paper, marks=[pytest.mark.soak] * ((i, j) != (1, 1)), id=f"{settings}-{paper}")
        for i, settings in enumerate(({}, {"rotation": "cw"}, {"R_roller": "10 mm"}, {"phi_rise": "95 deg"}))
        for j, paper in enumerate(("A4", "A3"))
    ],
)
def test_both_sides_of_the_pressure_angle_reach_its_arrowheads(settings: dict[str, str], paper: str) -> None:
    (view,) = (
        view
        for page in read(sheet("madi-cam", set=settings, format=paper, only="profile").svg()).pages
        for view in page.all
        if view.name == "profile"
    )
    tips = [
        tip for tip in view.tips if any(role == "dimension" and name.startswith("theta_") for role, name in tip.path)
    ]
    rays = [[(p.real, p.imag) for p in s.points] for s in view.strokes if s.role in ("normal", "position")]

    assert len(tips) == 2
    for tip in tips:
        at = shapely.Point(tip.corners[0].real, tip.corners[0].imag)
        assert min(shapely.LineString(ray).distance(at) for ray in rays) < 0.1


@pytest.mark.parametrize("plan", ["profile", "plate_profile"])
def test_arrowheads_of_phases_are_not_hidden_by_the_rod(plan: str) -> None:
    svg = sheet("madi-cam", only="profile").svg()
    drawn = svg[svg.index(f'class="view" data-name="{plan}"') :]

    rod = drawn.index('data-name="rod"')
    assert all(rod < drawn.index(f'class="dimension" data-name="phi_{name}"') for name in ("rise", "fall"))


@pytest.mark.parametrize("side", some([1, -1], 1))
def test_number_0_stands_by_the_rod_and_not_by_the_axis_of_the_cam(side: int) -> None:
    rotation = {"rotation": "cw"} if side < 0 else {}
    view = read(sheet("madi-cam", set=rotation, only="profile").svg())["profile"]
    (number,) = (text for text in view.of("position") if text.string == "0")
    (rod,) = (s for s in view.strokes if s.role == "position" and s.name == "0")
    centre = next(s.arc[0] for s in view.strokes if s.arc and ("dimension", "phi_rise") in s.path)
    e, upright = max(rod.points, key=lambda p: p.imag).real, centre.real

    middle = 0.5 * (number.box[0] + number.box[2])

    assert abs(middle - e) < abs(middle - upright)


@pytest.mark.parametrize("paper", some(["A1", pytest.param("A3", marks=pytest.mark.soak), "A4"], 0))
def test_rays_that_do_not_coincide_have_numbers_of_their_own(paper: str) -> None:
    view = read(sheet("madi-cam", format=paper, only="diagrams").svg())["diagrams"]
    rays = view.lines("ray")

    for text in (text for text in view.of("number") if re.fullmatch(r"[\d,– ]+", text.string)):
        middle = 0.5 * (text.box[1] + text.box[3])
        first = [int(part.split("–")[0]) for part in text.string.split(", ")]
        if len(first) == 1 or text.box[2] < rays[0].points[0].real:  # on the shelf beyond the pole
            continue
        feet = [ray.points[1].imag for ray in rays if {*ray.name.split()} & {*map(str, first)}]
        own = [foot for foot in feet if abs(foot - middle) < 3.0]
        assert max(own) - min(own) < 1.0, text.string


@pytest.mark.parametrize("paper", some(["A1", pytest.param("A3", marks=pytest.mark.soak), "A4"], 0))
def test_greatest_ordinates_are_measured_at_the_curve_and_at_the_nodes_of_chords(paper: str) -> None:
    view = read(sheet("madi-cam", format=paper, only="diagrams").svg())["diagrams"]
    nodes = [ring.centre.imag for ring in view.rings if any(role == "node" for role, _ in ring.path)]
    exact = [p.imag for s in view.inside("curve", "diagram_s") for p in s.points]
    zero = min(exact)

    assert measured(view, "S_max") == pytest.approx(max(exact) - zero, abs=0.01)
    assert min(abs(zero + measured(view, "S_max_chord") - node) for node in nodes) < 0.01
    assert measured(view, "S_max_chord") > measured(view, "S_max")


def test_an_english_sheet_of_a_cam_says_tan() -> None:
    views = {lang: read(sheet("madi-cam", only="sizes", lang=lang).svg())["sizes"] for lang in ("en", "uk")}
    said = {lang: " ".join(text.string for text in view.texts) for lang, view in views.items()}

    assert ("tg ν" in said["uk"], "tg ν" in said["en"], "tan ν" in said["en"]) == (True, False, True)


@pytest.mark.soak
def test_the_whole_sheet_of_madi_is_one_a1_or_three_pages_of_a3() -> None:
    small = CamCase((), "A3")

    assert (len(MADI.pages), len(small.pages)) == (1, 3)
    assert sorted(view.name for view in small.sheet.views) == sorted(view.name for view in MADI.sheet.views)
    assert [*apart(small, small.sheet)] == []


@pytest.mark.soak
@pytest.mark.parametrize("only", ["sizes", pytest.param("diagrams", marks=pytest.mark.soak)])
def test_a_part_of_a_cam_has_room_on_a4_beside_the_title_block(only: str) -> None:
    part = CamCase((), "A4", only=only)

    own = {view.name.removesuffix("_continued") for view in part.sheet.views}
    assert own < {view.name for view in MADI.sheet.views}
    assert [*apart(part, part.sheet)] == []


@pytest.mark.soak
@pytest.mark.parametrize(
    "changes",
    [
        {"fall": "same"},  # a large plate
        pytest.param({"R_roller": 25}, marks=pytest.mark.soak),
        pytest.param({"limits": "two-sided"}, marks=pytest.mark.soak),
        pytest.param({"law": "trapezoid"}, marks=pytest.mark.soak),  # a high travel
        pytest.param({"r_0": 60}, marks=pytest.mark.soak),
        pytest.param({"law": "cosine", "u": 0.5}, marks=pytest.mark.soak),  # the highest travel
    ],
    ids=str,
)
def test_small_changes_of_a_cam_stay_on_one_a1(changes: dict[str, object]) -> None:
    drawn = sheet("madi-cam", set=changes)

    assert (drawn.format, len(drawn.pages)) == ("A1", 1)
    smaller = drawn.scales["diagram_s"].mu > 1.001 * solve("madi-cam", set=changes).solved.values["mu_s"]
    assert any(warning.key == "cam-smaller" for warning in drawn.warnings) == smaller


@pytest.mark.parametrize(
    ("changes", "mu", "ratio"),
    [
        ({}, 0.001, "M 1:1"),
        pytest.param({"law": "cosine"}, 0.0005, "M 2:1", marks=pytest.mark.soak),  # least radii below 30 mm
        pytest.param({"h": "40 mm"}, 0.002, "M 1:2", marks=pytest.mark.soak),  # more than 150 mm to the top
    ],
    ids=str,
)
def test_the_profile_of_a_cam_is_enlarged_or_reduced_as_is_customary(
    changes: dict[str, object], mu: float, ratio: str
) -> None:
    drawn = sheet("madi-cam", set=changes, only="profile", lang="en", format="A1")

    assert {drawn.scales[plan].mu for plan in ("profile", "plate_profile")} == {mu}
    assert sum(ratio in text.string for text in read(drawn.svg()).texts) == 2


@pytest.mark.soak
@pytest.mark.parametrize("point", ["C5", "C6", "C7"])
def test_a_cam_that_turns_clockwise_is_drawn_the_other_way_round(point: str) -> None:
    assert [*POINTS[point](CLOCKWISE, CLOCKWISE.sheet)] == []


@pytest.mark.soak
@pytest.mark.parametrize("law", LAWS)
def test_sheets_of_all_laws_satisfy_the_points(law: str) -> None:
    case = CamCase((("law", law),))
    points = [point for point in POINTS if point != "G5" and (point != "C8" or case.solved.plate is not None)]

    assert {point: found for point in points if (found := [*POINTS[point](case, case.sheet)])} == {}


@pytest.mark.parametrize("seed", some(range(30), 0))
def test_no_line_runs_through_a_letter_among_the_positions_of_a_cam(seed: int) -> None:
    chance = Random(seed)
    changes = {
        "h": f"{chance.uniform(8.0, 25.0):.1f} mm",
        "phi_rise": f"{chance.randrange(70, 120, 5)} deg",
        "R_roller": f"{chance.uniform(4.0, 8.0):.1f} mm",
        "rotation": chance.choice(("cw", "ccw")),
    }
    drawn = sheet("madi-cam", set=changes, only="profile", lang=chance.choice(("uk", "ru", "en")), format="A1")
    views = [v for page in read_back(drawn).pages for v in page.all]

    struck = [(v.name, text.string, line.role) for v in views if v.name for text, line in thin_faults(v)]

    assert {view.name for view in views} >= {"profile", "plate_profile"}
    assert struck == []


@pytest.mark.parametrize("notation", ["bauman", pytest.param("iso", marks=pytest.mark.soak)])
def test_a_sheet_of_a_cam_has_one_convention_of_scale_factors(notation: str) -> None:
    drawn = sheet("madi-cam", only="diagrams", notation=notation, format="A1")

    factors = [t.string for t in read(drawn.svg()).texts if "μ" in t.string and "= 0,0" in t.string]
    assert len(factors) > 8
    assert not any("мм/м" in text or "мм/рад" in text for text in factors)


@pytest.mark.parametrize(
    ("settings", "kept"),
    [
        ({"r_0": 72.5, "R_roller": 29.01}, [False, True, True, True]),  # just broken
        pytest.param({"r_0": 72.5, "R_roller": 29}, [True] * 4, marks=pytest.mark.soak),  # just kept
        pytest.param({"r_0": 46, "e": -5}, [True, True, False, True], marks=pytest.mark.soak),  # of the rise
    ],
)
def test_the_sheet_says_of_the_rules_what_the_checks_say(settings: dict[str, float], kept: list[bool]) -> None:
    drawn = sheet("madi-cam", set=settings, only="sizes", lang="en", format="A2")
    checks, texts = solve("madi-cam", set=settings).checks, [text.string for text in read(drawn.svg()).texts]

    said = ["not" not in text for text in texts if re.search(r"\((not )?satisfied\)", text)]

    assert said == kept
    assert said == [checks[name]["ok"] for name in RULES]


SPOILED = {  # one piece of the file of the sheet changed
    "C1": (r'("section" data-name="7">\n<line[^>]*x1=")(\d+)', r"\g<1>1\g<2>"),
    "C2": (r'(data-name="chords?"|"chords" data-name="diagram_s">\n<line[^>]*y2=")(\d)', r"\g<1>9"),
    "C3": (r'("dimension" data-name="l_A2">.*?class="head"[^>]*? points=")([\d.]+),([\d.]+)', r"\g<1>\g<2>,1\g<3>"),
    "C4": (r"0,0001641(?= м/мм)", "0,0001647"),
    "C5": (r'("limit" data-name="rise"[^>]*? x1=")(\d)', r"\g<1>9"),
    "C6": (r'("position" data-name="9"[^>]*? x2=")(\d)', r"\g<1>9"),
    "C7": (r'("roller" data-name="9">\n<circle[^>]*r=")7', r"\g<1>7.1"),
    "C8": (r'(class="plate" data-name="9"[^>]*? x1=")(\d)', r"\g<1>9"),
    "G5": (r'(data-name="position"|class="position" data-name="4" x=")([\d.]+)(" y=")([\d.]+)', None),
}
SPOILED_BY_DEFAULT = ("C2", "C4", "C6", "C8")  # one of each view


@pytest.mark.parametrize(
    "point",
    [point if point in SPOILED_BY_DEFAULT else pytest.param(point, marks=pytest.mark.soak) for point in SPOILED],
)
def test_the_examiner_sees_a_spoiled_sheet_of_a_cam(point: str) -> None:
    (page,) = MADI.pages
    old, new = SPOILED[point]
    if new is None:  # a number where the next one stands
        place = r'class="position" data-name="{}"[^>]*? (x="[\d.]+" y="[\d.]+")'
        third, fourth = (re.findall(place.format(n), page)[0] for n in "34")
        spoiled = page.replace(third, fourth, 1)
    else:
        spoiled = re.sub(old, new, page, count=1, flags=re.DOTALL)
    assert spoiled != page

    try:
        found = [*POINTS[point](MADI, read(spoiled))]
    except (AssertionError, ValueError, KeyError) as stumbled:
        found = [str(stumbled)]

    assert found


FREE = CamCase((), "A1", "uk", ROCKER)
TWO_SIDED = CamCase((("rotation", "cw"), ("limits", "two-sided"), ("law", "polynomial-345")), "A3", "en", ROCKER)
GIVEN = CamCase((("l_OC", "125 mm"), ("law", "constant"), ("fall", "same")), "A1", "ru", ROCKER)
TURNED = CamCase(
    (("l_OC", "140 mm"), ("rotation", "cw"), ("law", "cosine"), ("phi_upper", "0 deg")), "A1", "en", ROCKER
)
JUDGED = CamCase(TWO_SIDED.changes, "A2", "en", ROCKER, only="sizes,profile")  # what the judges look at, on one page
ROCKERS = (FREE, *(pytest.param(case, marks=pytest.mark.soak) for case in (TWO_SIDED, GIVEN, TURNED)))


def swing(case: CamCase, phi: np.ndarray, side: int = -1) -> tuple[np.ndarray, np.ndarray]:
    """Angle of the rocker and its analogue of velocity: the travel along the arc over the rocker's length."""
    s, ds, _ = case.solved.motion.at(phi, side)
    l = case.solved.values["l_rocker"]
    return np.asarray(s / l), np.asarray(ds / l)


def first_angle(case: CamCase) -> float:
    """Angle at the pivot between the rocker in its lowest position and the line of centres."""
    l, d, r_0 = (case.solved.values[name] for name in ("l_rocker", "l_OC", "r_0"))
    return math.acos((l * l + d * d - r_0 * r_0) / (2.0 * l * d))


def inversion_faults(case: CamCase, drawn: Sheet) -> Faults:
    """The pivot goes round against omega; each roller's centre is l from it, and as far from O as the triangle says."""
    view, values = drawn["profile"], case.solved.values
    mu, l, d = mu_l(view), values["l_rocker"], values["l_OC"]
    centre, r_0 = ring(view, "circle", "r_0")
    sizes = abs(r_0 * mu - values["r_0"]), abs(ring(view, "circle", "l_OC")[1] * mu - d)
    yield from unless(max(sizes) <= NEAR * mu, "a circle has another radius")
    turning = view.turning("omega")
    yield from unless(turning is not None and turning[1] == case.sense, "omega turns the other way")
    angles = case.solved.angles
    psi, first = swing(case, angles)[0], first_angle(case)
    pivots = [view.point("A0"), *(node(view, f"A{i}") for i in range(1, len(angles)))]
    start = pivots[0] - centre
    for i, (phi, pivot) in enumerate(zip(angles.tolist(), pivots, strict=True)):
        at, there = node(view, f"B{i}"), centre + start * cmath.rect(1.0, -case.sense * phi)
        yield from unless(abs(pivot - there) <= NEAR, f"pivot {i} is not laid off against omega")
        yield from unless(abs(abs(at - pivot) * mu - l) <= NEAR * mu, f"rocker {i} has another length")
        far = math.sqrt(l * l + d * d - 2.0 * l * d * math.cos(first + float(psi[i]))) / mu
        yield from unless(abs(abs(at - centre) - far) <= NEAR, f"roller {i} is {abs(at - centre)} mm from O, not {far}")
        yield from unless(abs(ring(view, "roller", str(i))[0] - at) <= NEAR, f"roller {i} is not about its centre")


def contact_faults(case: CamCase, drawn: Sheet) -> Faults:
    """At any angle a roller about the place of its centre touches the practical profile and does not cut it."""
    view, values = drawn["profile"], case.solved.values
    mu, l, d, R = mu_l(view), values["l_rocker"], values["l_OC"], values["R_roller"]
    (practical,) = view.inside("curve", "practical")
    body = polygon(practical.points)
    yield from unless(body.is_valid, "the practical profile has a loop")
    centre, start = ring(view, "circle", "r_0")[0], view.point("A0")
    phi = np.linspace(0.0, math.tau, 500)[:-1]
    along = cmath.phase(start - centre) - case.sense * phi
    lift = math.pi + first_angle(case)  # from the line of centres, outwards, to the rocker
    at = centre + (d * np.exp(1j * along) + l * np.exp(1j * (along + lift + swing(case, phi)[0]))) * (1.0 / mu)
    beside = abs(complex(at[0]) - node(view, "B0"))
    yield from unless(beside <= NEAR, "the rocker lies on the other side of the line of centres")
    room = np.max(np.abs(shapely.distance(body.exterior, shapely.points(at.real, at.imag)) - R / mu))
    yield from unless(room <= NEAR, f"a roller misses the profile by {room:.4f} mm")


def size_faults(case: CamCase, drawn: Sheet) -> Faults:
    """Analogues along the rocker, limits through their ends at the permitted angle, the centre where they permit it."""
    view, values = drawn["rocker_sizes"], case.solved.values
    mu, l = mu_l(view), values["l_rocker"]
    pivot, centre = view.point("C"), view.point("O")
    (psi, before), (_, after) = (swing(case, case.solved.angles, side) for side in (-1, 1))
    for name in ("r_0", "l_OC"):
        away = abs(measured(view, name) * mu - values[name])
        yield from unless(away <= NEAR * mu, f"{name} is dimensioned otherwise")
    away = abs(abs(centre - node(view, "B0")) * mu - values["r_0"])
    yield from unless(away <= NEAR * mu, "the centre is not at r_0")
    for phase, way in (("rise", 1), ("fall", -1)):
        lines = getattr(case.solved.layout.division, phase)
        for i in lines:
            arm, dpsi = cmath.rect(1.0, float(psi[i])), float((after if i == lines[0] else before)[i])
            at, end = node(view, f"B{i}"), node(view, f"{i}_{phase}")
            yield from unless(abs(at - pivot - arm * (l / mu)) <= NEAR, f"position {i} is elsewhere")
            away = abs(end - at + arm * (case.sense * dpsi * l / mu))
            yield from unless(away <= NEAR, f"analogue {i} is laid off otherwise")
            (limit,) = view.lines("limit", f"{i}_{phase}")
            a, b = limit.points
            yield from unless(abs(cross((b - a) / abs(b - a), end - a)) <= NEAR, f"limit {i} misses its end")
            turned = angle(arm * cmath.rect(1.0, -way * case.sense * values[f"gamma_{phase}"]), b - a)
            yield from unless(abs(math.remainder(turned, 180.0)) <= STEEP, f"limit {i} is turned by {turned} degrees")
    yield from permitted_faults(case, view, pivot, centre)


def permitted_faults(case: CamCase, view: View, pivot: complex, centre: complex) -> Faults:
    """All hatched places, and the centre, keep the pressure angle in all positions; beyond the hatching none does."""
    within, strokes = math.radians(STEEP), view.inside("permitted", "centre")
    yield from unless(lack(case, view, pivot, centre) <= within, "the centre does not keep the limits")
    if len(strokes) < 5:
        yield "the permitted places are not hatched"
        return
    ends = [p for s in strokes for p in s.points]
    kept = max(lack(case, view, pivot, p) for p in ends) <= within
    yield from unless(kept, "a place is hatched that does not keep the limits")
    box = shapely.MultiPoint([(p.real, p.imag) for p in ends]).envelope
    inner = [p for p in ends if box.exterior.distance(shapely.Point(p.real, p.imag)) > 0.1]
    for stroke in strokes:
        a, b = stroke.points
        for end, out in ((a, a - b), (b, b - a)):
            if end in inner and lack(case, view, pivot, end + out / abs(out)) < 0.0:
                yield "a place that keeps the limits is not hatched"


def lack(case: CamCase, view: View, pivot: complex, place: complex) -> float:
    """By how much the pressure angle exceeds its limit if the cam's centre is at a place; negative within it."""
    mu, l, worst = mu_l(view), case.solved.values["l_rocker"], -math.inf
    motion, two_sided = case.solved.motion, case.solved.cam.two_sided
    if any(cross(cmath.rect(1.0, psi), place - pivot) > NEAR for psi in (0.0, motion.h / l)):
        return math.inf  # the cam stays below the rocker
    for phase, way in ((motion.rise, 1), (motion.fall, -1)):
        phi = np.linspace(phase.start, phase.end, 400)[:-1]
        psi, dpsi = swing(case, phi, 1)
        arm = np.exp(1j * psi)
        normal = pivot + arm * (l / mu) * (1.0 - case.sense * dpsi) - place
        theta = np.angle(normal / (1j * arm))
        limit = 0.5 * math.pi - case.solved.values[f"gamma_{phase.name}"]
        pushed = np.abs(theta) if two_sided else way * case.sense * theta
        worst = max(worst, float(np.max(pushed)) - limit)
    return worst


JUDGES: dict[str, Callable[[CamCase, Sheet], Faults]] = {
    "inversion": inversion_faults,
    "contact": contact_faults,
    "sizes": size_faults,
    "views": apart,
}


@pytest.mark.parametrize("judge", JUDGES)
@pytest.mark.parametrize("case", some([*ROCKERS, JUDGED], 1), ids=str)
def test_sheet_of_a_rocker_is_drawn_to_scale(case: CamCase, judge: str) -> None:
    assert list(JUDGES[judge](case, case.sheet)) == []


def shifted(view: str, tag: str, **shifts: float) -> Callable[[str], str]:
    """Add to attributes of the first element that follows `tag` in a view, mm; y runs down."""

    def shift(page: str) -> str:
        found = next(filter(None, (re.compile(tag).search(page, *span) for span in spans(page, view))), None)
        assert found, tag
        end = page.index(">", found.end())
        element = page[found.end() : end]
        for name, by in shifts.items():
            element, count = re.subn(
                rf'\b{name}="([\d.]+)', lambda was, name=name, by=by: f'{name}="{float(was[1]) + by:.6f}', element
            )
            assert count == 1, name
        return page[: found.end()] + element + page[end:]

    return shift


def spans(page: str, view: str) -> Iterator[tuple[int, int]]:
    """Go through where the groups of a view begin and end, one in each layer."""
    starts = [found.start() for found in re.finditer('class="(?:view|layer)"', page)]
    for start, end in pairwise([*starts, len(page)]):
        if page.startswith(f'class="view" data-name="{view}"', start):
            yield start, end


def without(group: str) -> Callable[[str], str]:
    """Take away the strokes of the first group of its kind."""
    return partial(re.sub, rf'(class="{group}" data-name="\w+">\n)(?:<line .*\n)*', r"\g<1>", count=1)


def of(role: str, name: str, tag: str = "circle") -> str:
    return rf'"{role}" data-name="{name}">\n<{tag}'


SIZES, PROFILE = "rocker_sizes", "profile"
HATCH = of("permitted", "centre", "line.*\n<line.*\n<line.*\n<line.*\n<line.*\n<line")  # from the edge to a limit
SPOILED_ROCKERS = {
    "a circle has another radius": ("inversion", shifted(PROFILE, of("circle", "l_OC"), r=0.02)),
    "pivot 7 is not laid off against omega": ("inversion", shifted(PROFILE, of("node", "A7"), cx=0.02)),
    "rocker 7 has another length": ("inversion", shifted(PROFILE, of("node", "A7"), cx=0.1, cy=0.1)),
    "roller 7 is ": ("inversion", shifted(PROFILE, of("node", "B7"), cx=0.1)),
    "roller 7 is not about its centre": ("inversion", shifted(PROFILE, of("roller", "7"), cx=0.02)),
    "a roller misses the profile by": ("contact", shifted(PROFILE, of("curve", "practical", "polygon"), points=-3.0)),
    "the practical profile has a loop": (
        "contact",
        shifted(PROFILE, of("curve", "practical", "polygon"), points=200.0),
    ),
    "the rocker lies on the other side": ("contact", shifted(PROFILE, of("node", "B0"), cx=0.02)),
    "the centre is not at r_0": ("sizes", shifted(SIZES, of("point", "O"), cy=0.02)),
    "r_0 is dimensioned otherwise": (
        "sizes",
        shifted(SIZES, of("dimension", "r_0", "line.*\n<polygon"), points=1.0),
    ),
    "position 5 is elsewhere": ("sizes", shifted(SIZES, of("node", "B5"), cy=0.02)),
    "analogue 5 is laid off otherwise": ("sizes", shifted(SIZES, of("node", "5_rise"), cx=0.02)),
    "limit 5 misses its end": ("sizes", shifted(SIZES, 'class="limit" data-name="5_rise"', x1=0.03, x2=0.03)),
    "limit 5 is turned by": ("sizes", shifted(SIZES, 'class="limit" data-name="5_rise"', x2=0.2)),
    "the centre does not keep the limits": ("sizes", shifted(SIZES, of("point", "O"), cy=-1.0)),
    "the permitted places are not hatched": ("sizes", without("permitted")),
    "a place is hatched that does not keep the limits": ("sizes", shifted(SIZES, HATCH, x2=0.5, y2=-0.5)),
    "a place that keeps the limits is not hatched": ("sizes", shifted(SIZES, HATCH, x2=-2.0, y2=2.0)),
}
SPOILED_ROCKERS_BY_DEFAULT = (
    "roller 7 is ",
    "a roller misses the profile by",
    "limit 5 is turned by",
)  # one of each judge


@pytest.mark.parametrize(
    "fault",
    [
        fault if fault in SPOILED_ROCKERS_BY_DEFAULT else pytest.param(fault, marks=pytest.mark.soak)
        for fault in SPOILED_ROCKERS
    ],
)
def test_the_judges_see_what_is_spoiled_on_a_sheet_of_a_rocker(fault: str) -> None:
    judge, spoil = SPOILED_ROCKERS[fault]

    found = list(JUDGES[judge](FREE, read(*map(spoil, FREE.pages))))

    assert any(one.startswith(fault) for one in found), found


@pytest.mark.soak
def test_numbers_of_positions_stand_apart_where_the_phases_of_a_rocker_fill_the_turn() -> None:
    turn = (("phi_rise", "200 deg"), ("phi_upper", "0 deg"), ("phi_fall", "160 deg"))
    case = CamCase(turn, "A1", "en", ROCKER, only="sizes,profile")

    numbers = case.sheet["profile"].of("position")

    boxes = [shapely.box(*text.box) for text in numbers]
    assert [text.string for text in numbers][:2] == ["0", "1"]
    assert len(numbers) >= case.solved.layout.division.last
    assert not any(a.intersects(b) for k, a in enumerate(boxes) for b in boxes[:k])


@pytest.mark.parametrize(
    ("variant", "lang"), [("1", "uk"), *(pytest.param("2", lang, marks=pytest.mark.soak) for lang in LANGUAGES)]
)
def test_the_example_is_one_a1_in_all_languages(variant: str, lang: str) -> None:
    drawn = sheet(ROCKER, variant, lang=lang)

    assert (drawn.format, len(drawn.pages)) == ("A1", 1)


def test_pressure_angles_of_a_rocker_are_drawn_between_their_limits_over_the_section_lines_of_the_diagrams() -> None:
    view, angles = FREE.sheet["pressure"], FREE.solved.angles
    rise, fall = (view.inside("limit", name) for name in ("rise", "fall-"))
    heights = [p.imag for s in view.inside("curve", "theta") for p in s.points]
    feet = [min(s.points, key=lambda p: p.imag).real for s in view.lines("section")]

    steps = np.diff(feet)

    limits = FREE.solved.rolling.limits
    told = {f"[θ] = {90.0 - math.degrees(gamma):g}°" for gamma in (limits.gamma_rise, limits.gamma_fall)}
    assert told == {text.string for text in view.texts if text.string.startswith("[")}
    assert max(heights) == pytest.approx(rise[0].points[0].imag, abs=NEAR)
    assert min(heights) == pytest.approx(fall[0].points[0].imag, abs=NEAR)
    assert steps == pytest.approx(np.diff(angles) * (steps[0] / (angles[1] - angles[0])), abs=NEAR)


@pytest.mark.parametrize("setting", some([{"rotation": "ccw"}, {"rotation": "cw"}, {"l_OC": "140 mm"}], 1))
def test_the_angle_at_the_pivot_is_that_of_its_positions_drawn(setting: dict[str, str]) -> None:
    found = solve(ROCKER, set=setting)

    roller, centre = (complex(found.solved.values[f"rocker_sizes.{mark}"]) for mark in ("B0", "C"))

    assert found["psi_0"].value == pytest.approx(abs(cmath.phase(centre / roller)), rel=1e-9)


def test_a_triangle_of_no_height_has_its_angle() -> None:
    triangle = LAWS_OF_BOARD["angle_of_triangle"]

    assert triangle(0.1, 0.3, 0.2 * (1.0 - 1e-15)) == 0.0
    assert triangle(0.1, 0.3, 0.4 * (1.0 + 1e-15)) == math.pi
    assert list(triangle(np.array([3.0, 1.0]), 4.0, 5.0)) == pytest.approx([math.pi / 2, math.pi])


@pytest.mark.soak
def test_an_undercut_profile_of_a_rocker_is_drawn_with_its_corner() -> None:
    case = CamCase((("R_roller", "34 mm"),), "A1", "en", ROCKER, only="profile")
    view, solved = case.sheet["profile"], case.solved
    assert solved.rocker is not None
    (cut,) = solved.rocker.profile.undercuts
    mu, R = mu_l(view), case.solved.values["R_roller"]
    (practical,) = view.inside("curve", "practical")
    corner, _ = ring(view, "corner", "1")
    notes = " ".join(text.string for text in view.of("heading"))

    (said,) = re.findall(r"from φ = ([\d.]+)° to ([\d.]+)° .* corner Q, up to ([\d.]+)° of its travel", notes)

    assert [float(one) for one in said[:2]] == pytest.approx(np.degrees([cut.start, cut.end]), abs=0.006)
    assert float(said[2]) == pytest.approx(math.degrees(cut.lost), rel=5e-3)
    k = min(range(len(practical.points)), key=lambda at: abs(practical.points[at] - corner))
    before, at, after = (practical.points[k + step] for step in (-1, 0, 1))
    assert abs(at - corner) < NEAR
    assert abs(angle(at - before, after - at)) > 5.0
    outline = shapely.LinearRing([(p.real, p.imag) for p in practical.points])
    centres = [ring(view, "roller", str(i))[0] for i in range(len(solved.angles))]
    room = {i: outline.distance(shapely.Point(b.real, b.imag)) - R / mu for i, b in enumerate(centres)}
    within = {i for i, phi in enumerate(solved.angles) if cut.start < phi < cut.end}
    assert within
    assert max(room[i] for i in within) > 4.0 * NEAR
    assert all(room[i] > -NEAR if i in within else abs(room[i]) < NEAR for i in room)


def test_the_offsets_that_a_given_r_0_permits_are_drawn_on_its_circle() -> None:
    case = CamCase((("r_0", "50 mm"),), "A3", "en", only="sizes")
    view, values = case.sheet["sizes"], case.solved.values
    (permitted,) = view.inside("offsets", "e")
    assert permitted.arc is not None
    origin, radius, _ = permitted.arc
    mu, ends = values["r_0"] / radius, sorted((permitted.points[k].real for k in (0, -1)), reverse=True)

    found = [(origin.real - x) * mu for x in (*ends, view.point("O").real)]  # the follower is to the right of O

    assert found == pytest.approx([values[name] for name in ("e_least", "e_most", "e")], abs=NEAR * mu)
    assert abs(view.point("O") - origin) == pytest.approx(radius, abs=NEAR)
    assert any("e_{min} = 6.24 mm ≤ e = 8.16 mm ≤ e_{max} = 10.09 mm" in text.string for text in case.sheet.texts)


@pytest.mark.soak
@pytest.mark.parametrize(
    ("e", "said"), [("3 mm", "e = 3.00 mm < e_{min} = 6.24 mm"), ("11 mm", "e = 11.00 mm > e_{max} = 10.09 mm")]
)
def test_a_given_offset_that_is_not_permitted_is_shown_so(e: str, said: str) -> None:
    case = CamCase((("r_0", "50 mm"), ("e", e)), "A3", "en", only="sizes")

    assert any(text.string == said for text in case.sheet.texts)


@pytest.mark.parametrize("covered", [0, 1, 2])
def test_an_angle_whose_letter_has_no_place_beside_it_is_drawn_where_its_arc_is_clear(
    covered: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    style, far, rays = STYLES["A1"], 40.0, (1.0 + 0j, cmath.rect(1.0, 0.8))
    inversion = object.__new__(profile_view._Roller)
    inversion.canvas, inversion.style = Canvas(style), style
    for part in PARTS[:covered]:  # numbers upon the arcs that are wanted first
        inversion.canvas.add(Text(cmath.rect(far * part, 0.4) - 0.5j * 2.0, "8", 2.0, "middle"))
    before = len(inversion.canvas.shapes)
    monkeypatch.setattr(Canvas, "write", lambda *place: False)

    radius = inversion._angle("theta", "theta_3", 0j, rays, far)

    dimensions = inversion.canvas.shapes[before:]
    assert radius == far * PARTS[covered]
    assert [dimension.name for dimension in dimensions] == ["theta_3"]
    assert {shape.radius for shape in dimensions[0].shapes if isinstance(shape, Arc)} == {radius}
    assert [letter.markup for letter in inversion.canvas._letters.values()] == ["theta"]


def test_shapes_of_a_law_of_motion_without_scales_are_of_one_height() -> None:
    case = solve_case("madi-cam")
    view = case.kind.pictured(case, case.words("en"))
    assert view is not None

    curves = {shape.name: shape.shapes for shape in view.shapes if isinstance(shape, Group) and shape.role == "curve"}
    levels = {name: [p.imag for piece in curve for p in piece.points] for name, curve in curves.items()}

    acceleration, travel = (max(level) - min(level) for level in levels.values())
    assert acceleration == pytest.approx(travel)
    assert travel > 10.0
