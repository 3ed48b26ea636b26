"""Figures of links of any form: corners, guides, blocks, arms, arcs, letters that give way, insets, loads, cycles."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import combinations, pairwise, permutations, product
from types import SimpleNamespace

import numpy as np
import pytest
import shapely

import kulman
from kulman import sheet, solve
from kulman.drawing.formats import STYLES, Style
from kulman.drawing.linkages.figures.cycle import _Band
from kulman.drawing.linkages.figures.group import STEP, Sketch, _Arm, _staggered
from kulman.drawing.linkages.figures.links import Skeleton, _Block
from kulman.drawing.linkages.figures.plan import LEAST_TIMES, SHORT, letter_marks, own_part, told_apart
from kulman.drawing.linkages.figures.scheme import CLEAR, _crowd, _points
from kulman.drawing.page import extent
from kulman.drawing.shapes import Line, Pen, Text, Vector
from kulman.drawing.text import lay_out
from kulman.drawing.view import Canvas
from kulman.plans.linkages.mechanism import Revolute
from kulman.scales.scale import Scale
from kulman.tests.sheets.judge import detached
from kulman.tests.support.cases import some
from kulman.tests.support.linkage_cases import Linkage
from kulman.tests.support.linkage_points import Faults, Judged, l1_plan, l5_similarity, l7_senses
from kulman.tests.support.printed_numbers import lines_of, numbers_of, table
from kulman.tests.support.readback import Arrow, Sheet, Stroke, View, cross, parallel, read, read_back
from kulman.tests.support.sheet_geometry import NEAR, crosses, same
from kulman.variants.reader import load_task
from kulman.variants.sheets import Sheet as Drawn
from kulman.variants.shelf import bundled

STYLE = STYLES["A1"]
FORCES = "velocity,acceleration,forces"


@cache
def drawn(task: str, only: str = "position", lang: str = "uk", variant: str | None = None) -> tuple[Drawn, Sheet]:
    """A sheet of A1, and what is read back of it."""
    found = sheet(task, variant, only=only, format="A1", lang=lang)
    return found, read_back(found)


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
    some(
        [
            pytest.param("scheme-17-sewing-machine", l5_similarity, id="three sides of a triangle named by similarity"),
            pytest.param("scheme-02-forging-press", l1_plan, id="no link across the hatching of a guide"),
            pytest.param("scheme-13-toggle-press", l1_plan, id="nor of a guide under a ram", marks=pytest.mark.soak),
            pytest.param("scheme-19-scotch-yoke", l1_plan, id="nor of a guide of a yoke", marks=pytest.mark.soak),
            pytest.param("scheme-11-slotter", l7_senses, id="senses across their own link"),
            pytest.param("scheme-20-press-automaton", l7_senses, id="senses across links of a triad"),
        ],
        1,
        5,
    ),
)
def test_figure_of_motion_is_without_fault(task: str, judge: Callable[[Judged, Sheet], Faults]) -> None:
    case = Linkage(task, "0", format="A1", only=("position", "velocity", "acceleration"))

    assert list(judge(case, case.sheet)) == []


@pytest.mark.parametrize("task", ["scheme-17-sewing-machine", "scheme-05-articulated-rod"])
def test_corners_of_a_sharp_link_are_no_wedges(task: str) -> None:
    sizes = [max(abs(a - b) for a in s.points for b in s.points) for s in position(task).lines("rigid")]

    assert 0.5 * STYLE.pair < min(sizes)
    assert max(sizes) < 3.7 * STYLE.pair  # round a pin at most


@pytest.mark.parametrize("task", some(["nau-slider-crank", "scheme-03-crank-rocker"], 1))
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


def motion_and_forces(task: str, variant: str, paper: str = "A1") -> Linkage:
    return Linkage(task, variant, format=paper, only=("position", "velocity", "acceleration", "forces", "lever"))


def misplaced(case: Linkage) -> list[object]:
    """Forces that stand far from their nodes, that lie on others, or beside their lines where that need not be."""
    faults: list[object] = []
    for view in (v for v in case.sheet.views if v.name.startswith(("group_", "link_", "driver", "lever"))):
        faults += [fault for fault in detached(view) if fault]
        faults += [fault for arrow in view.arrows if arrow.aside for fault in offset(view, arrow, style_of(case))]
        for one, other in combinations(view.arrows, 2):
            line, near = segment(one.tail, one.tip), segment(other.tail, other.tip)
            if line.intersection(near.buffer(0.5)).length > 0.5 * line.length:
                faults.append((view.name, one.name, other.name))
    return faults


def style_of(case: Linkage) -> Style:
    return STYLES[case.format or "A1"]


def segment(a: complex, b: complex) -> shapely.Geometry:
    return shapely.LineString([(a.real, a.imag), (b.real, b.imag)])


def offset(view: View, arrow: Arrow, style: Style) -> list[object]:
    """What is wrong with an arrow beside its line: not led from its point, or one of the two on that line is free."""
    leads = [line for line in view.lines("extension") if line.name]
    ends = arrow.tail, arrow.tip
    ((node, end),) = [
        s.points for s in leads if s.name == arrow.name and any(same(s.points[-1], p, 0.02) for p in ends)
    ]
    others = [segment(o.tail, o.tip) for o in view.arrows if o.name != arrow.name]
    strokes = [s for s in view.strokes if len(s.points) == 2 and s.path and s.path[-1][0] in ("link", "pivot")]
    main = [segment(*s.points) for s in (*strokes, *view.lines("lever"))]
    main += [segment(s.points[-1], s.points[-1]) for s in leads if s.name != arrow.name]
    gap = min((other.distance(segment(end, end)) for other in others), default=math.inf)
    faults = list[object]()
    if abs(arrow.aside) >= 2.0 * style.label:
        faults.append((arrow.name, "stands far beside its line"))
    if abs(end - node) < 0.7 * style.label or gap < 0.25 * style.label:
        faults.append((arrow.name, "has no leader that is seen"))
    if any(segment(*ends).crosses(line) for line in main):
        faults.append((arrow.name, "crosses a main line"))
    for ray in (arrow.unit, -arrow.unit):
        first = segment(node + ray * 0.1 * style.force, node + ray * 0.35 * style.force)
        if any(first.distance(line) < 0.2 * style.label for line in main):
            continue  # it would lie on the beginning of a line
        ahead = segment(node + ray * 0.35 * style.force, node + ray * style.force)
        if min((ahead.distance(thing) for thing in (*others, *main)), default=9.0) > 0.5 * style.label:
            faults.append((arrow.name, "could stand on its line"))
    return [(view.name, *fault) for fault in faults]


@pytest.mark.soak
def test_forces_within_a_large_block_lie_side_by_side() -> None:
    assert misplaced(motion_and_forces("scheme-10-shaper-two-blocks", "0")) == []


def test_a_force_beside_its_line_stands_across_no_side_of_the_lever() -> None:
    assert misplaced(Linkage("scheme-07-two-stage-compressor", "5")) == []


@pytest.mark.soak
def test_forces_on_one_line_stay_near_their_slider() -> None:
    view = drawn("scheme-13-toggle-press", FORCES)[1]["group_45"]
    pin = view.point("D")
    reach = [max(abs(a.tail - pin), abs(a.tip - pin)) for a in (view.arrow(name) for name in ("F_i5", "G_5", "F_5"))]

    assert max(reach) < 3 * STYLE.force


def test_driver_with_a_short_crank_is_drawn_larger() -> None:
    """Its arms are measured on that figure: the equation of M_bal has its scale factor."""
    of_sheet, read_back = drawn("scheme-12-shaking-conveyor", FORCES, "en")
    view, mu = read_back["driver"], of_sheet.scales["driver"].mu
    crank = abs(view.point("A") - view.point("O"))

    assert crank > 40.0
    assert abs(crank * mu - solve("scheme-12-shaking-conveyor").solved.values["l_OA"]) < 1e-5 * mu
    assert any(t.string == f"μ_{{l1}} = {mu:g} m/mm" for t in view.of("heading"))
    texts = [
        line for name in read_back.names if name.startswith("equations_forces") for line in lines_of(read_back[name])
    ]
    (equation,) = [line for line in texts if "M_{bal} = " in line]
    assert "·μ_{l1}" in equation
    (row,) = [
        row for name in read_back.names if "results" in name for row in table(read_back[name]) if row[0] == "h_{21}"
    ]
    assert f"h_{{21}} = {row[1]}" in [t.string for t in view.of("label")]
    assert row[2] == f"{mu:g}"


@pytest.mark.parametrize(
    ("task", "variant"),
    [
        pytest.param("scheme-13-toggle-press", "2", id="a foot beside the pivot"),
        pytest.param("scheme-06-opposed-compressor", "1", id="a foot above"),
        pytest.param("scheme-07-two-stage-compressor", "4", id="little room beside a foot"),
    ],
)
def test_the_moment_that_balances_turns_clear_of_the_foot_of_its_pivot(task: str, variant: str) -> None:
    view = drawn(task, FORCES, variant=variant)[1]["driver"]
    (arc,) = [s for s in view.inside("arrow", "M_bal") if s.arc]
    foot = view.inside("pivot")

    assert len(foot) > 5
    assert min(shapely.distance(arc.ink, s.ink) for s in foot) > 1.0


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


@pytest.mark.parametrize("task", some(["scheme-08-planer", "scheme-14-jaw-crusher", "nau-slider-crank"], 1))
def test_notes_of_figures_with_forces_share_lines_where_the_figure_has_room(task: str) -> None:
    """Seven lines stood above a lever, the shortest of them `h_G5 = 0`."""
    hung = [view for view in motion_and_forces(task, "7").drawn.views if view.name.startswith(("group_", "lever"))]
    assert len(hung) > 1
    for view in hung:
        rows = [shape for shape in view.shapes if isinstance(shape, Text) and shape.role == "heading"]
        left, _, right, _ = extent(view.shapes)

        assert [row.markup for row in rows if row.name == "note"][::-1] == [*view.notes]
        for one, other in pairwise(view.notes):
            layout = lay_out(f"{one}; {other}", STYLE.text)
            assert layout.right - layout.left > right - left - 0.01


def test_names_of_vectors_make_room_for_the_letters_of_their_ends() -> None:
    scales = {"mu_a": "0.04 (m/s^2)/mm"}
    found = sheet("scheme-15-lever-shears", "2", only="velocity,acceleration", format="A1", scales=scales)
    view = next(view for view in found.views if view.name == "acceleration")

    said = {shape.markup for shape in view.shapes if isinstance(shape, Text) and shape.role == "label"}
    ends = {end for note in view.notes for end in re.findall(r"[a-z]′(?:_\{\d\})?$", note.replace("; ", "\n"), re.M)}

    assert len(ends) > 3
    assert ends <= said


def test_no_letter_touches_the_filled_corner_of_a_rigid_link() -> None:
    view = read(sheet("scheme-18-hydraulic-drive", "2", format="A1").svg())["group_23"]

    corners = [stroke for stroke in view.strokes if stroke.role == "rigid"]
    assert len(corners) == 3
    assert not [text.string for text in view.texts for c in corners if shapely.intersects(text.area, c.ink)]


@pytest.mark.parametrize(("count", "noted"), [(3, 3), (4, 2)])
def test_letters_are_smaller_where_several_would_be_told_in_notes_else(count: int, noted: int) -> None:
    canvas = Canvas(STYLE)
    canvas.add(*(Line(6j * k - 60, 6j * k + 60, Pen.MAIN) for k in range(-12, 13)))
    for k, letter in enumerate("ABCD"[:count]):
        at = 6j * (2 * k - 2.5) - 20
        canvas.label(f"{letter} = 1", (at - 1, at + 1), spare=f"{letter} = 1")

    view = canvas.finish("crowded", ("heading",))

    labels = [shape.height for shape in view.shapes if isinstance(shape, Text) and shape.role == "label"]
    assert labels == [STYLE.text] * (count - noted)
    assert sum(note.count("=") for note in view.notes) == noted


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


FLATTEST = 0.3  # rad, the least that an arc turns to be seen as one


def misturned(case: Linkage) -> list[object]:
    """Arcs of omega and epsilon that turn about the wrong point, cannot be read as arcs, or lie on one another.

    A link that has no fixed pivot turns about one of its joints, for omega and epsilon the same.
    """
    view, style, faults = case.sheet["position"], style_of(case), list[object]()
    arcs = {name: s for s in view.strokes if s.arc for kind, name in s.path if kind == "arrow"}
    lines = {name: shapely.LineString([(p.real, p.imag) for p in arc.points]) for name, arc in arcs.items()}
    first = dict[str, complex]()
    for name, arc in arcs.items():
        assert arc.arc is not None
        (centre, radius, sweep), number = arc.arc, name.rpartition("_")[2]
        turning = {p.point for p in case.oracle.m.pairs if isinstance(p, Revolute) and int(number) in p.links}
        pivots = [view.point(pin) for pin in turning & {*case.oracle.still}]
        if not any(same(centre, at, 0.02) for at in pivots or [first.setdefault(number, centre)]):
            faults.append((name, "turns about a moving joint, or not about that of the other"))
        if radius * abs(sweep) < 2.0 * style.arrow or abs(sweep) < FLATTEST:
            faults.append((name, "is all arrowhead, or looks straight"))
        ends = [end for line in view.inside("link", number) for end in line.points]
        # the line of a link ends at the circle of its joint
        if radius > max(1.2 * style.force, *(abs(end - centre) + style.pair for end in ends)):
            faults.append((name, "stands beyond its link"))
        others = [other for other in arcs if other != name and other.endswith(f"_{number}")]
        faults += [(name, other) for other in others if lines[name].distance(lines[other]) < 0.5 * style.label]
    return faults


@pytest.mark.parametrize(
    ("task", "variant"),
    [("scheme-11-slotter", "4"), pytest.param("scheme-20-press-automaton", "0", marks=pytest.mark.soak)],
)
def test_arcs_of_slotted_links_and_triads_turn_about_the_fixed_pivots(task: str, variant: str) -> None:
    """Seen from the free end of its link an arc shows the opposite sense."""
    assert misturned(motion_and_forces(task, variant)) == []


def unread(case: Linkage) -> list[tuple[str, ...]]:
    """Arms that lie on a force, and those whose letters do not stand on their figures, more than two on a sheet."""
    faults, lost, style = list[tuple[str, ...]](), list[tuple[str, ...]](), style_of(case)
    for view in (view for view in case.sheet.views if view.name.startswith(("group_", "driver", "lever"))):
        told = [t.string for t in view.of("heading") if re.match("h.*[=] [^0]", t.string)]
        sizes = [(part, numbers_of(part.split("=")[-1], "uk")[0]) for text in told for part in text.split("; ")]
        lost += [(view.name, part) for part, mm in sizes if mm > 2.0 * style.text]
        forces = [(a.name, segment(a.tail, a.tip).buffer(0.2 * style.label)) for a in view.arrows]
        for line in (s for s in view.strokes if s.path and s.path[-1][0] == "arm" and s.role == "thin"):
            on = [force for force, ink in forces if ink.intersection(segment(*line.points)).length > 1.5 * style.label]
            faults += [(view.name, line.path[-1][1], "lies on", force) for force in on]
    return faults + lost * (len(lost) > 2)


@pytest.mark.soak
@pytest.mark.parametrize(
    "of",
    [("scheme-15-lever-shears", "3"), pytest.param(("scheme-17-sewing-machine", "9", "A3"), marks=pytest.mark.soak)],
)
def test_arms_of_crowded_groups_are_lettered_on_them(of: tuple[str, ...]) -> None:
    assert unread(motion_and_forces(*of)) == []


def like_dimensions(case: Linkage) -> list[object]:
    """Vectors to and fro that look like a dimension: one line with heads at both ends."""
    faults, least = list[object](), style_of(case).arrow
    for view in (view for view in case.sheet.views if view.name.startswith("forces_")):
        heads = {tip.path[-1][1]: tip.corners[0] for tip in view.tips if tip.path}
        assert heads
        for one, other in combinations(view.vectors, 2):
            if same(one.tail, other.tip) and same(one.tip, other.tail) and abs(one.span) > 3 * least:
                away = [min(abs(heads[v.quantity] - end) for end in (one.tail, one.tip)) for v in (one, other)]
                faults += [(view.name, one.quantity, other.quantity)] if max(away) <= least else []
    return faults


@pytest.mark.parametrize(("seed", "turn"), some([(seed, turn) for seed in range(15) for turn in range(3)], 5))
def test_random_forces_arcs_and_arms_stand_where_they_are_read(seed: int, turn: int) -> None:
    """Forces at their nodes or led there from them, arcs about fixed pivots, arms beside forces, heads apart."""
    random = np.random.default_rng(seed)
    for _ in range(turn + 1):
        task = str(random.choice([name for name in bundled("mechanism") if name != "bertyaev-six-bar"]))
        case = motion_and_forces(
            task, str(random.choice([*load_task(task).variants])), str(random.choice(["A1", "A3"]))
        )

    assert (misplaced(case), misturned(case), like_dimensions(case)) == ([], [], [])
    assert [fault for fault in unread(case) if "lies on" in fault and case.format == "A1"] == []


def test_link_whose_triangle_is_named_has_three_main_sides() -> None:
    """Two of its sides were main lines and the third, drawn for similarity, a thin one."""
    view = drawn("scheme-18-hydraulic-drive", "position,velocity,acceleration")[1]["position"]
    sides = [s for s in view.inside("link", "3") if len(s.points) == 2]

    assert len(sides) == 3
    assert len({s.width for s in sides}) == 1
    letters = [view.point(letter) for letter in "BCD"]
    thin = [s for s in view.lines("similarity") if all(min(abs(p - at) for at in letters) < 3.0 for p in s.points)]
    assert thin == []


@pytest.mark.parametrize(
    ("task", "pairs"), [("nau-slider-crank", 0), ("scheme-17-sewing-machine", 3), ("scheme-09-shaper", 2)]
)
def test_forces_whose_arm_is_a_line_of_the_lever_have_right_angles_there(task: str, pairs: int) -> None:
    """An examiner missed the mark at the balancing force, and at both forces of couples, on every sheet."""
    view = Linkage(task, "3" if task.startswith("nau") else "1", format="A1").sheet["lever"]
    squares = [s.points for s in view.strokes if s.role == "right-angle" and len(s.points) == 3]
    corners = [one + other - middle for one, middle, other in squares]

    def marked(arrow: Arrow) -> bool:
        """Whether a right angle stands where the line of a force meets its arm."""
        way = (arrow.tip - arrow.tail) / abs(arrow.tip - arrow.tail)
        return any(abs(((at - arrow.tail) / way).imag) < 5.0 and abs(at - arrow.tail) < 60.0 for at in corners)

    forces = [arrow for arrow in view.arrows if "F_bal" in arrow.name or (pairs and "couple" in arrow.name)]
    assert len(forces) == 1 + 2 * pairs
    assert all(map(marked, forces))
    assert len(corners) >= 1 + 2 * pairs


@pytest.mark.parametrize("variant", some(["5", "0", "2", "9"], 1))
def test_the_travel_of_a_driver_that_slides_is_dimensioned_from_where_it_is_zero(variant: str) -> None:
    """The plan did not say where the driver stands: of a crank it dimensions phi."""
    task = "scheme-18-hydraulic-drive"
    solution, view = solve(task, variant), Linkage(task, variant, format="A1").sheet["position"]
    (line,) = (s.points for s in view.inside("dimension", "s") if len(s.points) == 2)

    travel = abs(float(solution.case.solved.values["s"]))
    assert abs(line[1] - line[0]) * solution.scales["mu_l"].mu == pytest.approx(travel, abs=1e-5)
    assert min(abs((end - view.point("A")).real) for end in line) < 0.01
    assert any(text.string.replace(" ", "") == f"s={travel * 1e3:.0f}" for text in view.texts)


@pytest.mark.parametrize(
    "task", some(["scheme-20-press-automaton", "scheme-13-toggle-press", "scheme-06-opposed-compressor"], 2)
)
@pytest.mark.parametrize("variant", some(["0", "6"], 0))
def test_letters_of_guides_stand_at_the_ends_of_their_axes(task: str, variant: str) -> None:
    """Amid an axis that is drawn on, the letters stood upon another line."""
    view = Linkage(task, variant, format="A1", only=("position", "velocity", "acceleration")).sheet["position"]
    axes = [s.points for s in view.strokes if s.dashed and len(s.points) == 2]
    letters = [t for t in view.texts if re.fullmatch("([xyz])–\\1", t.string)]

    assert letters
    for (at,) in (t.of for t in letters):
        on = [ends for ends in axes if segment(*ends).distance(segment(at, at)) < 0.05]
        assert on
        assert not any(segment(a + (b - a) * 0.02, b - (b - a) * 0.02).distance(segment(at, at)) < 0.05 for a, b in on)


def test_letters_of_a_guide_stand_at_the_end_of_its_axis_that_is_clear_of_centres_of_mass() -> None:
    """Where S3 came to the end of the axis, its letters were led to S3."""
    view = Linkage("scheme-19-scotch-yoke", "3", format="A3").sheet["position"]
    at = {text.string: text.of[0] for text in view.texts if re.fullmatch("([xyz])–\\1", text.string)}

    assert abs(at["x–x"] - view.point("S3")) > 10


def arm_to(foot: complex, along: complex = 1j) -> _Arm:
    return _Arm(["F"], ["h_F"], foot, along, foot)


@pytest.mark.parametrize(
    ("task", "variant", "figure"),
    some([("scheme-02-forging-press", "7", "group_23"), ("scheme-05-articulated-rod", "0", "group_23")], 0),
)
def test_an_arm_beside_a_link_stands_clear_of_it(task: str, variant: str, figure: str) -> None:
    view = motion_and_forces(task, variant).sheet[figure]
    arms = [s for s in view.strokes if s.path and s.path[-1][0] == "arm" and s.role == "thin" and len(s.points) == 2]
    links = [s for s in view.strokes if s.path and s.path[-1][0] == "link" and len(s.points) == 2]

    assert arms
    for arm, link in product(arms, links):
        for (a, b), (c, d) in product((arm.points, arm.points[::-1]), (link.points, link.points[::-1])):
            if abs(a - c) < 2.0 * STYLE.pair:  # from one joint
                assert abs(math.degrees(cmath.phase((b - a) / (d - c)))) > 12.0


@pytest.mark.parametrize("of", [("nau-slider-crank", "3"), ("scheme-02-forging-press", "7")])
def test_arms_end_in_arrowheads_where_two_have_room(of: tuple[str, str]) -> None:
    case, seen = motion_and_forces(*of), set()
    for view in case.sheet.views:
        for line in (s for s in view.strokes if s.path and s.path[-1][0] == "arm" and len(s.points) == 2):
            heads = [head for head in view.tips if line.path[-1] in head.path]
            roomy = abs(line.points[1] - line.points[0]) > 2.2 * style_of(case).arrow
            seen.add(roomy)
            assert len(heads) == 2 * roomy
            for head, end, other in zip(heads, line.points[::-1], line.points, strict=False):
                back = sum(head.corners[1:]) / 2.0 - head.corners[0]
                assert abs(head.corners[0] - end) < 0.01
                assert abs(cmath.phase(back / (other - end))) < 0.01
    assert True in seen


def test_arms_side_by_side_are_staggered_away_from_the_figure() -> None:
    arms = [arm_to(40 + 0j), arm_to(20 + 0j), arm_to(60 + 0j), arm_to(-30 + 0j), arm_to(25j, 1 + 0j)]

    step = STEP * STYLE.text

    shifts = _staggered(0j, arms, 10 + 50j, STYLE)

    assert shifts == {0: -1j * step, 2: -2j * step}
    upon = _staggered(0j, arms, 10 + 50j, STYLE, [1 + 0.05j])  # nor does the first stay on a line from the pole
    assert upon == {1: -1j * step, 0: -2j * step, 2: -3j * step}


def test_random_arms_that_make_small_angles_do_not_meet() -> None:
    random = np.random.default_rng(5)
    for _ in range(200):
        turns = random.uniform(-0.09, 0.09, 5)
        ways = np.exp(1j * turns)
        arms = [arm_to(complex(w * r), complex(1j * w)) for w, r in zip(ways, random.uniform(10, 60, 5), strict=True)]

        shifts = _staggered(0j, arms, 40j, STYLE)

        assert sorted(round(abs(shift), 9) for shift in shifts.values()) == [
            round(STEP * STYLE.text * k, 9) for k in (1, 2, 3, 4)
        ]
        assert all(shift.imag < 0.0 for shift in shifts.values())
        drawn = [(shifts.get(i, 0j), each.foot + shifts.get(i, 0j)) for i, each in enumerate(arms)]
        assert not any(crosses(one, other) for one, other in combinations(drawn, 2))


@pytest.mark.parametrize(
    ("task", "variant"),
    some([("scheme-16-hay-baler", "0"), ("scheme-12-shaking-conveyor", "3"), ("scheme-20-press-automaton", "0")], 0),
)
def test_of_arms_side_by_side_the_shorter_ones_are_nearer_to_the_pole(task: str, variant: str) -> None:
    view, pairs = Linkage(task, variant).sheet["lever"], 0
    (pole,) = (ring.centre for ring in view.nodes if ring.path[-1][1] == "lever.p")
    every = [s.points for s in view.strokes if s.path and s.path[-1][0] == "arm" and len(s.points) == 2]
    arms = [min((ends, ends[::-1]), key=lambda ends: abs(ends[0] - pole)) for ends in every]

    for (a, b), (c, d) in permutations(arms, 2):
        if abs(b - a) < abs(d - c) - 1.0 and abs(math.degrees(cmath.phase((d - c) / (b - a)))) < 12.0:
            pairs += 1
            assert abs(a - pole) < abs(c - pole)
    assert pairs


@pytest.mark.parametrize("variant", some(["0", "8"], 0))
def test_arms_are_moved_off_forces_that_they_would_cross(variant: str) -> None:
    view = Linkage("scheme-03-crank-rocker", variant).sheet["lever"]
    arms = [s for s in view.strokes if s.path and s.path[-1][0] == "arm" and s.role == "thin" and len(s.points) == 2]
    forces = [(arrow.tail, arrow.tip) for arrow in view.arrows]

    inner = [(a + 0.6 * (b - a) / abs(b - a), b + 0.6 * (a - b) / abs(b - a)) for a, b in (s.points for s in arms)]
    assert len(inner) > 4
    assert not any(crosses(arm, force) for arm, force in product(inner, forces))


@pytest.mark.parametrize(
    ("task", "variant"),
    [("scheme-08-planer", "3"), ("scheme-12-shaking-conveyor", "0"), ("scheme-13-toggle-press", "3")],
)
def test_an_arm_shorter_than_a_block_is_drawn_and_lettered_beside_it(task: str, variant: str) -> None:
    view = read_back(sheet(task, variant, lang="en"))["group_45"]
    (arm,) = (s for s in view.strokes if ("arm", "h_4") in s.path and s.role == "thin")
    blocks = [_drawn(s) for s in view.strokes if s.path and s.path[-1][0] == "link" and len(s.points) > 4]

    assert blocks
    assert 1.0 < abs(arm.points[1] - arm.points[0]) < 6.0
    assert all(block.convex_hull.distance(_drawn(arm)) > 0.5 for block in blocks)
    assert [s for s in view.strokes if ("arm", "h_4") in s.path and s.role == "right-angle"]
    assert [t.string for t in view.of("label") if t.string.startswith("h_{4} = ")]


@pytest.mark.parametrize(
    ("task", "variant", "figure"),
    some([("scheme-13-toggle-press", "0", "group_45"), ("scheme-11-slotter", "0", "group_45")], 0),
)
def test_no_arm_runs_along_a_side_of_a_block(task: str, variant: str, figure: str) -> None:
    view = Linkage(task, variant).sheet[figure]
    links = [s for s in view.strokes if s.path and s.path[-1][0] == "link" and len(s.points) > 4]
    sides = shapely.MultiLineString([_drawn(block) for block in links]).buffer(0.2 * STYLE.label)
    arms = [s for s in view.strokes if s.path and s.path[-1][0] == "arm" and len(s.points) == 2]

    assert links
    assert arms
    assert max(shapely.length(sides.intersection(_drawn(arm))) for arm in arms) < 0.9 * STYLE.label


# Forces of very different size on one plan: the small ones stand in an inset, enlarged, and can be measured there.
NUMERALS = ("I", "II", "III", "IV", "VI", "VII")  # V is a velocity
INSETS = [
    Linkage("scheme-13-toggle-press", "1", format="A1"),
    Linkage("scheme-18-hydraulic-drive", "3", format="A1"),  # one is shorter than an arrowhead in its inset, too
    pytest.param(Linkage("scheme-20-press-automaton", "1", format="A1"), marks=pytest.mark.soak),
]


@pytest.mark.parametrize("case", INSETS, ids=str)
def test_small_forces_stand_in_insets_and_can_be_measured_there(case: Linkage) -> None:
    rows = [row for view in case.sheet.views if view.name.startswith("results_forces") for row in table(view)]
    cells = [(numbers_of(row[1], case.lang), numbers_of(row[2], case.lang)) for row in rows]
    printed = {(mm[0], mu[0]) for mm, mu in cells if mm and mu}
    plans = [view for view in case.sheet.views if view.name.startswith("forces_")]

    numerals = list[str]()
    for plan in plans:
        enlarged = [v for inset in plan.insets for v in inset.vectors if abs(v.span) >= SHORT]
        short = {v.quantity for v in plan.vectors if NEAR < abs(v.span) < STYLE.arrow}
        frames, said = [s.name for s in plan.lines("window")], " ".join(text.string for text in plan.texts)
        points = [abs(plan.vector(name).span) for name in short - {v.quantity for v in enlarged}]
        told = [float(number.replace(",", ".")) for number in re.findall(r"[0-9]+[,.][0-9]{2}\b", said)]
        assert all(min(abs(length - one) for one in told) < 0.00501 for length in points if length < 2.0), plan.name
        assert len(plan.insets) == (len(short) > 1)
        assert frames == [inset.name for inset in plan.insets]
        numerals += [t.string for t in plan.of("label") if t.string in NUMERALS]
        for inset in plan.insets:
            heading, name = sorted(
                (text.string for text in inset.of("heading") if text.name != "note"), key=lambda line: "=" not in line
            )
            assert name == f"Виносний елемент {numerals[-1]}"
            assert f"елемент {numerals[-1]}" in said
            mu = numbers_of(heading.partition("=")[2], case.lang)[0]
            for vector in inset.vectors:
                on_plan = plan.vector(vector.quantity)
                assert (vector.mu, vector.value) == (pytest.approx(mu), on_plan.value)
                assert abs(vector.span) * mu == pytest.approx(on_plan.value, abs=NEAR * mu)
                assert abs(on_plan.span) < NEAR or parallel(vector.span, on_plan.span, 0.01)
    drawn_as = [v for plan in plans for view in (plan, *plan.insets) for v in view.vectors]
    readable = {v.quantity for v in drawn_as if abs(v.span) >= SHORT}
    for name in readable & {"F_i2", "F_i3", "F_i4", "R_12_t", "R_34_t", "G_2", "G_4"}:
        drawn = [(abs(v.span), v.mu) for v in drawn_as if v.quantity == name]
        assert any(abs(mm - length) < 0.0101 and mu == its for mm, mu in printed for length, its in drawn), name
    assert numerals == [*NUMERALS[: len(numerals)]]
    assert numerals


@pytest.mark.parametrize("variant", some(["1", "2", "6"], 1))
def test_vectors_of_a_detail_are_long_enough_for_their_letters(variant: str) -> None:
    view = Linkage("scheme-07-two-stage-compressor", variant).sheet["forces_23"]
    (inset,) = view.insets

    own = [abs(v.span) for v in inset.vectors if NEAR < abs(view.vector(v.quantity).span) < STYLE.arrow]
    assert len(own) > 1
    assert min(own) >= 2.5 * STYLE.arrow


def test_points_of_a_detail_have_their_letters_there_and_but_for_the_pole_not_again_on_the_plan() -> None:
    plans = [view for view in Linkage("scheme-14-jaw-crusher", "0").sheet.views if view.name.startswith("forces_")]
    detailed = [plan for plan in plans if plan.insets]

    assert detailed
    for plan in detailed:
        marks, inside = ({t.string for t in view.of("label") if len(t.of) == 1} for view in (plan, plan.insets[0]))
        assert marks & inside == {"H"}
        assert len(inside) > 3


def _vector(tail: complex, tip: complex) -> Vector:
    return Vector(tail, tip, "R", abs(tip - tail), "N", 1.0)


@pytest.mark.parametrize("turn", [1.0, 1j, cmath.rect(1.0, 2.5)], ids=str)
def test_the_letter_of_a_vector_stands_where_no_other_on_its_line_is_meant(turn: complex) -> None:
    to, fro, again = drawn = [*told_apart(_vector(a * turn, b * turn) for a, b in ((0j, 90), (90 + 0j, 0), (0j, 90)))]
    beside = [[(end / turn).real for end in own_part(vector, drawn, 10.0)] for vector in drawn]

    # of two to and fro the second has its head in the middle; a third that goes with the first shares its head
    assert [to.head, fro.head, again.head] == ["tip", "middle", "tip"]
    assert all(abs(0.5 * sum(part) - head) < 20.0 for part, head in zip(beside, (90.0, 45.0, 90.0), strict=True))

    first, second, whole = (_vector(0j, length * turn) for length in (30.0, 55.0, 100.0))
    aside, hardly = _vector(40 * turn, (90 + 4j) * turn), _vector(0j, 95 * turn)
    ends = [own_part(vector, (first, second, whole, aside), 10.0) for vector in (first, second, whole)]
    assert [[round((end / turn).real) for end in part] for part in ends] == [[0, 30], [30, 55], [55, 100]]
    assert own_part(whole, (hardly,), 10.0) == (whole.tail, whole.tip)


@pytest.mark.parametrize(
    ("task", "variant"),
    some([("scheme-11-slotter", "4"), ("scheme-13-toggle-press", "1"), ("scheme-16-hay-baler", "1")], 1),
)
def test_arc_of_phi_keeps_off_supports_and_other_links(task: str, variant: str) -> None:
    view = Linkage(task, variant, format="A1").sheet["position"]
    (arc,) = (s for s in view.inside("dimension", "phi") if s.arc)
    main = max(stroke.width for stroke in view.strokes)

    foreign = [s for s in view.strokes if (s.width > 0.9 * main or s.role == "hatch") and ("link", "1") not in s.path]
    near = [s for s in foreign if shapely.distance(_drawn(arc), _drawn(s)) < 1.2]
    assert foreign
    assert not near, [stroke.path for stroke in near]


@pytest.mark.parametrize(
    ("task", "variant"),
    some(
        [
            ("scheme-12-shaking-conveyor", "3"),
            ("scheme-01-compressor", "9"),
            ("scheme-10-shaper-two-blocks", "5"),
            ("scheme-15-lever-shears", "6"),
            ("scheme-20-press-automaton", "2"),
            ("scheme-14-jaw-crusher", "4"),
        ],
        0,
        2,
    ),
)
def test_the_hatching_of_supports_stands_off_links_and_their_centres_of_mass(task: str, variant: str) -> None:
    view = Linkage(task, variant, format="A1").sheet["position"]
    bare = [s for s in view.inside("link") if len(s.points) == 2]  # blocks stand on their guides
    rings = [shapely.Point(ring.centre.real, ring.centre.imag).buffer(ring.radius) for ring in view.nodes]

    strokes = [s for s in view.lines("hatch") if any(kind == "pivot" for kind, _ in s.path)]
    assert strokes
    for stroke in strokes:
        assert all(shapely.distance(_drawn(stroke), _drawn(link)) > 0.4 for link in bare), stroke.path
        assert all(shapely.distance(_drawn(stroke), ring) > 0.4 for ring in rings), stroke.path


def _drawn(stroke: Stroke) -> shapely.LineString:
    return shapely.LineString([(point.real, point.imag) for point in stroke.points])


@pytest.mark.soak
def test_notes_of_a_plan_stand_under_its_heading_also_beside_an_inset() -> None:
    case = Linkage("scheme-14-jaw-crusher", "1", format="A1")
    plans = [view for view in case.sheet.views if view.name.startswith("forces_") and view.insets]

    said = [text for plan in plans for text in plan.of("heading") if " = " in text.string and text.name == "note"]
    for plan in plans:
        lines = [(text.box[0] + text.box[2], text.box[1]) for text in plan.of("heading")]
        assert max(middle for middle, _ in lines) - min(middle for middle, _ in lines) < STYLE.text, plan.name
        levels = sorted(level for _, level in lines)
        assert max(b - a for a, b in pairwise(levels)) < 4.0 * STYLE.heading, plan.name
    assert said  # of letters that have no room


def test_letter_beside_the_numeral_of_an_inset_does_not_read_as_its_index() -> None:
    canvas = Canvas(STYLE)
    canvas.detail("I", 0j, 4.0, "inset")
    (numeral,) = (shape for shape in canvas.shapes if isinstance(shape, Text))
    _, low, right, high = extent((numeral,))

    node = complex(right + 4.0 + lay_out("d", STYLE.label).width, 0.5 * (low + high))
    canvas.label("d", node, prefer=-1 + 0j)

    letter = extent([shape for shape in canvas.finish("plan").shapes if getattr(shape, "markup", "") == "d"])
    assert letter[1] < high
    assert letter[0] - right > 3.0


# lines of large forces close together in an inset; one of letters far from its point; notes in the place of letters
@pytest.mark.parametrize(
    ("task", "variant", "format"),
    some(
        [
            ("scheme-14-jaw-crusher", "3", "A3"),
            ("scheme-12-shaking-conveyor", "1", "A1"),
            ("scheme-14-jaw-crusher", "7", "A1"),
            ("scheme-15-lever-shears", "3", "A1"),
            ("scheme-20-press-automaton", "0", "A1"),
        ],
        1,
    ),
)
def test_letters_of_an_inset_stand_in_its_frame_and_notes_have_its_millimetres(
    task: str, variant: str, format: str
) -> None:
    case = Linkage(task, variant, format=format)
    insets = [inset for view in case.sheet.views for inset in view.insets]

    assert insets
    for inset in insets:
        ends = [(p.real, p.imag) for stroke in inset.lines("inset") for p in stroke.points]
        frame = shapely.MultiPoint(ends).envelope
        assert not [text.string for text in inset.of("label") if not frame.covers(text.area)], inset.name
        lengths = {round(abs(vector.span), 2) for vector in inset.vectors}
        for said in (said for text in inset.of("heading") if text.name == "note" for said in text.string.split(";")):
            assert {*numbers_of(said.partition("= ")[2].partition("= ")[2], case.lang)} <= lengths, said


def test_forces_too_short_to_be_drawn_are_told_in_one_note() -> None:
    view = Linkage("scheme-20-press-automaton", "0", format="A1").sheet["forces_2345"]

    said = sorted((text for text in view.of("heading") if "точкою" in text.string), key=lambda text: -text.box[1])
    assert len(said) > 1
    assert all(text.string.count("(") == 4 for text in said[:-1])


@pytest.mark.parametrize("variant", some(["0", "3"], 1))
def test_arms_beside_one_another_are_told_apart(variant: str) -> None:
    case = Linkage("scheme-20-press-automaton", variant, format="A1")
    view = case.sheet["group_2345"]
    lines = [s for s in view.inside("arm") if s.role == "thin" and abs(s.points[-1] - s.points[0]) > STYLE.arrow]

    close = 0
    for one, other in combinations(lines, 2):
        if abs(cmath.phase(((a := _way(one)) / _way(other)) ** 2)) < math.radians(6.0):
            ends = sorted(((p - one.points[0]) / a).real for p in other.points)
            if min(1.0, ends[-1]) - max(0.0, ends[0]) > 0.0:
                close += 1
                assert _drawn(one).distance(_drawn(other)) > 3.5, (one.path, other.path)
    assert close


def _way(line: Stroke) -> complex:
    return line.points[-1] - line.points[0]


@pytest.mark.parametrize("task", some(["scheme-14-jaw-crusher", "scheme-12-shaking-conveyor"], 1))
def test_forces_end_at_the_circles_of_hinges(task: str) -> None:
    sheet = Linkage(task, "1", format="A1").sheet
    views = [view for view in sheet.views if view.name.startswith(("group_", "driver"))]

    hinges = [(view, ring) for view in views for ring in view.rings if abs(ring.radius - STYLE.pair) < NEAR]
    inside = [
        arrow.name
        for view, ring in hinges
        for arrow in view.arrows
        for end in (arrow.tail, arrow.tip)
        if abs(end - ring.centre) < ring.radius - NEAR
    ]
    assert hinges
    assert not inside


# Load diagrams and factors of inertia that a task gives.
def mu_of_axis(view: View, letter: str) -> float:
    (text,) = [t.string for t in view.of("heading") if t.string.startswith(f"μ_{{{letter}}}")]
    return numbers_of(text.partition("=")[2].partition(" (")[0], "en")[0]


@pytest.mark.parametrize(
    ("task", "name", "load"),
    some([("scheme-01-compressor", "p_gas", "F_3"), ("scheme-13-toggle-press", "p_drawing", "F_5")], 0),
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
    return read_back(figures)


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
    "lang", ["uk", pytest.param("ru", marks=pytest.mark.soak), pytest.param("en", marks=pytest.mark.soak)]
)
def test_dead_positions_stand_thin_on_the_plan_of_the_mechanism_from_the_zero_on(lang: str) -> None:
    view = drawn("madi-four-bar", "dead", lang)[1]["position"]
    main, mu, last = max(s.width for s in view.strokes), 2.5, {"uk": "к", "ru": "к", "en": "e"}[lang]
    lines = [s for s in view.strokes if s.role == "dead-position"]

    assert [round(abs(s.points[-1] - s.points[0]) * mu, 3) for s in lines] == 2 * [120.0, 480.0, 380.0]
    assert all(s.width < main and s.dashed for s in lines)
    letters = {text.string: shapely.box(*text.box) for text in view.texts}
    for n, index in enumerate(("0", last)):
        crank, coupler, _ = (s.points for s in lines[3 * n : 3 * n + 3])
        assert abs(((coupler[-1] - crank[0]) / (crank[-1] - crank[0])).imag) < 1e-4  # in one line
        for letter, place in (("B", crank[-1]), ("C", coupler[-1])):
            gaps = {text: box.distance(shapely.Point(place.real, place.imag)) for text, box in letters.items()}
            assert min(gaps, key=lambda text: gaps[text]) == f"{letter}_{{{index}}}"
    notes = " ".join(t.string for t in sorted(view.of("heading"), key=lambda text: -text.baseline))
    angles = [float(text.replace(",", ".")) for text in re.findall(r"φ = ([\d,.]+)°", notes)]
    for angle, (a, b) in zip(angles, (lines[0].points, lines[3].points), strict=True):
        assert math.degrees(np.angle(b - a)) % 360.0 == pytest.approx(angle, abs=0.01)
    swing = [np.angle(s.points[-1] - s.points[0]) for s in (lines[2], lines[5])]
    assert (swing[1] - swing[0]) * (solve("madi-four-bar")["omega_3"].value or 0.0) > 0.0  # it works in the given one


@pytest.mark.parametrize(
    ("task", "slider", "before"),
    [
        pytest.param("nau-slider-crank", "B", -60.0, id="a stroke"),
        pytest.param(
            "scheme-18-hydraulic-drive", "A", math.inf, id="the range of a sliding driver", marks=pytest.mark.soak
        ),
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


@pytest.mark.soak
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


@pytest.mark.parametrize("task", some(["scheme-10-shaper-two-blocks", "scheme-14-jaw-crusher", "nau-slider-crank"], 0))
def test_no_link_stands_between_the_hatching_of_the_driver_and_the_zero_of_the_frame(task: str) -> None:
    view = position(task, "position,velocity,acceleration")
    (zero,) = [text for text in view.of("label") if text.string == "0"]
    links = [shapely.LineString([(p.real, p.imag) for p in s.points]) for s in view.inside("link")]
    hatching = [shapely.LineString([(p.real, p.imag) for p in s.points]) for s in view.lines("hatch")]

    near = min(hatching, key=zero.area.distance)
    assert zero.area.distance(near) < min(zero.area.distance(link) for link in links)


@pytest.mark.parametrize(
    ("said", "last"),
    [
        ({"b": "b in p", "c": "b in p"}, "b in p"),  # one text tells both
        ({"b": "b in p", "c": "c in p"}, ""),
        ({"b": "b in p"}, ""),  # nothing would tell of c
        ({}, ""),
    ],
)
def test_notes_tell_of_marks_in_one_place_only_what_holds_for_all_of_them(said: dict[str, str], last: str) -> None:
    asked = list[tuple[str, str]]()
    canvas = SimpleNamespace(
        part=lambda *shapes: "", parts={}, label=lambda text, at, last, **how: asked.append((text, last))
    )
    scene = SimpleNamespace(last=max, point=lambda at, mark: mark)
    letters = {"b": "b", "c": "c", "d": "d"}

    letter_marks(canvas, scene, letters, {"b": 1 + 1j, "c": 1 + 1j, "d": 9j}, (), said | {"d": "d on the sheet"})

    assert asked == [("b, c", last), ("d", "d on the sheet")]


@pytest.mark.parametrize("turn", [0.0, 0.5, 1.2, 2.5, -2.0], ids="turned by {} rad".format)
def test_an_arrow_leaves_a_block_where_its_side_is_however_the_guide_lies(turn: float) -> None:
    length, height = STYLE.slider
    u = cmath.rect(1.0, turn)
    block = _Block(30.0 + 20.0j, u, (length, height))
    figure = Skeleton(3, (), (block,), (), (), ())
    scene = SimpleNamespace(style=replace(STYLE, force=100.0 * STYLE.force))
    sketch = Sketch(SimpleNamespace(), scene, (), (figure,))
    at = block.at + 0.3 * length * u  # beside the centre, on the axis of the block

    along, back, across, slanted = (sketch._gap(at, u * e) for e in (1.0, -1.0, 1j, cmath.rect(1.0, 0.7)))

    assert along == back == pytest.approx(0.8 * length)  # as if it were the farther end on both sides
    assert across == pytest.approx(0.5 * height)
    out = at - block.at + slanted * u * cmath.rect(1.0, 0.7)
    assert abs((out / u).real) >= 0.5 * length - 1e-9 or abs((out / u).imag) >= 0.5 * height - 1e-9


def test_arrows_of_a_field_of_velocities_have_room_and_do_not_reach_each_other() -> None:
    field = drawn("nau-slider-crank", "cycle")[1]["field"].vectors
    apart = min(abs(a.tail - b.tail) for a, b in combinations(field, 2))

    assert 4.0 * STYLE.arrow < apart < 6.0 * STYLE.arrow
    assert apart / 3.0 < max(abs(vector.tip - vector.tail) for vector in field) < apart


def test_arcs_are_in_the_way_of_exactly_what_they_come_near() -> None:
    random = np.random.default_rng(80)
    ends, sizes = random.uniform(-60.0, 60.0, (6, 4)), random.uniform(0.0, 2.0, 6)
    busy = [(complex(*e[:2]), complex(*e[2:]), size, 1.0) for e, size in zip(ends, sizes, strict=True)]
    radii, angles = random.uniform(5.0, 50.0, (60, 1)), random.uniform(0.0, 6.0, (60, 1))

    points = _points(0j, radii, angles, np.array([[0.2, 0.5]]))

    lines = shapely.linestrings(ends.reshape(6, 2, 2))
    gaps = shapely.distance(shapely.points(points.real, points.imag)[..., None], lines) - sizes
    near = gaps.min(axis=(2, 3)) < CLEAR
    assert 20 < near.sum() < 100
    assert np.array_equal(_crowd(points, busy) > 0.0, near)


@pytest.mark.parametrize("task", ["scheme-19-scotch-yoke", "scheme-10-shaper-two-blocks"])
def test_lines_that_find_a_joint_run_past_it(task: str) -> None:
    view = position(task)
    lines = [line for line in view.lines("construction") if line.name[-2:] in ("_1", "_2") and len(line.points) == 2]

    for line in lines:
        at = view.point(line.name[:-2])
        start, end = line.points
        assert abs(cross(end - start, at - start)) < NEAR * abs(end - start)
        assert 3.0 < abs(end - at) < abs(at - start)
    assert len(lines) == 2


# points between vectors that leave no room, on one vector, beside a force that is too short alone; without any
@pytest.mark.parametrize(
    ("task", "variant", "enlarged"),
    some(
        [
            ("scheme-15-lever-shears", "6", {"acceleration"}),
            ("nau-slider-crank", "3", set()),
            ("scheme-16-hay-baler", "5", {"velocity"}),
            ("scheme-16-hay-baler", "2", {"forces_4"}),
            ("scheme-13-toggle-press", "2", {"acceleration"}),
            ("scheme-09-shaper", "4", {"acceleration"}),
            ("scheme-20-press-automaton", "0", {"acceleration"}),
        ],
        2,
        4,
    ),
)
def test_each_point_of_a_plan_has_its_letter_there_or_in_a_detail(task: str, variant: str, enlarged: set[str]) -> None:
    case = Linkage(task, variant)
    plans, places = [view for view in case.sheet.views if view.vectors], dict[str, set[bool]]()
    for view in (view for plan in plans for view in (plan, *plan.insets)):
        at = [text.of[0] for text in view.of("label") if len(text.of) == 1]
        for ring in view.nodes:
            places.setdefault(ring.path[-1][1], set()).add(any(abs(ring.centre - own) < 0.71 for own in at))

    assert [name for name, lettered in places.items() if True not in lettered] == []
    assert {plan.name for plan in plans if plan.insets} >= enlarged
    assert bool(enlarged) or not any(plan.insets for plan in plans if not plan.name.startswith("forces"))
    numerals = list[str]()
    for plan in plans:
        assert len(plan.insets) == len(plan.lines("window")) < 2
        numerals += [text.string for text in plan.of("label") if text.string in NUMERALS]
        headings = [text.string for inset in plan.insets for text in inset.of("heading")]
        assert [heading for heading in headings if "елемент" in heading] == [
            f"Виносний елемент {numeral}" for numeral in numerals[-1:] if plan.insets
        ]
        for vector in (vector for inset in plan.insets for vector in inset.vectors):
            assert vector.mu * LEAST_TIMES <= plan.vector(vector.quantity).mu * 1.0001
            assert abs(vector.span) * vector.mu == pytest.approx(vector.value, abs=NEAR * vector.mu)
            assert abs(vector.span) < NEAR or parallel(vector.span, plan.vector(vector.quantity).span, 0.01)
    assert len({*numerals}) == len(numerals)


# lines beside vectors, that end between letters, whose mark has a leader; one without any room
@pytest.mark.parametrize(
    ("task", "variant", "noted"),
    some(
        [
            ("scheme-09-shaper", "3", []),
            ("scheme-20-press-automaton", "4", []),
            ("scheme-15-lever-shears", "0", []),
            ("scheme-17-sewing-machine", "0", []),
            ("scheme-17-sewing-machine", "4", ["p′b′ ∥ x–x"]),
        ],
        1,
        4,
    ),
)
def test_each_construction_line_of_a_crowded_plan_has_its_mark(task: str, variant: str, noted: list[str]) -> None:
    case, said = Linkage(task, variant), list[str]()

    for view in (case.sheet["velocity"], case.sheet["acceleration"]):
        lines = {line.name for line in view.lines("construction")}
        marks = [text.string for text in view.of("label") if text.string[0] in "⊥∥"]
        notes = [note for text in view.of("heading") for note in text.string.split("; ") if re.search("[⊥∥]", note)]
        said += notes
        assert len(lines) > 3
        assert len(marks) + len(notes) == len(lines), (view.name, marks)
    assert said == noted


@pytest.mark.parametrize(("only", "letters"), [("position", {"A"}), ("position,velocity", {"A_{1,2,3}"})])
def test_coincident_points_are_lettered_by_their_links_where_they_are_told_apart(only: str, letters: set[str]) -> None:
    strings = {text.string for text in position("scheme-11-slotter", only).texts}

    assert {string for string in strings if string.startswith("A")} == letters
    assert strings >= {"O", "C", "D", "E"}
