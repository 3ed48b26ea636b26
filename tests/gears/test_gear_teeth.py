"""Teeth: profiles, what a rack leaves, pairs rolled as polygons; drawn on the board by strings and circles."""

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
from kulman.plans.gears.geometry import POINTS, geometry
from kulman.plans.gears.solve import SolvedGear, complete, solve_gear
from kulman.plans.gears.teeth import RIGHT_ANGLE, Meshing, _Tooth, meshing_of, tooth_of
from kulman.plans.hands.shaky import Hand, draw, paper_of, preset
from kulman.tests.support.gears import (
    SEED,
    Flank,
    contacts,
    counted_ratio,
    cut_by_rack,
    flanks_touch,
    line,
    madi,
    outlines,
    polygon,
    random_pairs,
    second_route,
    sector_of,
    wheel_of,
)

CASES = [
    pytest.param({}, "plain", id="the project's pinion"),
    pytest.param({"z_1": 9.0, "x_1": 0.0}, "undercut", id="undercut"),
    pytest.param({"z_1": 8.0, "x_1": 1.2, "x_2": 0.2}, "pointed", id="pointed"),
    pytest.param({"z_1": 40.0, "x_1": -0.3, "alpha": math.radians(26.0)}, "plain", id="round tip of the rack"),
    pytest.param({"z_1": 30.0, "x_1": 1.45, "x_2": 0.0}, "plain", id="root outside the pitch line"),
]
SLANTED = {"z_1": 14.0, "z_2": 25.0, "x_1": 0.5, "x_2": -0.1, "alpha": math.radians(24.0)}
PAIRS = [
    pytest.param({}, 1, id="the project's pair"),
    pytest.param(SLANTED, -1, id="24 deg, clockwise"),
    pytest.param({}, -1, id="turning clockwise", marks=pytest.mark.soak),
    pytest.param({"z_1": 18.0, "z_2": 30.0, "x_1": 0.0, "x_2": 0.0}, 1, id="without shifts", marks=pytest.mark.soak),
]
STEPS = 25  # of a pitch, in which contacts are counted by polygons
TOUCHING = 5e-6  # mm: less apart, two chords of flanks touch
Drawn = list[tuple[SolvedGear, dict[str, float]]]


def mesh(others: dict[str, float], sense: int = 1) -> Meshing:
    return meshing_of(complete(madi(**others)), sense)


@pytest.mark.parametrize(("others", "what"), [pytest.param(*CASES[0].values, marks=pytest.mark.soak), *CASES[1:]])
def test_tooth_has_the_area_that_a_rack_leaves_cutting_in_many_steps(others: dict[str, float], what: str) -> None:
    values = madi(**others)
    tooth = tooth_of(values, 1)
    assert kind(tooth) == what
    assert sector_of(tooth) == pytest.approx(cut_by_rack(values, tooth, values["x_1"], 3e-3), abs=1e-3)


