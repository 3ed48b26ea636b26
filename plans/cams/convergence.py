"""Error against the number of sections: the diagrams of a cam drawn by chords over and over, exactly and by hands.

Chords err as the square of a section when every jump of the acceleration lies on a section line, as the section itself
when one lies between lines. A hand errs the more the more chords it draws, so that for each there is a best number.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...scales.errors import InputError
from ..hands.hand import Hand
from ..hands.shaky import draw
from ..hands.spread import kept
from .closing import BOTH, STROKE, travel_errors
from .sectioned import Sectioned, at_nodes, between, exact_values, inner_jumps
from .solve import SolvedCam

Array = NDArray[np.float64]
NODES, BETWEEN = "nodes", "between"  # where the jumps of the acceleration lie
CLOSED = "s_closed"  # the travel on the worst section line, after velocity and travel have been closed
SECTIONS = (6, 12, 24, 48, 96, 192, 384)  # of a phase
DRAWN = (6, 9, 12, 18, 24, 36, 48, 72)
FINE = 24  # sections from which on errors show their order
ROUNDING = 1e-11  # error that is none
DRAWINGS, SEED = 400, 1
ENOUGH = 1.1  # times the least error that is as good


@dataclass(frozen=True, slots=True, eq=False)
class Convergence:
    """Errors by quantity, one for each number of sections: in parts of the exact value, of `s_closed` of the stroke.

    Parameters
    ----------
    exact : mapping of str to float
        The exact values, SI; of V_max and S_max in metres of paper.
    quantities : tuple of str
        What is compared.
    sections : mapping of str to tuple of int
        Sections of the rise by where jumps lie, `nodes` or `between`; the latter only where some lie within a phase.
    errors : mapping of (str, str) to array
        By where jumps lie and quantity, signed.
    drawn : tuple of int
        Numbers of sections at which hands were looked at.
    hands : mapping of (str, str) to array
        What 95 % of the drawings of a hand keep, by hand and quantity.
    """

    exact: Mapping[str, float]
    quantities: tuple[str, ...]
    sections: Mapping[str, tuple[int, ...]]
    errors: Mapping[tuple[str, str], Array]
    drawn: tuple[int, ...]
    hands: Mapping[tuple[str, str], Array]

    def order(self, where: str, quantity: str) -> float | None:
        """Return the power of the section as which an error falls; None when it is rounding."""
        n = np.array(self.sections[where], float)
        error = np.abs(self.errors[where, quantity])
        shown = (n >= FINE) & (error > ROUNDING)
        if shown.sum() < 3:
            return None
        return -float(np.polyfit(np.log(n[shown]), np.log(error[shown]), 1)[0])

    def best(self, hand: str, quantity: str) -> tuple[int, float]:
        """Return the fewest sections with which a hand errs hardly more than it must, and its error."""
        errors = self.hands[hand, quantity]
        least = np.min(errors, initial=np.inf, where=np.isfinite(errors))
        at = int(np.argmax(errors <= ENOUGH * least))
        return self.drawn[at], float(errors[at])


def convergence(
    solved: SolvedCam,
    hands: Mapping[str, Hand],
    quantities: Sequence[str] = (),
    sections: Iterable[int] = SECTIONS,
    drawn: Iterable[int] = DRAWN,
) -> Convergence:
    """Draw the diagrams with more and more sections.

    Parameters
    ----------
    solved : SolvedCam
        With its diagrams, and its sizes when r_0 is wanted.
    hands : mapping of str to Hand
        Hands by their names.
    quantities : sequence of str
        Of `compared`, all when empty.

    Raises
    ------
    InputError
        With the key `chart-exact-chords`: chords make no error, because the velocity is constant.
    """
    chosen = tuple(name for name in compared(solved) if not quantities or name in quantities)
    exact = {name: value for name, value in exact_values(solved).items() if name in chosen}
    divided = {NODES: at_nodes, **({BETWEEN: between} if inner_jumps(solved.motion) else {})}
    wanted = tuple(sections)
    found = {where: _unique(divide(solved, n, exact) for n in wanted) for where, divide in divided.items()}
    errors = {
        (where, name): np.array([_error(solved, one, name, exact) for one in ones])
        for where, ones in found.items()
        for name in chosen
    }
    if all(np.abs(error).max() < ROUNDING for error in errors.values()):
        raise InputError("chart-exact-chords")
    papers = _unique(at_nodes(solved, n, exact) for n in drawn)
    by_hand = {
        (name, quantity): np.array(kept_by_hand)
        for name, hand in hands.items()
        for quantity, kept_by_hand in zip(
            chosen, zip(*(_by_hand(solved, one, hand, chosen, exact) for one in papers), strict=True), strict=False
        )
    }
    counts = {where: tuple(one.sections for one in ones) for where, ones in found.items()}
    return Convergence(exact, chosen, counts, errors, tuple(one.sections for one in papers), by_hand)


def compared(solved: SolvedCam) -> tuple[str, ...]:
    """Return the names of what can be compared."""
    return (*exact_values(solved), CLOSED)


def _error(solved: SolvedCam, one: Sectioned, name: str, exact: Mapping[str, float]) -> float:
    """Return the error of chords alone."""
    if name in exact:
        return float(one.values[name] / exact[name] - 1.0)
    found = travel_errors(solved, one.angles, one.division, one.values)
    return float(found.get(BOTH, found[STROKE]))


def _by_hand(
    solved: SolvedCam, one: Sectioned, hand: Hand, names: Iterable[str], exact: Mapping[str, float]
) -> Iterator[float]:
    """Go through what most drawings of a hand keep."""
    values = draw(one.paper, hand, np.random.default_rng(SEED), DRAWINGS).values
    for name in names:
        if name in exact:
            drawings = np.broadcast_to(values[name], DRAWINGS)
            yield float(kept(drawings, exact[name])) / exact[name]
        else:
            found = travel_errors(solved, one.angles, one.division, values, DRAWINGS)
            yield float(kept(found.get(BOTH, found[STROKE]), 0.0))


def _unique(ones: Iterable[Sectioned]) -> list[Sectioned]:
    """Leave out what has the number of sections of another."""
    return list({one.sections: one for one in ones}.values())
