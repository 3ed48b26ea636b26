"""Figures of links of any form: corners, guides, blocks, arms, arcs, letters that give way, insets, loads, cycles."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import cache
from itertools import combinations

import numpy as np
import pytest

import kulman
from kulman import sheet, solve
from kulman.drawing.formats import STYLES
from kulman.drawing.linkages.figures.cycle import _Band
from kulman.drawing.linkages.figures.group import Arm
from kulman.drawing.linkages.figures.lever import staggered
from kulman.drawing.shapes import Line, Pen, Text
from kulman.drawing.view import Canvas
from kulman.scales.scale import Scale
from kulman.tests.support.linkage_cases import Linkage
from kulman.tests.support.linkage_points import Faults, Judged, l1_plan, l5_similarity, l7_senses
from kulman.tests.support.printed_numbers import lines_of, numbers_of, table
from kulman.tests.support.readback import Sheet, View, parallel, read
from kulman.tests.support.sheet_geometry import NEAR, crosses, same
from kulman.variants.sheets import Sheet as Drawn

STYLE = STYLES["A1"]
FORCES = "velocity,acceleration,forces"


@cache
def drawn(task: str, only: str = "position", lang: str = "uk") -> tuple[Drawn, Sheet]:
    """A sheet of A1, and what is read back of it."""
    found = sheet(task, only=only, format="A1", lang=lang)
    return found, read(*(found.svg(number) for number in range(1, len(found.pages) + 1)))


def position(task: str, only: str = "position") -> View:
    return drawn(task, only)[1]["position"]


def test_slotted_link_is_longer_than_the_way_of_its_block() -> None:
    """The slotted link of the slotter turns round; its block runs to and fro on it."""
    view, mu = position("scheme-11-slotter"), drawn("scheme-11-slotter")[0].scales["position"].mu
    pivot, pin = view.point("C"), view.point("A")
    e = (pin - pivot) / abs(pin - pivot)
    ends = [p for s in view.inside("link", "3") if len(s.points) == 2 for p in s.points]
    length = max(((end - pivot) / e).real for end in ends)

    turns = [solve("scheme-11-slotter", set={"phi": str(30 * k)}, only="position").solved for k in range(12)]
    ways = [abs(turn.point("A") - turn.point("C")) / mu for turn in turns]

    assert max(ways) > 1.2 * min(ways)
    assert length > max(ways) + STYLE.slider[0] / 2


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


@pytest.mark.parametrize(
    ("task", "judge"),
    [
        pytest.param("scheme-17-sewing-machine", l5_similarity, id="three sides of a triangle named by similarity"),
        pytest.param("scheme-02-forging-press", l1_plan, id="no link across the hatching of a guide"),
        pytest.param("scheme-13-toggle-press", l1_plan, id="nor of a guide under a ram"),
        pytest.param("scheme-19-scotch-yoke", l1_plan, id="nor of a guide of a yoke"),
        pytest.param("scheme-11-slotter", l7_senses, id="senses across their own link"),
        pytest.param("scheme-20-press-automaton", l7_senses, id="senses across links of a triad"),
    ],
)
def test_figure_of_motion_is_without_fault(task: str, judge: Callable[[Judged, Sheet], Faults]) -> None:
    case = Linkage(task, "0", format="A1", only=("position", "velocity", "acceleration"))

    assert list(judge(case, case.sheet)) == []


@pytest.mark.parametrize("task", ["scheme-17-sewing-machine", "scheme-05-articulated-rod"])
def test_corners_of_a_sharp_link_are_no_wedges(task: str) -> None:
    sizes = [max(abs(a - b) for a in s.points for b in s.points) for s in position(task).lines("rigid")]

    assert 0.5 * STYLE.pair < min(sizes)
    assert max(sizes) < 3.7 * STYLE.pair  # round a pin at most


@pytest.mark.parametrize("task", ["nau-slider-crank", "scheme-03-crank-rocker"])
def test_compass_arcs_can_be_seen_beside_carried_vectors(task: str) -> None:
    """A vector carried to a joint lies along the tangent of the arc by which the joint was found."""
    view = position(task, "position,velocity,acceleration")
    arcs = [s.points for s in view.lines("construction") if s.arc]
    assert arcs

    for arrow in view.arrows:
        for arc in arcs:
            ends = [((end - arrow.tail) * arrow.unit.conjugate()) for end in (arc[0], arc[-1])]
            if min(abs(at - arrow.tail) for at in arc) < 0.5:
                assert all(abs(end.imag) > 1.2 for end in ends)


def test_forces_on_one_line_stay_near_their_slider() -> None:
    view = drawn("scheme-13-toggle-press", FORCES)[1]["group_45"]
    pin = view.point("D")
    reach = [max(abs(a.tail - pin), abs(a.tip - pin)) for a in (view.arrow(name) for name in ("F_i5", "G_5", "F_5"))]

    assert max(reach) < 3 * STYLE.force


def test_driver_with_a_short_crank_is_drawn_larger() -> None:
    """Its arms are measured on that figure: the equation of M_bal has its scale factor."""
    of_sheet, read_back = drawn("scheme-17-sewing-machine", FORCES, "en")
    view, mu = read_back["driver"], of_sheet.scales["driver"].mu
    crank = abs(view.point("A") - view.point("O"))

    assert crank > 40.0
    assert abs(crank * mu - solve("scheme-17-sewing-machine").solved.values["l_OA"]) < 1e-5 * mu
    assert any(t.string == f"μ_{{l1}} = {mu:g} m/mm" for t in view.of("heading"))
    (equation,) = [line for line in lines_of(read_back["equations_forces_1"]) if "M_{bal} = " in line]
    assert "·μ_{l1}" in equation
    (row,) = [
        row for name in read_back.names if "results" in name for row in table(read_back[name]) if row[0] == "h_{21}"
    ]
    assert f"h_{{21}} = {row[1]}" in [t.string for t in view.of("label")]
    assert row[2] == f"{mu:g}"


@pytest.mark.parametrize(("lines", "role"), [("", "label"), ("along", "heading"), ("across", "heading")])
def test_letter_that_may_give_way_goes_into_the_notes_where_lines_leave_no_room(lines: str, role: str) -> None:
    canvas, way = Canvas(STYLE), {"": 0j, "along": 1 + 0j, "across": 1j}[lines]
    if lines:
        canvas.add(*(Line((1j * k - 60) * way, (1j * k + 60) * way, Pen.MAIN) for k in range(-60, 61, 3)))
    canvas.label("h = 1", (-1 + 0j, 1 + 0j), spare="h = 1")
    canvas.label("O", 90 + 0j)

    view = canvas.finish("crowded", ("heading",))

    roles = {shape.markup: shape.role for shape in view.shapes if isinstance(shape, Text)}
    assert roles == {"heading": "heading", "h = 1": role, "O": "label"}


@pytest.mark.parametrize(
    "mu", ["0.005", "0.01", *(pytest.param(mu, marks=pytest.mark.soak) for mu in ("0.008", "0.012"))]
)
def test_arcs_of_one_link_stand_apart(mu: str) -> None:
    """On a short link both arcs had the same least radius, one on the other."""
    plans = "position,velocity,acceleration"
    view = read(sheet("scheme-16-hay-baler", "8", only=plans, format="A1", scales={"mu_l": mu}).svg())["position"]

    for link in ("2", "3", "4"):
        arcs = [[s for s in view.inside("arrow", f"{rate}_{link}") if s.arc] for rate in ("omega", "epsilon")]
        assert [len(found) for found in arcs] == [1, 1]
        assert min(abs(a - b) for a in arcs[0][0].points for b in arcs[1][0].points) > 3.0


def arm_to(foot: complex, along: complex = 1j) -> Arm:
    return Arm(["F"], ["h_F"], foot, along, foot)


def test_arms_side_by_side_are_staggered_away_from_the_figure() -> None:
    arms = [arm_to(40 + 0j), arm_to(20 + 0j), arm_to(60 + 0j), arm_to(-30 + 0j), arm_to(25j, 1 + 0j)]

    shifts = staggered(0j, arms, 10 + 50j, 8.0)

    assert shifts == {0: -8j, 2: -16j}


def test_random_arms_that_make_small_angles_do_not_meet() -> None:
    random = np.random.default_rng(5)
    for _ in range(200):
        turns = random.uniform(-0.1, 0.1, 5)
        ways = np.exp(1j * turns)
        arms = [arm_to(complex(w * r), complex(1j * w)) for w, r in zip(ways, random.uniform(10, 60, 5), strict=True)]

        shifts = staggered(0j, arms, 40j, 9.0)

        assert sorted(round(abs(shift), 9) for shift in shifts.values()) == [9.0, 18.0, 27.0, 36.0]
        assert all(shift.imag < 0.0 for shift in shifts.values())
        drawn = [(shifts.get(i, 0j), each.foot + shifts.get(i, 0j)) for i, each in enumerate(arms)]
        assert not any(crosses(one, other) for one, other in combinations(drawn, 2))


# Forces of very different size on one plan: the small ones stand in insets, enlarged, and can be measured there.
NUMERALS = ("I", "II", "III", "IV", "V")
INSETS = [
    Linkage("scheme-13-toggle-press", "1", format="A1"),
    pytest.param(Linkage("scheme-18-hydraulic-drive", "1", format="A1"), marks=pytest.mark.soak),
    pytest.param(Linkage("scheme-20-press-automaton", "1", format="A1"), marks=pytest.mark.soak),
]


@pytest.mark.parametrize("case", INSETS, ids=str)
def test_small_forces_stand_in_insets_and_can_be_measured_there(case: Linkage) -> None:
    rows = [row for view in case.sheet.views if view.name.startswith("results_forces") for row in table(view)]
    cells = [(numbers_of(row[1], case.lang), numbers_of(row[2], case.lang)) for row in rows]
    printed = {(mm[0], mu[0]) for mm, mu in cells if mm and mu}
    plans = [view for view in case.sheet.views if view.name.startswith("forces_")]

    assert [inset for plan in plans for inset in plan.insets]
    for plan in plans:
        enlarged = [v for inset in plan.insets for v in inset.vectors if abs(v.span) >= STYLE.arrow]
        short = {v.quantity for v in plan.vectors if NEAR < abs(v.span) < STYLE.arrow}
        frames = [s.name for view in (plan, *plan.insets) for s in view.lines("window")]
        letters = [t.string for view in (plan, *plan.insets) for t in view.of("label")]
        assert len(short - {v.quantity for v in enlarged}) <= 1, plan.name  # at most one force of a plan is a point
        assert sorted(frames) == sorted(inset.name for inset in plan.insets)
        assert sum(letter in NUMERALS for letter in letters) == len(frames)
        for inset in plan.insets:
            (heading,) = [text.string for text in inset.of("heading")]
            mu = numbers_of(heading.partition("=")[2], case.lang)[0]
            for vector in inset.vectors:
                on_plan = plan.vector(vector.quantity)
                assert (vector.mu, vector.value) == (pytest.approx(mu), on_plan.value)
                assert abs(vector.span) * mu == pytest.approx(on_plan.value, abs=NEAR * mu)
                assert abs(on_plan.span) < NEAR or parallel(vector.span, on_plan.span, 0.01)
        for name in ("F_i2", "F_i3", "F_i4", "R_12_t", "R_34_t", "G_2", "G_4"):
            large = [v for v in enlarged if v.quantity == name]
            if large and abs(plan.vector(name).span) < STYLE.arrow:
                assert any((round(abs(v.span), 2), v.mu) in printed for v in large), name


# Load diagrams and factors of inertia that a task gives.
def mu_of_axis(view: View, letter: str) -> float:
    (text,) = [t.string for t in view.of("heading") if t.string.startswith(f"μ_{{{letter}}}")]
    return numbers_of(text.partition("=")[2].partition(" (")[0], "en")[0]


@pytest.mark.parametrize(
    ("task", "name", "load"),
    [("scheme-01-compressor", "p_gas", "F_3"), ("scheme-13-toggle-press", "p_drawing", "F_5")],
)
def test_load_diagram_is_drawn_to_its_scales(task: str, name: str, load: str) -> None:
    """Corners of the curve are the task's places and values; the marked ordinate is the load of this position."""
    values = solve(task).solved.values
    view = drawn(task, f"structure,{FORCES}", "en")[1][f"load_{name}"]
    (line,) = [s for s in view.inside("curve", name) if len(s.points) > 2]
    origin = line.points[0] - 1j * values["zero"]
    mu_s, mu_F = (mu_of_axis(view, letter) for letter in "sF")
    stroke = abs(values["_stroke_end"] - values["_stroke_begin"])
    top = max(point.imag for point in line.points) - origin.imag

    (mark,) = view.lines("ordinate", load)

    assert abs((line.points[-1].real - origin.real) * mu_s - stroke) < 0.01 * mu_s
    assert abs(top * mu_F - values["F_max"]) < 0.01 * mu_F
    assert abs(abs(mark.points[1] - mark.points[0]) * mu_F - abs(values[load])) < 0.01 * mu_F
    assert abs((mark.points[0].real - origin.real) * mu_s - values["_stroke_part"] * stroke) < 0.01
    assert not same(mark.points[0], mark.points[1])


