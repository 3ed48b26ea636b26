"""Special positions: status, reason, what remains defined, limits from both sides, what is zero, links in line."""

from __future__ import annotations

import cmath
import json
import math
import re
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from kulman.plans.board import Program
from kulman.plans.boards.arrays import ArrayBoard
from kulman.plans.boards.batch import batch
from kulman.plans.boards.exact import STATUSES, ExactBoard, run
from kulman.plans.boards.precision import fifty_digits
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import ZERO, Mechanism, Prismatic
from kulman.plans.linkages.solved import SolvedLinkage, board_givens, conditions_of, solve_linkage
from kulman.plans.quantities import references
from kulman.scales.errors import LANGUAGES, RAISED
from kulman.tests.linkages.test_second_solver import differing, quantities
from kulman.tests.support.commands import Run
from kulman.tests.support.mechanisms import (
    CRANK,
    ORIGIN,
    SEED,
    SIDES,
    bodies,
    general_slider_crank,
    nau_slider_crank,
    nau_values,
    one_of,
    pins,
    random_slider_cranks,
    solved,
)
from kulman.tests.support.second_solver import SecondSolver
from kulman.tests.support.singular_cases import CASES, EVERYTHING, Case, Limit, limits

Array = NDArray[Any]
EPS = 2.0**-52
BESIDE = (0.0, 0.1, -0.1, 0.0)  # radians or metres from the position to others of the same batch
ARMS = ("h_", "delta_")  # of a force that vanishes any arm will do; of two values that vanish there is no ratio
SLOW = {"triad a billionth of a radian before", "triad a billionth of a radian beyond"}  # searched for so near


@cache
def standing(case: Case) -> SolvedLinkage:
    return solve_linkage(case.of, case.values)


@cache
def tends(case: Case) -> dict[str, Limit]:
    return limits(standing(case), case.along, case.exact)


@pytest.mark.parametrize(
    "case", [pytest.param(case, marks=[pytest.mark.soak] * (case.name in SLOW), id=str(case)) for case in CASES]
)
def test_status_is_as_expected_alone_and_in_a_batch(case: Case) -> None:
    # groups of class III are followed to each place, which takes its time
    places = [case.values[case.along] + off * (not case.of.starts) for off in BESIDE]
    mechanism, program = standing(case).mechanism, standing(case).program

    givens = board_givens(mechanism, {**case.values, case.along: np.array(places)}, program)
    results, codes = batch(program, givens, program.names)

    assert standing(case).status == case.status == STATUSES[codes[0]] == STATUSES[codes[3]]
    for k, place in enumerate(places):
        beside = place != case.values[case.along]
        alone = solve_linkage(case.of, {**case.values, case.along: place}) if beside else standing(case)
        assert alone.status == STATUSES[codes[k]]
        if alone.mechanism == mechanism:  # moments may be taken about another joint elsewhere
            assert [n for n in results if not np.array_equal(results[n][k], alone.values[n], equal_nan=True)] == []


def raised(text: str) -> str:
    """Return a number with an exponent, 5e-08, as messages write it."""
    found = re.fullmatch(r"(\d)e-0?(\d+)", text)
    return f"{found[1]}·10⁻{found[2].translate(RAISED)}" if found else text


@pytest.mark.parametrize("case", CASES, ids=str)
def test_reason_names_lines_and_points_and_what_is_lost_is_undefined(case: Case) -> None:
    found, error = standing(case), standing(case).error()
    gone = {name for name, item in found.quantities.items() if item.value is None and item.x is None}

    assert (error is None) == (case.says is None) == (case.status in ("ok", "ill-conditioned")) == (not gone)
    if error is not None and case.says is not None:
        key, named = case.says
        assert (error.key, error.status_word, error.status) == (key, case.status, 3)
        assert {name: error.data[name] for name in named} == named
        assert all(raised(str(value)) in error.text(language) for language in LANGUAGES for value in named.values())
    assert set(case.lost.split()) <= gone
    assert set(case.kept.split()) <= found.quantities.keys() - gone
    for item in found.quantities.values():
        assert all(math.isfinite(part) for part in (item.value, item.x, item.y) if part is not None)


