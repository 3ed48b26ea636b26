"""The construction of a gear pair on the board: what is drawn and measured, against strings, circles, turned teeth."""

import math
import re
from itertools import pairwise

import numpy as np
import pytest

from kulman.plans.boards.arrays import ArrayBoard
from kulman.plans.boards.batch import batch
from kulman.plans.gears import construction
from kulman.plans.gears.construction import MOST, TEETH, TIP, mark, rolling
from kulman.plans.gears.gear import CCW, CW, STANDARD, GearPair
from kulman.plans.gears.geometry import POINTS
from kulman.plans.gears.solve import SolvedGear, solve_gear
from kulman.plans.hands.shaky import Hand, draw, paper_of, preset
from kulman.plans.marking.student import StudentBoard
from kulman.tests.support.gears import SEED, Flank, madi, random_pairs, second_route

Drawn = list[tuple[SolvedGear, dict[str, float]]]


@pytest.fixture(scope="module", params=[pytest.param(10, id="10"), pytest.param(300, id="300", marks=pytest.mark.soak)])
def drawn(request: pytest.FixtureRequest) -> Drawn:
    """Return pairs that are drawn, every other one with a pinion that turns clockwise, with their second routes."""
    pairs = random_pairs(np.random.default_rng(SEED), request.param)
    both = [
        [{name: float(column[k]) for name, column in columns.items()} for columns in (pairs, second_route(pairs))]
        for k in range(request.param)
    ]
    return [(solve_gear(GearPair((CCW, CW)[k % 2]), {**STANDARD, **one}), other) for k, (one, other) in enumerate(both)]


def seen(solved: SolvedGear, i: int, name: str) -> complex:
    """Return a mark seen from a wheel's centre, the pole ahead, so that the flank which touches is the upper one."""
    point = (solved.point(name) - solved.point(mark("O", i))) * (-1j if i == 1 else 1j)
    return point if solved.pair.sense > 0 else point.conjugate()


def flank_of(solved: SolvedGear, i: int) -> tuple[Flank, float]:
    """Return the flanks of a wheel by the second route, and the circle on which it rolls."""
    z, m, x, alpha = (solved.givens[name] for name in (f"z_{i}", "m", f"x_{i}", "alpha"))
    s = 0.5 * math.pi * m + 2.0 * x * m * math.sin(alpha) / math.cos(alpha)
    return Flank(0.5 * z * m, alpha, s), abs(solved.point(mark("O", i)))


def test_what_is_measured_is_found_by_a_second_route(drawn: Drawn) -> None:
    for solved, other in drawn:
        measured = {f"{name}_drawn": other[name] for name in ("g_alpha", "l_N1N2", "phi_alpha1", "phi_alpha2")}
        ratios = ("epsilon_alpha_drawn", "epsilon_alpha_arc1", "epsilon_alpha_arc2")
        measured |= dict.fromkeys(ratios, other["epsilon_alpha"])
        measured |= {f"r_p{i}": 0.5 * other[f"d_p{i}"] for i in (1, 2)}
        measured |= {f"c_{i}": solved.givens["c"] * solved.givens["m"] for i in (1, 2)}
        measured |= {f"y_{i}_{point}": other[f"y_{i}_{point}"] for i in (1, 2) for point in POINTS}
        for name, value in measured.items():
            size = 40.0 * solved.givens["m"] if solved.quantities[name].unit == "m" else 1.0
            assert abs(solved.values[name] - value) < 1e-10 * size, name
        for name in (name for name in other if name.startswith("theta")):
            slopes = math.atan(solved.values[name]) - math.atan(other[name])
            assert abs((slopes + 0.5 * math.pi) % math.pi - 0.5 * math.pi) < 1e-10, name


def test_line_of_action_touches_both_base_circles_and_is_cut_by_the_tip_circles(drawn: Drawn) -> None:
    for solved, other in drawn:
        size, sense = other["a_w"], solved.pair.sense
        n_1, n_2 = (solved.point(mark(f"N{i}")) for i in (1, 2))
        along = (n_2 - n_1) / abs(n_2 - n_1)
        assert abs(along - complex(-sense * math.cos(other["alpha_w"]), math.sin(other["alpha_w"]))) < 1e-12
        for i in (1, 2):
            radius = solved.point(mark(f"N{i}")) - solved.point(mark("O", i))
            assert abs((along.conjugate() * radius).real) < 1e-13 * size
            assert abs(radius) == pytest.approx(0.5 * other[f"d_b{i}"], rel=1e-12)
            tip = solved.point(mark(f"A{3 - i}")) - solved.point(mark("O", i))
            assert abs(tip) == pytest.approx(0.5 * other[f"d_a{i}"], rel=1e-12)
        assert abs(solved.point(mark("O2")) - solved.point(mark("O1")) - 1j * other["a_w"]) < 1e-13 * size
        places = [(along.conjugate() * (solved.point(mark(name)) - n_1)).real for name in ("A1", "K1", "K2", "A2")]
        assert places[0] == pytest.approx(other["rho_p1"], rel=1e-9)
        for first, last in ((0, 1), (2, 3)):
            assert places[last] - places[first] == pytest.approx(other["p_b"], rel=1e-12)


