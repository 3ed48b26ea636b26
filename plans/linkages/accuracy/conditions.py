"""How accurate a solved mechanism is: its conditions."""

from __future__ import annotations

from ...condition import Condition, conditions
from ...references import extent, plans_of
from ..mechanism import Mechanism, Prismatic, Revolute
from ..solved import SolvedLinkage


def signs(mechanism: Mechanism) -> frozenset[str]:
    """Return the names of givens that are +1 or -1: senses and branches. They do not err."""
    names = [pair.branch for pair in mechanism.pairs if isinstance(pair, (Revolute, Prismatic))]
    names += [couple.sense for couple in mechanism.couples]
    names += [getattr(mechanism.driver, "sense", None), mechanism.stroke.sense if mechanism.stroke else None]
    return frozenset(name for name in names if name is not None)


def varied(solved: SolvedLinkage) -> tuple[str, ...]:
    """Return the givens that may err: numbers other than zero that are no signs; ends of the stroke count as givens."""
    fixed = signs(solved.mechanism)
    return tuple(name for name, value in solved.givens.items() if name not in fixed and value)


def conditions_of(solved: SolvedLinkage) -> dict[str, Condition]:
    """Return the condition of every quantity; given lengths are their own."""
    found = conditions(solved.program, solved.givens, varied(solved), solved.values, solved.sines)
    size = extent(solved.program, solved.values)
    for name, quantity in solved.quantities.items():
        if name not in found:
            found[name] = Condition(abs(quantity.value or 0.0) / size if size else None, 1.0)
    return {name: found[name] for name in solved.quantities}


def worst_condition(solved: SolvedLinkage, plan: str | None = None) -> tuple[str, float]:
    """Return the quantity of the largest condition, of those that `plan` or any plan shows, and that condition.

    What is only calculated may lose its digits because it passes zero: that says nothing of the position.
    """
    shown = plans_of(solved.program)
    found = ((item.value or 0.0, name) for name, item in conditions_of(solved).items() if name in shown)
    here = (pair for pair in found if plan is None or shown[pair[1]] == plan)
    value, name = max(here, default=(0.0, ""))
    return name, value