@pytest.mark.parametrize("case", [case for case in CASES if case.status in ("ok", "singular")], ids=str)
def test_what_is_defined_is_the_limit_from_both_sides_and_what_is_lost_has_none(case: Case) -> None:
    found = standing(case)
    sizes = references(found.program, found.values)
    wrong, hidden = {}, set()
    for name, limit in tends(case).items():
        value = found.values[name]
        # where there is only one side, what is left of the way is 1e-9
        allowed = (1e-12 if limit.below is not None and limit.above is not None else 1e-9) * max(sizes[name], 1.0)
        if cmath.isnan(value):
            hidden |= {name} if abs(limit.value or 0.0) > 1e-12 else set()
        elif limit.value is None or abs(value - limit.value) > allowed:
            wrong[name] = (value, limit)

    assert {name: pair for name, pair in wrong.items() if not name.startswith(ARMS)} == {}
    if case.hidden != EVERYTHING:
        assert [name for name in hidden if not name.startswith(ARMS) and name not in case.hidden.split()] == []


@pytest.mark.parametrize("case", [case for case in CASES if case.limits], ids=str)
def test_limits_are_those_of_geometry(case: Case) -> None:
    found = standing(case)
    sizes = references(found.program, found.values)
    for name, expected in case.limits.items():
        limit = tends(case)[name]

        if math.isnan(expected):
            assert limit.value is None, name
            assert cmath.isnan(found.values[name]), name
        else:
            assert limit.value is not None, name
            size = abs(limit.value) if isinstance(found.values[name], complex) else limit.value.real
            assert size == pytest.approx(expected, rel=1e-12, abs=1e-12 * max(sizes[name], 1.0)), name


@pytest.mark.parametrize("case", [case for case in CASES if case.status == "ill-conditioned"], ids=str)
def test_ill_conditioned_positions_err_by_no_more_than_their_condition_says(case: Case) -> None:
    found = standing(case)
    exact = fifty_digits(found.program, found.givens)
    sizes, known = references(found.program, found.values), conditions_of(found)

    for name, size in sizes.items():
        condition = known[name].value
        if condition is not None and not name.startswith(ARMS):
            miss = abs(complex(exact[name] - found.values[name]))
            assert miss <= 8.0 * EPS * (condition + 1.0) * size, (name, miss / size, condition)
    assert min(item.sine for item in known.values()) < 1e-3


COMMANDS = {
    "ok": ("nau-slider-crank --set phi=0", "V_B", None),
    "ill-conditioned": ("nau-slider-crank --set phi=90 --set l_OA=50 --set l_AB=50,000001", "V_B", None),
    "singular": ("madi-four-bar --set phi=180 --set l_AB=120 --set l_BC=390 --set l_DC=240", "V_C", "⊥BC"),
    "singular pins": ("madi-four-bar --set phi=0 --set l_AB=510 --set l_BC=380", "V_C", "B"),
    "no-assembly": ("nau-slider-crank --set phi=90 --set l_OA=50 --set l_AB=49,999999", "B", "1·10⁻⁶ mm"),
    "no-assembly slide": ("scheme-18-hydraulic-drive --set s=-40 --set l_AB=200", "V_B", "mm"),
}


@pytest.mark.parametrize("kind", COMMANDS)
def test_the_command_line_tells_status_and_cause(kind: str, run: Run) -> None:
    command, name, cause = COMMANDS[kind]

    status, out, err = run("solve", *command.split(), "--json")

    found = json.loads(out)
    parts = [found["quantities"][name].get(part) for part in ("value", "x", "y")]
    assert found["status"] == kind.partition(" ")[0]
    assert status == (0 if cause is None else 3)
    assert (parts == [None] * 3) == (cause is not None)
    assert (cause or "") in err
    assert found["quantities"]["omega_1" if "omega_1" in found["quantities"] else "V_A"]["value"] is not None


# A slider-crank at and near the multiples of 90 degrees.
NAU = nau_slider_crank()
_, PROGRAM = construct(NAU)
IN_LINE = [
    "V_B",
    "a_BA_t",
    "epsilon_2",
    "M_i2",
    "h_2",
    "R_12_t",
    "R_03",
    "h_03",
    "h_21",
    "M_bal",
    "M_bal_lever",
    "F_bal",
]
UPRIGHT = ["V_BA", "omega_2", "a_BA_n"]


def undefined(program: Program, values: Any) -> set[str]:
    return {name for name in program.names if np.isnan(values[name])}


