"""Pages of a sheet: one rule for format and scale factors in all that is shown, views in order, pages well used."""

from __future__ import annotations

import json
import re
import shlex
from base64 import b64decode
from collections import Counter
from collections.abc import Iterator
from functools import lru_cache
from io import BytesIO
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from fontTools.ttLib import TTFont
from pypdfium2 import PdfDocument

import kulman
from kulman.drawing.linkages.ladders import extents_of, ways_of
from kulman.drawing.page import Page, extent
from kulman.drawing.shapes import Group, Text
from kulman.drawing.words import Words
from kulman.plans.board import POINTS
from kulman.plans.hands.shaky import preset
from kulman.plans.linkages.solved import conditions_of, worst_condition
from kulman.plans.quantities import plans_of
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.sheets.judge import faults, judged
from kulman.tests.support.cases import as_drawn, mus, other_lengths, same_scales, solve_case, some, vectors
from kulman.tests.support.chains import chain
from kulman.tests.support.commands import Run
from kulman.tests.support.printed_numbers import decimal
from kulman.tests.support.readback import read, read_back, svgs
from kulman.tests.support.task_files import task_of, with_changes
from kulman.variants.case import Request
from kulman.variants.marking.keyed import Rubric, keyed
from kulman.variants.reader import load_task
from kulman.variants.sheets import Sheet
from kulman.variants.shelf import bundled, bundled_text

TASKS = bundled()
QUICK = ("nau-slider-crank",)
EVERY = [task if task in QUICK else pytest.param(task, marks=pytest.mark.soak) for task in TASKS]
MADI = {"mu_l": 0.0025, "mu_V": 0.189, "mu_a": 21.318, "mu_h": 0.126, "mu_F_23": 33.154, "mu_F_1": 54.373}
KINEMATICS = {"givens", "structure", "position", "velocity", "acceleration", "equations_kinematics"}


@pytest.mark.parametrize("task", EVERY)
def test_segments_solved_are_those_of_sheet_note_form_and_handout(task: str) -> None:
    solution, sheet = kulman.solve(task), kulman.sheet(task)
    rubric = Rubric(preset("normal").tolerance)
    form = keyed(Request(load_task(task), solution.variant), solution.variant, {}, rubric).solution
    blank, on_a4 = kulman.handout(task, key=True), kulman.solve(task, format="A4")

    assert (mus(form), form.format) == (mus(solution), solution.format)
    shown = as_drawn(solution, sheet)
    assert sheet.format == shown.format
    assert same_scales(shown, sheet)
    assert [one for one in sheet.warnings if not one.key.startswith("scales-")] == [*solution.warnings]
    assert other_lengths(shown, sheet) == {}
    assert mus(kulman.note(task).sheet) == mus(sheet)
    assert same_scales(on_a4, blank)
    assert other_lengths(on_a4, blank) == {}


@pytest.mark.parametrize("lang", ["uk", pytest.param("ru", marks=pytest.mark.soak)])
def test_a_sheet_without_a_format_has_no_page_that_is_too_empty_where_other_plans_fill_it(lang: str) -> None:
    task, variant = "scheme-19-scotch-yoke", "6"
    sheet = kulman.sheet(task, variant, lang=lang)

    assert faults(read_back(sheet)) == []
    assert same_scales(kulman.solve(task, variant, format="A1"), sheet)
    assert {warning.key for warning in sheet.warnings} <= {"scales-changed"}  # all has room


@pytest.mark.parametrize(
    ("task", "variant"),
    [
        pytest.param("scheme-04-v-engine", "3", marks=pytest.mark.soak),
        pytest.param("scheme-07-two-stage-compressor", "4", marks=pytest.mark.soak),
        ("scheme-18-hydraulic-drive", "3"),
    ],
)
def test_plans_are_larger_where_the_last_page_would_be_half_empty(task: str, variant: str) -> None:
    sheet = kulman.sheet(task, variant)

    *_, sight = judged(read_back(sheet))
    assert sight.format != "A1" or sight.fill > 0.55
    assert same_scales(kulman.solve(task, variant), sheet)


