"""Figures of compound motion, read back from the drawn sheet: vectors at the points, construction lines, insets."""

from __future__ import annotations

import math
import re
from functools import lru_cache

import pytest

from kulman import sheet, solve
from kulman.plans.linkages.chain import hinged
from kulman.plans.linkages.compound import COMPOUND, Coupler
from kulman.scales.errors import InputError
from kulman.tests.sheets.judge import overlaps, thin_faults
from kulman.tests.support.printed_numbers import table
from kulman.tests.support.readback import Sheet, View, angle, parallel, read, read_back
from kulman.variants.solution import Solution

NEAR = 0.01  # mm
MORE = ["scheme-08-planer", "scheme-09-shaper", "scheme-13-toggle-press", "scheme-15-lever-shears", "nau-slider-crank"]
TASKS = ["bertyaev-six-bar", "scheme-03-crank-rocker", *(pytest.param(task, marks=pytest.mark.soak) for task in MORE)]
LANGUAGES = ["uk", *(pytest.param(lang, marks=pytest.mark.soak) for lang in ("ru", "en"))]


@lru_cache(maxsize=8)
def drawn(task: str, lang: str = "uk", format: str | None = None) -> Sheet:
    found = sheet(task, lang=lang, only="compound", format=format)
    return read_back(found)


@lru_cache(maxsize=8)
def solved(task: str) -> Solution:
    return solve(task, only="compound")


def couplers(task: str) -> tuple[Coupler, ...]:
    found = solved(task).solved
    return hinged(found.mechanism, found.structure)


def view(task: str, name: str) -> View:
    return next(v for page in drawn(task).pages for v in page.all if v.name == name)


def figures(task: str) -> list[tuple[View, Coupler, str, str]]:
    """Return the view, the coupler, the point and the kind, V or a, of every construction."""
    points = [(c, point) for c in couplers(task) for point in c.letters]
    velocity = [(view(task, "compound_velocity"), c, point, "V") for c, point in points]
    return velocity + [(view(task, f"compound_a_{c.letters[point]}"), c, point, "a") for c, point in points]


@pytest.mark.parametrize("task", TASKS)
def test_every_vector_measures_what_it_says_and_nothing_touches(task: str) -> None:
    assert overlaps(drawn(task)) == []
    for page in drawn(task).pages:
        for v in (v for view in page.all for v in view.vectors):
            item = solved(task)[v.quantity]
            assert item.value == pytest.approx(v.value, rel=1e-9, abs=1e-300)
            assert abs(v.span) * v.mu == pytest.approx(v.value, abs=NEAR * v.mu)
            assert abs(v.span - complex(item.x or 0.0, item.y or 0.0) / v.mu) < NEAR


@pytest.mark.parametrize("task", TASKS)
def test_parts_hang_on_one_another_from_the_point_of_the_mechanism_to_the_total(task: str) -> None:
    place_of = solved(task).solved.point
    for figure, c, point, kind in figures(task):
        rings = {ring.path[-1][1]: ring.centre for ring in figure.rings if ring.path}
        total = figure.vector(f"{kind}_{point}")
        place = total.tail

        for part in COMPOUND[kind]:
            vector = figure.vector(f"{kind}_{c.letters[point]}_{part}")
            assert abs(vector.tail - place) < NEAR
            place = vector.tip
        assert abs(place - total.tip) < NEAR
        assert min(abs(total.tail - ring.centre) for ring in figure.rings) < NEAR
        assert abs(angle(total.tail - rings[c.pivot], place_of(point) - place_of(c.pivot))) < 0.01


@pytest.mark.parametrize("task", TASKS)
def test_closing_lines_run_past_the_point_that_they_find(task: str) -> None:
    for figure, c, point, kind in figures(task):
        plan = f"{kind}_at_{c.letters[point]}_"
        lines = [s for s in figure.strokes if s.role == "construction" and s.name.startswith(plan)]
        if point != c.span.end or c.closing is None:
            assert lines == []
            continue
        total = figure.vector(f"{kind}_{point}").tip
        along = [c.span.n, c.closing.direction]
        assert len(lines) == 2
        for line, direction in zip(lines, along, strict=True):
            a, b = line.points[0], line.points[-1]
            assert not line.dashed
            u = solved(task).solved.point(direction)
            assert parallel(b - a, u) or parallel(a - b, u)
            assert abs(((total - a) / (b - a)).imag) * abs(b - a) < NEAR
            assert abs(b - total) == pytest.approx(10.0, abs=NEAR)


@pytest.mark.parametrize("task", ["bertyaev-six-bar", "scheme-03-crank-rocker"])
def test_what_is_too_short_stands_enlarged_in_an_inset(task: str) -> None:
    figure = view(task, "compound_a_B")
    short, long = ("a_B_t", "a_B_rn") if task == "bertyaev-six-bar" else ("a_B_n", "a_B_k")

    coarse = figure.vector(short)
    (fine,) = [v for inset in figure.insets for v in inset.vectors if v.quantity == short]

    assert abs(coarse.span) < 5.0 < abs(fine.span)
    assert coarse.mu / fine.mu == pytest.approx(round(coarse.mu / fine.mu))
    assert not [v for inset in figure.insets for v in inset.vectors if v.quantity == long]
    assert len(figure.insets) == len([s for s in figure.strokes if s.role == "window"]) == 1
    assert [s for inset in figure.insets for s in inset.strokes if s.role == "inset"]
    letters = {text.string for inset in figure.insets for text in inset.of("label")}
    (said,) = [text.string for text in figure.of("heading") if re.search("виносний елемент|detail", text.string)]
    assert letters.issuperset(letter.strip() for letter in said.partition(":")[0].split(", "))


