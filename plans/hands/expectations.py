"""What to expect of a hand: for each quantity where most drawings lie, which step errs most, what to let pass."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..marking.key import Key, answer_key
from ..names import role
from ..quantities import plans_of
from .hand import Hand, Tolerance
from .shaky import Paper
from .spread import NOTHING, SHARE, Sensitivities, Spread, drawn, sensitivities
from .tolerances import failing

DRAWINGS = 4000
SEED = 1


@dataclass(frozen=True, slots=True)
class Expectation:
    """What a hand makes of one quantity.

    Parameters
    ----------
    spread : Spread
        Where the part `SHARE` of its drawings lie.
    step, share : str and float, or None
        The step whose errors come through most, and its part of the variance; None for what does not err. Of a step
        whose least error breaks the construction the part is None.
    allowed, allowed_mm : float, or None
        What to let pass, SI and on paper, where a plan shows the quantity.
    degrees : float or None
        What to let pass of a vector's direction.
    failed : float
        Part of this hand's drawings that would be marked wrong all the same.
    mu : float or None
        Value of a millimetre, where a plan shows the quantity.
    errs : bool
        Whether the quantity hangs on any error at all.
    """

    spread: Spread
    step: str | None
    share: float | None
    allowed: float | None
    allowed_mm: float | None
    degrees: float | None
    failed: float
    mu: float | None
    errs: bool

    @property
    def half(self) -> float | None:
        """Half the interval, SI; of a point how far its drawings miss it."""
        spread = self.spread
        if spread.low is None or spread.high is None:
            return spread.miss if spread.miss == spread.miss else None
        return 0.5 * (spread.high - spread.low)

    @property
    def mm(self) -> float | None:
        """Half the interval on paper."""
        return None if self.mu is None or self.half is None else self.half / self.mu

    @property
    def percent(self) -> float | None:
        """Half the interval in per cents of the value, None where the value is nothing beside its plan."""
        exact = self.spread.exact
        if self.half is None or not exact or self.spread.percent is None:
            return None
        return 100.0 * self.half / abs(exact)


def expectations(
    paper: Paper, hand: Hand, tolerance: Tolerance, limits: Mapping[str, float] | None = None, drawings: int = DRAWINGS
) -> dict[str, Expectation]:
    """Draw a construction many times with a hand, the same drawings every time, and mark what comes out.

    Parameters
    ----------
    limits : mapping of str to float, optional
        Tolerances of single quantities in SI, in the place of the rule.

    Returns
    -------
    dict of str to Expectation
        For every quantity of the construction; what is only given does not err.
    """
    found = drawn(paper, hand, np.random.default_rng(SEED), drawings)
    key = answer_key(paper, tolerance, limits)
    spreads, missed = found.spreads(SHARE), found.board.missed
    parts = sensitivities(paper, hand)
    failed, plans = failing(found, key.allowed), plans_of(paper.program)
    made = {}
    for name, spread in spreads.items():
        errs = name in missed and not _cancelled(spread)
        step, share = _worst(parts, name) if errs else (None, None)
        mu = paper.mus.get(plans.get(name, ""))
        made[name] = Expectation(spread, step, share, *_allowed(key, name, mu), failed[name], mu, errs)
    return made


def _cancelled(spread: Spread) -> bool:
    """Tell whether errors that a quantity hangs on cancel: those of two scale factors in their ratio."""
    return spread.exact is not None and spread.deviation <= NOTHING * abs(spread.exact)


def _worst(parts: Sensitivities, name: str) -> tuple[str | None, float | None]:
    step, share = next(iter(parts.parts(name).items()), (None, math.nan))
    return step, share if math.isfinite(share) else None


def _allowed(key: Key, name: str, mu: float | None) -> tuple[float | None, float | None, float | None]:
    """Return what to let pass of a quantity: in SI, in mm, and of its direction in degrees."""
    allowed, angle = key.allowed[name], key.angles.get(name)
    if (
        not math.isfinite(allowed) or not np.isfinite(key[name]) or role(name).kind == "delta"
    ):  # of two values, marked alone
        return None, None, None
    return allowed, None if mu is None else allowed / mu, None if angle is None else math.degrees(angle)


def as_data(expected: Expectation) -> Mapping[str, Any]:
    """Return an expectation as the command line's JSON has it, None for what is undefined."""
    spread = expected.spread
    data = {
        "low": spread.low,
        "high": spread.high,
        "mm": expected.mm,
        "percent": expected.percent,
        "miss": spread.miss,
        "miss_mm": spread.mm_miss,
        "degrees": spread.degrees,
        "step": expected.step,
        "share": expected.share,
        "tolerance": expected.allowed,
        "tolerance_mm": expected.allowed_mm,
        "tolerance_deg": expected.degrees,
        "failed": expected.failed,
        "undrawn": spread.undrawn,
    }
    return {name: None if isinstance(x, float) and not math.isfinite(x) else x for name, x in data.items()}
