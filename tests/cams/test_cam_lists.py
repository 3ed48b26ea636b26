"""What is listed of a cam: the quantities of the plans wanted, under headings."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from kulman import solve
from kulman.plans.cams.cam import PLANS
from kulman.plans.cams.construction import construct
from kulman.plans.cams.solve import OF_PLAN, PRESSURES, SolvedCam, section_of

TASKS = ("madi-cam", str(Path(__file__).parents[2] / "docs" / "examples" / "rocker-cam.toml"))
GIVEN = {"mu_phi", "H_a", "H_v", "R_roller", "l_rocker"}


@cache
def names(task: str, *plans: str) -> frozenset[str]:
    return frozenset(solve(task, only=plans).to_json()["quantities"])


@pytest.mark.parametrize("task", TASKS, ids=["roller", "rocker"])
def test_only_a_plan_lists_what_it_adds(task: str) -> None:
    layout = solve(task).solved
    assert isinstance(layout, SolvedCam)
    steps = {plan: {step.name for step in construct(layout.layout, (plan,))} for plan in PLANS}

    assert names(task, "diagrams") - GIVEN <= steps["diagrams"]
    assert names(task, "sizes") - GIVEN <= steps["sizes"] - steps["diagrams"]
    assert names(task, "profile") - GIVEN <= steps["profile"] - steps["sizes"]
    assert names(task, "pressure") == {*PRESSURES}


@pytest.mark.parametrize("task", TASKS, ids=["roller", "rocker"])
def test_the_plans_together_list_everything_once(task: str) -> None:
    whole = solve(task)

    assert sum(len(names(task, plan)) for plan in PLANS) == len(whole) + len(PRESSURES)
    assert {*whole.to_json()["quantities"]} == {*whole}
    assert names(task, "sizes", "profile") == names(task, "sizes") | names(task, "profile")
    assert {section_of(name) for name in whole} <= {section for sections in OF_PLAN.values() for section in sections}


@pytest.mark.parametrize("lang", ["uk", "ru", "en"])
@pytest.mark.parametrize(("task", "heads"), [(TASKS[0], 5), (TASKS[1], 4)], ids=["roller", "rocker"])
def test_the_list_has_headings(task: str, heads: int, lang: str) -> None:
    parts = solve(task).table(lang).split("\n\n")

    assert len(parts) == heads
    assert all("  " not in part.splitlines()[0] and len(part.splitlines()) > 1 for part in parts)


def test_what_is_left_out_of_a_list_is_still_solved() -> None:
    assert solve("madi-cam", only="pressure")["r_0"].value == pytest.approx(0.04525818, rel=1e-6)


def test_the_list_has_the_chosen_scale_factors_beside_their_segments() -> None:
    found = solve("madi-cam", scales={"mu_s_ds": 0.0004}, lang="en")
    rows = {row[0]: row[1:] for row in map(str.split, found.table().splitlines()) if row}

    assert rows["mu_s_ds"] == ["0.0004", "m/mm"]
    assert (rows["mu_l"], rows["mu_s_d2s"][1]) == (["0.001", "m/mm"], "m/mm")
    assert float(rows["r_0"][2]) == pytest.approx(float(rows["r_0"][0]) / 0.4, abs=0.01)
    assert not {"mu_s_ds", "mu_l"} & {*found.to_json()["quantities"]}  # there they stand under `scales`
