"""Random cams with their answer keys, for students of every kind."""

from __future__ import annotations

import random
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from kulman.plans.cams.cam import LAWS
from kulman.plans.hands.shaky import preset
from kulman.plans.marking.key import Key
from kulman.plans.mistakes.book import Book, book
from kulman.scales.errors import InputError
from kulman.tests.support.marking_cases import HAND
from kulman.variants.case import Request
from kulman.variants.marking.keyed import Keyed, Rubric, keyed
from kulman.variants.reader import load_task

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
