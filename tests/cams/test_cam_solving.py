"""Tasks about cams solved: quantities, rules of good design, what the commands print."""

from __future__ import annotations

import json
import math
from typing import Any

import pytest

from kulman import cli, solve
from kulman.plans.cams.cam import LAWS
from kulman.scales.errors import InputError
from kulman.variants.solution import Solution

TASK = "madi-cam"


@pytest.fixture(scope="module")
def solution() -> Solution:
    return solve(TASK)


def test_quantities_have_their_names_and_units(solution: Solution) -> None:
    units = {
        "m": "A_1 A_2 ds_max s_max r_0 e s_0 rho_min R_roller r_0_flat_min r_0_flat R_plate H_v H_a",
        "m/mm": "mu_s mu_ds mu_d2s mu_s_chord mu_ds_chord mu_d2s_chord",
        "rad": "gamma_rise_min gamma_fall_min nu",
        "(m/s)/mm": "mu_v",
        "(m/s^2)/mm": "mu_a",
        "rad/mm": "mu_phi",
        "m/s": "v_max",
        "m/s^2": "a_max",
    }

    assert {name: solution[name].unit for names in units.values() for name in names.split()} == {
        name: one for one, names in units.items() for name in names.split()
    }


@pytest.mark.parametrize("chord", ["", "_chord"])
def test_scale_factors_hang_together(solution: Solution, chord: str) -> None:
    def q(name: str) -> float:
        value = solution[name].value
        assert value is not None
        return value

    mu_s, mu_ds, mu_d2s = (q(f"{name}{chord}") for name in ("mu_s", "mu_ds", "mu_d2s"))
    assert mu_ds == pytest.approx(mu_s / (q("mu_phi") * q("H_v") * 1e3), rel=1e-12)
    assert mu_d2s == pytest.approx(mu_ds / (q("mu_phi") * q("H_a") * 1e3), rel=1e-12)
    assert q(f"mu_v{chord}") == pytest.approx(200.0 * mu_ds, rel=1e-12)
    assert q(f"mu_a{chord}") == pytest.approx(200.0**2 * mu_d2s, rel=1e-12)
    assert math.tan(q(f"nu{chord}")) == pytest.approx(mu_s / mu_ds, rel=1e-12)


@pytest.mark.parametrize("law", LAWS)
def test_every_law_is_solved_and_keeps_the_limits(law: str) -> None:
    found = solve(TASK, set={"law": law}, only="sizes")

    assert found.status == "ok"
    assert found["s_max"].value == pytest.approx(0.013)
    assert {name: one["ok"] for name, one in found.checks.items() if name.startswith("gamma")} == {
        "gamma_rise": True,
        "gamma_fall": True,
    }
    assert [warning.key for warning in found.warnings if warning.key == "cam-no-plate"] == (
        ["cam-no-plate"] if law == "uniform" else []
    )


def test_only_what_is_wanted_is_built() -> None:
    diagrams, sizes = (solve(TASK, only=plan) for plan in ("diagrams", "sizes"))

    assert ("mu_s" in diagrams, "r_0" in diagrams) == (True, False)
    assert ("r_0" in sizes, "rho_min" in sizes) == (True, False)


def test_sense_of_rotation_moves_the_follower_to_the_other_side(solution: Solution) -> None:
    turned = solve(TASK, set={"rotation": "cw"})

    assert turned["e"].value == pytest.approx(-(solution["e"].value or 0.0), rel=1e-12)
    assert turned["r_0"].value == pytest.approx(solution["r_0"].value, rel=1e-12)


def test_given_radius_has_a_range_of_offsets_or_a_reason_why_there_is_none(solution: Solution) -> None:
    wide = solve(TASK, set={"r_0": 60})

    assert wide["e_least"].value < wide["e"].value < wide["e_most"].value  # type: ignore[operator]
    with pytest.raises(InputError, match=r"at r_0 = 45 mm no eccentricity keeps .* takes at least 45\.2582 mm"):
        solve(TASK, set={"r_0": 45})
    assert "e_least" not in solution


# rules of good design


def test_rules_of_good_design_hold_for_the_project(solution: Solution) -> None:
    checks = solution.checks

    assert all(one["ok"] for one in checks.values())
    assert checks["roller_of_radius"]["limit"] == pytest.approx(0.4 * (solution["r_0"].value or 0.0))
    assert checks["roller_of_curvature"]["limit"] == pytest.approx(0.7 * (solution["rho_min"].value or 0.0))
    assert checks["roller_of_radius"]["value"] == 0.007
    assert solution.warnings == ()


@pytest.mark.parametrize(
    ("settings", "broken"),
    [
        pytest.param({"R_roller": 19}, {"roller_of_radius"}, id="of the radius"),
        pytest.param({"R_roller": 22}, {"roller_of_radius", "roller_of_curvature"}, id="of the curvature"),
        pytest.param(
            {"R_roller": 33}, {"roller_of_radius", "roller_of_curvature", "undercut_roller"}, id="undercut profile"
        ),
        pytest.param({"r_0": 46, "e": -5}, {"gamma_rise"}, id="transmission angle"),
    ],
)
def test_a_broken_rule_is_told(settings: dict[str, Any], broken: set[str]) -> None:
    found = solve(TASK, set=settings)

    assert {name for name, one in found.checks.items() if not one["ok"]} == broken
    told = [warning.text() for warning in found.warnings if warning.key != "cam-r-0-at-e"]  # which tells the least r_0
    assert len(told) == len(broken)
    assert ("undercut_roller" in broken) == any(
        "is undercut: from 35.61° to 49.73° the follower loses up to 0.0224 mm" in line for line in told
    )
    assert ("roller_of_radius" in broken) == any("is larger than 0.4 r_0 = 18.1 mm" in line for line in told)
    assert ("gamma_rise" in broken) == any("in the rise the transmission angle falls to" in line for line in told)


def test_roller_that_leaves_no_cam_is_refused() -> None:
    with pytest.raises(InputError, match=r"the roller, 46 mm, is not smaller than r_0 = 45\.25818 mm"):
        solve(TASK, set={"R_roller": 46})


# the commands


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[object, str, str]:
    with pytest.raises(SystemExit) as stopped:
        cli.main(arguments)
    out, err = capsys.readouterr()
    return stopped.value.code, out, err


def test_solve_prints_json_with_the_scale_factors_and_checks(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "solve", TASK, "--json")

    data = json.loads(out)
    assert (status, data["status"]) == (0, "ok")
    assert data["scales"]["mu_s"]["value"] == data["quantities"]["mu_s"]["value"]
    assert data["scales"]["mu_l"] == {"value": 0.001, "unit": "m/mm"}
    assert data["quantities"]["A_1"]["mm"] == pytest.approx(110.0)
    assert data["checks"]["convex"]["ok"] is True


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (
            ("solve", TASK, "--only", "velocity"),
            "unknown plan 'velocity'; known are: diagrams, sizes, profile, pressure\n",
        ),
        (
            ("solve", TASK, "--scale", "mu_s=1"),
            "mu_s follows from the lengths on paper that are given; chosen may be: mu_l, mu_s_ds, mu_s_d2s\n",
        ),
        (("solve", TASK, "--set", "h=-1"), "h: '-1': must be greater than zero\n"),
    ],
)
def test_what_a_cam_has_not_is_refused_in_one_line(
    arguments: tuple[str, ...], line: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")

    assert run(capsys, *arguments) == (2, "", line)
