"""The cycle where it is peculiar: slotted links, parallel guides, triads, all tasks; diagrams by chords, sliders."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpc, mpf

from kulman import solve
from kulman.plans.linkages.cycle import (
    _differentiate,
    chords,
    cycle,
    diagrams,
    pole_distance,
    slider_runs,
    velocities,
    velocity_field,
)
from kulman.plans.linkages.mechanism import ZERO, Driver, Mechanism, Prismatic, Stroke
from kulman.plans.linkages.solved import solve_linkage
from kulman.scales.errors import InputError
from kulman.tests.support.cases import some
from kulman.tests.support.linkages import (
    BENT,
    CRANK,
    PRESS_VALUES,
    RAM,
    RAM_VALUES,
    four_bar,
    four_bar_values,
    piston_engine,
    reach,
    slider_crank,
    slider_crank_values,
)
from kulman.tests.support.mechanisms import ORIGIN, bodies, pins
from kulman.variants.reader import load_task
from kulman.variants.shelf import bundled

MOTION = ("acceleration",)
RATES = {"phi": 0.3, "speed": 2.0, "sense": 1.0}


def slotted(stroke: Stroke | None = None) -> Mechanism:
    """Crank OA, a stone at A in the slot of a lever that turns about C."""
    slot = Prismatic("A", (2, 3), ORIGIN, ZERO)
    return Mechanism(bodies("O A:l_OA", "A", "C D:l_CD"), (*pins("O01 A12 C03@x_C"), slot), CRANK, stroke=stroke)


def test_a_lever_swings_between_the_tangents_to_the_circle_of_the_crank() -> None:
    done = cycle(slotted(Stroke(3)), {**RATES, "l_OA": 1.0, "l_CD": 2.0, "x_C": 2.0}, ("velocity",))

    swing = done.motions[0]
    assert sorted(spot.angle for spot in swing.dead) == pytest.approx([math.pi / 3, 5 * math.pi / 3], abs=1e-12)
    assert swing.travel is not None
    assert swing.travel.length == pytest.approx(math.pi / 3, abs=1e-12)
    # the lever points to the crank pin: it turns counter-clockwise while the crank turns from 60 to 300 degrees
    assert swing.ratio == pytest.approx(2.0, abs=1e-12)
    assert done.zero == pytest.approx(math.pi / 3, abs=1e-12)


def test_a_stone_that_comes_to_the_pivot_of_its_lever_is_a_change_point() -> None:
    done = cycle(slotted(), {**RATES, "l_OA": 1.0, "l_CD": 2.0, "x_C": 1.0}, ("velocity",), 4, start=0.0)

    (change,) = done.reach.changes
    assert done.statuses == ("singular", "ok", "ok", "ok")
    assert min(change, 2 * math.pi - change) < 1e-7
    assert np.isnan(done.values["V_D"]).tolist() == [True, False, False, False]


def test_parallel_guides_of_a_slotted_crank_are_poles() -> None:
    guides = (Prismatic("B", (2, 1), ORIGIN, ZERO), Prismatic("B", (3, 0), ("h", ZERO), "up"))
    mechanism = Mechanism(bodies("O A:l_OA", "B", "B"), (*pins("O01 B23"), *guides), CRANK)

    done = cycle(mechanism, {**RATES, "l_OA": 1.0, "h": 0.5, "up": math.pi / 2}, ("velocity",), 8, start=0.0)

    assert done.reach.poles == pytest.approx([math.pi / 2, 3 * math.pi / 2], abs=1e-12)
    assert [k for k, status in enumerate(done.statuses) if status == "singular"] == [2, 6]
    assert done.motions[0].dead == ()  # the velocity passes infinity, not zero
    assert done.values["B"][1] == pytest.approx(0.5 + 0.5j)
    assert done.extremes(["V_B"])["V_B"][0].value == math.inf


def triad_values(crank: float) -> dict[str, float]:
    """Return values of a triad that stands so when the crank is at 0.3 rad."""
    A, B, E, F = crank * complex(math.cos(0.3), math.sin(0.3)), 1.0 + 0.9j, 2.1 + 0.2j, 0.3 + 2.2j
    C, D = B + 0.5 + 0.1j, B + 0.2 + 0.6j
    lengths = {"l_OA": crank, "l_AB": abs(B - A), "l_EC": abs(C - E), "l_FD": abs(D - F)}
    figure = {"x_C": 0.5, "y_C": 0.1, "x_D": 0.2, "y_D": 0.6, "x_E": 2.1, "y_E": 0.2, "x_F": 0.3, "y_F": 2.2}
    start = {"x_0": 1.0, "y_0": 0.9, "angle_0": 0.0, "phi_0": 0.3, "phi": 0.3, "n_1": 2.0}
    return {**PRESS_VALUES, **lengths, **figure, **start}


def test_a_triad_is_followed_all_round() -> None:
    values = triad_values(0.1)

    done = cycle(BENT, values, MOTION, positions=48)

    assert set(done.statuses) == {"ok"}
    assert done.reach.free
    for start, end, length in (("A", "B", "l_AB"), ("E", "C", "l_EC"), ("F", "D", "l_FD")):
        assert np.allclose(np.abs(done.values[end] - done.values[start]), values[length], rtol=1e-12, atol=0.0)
    steps = np.abs(np.diff(np.append(done.values["D"], done.values["D"][0])))
    assert steps.max() < 3.0 * np.median(steps)  # no jump anywhere, and it closes
    h = 1e-5
    slope = (done.at(done.angles + h, ["D"])["D"] - done.at(done.angles - h, ["D"])["D"]) / (2.0 * h) * values["n_1"]
    assert np.allclose(slope, done.values["V_D"], atol=1e-8)
    assert [len(motion.dead) for motion in done.motions] == [2] * len(done.motions)


def test_a_triad_has_limiting_positions_where_its_legs_meet_in_a_point() -> None:
    values = triad_values(0.6)

    (arc,) = reach(BENT, values).apart

    determinants = []
    for angle in (arc.low - 1e-6, arc.low - 4e-6, arc.high + 1e-6, arc.high + 4e-6):
        solved = solve_linkage(BENT, {**values, "phi": angle}, ("position",))
        lines = [(solved.point(a), solved.point(b) - solved.point(a)) for a, b in ("AB", "EC", "FD")]
        rows = [(u.real, u.imag, (at.conjugate() * u).imag) for at, u in lines]
        determinants.append(np.linalg.det(np.array(rows)))
    # it is zero when the lines meet in one point, and goes with the root of the way to the limit
    assert determinants[1] / determinants[0] == pytest.approx(2.0, rel=1e-3)
    assert determinants[3] / determinants[2] == pytest.approx(2.0, rel=1e-3)
    assert solve_linkage(BENT, {**values, "phi": arc.low + 1e-6}, ("position",)).status == "no-assembly"


@pytest.mark.parametrize("step", [9, pytest.param(1, marks=pytest.mark.soak)])
@pytest.mark.parametrize("name", some(bundled("mechanism"), *range(0, 99, 3)))
def test_tasks_move_over_the_whole_cycle_with_links_of_constant_length(name: str, step: int) -> None:
    task = load_task(name)
    for variant in [*task.variants][::step]:
        done = cycle(task.mechanism, task.values(variant), ("position",), positions=72)

        # a sliding driver begins and ends at the limits of its reach
        inner = done.statuses if done.drive.turns else done.statuses[1:-1]
        assert set(inner) <= {"ok", "ill-conditioned"}, variant
        assert not done.reach.apart, variant
        for link in done.mechanism.links:
            for first, second in zip(link.points, list(link.points)[1:], strict=False):
                found = np.abs(done.values[second] - done.values[first])
                assert np.ptp(found) <= 1e-12 * max(found.max(), 1e-3), (variant, first, second)


def test_a_driver_with_a_literal_angle_turns_alone() -> None:
    # 30 degrees of the driver and of a guide may be one constant of the task
    guide, driver = (
        Prismatic("B", (3, 0), ORIGIN, "_constant_1"),
        Driver(1, "O", "A", "_constant_1", "speed", "sense"),
    )
    mechanism = Mechanism(bodies("O A:l_OA", "A B:l_AB", "B"), (*pins("O01 A12 B23"), guide), driver)

    done = cycle(mechanism, {"l_OA": 1.0, "l_AB": 3.0, "_constant_1": math.pi / 6, "speed": 1.0, "sense": 1.0})

    assert np.allclose(np.angle(done.values["B"]), math.pi / 6)
    assert [spot.angle for spot in done.motions[0].dead] == pytest.approx([math.pi / 6, 7 * math.pi / 6])


# Against 34 digits: crank OA, coupler AB, rocker CB; with a link BD whose end D moves along a level guide.
BARS = ("O A:l_OA", "A B:l_AB", "C B:l_CB")
JOINTS = "O01 A12 B23:side C03@x_C,y_C"
LEVEL = Prismatic("D", (5, 0), (ZERO, "y_D"), ZERO, branch="near")
IN_LINE = Mechanism(bodies(*BARS), pins(JOINTS), CRANK)
JUST_REACHING = Mechanism(bodies(*BARS, "B D:l_BD", "D"), (*pins(f"{JOINTS} B34 D45"), LEVEL), CRANK)


def random_four_bar(random: np.random.Generator) -> dict[str, float]:
    """Return a crank-rocker whose frame stands in any direction."""
    while True:
        a, b, c, d = sorted(random.uniform(0.1, 1.0, 4))
        if a + d < b + c:
            break
    b, c, d = random.permutation([b, c, d])
    turned = d * np.exp(1j * random.uniform(0.0, 2.0 * math.pi))
    lengths = {"l_OA": a, "l_AB": b, "l_CB": c, "x_C": turned.real, "y_C": turned.imag}
    signs = {"side": float(random.choice((-1, 1))), "near": 1.0}
    return {**RATES, **{name: float(x) for name, x in lengths.items()}, **signs}


def off(found: tuple[float, ...], place: mpf) -> float:
    """Return how far the nearest of some places, rad, is from a place that is known to 34 digits."""
    return min(float(abs((mpf(x) - place + mp.pi) % (2 * mp.pi) - mp.pi)) for x in found)


@pytest.mark.parametrize("count", [pytest.param(10, id="10"), pytest.param(150, id="150", marks=pytest.mark.soak)])
def test_change_points_are_where_34_digits_have_them(count: int) -> None:
    random, seen = np.random.default_rng(20261122), 0
    with mp.workdps(34):
        while seen < count:
            values = random_four_bar(random)
            frame = mp.hypot(values["x_C"], values["y_C"])
            values["l_CB"] = float(frame + mpf(values["l_OA"]) - mpf(values["l_AB"]))  # all in line, A beyond O
            if abs(values["l_CB"] - values["l_AB"]) > frame - values["l_OA"] or values["l_CB"] < 0.05:
                continue  # no crank that turns
            found = reach(IN_LINE, values)
            if not found.changes:  # rounding of a length has made a gap of the touch
                assert sum(arc.high - arc.low for arc in found.apart) < 1e-6
                continue
            seen += 1
            direction = mp.atan2(values["y_C"], values["x_C"])
            assert off(found.changes, direction + mp.pi) < 1e-12
            assert all(min(off((x,), direction), off((x,), direction + mp.pi)) < 1e-12 for x in found.changes)


@pytest.mark.parametrize("count", [pytest.param(4, id="4"), pytest.param(60, id="60", marks=pytest.mark.soak)])
def test_a_link_that_just_reaches_its_guide_does_so_where_34_digits_have_it(count: int) -> None:
    random, seen = np.random.default_rng(20261123), 0
    with mp.workdps(34):
        while seen < count:
            values = random_four_bar(random)
            height = height_of(values)
            assert reach(JUST_REACHING, {**values, "l_BD": 6.0, "y_D": -2.0}).free
            best = max(np.arange(0.0, 6.28, 0.02).tolist(), key=lambda phi: float(height(mpf(phi))))
            slope = mp.diff
            ends = (best - 0.02, best + 0.02)
            top = mp.findroot(lambda phi: slope(height, phi), ends, solver="anderson", tol=1e-25)  # noqa: B023
            if abs(mp.diff(height, top, 2)) < 0.1:  # too flat for sixteen digits
                continue
            seen += 1

            found = reach(JUST_REACHING, {**values, "y_D": -2.0, "l_BD": float(height(top) + 2)})

            assert off(found.changes, top) < 1e-12
            for x in map(mpf, found.changes):  # an upright rocker passes its top twice
                assert abs(mp.diff(height, x) / mp.diff(height, x, 2)) < 1e-12


def height_of(values: dict[str, float]) -> Any:
    """Return the height of the rocker's pin B over the angle of the crank."""
    a, b, c, side = (mpf(values[name]) for name in ("l_OA", "l_AB", "l_CB", "side"))
    pivot = mpc(values["x_C"], values["y_C"])

    def height(phi: mpf) -> mpf:
        tip = a * mp.expj(phi)
        across = pivot - tip
        along = (abs(across) ** 2 + b * b - c * c) / (2 * abs(across))
        return (tip + across / abs(across) * mpc(along, side * mp.sqrt(b * b - along * along))).imag

    return height


