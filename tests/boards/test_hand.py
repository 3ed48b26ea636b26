"""The hand on the command line: intervals, what to let pass, the worst step; the same drawings every time."""

from __future__ import annotations

import json
import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from kulman import sheet, solve
from kulman.drawing.formats import FORMATS
from kulman.plans.hands.shaky import PRESETS, Hand, Paper, draw
from kulman.plans.hands.spread import DRAWINGS, SEED, Expectation, _Spread
from kulman.scales.choices import HANDS, SIZES
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.commands import Run
from kulman.variants.hands import _hand_of
from kulman.variants.shelf import bundled

KEYS = {"low", "high", "mm", "percent", "miss", "miss_mm", "step", "share", "tolerance", "tolerance_mm"}
KEYS |= {"degrees", "tolerance_deg", "failed", "undrawn"}


def items(task: str = "nau-slider-crank", variant: str | None = "example", **more: Any) -> dict[str, Any]:
    found = solve(task, variant, **{"hand": "normal", **more}).to_json()["quantities"]
    return {name: item["hand"] for name, item in found.items() if "hand" in item}


@pytest.mark.parametrize("rigid", [("I_0",), ("I_2",), ("I_0", "I_2")], ids=",".join)
def test_what_is_infinite_of_rigid_beams_misses_nothing(rigid: tuple[str, ...]) -> None:
    solution = solve("karpenko-hoist", hand="normal", set=dict.fromkeys(rigid, "inf"))
    found = {name: item.get("hand") for name, item in solution.to_json()["quantities"].items()}

    infinite = [{"I_0": "C_01", "I_2": "C_2"}[name] for name in rigid]
    for name in infinite:
        assert solution[name].value is None
        assert found[name] == dict.fromkeys(KEYS) | {"failed": 0.0, "undrawn": 0.0}, name
    of_one = {name for name, item in found.items() if item and item["low"] is not None}
    assert len(of_one) > 20
    assert all(found[name]["low"] <= solution[name].value <= found[name]["high"] for name in of_one)
    for language in LANGUAGES:
        row = next(row for row in solution.drawn(language).splitlines() if row.startswith(f"{infinite[0]} "))
        assert row.split() == [infinite[0], "–", *row.split()[2:3], "–"]


def test_json_of_the_command_line_says_what_a_hand_draws_if_anything(run: Run) -> None:
    status, out, _ = run("solve", "nau-slider-crank", "-v", "example", "--hand", "normal", "--json")
    found = json.loads(out)
    quantities = found["quantities"]
    lost, without, _ = run("solve", "nau-slider-crank", "--set", "l_AB=5", "--hand", "normal", "--json")

    assert (status, lost) == (0, 3)
    assert "hand" not in json.loads(without)
    assert (found["hand"]["name"], found["hand"]["tolerance"]) == ("normal", {"mm": 2.0, "part": 0.05, "degrees": 1.0})
    assert all(item["hand"].keys() == KEYS for name, item in quantities.items() if not name.startswith("l_"))
    V_B, width = quantities["V_B"]["hand"], quantities["V_B"]["hand"]["high"] - quantities["V_B"]["hand"]["low"]
    assert V_B["low"] < quantities["V_B"]["value"] < V_B["high"]
    assert V_B["mm"] == pytest.approx(0.5 * width / found["scales"]["mu_V"]["value"])
    assert V_B["percent"] == pytest.approx(50.0 * width / quantities["V_B"]["value"])
    assert (V_B["step"], round(V_B["share"], 1)) == ("velocity.B", 0.4)
    assert V_B["tolerance_mm"] >= 2.0
    assert V_B["tolerance_deg"] >= 1.0
    assert quantities["omega_2"]["hand"]["mm"] is None
    assert [quantities["omega_1"]["hand"][part] for part in ("step", "share", "failed")] == [None, None, 0.0]


