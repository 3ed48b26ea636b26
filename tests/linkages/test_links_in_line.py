"""Laws where links come into line: they keep their lengths, statuses turn within rounding, alone as together."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from kulman.plans.boards.batch import batch
from kulman.plans.boards.exact import STATUSES, run
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import Driver, Link, Mechanism, Prismatic, Revolute
from kulman.plans.linkages.solved import board_givens
from kulman.tests.support.mechanisms import ORIGIN, SEED

Array = NDArray[Any]
ZERO = "zero"
COUNTS = [400, pytest.param(10_000, marks=pytest.mark.soak)]
CRANK = Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)})
DRIVER = Driver(1, "O", "A", "phi", "n_1", "sense_1")
FOUR_BAR = Mechanism(
    (CRANK, Link(2, {"A": ORIGIN, "B": ("l_AB", ZERO)}), Link(3, {"C": ORIGIN, "B": ("l_CB", ZERO)})),
    (
        Revolute("O", (0, 1), ("x_O", "y_O")),
        Revolute("A", (1, 2)),
        Revolute("B", (2, 3), None, "branch"),
        Revolute("C", (3, 0), ("x_C", "y_C")),
    ),
    DRIVER,
)
SLOTTED = Mechanism(
    (CRANK, Link(2, {"A": ORIGIN}), Link(3, {"C": ORIGIN, "D": ("l_CB", ZERO)})),
    (
        Revolute("O", (0, 1), ("x_O", "y_O")),
        Revolute("A", (1, 2)),
        Prismatic("A", (2, 3), ORIGIN, ZERO, "e", "branch"),
        Revolute("C", (3, 0), ("x_C", "y_C")),
    ),
    DRIVER,
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


def solved(mechanism: Mechanism, values: dict[str, Array]) -> tuple[dict[str, Array], list[str]]:
    _, program = construct(mechanism, ("velocity",))
    results, codes = batch(program, board_givens(mechanism, values), program.names)
    return results, [STATUSES[code] for code in codes]


def alone(mechanism: Mechanism, values: dict[str, Array], index: int) -> str:
    _, program = construct(mechanism, ("velocity",))
    return run(program, board_givens(mechanism, {name: float(array[index]) for name, array in values.items()})).status


@pytest.mark.parametrize("count", COUNTS)
def test_links_in_line_but_for_rounding_are_singular_and_keep_their_lengths(count: int) -> None:
    values = nearly_flat(count, np.zeros(count))

    results, statuses = solved(FOUR_BAR, values)

    # A itself is rounded as the way to it was: where OA and O cancel, that is more than its own coordinates show
    assert statuses.count("singular") >= 0.999 * count
    held = np.array([status == "singular" for status in statuses])
    sizes = sum(abs(values[name]) for name in ("x_O", "y_O", "x_C", "y_C", "l_OA", "l_AB", "l_CB"))[held]
    for start, length in (("A", "l_AB"), ("C", "l_CB")):
        gap = abs(abs(results["B"] - results[start])[held] - values[length][held])
        assert np.max(gap / sizes) < 1e-14
    assert np.isnan(results["V_B"][held]).all()


@pytest.mark.parametrize("power", range(4, 16))
def test_links_keep_their_lengths_on_the_way_into_line(power: int) -> None:
    count = 200
    random = np.random.default_rng(power)
    values = nearly_flat(count, random.choice([-1.0, 1.0], count) * 10.0**-power)

    results, statuses = solved(FOUR_BAR, values)

    held = np.array([status != "no-assembly" for status in statuses])
    sizes = sum(abs(values[name]) for name in ("x_O", "y_O", "x_C", "y_C", "l_OA", "l_AB", "l_CB"))[held]
    assert 0.2 * count < held.sum()
    for start, length in (("A", "l_AB"), ("C", "l_CB")):
        assert np.max(abs(abs(results["B"] - results[start])[held] - values[length][held]) / sizes) < 1e-14
    lost = np.isnan(results["V_B"])
    assert (lost == [status in ("singular", "no-assembly") for status in statuses]).all()


def test_statuses_of_links_in_line_are_the_same_alone_and_together() -> None:
    offs = np.concatenate([sign * 10.0 ** -np.arange(2.0, 17.0, 0.5) for sign in (-1.0, 1.0)])
    values = nearly_flat(len(offs), offs)

    _, statuses = solved(FOUR_BAR, values)

    assert [alone(FOUR_BAR, values, i) for i in range(len(offs))] == statuses
    assert set(statuses) == set(STATUSES)


@pytest.mark.parametrize("count", COUNTS)
def test_block_at_the_pivot_is_singular_and_ill_conditioned_near_it(count: int) -> None:
    values, A, _ = random_places(count)
    sizes = np.max([abs(values[name]) for name in ("x_O", "y_O", "l_OA", "l_CB")], axis=0)
    expected = {0.0: {"singular"}, 1e-14: {"singular"}, 1e-11: {"ill-conditioned"}, 1e-4: {"ill-conditioned"}}
    for off, known in {**expected, 1e-2: {"ok"}}.items():
        C = A + off * sizes * 1j
        there = values | {"x_C": C.real, "y_C": C.imag}

        results, statuses = solved(SLOTTED, there)

        assert set(statuses) == known, off
        assert np.isnan(results["omega_3"]).all() == (known == {"singular"})
        assert all(alone(SLOTTED, there, i) == statuses[i] for i in range(0, count, count // 10))


def test_pins_that_coincide_but_for_rounding_settle_no_direction() -> None:
    count = 300
    values, A, _ = random_places(count)
    there = values | {"x_C": A.real, "y_C": A.imag, "l_AB": np.full(count, 0.5)}

    results, statuses = solved(FOUR_BAR, there)

    assert set(statuses) == {"singular"}
    assert np.isnan(results["B"]).all()
    assert [alone(FOUR_BAR, there, i) for i in range(0, count, 30)] == ["singular"] * 10
