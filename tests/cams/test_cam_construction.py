"""The construction of a cam on the board: chords, scale factors, tangents, inversion, against the exact motion."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from kulman import load_task
from kulman.plans.boards.exact import run
from kulman.plans.cams.cam import LAWS, PLANS, Cam
from kulman.plans.cams.construction import construct, ray
from kulman.plans.cams.motion import motion_of
from kulman.plans.cams.solve import EQUAL, diagram_givens, solve_cam
from kulman.plans.hands.shaky import draw, paper_of, preset
from kulman.scales.errors import InputError

DEGREE = math.radians(1.0)
MADI = {**load_task("madi-cam").values("17"), "mu_phi": DEGREE}
FOLLOWERS = ("roller", "plate")
LAWS_OF_CHORDS = [
    law if law in ("sawtooth", "modified-sine") else pytest.param(law, marks=pytest.mark.soak)
    for law in LAWS
    if law != "uniform"
]


def test_the_scale_factors_of_the_project_follow_from_its_amplitude() -> None:
    # by hand: V = A u x / (2 H), S = A x^2 u (u + (1 - u)) / (6 H^2) * ... of a sawtooth, all in mm of paper
    v_max = 110 * 36 / 2 / 30
    s_max = (110 * 36**2 / 6 + (110 * 36 / 2) * 72 / 3) / 30**2
    mu_s = 0.013 / s_max
    mu_ds = mu_s / (DEGREE * 30)
    mu_d2s = mu_ds / (DEGREE * 30)
    by_hand = {"mu_s": mu_s, "mu_ds": mu_ds, "mu_d2s": mu_d2s, "mu_v": 200 * mu_ds, "mu_a": 200**2 * mu_d2s}
    by_hand |= {"ds_max": v_max * mu_ds, "nu": math.atan(mu_s / mu_ds), "l_A2": 0.055}

    found = solve_cam(Cam(FOLLOWERS, "sawtooth"), MADI).quantities

    assert {name: found[name].value for name in by_hand} == pytest.approx(by_hand, rel=1e-13)


def random_cams(count: int) -> list[tuple[Cam, dict[str, float]]]:
    """Return cams with random laws, phases, amplitudes, pole distances, both senses and orders of the fall."""
    random = np.random.default_rng(20261122)
    cams = []
    for _ in range(count):
        law, law_fall = random.choice(LAWS, 2)
        rise, fall = random.uniform(40, 150, 2)
        upper = random.choice([0.0, random.uniform(1, 60)])
        numbers = {"phi_rise": rise * DEGREE, "phi_upper": upper * DEGREE, "phi_fall": fall * DEGREE}
        numbers |= {"h": random.uniform(0.004, 0.06), "u": random.uniform(0.25, 0.75)}
        numbers |= {"l_A1": random.uniform(0.04, 0.2), "H_a": random.uniform(0.02, 0.06)}
        numbers |= {"H_v": random.uniform(0.02, 0.06), "gamma_rise": random.uniform(50, 80) * DEGREE}
        numbers |= {"gamma_fall": random.uniform(45, 80) * DEGREE}
        words = (str(random.choice(two)) for two in (("mirror", "same"), ("ccw", "cw"), ("one-sided", "two-sided")))
        cams.append((Cam(FOLLOWERS, str(law), str(law_fall), *words), MADI | numbers))
    return cams


MANY = pytest.mark.parametrize("count", [pytest.param(5, id="5"), pytest.param(100, id="100", marks=pytest.mark.soak)])


@MANY
def test_scale_factors_show_what_the_motion_has(count: int) -> None:
    for cam, values in random_cams(count):
        solved = solve_cam(cam, values, ("diagrams",))
        motion, found = solved.motion, solved.quantities

        assert found["s_max"].value == pytest.approx(values["h"], rel=1e-12)
        assert found["ds_max"].value == pytest.approx(motion.ds_max.value, rel=1e-12)
        if "A_1" in found:
            rise = motion.maximum(0.0, 0.0, 1.0, ("rise",)).value
            slowing = motion.maximum(0.0, 0.0, -1.0, ("rise",)).value
            assert found["A_1"].value == pytest.approx(rise, rel=1e-12)
            assert found["A_2"].value == pytest.approx(slowing, rel=1e-10)
            assert found["a_max"].value == pytest.approx(values["omega"] ** 2 * motion.d2s_max.value, rel=1e-12)


@pytest.mark.parametrize("law", LAWS_OF_CHORDS)
def test_chords_run_parallel_to_their_rays(law: str) -> None:
    solved = solve_cam(Cam(FOLLOWERS, law), MADI)
    for plan, onto in (("diagram_a", "diagram_v"), ("diagram_v", "diagram_s")):
        for i in solved.layout.division.sections:
            chord = solved.point(f"{onto}.{i}") - solved.point(f"{onto}.{i - 1}")
            direction = solved.point(ray(plan, i))
            assert abs((direction.conjugate() * chord).imag) < 1e-12 * abs(chord)
            foot = solved.point(f"{onto}.f{i}")
            assert solved.point(f"{onto}.{i}").real == pytest.approx(foot.real, abs=1e-15)
            assert foot.real == pytest.approx(solved.angles[i] / DEGREE * 1e-3, rel=1e-13)


def errors(cam: Cam, sections: int, shift: float = 0.0) -> tuple[float, float]:
    """Return by which parts chords miss velocity and stroke; `shift` moves all inner section lines by a part."""
    motion = motion_of(cam, MADI)
    solved = solve_cam(Cam(cam.followers, cam.law, fall=cam.fall, sections=sections), MADI, ("diagrams",))
    division = replace(solved.layout.division, angles=solved.angles.copy())
    angles = division.angles
    inside = [i for i in division.lines if i not in (0, division.top, division.leave, division.last)]
    angles[inside] += shift * (angles[1] - angles[0])
    givens = solved.givens | diagram_givens(motion, division, "diagram_a")
    board = run(construct(solved.layout, ("diagrams",)), givens)
    drawn = (board.values["V_max_chord"] / board.values["_V_max"], board.values["S_max_chord"] / board.values["_S_max"])
    return abs(drawn[0] - 1.0), abs(drawn[1] - 1.0)


@pytest.mark.parametrize("law", LAWS_OF_CHORDS)
def test_chords_are_of_second_order_when_jumps_lie_on_nodes(law: str) -> None:
    few, many = (errors(Cam(FOLLOWERS, law), sections) for sections in (24, 96))

    for coarse, fine in zip(few, many, strict=True):
        assert fine < 2e-3
        assert fine < 1e-12 or math.log(coarse / fine, 4.0) > 1.8


@pytest.mark.parametrize("law", ["sawtooth", pytest.param("constant", marks=pytest.mark.soak)])
def test_chords_are_of_first_order_when_jumps_lie_between_nodes(law: str) -> None:
    coarse, fine = (errors(Cam(FOLLOWERS, law), sections, 0.3)[1] for sections in (24, 192))

    assert 0.7 < math.log(coarse / fine, 8.0) < 1.4


@MANY
def test_sizes_by_tangents_come_to_those_of_the_exact_curves(count: int) -> None:
    for cam, values in random_cams(count):
        fine = Cam(cam.followers, cam.law, cam.law_fall, cam.fall, cam.rotation, cam.limits, sections=96)
        solved = solve_cam(fine, values, ("sizes",))
        exact = solved.roller.by_tangents
        found = solved.quantities

        assert found["r_0_tangents"].value == pytest.approx(exact.r_0, rel=8e-3)
        assert found["e_tangents"].value == pytest.approx(exact.e, abs=8e-3 * exact.r_0)
        assert found["r_0"].value <= exact.r_0 * (1 + 1e-12)
        if solved.plate is not None:
            size = max(found["r_0_flat_min"].value, found["A_1"].value)
            kinks = "trapezoid" in cam.law + cam.falls_by  # lie between section lines: the curve is cut there
            part = 0.04 if kinks else 8e-3
            assert found["r_0_flat_tangent"].value == pytest.approx(solved.plate.sizes.r_0_min, abs=part * size)


@MANY
def test_profiles_by_inversion_are_the_exact_ones(count: int) -> None:
    for cam, values in random_cams(count):
        solved = solve_cam(cam, values)
        profile, plate = solved.roller.profile, solved.plate
        exact = {"profile.B": profile.pitch(solved.angles, -1), "profile.K": profile.practical(solved.angles, -1)}
        if plate is not None:
            exact["plate_profile.K"] = plate.profile.practical(solved.angles, -1)
        for mark, places in exact.items():
            for i in solved.layout.division.lines:
                assert solved.point(f"{mark}{i}") == pytest.approx(complex(places[i]), abs=1e-12)


def test_a_cam_for_one_follower_draws_nothing_of_the_other_and_profiles_where_they_are_wanted() -> None:
    plans = set(solve_cam(Cam(("plate",), "sine"), MADI).program.plans)

    assert "plate_profile" in plans
    assert plans.isdisjoint({"sizes", "profile"})
    assert [plan for plan in PLANS if solve_cam(Cam(FOLLOWERS, "sine"), MADI, (plan,)).draws_profiles] == ["profile"]


def test_a_hand_draws_the_cam_as_well_as_its_pencil_lets_it() -> None:
    solved = solve_cam(Cam(FOLLOWERS, "sawtooth"), MADI)
    hand = preset("normal").hand
    chosen = {"mu_l": 1e-3, **{symbol: solved.values[mu] for symbol, mu in EQUAL.items()}}
    board = draw(paper_of(solved, {**solved.values, **chosen}), hand, np.random.default_rng(1), 400)

    for name in ("mu_s_chord", "r_0_tangents"):
        exact = solved.values[name]
        spread = np.std(board.values[name]) / abs(exact)
        assert 1e-4 < spread < 0.3, name
        assert abs(np.mean(board.values[name]) / exact - 1.0) < spread
    assert np.std(board.values["mu_s"]) == 0.0  # calculated from data


ROCKER = {name: value for name, value in MADI.items() if name != "h"} | {
    **{"psi": 25 * DEGREE, "l_rocker": 0.1, "gamma_rise": 50 * DEGREE, "gamma_fall": 45 * DEGREE}
}


@pytest.mark.parametrize(
    ("rotation", "distance"),
    [
        ("ccw", {"l_OC": 0.12}),
        ("cw", {}),
        *(pytest.param(*both, marks=pytest.mark.soak) for both in (("ccw", {}), ("cw", {"l_OC": 0.12}))),
    ],
)
def test_the_profile_under_a_rocker_is_the_exact_one(rotation: str, distance: dict[str, float]) -> None:
    solved = solve_cam(Cam(("rocker",), "modified-sine", rotation=rotation), ROCKER | distance)
    profile = solved.rocker.profile
    pitch, practical = profile.pitch(solved.angles, -1), profile.practical(solved.angles, -1)

    for i in solved.layout.division.lines:
        assert solved.point(f"profile.B{i}") == pytest.approx(complex(pitch[i]), abs=1e-12)
        assert solved.point(f"profile.K{i}") == pytest.approx(complex(practical[i]), abs=1e-12)
    assert solved.quantities["l_OC"].value == pytest.approx(distance.get("l_OC", solved.rocker.sizes.l_OC), rel=1e-12)
    assert solved.quantities["r_0"].value == pytest.approx(abs(complex(pitch[0])), rel=1e-12)


def test_limits_of_a_rocker_do_not_cut_off_the_centre_and_one_runs_through_it() -> None:
    solved = solve_cam(Cam(("rocker",), "sine", sections=48), ROCKER)
    centre, lines = solved.point("rocker_sizes.C"), solved.layout.division.lines

    away = [
        (solved.point(f"_limit{i}").conjugate() * (centre - solved.point(f"rocker_sizes.D{i}"))).imag for i in lines
    ]

    assert -2e-4 < max(away) < 1e-12  # all on one side, below


def test_sizes_that_are_given_are_kept() -> None:
    at_r_0, at_e, at_both = (
        solve_cam(Cam(("roller",), "sine"), MADI | given).quantities
        for given in ({"r_0": 0.05}, {"e": 0.0}, {"r_0": 0.05, "e": 0.012})
    )

    assert at_r_0["r_0"].value == pytest.approx(0.05, rel=1e-14)
    assert at_r_0["e_least"].value < at_r_0["e"].value < at_r_0["e_most"].value
    assert at_r_0["gamma_rise_min"].value >= MADI["gamma_rise"]
    assert (at_e["e"].value, "e_least" in at_e) == (0.0, False)
    assert at_e["gamma_rise_min"].value == pytest.approx(MADI["gamma_rise"], rel=1e-12)
    assert (at_both["e"].value, at_both["r_0"].value) == pytest.approx((0.012, 0.05))


def test_no_offset_and_no_place_are_explained() -> None:
    with pytest.raises(InputError, match=r"r_0 = 20 mm .* at least 2[0-9.]+ mm"):
        solve_cam(Cam(("roller",), "sine"), MADI | {"r_0": 0.02})
    with pytest.raises(InputError, match="no place of the cam's centre keeps gamma"):
        solve_cam(Cam(("rocker",), "sine"), ROCKER | {"psi": 80 * DEGREE, "gamma_rise": 85 * DEGREE})