@pytest.mark.parametrize("gamma", [0, 90, 180, 270, -90])
@pytest.mark.parametrize("degrees", [0, 90, 180, 270, 360, -90, 450])
def test_what_geometry_says_is_zero_is_exactly_zero(degrees: float, gamma: float) -> None:
    mechanism = general_slider_crank()
    _, program = construct(mechanism)
    others = ["x_O", "y_O", "x_g", "y_g", "e", "m_1", "F_1", "F_C", "F_B", "alpha_F1", "alpha_FC", "alpha_FB"]
    for side, variant in ((side, variant) for side in SIDES for variant in ("0", "5", "example")):
        load = math.radians(gamma + (180 if side == "right" else 0))
        values = {
            **dict.fromkeys(others, 0.0),
            **nau_values(variant, side, phi=math.radians(degrees + gamma)),
            "l_AC": 0.1,
        }
        board = run(program, board_givens(mechanism, {**values, "gamma": math.radians(gamma), "alpha_F3": load}))

        exact = UPRIGHT if degrees % 180 else IN_LINE
        assert {name: board.values[name] for name in exact if abs(board.values[name]) > 0} == {}
        assert undefined(program, board.values) == set()
        assert board.status == "ok"


@pytest.mark.parametrize("degrees", [0, 90])
def test_what_geometry_says_is_zero_is_exactly_zero_for_any_lengths(degrees: float) -> None:
    random = np.random.default_rng(90)
    l_OA = 10 ** random.uniform(-2, 0, 500)
    values: dict[str, Any] = {name: np.full(500, x) for name, x in nau_values(phi=math.radians(degrees)).items()}
    values |= {"l_OA": l_OA, "l_AB": l_OA * random.uniform(1.1, 5, 500), "l_AS2": l_OA * random.uniform(0.1, 1, 500)}

    mechanisms = solved(NAU, values)

    for name in UPRIGHT if degrees else ("V_B", "R_03", "epsilon_2", "M_bal_lever", "h_03"):
        assert not mechanisms[name].any(), name


@pytest.mark.parametrize("offset", [1e-3, -1e-6, 1e-9, -1e-12])
@pytest.mark.parametrize("degrees", [0, 90, 180, 270])
def test_positions_near_a_right_angle_agree_with_the_second_solver(degrees: float, offset: float) -> None:
    for side in SIDES:
        values = nau_values("example", side, phi=math.radians(degrees) + offset)

        board = run(PROGRAM, board_givens(NAU, values))

        names = [name for name in quantities(PROGRAM) if name != "delta_M_bal"]  # of two moments that nearly vanish
        assert board.status == "ok"
        assert differing(board, SecondSolver(NAU, values), names, 1e-11) == {}
        assert abs(board.values["V_BA" if degrees % 180 else "V_B"]) > 0


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize(("l_AB", "degrees", "failed"), [(0.04, 60, "B"), (0.04, -60, "B"), (0.05, 90, "velocity.B")])
def test_what_hangs_on_a_step_that_fails_is_lost_and_nothing_else(
    l_AB: float, degrees: float, failed: str, side: str
) -> None:
    givens = board_givens(NAU, nau_values(side=side, phi=math.radians(degrees), l_AB=l_AB))
    hanging = {failed}
    for step in PROGRAM:
        hanging |= {step.name} if hanging & set(step.operands) else set()

    board = run(PROGRAM, givens)
    longer = run(PROGRAM, {**givens, "l_AB": 0.13})

    assert board.trouble is not None
    assert (board.status, board.trouble.name) == ("no-assembly" if failed == "B" else "singular", failed)
    assert board.trouble.gap == pytest.approx(
        0.05 * math.sin(math.radians(60)) - 0.04 if failed == "B" else 0.0, rel=1e-13
    )
    assert abs(board.trouble.sine) < 1e-13
    assert undefined(PROGRAM, board.values) == hanging
    for name in ("O", "A", "e_OA", "V_A", "velocity.A", "a_A", "omega_1", "F_3", "u_30", "lever.A"):
        assert board.values[name] == longer.values[name]


THRESHOLDS = {1e-3: "ok", 0.6e-6: "ok", 0.4e-6: "ill-conditioned", 1e-7: "ill-conditioned", 1e-14: "ill-conditioned"}
THRESHOLDS |= {0.0: "singular", -1e-14: "no-assembly"}


def test_status_turns_where_its_threshold_says() -> None:
    parts = np.array([*THRESHOLDS])
    values = nau_values(phi=math.radians(90))
    boards = [run(PROGRAM, board_givens(NAU, {**values, "l_AB": 0.05 * (1 + part)})) for part in THRESHOLDS]
    mechanisms = solved(NAU, {**{n: np.full(7, x) for n, x in values.items()}, "l_AB": 0.05 * (1 + parts)})

    assert [board.status for board in boards] == [STATUSES[c] for c in mechanisms.codes] == [*THRESHOLDS.values()]
    assert min(boards[3].sines.values()) == pytest.approx(math.sqrt(1 - (1 + 1e-7) ** -2), rel=1e-6)


