"""The cycle where it is peculiar: slotted links through their pivots, parallel guides, triads, all bundled tasks."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import mp, mpc, mpf

from kulman.plans.linkages.cycles.cycle import cycle
from kulman.plans.linkages.mechanism import ZERO, Driver, Link, Mechanism, Prismatic, Revolute, Start, Stroke
from kulman.plans.linkages.solved import solve_linkage
from kulman.scales.errors import InputError
from kulman.tests.support.linkages import reach
from kulman.variants.reader import load_task
from kulman.variants.shelf import bundled

ORIGIN = (ZERO, ZERO)
CRANK = Driver(1, "O", "A", "phi", "speed", "sense")
RATES = {"phi": 0.3, "speed": 2.0, "sense": 1.0}


def slotted(stroke: Stroke | None = None) -> Mechanism:
    """Crank OA, a stone at A in the slot of a lever that turns about C."""
    return Mechanism(
        links=(
            Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}),
            Link(2, {"A": ORIGIN}),
            Link(3, {"C": ORIGIN, "D": ("l_CD", ZERO)}),
        ),
        pairs=(
            Revolute("O", (0, 1), ORIGIN),
            Revolute("A", (1, 2)),
            Prismatic("A", (2, 3), ORIGIN, ZERO),
            Revolute("C", (0, 3), ("x_C", ZERO)),
        ),
        driver=CRANK,
        stroke=stroke,
    )


def test_a_lever_swings_between_the_tangents_to_the_circle_of_the_crank() -> None:
    values = {**RATES, "l_OA": 1.0, "l_CD": 2.0, "x_C": 2.0}

    done = cycle(slotted(Stroke(3)), values, ("velocity",))

    swing = done.motions[0]
    angles = sorted(spot.angle for spot in swing.dead)
    assert angles == pytest.approx([math.pi / 3, 5 * math.pi / 3], abs=1e-12)
    assert swing.travel is not None
    assert swing.travel.length == pytest.approx(math.pi / 3, abs=1e-12)
    # the lever points to the crank pin: it turns counter-clockwise while the crank turns from 60 to 300 degrees
    assert swing.ratio == pytest.approx(2.0, abs=1e-12)
    assert done.zero == pytest.approx(math.pi / 3, abs=1e-12)


def test_a_stone_that_comes_to_the_pivot_of_its_lever_is_a_change_point() -> None:
    done = cycle(slotted(), {**RATES, "l_OA": 1.0, "l_CD": 2.0, "x_C": 1.0}, ("velocity",), 4, start=0.0)

    assert done.statuses == ("singular", "ok", "ok", "ok")
    assert len(done.reach.changes) == 1
    assert min(done.reach.changes[0], 2 * math.pi - done.reach.changes[0]) < 1e-7
    assert np.isnan(done.values["V_D"]).tolist() == [True, False, False, False]


def tangent_mechanism() -> Mechanism:
    """A slotted crank about O moves a stone along a straight guide at the distance h."""
    return Mechanism(
        links=(Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}), Link(2, {"B": ORIGIN}), Link(3, {"B": ORIGIN})),
        pairs=(
            Revolute("O", (0, 1), ORIGIN),
            Prismatic("B", (2, 1), ORIGIN, ZERO),
            Revolute("B", (2, 3)),
            Prismatic("B", (3, 0), ("h", ZERO), "up"),
        ),
        driver=CRANK,
    )


def test_parallel_guides_are_named() -> None:
    values = {**RATES, "l_OA": 1.0, "h": 0.5, "up": math.pi / 2}

    done = cycle(tangent_mechanism(), values, ("velocity",), 8, start=0.0)

    assert done.reach.poles == pytest.approx([math.pi / 2, 3 * math.pi / 2], abs=1e-12)
    assert [k for k, status in enumerate(done.statuses) if status == "singular"] == [2, 6]
    assert done.motions[0].dead == ()  # the velocity passes infinity, not zero
    assert done.values["B"][1] == pytest.approx(0.5 + 0.5j)
    assert done.extremes(["V_B"])["V_B"][0].value == math.inf


def triad() -> Mechanism:
    """A central link on three legs: one from the crank pin, two from pivots on the frame."""
    return Mechanism(
        links=(
            Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}),
            Link(2, {"A": ORIGIN, "B": ("l_AB", ZERO)}),
            Link(3, {"B": ORIGIN, "C": ("x_C", "y_C"), "D": ("x_D", "y_D")}),
            Link(4, {"E": ORIGIN, "C": ("l_EC", ZERO)}),
            Link(5, {"F": ORIGIN, "D": ("l_FD", ZERO)}),
        ),
        pairs=(
            Revolute("O", (0, 1), ORIGIN),
            Revolute("A", (1, 2)),
            Revolute("B", (2, 3)),
            Revolute("C", (3, 4)),
            Revolute("D", (3, 5)),
            Revolute("E", (0, 4), ("x_E", "y_E")),
            Revolute("F", (0, 5), ("x_F", "y_F")),
        ),
        driver=CRANK,
        starts=(Start(3, "x_B", "y_B", "turn", "phi"),),
    )


def triad_values(crank: float) -> dict[str, float]:
    """Return values of a triad that stands so when the crank is at 0.3 rad."""
    A, B, E, F = crank * complex(math.cos(0.3), math.sin(0.3)), 1.0 + 0.9j, 2.1 + 0.2j, 0.3 + 2.2j
    C, D = B + 0.5 + 0.1j, B + 0.2 + 0.6j
    lengths = {"l_OA": crank, "l_AB": abs(B - A), "l_EC": abs(C - E), "l_FD": abs(D - F)}
    figure = {"x_C": 0.5, "y_C": 0.1, "x_D": 0.2, "y_D": 0.6}
    places = {f"{axis}_{name}": part for name, at in (("E", E), ("F", F), ("B", B)) for axis, part in _parts(at)}
    return {**RATES, **lengths, **figure, **places, "turn": 0.0}


def _parts(at: complex) -> tuple[tuple[str, float], tuple[str, float]]:
    return ("x", at.real), ("y", at.imag)


def test_a_triad_is_followed_all_round() -> None:
    values = triad_values(0.1)

    done = cycle(triad(), values, ("acceleration",), positions=48)

    assert set(done.statuses) == {"ok"}
    assert done.reach.free
    for start, end, length in (("A", "B", "l_AB"), ("E", "C", "l_EC"), ("F", "D", "l_FD")):
        found = np.abs(done.values[end] - done.values[start])
        assert np.allclose(found, values[length], rtol=1e-12, atol=0.0)
    steps = np.abs(np.diff(np.append(done.values["D"], done.values["D"][0])))
    assert steps.max() < 3.0 * np.median(steps)  # no jump anywhere, and it closes
    h = 1e-5
    slope = (done.at(done.angles + h, ["D"])["D"] - done.at(done.angles - h, ["D"])["D"]) / (2.0 * h) * values["speed"]
    assert np.allclose(slope, done.values["V_D"], atol=1e-8)
    for motion in done.motions:
        assert len(motion.dead) == 2


def test_a_triad_has_limiting_positions_where_its_legs_meet_in_a_point() -> None:
    values = triad_values(0.6)

    found = reach(triad(), values)

    (arc,) = found.apart
    inside = np.array([arc.low - 1e-6, arc.low - 4e-6, arc.high + 1e-6, arc.high + 4e-6])
    solved = [solve_linkage(triad(), {**values, "phi": angle}, ("position",)) for angle in inside.tolist()]
    marks = {name: np.array([one.point(name) for one in solved]) for name in "ABCDEF"}
    determinants = np.abs(concurrence(marks))
    # it goes with the root of the way to the limit
    assert determinants[1] / determinants[0] == pytest.approx(2.0, rel=1e-3)
    assert determinants[3] / determinants[2] == pytest.approx(2.0, rel=1e-3)
    beyond = solve_linkage(triad(), {**values, "phi": arc.low + 1e-6}, ("position",))
    assert beyond.status == "no-assembly"


def concurrence(marks: dict[str, np.ndarray]) -> np.ndarray:
    """Determinant of the lines of three legs: zero when they meet in one point."""
    lines = [(marks[a], marks[b] - marks[a]) for a, b in ("AB", "EC", "FD")]
    rows = [(u.real, u.imag, (at.conj() * u).imag) for at, u in lines]
    return np.linalg.det(np.moveaxis(np.array(rows), -1, 0))


@pytest.mark.parametrize("step", [4, pytest.param(1, marks=pytest.mark.soak)])
@pytest.mark.parametrize("name", bundled("mechanism"))
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


def test_an_output_that_has_no_stroke_is_refused_by_its_number() -> None:
    mechanism = slotted(Stroke(3))
    values = {**RATES, "l_OA": 1.0, "l_CD": 2.0, "x_C": 0.5}  # C within the circle: the lever goes round and round

    with pytest.raises(InputError) as caught:
        cycle(mechanism, values)

    assert caught.value.key == "stroke-none"
    assert caught.value.data["link"] == 3


def test_a_driver_with_a_literal_angle_turns_alone() -> None:
    # 30 degrees of the driver and of a guide may be one constant of the task
    mechanism = Mechanism(
        links=(
            Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}),
            Link(2, {"A": ORIGIN, "B": ("l_AB", ZERO)}),
            Link(3, {"B": ORIGIN}),
        ),
        pairs=(
            Revolute("O", (0, 1), ORIGIN),
            Revolute("A", (1, 2)),
            Revolute("B", (2, 3)),
            Prismatic("B", (3, 0), ORIGIN, "_constant_1"),
        ),
        driver=Driver(1, "O", "A", "_constant_1", "speed", "sense"),
    )

    done = cycle(mechanism, {"l_OA": 1.0, "l_AB": 3.0, "_constant_1": math.pi / 6, "speed": 1.0, "sense": 1.0})

    assert np.allclose(np.angle(done.values["B"]), math.pi / 6)
    assert [spot.angle for spot in done.motions[0].dead] == pytest.approx([math.pi / 6, 7 * math.pi / 6])


def in_line(slider: bool) -> Mechanism:
    """Crank OA, coupler AB and rocker CB; with a slider also a link BD whose end D moves along a level guide."""
    links: tuple[Link, ...] = (
        Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}),
        Link(2, {"A": ORIGIN, "B": ("l_AB", ZERO)}),
        Link(3, {"C": ORIGIN, "B": ("l_CB", ZERO)}),
    )
    pairs: tuple[Revolute | Prismatic, ...] = (
        Revolute("O", (0, 1), ORIGIN),
        Revolute("A", (1, 2)),
        Revolute("B", (2, 3), branch="side"),
        Revolute("C", (0, 3), ("x_C", "y_C")),
    )
    if slider:
        links += (Link(4, {"B": ORIGIN, "D": ("l_BD", ZERO)}), Link(5, {"D": ORIGIN}))
        pairs += (
            Revolute("B", (3, 4)),
            Revolute("D", (4, 5)),
            Prismatic("D", (5, 0), (ZERO, "y_D"), ZERO, branch="near"),
        )
    return Mechanism(links=links, pairs=pairs, driver=CRANK)


def random_four_bar(random: np.random.Generator) -> dict[str, float]:
    """Return a crank-rocker whose frame stands in any direction."""
    while True:
        a, b, c, d = sorted(random.uniform(0.1, 1.0, 4))
        if a + d < b + c:
            break
    b, c, d = random.permutation([b, c, d])
    turned = d * np.exp(1j * random.uniform(0.0, 2.0 * math.pi))
    lengths = {"l_OA": a, "l_AB": b, "l_CB": c, "x_C": turned.real, "y_C": turned.imag}
    return {
        **RATES,
        **{name: float(x) for name, x in lengths.items()},
        "side": float(random.choice((-1, 1))),
        "near": 1.0,
    }


def off(found: tuple[float, ...], place: mpf) -> float:
    """Return how far the nearest of some places, rad, is from a place that is known to 34 digits."""
    return min(float(abs((mpf(x) - place + mp.pi) % (2 * mp.pi) - mp.pi)) for x in found)


@pytest.mark.parametrize("count", [pytest.param(25, id="25"), pytest.param(150, id="150", marks=pytest.mark.soak)])
def test_change_points_are_where_34_digits_have_them(count: int) -> None:
    random, seen = np.random.default_rng(20261122), 0

    with mp.workdps(34):
        while seen < count:
            values = random_four_bar(random)
            frame = mp.hypot(values["x_C"], values["y_C"])
            values["l_CB"] = float(frame + mpf(values["l_OA"]) - mpf(values["l_AB"]))  # all in line, A beyond O
            if abs(values["l_CB"] - values["l_AB"]) > frame - values["l_OA"] or values["l_CB"] < 0.05:
                continue  # no crank that turns
            found = reach(in_line(False), values)
            changes = found.changes
            if not changes:  # rounding of a length has made a gap of the touch
                assert sum(arc.high - arc.low for arc in found.apart) < 1e-6
                continue
            seen += 1
            direction = mp.atan2(values["y_C"], values["x_C"])
            assert off(changes, direction + mp.pi) < 1e-12
            assert all(off((x,), direction) < 1e-12 or off((x,), direction + mp.pi) < 1e-12 for x in changes)


@pytest.mark.parametrize("count", [pytest.param(12, id="12"), pytest.param(60, id="60", marks=pytest.mark.soak)])
def test_a_link_that_just_reaches_its_guide_does_so_where_34_digits_have_it(count: int) -> None:
    random, seen = np.random.default_rng(20261123), 0

    with mp.workdps(34):
        while seen < count:
            values = random_four_bar(random)
            a, b, c, side = (mpf(values[name]) for name in ("l_OA", "l_AB", "l_CB", "side"))
            pivot = mpc(values["x_C"], values["y_C"])

            def height(phi: mpf) -> mpf:
                tip = a * mp.expj(phi)  # noqa: B023
                across = pivot - tip  # noqa: B023
                along = (abs(across) ** 2 + b * b - c * c) / (2 * abs(across))  # noqa: B023
                return (tip + across / abs(across) * mpc(along, side * mp.sqrt(b * b - along * along))).imag  # noqa: B023

            solved = reach(in_line(True), {**values, "l_BD": 6.0, "y_D": -2.0})
            assert solved.free
            best = max(np.arange(0.0, 6.28, 0.02).tolist(), key=lambda phi: float(height(mpf(phi))))
            top = mp.findroot(
                lambda phi: mp.diff(height, phi), (best - 0.02, best + 0.02), solver="anderson", tol=1e-25
            )
            if abs(mp.diff(height, top, 2)) < 0.1:  # too flat for sixteen digits
                continue
            seen += 1
            values |= {"y_D": -2.0, "l_BD": float(height(top) + 2)}
            found = reach(in_line(True), values)
            assert off(found.changes, top) < 1e-12
            for x in map(mpf, found.changes):  # an upright rocker passes its top twice
                assert abs(mp.diff(height, x) / mp.diff(height, x, 2)) < 1e-12
