"""Other routes where lines meet flatly, or vectors are short: the same numbers, and hands that miss less by them."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from kulman import sheet, solve
from kulman.plans.board import Program, Step
from kulman.plans.boards.exact import SMALL, run
from kulman.plans.hands.shaky import Paper, preset
from kulman.plans.hands.spread import _sensitivities
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.solved import TWICE, SolvedLinkage, _sines_of, _with_moment_centres, solve_linkage
from kulman.plans.quantities import references
from kulman.tests.support.dyads import random_dyads
from kulman.tests.support.linkage_cases import Linkage
from kulman.tests.support.linkage_points import linkage_faults
from kulman.tests.support.mechanisms import one_of
from kulman.variants.shelf import bundled_text

CAREFUL = preset("careful").hand
FLAT = {"l_OA": "100 mm", "l_OC": "170 mm", "l_AS2": "150 mm", "l_CS3": "155 mm"}  # A and C close together beside B
LONGER_CB = {**FLAT, "l_AB": "300 mm", "l_CB": "310 mm", "phi": "20 deg"}
LONGER_AB = {**FLAT, "l_AB": "310 mm", "l_CB": "300 mm", "phi": "-10 deg"}


def flat(data: dict[str, str]) -> SolvedLinkage:
    return solve("scheme-03-crank-rocker", set=data).solved


@pytest.mark.parametrize(("data", "centre"), [(LONGER_CB, "C"), (LONGER_AB, "A")])
def test_centre_is_the_joint_opposite_to_the_better_angle_and_gives_the_same_forces(
    data: dict[str, str], centre: str
) -> None:
    solved = flat(data)
    usual = run(construct(replace(solved.mechanism, centres=()))[1], solved.givens).values

    at_a, at_b, at_c = _sines_of(*(solved.point(joint) for joint in "ABC"))

    assert at_b < SMALL
    assert max(at_a, at_c) == (at_a if centre == "C" else at_c) > TWICE * at_b
    assert solved.mechanism.centres == (("23", centre),)
    assert solved.sines["forces_23.5"] > TWICE * at_b
    for name in ("R_12_t", "R_12_n", "R_12", "R_03_n", "R_03_t", "R_03", "R_32", "M_bal"):
        assert abs(solved.values[name] - usual[name]) <= 1e-13 * abs(solved.values["R_12"]), name
    part = solved.values["R_12_m" if centre == "C" else "R_03_m"] / (solved.point("A") - solved.point("C"))
    assert abs(part.real) <= 1e-15 * abs(part)


def test_usual_plan_stays_where_lines_meet_well_or_nothing_is_better() -> None:
    assert solve("scheme-03-crank-rocker").solved.mechanism.centres == ()
    long = flat({"l_OA": "95 mm", "l_OC": "490 mm", "phi": "181 deg", "l_AB": "300 mm", "l_CB": "290 mm"})
    short = flat(LONGER_CB)
    without_sides = {**short.values, "A": short.values["C"]}

    assert _sines_of(*(long.point(joint) for joint in "ABC"))[1] < SMALL
    assert long.mechanism.centres == ()
    assert _with_moment_centres(replace(short.mechanism, centres=()), short.structure, without_sides).centres == ()
    assert all(math.isnan(sine) for sine in _sines_of(1j, 0j, 1j))


def test_sheet_tells_the_moments_and_both_ways_to_the_reaction() -> None:
    text = sheet("scheme-03-crank-rocker", set=LONGER_CB, lang="en", only="forces").svg()

    assert all(part in text for part in ("(2, 3) = 0:", 'data-quantity="R_12_m"', 'data-name="h_2_C"'))


@pytest.mark.soak
@pytest.mark.parametrize("variant", [pytest.param("a", id="C"), pytest.param("b", id="A")])
def test_sheet_of_a_folded_dyad_has_no_fault(variant: str, tmp_path: Path) -> None:
    rows = "".join(
        f'  {{ id = "{name}", phi = {phi}, l_OA = 100, l_AB = {ab}, l_CB = {cb}, l_OC = 170, l_AS2 = 150, l_CS3 = 155, '
        "n_1 = 200, q = 19, M_3 = 240 },\n"
        for name, phi, ab, cb in (("a", 20, 300, 310), ("b", -10, 310, 300))
    )
    text = bundled_text("scheme-03-crank-rocker").replace("variant = [\n", f"variant = [\n{rows}")
    task = tmp_path / "folded.toml"
    task.write_text(text, encoding="utf-8")
    case = Linkage(str(task), variant, format="A1")

    assert case.solution.solved.mechanism.centres != ()
    assert linkage_faults(case) == []


def own_error(program: Program, solved: SolvedLinkage) -> float:
    """Return what reactions miss by errors of the force plan alone, in parts of the largest."""
    values = run(program, solved.givens).values
    names = [f"R_{number}" for number in ("24", "35", "45")]
    largest = max(abs(values[name]) for name in names)
    mus = dict.fromkeys(program.plans, 1.0) | {"position": 0.01, "forces_45": largest / 100.0}
    found = _sensitivities(Paper(program, solved.givens, mus), CAREFUL, names)
    own = [step.startswith(("forces_45", "_M_", "R_")) or step.endswith(("PQ", "QP")) for step in found.steps]
    return max(float(np.linalg.norm(found.misses[name][own])) / largest for name in names)


@pytest.mark.parametrize("count", [20, pytest.param(300, marks=pytest.mark.soak)])
def test_reactions_by_another_centre_miss_less(count: int) -> None:
    mechanism, values, _ = random_dyads("RRR", (2, 3), (), seed=3, count=count)
    gains = []
    for index in range(count):
        solved = solve_linkage(mechanism, one_of(values, index))
        centres = tuple(centre for centre in solved.mechanism.centres if centre[0] == "45")
        if centres:
            routes = (replace(solved.mechanism, centres=chosen) for chosen in ((), centres))
            first, second = (own_error(construct(route)[1], solved) for route in routes)
            gains.append(first / second)

    assert len(gains) > count / 20
    assert min(gains) > 1.0
    assert np.median(gains) > 2.0


def by_velocity(program: Program, load: str) -> Program:
    """Return the program with a load against the velocity as it is read, not along a known line."""
    steps: list[Step] = []
    for step in program:
        if step.name == load:
            size, v, _, speed = step.operands
            length = f"_V_of_{load}"
            steps.append(Step("distance", length, ("velocity.p", f"velocity.{v.removeprefix('V_')}")))
            step = Step("calc", load, (size, v, length, speed), "resisting_force")
        steps.append(step)
    return Program(tuple(steps))


@pytest.mark.parametrize(
    ("task", "degrees", "times"),
    [
        ("scheme-14-jaw-crusher", 270.0, 100.0),
        ("scheme-15-lever-shears", 0.0, 5.0),
        ("scheme-17-sewing-machine", 75, 2),
    ],
)
def test_resistance_along_a_known_line_misses_less_beside_a_dead_position(
    task: str, degrees: float, times: float
) -> None:
    load = "F_3" if "sewing" in task else "F_5"
    solved = solve(task, set={"phi": f"{degrees} deg"}).solved
    sizes = references(solved.program, solved.values)
    mus = dict.fromkeys(solved.program.plans, 0.01)
    shown = {plan: sizes[name] / 100.0 for name, plan in solved.shown_on.items() if name in sizes}

    new, old = (
        float(
            np.linalg.norm(
                _sensitivities(Paper(program, solved.givens, {**mus, **shown}), CAREFUL, [load]).misses[load]
            )
        )
        for program in (solved.program, by_velocity(solved.program, load))
    )

    assert old > times * new
