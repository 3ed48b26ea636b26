"""Points H1 to H5 of the examiner's list on sheets of hoists that were drawn and read back."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pytest

from kulman import sheet
from kulman.tests.support.hoists import VARIANTS, together, two_sided
from kulman.tests.support.overlaps import overlaps
from kulman.tests.support.readback import Sheet, View, read
from kulman.variants.sheets import Sheet as Drawing

TASK = "karpenko-hoist"
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
        return sheet(TASK, self.variant, set=changes, format=self.format, lang=self.lang)

    @cached_property
    def sheet(self) -> Sheet:
        return read(*(self.drawn.svg(number) for number in range(1, len(self.drawn.pages) + 1)))

    @cached_property
    def values(self) -> dict[str, float]:
        return {**VARIANTS[self.variant], **dict(self.changes)}

    @cached_property
    def forces(self) -> dict[str, float]:
        """Forces and times by integration, SI, with the weight m g."""
        found = {name: float(value[0]) for name, value in two_sided(together([self.values])).items()}
        return found | {"m": (self.values["G_1"] + self.values["G_2"] / 3.0) / 9.81}


CASES = (
    HoistCase(),
    HoistCase("V02", lang="en"),
    HoistCase("V03", lang="ru"),
    *(pytest.param(HoistCase(variant), marks=pytest.mark.soak) for variant in VARIANTS),
)
every_case = pytest.mark.parametrize("case", CASES, ids=str)


def number(text: str) -> float:
    return float(text.replace(",", ".").replace("−", "-"))


def mu(view: View, symbol: str) -> float:
    """The printed scale factor, SI per mm."""
    heading = " ".join(text.string for text in view.of("heading"))
    found = re.search(re.escape(f"μ_{{{symbol}}} = ") + r"([\d.,]+)", heading)
    assert found is not None, heading
    return number(found[1])


def printed(view: View, symbol: str) -> float:
    """The number printed after `symbol =`."""
    texts = [text.string for text in view.texts if text.string.startswith(f"{symbol} = ")]
    assert texts, symbol
    return number(texts[0].split(" = ")[1].split(" ")[0])


def curve(view: View, name: str) -> np.ndarray:
    (stroke,) = view.inside("curve", name)
    return np.array(stroke.points)


def node(view: View, name: str) -> complex:
    (ring,) = [ring for ring in view.rings if ("node", name) in ring.path]
    return ring.centre


@every_case
def test_scheme_is_drawn_to_its_scale_and_dimensioned(case: HoistCase) -> None:  # H1
    view, values = case.sheet["scheme"], case.values
    scale = mu(view, "l")

    ends = {mark: view.point(mark) for mark in ("O1", "O2", "B1", "B2")}
    rope = view.lines("rope", "L")[0]

    for left, right, i in (("O1", "O2", 0), ("B1", "B2", 2)):
        (beam,) = [stroke for stroke in view.inside("link", str(i)) if len(stroke.points) == 2]
        a, b = sorted(beam.points, key=lambda point: point.real)
        assert abs(b - a) * scale == pytest.approx(values[f"l_{i}"], abs=0.02 * scale)
        at = rope.points[-1].real
        assert (at - a.real) * scale == pytest.approx(values[f"beta_{i}"] * values[f"l_{i}"], abs=0.02 * scale)
        assert printed(view, f"l_{{{i}}}") == pytest.approx(values[f"l_{i}"])
        assert abs(ends[left] - a) < 0.02
        assert abs(ends[right] - b) < 0.02
    heading = " ".join(text.string for text in view.of("heading"))
    ratio = re.search(r"1:([\d.,]+)", heading)
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
    lift_off, extremes, circle, found = (
        *(case.sheet[name] for name in ("lift_off", "extremes", "circle")),
        case.forces,
    )
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
    assert printed(circle, "k_{1}T_{1}") == pytest.approx(angle, rel=1e-3)


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
    assert ("(14)" in strength) == (verdicts[0] != verdicts[1])


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
        assert f"{number(above) / number(below):.4g}" == f"{number(ratio):.4g}"
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
    assert any(text.startswith("F_{12 min} ≥") for text in checks)
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


@every_case
def test_letters_touch_nothing(case: HoistCase) -> None:
    assert overlaps(case.sheet) == []


@pytest.mark.parametrize(
    "case",
    [
        HoistCase(changes=(("I_0", math.inf), ("I_2", math.inf))),
        pytest.param(HoistCase(changes=(("I_0", 2.7e-6), ("a", 0.0))), id="the rope would push"),
        pytest.param(HoistCase("V09", (("V_0", 1.0),)), id="slack in phase 2"),
        pytest.param(HoistCase(format="A3"), marks=pytest.mark.soak),
        pytest.param(HoistCase(format="A2"), marks=pytest.mark.soak),
    ],
    ids=str,
)
def test_odd_hoists_have_sheets_too(case: HoistCase) -> None:
    assert overlaps(case.sheet) == []
    assert "forces" in case.sheet.names


def test_circle_of_a_rope_that_goes_slack_ends_where_it_would_push() -> None:
    case = HoistCase("V09", (("V_0", 1.0),), lang="en")
    circle, checks = case.sheet["circle"], [text.string for text in case.sheet["checks"].of("cell")]

    (slack,) = circle.lines("slack")
    (zero,) = circle.lines("level", "slack")

    assert slack.dashed
    centre, of_P = node(circle, "P_m"), mu(circle, "P")
    mean = case.forces["m"] * (9.81 + case.values["a"])
    assert (centre - zero.points[0]).real * of_P == pytest.approx(mean, abs=NEAR * of_P)
    assert not any(("node", "P_12_min") in ring.path for ring in circle.rings)
    assert any(text.startswith("would be −") for text in checks)


def test_pages_of_a_small_format_have_smaller_diagrams_and_say_so() -> None:
    case = HoistCase("V02", format="A4", lang="en")

    view, found = case.sheet["forces"], case.forces

    assert len(case.drawn.pages) > 1
    assert overlaps(case.sheet) == []
    lifted, support = curve(view, "P_12"), curve(view, "F_01")
    most = np.max((lifted - support[-1]).imag) * mu(view, "F")
    assert most == pytest.approx(found["P_12_max"], rel=1e-3)
    assert any("usual size" in warning.text("en") for warning in case.drawn.warnings)
    assert case.drawn.scales["forces"].mu == pytest.approx(mu(view, "F"))


@pytest.mark.parametrize(
    ("only", "own"),
    [
        ("circle", {"circle"}),
        ("scheme", {"scheme", "model"}),
        pytest.param("forces", {"forces", "strength", "checks", "flow"}, marks=pytest.mark.soak),
    ],
)
def test_a_sheet_has_what_belongs_to_the_parts_wanted(only: str, own: set[str]) -> None:
    names = {view.name for view in sheet(TASK, only=only).views}

    assert names == own | {"givens", "note", "results", "scales"}
