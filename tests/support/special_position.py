"""One special position and what is to be said of it; the mechanisms on which such positions are shown."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Container, Mapping
from dataclasses import dataclass, field
from typing import Any

from mpmath import mp

from kulman.plans.linkages.mechanism import Mechanism
from kulman.tests.linkages.test_dyads_special import FOUR_BAR, SCOTCH_YOKE, SLOTTED_LEVER, TANGENT, VALUES
from kulman.tests.linkages.test_triad_following import BENT, PARALLELOGRAM
from kulman.tests.support.mechanisms import nau_slider_crank, nau_values
from kulman.tests.support.presses import VALUES as PRESS_VALUES
from kulman.variants.reader import load_task

PI = math.pi


class Everything(Container[str]):
    """All names."""

    def __contains__(self, name: object) -> bool:
        return True


EVERYTHING = Everything()
NOWHERE = math.nan  # a quantity that has no limit here, or not the same from both sides
Number = Callable[[], Any]
RIGHT: Mapping[str, Number] = {"phi": lambda: mp.pi / 2}
STRAIGHT: Mapping[str, Number] = {"phi": lambda: mp.pi}


@dataclass(frozen=True, eq=False)
class Case:
    """One position.

    `says` is the key of the reason and what it names; `lost` and `kept` are some of the quantities that are undefined
    and defined; `limits` what some tend to from both sides, magnitudes of vectors; `hidden` the lost ones that tend to
    something all the same. `exact` are givens with all digits; `along` what is moved to come near.
    """

    name: str
    of: Mechanism
    values: Mapping[str, float]
    status: str
    says: tuple[str, dict[str, Any]] | None = None
    lost: tuple[str, ...] = ()
    kept: tuple[str, ...] = ()
    limits: Mapping[str, float] = field(default_factory=dict)
    hidden: Container[str] = ()
    exact: Mapping[str, Number] = field(default_factory=dict)
    along: str = "phi"

    def __str__(self) -> str:
        return self.name


def crank(name: str, status: str, changed: Mapping[str, float], **more: Any) -> Case:
    """A central slider-crank, l_OA = 50 mm, l_AB = 130 mm."""
    return Case(name, nau_slider_crank(), nau_values(**changed), status, **more)


def bars(name: str, status: str, changed: Mapping[str, float], **more: Any) -> Case:
    """A four-bar linkage, OA = 0.1, AB = 0.25, CB = 0.2, OC = 0.3 m."""
    # across a link in line there is a reaction all the same: it follows from the moments of that link alone
    return Case(name, FOUR_BAR, {**VALUES, **changed}, status, hidden=("R_03_t", "R_12_t", "R_03_m", "R_12_m"), **more)


def slot(name: str, status: str, changed: Mapping[str, float], **more: Any) -> Case:
    """A slotted lever, OA = 0.1, OC = 0.3 m."""
    return Case(name, SLOTTED_LEVER, {**VALUES, **changed}, status, **more)


def yoke(name: str, status: str, changed: Mapping[str, float], **more: Any) -> Case:
    """A Scotch yoke, OA = 0.1 m."""
    exact = {} if "up" in changed else {"up": lambda: mp.pi / 2}
    return Case(name, SCOTCH_YOKE, {**VALUES, **changed}, status, exact={**exact, **more.pop("exact", {})}, **more)


def tangent(name: str, status: str, changed: Mapping[str, float], **more: Any) -> Case:
    """A slider on the crank, a slider on the frame, with a common pin."""
    return Case(name, TANGENT, {**VALUES, **changed}, status, **more)


def triad(name: str, status: str, of: Mechanism, changed: Mapping[str, float], **more: Any) -> Case:
    """A central link on three legs of equal length and direction."""
    return Case(name, of, {**PRESS_VALUES, **PARALLELOGRAM, **changed}, status, **more)


def concurrent(outer: complex) -> tuple[Mechanism, dict[str, float]]:
    """Return a triad with joints at 0, j, 1 - 0.3j whose legs, 0.3 m long, all point to `outer`."""
    joints = (0j, 1j, 1.0 - 0.3j)
    a, e, f = (place - 0.3 * (outer - place) / abs(outer - place) for place in joints)
    lengths = {"l_OA": abs(a), "l_AB": 0.3, "l_EC": 0.3, "l_FD": 0.3, "x_C": 0.0, "y_C": 1.0, "x_D": 1.0, "y_D": -0.3}
    places = {"x_E": e.real, "y_E": e.imag, "x_F": f.real, "y_F": f.imag, "phi": cmath.phase(a)}
    start = {"phi_0": cmath.phase(a), "x_0": 0.0, "y_0": 0.0, "angle_0": 0.0}
    return BENT, {**PRESS_VALUES, **lengths, **places, **start}


def hydraulic(name: str, status: str, travel: float, **more: Any) -> Case:
    """A tipper whose cylinder drives A along x; AB and CB, together 500 mm, lie in line at 100 mm."""
    task = load_task("scheme-18-hydraulic-drive")
    changed = {"s": travel, "l_AB": 270, "l_CB": 230, "x_C": 500, "y_C": -300}
    return Case(name, task.mechanism, task.values("0", changed), status, along="s", **more)