@pytest.mark.parametrize(("others", "what"), CASES)
def test_outline_is_one_curve_without_gaps_loops_or_kinks(others: dict[str, float], what: str) -> None:
    tooth, step = tooth_of(madi(**others), 1), 1e-6
    half, whole = tooth.half(200), polygon(wheel_of(tooth, 200))
    rho = np.linspace(tooth.rho_start, tooth.rho_end, 50)
    points, normals = tooth.flank(rho), normal(tooth, rho)
    leaves = np.diff(tooth.fillet(np.array([tooth.beta_start, tooth.beta_start + step])))[0]
    comes = np.diff(tooth.fillet(np.array([RIGHT_ANGLE - step, RIGHT_ANGLE])))[0]
    foot = complex(tooth.fillet(RIGHT_ANGLE))

    assert whole.is_valid
    assert np.max(np.abs(np.diff(half))) < 0.03 * tooth.r
    assert abs(complex(tooth.fillet(tooth.beta_start)) - complex(tooth.flank(tooth.rho_start))) < 1e-12 * tooth.r
    assert half[0] == pytest.approx(tooth.tip)
    assert np.angle(half[-1]) == pytest.approx(math.pi / tooth.z)
    assert abs(half[-1]) == pytest.approx(tooth.r_f)
    assert np.all(np.diff(np.abs(half)) < 1e-12)  # from the tip inwards all the way
    assert what != "pointed" or abs(complex(tooth.flank(tooth.rho_end)).imag) < 1e-12 * tooth.r
    along = points - rho * normals  # the end of the radius of curvature: normals touch the base circle
    assert np.max(np.abs(np.abs(along) - tooth.r_b)) < 1e-12 * tooth.r
    assert np.max(np.abs((along * normals.conj()).real)) < 1e-12 * tooth.r
    chords = np.diff(points)
    slope = (chords * normal(tooth, 0.5 * (rho[1:] + rho[:-1])).conj()).real / np.abs(chords)
    assert np.max(np.abs(slope)) < 1e-3  # and they are normals: of chords beside them
    kink = abs((leaves * complex(normal(tooth, tooth.rho_start)).conjugate()).real) / abs(leaves)
    assert kink > 1e-2 if what == "undercut" else kink < 1e-4
    assert abs((comes * foot.conjugate()).real) / abs(comes * foot) < 1e-4
    assert abs(foot) == pytest.approx(tooth.r_f, rel=1e-14)


def test_teeth_have_the_thickness_of_the_formula_and_follow_each_other_by_the_angular_pitch() -> None:
    values = madi()
    found = geometry(values)

    for i in (1, 2):
        tooth = tooth_of(values, i)
        assert 2.0 * tooth.r * float(tooth.half_angle(tooth.r)) == pytest.approx(found[f"s_{i}"], rel=1e-14)
        assert 2.0 * tooth.r_a * float(tooth.half_angle(tooth.r_a)) == pytest.approx(found[f"s_a{i}"], rel=1e-13)
        assert tooth.rho_start == pytest.approx(found[f"rho_l{i}"], rel=1e-12)
        three, one = tooth.teeth(3), tooth.outline()
        assert len(three) == 3 * (len(one) - 1) + 1
        turned = one * np.exp(2j * math.pi / tooth.z)
        assert np.max(np.abs(three[len(one) - 1 : 2 * len(one) - 2] - turned[:-1])) < 1e-15
        assert abs(three[-1]) == pytest.approx(tooth.r_f)


def test_undercut_begins_at_the_least_shift_and_points_where_the_tip_has_no_thickness() -> None:
    least = geometry(madi(z_1=12.0))["x_min1"]
    for beside, undercut in ((1e-9, False), (-1e-9, True)):
        assert tooth_of(madi(z_1=12.0, x_1=least + beside), 1).undercut == undercut
    for x in np.linspace(0.3, 1.1, 9):
        values = madi(z_1=12.0, x_1=float(x), x_2=0.0)
        assert tooth_of(values, 1).pointed == (geometry(values)["s_a1"] < 0.0)


def kind(tooth: _Tooth) -> str:
    return "undercut" if tooth.undercut else "pointed" if tooth.pointed else "plain"


@pytest.mark.soak
def test_teeth_of_many_racks_have_the_area_that_is_left() -> None:
    random = np.random.default_rng(SEED)
    for what, teeth, shifts in (
        ("plain", (12, 60), (0.35, 0.5)),
        ("undercut", (6, 14), (-0.2, 0.1)),
        ("pointed", (6, 9), (0.9, 1.1)),
    ):
        for _ in range(8):
            z, x = float(random.integers(*teeth)), random.uniform(*shifts)
            values = madi(z_1=z, x_1=x, x_2=-0.1, alpha=math.radians(random.uniform(18.0, 22.0)))
            tooth = tooth_of(values, 1)
            assert (kind(tooth), tooth.whole) == (what, True)
            assert sector_of(tooth) == pytest.approx(cut_by_rack(values, tooth, x, 2e-3), abs=1e-3), (z, x)


