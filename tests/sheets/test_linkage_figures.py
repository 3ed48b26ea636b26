"""Figures of links of any form: rigid corners, guides as long as the slider's way, blocks, letters that give way."""

from __future__ import annotations

import math
import re

import pytest

from kulman import sheet, solve
from kulman.drawing.formats import STYLES
from kulman.drawing.shapes import Line, Pen, Text
from kulman.drawing.view import Canvas
from kulman.tests.support.linkage_cases import Linkage
from kulman.tests.support.linkage_points import l1_plan, l5_similarity, l7_senses
from kulman.tests.support.printed_numbers import lines_of, table
from kulman.tests.support.readback import View, read
from kulman.tests.support.sheet_geometry import same


def position(task: str, **changes: str) -> View:
    drawn = sheet(task, only="position", format="A1", set=changes or None)
    return read(*(drawn.svg(number) for number in range(1, len(drawn.pages) + 1)))["position"]


def ends(view: View, link: str) -> list[complex]:
    """Ends of the main lines of a link."""
    return [p for s in view.inside("link", link) if len(s.points) == 2 for p in s.points]


def test_slotted_link_is_longer_than_the_way_of_its_block() -> None:
    """The slotted link of the slotter turns round; its block runs to and fro on it."""
    drawn = sheet("scheme-11-slotter", only="position", format="A1")
    view, mu = read(drawn.svg())["position"], drawn.scales["position"].mu
    pivot, pin = view.point("C"), view.point("A")
    e = (pin - pivot) / abs(pin - pivot)
    length = max(((end - pivot) / e).real for end in ends(view, "3"))

    turns = [solve("scheme-11-slotter", set={"phi": str(30 * k)}, only="position") for k in range(12)]
    ways = [math.dist(xy(turn, "A"), xy(turn, "C")) / mu for turn in turns]

    assert max(ways) > 1.2 * min(ways)
    assert length > max(ways) + STYLES["A1"].slider[0] / 2


def xy(solution: object, point: str) -> tuple[float, float]:
    at = solution.solved.point(point)  # type: ignore[attr-defined]
    return at.real, at.imag


@pytest.mark.parametrize(
    ("task", "corners", "arcs"),
    [
        pytest.param("scheme-16-hay-baler", 3, 0, id="three joints not in line"),
        pytest.param("scheme-15-lever-shears", 0, 1, id="three joints in line"),
        pytest.param("scheme-08-planer", 1, 0, id="two arms on a pivot"),
        pytest.param("scheme-06-opposed-compressor", 0, 1, id="two pins opposite on the crank"),
        pytest.param("scheme-19-scotch-yoke", 2, 0, id="a yoke on its block"),
        pytest.param("nau-slider-crank", 0, 0, id="two joints a link"),
    ],
)
def test_rigid_corners_are_marked(task: str, corners: int, arcs: int) -> None:
    rigid = position(task).lines("rigid")

    assert sum(s.arc is None for s in rigid) == corners
    assert sum(s.arc is not None for s in rigid) == arcs


@pytest.mark.parametrize("task", ["scheme-17-sewing-machine"])
def test_triangles_named_by_similarity_have_three_sides(task: str) -> None:
    case = Linkage(task, "0", format="A1", only=("position", "velocity", "acceleration"))

    assert list(l5_similarity(case, case.sheet)) == []


@pytest.mark.parametrize("task", ["scheme-02-forging-press", "scheme-13-toggle-press", "scheme-19-scotch-yoke"])
def test_no_link_crosses_the_hatching_of_a_guide(task: str) -> None:
    case = Linkage(task, "0", format="A1", only=("position",))

    assert list(l1_plan(case, case.sheet)) == []


@pytest.mark.parametrize("task", ["scheme-17-sewing-machine", "scheme-05-articulated-rod"])
def test_corners_of_a_sharp_link_are_no_wedges(task: str) -> None:
    pair = STYLES["A1"].pair
    sizes = [max(abs(a - b) for a in s.points for b in s.points) for s in position(task).lines("rigid")]

    assert 0.5 * pair < min(sizes)
    assert max(sizes) < 3.7 * pair  # round a pin at most


@pytest.mark.parametrize("task", ["scheme-11-slotter", "scheme-20-press-automaton"])
def test_senses_stand_across_their_own_link(task: str) -> None:
    case = Linkage(task, "0", format="A1", only=("position", "velocity", "acceleration"))

    assert list(l7_senses(case, case.sheet)) == []


@pytest.mark.parametrize("task", ["nau-slider-crank", "scheme-03-crank-rocker"])
def test_compass_arcs_can_be_seen_beside_carried_vectors(task: str) -> None:
    """A vector carried to a joint lies along the tangent of the arc by which the joint was found."""
    drawn = sheet(task, only="position,velocity,acceleration", format="A1")
    view = read(drawn.svg())["position"]
    arcs = [s.points for s in view.lines("construction") if s.arc]
    assert arcs

    for arrow in view.arrows:
        for arc in arcs:
            ends = [((end - arrow.tail) * arrow.unit.conjugate()) for end in (arc[0], arc[-1])]
            if min(abs(at - arrow.tail) for at in arc) < 0.5:
                assert all(abs(end.imag) > 1.2 for end in ends)