# Diagrams by chords: order two in the number of sections, scale factors of paper, beside the plans.
PISTON = slider_crank_values(1.0, 3.0, 0.5)
DRIVEN = {"l_AB": 3.0, "l_OA": 1.0, "travel": 2.5, "speed": 0.5, "gamma": 0.3, "side": 1.0}


@pytest.mark.parametrize(
    ("mechanism", "values", "of", "unit"),
    [
        pytest.param(slider_crank(), PISTON, "B", "m", id="slider"),
        pytest.param(slider_crank(), {**PISTON, "sense": -1.0}, "3", "m", id="slider by its number"),
        pytest.param(slider_crank(), PISTON, "E", "m", id="point of the rod"),
        pytest.param(slider_crank(), PISTON, "2", "rad", id="rod"),
        pytest.param(four_bar(), four_bar_values(1.0, 3.0, 2.5, 2.0, sense=-1.0), "3", "rad", id="rocker"),
        pytest.param(four_bar(), four_bar_values(2.0, 2.5, 3.0, 1.0), "3", "rad", id="drag link, round and round"),
    ],
)
def test_chords_come_nearer_to_the_plans_with_the_square_of_the_sections(
    mechanism: Mechanism, values: dict[str, float], of: str, unit: str
) -> None:
    done = cycle(mechanism, values, MOTION)

    drawn = [diagrams(done, of, sections) for sections in (48, 96, 192)]

    assert {d.unit for d in drawn} == {unit}
    for curve in ("velocity", "acceleration"):
        errors = [np.abs(getattr(d, curve).difference).max() for d in drawn]
        assert [math.log2(errors[k] / errors[k + 1]) for k in (0, 1)] == pytest.approx([2.0, 2.0], abs=0.15)
        assert getattr(drawn[-1], curve).per_cent.max() < 0.5


