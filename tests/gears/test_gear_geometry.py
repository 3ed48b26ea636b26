"""Quantities of a pair by a route without formulas, shifts that follow, bad data, verdicts; the blocking contour."""

import math
from functools import cache

import numpy as np
import pytest
from mpmath import mp

from kulman.plans.gears.blocking import (
    BLOCKING,
    CELLS,
    CURVES,
    Plane,
    _near_crossings,
    crossings,
    plane_of,
    traced,
)
from kulman.plans.gears.gear import HARDENED, STANDARD, GearPair
from kulman.plans.gears.geometry import (
    POINTS,
    _angle_of_involute,
    _geometry_program,
    _involute,
    geometry,
    tangent_of_involute,
)
from kulman.plans.gears.solve import SAME_CENTRES, checks, complete, judged
from kulman.plans.gears.teeth import meshing_of, tooth_of
from kulman.plans.solved import Check
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.gears import SEED, Flank, madi, outlines, polygon, random_pairs, second_route

FAULTS = [
    ({"x_1": 0.12}, {"undercut_1"}),
    ({"z_1": 30.0, "z_2": 12.0, "x_1": 0.8, "x_2": 0.1}, {"undercut_2"}),
    ({"x_1": 0.5, "x_2": 1.0}, {"contact_ratio"}),
    ({"z_1": 12.0, "x_1": 0.8, "x_2": -0.1}, {"tip_1"}),
    ({"z_1": 25.0, "z_2": 90.0, "x_1": -0.1, "x_2": -0.6}, {"interference_1"}),
]
MEASURED = {"z_W1", "z_W2", "W_1", "W_2", "rho_f", "inv_alpha", "inv_alpha_w", *SAME_CENTRES}  # in tests of their own
LENGTHS = {"a", "d", "p", "P", "s", "e", "h", "rho", "l", "g", "y"}
NUMBERS = {"y", "delta_y"}
BASIC = {"m": 5e-3, "z_1": 15.0, "z_2": 20.0}
SIZES = ((15.0, 20.0), (12.0, 24.0), (60.0, 90.0), (20.0, 40.0), (10.0, 10.0), (35.0, 36.0))
WHEELS = [pytest.param(*size, marks=pytest.mark.soak if k else ()) for k, size in enumerate(SIZES)]


@pytest.fixture(
    scope="module", params=[pytest.param(60, id="60"), pytest.param(1000, id="1000", marks=pytest.mark.soak)]
)
def pairs(request: pytest.FixtureRequest) -> dict[str, np.ndarray]:
    return random_pairs(np.random.default_rng(SEED), request.param)


def test_every_quantity_is_found_by_a_second_route(pairs: dict[str, np.ndarray]) -> None:
    found, other = geometry(pairs), second_route(pairs)

    named = {name for name in _geometry_program().names if not name.startswith("_")}
    assert named - MEASURED == set(other) & named
    for name in sorted(set(other) & named):
        error = found[name] - other[name]
        if name.startswith("theta"):  # as large as the places are near to N: compared as slopes of a line
            slopes = np.arctan(found[name]) - np.arctan(other[name])
            error = (slopes + 0.5 * np.pi) % np.pi - 0.5 * np.pi
        elif name in LENGTHS or (name.partition("_")[0] in LENGTHS and name not in NUMBERS):
            error = error / (40.0 * pairs["m"])
        assert np.max(np.abs(error)) < 1e-10, name
    for k in (0, 7, len(pairs["m"]) - 1):  # of many pairs as of each
        alone = geometry({name: float(values[k]) for name, values in pairs.items()})
        assert [name for name, value in alone.items() if value != found[name][k]] == []