def test_intervals_hold_95_of_100_drawings_of_this_generator_every_time() -> None:
    solution, found = solve("nau-slider-crank", "example", hand="normal"), items()
    mus = {plan: solution.scales[symbol].mu for plan, symbol in solution.solved.scale_of_plan.items()}
    mus["lever"] = solution.scales["mu_h"].mu  # which the sheet draws larger than the velocity plan
    paper = Paper(solution.solved.program, solution.solved.givens, mus)

    board = draw(paper, PRESETS["normal"].hand, np.random.default_rng(SEED), DRAWINGS)

    assert found == items()
    for name, item in found.items():
        values, exact = board.values[name], solution.solved.values[name]
        sizes = np.abs(values) if np.iscomplexobj(values) else values
        if item["step"] is not None and item["low"] is not None:
            assert np.mean((sizes >= item["low"]) & (sizes <= item["high"])) == pytest.approx(0.95, abs=1e-3), name
        if item["step"] is not None and item["degrees"] is not None:
            off = np.degrees(np.abs(np.angle(values * np.conj(exact))))
            assert np.mean(off <= item["degrees"]) == pytest.approx(0.95, abs=1e-3), name
    # the crank is laid off, then the vector; a mark and a reading turn 80 mm by less
    turned = math.hypot(0.5, 0.5, *[math.degrees(0.25 / 80.0)] * 2)
    assert found["V_A"]["degrees"] == pytest.approx(1.96 * turned, rel=0.05)
    assert found["omega_2"]["degrees"] is None


def test_a_steadier_hand_draws_narrower_intervals_and_one_without_errors_what_is_calculated() -> None:
    found = [items(hand=hand) for hand in HANDS]
    widths = [{n: item["high"] - item["low"] for n, item in each.items() if item["low"] is not None} for each in found]
    solution = solve("madi-four-bar", hand=Hand(0.0, 0.0, 0.0))

    assert list(HANDS) == list(PRESETS)
    assert list(SIZES) == [name for name in FORMATS if not name.endswith("-portrait")]
    for steady, shaky in pairwise(widths):
        assert all(steady[name] < shaky[name] for name in steady if shaky[name] > 0.0)
    assert solution.drawing is not None
    for name, expected in solution.drawing.expected.items():
        value = solution[name].value
        assert expected.step is None
        if value is not None:
            assert expected.spread.low == expected.spread.high == pytest.approx(value, rel=1e-15), name


@pytest.mark.parametrize(
    "text",
    [
        "0.2 mm, 0.5 deg, 0.2 mm",
        "0,2 мм; 0,5 град; 0,2 мм",
        "0.2mm,0.5°,0.2mm",
        "0.2; 0.5; 0.2",
        "0,2 мм, 0,5°, 0,2 мм",
    ],
)
def test_a_hand_of_ones_own_is_read(text: str) -> None:
    name, hand, tolerance = _hand_of(text)

    assert name == "own"
    assert [hand.point, hand.direction, hand.reading] == pytest.approx([0.2, 0.5, 0.2], rel=1e-14)
    assert tolerance == PRESETS["normal"].tolerance


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ("normel", "hand-unknown-like"),
        ("0.2 mm, 0.5 deg", "hand-three"),
        ("0.2 mm, 0.5 mm, 0.2 mm", "unit-wrong"),
        ("0.2 mm, 0.5 deg, -1 mm", "hand-negative"),
    ],
)
def test_a_wrong_hand_is_refused_in_one_line(text: str, key: str, run: Run) -> None:
    with pytest.raises(InputError) as refused:
        solve("nau-slider-crank", hand=text)
    status, out, err = run("solve", "nau-slider-crank", "--hand", text)

    assert refused.value.key == key
    assert all(refused.value.text(language) for language in LANGUAGES)
    assert (status, out, err.count("\n")) == (2, "", 1)