@pytest.mark.parametrize("variant", load_task("nau-slider-crank").variants)
def test_a_lever_is_in_proportion_to_a_velocity_plan_whose_length_the_task_fixes(variant: str) -> None:
    scales = mus(kulman.solve("nau-slider-crank", variant))

    assert 2.0 <= scales["mu_V"] / scales["mu_h"] < 2.501


@pytest.mark.parametrize(
    ("task", "variant"),
    [("scheme-04-v-engine", "5"), ("scheme-05-articulated-rod", "4"), ("scheme-07-two-stage-compressor", "5")],
)
def test_the_shortest_of_force_plans_with_one_scale_factor_can_be_read(task: str, variant: str) -> None:
    solution = kulman.solve(task, variant)
    longest: dict[str, float] = {}
    for quantity in (solution[name] for name in solution if name.startswith(("R_", "F_"))):
        if quantity.mm is not None and quantity.scale:
            longest[quantity.scale] = max(longest.get(quantity.scale, 0.0), abs(quantity.mm))

    assert {"mu_F_45", "mu_F_23", "mu_F_1"} == longest.keys()
    assert len({solution.scales[symbol].mu for symbol in longest}) == 1
    assert min(longest.values()) > 60.0


@pytest.mark.parametrize("format", ["A3", pytest.param("A4", marks=pytest.mark.soak)])
def test_a_sheet_with_other_scale_factors_names_them_and_solve_shows_its_numbers(format: str) -> None:
    usual, small = (kulman.solve("nau-slider-crank", "7", format=name) for name in (None, format))
    sheet = kulman.sheet("nau-slider-crank", "7", format=format)

    changed = {symbol for symbol, mu in mus(small).items() if mu != mus(usual)[symbol]}
    assert changed
    assert same_scales(small, sheet)
    [warning] = [warning for warning in sheet.warnings if warning.key == "scales-changed"]
    for language in LANGUAGES:
        line = warning.text(language)
        assert "\n" not in line
        assert f"`kulman solve nau-slider-crank -v 7 --format {format}`" in line
        assert set(re.findall(r"mu_\w+", line)) == changed
        for symbol in changed:
            change = f"{symbol} {mus(usual)[symbol]:g} -> {mus(small)[symbol]:g}"
            assert decimal(change, language) in line


@pytest.mark.parametrize("drawn", [kulman.sheet, kulman.handout])
def test_the_command_that_a_sheet_names_shows_its_numbers(drawn: Any, run: Run, tmp_path: Path) -> None:
    file = tmp_path / "my own.toml"
    file.write_text(bundled_text("nau-slider-crank"), encoding="utf-8")
    own = {"set": {"l_OA": 45, "phi": (50.0, "deg")}, "scales": {"pa": "60 mm"}, "only": ["velocity", "forces"]}
    sheet = drawn(file, "7", format="A4", norm="iso", lettering="dejavu", lang="en", **own)

    [warning] = [warning for warning in sheet.warnings if warning.key == "scales-changed"]
    for language in LANGUAGES:
        command = re.findall("`(.+?)`", warning.text(language))[-1]
        status, shown, _ = run(*shlex.split(command)[1:], "--json")
        assert status == 0
        scales = json.loads(shown)["scales"]
        assert {name: scales[name]["value"] for name in scales} == pytest.approx(mus(sheet))


def test_few_plans_take_a_small_format_and_much_text_a_large_one() -> None:
    solved, drawn = (
        {only: command("nau-slider-crank", "7", only=only).format for only in ("velocity", "position", None)}
        for command in (kulman.solve, kulman.sheet)
    )

    assert solved == drawn
    assert drawn["velocity"] != drawn[None] == "A1"