def test_common_normal_is_the_distance_of_jaws_that_touch_two_flanks(pairs: dict[str, np.ndarray]) -> None:
    found = geometry(pairs)

    for i in (1, 2):
        some = np.isfinite(found[f"W_{i}"])  # flanks may be too short for any number of teeth
        r, s = 0.5 * found[f"d_{i}"][some], found[f"s_{i}"][some]
        z, alpha, m = (pairs[name][some] for name in (f"z_{i}", "alpha", "m"))
        flank = Flank(r, alpha, s)
        turn = np.exp(1j * math.pi * (found[f"z_W{i}"][some] - 1.0) / z)  # of the last tooth from the middle of all

        def beside(t: np.ndarray, flank: Flank = flank, turn: np.ndarray = turn) -> np.ndarray:
            return (flank.point(t) * turn).imag

        at = flank.base + np.angle(turn)  # where the flank is upright
        assert np.max(np.abs(found[f"W_{i}"][some] - 2.0 * beside(at)) / m) < 1e-11
        assert np.all((beside(at) > beside(at - 1e-3)) & (beside(at) > beside(at + 1e-3)))
        radius = 2.0 * abs(flank.point(at))
        assert np.all((found[f"d_p{i}"][some] <= radius) & (radius <= found[f"d_a{i}"][some]))
        short = 2.0 * (found[f"rho_a{i}"] - found[f"rho_p{i}"]) < found["p_b"]
        assert np.all(some | short)
    z = np.arange(12.0, 100.0)  # as many teeth as tables say: z * 20 / 180 + 0.5, rounded
    assert np.all(np.abs(geometry({**madi(x_1=0.0, x_2=0.0, z_2=1000.0), "z_1": z})["z_W1"] - (z / 9.0 + 0.5)) <= 0.53)


def test_corner_of_the_rack_is_the_printed_one_and_fills_a_narrow_tip() -> None:
    found, steep = geometry(madi()), madi(alpha=math.radians(26.0))
    narrow = geometry(steep)["rho_f"] / steep["m"]
    assert found["rho_f"] / found["m"] == pytest.approx(0.38, abs=1e-4)  # GOST 13755-81 rounds 0.379951
    assert found["rho_f"] * (1.0 - math.sin(STANDARD["alpha"])) == pytest.approx(0.25 * found["m"], rel=1e-14)
    tip = 0.25 * math.pi - 1.25 * math.tan(steep["alpha"])  # half the tip without the corner, in modules
    rounded = tip / math.tan(0.5 * (0.5 * math.pi - steep["alpha"]))  # of the circle that touches flank and tip there
    assert narrow == pytest.approx(rounded, rel=1e-13)
    assert narrow < 0.25 / (1.0 - math.sin(steep["alpha"]))


@pytest.mark.parametrize("alpha", [1e-8, 1e-4, 0.05, 0.3, 0.463, 0.4637, 0.7, 1.2, 1.57])
def test_involute_and_its_inverse_are_exact_to_the_last_digits(alpha: float) -> None:
    with mp.workdps(50):
        exact = mp.tan(mp.mpf(alpha)) - mp.mpf(alpha)
        value = float(_involute(alpha))
        angle = mp.findroot(lambda a: mp.tan(a) - a - mp.mpf(value), mp.mpf(alpha))

        assert abs(float(value / exact) - 1.0) < 2e-15
        assert abs(float(mp.mpf(float(_angle_of_involute(value))) / angle) - 1.0) < 1e-15


def test_inverse_of_the_involute_never_fails() -> None:
    inv = np.logspace(-300, 12, 20_001)
    t = tangent_of_involute(inv)
    back = np.where(t < 1e-3, t**3 / 3.0, t - np.arctan(t))
    assert np.max(np.abs(back / inv - 1.0)) < 1e-6  # the difference loses digits where it is small
    assert np.all(np.diff(t) > 0.0)
    assert tangent_of_involute(0.0) == 0.0
    assert np.isnan(tangent_of_involute(-1e-9))


