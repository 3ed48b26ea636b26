"""What is lost by rounding: conditions K by exact derivatives, fifty digits beside every precision, and their bound.

Plans in double precision miss fifty digits by no more than data that err in their last places would: |error| <= 4 eps
(K + 1) times the size that K refers to (of what no plan shows its own magnitude), of every quantity, over the cycle and
on the way to every dead position, limit and change point from 0.1 down to 1e-9 rad.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpc, mpf

from kulman import solve
from kulman.plans.board import Program
from kulman.plans.boards.exact import run
from kulman.plans.boards.precision import DIGITS, batch_in, fifty_digits, run_in
from kulman.plans.condition import _Dual, _sizes_beside, conditions, derivatives, root
from kulman.plans.laws import LAWS, TURN
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.limits import Reach, Swept, reach_of, swept
from kulman.plans.linkages.solved import SolvedLinkage, conditions_of, signs, solve_linkage, varied
from kulman.plans.linkages.strokes import output_motions
from kulman.plans.quantities import plans_of, references, results
from kulman.tests.support.dyads import random_dyads
from kulman.tests.support.mechanisms import SEED, general_slider_crank, nau_slider_crank, nau_values, one_of
from kulman.tests.support.mechanisms import random_slider_cranks as random_cranks
from kulman.variants.shelf import bundled

TASKS = ("nau-slider-crank", "madi-four-bar", "scheme-10-shaper-two-blocks", "scheme-11-slotter")
MORE = [task for task in bundled("mechanism") if task not in TASKS]
EPS = 2.0**-52


def near_the_end(angle: float) -> SolvedLinkage:
    """Return a slider-crank whose rod, shorter than the crank, stands at `angle` to the normal to the guide."""
    phi = math.asin(0.08 * math.cos(angle) / 0.1)
    return solve_linkage(nau_slider_crank(), nau_values(l_OA=0.1, l_AB=0.08, phi=phi))


def standing(of: str | int | float) -> SolvedLinkage:
    """Return a task, a random slider-crank by its number, or one that stands so near a singular position."""
    if isinstance(of, float):
        return near_the_end(of)
    return solve(of).solved if isinstance(of, str) else solve_linkage(general_slider_crank(), one_of(RANDOM, of))


STEP = mpf(10) ** -13  # part of a given, more than a right angle is rounded by; the error of a difference is its square


def differences(
    program: Program, givens: Mapping[str, Any], varied: Iterable[str], names: Iterable[str]
) -> dict[str, list[Any]]:
    """Return x dQ/dx of `names` for every given x of `varied`, by central differences with fifty digits."""
    slopes: dict[str, list[Any]] = {name: [] for name in names}
    with mp.workdps(DIGITS):
        exact = {name: mpf(value) for name, value in givens.items()}
        for given in varied:
            more, less = (
                fifty_digits(program, {**exact, given: exact[given] * factor}) for factor in (1 + STEP, 1 - STEP)
            )
            for name, found in slopes.items():
                found.append((more[name] - less[name]) / (2 * STEP))
    return slopes


RANDOM = random_cranks(SEED, 100)
NEAR = (1e-1, 1e-2, 1e-3, 1e-4)
LONG: list[str | int] = [*MORE, *range(3, 100)]


@pytest.mark.parametrize("of", [*TASKS, *range(3), *NEAR, *(pytest.param(of, marks=pytest.mark.soak) for of in LONG)])
def test_conditions_are_those_of_differences_with_fifty_digits(of: str | int | float) -> None:
    solved = standing(of)
    near = [name for name in varied(solved) if name.startswith("_near_")]  # where a template is guessed to lie
    program, names = solved.program, [name for name in varied(solved) if name not in near]
    sizes, shown, known = references(program, solved.values), plans_of(program), conditions_of(solved)

    ours = derivatives(program, solved.givens, names)
    theirs = differences(program, solved.givens, names, [step.name for step in results(program)])

    assert not any(slopes.any() for slopes in derivatives(program, solved.givens, near).values())
    for name, slopes in theirs.items():
        if name.startswith("delta_"):  # two routes to one value do not differ, whatever is given
            continue
        expected, total = sum(float(abs(slope)) for slope in slopes), float(np.abs(ours[name]).sum())
        if math.isnan(expected):  # the arm of a force that is zero: neither route knows it
            assert math.isnan(total)
            assert np.isnan(solved.values[name])
            continue
        assert abs(total - expected) <= 1e-6 * max(expected, 1e-6 * sizes[name]), name
        size = sizes[name] if name in shown else abs(solved.values[name])
        if known[name].value is not None and size:
            assert known[name].value == pytest.approx(total / size, rel=1e-12), name


def test_condition_and_sine_go_as_they_do_near_a_singular_position() -> None:
    found = [conditions_of(near_the_end(angle))["B"] for angle in (1e-2, 1e-3, 1e-4)]

    first, second, third = (condition.value or 0.0 for condition in found)
    sines = [condition.sine for condition in found]
    assert sines == pytest.approx([math.sin(1e-2), math.sin(1e-3), math.sin(1e-4)], rel=1e-6)
    assert [second / first, third / second] == pytest.approx([10.0, 10.0], rel=0.02)


def test_slopes_are_of_the_degrees_of_mechanics_and_signs_do_not_err() -> None:
    solved = solve("nau-slider-crank", "example").solved
    names = varied(solved)

    slopes = derivatives(solved.program, solved.givens, names)
    by_speed = conditions(solved.program, solved.givens, ("n_1",), solved.values, solved.sines)["V_B"].value

    # v is of the first degree in n_1, a of the second, and by all lengths together v is of the first
    assert slopes["V_B"][names.index("n_1")] == pytest.approx(solved.values["V_B"], rel=1e-12)
    assert slopes["a_B"][names.index("n_1")] == pytest.approx(2.0 * solved.values["a_B"], rel=1e-12)
    lengths = [i for i, name in enumerate(names) if name.startswith("l_")]
    assert sum(slopes["V_B"][lengths]) == pytest.approx(solved.values["V_B"], rel=1e-12)
    assert by_speed == pytest.approx(abs(solved.values["V_B"]) / abs(solved.values["V_A"]), rel=1e-12)
    assert signs(solved.mechanism) & set(solved.givens) != set()
    assert signs(solved.mechanism).isdisjoint(names)


def test_a_root_that_is_zero_has_infinite_slopes_or_none() -> None:
    found = root(_Dual(0.0, np.array([0.0, 2.0])))

    assert (found.value, *found.slopes) == (0.0, 0.0, math.inf)


def test_worst_sine_behind_a_quantity_is_that_of_the_intersections_it_needs() -> None:
    solved = solve("scheme-07-two-stage-compressor").solved
    lost = solve_linkage(nau_slider_crank(), nau_values(l_OA=0.1, l_AB=0.05, phi=1.5))

    known, none = conditions_of(solved), conditions_of(lost)

    assert known["V_A"].sine == 1.0
    assert known["V_C"].sine <= known["V_B"].sine < 1.0
    assert min(item.sine for item in known.values()) == pytest.approx(solved.worst_sine()[1], rel=1e-15)
    assert (none["V_B"].value, none["V_B"].sine) == (None, 0.0)
    assert none["V_A"].value is not None


def test_solve_shows_conditions_when_asked() -> None:
    solution = solve("nau-slider-crank", "example", condition=True)
    item = solution.to_json()["quantities"]["V_B"]

    assert item["condition"] == pytest.approx(conditions_of(solution.solved)["V_B"].value)
    assert item["sine"] == pytest.approx(math.cos(math.asin(50 * math.sin(math.radians(60)) / 130)), rel=1e-12)
    assert "condition" not in solve("nau-slider-crank", "example").to_json()["quantities"]["V_B"]
    row = next(line for line in solution.table("en").splitlines() if line.startswith("V_B "))
    assert row.split()[-4:] == ["K", f"{item['condition']:.3g}", "sin", f"{item['sine']:.3g}"]


SHOWN = [pytest.param(task, marks=[pytest.mark.soak] * (i % 4 > 0)) for i, task in enumerate(bundled("mechanism"))]


@pytest.mark.parametrize("task", SHOWN)
def test_every_quantity_of_every_task_has_a_condition_and_a_sine(task: str) -> None:
    quantities = solve(task, condition=True).to_json()["quantities"]

    largest: dict[str, float] = {}
    for item in quantities.values():
        largest[item["unit"]] = max(largest.get(item["unit"], 0.0), abs(item.get("value") or 0.0))
    for name, item in quantities.items():
        assert 0.0 < item["sine"] <= 1.0, name
        undefined = item.get("value", item.get("x")) is None
        nothing = abs(item.get("value") or 0.0) <= 1e-12 * largest[item["unit"]]
        assert item["condition"] is not None or undefined or nothing, name
        assert item["condition"] is None or (item["condition"] >= 0.0 and not undefined), name
    assert json.loads(json.dumps(quantities, allow_nan=False)) == quantities


def test_the_condition_of_a_calculated_quantity_refers_to_itself_and_rounding_has_none() -> None:
    # the rod hardly speeds up: its moment of inertia forces is nothing beside M_bal, and three of its digits are lost
    solved = solve("scheme-12-shaking-conveyor", "0").solved
    slope = derivatives(solved.program, solved.givens, varied(solved))["M_i4"][varied(solved).index("phi")]
    turned = solve("scheme-12-shaking-conveyor", "0", set={"phi": math.degrees(solved.givens["phi"] * (1 + 1e-7))})
    rounded = solve("scheme-05-articulated-rod", "1", condition=True)

    assert (conditions_of(solved)["M_i4"].value or 0.0) > 1e3
    assert float(turned["M_i4"].value or 0.0) - solved.values["M_i4"] == pytest.approx(1e-7 * slope, rel=1e-3)
    assert 0.0 < abs(rounded["omega_2"].value or 0.0) < 1e-12
    assert rounded.conditions["omega_2"].value is None
    assert rounded.to_json()["quantities"]["omega_2"]["condition"] is None


# Other precisions.
ROUNDING = {"single": 2.0**-23, "double": EPS, "extended": float(np.finfo(np.longdouble).eps)}
KINDS = {
    "single": (np.float32, np.complex64),
    "double": (np.float64, np.complex128),
    "extended": (np.longdouble, np.clongdouble),
}
SAMPLE = ("nau-slider-crank", "scheme-11-slotter", "scheme-20-press-automaton")  # the last has a group of class III


def exactly(value: Any) -> Any:
    """Return a number of any precision as one of mpmath, without rounding."""

    def part(number: Any) -> Any:
        high = float(number)
        return mpf(high) + mpf(float(number - type(number)(high)))

    return value if isinstance(value, (mpf, mpc)) else mpc(part(np.real(value)), part(np.imag(value)))


def largest_miss(solved: SolvedLinkage, values: Mapping[str, Any], right: Mapping[str, Any]) -> float:
    """Return the largest error of all quantities, in parts of the largest vectors beside them."""
    sizes = references(solved.program, solved.values)
    with mp.workdps(50):
        errors = [
            float(abs(exactly(values[step.name]) - right[step.name])) / sizes[step.name]
            for step in results(solved.program)
            if sizes[step.name] and solved.values[step.name] == solved.values[step.name]
        ]
    assert not any(map(math.isnan, errors))
    return max(errors)


@pytest.mark.parametrize("task", SAMPLE)
def test_each_precision_misses_fifty_digits_by_its_own_rounding_alone_and_in_a_batch(task: str) -> None:
    solved = solve(task).solved
    drive = swept(solved.mechanism, solved.givens)
    givens = drive.givens(solved.givens, np.full(3, drive.start))
    here = {name: float(np.ravel(value)[0]) for name, value in givens.items()}
    right, there = run_in(solved.program, solved.givens, "fifty"), run_in(solved.program, here, "fifty")
    for precision, rounding in ROUNDING.items():
        alone = run_in(solved.program, solved.givens, precision)
        found, codes = batch_in(
            solved.program, givens, [step.name for step in results(solved.program)], precision, chunk=2
        )

        assert rounding / 100.0 < largest_miss(solved, alone, right) < 1e3 * rounding, precision
        assert largest_miss(solved, {name: array[0] for name, array in found.items()}, there) < 1e3 * rounding
        kinds = {np.dtype(np.result_type(array)).type for array in found.values()}
        assert kinds == {type(np.ones(1, kind)[0]) for kind in KINDS[precision]}
        assert not codes.any()
        assert all((array == array[0]).all() for array in found.values())


def test_double_precision_is_the_exact_board_and_all_have_the_status_of_a_position_that_fails() -> None:
    solved = solve("nau-slider-crank").solved
    assert run_in(solved.program, solved.givens, "double") == run(solved.program, solved.givens).values

    givens = {**solved.givens, "l_AB": np.array([solved.givens["l_AB"], 1e-3])}
    for precision in KINDS:
        found, codes = batch_in(solved.program, givens, ["V_A", "V_B"], precision)
        assert codes.tolist() == [0, 3]
        assert np.isnan(found["V_B"]).tolist() == [False, True]
        assert not np.isnan(found["V_A"]).any()


# The bound of double precision.
MOST = 4.0
AWAY = tuple(10.0**-power for power in range(1, 10))


@dataclass(frozen=True, slots=True)
class Task:
    """A mechanism ready to be moved through its cycle."""

    drive: Swept
    program: Program
    values: Mapping[str, Any]
    reach: Reach

    def givens(self, place: float) -> dict[str, float]:
        """Return what the board begins with, the driver being at a place."""
        there = self.drive.givens(self.values, np.array([place]))
        return {name: float(np.ravel(value)[0]) for name, value in there.items()}

    def cycle(self, count: int) -> list[float]:
        """Return places around the circle, or within the stretches that the driver can reach."""
        if self.drive.turns:
            return [self.drive.start + TURN * k / count for k in range(count)]
        return [s.low + (s.high - s.low) * (k + 0.5) / count for s in self.reach.stretches for k in range(count)]

    def special(self) -> list[float]:
        """Return dead positions of outputs, limits and change points."""
        dead = {dead.angle for motion in output_motions(self.drive, self.values, self.reach) for dead in motion.dead}
        return sorted(dead.union(self.reach.limits, self.reach.changes))


def task_of(mechanism: Any, values: Mapping[str, Any]) -> Task:
    drive = swept(mechanism, values)
    return Task(drive, construct(drive.mechanism)[1], values, reach_of(drive, values))


def named(name: str) -> Task:
    solved = solve(name).solved
    return task_of(solved.mechanism, solved.givens)


def ratios(task: Task, place: float) -> Iterator[tuple[float, str]]:
    """Go through all quantities of a position: error over what it may be, and the name.

    Left out are arms of forces that are zero but for rounding: these have no line.
    """
    givens = task.givens(place)
    board, right = run(task.program, givens), fifty_digits(task.program, givens)
    fixed = signs(task.drive.mechanism)
    slopes = derivatives(task.program, givens, [name for name, x in givens.items() if name not in fixed and x])
    sizes = _sizes_beside(task.program, board.values)
    bounds: dict[str, float] = {}
    for step in results(task.program):
        value, name = board.values[step.name], step.name
        if step.verb == "arm" and abs(board.values[step.operands[1]]) <= MOST * bounds.get(step.operands[1], 0.0):
            continue
        if value != value:
            assert board.trouble is not None, name
            continue
        bounds[name] = EPS * (float(np.abs(slopes[name]).sum()) + sizes[name])
        if step.law == "difference":  # in per cent: what both values may err by, beside the first of them
            beside = abs(board.values[step.operands[1]])
            bounds[name] += 100.0 * sum(map(bounds.__getitem__, step.operands)) / (beside + (beside == 0.0))
        with mp.workdps(DIGITS):
            error = float(abs(mp.mpmathify(value) - right[name]))
        assert error == error, name
        yield (error / bounds[name] if bounds[name] else math.inf if error else 0.0), name


def worst(task: Task, places: list[float]) -> tuple[float, str, float]:
    """Return the worst ratio of all quantities at some places, the quantity and the place."""
    found = [(*ratio, place) for place in places for ratio in ratios(task, place)]
    assert len(found) > len(places)
    return max(found)


@pytest.mark.parametrize("name", SAMPLE)
def test_plans_err_no_more_than_their_data_over_a_sample_of_the_cycle(name: str) -> None:
    task = named(name)
    dead = task.special()[0]

    assert worst(task, [*task.cycle(6), *(dead + away for away in (1e-2, -1e-5, 1e-9))])[0] <= MOST


@pytest.mark.soak
@pytest.mark.parametrize("name", sorted(bundled("mechanism")))
def test_plans_err_no_more_than_their_data(name: str) -> None:
    task = named(name)
    near = [place + away for place in task.special() for step in AWAY for away in (step, -step)]

    ratio, quantity, place = worst(task, [*task.cycle(72), *near])

    assert ratio <= MOST, (quantity, place)


DYADS: list[tuple[str, tuple[int, int], tuple[bool, ...]]] = [
    *(("RRR", (2, 3), ()), ("RRP", (2, 3), (False,)), ("RRP", (2, 1), (True,)), ("RPR", (2, 3), (False,))),
    *(("RPR", (2, 1), (True,)), ("PRP", (2, 3), (False, True)), ("RPP", (2, 3), (False, False))),
]


@pytest.mark.parametrize("limits", [False, pytest.param(True, marks=pytest.mark.soak)], ids=["here", "limits"])
@pytest.mark.parametrize(("kind", "before", "carries"), DYADS)
def test_dyads_err_no_more_than_their_data_also_beside_their_limits(
    kind: str, before: tuple[int, int], carries: tuple[bool, ...], limits: bool
) -> None:
    mechanism, values, _ = random_dyads(kind, before, carries, seed=7, count=1)
    task = task_of(mechanism, one_of(values, 0))
    near = [place + away for place in task.reach.limits for step in AWAY for away in (step, -step)]

    ratio, quantity, place = worst(task, [task.drive.start, *(near if limits else ())])

    assert ratio <= MOST, (quantity, place)


def test_a_plan_without_a_few_digits_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    task = named("nau-slider-crank")
    assert worst(task, [1.0])[0] <= MOST

    exact = LAWS["normal_part"]
    right = fifty_digits(task.program, task.givens(1.0))
    monkeypatch.setitem(globals(), "fifty_digits", lambda program, givens: right)
    monkeypatch.setitem(LAWS, "normal_part", lambda v, length: exact(v, length) * (1.0 + 2.0**-42))

    assert worst(task, [1.0])[0] > MOST