# The sheet of a whole cycle.
@cache
def cycle_sheet(task: str = "nau-slider-crank") -> Sheet:
    figures = kulman.sweep(task, positions=12).drawn()
    return read(*(figures.svg(number) for number in range(1, len(figures.pages) + 1)))


def labels(view: str) -> list[str]:
    return [text.string for text in cycle_sheet()[view].of("label")]


def test_positions_are_numbered_as_points_and_show_how_the_crank_turns() -> None:
    """A bare number is that of a link."""
    written = labels("positions")

    assert {f"A_{{{number}}}" for number in range(12)} <= set(written)
    numbers = [n for text in written if text.startswith("B_") for n in re.findall(r"\d+", text)]
    assert sorted(map(int, numbers)) == list(range(12))
    assert sorted(text for text in written if text.isdigit()) == ["1", "2", "3"]
    turning = cycle_sheet()["positions"].turning("omega_1")
    assert turning is not None
    assert turning[1] == math.copysign(1.0, kulman.solve("nau-slider-crank").solved.values["omega_1"])
    assert "ω_{1}" in written


@pytest.mark.parametrize(
    ("task", "slider", "before"),
    [
        pytest.param("nau-slider-crank", "B", -60.0, id="a stroke"),
        pytest.param("scheme-18-hydraulic-drive", "A", math.inf, id="the range of a sliding driver"),
    ],
)
def test_guide_is_as_long_as_what_slides_on_it_moves(task: str, slider: str, before: float) -> None:
    view = cycle_sheet(task)["positions"]
    ends = [p.real for s in view.inside("guide") if s.role != "hatch" for p in s.points]
    places = [ring.centre.real for ring in view.rings if abs(ring.centre.imag - view.point(slider).imag) < 0.01]
    on_guide = [x for x in places if before > 0.0 or x < view.point("O").real + before]

    assert min(ends) < min(on_guide)
    assert max(ends) > max(on_guide)