@pytest.mark.parametrize("count", [pytest.param(4, id="4"), pytest.param(40, id="40", marks=pytest.mark.soak)])
def test_shifts_follow_from_the_centre_distance(count: int) -> None:
    pairs = random_pairs(np.random.default_rng(SEED), count)
    a_w, x_sum = geometry(pairs)["a_w"], pairs["x_1"] + pairs["x_2"]
    for k in range(count):
        values = {name: float(column[k]) for name, column in pairs.items()}
        rest = {name: value for name, value in values.items() if name not in ("x_1", "x_2")}
        for given in ({"a_w": float(a_w[k])}, {"x_sum": float(x_sum[k])}):
            for kept, other in (("x_1", "x_2"), ("x_2", "x_1")):
                found = complete({**rest, **given, kept: values[kept]})
                assert found[other] == pytest.approx(values[other], abs=1e-11)
                assert "a_w" not in found


@pytest.mark.parametrize("count", [pytest.param(5, id="5"), pytest.param(30, id="30", marks=pytest.mark.soak)])
def test_shifts_for_equal_sliding_give_the_same_sliding_at_both_roots_and_no_less_is_had(count: int) -> None:
    random = np.random.default_rng(SEED)
    for _ in range(count):
        z_1, z_2 = (float(z) for z in random.integers(14, 70, 2))
        values = {"m": 3e-3, "z_1": z_1, "z_2": z_2, "x_sum": random.uniform(0.0, 1.0)}

        found = complete(values)

        at = geometry(found)
        assert at["theta_12_A1"] == pytest.approx(at["theta_21_A2"], rel=1e-9)
        assert min(at["rho_p1"], at["rho_p2"]) > 0.0
        for aside in (-0.01, 0.01):  # of two shifts with this sum no others have a lesser greatest sliding
            worse = geometry({**found, "x_1": found["x_1"] + aside, "x_2": found["x_2"] - aside})
            assert min(worse["theta_12_A1"], worse["theta_21_A2"]) < at["theta_12_A1"]
        again = complete({name: values[name] for name in ("m", "z_1", "z_2")} | {"a_w": at["a_w"]})
        assert again["x_1"] == pytest.approx(found["x_1"], abs=1e-8)  # from the centre distance, too


@pytest.mark.parametrize(
    ("given", "key"),
    [
        (madi(z_2=math.nan), "gear-teeth"),
        (madi(m=math.inf), "gear-module"),
        (madi(alpha=math.radians(9.9)), "gear-alpha"),
        (madi(alpha=math.radians(35.1)), "gear-alpha"),
        (madi(alpha=math.radians(35.0)), "gear-rack"),  # without a tip
        (madi(h_a=0.0, h_l=0.2), "gear-rack"),
        (madi(h_l=1.0), "gear-rack"),  # an edge that does not pass the pitch line
        (madi(h_l=2.3), "gear-rack"),  # and one longer than the tooth
        (madi(c=-0.1), "gear-rack"),
        (madi(z_1=6.0, x_1=-0.9), "gear-no-tooth"),  # cut through
        (madi(x_1=math.nan), "gear-shifts"),
        (madi(z_1=22.0, z_2=39.0, h_a=0.3, h_l=0.6, x_1=1.3, x_2=-1.1), "gear-no-contact"),  # tips apart
        ({**BASIC}, "gear-shifts"),
        ({**BASIC, "x_1": 0.2, "x_2": 0.1, "a_w": 90e-3}, "gear-shifts"),
        ({**BASIC, "x_sum": 0.2, "a_w": 90e-3}, "gear-shifts"),  # the same twice
        ({**BASIC, "a_w": 82e-3}, "gear-centre"),  # base circles overlap
        ({**BASIC, "x_sum": -0.9}, "gear-no-mesh"),
        ({**BASIC, "a_w": 110e-3, "x_1": 0.2}, "gear-no-tooth-found"),
        ({**BASIC, "z_1": 8.0, "z_2": 8.0, "x_sum": -0.05}, "gear-no-balance"),  # interference in any case
    ],
)
def test_bad_data_are_explained(given: dict[str, float], key: str) -> None:
    with pytest.raises(InputError) as caught:
        complete(given)
    assert caught.value.key == key
    assert not [language for language in LANGUAGES if "{" in caught.value.text(language)]