@pytest.mark.parametrize(
    ("task", "symbol", "mu"),
    [
        ("nau-slider-crank", "mu_l", "1000"),
        ("madi-cam", "mu_l", "1000"),
        ("madi-cam", "mu_s_d2s", "1000"),
        ("madi-cam", "mu_phi", "100000"),
        ("madi-gear", "mu_theta", "100000"),
        ("karpenko-hoist", "mu_l", "1000"),
        ("karpenko-hoist", "mu_F_circle", "1e6"),
    ],
)
def test_scale_factors_at_which_a_plan_is_a_point_are_refused(task: str, symbol: str, mu: str) -> None:
    given = symbol in ("mu_phi", "mu_theta")
    asked = {"set" if given else "scales": {symbol: mu}}

    for command in (kulman.solve, kulman.sheet):
        with pytest.raises(InputError) as refused:
            command(task, **asked)  # type: ignore[operator]
        assert (refused.value.key, refused.value.data["symbol"]) == ("plan-too-small", symbol)


@pytest.mark.parametrize(
    ("task", "symbol", "mu"),
    [
        ("nau-slider-crank", "mu_V", "0.001"),
        ("nau-slider-crank", "mu_F_23", "0.01"),
        ("madi-cam", "mu_l", "1e-6"),
        ("madi-gear", "mu_l", "1e-5"),
        ("karpenko-hoist", "mu_F_circle", "0.1"),
    ],
)
def test_scale_factors_at_which_no_sheet_has_a_segment_are_refused_before_anything_is_drawn(
    task: str, symbol: str, mu: str
) -> None:
    for command in (kulman.solve, kulman.sheet):
        with pytest.raises(InputError) as refused:
            command(task, scales={symbol: mu})  # type: ignore[operator]
        fitting = command is kulman.sheet and task == "nau-slider-crank"  # the sheet of a linkage says what fits
        assert refused.value.key == ("plan-too-large-everywhere" if fitting else "plan-too-long")
        assert refused.value.data["symbol"] == symbol
        assert fitting == ("fits" in refused.value.data)


@pytest.mark.parametrize(
    ("asked", "size"),
    [
        pytest.param({"set": {"L": "40 m"}, "scales": {"mu_l": 45}}, 40.0 / 45, id="a rope longer than the beams"),
        pytest.param({"scales": {"mu_l": 20}}, 16.5 / 20, id="the longer beam"),
        pytest.param({"scales": {"mu_F_circle": 25000}}, 2 * 10491.92 / 25000, id="the diameter of the circle"),
    ],
)
def test_a_refusal_tells_the_true_size_of_the_largest_segment_of_a_hoist(asked: dict[str, object], size: float) -> None:
    with pytest.raises(InputError) as refused:
        kulman.solve("karpenko-hoist", **asked)  # type: ignore[arg-type]

    assert refused.value.data["size"] == f"{size:.2g}"
    kulman.solve("karpenko-hoist", set={"L": "40 m"}, scales={"mu_l": 25})  # the rope is no point


def views(page: Page) -> Iterator[Group]:
    yield from (shape for shape in page.shapes if isinstance(shape, Group) and shape.role == "view")


def used(page: Page) -> float:
    """Part of the page that the boxes of its views cover."""
    boxes = [extent(view.shapes) for view in views(page)]
    return sum((c - a) * (d - b) for a, b, c, d in boxes) / (page.width * page.height)


@pytest.mark.parametrize(("symbol", "mu"), [("mu_F_23", 15.0), pytest.param("mu_a", 5.0, marks=pytest.mark.soak)])
def test_scale_factors_that_task_and_user_fix_are_kept_on_more_pages(symbol: str, mu: float) -> None:
    usual = kulman.sheet("madi-four-bar")
    drawn = kulman.sheet("madi-four-bar", scales={symbol: mu}, format="A1")

    assert (mus(usual), usual.warnings) == (MADI, ())
    assert mus(drawn) == {**MADI, symbol: mu}
    assert len(drawn.pages) == 2