def test_rays_have_the_numbers_of_their_chords() -> None:
    view = cycle_sheet()["diagrams"]
    rays = [s.name for s in view.lines("ray")]
    numbers = sorted(int(n) for name in rays for n in name.split())

    assert numbers == sorted([*range(1, 13)] * 2)
    assert all(name.replace(" ", ", ") in labels("diagrams") for name in rays)


def test_rates_without_limit_are_cut_off() -> None:
    """The rocker of the tipper turns without limit where its links stretch out, at both ends of the drive's range."""
    diagrams = cycle_sheet("scheme-18-hydraulic-drive")["diagrams"]
    scales = {t.string.partition(";")[0]: t.string for t in diagrams.of("label") if "μ" in t.string}

    assert scales["ω_{3}"].endswith("μ_{ω} = 0.1 (rad/s)/mm")
    assert any("ω_{3}, ε_{3}" in t.string for t in diagrams.of("heading"))


@pytest.mark.parametrize(
    ("curve", "chords", "ends"),
    [((0.2, 0.5), None, (0.0, 0.5)), ((-3.0, -1.0), None, (-3.0, 0.0)), ((0.2, math.nan), (-0.1, 0.7), (-0.1, 0.7))],
)
def test_axis_of_a_diagram_spans_zero_the_curve_and_its_chords(
    curve: tuple[float, ...], chords: tuple[float, ...] | None, ends: tuple[float, float]
) -> None:
    by_chords = None if chords is None else (np.arange(2.0), np.array(chords))

    assert _Band("V_B", Scale("mu_V", 0.1, "m/s"), np.array(curve), by_chords).ends == ends
