"""Gear pairs solved: quantities with units, checks and warnings, what is undefined, plans, limits, other languages."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from kulman import cli, solve
from kulman.plans.gears.gear import PLANS, GearPair
from kulman.plans.gears.geometry import geometry_program
from kulman.plans.gears.solve import SECTIONS, WHOLE, conditions_of, section_of, solve_gear
from kulman.plans.hands.shaky import paper_of, preset
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.gears import SEED, counted_ratio, random_pairs
from kulman.variants.solution import Solution

TASK = "madi-gear"


@pytest.fixture(scope="module")
def solution() -> Solution:
    return solve(TASK, lang="en")


def test_every_calculated_quantity_is_there_in_si_with_its_unit(solution: Solution) -> None:
    named = {name for name in geometry_program().names if not name.startswith("_")}
    units = {
        "rad": ("alpha_", "tau_", "nu_", "phi_"),
        "1": ("x_", "inv_", "epsilon_", "theta_", "z_W", "u", "y", "delta_y"),
    }

    assert named <= set(solution)
    for name, quantity in solution.quantities.items():
        if quantity.unit == "rad":
            assert name.startswith(units["rad"])
        elif quantity.unit == "1":
            assert name.startswith(units["1"])
        else:
            assert quantity.unit == {"mu_rho": "m/mm", "mu_theta": "1/mm"}.get(name, "m")
    assert solution["d_a1"].value == pytest.approx(0.0854997, abs=5e-8)
    assert math.degrees(solution["alpha_w"].value or 0.0) == pytest.approx(26.654, abs=5e-4)
    assert (solution["a_w"].mm, solution["a_w"].scale) == (pytest.approx(460.0, abs=1e-3), "mu_l")


def test_infinite_sliding_is_null_in_json_and_a_dash_in_the_table(
    solution: Solution, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        cli.main(["solve", TASK, "--json"])

    printed = capsys.readouterr().out
    data = json.loads(printed)["quantities"]

    assert "Infinity" not in printed
    assert [name for name, item in data.items() if item.get("value", 0.0) is None] == ["theta_12_01", "theta_21_12"]
    assert [name for name in data if name.endswith("_01")] == ["y_1_01", "y_2_01", "theta_12_01", "theta_21_01"]
    assert any(line.split() == ["theta_12_01", "–"] for line in solution.table().splitlines())


def test_table_is_divided_into_the_sections_of_the_note_in_every_language(solution: Solution) -> None:
    headings = solution.kind.headings(solution.solved, solution.words)

    assert [section_of(name) for name in headings] == list(SECTIONS)
    assert list(solution) == sorted(solution, key=lambda name: SECTIONS.index(section_of(name)))
    for language in LANGUAGES:
        lines = solution.table(language).splitlines()
        said = solution.kind.headings(solution.solved, solution.words.speaking(language)).values()
        assert all(heading in lines for heading in said)
    assert "26.6541     °" in solution.table()
    assert " rad" not in solution.table()


@pytest.mark.parametrize(
    ("only", "sections", "drawn"),
    [
        pytest.param("geometry", SECTIONS[:6], (), id="geometry"),
        pytest.param("meshing", SECTIONS[:7], ("meshing",), id="meshing"),
        pytest.param("sliding", (*SECTIONS[:6], SECTIONS[7]), ("sliding", "theta"), id="sliding"),
        pytest.param("meshing,sliding", SECTIONS, ("meshing", "sliding", "theta"), id="all"),
    ],
)
def test_only_the_plans_wanted_are_built(only: str, sections: tuple[str, ...], drawn: tuple[str, ...]) -> None:
    found = solve(TASK, only=only)

    assert tuple(dict.fromkeys(map(section_of, found))) == sections
    assert tuple(found.solved.scale_of_plan) == drawn
    assert set(PLANS) >= {*only.split(",")}


def test_checks_have_values_limits_and_verdicts(solution: Solution) -> None:
    checks = solution.checks

    assert all(check["ok"] for check in checks.values())
    assert solution.warnings == ()
    assert set(checks) == {
        *(f"centre_a_w_{way}" for way in ("rolling", "shift", "tip1", "tip2")),
        *(f"{rule}_{i}" for rule in ("undercut", "interference", "tip") for i in (1, 2)),
        "contact_ratio",
    }
    assert checks["contact_ratio"] == {
        "ok": True,
        "quantity": "epsilon_alpha",
        "value": solution["epsilon_alpha"].value,
        "limit": 1.2,
        "relation": "at-least",
        "unit": "1",
    }
    assert checks["tip_1"]["limit"] == pytest.approx(1.5e-3)
    assert solve(TASK, set={"material": "hardened"}).checks["tip_1"]["limit"] == pytest.approx(2e-3)


def test_table_ends_in_the_checks_with_their_limits(solution: Solution) -> None:
    last = solution.table("en").splitlines()[-len(solution.checks) :]

    assert [line.split()[0] for line in last] == list(solution.checks)
    assert last[4].split() == ["undercut_1", "x_1", "0.2", "≥", "0.122667", "satisfied"]
    assert last[6].split() == ["interference_1", "rho_l1", "1.13054", "mm", "≤", "6.41925", "mm", "satisfied"]
    bad = solve(TASK, set={"x_1": 0.1}, lang="en").table().splitlines()
    assert [line.split()[0] for line in bad if line.endswith("not satisfied")] == ["undercut_1"]


@pytest.mark.parametrize(
    ("settings", "failing", "told"),
    [
        pytest.param({"x_1": 0.1}, {"undercut_1"}, ("x_1 = 0.1 is less than 0.1227",), id="undercut"),
        pytest.param(
            {"x_1": 1.3, "x_2": 0.3},
            {"interference_1", "contact_ratio", "tip_1"},
            ("rho_l1 = 17.21 mm is greater than rho_p1 = 16.97 mm", "contact ratio 1.01", "s_a1 = 1.286 mm"),
            id="interference",
        ),
        pytest.param(
            {"z_1": 12, "x_1": 0.3, "x_2": 1.6},
            {"interference_2", "contact_ratio"},
            ("wheel 2", "less than 1: for a part of the turn"),
            id="broken contact",
        ),
        pytest.param({"material": "hardened", "x_1": 0.6}, {"contact_ratio"}, ("1.2, the least advised",), id="short"),
        pytest.param(
            {"x_1": 2.5, "x_2": 0.4},
            {"tip_1", "interference_1", "contact_ratio"},
            ("its teeth are pointed",),
            id="pointed",
        ),
    ],
)
def test_limits_that_are_not_kept_are_told(
    settings: dict[str, object], failing: set[str], told: tuple[str, ...]
) -> None:
    found = solve(TASK, set=settings)  # type: ignore[arg-type]

    assert failing <= {name for name, check in found.checks.items() if not check["ok"]}
    warnings = [warning.text("en") for warning in found.warnings]
    assert all(any(text in warning for warning in warnings) for text in told), warnings
    for language in LANGUAGES:
        assert all("{" not in warning.text(language) for warning in found.warnings)


@pytest.mark.parametrize(
    ("teeth", "ratio"),
    [
        pytest.param({"z_1": 8, "z_2": 25}, 0.9127, id="undercut pinion"),
        pytest.param({"z_1": 7, "z_2": 7}, 0.3768, id="undercut both"),
    ],
)
def test_contact_of_cut_flanks_is_judged_by_what_is_left_of_them(teeth: dict[str, object], ratio: float) -> None:
    found = solve(TASK, set={**teeth, "x_1": 0, "x_2": 0})  # type: ignore[arg-type]
    counted = counted_ratio(found.solved.meshing)

    assert found.checks["contact_ratio"]["ok"]  # by the formula, which counts the flanks that are cut away
    assert not found.checks["contact_flanks"]["ok"]
    assert found.checks["contact_flanks"]["value"] == pytest.approx(ratio, abs=1e-4)
    assert counted == pytest.approx(ratio, abs=2e-3)
    assert any("less than 1: for a part of the turn no flanks touch" in w.text("en") for w in found.warnings)


def test_angles_may_miss_what_their_marks_miss(solution: Solution) -> None:
    paper = paper_of(solution.solved, {scale.symbol: scale.mu for scale in solution.scales.values()})

    careful, normal = (
        solution.kind.limits(solution.solved, paper, preset(name).tolerance) for name in ("careful", "normal")
    )

    assert {"phi_alpha1_drawn", "phi_alpha2_drawn", "epsilon_alpha_arc1", "epsilon_alpha_arc2"} <= set(normal)
    assert math.radians(1.0) < normal["phi_alpha1_drawn"] < math.radians(4.0)
    assert all(careful[name] < limit for name, limit in normal.items())
    assert normal["epsilon_alpha_arc1"] == pytest.approx(normal["phi_alpha1_drawn"] / solution["tau_1"].value, rel=1e-6)


def test_what_honest_drawings_give_is_let_pass() -> None:
    found = solve(TASK, hand="normal")

    assert found.drawing is not None
    for name, expected in found.drawing.expected.items():
        assert expected.failed <= 0.06, name


def test_conditions_tell_how_quantities_hang_on_the_data() -> None:
    found = solve(TASK, condition=True)
    known = {name: condition.value for name, condition in found.conditions.items()}

    assert set(known) == set(found)
    assert known["a"] == pytest.approx(1.0, rel=1e-8)  # m alone, for whole numbers do not err
    assert known["d_b1"] == pytest.approx(1.0 + 20.0 * math.tan(math.radians(20.0)) * math.pi / 180.0, rel=1e-8)
    assert known["tau_1"] == known["u"] == 0.0
    assert known["mu_theta"] == pytest.approx(1.0)
    assert known["theta_12_01"] is None
    assert known["rho_l1"] > 10.0 > known["rho_l2"]  # nearly undercut
    assert found.conditions["g_alpha_drawn"].sine == pytest.approx(math.sin(found["alpha_a1"].value or 0.0), rel=1e-12)
    # by the givens of a task, one after the other
    total = 0.0
    for name, value in (
        ("m", 5.0),
        ("x_1", 0.2),
        ("x_2", 0.85),
        ("alpha", 20.0),
        ("h_a", 1.0),
        ("h_l", 2.0),
        ("c", 0.25),
    ):
        more, less = (solve(TASK, set={name: value * (1.0 + step)})["g_alpha"].value for step in (1e-4, -1e-4))
        total += abs((more or 0.0) - (less or 0.0)) / 2e-4
    assert known["g_alpha"] == pytest.approx(total / (found["g_alpha"].value or 1.0), rel=1e-5)


def test_scale_factors_that_a_pair_has_not_are_refused() -> None:
    for symbol in ("mu_V", "mu_rho"):
        with pytest.raises(InputError):
            solve(TASK, scales={symbol: "0.05"})


@pytest.mark.parametrize("count", [5, pytest.param(100, marks=pytest.mark.soak)])
def test_no_quantity_of_a_pair_loses_more_than_its_condition_says(count: int) -> None:
    random, err = np.random.default_rng(SEED), 1e-7
    pairs = random_pairs(random, count)
    for i in range(count):
        numbers = {name: float(values[i]) for name, values in pairs.items()}
        right = solve_gear(GearPair(), numbers)
        erring = {
            name: value if name in WHOLE else value * (1.0 + err * random.choice((-1.0, 1.0)))
            for name, value in numbers.items()
        }
        there = solve_gear(GearPair(), erring)

        for name, condition in conditions_of(right).items():
            value, moved = right.values[name], there.values[name]
            if condition.value is None or not math.isfinite(value):
                continue
            size = max(abs(value), numbers["m"]) if name in right.shown_on else abs(value)
            assert abs(moved - value) <= err * (condition.value * 1.001 + 1e-3) * size, (i, name)