def test_statuses_agree_within_ulps_of_every_threshold() -> None:
    mechanism, thresholds = general_slider_crank(), (1.0, math.sqrt(1 - 1e-6))
    _, program = construct(mechanism)
    for index in range(6):
        one = one_of(random_slider_cranks(12, 6), index)
        board = run(program, board_givens(mechanism, one))
        distance = abs((board.values["u_30"].conjugate() * (board.values["A"] - board.values["_u_30_origin_B"])).imag)
        steps = np.arange(-30, 31) * 2.0**-53
        l_AB = np.concatenate([distance / threshold * (1 + steps) for threshold in thresholds])
        values = {**{name: np.full(l_AB.shape, value) for name, value in one.items()}, "l_AB": l_AB}

        mechanisms = solved(mechanism, values)

        statuses = [run(program, board_givens(mechanism, one_of(values, i))).status for i in range(len(l_AB))]
        assert statuses == [STATUSES[code] for code in mechanisms.codes]
        assert len(set(statuses)) >= 3


@pytest.mark.parametrize(
    ("moment", "force", "arm"),
    [
        pytest.param(-6.0, 3j, 2.0, id="a force off the point"),
        pytest.param(0.0, 3j, 0.0, id="a force through the point"),
        pytest.param(0.0, 0j, 0.0, id="nothing"),
        pytest.param(6.0, 0j, math.nan, id="a couple, which has no arm"),
    ],
)
def test_arm_is_that_of_one_force(moment: float, force: complex, arm: float) -> None:
    one, many = ExactBoard({"M": moment, "F": force}), ArrayBoard({"M": np.array([moment]), "F": np.array([force])}, 1)

    one.step("arm", "h", "M", "F")
    with np.errstate(invalid="ignore", divide="ignore"):
        many.step("arm", "h", "M", "F")

    assert [one.values["h"], many.values["h"][0]] == pytest.approx([arm, arm], rel=1e-15, nan_ok=True)


def test_what_bears_no_load_has_no_arms_and_needs_no_balancing() -> None:
    idle = run(PROGRAM, board_givens(NAU, nau_values(F_3=0.0, m_3=0.0)))
    massless = run(PROGRAM, board_givens(NAU, nau_values(F_3=0.0, m_2=0.0, m_3=0.0, J_S2=0.0)))

    assert idle.status == "ok"
    assert undefined(PROGRAM, idle.values) == undefined(PROGRAM, massless.values) == set()
    assert idle.values["F_3"] == idle.values["F_i3"] == 0
    nothing = ("R_12", "R_03", "R_01", "M_bal", "M_bal_lever", "delta_M_bal")
    assert [massless.values[name] for name in nothing] == [0] * 6


# Random links that come into line, or nearly.
COUNTS = [400, pytest.param(10_000, marks=pytest.mark.soak)]
FOUR_BAR = Mechanism(bodies("O A:l_OA", "A B:l_AB", "C B:l_CB"), pins("O01@x_O,y_O A12 B23:branch C30@x_C,y_C"), CRANK)
SLOTTED = Mechanism(
    bodies("O A:l_OA", "A", "C D:l_CB"),
    (*pins("O01@x_O,y_O A12 C30@x_C,y_C"), Prismatic("A", (2, 3), ORIGIN, ZERO, "e", "branch")),
    CRANK,
)


def random_places(count: int) -> tuple[dict[str, Array], Array, Array]:
    """Return values of cranks and pivots anywhere, near the origin or far from it, with the places of A and C."""
    random = np.random.default_rng(SEED)
    far = 10.0 ** random.uniform(-1.0, 1.0, count)
    x_O, y_O, x_C, y_C = (far * random.uniform(-1.0, 1.0, count) for _ in range(4))
    l_OA, phi = 10.0 ** random.uniform(-1.0, 0.0, count), random.uniform(-7.0, 7.0, count)
    values = {"x_O": x_O, "y_O": y_O, "x_C": x_C, "y_C": y_C, "l_OA": l_OA, "phi": phi}
    values |= {"n_1": np.full(count, 3.0), "sense_1": random.choice([-1.0, 1.0], count)}
    values |= {"branch": random.choice([-1.0, 1.0], count), "l_CB": np.full(count, 0.5), "e": np.zeros(count)}
    return values, x_O + 1j * y_O + l_OA * np.exp(1j * phi), x_C + 1j * y_C


def nearly_flat(count: int, offs: Array) -> dict[str, Array]:
    """Return four-bars with AB and CB in line, stretched or folded, but for the parts `offs` of CA."""
    values, A, C = random_places(count)
    random = np.random.default_rng(SEED + 1)
    base, part = abs(C - A), random.uniform(0.1, 0.9, count)
    folded = random.random(count) < 0.5
    l_AB = np.where(folded, base * (1.0 + part), base * part)
    return values | {"l_AB": l_AB, "l_CB": np.where(folded, l_AB - base, base - l_AB) * (1.0 + offs)}