def verdicts(values: dict[str, float], pair: GearPair | None = None) -> dict[str, Check]:
    return {check.name: check for check in checks(pair or GearPair(), geometry(values))}


def test_pair_of_the_project_passes_all_checks_and_each_fault_is_told_by_its_own() -> None:
    found = verdicts(madi())

    assert all(check.ok for check in found.values())
    assert list(found) == [
        *(f"centre_{name}" for name in SAME_CENTRES),
        *("undercut_1", "undercut_2", "interference_1", "interference_2", "contact_ratio", "tip_1", "tip_2"),
    ]
    check = found["interference_1"]
    assert (check.quantity, check.of, check.relation) == ("rho_l1", "rho_p1", "at-most")
    assert (check.value, check.limit) == pytest.approx((1.1305e-3, 6.4192e-3), abs=1e-7)
    assert found["contact_ratio"].limit == 1.2
    for others, failing in FAULTS:
        assert {name for name, check in verdicts(madi(**others)).items() if not check.ok} == failing


def test_limit_that_an_error_names_is_the_limit() -> None:
    least = 87.5e-3 * math.cos(STANDARD["alpha"])
    with pytest.raises(InputError) as caught:
        complete({**BASIC, "a_w": least * 0.999, "x_1": 0.2})
    assert caught.value.data["least"] == f"{least * 1e3:.7g}"
    with pytest.raises(InputError) as caught:
        complete({**BASIC, "x_1": 0.0, "x_2": -2.0})
    x_sum = float(caught.value.data["least"])
    assert geometry(madi(x_1=0.0, x_2=x_sum + 1e-4), ("alpha_w",))["alpha_w"] > 0.0
    assert not geometry(madi(x_1=0.0, x_2=x_sum - 1e-4), ("alpha_w",))["alpha_w"] >= 0.0


@pytest.mark.parametrize(
    ("z_1", "z_2", "x_1", "x_2", "roots"),
    [
        pytest.param(20.0, 40.0, 0.2, 0.0, set(), id="neither", marks=pytest.mark.soak),
        pytest.param(15.0, 20.0, 0.2, 0.85, set(), id="the project's pair"),
        pytest.param(20.0, 40.0, 0.3, -1.0, {1}, id="root of the pinion", marks=pytest.mark.soak),
        pytest.param(25.0, 90.0, -0.1, -0.6, {1}, id="pinion and large wheel", marks=pytest.mark.soak),
        pytest.param(20.0, 40.0, 0.0, 1.65, {2}, id="root of the wheel"),
        pytest.param(30.0, 30.0, -0.6, -0.6, {1, 2}, id="both"),
    ],
)
def test_interference_is_where_wheels_overlap_when_they_roll(
    z_1: float, z_2: float, x_1: float, x_2: float, roots: set[int]
) -> None:
    values = complete(madi(z_1=z_1, z_2=z_2, x_1=x_1, x_2=x_2))
    meshing = meshing_of(values)
    angles = np.linspace(-math.pi / z_1, math.pi / z_1, 16, endpoint=False)
    pairs = (outlines(meshing, float(angle), 100, math.radians(0.3)) for angle in angles)
    worst = max(polygon(first).intersection(polygon(second)).area for first, second in pairs)
    own = verdicts(values)
    assert {i for i in (1, 2) if not own[f"interference_{i}"].ok} == roots
    assert (worst > 1e-4) == bool(roots)


