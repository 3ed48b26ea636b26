"""Points H1 to H5 of the examiner's list on sheets of hoists that were read back."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
import pytest
import shapely

from kulman import sheet
from kulman.plans.hoist.construction import EXTREMES, FORCES, LIFT_OFF
from kulman.tests.sheets.judge import overlaps, thin_faults
from kulman.tests.support.cam_points import node, printed_scales
from kulman.tests.support.hoists import VARIANTS, together, two_sided
from kulman.tests.support.printed_numbers import half_digit
from kulman.tests.support.readback import Sheet, Stroke, View, read, read_back
from kulman.variants.sheets import Sheet as Drawing


@cache
def first() -> Sheet:
    """The sheet of the first variant, whose diagrams have room."""
    return read(sheet("karpenko-hoist", "V01").svg())


def test_beams_are_named_beside_their_ends() -> None:
    view = first()["beams"]
    circles = shapely.union_all([shapely.Point(r.centre.real, r.centre.imag).buffer(r.radius) for r in view.rings])

    names = [text for text in view.of("label") if text.string.startswith("балка")]
    assert [text.string[-1] for text in names] == ["0", "2"]
    assert all(text.area.distance(circles) > 1.0 for text in names)  # as digits they read as one number with these


@pytest.mark.parametrize("plan", [LIFT_OFF, EXTREMES, FORCES])
def test_numbers_of_an_axis_have_as_many_decimals_as_one_another(plan: str) -> None:
    texts = first()[plan].of("number")
    feet = min(text.box[1] for text in texts)

    for below in (True, False):
        axis = [text.string for text in texts if (text.box[1] < feet + 1.0) is below and text.string != "0"]
        assert len(axis) > 2
        assert len({len(number.partition(",")[2]) for number in axis}) == 1, axis


def test_the_crossing_of_a_hoist_is_drawn_larger_where_the_diagram_has_room() -> None:
    view = first()["lift_off"]
    (window,) = (s for s in view.strokes if ("frame", "magnified") in s.path)
    (parabola,) = (s.points for s in view.strokes if ("curve", "parabola") in s.path)

    right, top = (max(part) for part in ([p.real for p in window.points], [p.imag for p in window.points]))
    left = min(p.real for p in window.points)

    assert right < max(p.real for p in parabola)  # inside, below the curve
    assert all(p.imag > top for p in parabola if p.real > left)


@pytest.mark.soak
@pytest.mark.parametrize("paper", ["A4", pytest.param("A1", marks=pytest.mark.soak)])
@pytest.mark.parametrize(
    "variant", ["V08", *(pytest.param(variant, marks=pytest.mark.soak) for variant in ("V01", "V05"))]
)
def test_letter_of_the_parabola_does_not_stand_among_the_numbers_of_the_axis(variant: str, paper: str) -> None:
    drawing = sheet("karpenko-hoist", variant, format=paper)
    view = read_back(drawing)["lift_off"]
    (foot,) = (line.points[0].imag for line in view.lines("scale"))

    letters = [
        t for t in view.texts if t.string.startswith("y − mg") and t.box[2] < view.lines("scale")[0].points[1].real
    ]

    assert letters
    assert all(text.box[1] > foot for text in letters if text.box[3] > foot - 12.0)


NEAR = 0.02  # mm, as far as curves of many points are read


@dataclass(frozen=True)
class HoistCase:
    """A variant with changes on a format, in a language."""

    variant: str = "V04"
    changes: tuple[tuple[str, float], ...] = ()
    format: str = "A1"
    lang: str = "uk"

    def __str__(self) -> str:
        return f"{self.variant}-{self.format}-{self.lang}-{dict(self.changes)}"

    @cached_property
    def drawn(self) -> Drawing:
        changes = {name: repr(value) for name, value in self.changes}
        return sheet("karpenko-hoist", self.variant, set=changes, format=self.format, lang=self.lang)

    @cached_property
    def sheet(self) -> Sheet:
        return read_back(self.drawn)

    @cached_property
    def values(self) -> dict[str, float]:
        return {**VARIANTS[self.variant], **dict(self.changes)}

    @cached_property
    def forces(self) -> dict[str, float]:
        """Forces and times by integration, SI, with the weight m g."""
        found = {name: float(value[0]) for name, value in two_sided(together([self.values])).items()}
        return found | {"m": (self.values["G_1"] + self.values["G_2"] / 3.0) / 9.81}


PUSHED = HoistCase(changes=(("I_0", 2.7e-6), ("a", 0.0)))  # the rope would push
SLACK = HoistCase("V09", (("V_0", 1.0),), lang="en")  # it goes slack in phase 2
RIGID = HoistCase(changes=(("I_0", math.inf), ("I_2", math.inf)))


CASES = (
    *(HoistCase(), HoistCase("V03", lang="ru"), pytest.param(HoistCase("V02", lang="en"), marks=pytest.mark.soak)),
    *(pytest.param(HoistCase(variant), marks=pytest.mark.soak) for variant in VARIANTS if variant != HoistCase.variant),
)
SMALL = [pytest.param(HoistCase(format=format), marks=pytest.mark.soak) for format in ("A3", "A2")]
every_case = pytest.mark.parametrize("case", CASES, ids=str)


def number(text: str) -> float:
    return float(text.replace(",", ".").replace("−", "-"))


def mu(view: View, symbol: str) -> float:
    """The printed scale factor, SI per mm."""
    return printed_scales(view)[f"μ_{{{symbol}}}"]


def printed(view: View, symbol: str) -> float:
    """The number printed after `symbol =`."""
    texts = [text.string for text in view.texts if text.string.startswith(f"{symbol} = ")]
    assert texts, symbol
    return number(texts[0].split(" = ")[1].split(" ")[0])


def curve(view: View, name: str) -> np.ndarray:
    (stroke,) = view.inside("curve", name)
    return np.array(stroke.points)


@every_case
def test_scheme_is_drawn_to_its_scale_and_dimensioned(case: HoistCase) -> None:  # H1
    view, values = case.sheet["scheme"], case.values
    scale = mu(view, "l")

    (rope,) = view.lines("rope", "L")

    for left, right, i in (("O1", "O2", 0), ("B1", "B2", 2)):
        (beam,) = [stroke for stroke in view.inside("link", str(i)) if len(stroke.points) == 2]
        a, b = sorted(beam.points, key=lambda point: point.real)
        assert abs(b - a) * scale == pytest.approx(values[f"l_{i}"], abs=0.02 * scale)
        at = rope.points[-1].real
        assert (at - a.real) * scale == pytest.approx(values[f"beta_{i}"] * values[f"l_{i}"], abs=0.02 * scale)
        assert printed(view, f"l_{{{i}}}") == pytest.approx(values[f"l_{i}"])
        assert max(abs(view.point(left) - a), abs(view.point(right) - b)) < 0.02
    ratio = re.search(r"1:([\d.,]+)", " ".join(text.string for text in view.of("heading")))
    assert ratio is not None
    assert number(ratio[1]) == pytest.approx(scale * 1e3)
    model = [text.string for text in case.sheet["model"].texts]
    assert {"m", "mg", "s", "C_{01}", "C_{12}", "F_{01}", "F_{12}"} <= set(model)


@every_case
def test_forces_over_time_join_and_swing_about_the_mean(case: HoistCase) -> None:  # H2
    view, found = case.sheet["forces"], case.forces
    support, rope, lifted = (curve(view, name) for name in ("F_01", "F_12", "P_12"))
    of_F, of_t = mu(view, "F"), mu(view, "t")
    origin = complex(support[0].real, support[-1].imag)

    weight, mean = found["m"] * 9.81, found["m"] * (9.81 + case.values["a"])
    assert (support[0] - origin).imag * of_F == pytest.approx(-weight, abs=NEAR * of_F)
    assert abs((support[1] - support[0]).imag) < NEAR
    assert (support[-1] - origin).real * of_t == pytest.approx(found["t_1"], abs=NEAR * of_t)
    assert abs(rope[0] - origin) < NEAR
    assert (rope[-1] - origin).imag * of_F == pytest.approx(found["F_12_t1"], abs=NEAR * of_F)
    assert abs(rope[-1] - lifted[0]) < NEAR  # no jump, and no kink
    slopes = [(b - a).imag / (b - a).real for a, b in ((rope[-2], rope[-1]), (lifted[0], lifted[1]))]
    assert slopes[0] == pytest.approx(slopes[1], abs=0.05 * (1.0 + abs(slopes[1])))
    heights = (lifted - origin).imag * of_F
    assert np.max(heights) == pytest.approx(found["P_12_max"], abs=2.0 * NEAR * of_F)
    assert np.min(heights) == pytest.approx(found["P_12_min"], abs=2.0 * NEAR * of_F)
    assert 0.5 * (np.max(heights) + np.min(heights)) == pytest.approx(mean, abs=2.0 * NEAR * of_F)
    top = (node(view, "P_12_max") - origin).real * of_t
    assert top == pytest.approx(found["t_1"] + found["T_1"], abs=NEAR * of_t)
    for name, level in (("P_st", weight), ("P_m", mean)):
        (line,) = view.lines("level", name)
        assert (line.points[0] - origin).imag * of_F == pytest.approx(level, abs=NEAR * of_F)
    symbols = {"P_12_max": "P_{12 max}", "F_12_t1": "F_{12}(t_{1})", "P_12_min": "P_{12 min}"}
    for name, symbol in symbols.items():
        drawn = (node(view, name) - origin).imag * of_F
        assert printed(view, symbol) == pytest.approx(drawn, abs=NEAR * of_F + 1e-3 * abs(drawn))


@every_case
def test_drawn_roots_are_crossings_and_the_circle_has_the_swing(case: HoistCase) -> None:  # H3
    lift_off, extremes, circle = (case.sheet[name] for name in ("lift_off", "extremes", "circle"))
    found = case.forces
    parabola, wave = curve(lift_off, "parabola"), curve(lift_off, "sinusoid")
    of_t = mu(lift_off, "t1")

    difference = (parabola - wave).imag
    k = int(np.flatnonzero((difference[:-1] < 0.0) & (difference[1:] >= 0.0))[0])
    part = difference[k] / (difference[k] - difference[k + 1])
    crossing = parabola[k] + part * (parabola[k + 1] - parabola[k])
    assert (crossing - parabola[0]).real * of_t == pytest.approx(found["t_1"], rel=1e-3)
    assert abs(node(lift_off, "X") - crossing) < 1.5  # chords
    drawn = [ring.centre for ring in extremes.rings if any(k == "node" and n.startswith("X") for k, n in ring.path)]
    start = curve(extremes, "sinusoid")[0].real
    assert all(0.0 < (at.real - start) * mu(extremes, "t1") < found["t_1"] for at in drawn)
    if found["F_12_max"] > found["F_12_t1"] * (1.0 + 1e-9):
        assert drawn
    if not drawn:
        words = {"uk": "немає", "ru": "нет", "en": "no extremes"}[case.lang]
        assert any(words in text.string for text in extremes.texts)
    centre, ends = node(circle, "P_m"), (node(circle, "P_12_min"), node(circle, "P_12_max"))
    of_P, radius = mu(circle, "P"), abs(ends[1] - centre)
    assert radius * of_P == pytest.approx(0.5 * (found["P_12_max"] - found["P_12_min"]), abs=NEAR * of_P)
    begin = node(circle, "F_12_t1")
    assert abs(abs(begin - centre) - radius) < NEAR
    mean = 0.5 * (found["P_12_max"] + found["P_12_min"])
    assert (begin - centre).real * of_P == pytest.approx(found["F_12_t1"] - mean, abs=NEAR * of_P)
    angle = np.angle(begin - centre) % (2.0 * math.pi)
    assert printed(circle, "φ_{1}") == pytest.approx(angle, rel=1e-3)


@every_case
def test_moment_of_the_greatest_force_is_the_sum_of_times_as_they_are_printed(case: HoistCase) -> None:
    cells = [cell.string for cell in case.sheet["results"].of("cell")]
    first, swing = (number(cells[cells.index(name) + 1]) for name in ("t_{1}", "T_{1}"))
    texts = (text.string for text in case.sheet["forces"].of("time"))

    marked = [text.split(" = ")[1].split(" ")[0] for text in texts if text.startswith("t_{1} + T_{1} = ")]

    assert len(marked) == 1
    for text in marked:
        assert abs(number(text) - (first + swing)) <= half_digit(text)


@every_case
def test_formula_of_the_article_is_dashed_and_jumps(case: HoistCase) -> None:  # H4
    view, found, values = case.sheet["forces"], case.forces, case.values
    support, lifted = curve(view, "F_01"), curve(view, "P_12")
    of_F, origin = mu(view, "F"), complex(support[0].real, support[-1].imag)
    parts = view.inside("curve", "printed")

    assert all(stroke.dashed for stroke in parts)
    points = np.concatenate([np.array(stroke.points) for stroke in parts])
    assert (points[0] - origin).imag * of_F == pytest.approx(found["m"] * 9.81, abs=NEAR * of_F)
    (jump,) = view.lines("jump", "printed")
    assert abs(abs(jump.points[1] - jump.points[0]) - abs(points[0] - lifted[0])) < NEAR
    stiff = together([values])
    C_k = stiff["S"] * stiff["E_k"] / stiff["L"]
    b = stiff["beta_2"] * (1.0 - stiff["beta_2"])
    C_2 = 3.0 * stiff["E_2"] * stiff["I_2"] / (b * b * stiff["l_2"] ** 3)
    C_12 = float((C_k * C_2 / (C_k + C_2))[0])
    m, a = found["m"], values["a"]
    most = m * (9.81 + a) + math.hypot(m * a, values["V_0"] * math.sqrt(m * C_12))
    assert np.max((points - origin).imag) * of_F == pytest.approx(most, abs=3.0 * NEAR * of_F)
    exact = max(found["F_12_max"], found["P_12_max"])
    verdicts = [values["sigma"] * values["S"] / force >= values["K"] for force in (exact, most)]
    strength = " ".join(text.string for text in case.sheet["strength"].texts)
    same = ("висновок той самий", "вывод тот же", "verdict is the same")
    assert "(14)" in strength
    assert any(words in strength for words in same) == (verdicts[0] == verdicts[1])
    exactly = ("за точною кривою", "по точной кривой", "by the exact curve")
    assert any(words in strength for words in exactly)
    heading = " ".join(text.string for text in view.of("heading"))
    (said,) = re.findall(r"(?:стрибком|скачком|jump of) ([\d.,]+) [НN]", heading)
    assert float(said.replace(",", ".")) == pytest.approx(abs(points[0] - lifted[0]) * of_F, abs=0.5 + NEAR * of_F)


@every_case
def test_verdict_and_flow_chart_are_those_of_the_numbers(case: HoistCase) -> None:  # H5
    found, values = case.forces, case.values
    greatest = max(found["F_12_max"], found["P_12_max"])
    safety = values["sigma"] * values["S"] / greatest
    strength, flow, beams = (case.sheet[name] for name in ("strength", "flow", "beams"))

    lines = " ".join(text.string for text in strength.texts)
    ratios = re.findall(r"= ([\d.,]+)/([\d.,]+) = ([\d.,]+)", lines)
    assert len(ratios) == 2  # the stress, the safety: with their numbers, which recompute
    for above, below, ratio in ratios:
        assert number(ratio) == pytest.approx(number(above) / number(below), rel=0.0, abs=half_digit(ratio))
    numbers = [number(text) for text in re.findall(r"= (-?[\d.,]+)", lines)]
    for expected in (greatest, greatest / values["S"] * 1e-6):
        assert any(abs(seen - expected) < 1e-3 * expected for seen in numbers), lines
    assert ("≥ K" in lines) == (safety >= values["K"])
    taken = {name for stroke in flow.strokes for role, name in stroke.path if role == "taken"}
    assert ("strong-end" in taken) == (safety >= values["K"])
    assert ("strong-places" in taken) == (safety < values["K"])
    resting = found["F_12_max"] > found["P_12_max"]
    for name, larger in (("F_12_max", resting), ("P_12_max", not resting)):
        assert ({f"larger-{name}", f"{name}-stress"} <= taken) == larger
    checks = [text.string for text in case.sheet["checks"].of("cell")]
    falls = found["F_12_min"] < found["F_12_t1"]  # what only rises from 0 has no least force but that
    assert any(text.startswith("F_{12 min} ≥" if falls else "F_{12}(t_{1}) ≥") for text in checks)
    assert ("F_{12 min}" in [text.string for text in case.sheet["results"].of("cell")]) == falls
    assert any(text.startswith("P_{12 min} ≥") for text in checks)
    of_w, of_x = mu(beams, "w"), mu(beams, "x")
    for i, load in ((0, found["m"] * 9.81), (2, found["P_12_max"])):
        points = curve(beams, f"beam_{i}_w")
        l, b = values[f"l_{i}"], values[f"beta_{i}"] * values[f"l_{i}"]
        EI = values[f"E_{i}"] * values[f"I_{i}"]
        x, w = (points - points[0]).real * of_x, -(points - points[0]).imag * of_w
        under = load * b**2 * (l - b) ** 2 / (3.0 * EI * l)
        assert w[np.argmin(np.abs(x - b))] == pytest.approx(under, abs=NEAR * of_w)
        most = node(beams, f"w_{i}_max") - points[0]
        assert -most.imag * of_w == pytest.approx(float(np.max(w)), abs=NEAR * of_w)
        assert l - most.real * of_x == pytest.approx(math.sqrt((l * l - b * b) / 3.0), abs=NEAR * of_x)
        assert b <= l / 2.0  # so that this is the distance from the farther end, and the view says so
    assert [text for text in beams.of("heading") if re.search("дальшого|дальнего|farther", text.string)]


@pytest.mark.parametrize("case", [*CASES, *SMALL], ids=str)
def test_dimensions_of_the_scheme_run_through_no_body_and_no_letter(case: HoistCase) -> None:
    scheme = case.sheet["scheme"]
    bodies = [s for s in scheme.strokes if s.path and s.path[-1][0] in ("link", "pivot", "rollers")]
    solid = shapely.MultiLineString([[(p.real, p.imag) for p in s.points] for s in bodies])
    letters = shapely.MultiPolygon([shapely.box(*text.box) for text in scheme.texts])

    lines = [s for s in scheme.strokes if s.role in ("extension", "shelf") or ("dimension", s.name) in s.path]
    lines += [s for s in scheme.strokes if any(role == "dimension" for role, _ in s.path)]

    assert len(lines) >= 15
    for line in (shapely.LineString([(p.real, p.imag) for p in stroke.points]) for stroke in lines):
        assert line.distance(letters) > 0.5 - 1e-6  # lines break off half a millimetre from letters
        assert line.distance(solid) > 0.2


@pytest.mark.parametrize(
    "variant", [*VARIANTS][:4] + [pytest.param(v, marks=pytest.mark.soak) for v in [*VARIANTS][4:]]
)
def test_no_axis_and_no_extension_line_runs_through_a_letter_of_a_hoist(variant: str) -> None:
    drawn = sheet("karpenko-hoist", variant, only="scheme,circle", format="A1", lang="uk")
    views = [view for page in read(drawn.svg()).pages for view in page.all if view.name in ("scheme", "circle")]

    struck = [(text.string, line.role) for view in views for text, line in thin_faults(view)]

    assert len(views) == 2
    assert [fault for fault in struck if fault[1] in ("axis", "extension")] == []


@pytest.mark.parametrize("case", [*CASES, *SMALL], ids=str)
def test_detail_of_the_crossing_has_its_letter_at_its_place(case: HoistCase) -> None:
    view = case.sheet["lift_off"]
    (window,) = view.lines("window", "magnified")
    assert window.arc is not None
    centre, radius, _ = window.arc
    (title,) = (text.string for text in view.texts if text.role == "magnified")
    letter = title.partition(" ")[0]
    (mark,) = (text for text in view.texts if text.string == letter)

    assert abs(centre - node(view, "X")) < 0.01
    assert title == f"{letter} (10:1)"
    (leader,) = (line for line in view.lines("leader", letter))
    near = min(leader.points, key=lambda p: abs(p - centre))
    assert abs(abs(near - centre) - radius) < 0.01  # from the ring to the shelf under the letter
    (shelf,) = view.lines("shelf", letter)
    left, right = sorted(p.real for p in shelf.points)
    assert shelf.points[0] in leader.points
    assert left < mark.box[0] < mark.box[2] < right
    assert 0.0 < mark.box[1] - shelf.points[0].imag < 2.0


@pytest.mark.parametrize("case", [*CASES, *SMALL], ids=str)
def test_jump_of_the_article_can_be_seen_and_measured(case: HoistCase) -> None:
    view, found = case.sheet["forces"], case.forces
    of_F, jump = mu(view, "F"), abs(found["m"] * 9.81 - found["F_12_t1"])
    times = [float(t.string.split("(")[1].split(":")[0]) for t in view.texts if t.role == "magnified"]
    ends = [p for s in view.strokes if ("dimension", "jump") in s.path and len(s.points) == 2 for p in s.points]
    drawn = max(abs(a - b) for a in ends for b in ends if abs((a - b).real) < NEAR)

    assert len(times) <= 1
    assert not {t.string for t in view.texts} & {
        t.string for t in case.sheet["lift_off"].texts if t.role == "magnified"
    }
    assert jump / of_F * max(times, default=1.0) >= 2.0
    assert drawn >= jump / of_F * max(times, default=1.0) - NEAR  # arrows of a short one stand outside
    assert any(text.string == "(14)" for text in view.texts)
    said = [text.string for text in view.texts if text.string.startswith("P_{m} = ")]
    levels = [view.lines("level", name)[0] for name in ("P_st", "P_m")]
    assert levels[0].dashed != levels[1].dashed or abs((levels[0].points[0] - levels[1].points[0]).imag) > 3.0
    assert not said or said[0].startswith("P_{m} = mg + ma = ")


@pytest.mark.parametrize("case", [*CASES, *SMALL], ids=str)
def test_detail_of_the_lift_off_shows_the_time_of_the_curves_and_that_of_the_chords(case: HoistCase) -> None:
    view, found = case.sheet["lift_off"], case.forces
    (curve,) = (s.points for s in view.strokes if ("curve", "parabola") in s.path)
    apart = 10.0 * (found["t_1"] / mu(view, "t1") - (node(view, "X") - curve[0]).real)
    (frame,) = (s for s in view.strokes if ("frame", "magnified") in s.path)
    middle = 0.5 * (min(p.real for p in frame.points) + max(p.real for p in frame.points))
    (exact,) = (line.points[0].real for line in view.lines("time", "t_1"))
    drawn = [line.points[0].real for line in view.lines("time", "t_1_drawn")]

    assert abs(exact - middle - apart) < 10.0 * NEAR
    assert len(drawn) == (abs(apart) >= 0.5)
    assert all(abs(place - middle) < NEAR for place in drawn)


@pytest.mark.parametrize("case", [*CASES, *SMALL], ids=str)
def test_least_force_of_the_first_phase_is_marked_where_the_force_falls(case: HoistCase) -> None:
    view, found = case.sheet["forces"], case.forces
    falls = found["F_12_min"] < found["F_12_t1"]

    assert any(("node", "F_12_min") in ring.path for ring in view.rings) == falls
    assert any(text.string.startswith("F_{12 min} = ") for text in view.texts) == falls
    if falls:
        height = (node(view, "F_12_min") - curve(view, "F_12")[0]).imag  # the force begins at zero
        assert abs(height * mu(view, "F") - found["F_12_min"]) < NEAR * mu(view, "F")


@pytest.mark.parametrize("case", [*CASES, *SMALL], ids=str)
def test_flow_chart_has_thin_symbols_about_their_texts_and_the_taken_way_thick(case: HoistCase) -> None:
    flow = case.sheet["flow"]
    kinds: dict[str, list[Stroke]] = {}
    for stroke in flow.strokes:
        kinds.setdefault(stroke.path[-1][0] if stroke.path else stroke.role, []).append(stroke)
    main = max(stroke.width for stroke in flow.strokes)

    assert {stroke.width < main for stroke in (*kinds["block"], *kinds["way"])} == {True}
    assert {stroke.width for stroke in kinds["taken"]} == {main}
    outlines: dict[str, list[complex]] = {}
    for stroke in kinds["block"]:
        outlines.setdefault(stroke.path[-1][1], []).extend(stroke.points)
    areas = {name: shapely.MultiPoint([(p.real, p.imag) for p in points]) for name, points in outlines.items()}
    areas = {name: points.convex_hull for name, points in areas.items()}
    rhombi = ("larger", "strong")
    for name, area in areas.items():  # a rhombus is half of the box about it, a rectangle all, others in between
        low, high = {True: (0.49, 0.51), False: (0.8, 1.01)}[name in rhombi]
        assert low < area.area / area.envelope.area < high
        assert any(area.contains(shapely.box(*text.box)) for text in flow.texts), name
    answers = [text for text in flow.texts if text.role == "answer"]
    assert len(answers) == 4
    for text in answers:  # each beside the question that it answers, and no block over it
        near = min(areas, key=lambda name: areas[name].distance(shapely.box(*text.box)))
        assert near in (*rhombi, "end")
        assert not any(area.intersects(shapely.box(*text.box)) for area in areas.values())


@pytest.mark.parametrize("case", [*CASES, RIGID, PUSHED, SLACK, *SMALL], ids=str)
def test_letters_touch_nothing_on_usual_and_on_odd_sheets(case: HoistCase) -> None:
    assert overlaps(case.sheet) == []
    assert "forces" in case.sheet.names


def test_circle_of_a_rope_that_goes_slack_ends_where_it_would_push() -> None:
    circle, checks = SLACK.sheet["circle"], [text.string for text in SLACK.sheet["checks"].of("cell")]

    ((slack,), (zero,)) = circle.lines("slack"), circle.lines("level", "slack")

    assert slack.dashed
    centre, of_P = node(circle, "P_m"), mu(circle, "P")
    mean = SLACK.forces["m"] * (9.81 + SLACK.values["a"])
    assert (centre - zero.points[0]).real * of_P == pytest.approx(mean, abs=NEAR * of_P)
    assert not any(("node", "P_12_min") in ring.path for ring in circle.rings)
    assert any(text.startswith("would be −") for text in checks)


@pytest.mark.soak
def test_pages_of_a_small_format_have_smaller_diagrams_and_say_so() -> None:
    case = HoistCase("V02", format="A4", lang="en")
    view, of_F = case.sheet["forces"], mu(case.sheet["forces"], "F")

    lifted, support = curve(view, "P_12"), curve(view, "F_01")

    assert len(case.drawn.pages) > 1
    assert overlaps(case.sheet) == []
    assert np.max((lifted - support[-1]).imag) * of_F == pytest.approx(case.forces["P_12_max"], rel=1e-3)
    assert any("usual size" in warning.text("en") for warning in case.drawn.warnings)
    assert case.drawn.scales["forces"].mu == pytest.approx(of_F)


@pytest.mark.parametrize(
    ("only", "own"),
    [
        ("circle", {"circle"}),
        pytest.param("scheme", {"scheme", "model"}, marks=pytest.mark.soak),
        pytest.param("forces", {"forces", "strength", "checks", "flow"}, marks=pytest.mark.soak),
    ],
)
def test_a_sheet_has_what_belongs_to_the_parts_wanted(only: str, own: set[str]) -> None:
    assert {view.name for view in sheet("karpenko-hoist", only=only).views} == own | {
        "givens",
        "results",
        "scales",
    }


@pytest.mark.parametrize("case", CASES, ids=str)
def test_least_force_of_the_second_phase_stands_a_millimetre_from_the_circle(case: HoistCase) -> None:
    circle = case.sheet["circle"]
    centre = node(circle, "P_m")
    radius = abs(node(circle, "P_12_min") - centre)

    (letter,) = [text for text in circle.of("label") if text.string.startswith("P_{12 min} =")]

    x0, y0, x1, y1 = letter.box
    near = complex(min(max(centre.real, x0), x1), min(max(centre.imag, y0), y1))
    assert abs(abs(near - centre) - radius) > 1.0