def together(mechanism: Mechanism, values: dict[str, Array]) -> tuple[dict[str, Array], Array]:
    """Solve all positions at once; return values and statuses."""
    _, program = construct(mechanism, ("velocity",))
    results, codes = batch(program, board_givens(mechanism, values), program.names)
    return results, np.array(STATUSES)[codes]


def alone(mechanism: Mechanism, values: dict[str, Array], step: int = 1) -> list[str]:
    _, program = construct(mechanism, ("velocity",))
    ones = (one_of(values, i) for i in range(0, len(values["phi"]), step))
    return [run(program, board_givens(mechanism, one)).status for one in ones]


def stretched(values: dict[str, Array], results: dict[str, Array]) -> Array:
    """Return by how much the coupler or the rocker misses its length, in parts of all that B hangs on."""
    sizes = sum(abs(values[name]) for name in ("x_O", "y_O", "x_C", "y_C", "l_OA", "l_AB", "l_CB"))
    ways = [abs(abs(results["B"] - results[start]) - values[f"l_{start}B"]) for start in "AC"]
    return np.asarray(np.max(ways, axis=0) / sizes)


@pytest.mark.parametrize("count", COUNTS)
def test_links_in_line_but_for_rounding_are_singular_and_keep_their_lengths(count: int) -> None:
    values = nearly_flat(count, np.zeros(count))

    results, statuses = together(FOUR_BAR, values)

    # A itself is rounded as the way to it was: where OA and O cancel, that is more than its own coordinates show
    held = statuses == "singular"
    assert held.sum() >= 0.999 * count
    assert np.max(stretched(values, results)[held]) < 1e-14
    assert np.isnan(results["V_B"][held]).all()


@pytest.mark.parametrize("power", range(4, 16))
def test_links_keep_their_lengths_on_the_way_into_line(power: int) -> None:
    random = np.random.default_rng(power)
    values = nearly_flat(200, random.choice([-1.0, 1.0], 200) * 10.0**-power)

    results, statuses = together(FOUR_BAR, values)

    held = statuses != "no-assembly"
    assert held.sum() > 40
    assert np.max(stretched(values, results)[held]) < 1e-14
    assert np.array_equal(np.isnan(results["V_B"]), np.isin(statuses, ("singular", "no-assembly")))


def test_statuses_of_links_in_line_are_the_same_alone_and_together_and_of_any_size() -> None:
    offs = np.concatenate([sign * 10.0 ** -np.arange(2.0, 17.0, 0.5) for sign in (-1.0, 1.0)])
    values = nearly_flat(len(offs), offs)

    _, statuses = together(FOUR_BAR, values)

    assert alone(FOUR_BAR, values) == statuses.tolist()
    assert set(statuses) == set(STATUSES)
    for size in (2.0**-20, 2.0**20):  # micrometres or a thousand kilometres: nothing is rounded otherwise
        lengths = {name: size * value for name, value in values.items() if name.startswith(("l_", "x_", "y_"))}
        assert alone(FOUR_BAR, values | lengths) == statuses.tolist()
        assert together(FOUR_BAR, values | lengths)[1].tolist() == statuses.tolist()


@pytest.mark.parametrize("count", COUNTS)
def test_block_at_the_pivot_is_singular_and_ill_conditioned_near_it(count: int) -> None:
    values, A, _ = random_places(count)
    sizes = np.max([abs(values[name]) for name in ("x_O", "y_O", "l_OA", "l_CB")], axis=0)
    expected = {0.0: "singular", 1e-14: "singular", 1e-11: "ill-conditioned", 1e-4: "ill-conditioned", 1e-2: "ok"}
    for off, status in expected.items():
        C = A + off * sizes * 1j
        there = values | {"x_C": C.real, "y_C": C.imag}

        results, statuses = together(SLOTTED, there)

        assert set(statuses) == {status}, off
        assert np.isnan(results["omega_3"]).all() == (status == "singular")
        assert {*alone(SLOTTED, there, count // 10)} == {status}


def test_pins_that_coincide_but_for_rounding_settle_no_direction() -> None:
    values, A, _ = random_places(300)
    there = values | {"x_C": A.real, "y_C": A.imag, "l_AB": np.full(300, 0.5)}

    results, statuses = together(FOUR_BAR, there)

    assert set(statuses) == {"singular"} == {*alone(FOUR_BAR, there, 30)}
    assert np.isnan(results["B"]).all()