def test_teeth_have_pitch_and_thickness_and_their_flanks_pass_the_pole_the_lower_points_and_the_ends(
    drawn: Drawn,
) -> None:
    for solved, other in drawn:
        for i in (1, 2):
            flank, r_w = flank_of(solved, i)
            r = 0.5 * other[f"d_{i}"]
            ahead = other[f"tau_{i}"] if i == 1 else -other[f"tau_{i}"]
            active, resting, middle = ([seen(solved, i, mark(letter, i, j)) for j in TEETH] for letter in "SRM")
            for points in (active, resting, middle):
                assert np.allclose(np.abs(points), r, rtol=1e-12)
                assert np.allclose(np.angle(np.array(points[1:]) / points[:-1]), ahead, rtol=1e-10)
            thick = [np.angle(a / b) * r for a, b in zip(active, resting, strict=True)]
            assert np.allclose(thick, other[f"s_{i}"], rtol=1e-10)
            assert np.angle(active[1]) == pytest.approx(between(flank, r_w, r), abs=1e-12)
            lower = seen(solved, i, mark("L", i))
            assert abs(lower) == pytest.approx(0.5 * other[f"d_p{i}"], rel=1e-12)
            assert np.angle(lower) == pytest.approx(between(flank, r_w, abs(lower)), abs=1e-11)
            for end, at in (("start", "A1"), ("end", "A2")):  # of engagement
                place, rolls = seen(solved, i, mark(at)), seen(solved, i, mark("B", i, end))
                assert abs(rolls) == pytest.approx(r_w, rel=1e-12)
                assert np.angle(rolls / place) == pytest.approx(between(flank, abs(place), r_w), abs=1e-11)


def test_every_mark_is_explained() -> None:
    program = solve_gear(GearPair(), madi()).program
    said = construction.__doc__ or ""
    known = set(re.findall(r"`(\w+?)(?:_\d+|_start|_end|_a)?`", said)) | set(re.findall(r"`(\w+)`", said))

    for name in (step.name.partition(".")[2] for step in program if "." in step.name):
        letters = name.rpartition("_")[0]
        first = letters if letters in known else letters.replace("2", "1")  # what is said of one wheel goes for both
        assert {name, letters, first} & known or name in POINTS, name


def test_involutes_by_rolling_lie_on_the_flanks_that_a_string_makes(drawn: Drawn) -> None:
    for solved, other in drawn:
        for i, rolled in zip((1, 2), solved.layout.rollings, strict=True):
            flank, r_w = flank_of(solved, i)
            for k in (*range(rolled.last + 1), TIP):
                foot, end = seen(solved, i, mark("T", i, k)), seen(solved, i, mark("E", i, k))
                length = abs(end - foot)
                string = flank.point(np.array(length / flank.r_b)) * np.exp(-1j * flank.half(np.array(r_w)))
                assert abs(end - string) < 1e-12 * r_w
                assert abs((foot.conjugate() * (end - foot)).real) < 1e-12 * r_w * r_w
                if k != TIP:
                    division = abs(solved.point(mark("D", i, k)))
                    assert length == pytest.approx(division, abs=1e-12 * r_w)
                    assert length == pytest.approx(k * other[f"rho_w{i}"] / rolled.parts, abs=1e-12 * r_w)
            assert abs(seen(solved, i, mark("E", i, TIP))) == pytest.approx(0.5 * other[f"d_a{i}"], rel=1e-12)
            feet = [seen(solved, i, mark("T", i, k)) for k in range(rolled.last + 1)]
            arcs = [np.angle(after / before) for before, after in pairwise(feet)]
            assert np.allclose(np.abs(arcs) * flank.r_b, other[f"rho_w{i}"] / rolled.parts, rtol=1e-10)


def between(flank: Flank, first: float, second: float) -> float:
    """Return the angle at the centre from a point of the upper flank to another one, by their radii."""
    return float(flank.half(np.array(second)) - flank.half(np.array(first)))


