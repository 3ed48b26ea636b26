"""Pages of a sheet: one rule for format and scale factors in all that is shown, views in order, pages well used."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

import pytest

import kulman
from kulman.drawing.extents import Extent, Extents, Ladder, _grown
from kulman.drawing.page import Page, extent
from kulman.drawing.shapes import Group, Shape, Vector
from kulman.plans.hands.shaky import preset
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.printed_numbers import decimal
from kulman.tests.support.task_files import task_of, with_changes
from kulman.variants.case import Request
from kulman.variants.marking.keyed import Rubric, keyed
from kulman.variants.reader import load_task
from kulman.variants.sheets import Sheet
from kulman.variants.shelf import bundled, bundled_text
from kulman.variants.solution import Solution

TASKS = bundled()
QUICK = ("nau-slider-crank", "madi-cam", "karpenko-hoist", "scheme-13-toggle-press")
EVERY = [task if task in QUICK else pytest.param(task, marks=pytest.mark.soak) for task in TASKS]
SAME = 0.01  # mm
MADI = {"mu_l": 0.0025, "mu_V": 0.189, "mu_a": 21.318, "mu_F_23": 33.154, "mu_F_1": 54.373}
KINEMATICS = {"givens", "structure", "position", "velocity", "acceleration", "equations_kinematics"}


def vectors(shapes: tuple[Shape, ...]) -> Iterator[Vector]:
    for shape in shapes:
        if isinstance(shape, Vector):
            yield shape
        elif isinstance(shape, Group):
            yield from vectors(shape.shapes)


def lengths(sheet: Sheet) -> dict[str, list[float]]:
    """Return how long each quantity is drawn, on its plan and in insets."""
    found: dict[str, list[float]] = {}
    for page in sheet.pages:
        for vector in vectors(page.shapes):
            assert abs(vector.tip - vector.tail) == pytest.approx(vector.value / vector.mu, abs=1e-6)
            found.setdefault(vector.quantity, []).append(vector.value / vector.mu)
    return found


def mus(of: Sheet | Solution) -> dict[str, float]:
    return {scale.symbol: scale.mu for scale in of.scales.values()}


def other_lengths(solution: Solution, sheet: Sheet) -> dict[str, object]:
    """Return the quantities that a sheet draws as no such segments as are solved."""
    drawn, items = lengths(sheet), solution.to_json()["quantities"]
    shown = {name: items[name]["mm"] for name in drawn if items.get(name, {}).get("mm")}
    assert shown or solution.task.kind != "mechanism"
    return {n: (mm, drawn[n]) for n, mm in shown.items() if all(abs(mm - length) > SAME for length in drawn[n])}


def same_scales(solution: Solution, sheet: Sheet) -> bool:
    drawn = mus(sheet)
    return all(drawn[symbol] == mu for symbol, mu in mus(solution).items())


@pytest.mark.parametrize("task", EVERY)
def test_segments_solved_are_those_of_sheet_note_form_and_handout(task: str) -> None:
    solution, sheet = kulman.solve(task), kulman.sheet(task)
    rubric = Rubric(preset("normal").tolerance)
    form = keyed(Request(load_task(task), solution.variant), solution.variant, {}, rubric).solution
    blank, on_a4 = kulman.handout(task, key=True), kulman.solve(task, format="A4")

    assert sheet.format == solution.format
    assert same_scales(solution, sheet)
    assert sheet.warnings == solution.warnings
    assert other_lengths(solution, sheet) == {}
    assert (mus(form), form.format) == (mus(solution), solution.format)
    assert mus(kulman.note(task).sheet) == mus(sheet)
    assert same_scales(on_a4, blank)
    assert other_lengths(on_a4, blank) == {}


@pytest.mark.soak
@pytest.mark.parametrize("task", TASKS)
def test_every_variant_is_drawn_as_it_is_solved(task: str) -> None:
    for variant in load_task(task).variants:
        solution, sheet = kulman.solve(task, variant), kulman.sheet(task, variant)

        assert same_scales(solution, sheet), variant
        assert sheet.format == solution.format, variant
        assert other_lengths(solution, sheet) == {}, variant


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
        assert f"kulman solve --format {format}" in line
        assert set(re.findall(r"mu_\w+", line)) == changed
        for symbol in changed:
            change = f"{symbol} {mus(usual)[symbol]:g} -> {mus(small)[symbol]:g}"
            assert decimal(change, language) in line


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


def test_a_plan_on_the_cranks_scale_is_counted_with_the_mechanism_when_a_page_is_filled() -> None:
    ladders = {"mu_l": Ladder((0.001, 0.002, 0.004), 0.4), "mu_V": Ladder((0.01, 0.02, 0.04), 4.0, root="mu_l")}
    mechanism, plan = Extent("mu_l", (0.4, 0.3), (0.0, 0.0)), Extent("mu_V", (4.0, 3.0), (0.0, 0.0), part=1)
    extents = Extents((mechanism, plan), (0.0, 0.0), ladders)
    asked: list[int] = []

    def fits(rungs: dict[str, int]) -> bool:
        asked.append(rungs["mu_l"])
        return True

    assert _grown(extents, {"mu_l": 2}, {"mu_l": 0}, fits) == {"mu_l": 0}
    assert asked == [1, 0]


def views(page: Page) -> Iterator[Group]:
    yield from (shape for shape in page.shapes if isinstance(shape, Group) and shape.role == "view")


def used(page: Page) -> float:
    """Part of the page that the boxes of its views cover."""
    boxes = [extent(view.shapes) for view in views(page)]
    return sum((c - a) * (d - b) for a, b, c, d in boxes) / (page.width * page.height)


@pytest.mark.parametrize(("symbol", "mu"), [("mu_F_23", 15.0), pytest.param("mu_a", 8.0, marks=pytest.mark.soak)])
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


@pytest.mark.parametrize(
    "task", ["scheme-10-shaper-two-blocks", pytest.param("scheme-04-v-engine", marks=pytest.mark.soak)]
)
def test_two_pages_are_read_in_order_and_used(task: str) -> None:
    drawn = two_pages(task)

    names = [[view.name for view in views(page)] for page in drawn.pages]
    assert len(names) == 2
    assert KINEMATICS & {*names[0]}
    assert not KINEMATICS & {*names[1]}
    assert names[0][:2] == ["givens", "structure"]
    assert all(used(page) > 0.4 for page in drawn.pages)


def test_plans_are_drawn_larger_where_pages_have_room() -> None:
    drawn = mus(two_pages("scheme-10-shaper-two-blocks"))
    solved = kulman.solve("scheme-10-shaper-two-blocks", "6")

    longest = {
        symbol: max(q.mm or 0.0 for name, q in solved.quantities.items() if q.scale == symbol and q.kind == "vector")
        for symbol in ("mu_V", "mu_a", "mu_F_23")
    }
    assert {symbol: drawn[symbol] for symbol in longest} == {s: mu for s, mu in mus(solved).items() if s in longest}
    assert all(80.0 < millimetres < 300.0 for millimetres in longest.values())


@pytest.mark.parametrize("task", ["nau-slider-crank", "madi-four-bar", "bertyaev-six-bar", "scheme-20-press-automaton"])
def test_a_structure_alone_is_drawn_with_its_scheme(task: str) -> None:
    assert {view.name for view in kulman.sheet(task, only="structure").views} == {"givens", "structure", "position"}


# Slider-cranks that a user may write: other letters, a crank with a counterweight, a rod without mass.
@pytest.mark.parametrize(
    ("changes", "there", "missing"),
    [
        pytest.param(
            (
                ('A = ["l_OA"', 'D = ["l_OA"'),
                ('A = ["0 mm", "0 mm"], B', 'D = ["0 mm", "0 mm"], B'),
                ('point = "A"', 'point = "D"'),  # of the pair on the frame
                ('point = "A"', 'point = "D"'),
                ("pa=80", "pd=80"),
                ("p'a'=80", "p'd'=80"),
            ),
            ("F″", "F′", "h″", 'data-name="h_lever_M_i2_D"'),
            "F_A",
            id="a couple has both primes whatever its joints are called",
        ),
        pytest.param(
            (
                (
                    'A = ["l_OA", "0 mm"] }\ncentre = "O"',
                    'A = ["l_OA", "0 mm"], S1 = ["-20 mm", "0 mm"] }\ncentre = "S1"\nmass = "m_2"',
                ),
            ),
            ('data-quantity="F_i1"', 'class="line-of-action" data-name="F_i1"'),
            "h_lever_M_i2_D",
            id="the arm of a counterweight is drawn",
        ),
        pytest.param(
            (('centre = "S2"\nmass = "m_2"\ninertia = "J_S2"\n', 'centre = "S2"\n'),),
            ('data-quantity="R_12"',),
            'data-quantity="F_i2"',
            id="a rod without mass is drawn",
        ),
    ],
)
def test_slider_crank_of_ones_own_is_drawn(
    changes: tuple[tuple[str, str], ...], there: tuple[str, ...], missing: str
) -> None:
    svg = kulman.sheet(task_of(with_changes(bundled_text("nau-slider-crank"), *changes)), lang="en", format="A1").svg()

    assert [part for part in there if part not in svg] == []
    assert missing not in svg
