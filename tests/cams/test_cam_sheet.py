"""Points C1 to C8 of the examiner's list on sheets of cams that were drawn and read back."""

from __future__ import annotations

import re

import pytest

from kulman import sheet, solve
from kulman.plans.cams.cam import LAWS
from kulman.tests.support.cam_points import POINTS, CamCase, apart
from kulman.tests.support.readback import read
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


def test_the_whole_sheet_of_madi_is_one_a1_or_three_pages_of_a3() -> None:
    small = CamCase((), "A3")

    assert (len(MADI.pages), len(small.pages)) == (1, 3)
    assert sorted(view.name for view in small.sheet.views) == sorted(view.name for view in MADI.sheet.views)
    assert [*apart(small, small.sheet)] == []


@pytest.mark.parametrize("only", ["sizes", pytest.param("diagrams", marks=pytest.mark.soak)])
def test_a_part_of_a_cam_has_room_on_a4_beside_the_title_block(only: str) -> None:
    part = CamCase((), "A4", only=only)

    assert {view.name for view in part.sheet.views} < {view.name for view in MADI.sheet.views}
    assert [*apart(part, part.sheet)] == []


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
        pytest.param({}, 0.001, "M 1:1", id="of the project"),
        pytest.param({"law": "cosine"}, 0.0005, "M 2:1", id="least radii below 30 mm", marks=pytest.mark.soak),
        pytest.param({"h": "40 mm"}, 0.002, "M 1:2", id="more than 150 mm to the top", marks=pytest.mark.soak),
    ],
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