def test_scale_factors_are_those_of_the_sheet_of_a_format() -> None:
    drawn = sheet("nau-slider-crank", "example", only="velocity", format="A4")
    small = solve("nau-slider-crank", "example", only="velocity", format="A4", hand="normal")
    large = items(only="velocity", scales={"pa": 200})

    for plan, symbol in small.solved.scale_of_plan.items():
        assert drawn.scales[plan].mu == small.scales[symbol].mu, plan
    assert items(only="velocity", format="A4")["V_B"]["percent"] > large["V_B"]["percent"]


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_table_says_it_in_every_language_and_keeps_the_notation(language: str) -> None:
    solution = solve("scheme-09-shaper", hand="normal")
    lines = solution.drawn(language).splitlines()
    wanted = {"only": "acceleration", "hand": "normal", "notation": "bertyaev"}  # without primes
    table = solve("nau-slider-crank", "3", **wanted).drawn(language)

    heads = [line for line in lines if "95 %" in line]
    assert len(heads) == 1
    rows = [row for row in lines[lines.index(heads[0]) + 1 :] if row]
    assert [row.split()[0] for row in rows] == list(solution.drawing.expected)  # type: ignore[union-attr]
    decimal = "." if language == "en" else ","
    assert all(decimal in row for row in rows if row.split()[0] in ("V_E", "R_05"))
    assert table == solve("nau-slider-crank", "3", lang=language, **wanted).drawn()
    assert "′" not in table
    assert "′" in solve("nau-slider-crank", "3", **wanted | {"notation": "nau"}).drawn(language)


def test_conditions_stand_beside_what_the_hand_makes() -> None:
    solution = solve("nau-slider-crank", "3", only="velocity", hand="careful", condition=True)

    lines = solution.drawn("en").splitlines()

    head = next(line for line in lines if line.startswith("quantity"))
    row = next(line for line in lines if line.startswith("V_B "))
    k, sine = (float(row[: head.index(name) + len(name)].split()[-1]) for name in (" K", " sin"))
    assert k == pytest.approx(solution.conditions["V_B"].value, rel=0.01)
    assert sine == pytest.approx(solution.conditions["V_B"].sine, rel=0.01)
    assert " sin " not in solve("nau-slider-crank", "3", only="velocity", hand="careful").drawn("en")


def test_a_zero_segment_lets_what_is_calculated_from_it_pass_and_a_step_that_breaks_has_no_part() -> None:
    """In the dead position a_BA_t is zero: epsilon_2 misses by what that point may miss, whichever way."""
    found, broken = items(set={"phi": 0}), items(set={"phi": 90, "l_AB": "50.00001"}, only="velocity")["B"]
    l_AB = solve("nau-slider-crank", "example").solved.values["l_AB"]

    assert found["a_BA_t"]["tolerance_mm"] >= 2.0
    assert found["epsilon_2"]["tolerance"] == pytest.approx(found["a_BA_t"]["tolerance"] / l_AB, rel=1e-9)
    assert found["epsilon_2"]["failed"] < 0.2  # as of the segment itself
    assert found["M_i2"]["failed"] == found["epsilon_2"]["failed"]
    assert broken["step"] is not None
    assert broken["share"] is None
    assert broken["undrawn"] == pytest.approx(0.5, abs=0.05)


TASKS = [pytest.param(task, marks=[pytest.mark.soak] * (i % 6 > 0)) for i, task in enumerate(bundled("mechanism"))]


@pytest.mark.parametrize("task", TASKS)
def test_every_task_is_drawn_by_hand_and_few_hands_fail(task: str) -> None:
    solution = solve(task, hand="careful")
    found = solution.to_json()["quantities"]
    drawn = {name: item["hand"] for name, item in found.items() if "hand" in item}

    assert json.dumps(found, allow_nan=False)
    assert np.median([item["failed"] for item in drawn.values()]) < 0.02
    for name, item in drawn.items():
        if item["step"] is not None and found[name].get("value") is not None:
            assert 0.0 < item["share"] <= 1.0, name
            assert name.startswith("delta_") or item["tolerance"] > 0.0, name
            assert ("x" in found[name]) == (item["tolerance_deg"] is not None), name
    assert solution.drawn("uk")


@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e6])
def test_what_is_nothing_beside_its_plan_has_no_per_cents_in_any_unit(unit: float) -> None:
    def per_cents(exact: float) -> float | None:
        spread = _Spread(0.0, exact=exact, low=0.9 * unit, high=1.1 * unit, size=3.0 * unit)
        return Expectation(spread, None, None, None, None, 0.0, None, True).percent

    assert per_cents(unit) == pytest.approx(10.0)
    assert per_cents(1e-13 * unit) is None