def normal(tooth: _Tooth, rho: float | np.ndarray) -> np.ndarray:
    """Return unit normals of the upper involute, out of the tooth: each lies on a tangent of the base circle."""
    return 1j * np.exp(1j * (tooth.psi_b - np.asarray(rho) / tooth.r_b))


@pytest.mark.parametrize("count", [pytest.param(60, id="60"), pytest.param(150, id="150", marks=pytest.mark.soak)])
def test_outlines_of_all_racks_and_shifts_are_valid(count: int) -> None:
    random = np.random.default_rng(SEED)
    seen = {"plain": 0, "undercut": 0, "pointed": 0, "round": 0}
    for _ in range(count):
        h_a = random.uniform(0.6, 1.1)
        values = madi(
            z_1=float(random.integers(3, 30)),
            x_1=random.uniform(-0.8, 1.6),
            alpha=math.radians(random.uniform(10.0, 32.0)),
            h_a=h_a,
            h_l=2.0 * h_a * random.uniform(0.9, 1.02),
            c=random.uniform(0.1, 0.2),
        )
        tooth = tooth_of(values, 1)
        if (h_a + values["c"]) * math.tan(values["alpha"]) < 0.25 * math.pi and tooth.whole:
            seen[kind(tooth)] += 1
            seen["round"] += tooth.e_f == 0.0
            assert polygon(wheel_of(tooth, 24)).is_valid

    assert min(seen.values()) > count // 30


def overlap(meshing: Meshing, angle: float) -> float:
    """Return the area common to both wheels, mm2."""
    first, second = (polygon(outline) for outline in outlines(meshing, angle, 300, math.radians(0.1)))
    return float(first.intersection(second).area)


@pytest.mark.parametrize(
    ("others", "sense"), [PAIRS[1], *(pytest.param(*PAIRS[k].values, marks=pytest.mark.soak) for k in (0, 2, 3))]
)
def test_contacts_counted_on_polygons_make_the_contact_ratio(others: dict[str, float], sense: int) -> None:
    meshing = mesh(others, sense)
    epsilon = geometry(madi(**others))["epsilon_alpha"]
    pitch = 2.0 * math.pi / meshing.teeth[0].z
    angles = (np.arange(STEPS) + 0.37) * pitch / STEPS
    counted = [flanks_touch(meshing, float(angle), TOUCHING) for angle in angles]
    assert counted == [len(contacts(meshing, float(angle))) for angle in angles]
    assert np.mean(counted) == pytest.approx(epsilon, abs=1.0 / STEPS + 1e-3)
    assert counted_ratio(meshing) == pytest.approx(epsilon, abs=1.5e-3)


@pytest.mark.soak
def test_many_pairs_roll_without_overlap_and_touch_as_often_as_the_contact_ratio_says() -> None:
    pairs = random_pairs(np.random.default_rng(SEED), 12)
    for k in range(12):
        values = {name: float(column[k]) for name, column in pairs.items()}
        values["m"] = 4e-3
        if max(values["z_1"], values["z_2"]) > 60.0:
            continue
        meshing = meshing_of(complete(values), 1 - 2 * (k % 2))
        pitch = 2.0 * math.pi / values["z_1"]
        for angle in np.linspace(0.0, pitch, 9):
            assert overlap(meshing, float(angle)) < 1e-6
        counted = [flanks_touch(meshing, float(angle), TOUCHING) for angle in (np.arange(150) + 0.5) * pitch / 150]
        assert np.mean(counted) == pytest.approx(geometry(values)["epsilon_alpha"], abs=0.01)