@pytest.mark.parametrize("sections", [8, 24])
def test_velocities_stand_at_the_middles_of_sections_accelerations_at_their_ends(sections: int) -> None:
    drawn = diagrams(cycle(slider_crank(), PISTON, MOTION), "B", sections)

    step = math.pi / sections  # a full turn at 2 rad/s takes pi seconds
    assert len(drawn.times) == len(drawn.s) == len(drawn.v) == len(drawn.a) == sections + 1
    assert np.allclose(drawn.times, np.arange(sections + 1) * step)
    assert np.allclose(drawn.velocity.times, (np.arange(sections) + 0.5) * step)
    assert np.allclose(drawn.acceleration.times, np.arange(sections) * step)
    assert np.allclose(drawn.acceleration.plans, drawn.a[:-1])
    driven = diagrams(cycle(piston_engine(), DRIVEN, MOTION, start=2.3, end=3.7), "3", 48)  # open ones
    assert len(driven.acceleration.chords) == 47
    assert driven.velocity.per_cent.max() < 0.5
    assert driven.times[-1] == pytest.approx(1.4 / 0.5)


def test_chords_on_paper_give_the_same_values_and_of_a_parabola_are_exact() -> None:
    times, t = np.linspace(0.0, 0.08, 13), np.linspace(0.0, 1.2, 13)
    s = 0.1 * np.sin(40.0 * times)
    mu_s, mu_t, mu_v = 0.001, 0.08 / 180.0, 0.075  # m/mm, s/mm, (m/s)/mm

    pole = pole_distance(mu_s, mu_t, mu_v)
    v, a = _differentiate(3.0 * t * t, 0.1, closed=False)

    cut = np.diff(s / mu_s) * (pole / (180.0 / 12))  # by rays from the pole, parallel to the chords
    assert pole == pytest.approx(30.0)
    assert np.allclose(cut * mu_v, chords(s, times[1]), rtol=1e-13)
    assert np.allclose(v, 6.0 * 0.5 * (t[:-1] + t[1:]))
    assert np.allclose(a, 6.0)
    assert len(a) == 11


