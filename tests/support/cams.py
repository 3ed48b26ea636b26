"""Random motions of cams of mixed laws, cams that belong to them, and their answer keys for students of every kind."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np

from kulman.plans.cams.cam import LAWS, ORDERS
from kulman.plans.cams.followers import Limits, Rocker, RollerProfile, Sizes, Straight
from kulman.plans.cams.laws_of_motion import UNIFORM, law_of_motion
from kulman.plans.cams.motion import Motion
from kulman.plans.cams.sizes import _smallest_rocker, _smallest_roller, wedge
from kulman.plans.hands.shaky import preset
from kulman.plans.marking.key import Key
from kulman.plans.mistakes.book import Book, book
from kulman.scales.errors import InputError
from kulman.tests.support.marking_cases import HAND
from kulman.variants.case import Request
from kulman.variants.marking.keyed import Keyed, Rubric, keyed
from kulman.variants.reader import load_task

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
            sizes = _smallest_rocker(follower, limits)
            if not isinstance(sizes, Sizes):
                continue
        else:
            motion = random_motion(random, SMOOTH)
            follower, sizes = Straight(motion, sense), _smallest_roller(wedge(motion, limits, sense))
        sharpest = RollerProfile(follower, sizes, 0.0).rho_min
        yield RollerProfile(follower, sizes, part * min(sharpest, 0.9 * sizes.r_0))


MADI = "madi-cam"
ROCKER = str(Path(__file__).resolve().parents[2] / "docs" / "examples" / "rocker-cam.toml")
Settings = tuple[tuple[str, str], ...]


def random_settings(choose: random.Random, law: str = "") -> Settings:
    """Return data of a cam with a roller and a plate that are another one's, in both senses of rotation."""
    said = {
        "law": law or choose.choice(LAWS),
        "rotation": choose.choice(("ccw", "cw")),
        "limits": choose.choice(("one-sided", "two-sided")),
        "fall": choose.choice(("mirror", "same")),
        "h": f"{choose.uniform(8.0, 25.0):.3g} mm",
        "phi_rise": f"{choose.randrange(80, 150, 2)} deg",
        "phi_upper": f"{choose.choice((0, 15, 30))} deg",
        "phi_fall": f"{choose.randrange(80, 150, 2)} deg",
        "u": choose.choice(("1/3", "0.4", "0.5", "0.6")),
        "gamma_rise": f"{choose.randrange(50, 78)} deg",
        "gamma_fall": f"{choose.randrange(45, 65)} deg",
        "R_roller": "3 mm",
    }
    return tuple(said.items())


@cache
def keyed_cam(settings: Settings = (), task: str = MADI, hand: str = HAND) -> Keyed:
    """Return a cam ready for marking, as `kulman check` makes it."""
    request = Request(load_task(task), "", settings=dict(settings), language="en")
    return keyed(request, next(iter(request.task.variants)), {}, Rubric(preset(hand).tolerance))


@cache
def cam_book(settings: Settings = (), task: str = MADI) -> Book:
    """Return the mistakes that concern a cam."""
    return book(keyed_cam(settings, task).key)


def random_cams(seed: int, count: int, law: str = "") -> Iterator[Settings]:
    """Go through the data of random cams that can be solved."""
    choose = random.Random(seed)
    while count:
        settings = random_settings(choose, law)
        try:
            keyed_cam(settings)
        except InputError:  # a roller that leaves no cam
            continue
        count -= 1
        yield settings


def asked(of: Keyed) -> frozenset[str]:
    """Return what a form asks for."""
    return frozenset(question.name for part in of.parts for question in part.asked)


def asked_key(of: Keyed) -> Key:
    """Return the key with what a form asks for alone."""
    from dataclasses import replace

    names = asked(of)
    return replace(of.key, questions={name: q for name, q in of.key.questions.items() if name in names})