@pytest.mark.parametrize(("others", "sense"), PAIRS)
def test_line_of_action_touches_both_base_circles_and_passes_the_pole(others: dict[str, float], sense: int) -> None:
    meshing, values = mesh(others, sense), madi(**others)
    found = geometry(values)

    ends = first, second = meshing.place(0.0), meshing.place(found["l_N1N2"])
    for n, centre, tooth in zip(ends, meshing.centres, meshing.teeth, strict=True):
        assert abs(n - centre) == pytest.approx(tooth.r_b, rel=1e-13)
        assert abs(((n - centre).conjugate() * meshing.along).real) < 1e-13 * tooth.r
    assert abs((first.conjugate() * second).imag) < 1e-13 * abs(first) * abs(second)  # the pole is between them
    assert abs(second - first) == pytest.approx(found["l_N1N2"], rel=1e-13)
    start, end = (meshing.place(found[rho]) for rho in ("rho_p1", "rho_a1"))
    assert abs(start - meshing.centres[1]) == pytest.approx(meshing.teeth[1].r_a, rel=1e-13)
    assert abs(end - meshing.centres[0]) == pytest.approx(meshing.teeth[0].r_a, rel=1e-13)
    assert abs(end - start) == pytest.approx(found["g_alpha"], rel=1e-12)
    rim = 1j * sense * (0j - meshing.centres[0])  # how the pinion's rim moves at the pole
    assert (rim.conjugate() * meshing.along).real > 0.0  # and drives the wheel
    for one, other in (meshing.teeth, meshing.teeth[::-1]):  # both roots have the radial clearance
        gap = abs(meshing.centres[1] - meshing.centres[0]) - one.r_a - other.r_f
        assert gap == pytest.approx(values["c"] * values["m"], rel=1e-12)


def test_single_contact_lies_between_two_double_ones_and_undercut_teeth_touch_less_long() -> None:
    meshing, values = mesh({}), madi(z_1=8.0, x_1=-0.1, z_2=40.0, x_2=0.3)
    first, last = meshing.touching
    low, high = last - meshing.sizes["p_b"], first + meshing.sizes["p_b"]
    short = meshing_of(values)
    for rho_1, count in (((first + low) / 2, 2), ((low + high) / 2, 1), ((high + last) / 2, 2)):
        assert len(contacts(meshing, meshing.angle(rho_1))) == count
    assert short.teeth[0].undercut
    assert short.touching[0] > geometry(values)["rho_p1"]
    assert counted_ratio(short) < geometry(values)["epsilon_alpha"] - 0.1
    assert overlap(short, 0.05) < 1e-6  # the undercut makes room


@pytest.mark.parametrize(("others", "sense"), PAIRS)
def test_flanks_touch_where_the_contact_is_said_to_be(others: dict[str, float], sense: int) -> None:
    meshing = mesh(others, sense)
    first, last = meshing.touching
    for rho_1 in np.linspace(first, last, 5):
        angle = meshing.angle(float(rho_1))
        place = meshing.place(float(rho_1))
        assert np.min(np.abs(contacts(meshing, angle) - rho_1)) < 1e-15
        lines = [line(np.append(outline, outline[0])) for outline in outlines(meshing, angle, 400)]
        point = line(np.array([place, place + 1e-12]))
        assert all(outline.distance(point) < 1e-4 for outline in lines)


@pytest.mark.parametrize(("others", "sense"), PAIRS)
def test_wheels_roll_through_a_pitch_without_overlap_and_without_backlash(others: dict[str, float], sense: int) -> None:
    meshing = mesh(others, sense)
    first, second = outlines(meshing, 0.0, 100)
    for angle in np.linspace(0.0, 2.0 * math.pi / meshing.teeth[0].z, 8):
        assert overlap(meshing, float(angle)) < 1e-6
    for turn in (1e-3, -1e-3):
        turned = meshing.centres[0] + (first - meshing.centres[0]) * np.exp(1j * turn)
        assert polygon(turned).intersection(polygon(second)).area > 1e-2


@pytest.fixture(scope="module", params=[pytest.param(10, id="10"), pytest.param(120, id="120", marks=pytest.mark.soak)])
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


def test_teeth_have_pitch_and_thickness_and_pass_the_pole_and_the_ends(drawn: Drawn) -> None:
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
