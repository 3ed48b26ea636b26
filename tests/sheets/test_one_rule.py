"""One rule for format and scale factors: `solve`, the sheet, the note, the form and the handout show the same plans."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest

import kulman
from kulman.drawing.extents import Extent, Extents, Ladder, _grown
from kulman.drawing.shapes import Group, Shape, Vector
from kulman.plans.hands.shaky import preset
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.printed_numbers import decimal
from kulman.variants.case import Request
from kulman.variants.marking.keyed import keyed
from kulman.variants.marking.rubric import Rubric
from kulman.variants.reader import load_task
from kulman.variants.sheets import Sheet
from kulman.variants.shelf import bundled
from kulman.variants.solution import Solution

TASKS = bundled()
QUICK = ("nau-slider-crank", "madi-cam", "karpenko-hoist", "scheme-20-press-automaton")
EVERY = [task if task in QUICK else pytest.param(task, marks=pytest.mark.soak) for task in TASKS]
SAME = 0.01  # mm
CHANGES = ("scales-changed", "scale-coarser")


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


def test_a_student_who_draws_from_solve_draws_the_sheets_plan() -> None:
    solution, sheet = kulman.solve("nau-slider-crank", "7"), kulman.sheet("nau-slider-crank", "7")

    assert solution["F_3"].mm == pytest.approx(lengths(sheet)["F_3"][0], abs=SAME)
    assert (solution.format, mus(solution)["mu_F_23"]) == (sheet.format, mus(sheet)["mu_F_23"])


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


def test_solve_names_format_and_scale_factors(capsys: pytest.CaptureFixture[str]) -> None:
    solution = kulman.solve("nau-slider-crank", "7", lang="en")

    last = solution.table().splitlines()[-1]
    assert last.startswith("A1: mu_l = 0.00068 m/mm, ")
    assert solution.to_json()["format"] == "A1"
    assert [part.split(" = ")[0] for part in last.removeprefix("A1: ").split(", ")] == [*solution.to_json()["scales"]]


def test_few_plans_take_a_small_format_and_much_text_a_large_one() -> None:
    formats = [kulman.solve("nau-slider-crank", "7", only=plans).format for plans in ("velocity", "position", None)]

    assert formats == [kulman.sheet("nau-slider-crank", "7", only=p).format for p in ("velocity", "position", None)]
    assert formats[0] != formats[2] == "A1"


@pytest.mark.parametrize(
    ("task", "symbol", "mu"),
    [
        ("nau-slider-crank", "mu_l", "1000"),
        ("madi-cam", "mu_l", "1000"),
        ("madi-cam", "mu_s_ds", "1000"),
        ("madi-cam", "mu_s_d2s", "1000"),
        ("madi-cam", "mu_phi", "100000"),
        ("madi-gear", "mu_l", "1000"),
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


def test_a_scheme_with_a_long_rope_is_refused_only_where_the_rope_is_a_point() -> None:
    solution = kulman.solve("karpenko-hoist", set={"L": "40 m"}, scales={"mu_l": 25})

    assert mus(solution)["mu_l"] == 25


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
