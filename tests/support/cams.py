"""Random motions of cams of mixed laws, and cams that belong to them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from kulman.plans.cams.cam import LAWS, ORDERS
from kulman.plans.cams.followers import Limits, Rocker, RollerProfile, Sizes, Straight
from kulman.plans.cams.laws_of_motion import UNIFORM, law_of_motion
from kulman.plans.cams.motion import Motion
from kulman.plans.cams.sizes import smallest_rocker, smallest_roller, wedge

SEED = 1868
SMOOTH = tuple(law for law in LAWS if law != UNIFORM)


def madi_motion() -> Motion:
    """Return the motion of the project's cam: stroke 13 mm, phases 108, 15, 108 deg, sawtooth with u = 1/3."""
    phases = (math.radians(angle) for angle in (108.0, 15.0, 108.0))
    return Motion(13e-3, *phases, law_of_motion("sawtooth", 1.0 / 3.0))


MADI_LIMITS = Limits(math.radians(75.0), math.radians(60.0))


def random_motion(random: np.random.Generator, laws: tuple[str, ...] = LAWS, h: float | None = None) -> Motion:
    """Return a motion of two laws, each with its own asymmetry, with or without dwells."""
    rise, fall = (law_of_motion(str(random.choice(laws)), random.uniform(0.2, 0.8)) for _ in range(2))
    parts = random.dirichlet((6.0, 2.0, 6.0, 3.0)) * 2.0 * math.pi
    upper = parts[1] * random.integers(0, 2)
    order = str(random.choice(ORDERS))
    stroke = random.uniform(5e-3, 60e-3) if h is None else h
    return Motion(stroke, parts[0], upper, parts[2], rise, fall, order)


def random_limits(random: np.random.Generator) -> Limits:
    """Return permitted transmission angles, on one side or on both."""
    rise, fall = np.radians(random.uniform(25.0, 80.0, 2))
    return Limits(float(rise), float(fall), bool(random.integers(0, 2)))


def dense(motion: Motion, name: str, cells: int) -> tuple[np.ndarray, ...]:
    """Return phi, s, s', s'' over a phase, both limits at every corner of the motion."""
    phase = getattr(motion, name)
    found = []
    for low, high in pairwise(phase.corners):
        phi = np.linspace(low, high, cells + 1)
        left, right = motion.at(phi, -1), motion.at(phi, 1)
        found.append((phi, *(np.append(b[:-1], a[-1:]) for a, b in zip(left, right, strict=True))))
    return tuple(np.concatenate(parts) for parts in zip(*found, strict=True))


def random_profiles(count: int, seed: int, part: float) -> Iterator[RollerProfile]:
    """Go through cams with rollers on lines and on rockers, the roller's radius a part of the least radius."""
    random = np.random.default_rng([SEED, seed])
    for k in range(count):
        limits, sense = random_limits(random), int(random.choice((-1, 1)))
        follower: Rocker | Straight
        if k % 3 == 2:
            motion = random_motion(random, SMOOTH, random.uniform(0.1, 0.4))
            follower = Rocker(motion, 0.1, sense)
            sizes = smallest_rocker(follower, limits)
            if not isinstance(sizes, Sizes):
                continue
        else:
            motion = random_motion(random, SMOOTH)
            follower, sizes = Straight(motion, sense), smallest_roller(wedge(motion, limits, sense))
        sharpest = RollerProfile(follower, sizes, 0.0).rho_min
        yield RollerProfile(follower, sizes, part * min(sharpest, 0.9 * sizes.r_0))