def test_a_fixed_scale_factor_takes_a_larger_format_a_second_page_or_is_refused() -> None:
    free = kulman.sheet("nau-slider-crank", only="velocity", scales={"mu_V": 0.015})
    on_a4 = kulman.sheet("nau-slider-crank", only="velocity", scales={"mu_V": 0.02}, format="A4")
    with pytest.raises(InputError) as refused:
        kulman.sheet("nau-slider-crank", only="velocity", scales={"mu_V": 0.006}, format="A4")

    assert mus(free)["mu_V"] == 0.015
    assert free.format != "A4"
    assert mus(on_a4)["mu_V"] == 0.02
    assert "velocity" not in {view.name for view in views(on_a4.pages[0])}
    assert refused.value.key == "plan-too-large-everywhere"


@lru_cache
def two_pages(task: str) -> Sheet:
    return kulman.sheet(task, "6", format="A1")


@pytest.mark.parametrize("task", ["scheme-09-shaper", pytest.param("scheme-15-lever-shears", marks=pytest.mark.soak)])
def test_two_pages_are_read_in_order_and_used(task: str) -> None:
    drawn = two_pages(task)

    names = [[view.name for view in views(page)] for page in drawn.pages]
    assert len(names) == 2
    assert KINEMATICS & {*names[0]}
    assert not KINEMATICS & {*names[1]}
    assert names[0][:2] == ["givens", "structure"]
    assert all(used(page) > 0.35 for page in drawn.pages)


def test_plans_are_drawn_larger_where_pages_have_room() -> None:
    drawn = mus(two_pages("scheme-09-shaper"))
    solved = kulman.solve("scheme-09-shaper", "6")

    longest = {
        symbol: max(q.mm or 0.0 for name, q in solved.quantities.items() if q.scale == symbol and q.kind == "vector")
        for symbol in ("mu_V", "mu_a", "mu_F_23")
    }
    assert {symbol: drawn[symbol] for symbol in longest} == {s: mu for s, mu in mus(solved).items() if s in longest}
    assert all(80.0 < millimetres < 300.0 for millimetres in longest.values())


@pytest.mark.parametrize(
    ("task", "variant", "symbol"),
    [
        ("scheme-14-jaw-crusher", "6", "mu_a"),
        ("scheme-12-shaking-conveyor", "8", "mu_a"),
        ("scheme-15-lever-shears", "2", "mu_V"),
        ("scheme-16-hay-baler", "6", "mu_V"),
    ],
)
def test_a_plan_whose_points_crowd_is_larger_than_others(task: str, variant: str, symbol: str) -> None:
    solution = kulman.solve(task, variant)
    longest = max(q.mm or 0.0 for q in solution.quantities.values() if q.scale == symbol and q.kind == "vector")

    assert longest > 190.0


@pytest.mark.parametrize(
    ("task", "variant"),
    [("scheme-14-jaw-crusher", "2"), ("scheme-15-lever-shears", "3"), ("scheme-20-press-automaton", "2")],
)
def test_no_plan_is_small_beside_mechanism_and_lever(task: str, variant: str) -> None:
    longest = Counter[str]()
    for q in kulman.solve(task, variant).quantities.values():
        if q.kind == "vector" and q.scale:
            longest[q.scale] = max(longest[q.scale], round(q.mm or 0.0))

    assert min(longest.values()) >= 100.0, longest


@pytest.mark.parametrize(
    ("task", "variant"),
    some(
        [
            *(("scheme-18-hydraulic-drive", variant) for variant in "058"),
            *(("scheme-10-shaper-two-blocks", variant) for variant in "257"),  # long equations of a slotted link
            ("scheme-05-articulated-rod", "8"),  # two pages are nearly full
            ("scheme-20-press-automaton", "2"),  # a special point is far from all joints
        ],
        1,
    ),
)
def test_a_sheet_has_the_scale_factors_that_are_solved_for(task: str, variant: str) -> None:
    assert same_scales(kulman.solve(task, variant), kulman.sheet(task, variant))