def test_inset_names_its_own_scale_factor_and_a_zero_vector_is_a_point_that_is_said() -> None:
    figure = view("bertyaev-six-bar", "compound_a_B")
    texts = [text.string for inset in figure.insets for text in inset.texts]

    assert "Виносний елемент I" in texts
    assert any(text.startswith("M_{a} = 0,08") for text in texts)
    assert abs(figure.vector("a_B_et").span) < NEAR
    assert any("= 0" in text.string for text in figure.texts)


def test_instant_centres_stand_on_rays_normal_to_the_velocities() -> None:
    figure = view("bertyaev-six-bar", "compound_velocity")
    rays = [s for s in figure.strokes if s.role == "ray"]

    assert sorted(ray.name for ray in rays) == ["P_2_A", "P_2_B", "P_4_C", "P_4_D"]
    for ray in rays:
        v = figure.vector(f"V_{ray.name[-1]}")
        way = ray.points[-1] - ray.points[0]
        assert abs(abs(angle(way, v.span)) - 90.0) < 0.01
    places = {ring.path[-1][1]: ring.centre for ring in figure.rings if ring.path}
    scale = 0.005
    O = places["O"]
    for P in ("P_2", "P_4"):
        assert abs((places[P] - O) * scale - solved("bertyaev-six-bar").solved.point(P)) < NEAR * scale


@pytest.mark.parametrize(
    ("phi", "said", "rays"),
    [
        pytest.param(89.0, "beyond the drawing", [], id="far away"),
        pytest.param(90.0, "does not turn", [], id="nowhere"),
        pytest.param(0.0, "", ["P_2_A"], id="in the slider's pin"),
    ],
)
def test_instant_centre_of_special_positions(phi: float, said: str, rays: list[str]) -> None:
    found = sheet("nau-slider-crank", "example", lang="en", only="compound", set={"phi": phi})
    velocity = next(v for v in read(found.svg()).pages[0].all if v.name == "compound_velocity")

    assert [s.name for s in velocity.strokes if s.role == "ray"] == rays
    assert any(said in text.string for text in velocity.texts)


def test_senses_of_turning_are_those_of_the_rates() -> None:
    figure = view("bertyaev-six-bar", "compound_velocity")
    arcs = {s.path[-1][1]: s for s in figure.strokes if s.arc and s.path and s.path[-1][0] == "arrow"}

    assert {"omega_1", "omega_2", "omega_3", "omega_4", "omega_r_2", "omega_r_4"} == {*arcs}
    for name, stroke in arcs.items():
        assert stroke.arc is not None
        assert math.copysign(1.0, stroke.arc[2]) == math.copysign(1.0, solved("bertyaev-six-bar").solved.values[name])


@pytest.mark.parametrize("lang", LANGUAGES)
def test_nothing_touches_on_the_sheet_of_the_seed(lang: str) -> None:
    found = sheet("bertyaev-six-bar", lang=lang)
    page = read_back(found)

    assert overlaps(page) == []
    assert [t.string for p in page.pages for v in p.all if "compound" in v.name for t, _ in thin_faults(v)] == []


def test_smaller_format_takes_coarser_scales_and_a_mechanism_without_couplers_is_refused() -> None:
    assert len(drawn("scheme-03-crank-rocker", format="A3").pages) > 1
    assert overlaps(drawn("scheme-03-crank-rocker", format="A3")) == []
    with pytest.raises(InputError) as raised:
        sheet("scheme-19-scotch-yoke", only="compound")
    assert raised.value.key == "no-coupler"


@pytest.mark.parametrize("task", [*TASKS[:2], *(pytest.param(MORE[k], marks=pytest.mark.soak) for k in (1, 3))])
def test_every_vector_of_compound_motion_has_its_segment_in_the_table(task: str) -> None:
    rows = [row for v in drawn(task).views if v.name.startswith("results_compound") for row in table(v)[1:]]
    vectors = [row for row in rows if row[0][0] in "vVa"]

    assert vectors != []
    assert [row for row in vectors if row[1] == "–"] == []


def test_letters_that_are_units_too_lean_on_an_english_sheet() -> None:
    texts = re.findall(r"<text([^>]*)>(?:m|OA|AB)</text>", sheet("bertyaev-six-bar", lang="en").svg(1))

    assert len(texts) > 3
    assert [text for text in texts if 'font-style="italic"' not in text] == []


def test_letters_of_points_that_are_no_joints_stand_at_them() -> None:
    for point in ("M", "K"):
        for name in (f"compound_a_{point}", "compound_velocity"):
            figure = view("bertyaev-six-bar", name)
            (letter,) = [text for text in figure.of("label") if text.string == point]

            x0, y0, x1, y1 = letter.box
            (at,) = letter.of
            assert abs(complex(max(x0 - at.real, at.real - x1, 0.0), max(y0 - at.imag, at.imag - y1, 0.0))) < 5.5