@pytest.mark.parametrize("count", [pytest.param(20, id="20"), pytest.param(60, id="60", marks=pytest.mark.soak)])
def test_undercut_and_thickness_are_those_of_the_teeth(count: int) -> None:
    random = np.random.default_rng(SEED)
    for _ in range(count):
        values = madi(z_1=float(random.integers(8, 30)), x_1=random.uniform(-0.3, 0.9), x_2=0.3)
        own, tooth = verdicts(values), tooth_of(values, 1)

        assert own["undercut_1"].ok != tooth.undercut
        thickness = 2.0 * tooth.r_a * float(tooth.half_angle(tooth.r_a))
        assert own["tip_1"].ok == (thickness >= 0.3 * values["m"])


def test_sliding_at_the_ends_and_distances_of_centres_in_other_ways(pairs: dict[str, np.ndarray]) -> None:
    found = geometry(pairs)

    for own, mate, end, other in (("12", "21", "01", "12"), ("21", "12", "12", "01")):
        assert np.all(found[f"theta_{own}_{end}"] == -np.inf)
        assert np.all(found[f"theta_{own}_{other}"] == 1.0)
        inside = (found["g_f"] > 0.0) & (found["g_a"] > 0.0)  # the pole is the sixth point
        assert np.all(found[f"theta_{mate}_06"][inside] == 0.0)
    y_1, y_2 = (np.array([found[f"y_{i}_{point}"] for point in POINTS]) for i in (1, 2))
    assert np.all(np.diff(y_1, axis=0) > 0.0)
    assert np.all(np.diff(y_2, axis=0) < 0.0)
    for name in SAME_CENTRES:
        assert np.max(np.abs(found[name] / found["a_w"] - 1.0)) < 1e-14
    for i in (1, 2):  # and the depth of the teeth in two
        depth = 0.5 * (found[f"d_a{i}"] - found[f"d_f{i}"])
        assert np.max(np.abs(depth - found["h"]) / pairs["m"]) < 1e-12


def test_standard_rack_is_taken_where_no_other_is_given_and_limits_are_allowed_themselves() -> None:
    assert complete({**BASIC, "x_1": 0.2, "x_2": 0.85}) == madi()
    assert complete({**BASIC, "x_1": 0.2, "x_2": 0.85, "c": 0.3})["c"] == 0.3
    for others in (
        {"alpha": math.radians(10.0)},
        {"alpha": math.radians(35.0), "h_a": 0.8, "h_l": 1.6},
        {"c": 0.0},
        {"h_l": 2.25},
        {"h_a": 0.25 * math.pi / math.tan(math.radians(20.0)) - 0.25},  # the tip of the rack has no width
        {"z_1": 3.0, "x_1": 1.0},
        {"z_2": 10000.0},
    ):
        assert complete(madi(**others)) == madi(**others)


def test_hardened_tips_are_thicker_what_is_on_its_limit_is_in_order_what_is_undefined_is_not() -> None:
    values = madi(z_1=12.0, x_1=0.6, x_2=0.2)
    soft, hard = (verdicts(values, pair)["tip_1"] for pair in (GearPair(), GearPair(material=HARDENED)))
    assert (soft.ok, hard.ok) == (True, False)
    assert (soft.limit, hard.limit) == pytest.approx((0.3 * values["m"], 0.4 * values["m"]))
    assert soft.limit < geometry(values)["s_a1"] < hard.limit
    assert verdicts(madi(x_1=geometry(madi())["x_min1"]))["undercut_1"].ok
    for relation, undefined in (("at-least", "tip_1"), ("at-most", "interference_1")):
        assert judged(undefined, "e", {"e": 1.2}, 1.2, relation).ok
        assert not judged(undefined, "e", {"e": math.nan}, 1.2, relation).ok
    assert not judged("centre_a_w_shift", "a_w_shift", {"a_w_shift": 92e-3, "a_w": 92.1e-3}, "a_w", "equal").ok


def others_of(name: str) -> list[str]:
    return [other for other in BLOCKING if other != name]


