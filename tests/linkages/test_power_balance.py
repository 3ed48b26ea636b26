"""Power balance over the cycle of every bundled task: loads, weights, inertia and the drive together do no work.

A second route to the balancing moment or force: no reaction, no arm and no plan of forces comes into it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from kulman.plans.boards.batch import batch
from kulman.plans.linkages.chain import construct, moving_bodies
from kulman.plans.linkages.limits import swept
from kulman.plans.linkages.mechanism import FORCE, Driver, Link, Mechanism
from kulman.plans.linkages.solved import board_givens
from kulman.variants.reader import load_task
from kulman.variants.shelf import bundled, summary
from kulman.variants.task import Task

POSITIONS = 96
FORCED = [name for name in bundled("mechanism") if "forces" in summary(name)["plans"]]


class Powers:
    """Powers of everything that acts on one variant of a task, over the cycle, each of shape (N,)."""

    def __init__(self, task: Task, variant: str) -> None:
        mechanism, values = task.mechanism, task.values(variant)
        drive = swept(mechanism, values)
        self.mechanism: Mechanism = drive.mechanism
        structure, program = construct(self.mechanism, ("forces", "lever"))
        self.bodies = moving_bodies(self.mechanism, structure)
        turn = np.linspace(0.0, 2.0 * np.pi, POSITIONS, endpoint=False) + 0.01
        places = turn if drive.turns else drive.start * (1.0 + 0.001 * np.sin(turn))
        self.givens = board_givens(drive.mechanism, drive.givens(values, places), program, follow=False)
        wanted = [name for name in program.names if not name.startswith("forces_")]
        self.found, self.codes = batch(program, self.givens, wanted)

    def number(self, name: str) -> Any:
        """A given, or what the program has made of givens."""
        return self.found.get(name, self.givens.get(name))

    def still(self, point: str) -> bool:
        return point in self.mechanism.frame_points

    def of_force(self, force: Any, point: str) -> NDArray[Any]:
        v = 0j if self.still(point) else self.found[self.mechanism.mark("velocity", point)]
        return np.real(np.conj(force) * v) + np.zeros(POSITIONS)

    def of_moment(self, moment: Any, link: int) -> NDArray[Any]:
        omega = self.bodies[link].omega
        return moment * (self.found[omega] if omega else 0.0) + np.zeros(POSITIONS)

    def of_mass(self, link: Link) -> list[NDArray[Any]]:
        """Inertia and weight of a link, from its motion alone."""
        powers, centre, epsilon = [], str(link.centre), self.bodies[link.number].epsilon
        if link.mass and not self.still(centre):
            mass, a = self.number(link.mass), self.found[self.mechanism.mark("acceleration", centre)]
            weight = self.number(self.mechanism.gravity) if self.mechanism.gravity else 0.0
            powers = [self.of_force(-mass * a, centre), self.of_force(-1j * mass * weight, centre)]
        if link.inertia and epsilon:
            powers.append(self.of_moment(-self.number(link.inertia) * self.found[epsilon], link.number))
        return powers

    def of_drive(self, lever: bool) -> NDArray[Any]:
        driver, end = self.mechanism.driver, "_lever" if lever else ""
        if isinstance(driver, Driver) and driver.balance != FORCE:
            return self.of_moment(self.found[f"M_bal{end}"], driver.link)
        # along the normal to the crank, or along the guide: so is the velocity of the point
        size = self.found[f"_V_{driver.point}"]
        return np.asarray(self.found[f"F_bal{end}"] * size)

    def all_but_the_drive(self) -> list[NDArray[Any]]:
        powers = [self.of_force(self.found[load.name], load.point) for load in self.mechanism.loads]
        powers += [self.of_moment(self.found[couple.name], couple.link) for couple in self.mechanism.couples]
        return powers + [power for link in self.mechanism.links for power in self.of_mass(link)]


@pytest.mark.parametrize(
    ("name", "step"),
    [*((name, 9) for name in FORCED[::2]), *(pytest.param(name, 1, marks=pytest.mark.soak) for name in FORCED)],
)
def test_powers_add_up_to_nothing_over_the_cycle(name: str, step: int) -> None:
    task = load_task(name)

    for variant in [*task.variants][::step]:
        powers = Powers(task, variant)
        others = powers.all_but_the_drive()
        for lever in (False, True):
            terms = np.array([*others, powers.of_drive(lever)])
            whole = np.isfinite(terms).all(axis=0)
            assert np.array_equal(whole, powers.codes < 2), variant  # "ok" or "ill-conditioned"
            assert whole.any(), variant
            largest = np.abs(terms[:, whole]).max()
            assert np.abs(terms[:, whole].sum(axis=0)).max() <= 1e-11 * largest, (variant, lever)


def test_a_wrong_force_is_noticed() -> None:
    powers = Powers(load_task("nau-slider-crank"), "example")

    wrong = [*powers.all_but_the_drive(), powers.of_drive(False) * (1.0 + 1e-9)]

    assert np.abs(np.sum(wrong, axis=0)).max() > 1e-11 * np.abs(wrong).max()