@pytest.mark.parametrize(
    ("task", "variant"), some([("scheme-01-compressor", "3"), ("scheme-02-forging-press", "1")], 1)
)
def test_headings_side_by_side_do_not_read_as_one_line(task: str, variant: str) -> None:
    drawn = kulman.sheet(task, variant)
    (page,) = read(drawn.svg()).pages
    headings = [(text.area.bounds, text) for view in page.views for text in view.of("heading")]
    gaps = [
        max(a, b)[0] - min(a, b)[2]
        for (a, one), (b, other) in combinations(headings, 2)
        if abs(one.baseline - other.baseline) < 1.0
    ]

    assert len(gaps) > 3
    assert min(gaps) > 7.5


@pytest.mark.parametrize(
    "task",
    [
        "karpenko-hoist",
        *(pytest.param(t, marks=pytest.mark.soak) for t in ("scheme-14-jaw-crusher", "bertyaev-six-bar", "madi-gear")),
    ],
)
def test_figures_are_numbered_in_order_and_headings_have_common_baselines(task: str) -> None:
    numbers, above = list[str](), set[float]()
    for view in kulman.sheet(task, lang="uk").views:
        (first,) = [s for s in view.shapes if isinstance(s, Text) and s.markup.endswith(view.heading[0])]
        numbers += re.findall(r"^(\d+)\. ", first.markup)
        assert bool(view.rows or view.lines) is (first.markup == view.heading[0])
        above.add(round(view.box[3] - first.at.imag, 6))
    assert numbers == [str(number + 1) for number in range(len(numbers))]
    assert len(numbers) > 3
    assert len(above) == 1