@cache
def plane(z_1: float, z_2: float) -> Plane:
    """Return the plane of wheels with some shifts; it keeps what it has traced."""
    return plane_of(complete(madi(z_1=z_1, z_2=z_2, x_1=0.45, x_2=0.45)))


def by_second_route(plane: Plane, places: np.ndarray) -> dict[str, np.ndarray]:
    """Return the functions of the curves from points of flanks and lines; curvatures in millimetres."""
    size = np.ones(places.shape)
    pairs = {name: value * size for name, value in plane.values.items()} | {"x_1": places.real, "x_2": places.imag}
    with np.errstate(invalid="ignore", divide="ignore"):
        own = second_route(pairs)
    found = {"contact_1": own["epsilon_alpha"] - 1.0, "contact_1.2": own["epsilon_alpha"] - 1.2}
    for i in (1, 2):
        found[f"undercut_{i}"] = pairs[f"x_{i}"] - own[f"x_min{i}"]
        found[f"interference_{i}"] = (own[f"rho_p{i}"] - own[f"rho_l{i}"]) * 1e3
        found[f"pointed_{i}"] = own[f"s_a{i}"] * 1e3
        found[f"thin_{i}"] = own[f"s_a{i}"] * 1e3 - 0.3 * plane.values["m"] * 1e3
    return found


@pytest.mark.parametrize(("z_1", "z_2"), WHEELS)
def test_points_of_every_curve_are_on_their_limit(z_1: float, z_2: float) -> None:
    of = plane(z_1, z_2)
    step = abs(of.high - of.low) / CELLS
    for name in CURVES:
        inside = np.concatenate([run[of.permits(run, others_of(name))] for run in of.curves[name]] or [np.empty(0)])
        assert np.max(np.abs(by_second_route(of, inside)[name]), initial=0.0) < 1e-9, name
        for run in of.curves[name]:
            assert np.max(np.abs(np.diff(run)), initial=0.0) < 2.0 * step


@pytest.mark.parametrize(("z_1", "z_2"), WHEELS)
def test_curves_cross_where_both_limits_are_reached_and_sides_of_the_contour_meet_there(z_1: float, z_2: float) -> None:
    of = plane(z_1, z_2)

    corners, sides = of.corners(), of.contour()

    assert len(corners) >= 3
    places = np.array([corner.place for corner in corners])
    around = places[:, np.newaxis] + 1e-3 * np.exp(2j * np.pi * np.arange(90) / 90)
    found, beside = by_second_route(of, places), by_second_route(of, around)
    inside = np.logical_and.reduce([beside[name] > 0.0 for name in BLOCKING])
    ends = np.array([run[k] for _, run in sides for k in (0, -1)])
    for k, corner in enumerate(corners):
        assert abs(found[corner.first][k]) < 1e-8
        assert abs(found[corner.second][k]) < 1e-8
        assert all(found[name][k] > -1e-8 for name in BLOCKING)
        assert 0 < np.count_nonzero(inside[k]) < 90  # the corner of an area
        assert np.any(beside[corner.first][k] < 0.0)
        assert np.any(beside[corner.second][k] < 0.0)
        assert np.count_nonzero(np.abs(ends - corner.place) < 1e-9) == 2
    if z_1 < 20.0:
        assert len(sides) == len(corners)  # a closed contour
    for name, run in sides:
        assert np.all(of.permits(run, others_of(name), 1e-9))