@pytest.mark.parametrize(
    ("task", "ends"),
    [
        pytest.param("scheme-09-shaper", ("A3", "C"), id="a slotted link, by its point under the block"),
        pytest.param("scheme-03-crank-rocker", ("B", "C"), id="a rocker, by its joints"),
    ],
)
def test_couples_hang_on_the_lever_as_pairs(task: str, ends: tuple[str, str]) -> None:
    """Also the force at the pole is drawn, that at the image of a pivot: it has no moment, but it is half the pair."""
    drawn = sheet(task, only="velocity,forces,lever", format="A1")
    lever = next(v for n in range(1, len(drawn.pages) + 1) for v in read(drawn.svg(n)).views if v.name == "lever")
    found = [a for a in lever.arrows if re.fullmatch(rf"F_(i3|sum)_couple_({'|'.join(ends)})", a.name)]

    assert len(found) == 2
    assert same(found[0].unit, -found[1].unit)
    assert any(min(abs(a.tail - lever.point("lever.p")), abs(a.tip - lever.point("lever.p"))) < 0.01 for a in found)


def test_forces_on_one_line_stay_near_their_slider() -> None:
    drawn = sheet("scheme-13-toggle-press", only="velocity,acceleration,forces", format="A1")
    view = next(v for n in range(1, len(drawn.pages) + 1) for v in read(drawn.svg(n)).views if v.name == "group_45")
    pin, long = view.point("D"), STYLES["A1"].force
    reach = [max(abs(a.tail - pin), abs(a.tip - pin)) for a in (view.arrow(name) for name in ("F_i5", "G_5", "F_5"))]

    assert max(reach) < 3 * long


def test_driver_with_a_short_crank_is_drawn_larger() -> None:
    """Its arms are measured on that figure: the equation of M_bal has its scale factor."""
    drawn = sheet("scheme-17-sewing-machine", only="velocity,acceleration,forces", format="A1", lang="en")
    read_back = read(*(drawn.svg(number) for number in range(1, len(drawn.pages) + 1)))
    view, found = read_back["driver"], solve("scheme-17-sewing-machine").solved
    mu = drawn.scales["driver"].mu

    assert abs(view.point("A") - view.point("O")) > 40.0
    assert abs(abs(view.point("A") - view.point("O")) * mu - found.values["l_OA"]) < 1e-5 * mu
    assert any(t.string == f"μ_{{l1}} = {mu:g} m/mm" for t in view.of("heading"))
    (equation,) = [line for line in lines_of(read_back["equations_forces_1"]) if "M_{bal} = " in line]
    assert "·μ_{l1}" in equation
    (row,) = [
        row for name in read_back.names if "results" in name for row in table(read_back[name]) if row[0] == "h_{21}"
    ]
    assert f"h_{{21}} = {row[1]}" in [t.string for t in view.of("label")]
    assert row[2] == f"{mu:g}"


def test_block_lies_in_its_link_and_turns_with_it() -> None:
    view = position("scheme-09-shaper")
    pivot, pin = view.point("C"), view.point("A")
    (block,) = [s for s in view.inside("link", "2") if len(s.points) == 5]
    a, b, c, _, _ = block.points

    assert same(sum(block.points[:4]) / 4, pin)
    assert min(abs(((side / (pin - pivot)) / abs(side / (pin - pivot))).imag) for side in (b - a, c - b)) < 1e-4


def test_points_on_several_links_have_all_their_numbers() -> None:
    drawn = sheet("scheme-09-shaper", only="position,velocity", format="A1")
    labels = [text.string for text in read(drawn.svg())["position"].of("label")]

    assert "A_{1,2,3}" in labels
    assert "A" not in labels


def test_letter_that_may_give_way_goes_into_the_notes() -> None:
    canvas = Canvas(STYLES["A1"])
    canvas.add(*(Line(complex(-60, y), complex(60, y), Pen.MAIN) for y in range(-60, 61, 3)))
    canvas.label("h = 1", (-1 + 0j, 1 + 0j), spare="h = 1")

    view = canvas.finish("crowded", ("heading",))

    texts = [shape for shape in view.shapes if isinstance(shape, Text)]
    assert [text.role for text in texts if text.markup == "h = 1"] == ["heading"]


def test_letter_with_room_stands_beside_its_line() -> None:
    canvas = Canvas(STYLES["A1"])
    canvas.label("h = 1", (-10 + 0j, 10 + 0j), spare="h = 1")

    view = canvas.finish("empty", ("heading",))

    texts = [shape for shape in view.shapes if isinstance(shape, Text)]
    assert [text.role for text in texts if text.markup == "h = 1"] == ["label"]


@pytest.mark.parametrize(
    "mu", ["0.005", "0.01", *(pytest.param(mu, marks=pytest.mark.soak) for mu in ("0.008", "0.012"))]
)
def test_arcs_of_one_link_stand_apart(mu: str) -> None:
    """On a short link both arcs had the same least radius, one on the other."""
    drawn = sheet("scheme-16-hay-baler", "8", only="position,velocity,acceleration", format="A1", scales={"mu_l": mu})
    view = read(drawn.svg())["position"]

    for link in ("2", "3", "4"):
        arcs = [[s for s in view.inside("arrow", f"{rate}_{link}") if s.arc] for rate in ("omega", "epsilon")]
        assert [len(found) for found in arcs] == [1, 1]
        assert min(abs(a - b) for a in arcs[0][0].points for b in arcs[1][0].points) > 3.0