def test_what_does_not_move_and_what_has_no_accelerations_has_no_diagrams() -> None:
    for of in "Q9":
        with pytest.raises(InputError) as caught:
            diagrams(cycle(slider_crank(), PISTON, MOTION), of)
        assert caught.value.key == "motion-unknown"
    with pytest.raises(InputError, match="accelerations"):
        diagrams(cycle(slider_crank(), PISTON, ("velocity",)), "B")


def test_the_field_of_velocities_is_that_of_a_rigid_link() -> None:
    solved = solve_linkage(four_bar(), four_bar_values(1.0, 3.0, 2.5, 2.0), ("velocity",))
    sliding = solve_linkage(slider_crank(), PISTON, ("velocity",))

    for link, points in ((1, "OA"), (2, "ABE"), (3, "CB")):
        places, field = velocity_field(solved, link)
        for point in points:
            at = solved.point(point)
            v = 0j if point in "OC" else solved.point(f"velocity.{point}")
            assert np.allclose(field - v, 1j * solved.values[f"omega_{link}"] * (places - at), atol=1e-12)
            assert places.real.min() < at.real < places.real.max()
            assert places.imag.min() < at.imag < places.imag.max()
        assert places.shape == field.shape == (7, 9)
    assert np.all(velocity_field(sliding, 3)[1] == sliding.point("velocity.B"))
    assert velocities(np.array([0j, 1.0, 1j]), 0j, 1.0 + 0j, 2.0).tolist() == [1 + 0j, 1 + 2j, -1 + 0j]


# Guides are drawn as long as their sliders run: on the frame that is the stroke, found by zeros of the velocity.
@pytest.mark.parametrize("task", ["nau-slider-crank", "scheme-09-shaper", "scheme-20-press-automaton"])
def test_sliders_on_the_frame_run_as_far_as_their_strokes(task: str) -> None:
    solved = solve(task).solved

    runs = slider_runs(solved)

    motions = cycle(solved.mechanism, solved.givens, ("velocity",)).motions
    strokes = {f"u_{m.output.link}0": m.travel.length for m in motions if m.output.slides and m.travel is not None}
    assert strokes
    for guide, length in strokes.items():
        low, high = runs[guide]
        assert high - low == pytest.approx(length, rel=2e-3)  # the ends lie between the 72 positions


def test_the_ram_of_a_group_of_class_iii_runs_on_its_own_branch() -> None:
    runs = [slider_runs(solve_linkage(RAM, {**RAM_VALUES, "phi": phi})) for phi in (0.2, 0.7)]

    (first,), (second,) = (run.values() for run in runs)
    assert first[1] - first[0] == pytest.approx(second[1] - second[0], rel=5e-3)