def test_pinion_that_turns_the_other_way_is_drawn_in_a_mirror() -> None:
    ccw, cw = (solve_gear(GearPair(rotation), madi()) for rotation in (CCW, CW))

    marks = [step.name for step in ccw.program if step.name.startswith("meshing.")]
    assert len(marks) > 60
    for name in marks:
        assert abs(ccw.point(name) + cw.point(name).conjugate()) < 1e-15
    assert all(cw.quantities[name].value == pytest.approx(q.value) for name, q in ccw.quantities.items())


def test_many_pairs_at_once_equal_one_at_a_time_to_the_last_bit() -> None:
    x_1 = np.linspace(0.15, 0.25, 64)
    solved = [solve_gear(GearPair(), madi(x_1=shift)) for shift in x_1[::9].tolist()]
    program = solved[0].program
    givens = {**solved[0].givens, "x_1": x_1}

    found, codes = batch(program, givens, program.names)
    board = ArrayBoard(givens, x_1.size)
    board.follow(program)

    assert not codes.any()
    for name in program.names:
        one_by_one = np.array([each.values[name] for each in solved])
        for column in (found[name], board.values[name]):
            assert np.array_equal(np.broadcast_to(column, x_1.shape)[::9], one_by_one), name


def test_hand_that_never_errs_draws_what_is_exact_and_a_shaky_one_errs_as_it_should() -> None:
    solved = solve_gear(GearPair(), madi())
    paper = paper_of(solved, {"mu_l": 0.0002, "mu_rho": 0.0002, "mu_theta": 0.05})

    exact = draw(paper, Hand(0.0, 0.0, 0.0), np.random.default_rng(1), 3)
    shaky = draw(paper, preset("normal").hand, np.random.default_rng(1), 2000)

    for name in solved.program.names:
        assert np.allclose(exact.values[name], solved.values[name], rtol=1e-12, atol=1e-15), name
    spreads = {"g_alpha_drawn": (0.1e-3, 1e-3), "y_1_03": (0.2e-3, 1e-3), "phi_alpha1_drawn": (5e-3, 0.04)}
    for name, (least, most) in spreads.items():
        assert least < np.std(shaky.values[name]) < most
        assert abs(np.mean(shaky.values[name]) - solved.values[name]) < 0.2 * np.std(shaky.values[name])
    assert "d_a1" not in shaky.missed  # what is calculated does not err


def test_what_follows_from_a_students_value_follows_from_it_on_the_drawing() -> None:
    solved = solve_gear(GearPair(), madi())
    wrong = solved.values["d_a2"] + 1e-3

    class Said:
        """The student's tip circle of the wheel."""

        def taken(self, value: float) -> float:
            return wrong

    board = StudentBoard(solved.program, solved.givens, lambda name, value: (Said() if name == "d_a2" else None, False))
    board.go_on()

    along = math.sqrt(wrong**2 - solved.values["d_b2"] ** 2) * 0.5 - solved.values["rho_w2"]
    g_alpha = along + solved.values["g_a"]
    assert board.values["g_alpha_drawn"] == pytest.approx(g_alpha, rel=1e-12)
    assert board.values["epsilon_alpha_drawn"] == pytest.approx(g_alpha / solved.values["p_b"], rel=1e-12)
    assert board.values["c_1"] == pytest.approx(1.25e-3 - 0.5e-3, rel=1e-9)


def test_a_pole_outside_the_active_line_and_involutes_far_out_are_constructed_otherwise() -> None:
    for x_1, x_2, point in ((1.5, -1.0, "03"), (-1.0, 1.5, "08"), (0.2, 0.0, "06")):
        solved = solve_gear(GearPair(), madi(z_1=40.0, z_2=50.0, x_1=x_1, x_2=x_2))
        assert solved.layout.pole == point  # of the table
        assert solved.values[f"theta_12_{point}"] == solved.values[f"theta_21_{point}"] == 0.0
        assert solved.values[f"y_1_{point}"] == solved.values[f"y_2_{point}"] == solved.values["PW"]
    for rho_w, rho_a in ((1.0, 1.2), (1.0, 0.4), (1.0, 7.0), (1.0, 40.0), (1e-6, 1.0)):
        rolled = rolling(rho_w, rho_a)  # in no more parts than can be told apart
        part = rho_w / rolled.parts
        assert 1 <= rolled.parts <= construction.PARTS
        assert rolled.last <= MOST
        assert rolled.last == MOST or rolled.last * part <= rho_a < (rolled.last + 1) * part