def test_plans_are_as_large_as_the_paper_allows_and_in_proportion() -> None:
    longest: dict[str, list[float]] = {"V": [], "a": [], "F": []}
    for task in (task for task in bundled() if task.startswith("scheme")):
        for variant in [*load_task(task).variants][:4]:
            solved, plans = kulman.solve(task, variant), dict[str, list[float]]()
            for q in solved.quantities.values():
                if q.kind == "vector" and q.scale:
                    plans.setdefault(q.scale[3:4], []).append(q.mm or 0.0)
            for kind, lengths in plans.items():
                longest[kind].append(max(lengths))

    every = sorted(length for lengths in longest.values() for length in lengths)
    assert {kind: len(of) for kind, of in longest.items()} == dict.fromkeys(longest, 80)
    assert every[0] > 90.0
    assert every[len(every) // 10] > 130.0  # nine of ten plans of velocities, of accelerations, the largest of forces
    assert every[len(every) // 4] > 150.0  # three of four
    assert every[-1] < 330.0  # longer where points crowd, or the last page would be half empty
    ratios = sorted(max(v / a, a / v) for v, a in zip(longest["V"], longest["a"], strict=True))
    assert ratios[len(ratios) * 7 // 8] < 1.6  # what round scale factors allow, and points that crowd


@pytest.mark.parametrize(
    ("task", "variant"),
    some(
        [
            ("scheme-12-shaking-conveyor", "2"),  # arms far beyond the velocity plan
            ("scheme-20-press-automaton", "0"),  # twelve small forces in one detail
            ("scheme-09-shaper", "1"),  # small forces that another plan shows
            ("scheme-16-hay-baler", "0"),
        ],
        0,
        1,
    ),
)
def test_lever_and_force_plans_take_about_what_scale_factors_were_chosen_for(task: str, variant: str) -> None:
    drawn = {view.name: view.size for view in kulman.sheet(task, variant).views}
    case = solve_case(task, variant)
    extents = extents_of(case.solved, case.choosers, case.plans)
    _, rungs, _ = next(ways_of(extents, None))

    (lever,) = [e.on_paper(extents.mu(e.symbol, rungs), 1.0) for e in extents.figures if e.symbol == "mu_h"]
    plans = [e.on_paper(extents.mu(e.symbol, rungs), 1.0) for e in extents.figures if e.symbol[:4] in ("", "mu_F")]
    area = sum(wide * high for name, (wide, high) in drawn.items() if name.startswith("forces"))
    assert [a / b for a, b in zip(lever, drawn["lever"], strict=True)] == pytest.approx([1.0, 1.0], abs=0.15)
    assert sum(wide * high for wide, high in plans) / area == pytest.approx(1.0, abs=0.2)


def test_force_plans_of_like_forces_have_one_scale_factor() -> None:
    one, several = 0, 0
    for task in (task for task in bundled() if task.startswith("scheme")):
        for variant in [*load_task(task).variants][:3]:
            solved, longest = kulman.solve(task, variant), dict[str, float]()
            for quantity in solved.quantities.values():
                if (quantity.scale or "").startswith("mu_F"):
                    longest[quantity.scale] = max(longest.get(quantity.scale, 0.0), abs(quantity.value or 0.0))
            most, scales = max(longest, key=longest.__getitem__), mus(solved)
            alike = {symbol for symbol in longest if longest[most] <= 2.999 * longest[symbol]}
            assert {scales[symbol] for symbol in alike} == {scales[most]}, (task, variant)
            one += len(alike) > 1
            several += len({scales[symbol] for symbol in longest}) > 1
    assert min(one, several) > 5


@pytest.mark.parametrize(
    "task", some(["nau-slider-crank", "madi-four-bar", "bertyaev-six-bar", "scheme-20-press-automaton"], 1)
)
def test_a_structure_alone_is_drawn_with_its_scheme(task: str) -> None:
    assert {view.name for view in kulman.sheet(task, only="structure").views} == {"givens", "structure", "position"}


def test_a_mechanism_on_which_nothing_acts_is_drawn() -> None:
    nothing = dict.fromkeys(("F_3", "m_2", "m_3", "J_S2"), 0)

    drawn = kulman.sheet("nau-slider-crank", "3", set=nothing, lang="en")

    svg = "".join(svgs(drawn))
    assert not re.search(r"nan|\binf\b", svg)
    assert {vector.value for vector in vectors(drawn.pages[0].shapes) if vector.quantity[0] in "FR"} <= {0.0}


# Slider-cranks that a user may write: other letters, a crank with a counterweight, a rod without mass.
AT = ('point = "A"', 'point = "D"')  # of the pair, of the driver
CRANK, HEAVY = 'A = ["l_OA", "0 mm"] }\ncentre = "O"', 'centre = "S1"\nmass = "m_2"'
OWN = {  # what is changed; what is drawn, and what is not
    "a couple has both primes whatever its joints are called": (
        (('A = ["l_OA"', 'D = ["l_OA"'), ('A = ["0 mm", "0 mm"], B', 'D = ["0 mm", "0 mm"], B'), AT, AT,
         ("pa=80", "pd=80"), ("p'a'=80", "p'd'=80")),
        ("F″", "F′", "h″", 'data-name="h_lever_M_i2_D"'), "F_A",
    ),
    "the arm of a counterweight is drawn": (
        ((CRANK, 'A = ["l_OA", "0 mm"], S1 = ["-20 mm", "0 mm"] }\n' + HEAVY),),
        ('data-quantity="F_i1"', 'class="line-of-action" data-name="F_i1"'), "h_lever_M_i2_D",
    ),
    "a rod without mass is drawn": (
        (('centre = "S2"\nmass = "m_2"\ninertia = "J_S2"\n', 'centre = "S2"\n'),),
        ('data-quantity="R_12"',), 'data-quantity="F_i2"',
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", some(OWN, 1))
def test_slider_crank_of_ones_own_is_drawn(name: str) -> None:
    changes, there, missing = OWN[name]
    svg = kulman.sheet(task_of(with_changes(bundled_text("nau-slider-crank"), *changes)), lang="en", format="A1").svg()

    assert [part for part in there if part not in svg] == []
    assert missing not in svg


# An ill-conditioned position says so, on the plans and in its warnings: where, and how much errors grow.
PLANS = ("structure", "position", "velocity")
POSITIONS = {
    "nau-slider-crank": ({"phi": 90, "l_OA": 50, "l_AB": "50.00001", "l_AS2": 60}, "B"),
    "madi-four-bar": ({"phi": 180, "l_AB": 120, "l_BC": "390.00001", "l_DC": 240}, "C"),
    "scheme-09-shaper": ({"phi": 90, "l_DE": "20.00001"}, "E"),
    "scheme-18-hydraulic-drive": ({"s": "100.00001", "l_AB": 270, "l_CB": 230, "x_C": 500, "y_C": -300}, "B"),
}


def texts_of(task: str, language: str, **settings: str | float) -> list[str]:
    """Return the lines of text of a sheet, letters with their indices."""
    drawn = kulman.sheet(task, set=settings, only=PLANS, lang=language)
    pages = read_back(drawn).pages
    return [text.string for page in pages for view in page.all for text in view.texts]


def beginning(language: str, key: str) -> str:
    return Words.of(language, "nau")[key].partition("{")[0]


@pytest.mark.parametrize(
    ("task", "language"),
    [
        pytest.param(task, language, marks=[pytest.mark.soak] * (i % 4 != 0))
        for i, (task, language) in enumerate((task, language) for task in POSITIONS for language in LANGUAGES)
    ],
)
def test_plans_of_an_ill_conditioned_position_say_so(task: str, language: str) -> None:
    settings, _ = POSITIONS[task]
    growth = beginning(language, "said.ill_growth")

    lines, usual = texts_of(task, language, **settings), texts_of(task, language)

    assert not any(line.startswith(beginning(language, "said.ill_position")) for line in usual)
    assert sum(line.startswith(beginning(language, "said.ill_position")) for line in lines) == 2
    assert sum(line.startswith(growth) and "K = " in line for line in lines) == 2


@pytest.mark.parametrize("task", some(POSITIONS, 0, 1))
def test_warnings_name_the_point_the_angle_and_the_condition(task: str) -> None:
    settings, point = POSITIONS[task]
    solution = kulman.solve(task, set=settings)

    (warning,) = solution.warnings

    assert solution.status == "ill-conditioned"
    assert (warning.key, warning.data["point"]) == ("ill-conditioned", point)
    worst = max(item.value or 0.0 for item in conditions_of(solution.solved).values())
    assert float(warning.data["condition"]) == pytest.approx(worst, rel=0.05)
    assert solution.solved.worst_sine()[1] == pytest.approx(1.0 / float(warning.data["loss"]), rel=0.05)
    for language in LANGUAGES:
        assert decimal(str(warning.data["angle"]), language) in warning.text(language)


def test_an_angle_that_is_only_small_is_warned_of_without_a_condition() -> None:
    (warning,) = kulman.solve("nau-slider-crank", set={"phi": 90, "l_OA": 50, "l_AB": 51}).warnings

    assert warning.key == "small-angle"
    assert float(warning.data["loss"]) == pytest.approx(5.07, rel=0.01)


def test_the_worst_condition_is_that_of_the_plan_that_shows_it() -> None:
    solved = kulman.solve("madi-four-bar").solved

    name, value = worst_condition(solved, "velocity")

    shown = [step.name for step in solved.program if plans_of(solved.program).get(step.name) == "velocity"]
    assert name in shown
    assert value == max(conditions_of(solved)[one].value or 0.0 for one in shown if one in conditions_of(solved))
    points = {step.name for step in solved.program if step.verb in POINTS}
    assert worst_condition(solved, "position")[0] in points | {"h_1", "h_2", "h_3", "h_21"}


def test_joints_that_nearly_coincide_are_named() -> None:
    settings = {"l_OC": 150, "phi": "270.02", "l_DE": 500}
    (warning,) = kulman.solve("scheme-09-shaper", set=settings).warnings

    lines = texts_of("scheme-09-shaper", "en", **settings)

    assert (warning.key, warning.data["first"], warning.data["second"]) == ("ill-conditioned-pins", "C", "A")
    assert sum(line.startswith("Ill-conditioned position: the joints C and A nearly coincide") for line in lines) == 1


@pytest.mark.parametrize(
    ("task", "language"),
    [
        ("nau-slider-crank", "ru"),
        *(pytest.param(*of, marks=pytest.mark.soak) for of in (("madi-cam", "en"), ("karpenko-hoist", "uk"))),
    ],
)
def test_letters_of_a_pdf_can_be_selected_and_faces_of_an_svg_are_whole_fonts(
    task: str, language: str, tmp_path: Path
) -> None:
    drawn = kulman.sheet(task, lang=language)
    drawn.save(tmp_path / "sheet.pdf")
    svgs = [drawn.svg(number + 1) for number in range(len(drawn.pages))]
    pages = (page.get_textpage().get_text_range() for page in PdfDocument(tmp_path / "sheet.pdf"))
    runs = (run.string for text in read(*svgs).texts for run in text.runs)
    selected, written = (Counter("".join("".join(parts).split())) for parts in (pages, runs))

    assert selected == written
    for svg in svgs:
        faces = re.findall(r"base64,([\w+/=]+)", svg)
        assert len(faces) == 2
        for face in faces:
            font = TTFont(BytesIO(b64decode(face)), lazy=False, checkChecksums=2)
            font.ensureDecompiled()
            assert {"OS/2", "cmap", "glyf", "head", "hhea", "hmtx", "loca", "maxp", "name", "post"} <= {*font.keys()}


@pytest.mark.soak
def test_a_text_that_is_higher_than_a_page_stands_in_parts_one_after_the_other() -> None:
    sheet = kulman.sheet(task_of(chain(6)), only=["acceleration"], format="A4")
    name = "equations_acceleration"
    drawn = [group.name for page in sheet.pages for group in page.shapes if isinstance(group, Group)]
    whole, *parts = (view for view in sheet.views if name in (view.name, view.of))

    assert drawn.index("acceleration") < drawn.index(name) < drawn.index(f"{name}_continued")
    assert (whole.of, whole.lines) == ("", sum((part.lines for part in parts), ()))
    assert len(parts) > 1
    assert min(len(part.lines) for part in parts) >= 10
    assert all(whole.heading[0] in part.heading[0] for part in parts)


@pytest.mark.parametrize(
    ("task", "variant"),
    some(
        [
            ("scheme-14-jaw-crusher", "3"),  # a detail of accelerations, and of small forces after it
            ("bertyaev-six-bar", "example"),  # of compound motion
            ("karpenko-hoist", "V02"),
            ("scheme-20-press-automaton", "0"),
        ],
        0,
        1,
        2,
    ),
)
def test_details_are_numbered_as_their_figures_come(task: str, variant: str) -> None:
    def every(shapes: tuple[Any, ...]) -> Iterator[Any]:
        for shape in shapes:
            yield from every(shape.shapes) if isinstance(shape, Group) else (shape,)

    marked, entitled, told = list[str](), list[str](), set[str]()
    for view in kulman.sheet(task, variant, lang="uk").views:
        shapes = [*every(view.shapes)]
        texts = {shape.markup for shape in shapes if isinstance(shape, Text)}
        shelves = [shape.name for shape in shapes if getattr(shape, "role", "") == "shelf" and shape.name]
        assert texts.issuperset(shelves)
        said = {text for text in texts if "виносний елемент" in text}
        assert said <= {*view.notes}
        told |= {text.partition("елемент ")[2] for text in said}
        found = (re.match(r"Виносний елемент (.*)|([IVX]+) \(\d+:1\)", text) for text in texts)
        entitled += sorted((match[1] or match[2] for match in found if match), key=shelves.index)
        marked += shelves

    assert marked == ["I", "II", "III", "IV", "VI", "VII", "VIII", "IX", "XI", "XII"][: len(marked)]
    assert entitled == marked
    assert {*marked} >= told
    assert marked


@pytest.mark.parametrize("only", ["velocity", "acceleration", "position,velocity"])
@pytest.mark.parametrize("task", some(bundled("mechanism"), 4, 16))
def test_what_is_not_drawn_keeps_a_scale_factor_that_could_be_drawn(task: str, only: str) -> None:
    found = kulman.solve(task, only=only)
    size = found.solved.extent / found.scales["mu_l"].mu

    assert 40.0 < size < 500.0, size