def test_undercut_lines_of_the_project_cross_in_the_least_shifts_and_many_teeth_mesh_beyond_the_pole() -> None:
    of, many = plane_of(madi()), plane_of(complete(madi(z_1=100.0, z_2=120.0, x_1=0.0, x_2=0.0)))
    chosen, beyond = complex(of.values["x_1"], of.values["x_2"]), complex(2.0, -2.2)  # a tip that ends before the pole

    place = next(c.place for c in plane(15.0, 20.0).crossings() if (c.first, c.second) == ("undercut_1", "undercut_2"))

    assert place == pytest.approx(complex(0.1226666617, -0.1697777844), abs=1e-9)
    assert chosen == complex(0.2, 0.85)
    assert bool(of.permits(chosen))
    assert bool(of.permits(chosen, CURVES))
    assert not bool(of.permits(complex(0.2, 1.0), CURVES))  # the contact ratio
    assert bool(many.permits(beyond))
    assert all(limit[0] > 0.0 for limit in by_second_route(many, np.array([beyond])).values())
    assert not bool(many.permits(complex(0.5, -1.5)))


def test_traced_curves_are_exact_cross_in_two_places_and_end_where_they_are_not_defined() -> None:
    def circle(places: np.ndarray) -> np.ndarray:
        return np.abs(places) ** 2 - 1.0

    def slope(places: np.ndarray) -> np.ndarray:
        return np.asarray(places.real - places.imag)

    def half(places: np.ndarray) -> np.ndarray:
        return np.where(places.real > 0.0, circle(places), np.nan)

    round_, straight, arc = (traced(function, -2 - 2j, 2 + 2j, 41) for function in (circle, slope, half))

    (run,), (part,) = round_, arc
    assert run[0] == run[-1]  # closed
    assert np.max(np.abs(np.abs(run) - 1.0)) < 1e-14
    assert abs(np.sum(np.angle(run[1:] / run[:-1]))) == pytest.approx(2.0 * np.pi)
    starts = _near_crossings(round_, straight)
    found = crossings(lambda at: {"circle": circle(at), "slope": slope(at)}, starts, 0.2)
    assert np.sort_complex(found) == pytest.approx(np.array([-1 - 1j, 1 + 1j]) / np.sqrt(2.0), abs=1e-12)
    assert crossings(lambda at: {"circle": circle(at), "slope": slope(at) + 9.0}, starts, 0.2).size == 0
    assert np.all(part.real > -0.1)
    assert part[0] != part[-1]


@pytest.mark.parametrize(("z_1", "z_2"), WHEELS)
def test_permitted_area_is_that_of_the_second_route_and_lies_in_the_window(z_1: float, z_2: float) -> None:
    of = plane(z_1, z_2)
    random = np.random.default_rng(SEED)
    size = of.high - of.low
    places = of.low + size.real * random.random(2000) + 1j * size.imag * random.random(2000)

    found = by_second_route(of, places)

    inside = np.logical_and.reduce([found[name] >= 0.0 for name in BLOCKING])
    assert np.array_equal(of.permits(places), inside)
    assert 0.02 < np.mean(inside) < 0.98
    edge = np.linspace(0.0, 1.0, 201)
    level, upright = edge * size.real, 1j * edge * size.imag
    rim = of.low + np.concatenate((level, level + 1j * size.imag, upright, upright + size.real))
    if z_1 < 20.0:  # one contour, round which the window is
        assert not np.any(of.permits(rim))


def test_saddle_is_traced_as_two_curves() -> None:
    runs = traced(lambda places: np.asarray(places.real * places.imag - 1e-4), -1 - 1j, 1 + 1j, 11)
    assert len(runs) == 2
    assert all(np.max(np.abs(run.real * run.imag - 1e-4)) < 1e-14 for run in runs)


@pytest.mark.parametrize("m", [1e-3, 1e-1])
def test_curves_of_the_contour_are_as_far_in_modules_for_pairs_of_any_module(m: float) -> None:
    places = np.array([0.2 + 0.85j, 0.4 + 0.1j, 1.1 + 0.9j])

    usual, other = (plane_of(complete(madi(**of))).measures(places) for of in ({}, {"m": m}))

    assert {*usual} == {*CURVES}
    assert {name: pytest.approx(measure, abs=1e-9, nan_ok=True) for name, measure in usual.items()} == other
