"""Ladders of scale factors: for each plan the wanted one first, then coarser and coarser; finer ones for much room."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ....plans.board import POSITION
from ....plans.linkages.mechanism import Driver
from ....plans.linkages.solved import SolvedLinkage
from ....scales.choose import UNITS, Choosers, CrankScale, Round
from ....scales.errors import InputError
from ....scales.scale import Scale, steps
from ..scene import DRIVER

Ladders = Mapping[str, tuple[float, ...]]
LONGEST = 130.0  # mm, the longest segment of a plan whose scale factor nobody has chosen
LARGEST = 200.0  # mm, the same for the mechanism from joint to joint, and for plans of many vectors
SHORTEST = 1.0  # mm, the least that the longest segment of a plan may be
CROWD, HUNG = 14, 8  # vectors on one plan; forces on the lever
DRAWN = ("read", "chain")
CRANK = 45.0  # mm, the least length of a crank drawn apart
FINER = 2.05  # times that a plan may be enlarged whose pages have room to spare


def first_scales(solved: SolvedLinkage, choosers: Choosers) -> dict[str, Scale]:
    """Return the scale factors as they are wanted, by plan, before any format has its say."""
    return by_plan(solved, {symbol: ladder[0] for symbol, ladder in ladders_of(solved, choosers).items()})


def ladders_of(solved: SolvedLinkage, choosers: Choosers) -> dict[str, tuple[float, ...]]:
    """Return for each scale factor of the plans its values from the wanted one to ever coarser ones."""
    plans = solved.scale_of_plan

    def value(name: str) -> float:
        item = solved.quantities.get(name)
        if name in plans.values():
            size = _largest(solved, name)
        else:
            size = abs(item.value or 0.0) if item is not None else abs(float(solved.values.get(name, 0.0)))
        if not size > 0.0:
            raise InputError("scale-of-zero", quantity=name)
        return size

    ladders: dict[str, tuple[float, ...]] = {}
    for symbol in dict.fromkeys(plans.values()):
        chooser = choosers.get(symbol)
        if chooser is None:  # nobody has chosen: round, and any at all for a plan on which everything is zero
            longest = LARGEST if symbol == plans[POSITION] or _crowded(solved, symbol) else LONGEST
            ladders[symbol] = Round(symbol, longest).ladder(value) if _largest(solved, symbol) > 0.0 else (1.0,)
        elif isinstance(chooser, CrankScale):
            ladders[symbol] = chooser.ladder(value, ladders["mu_l"])
        else:
            ladders[symbol] = chooser.ladder(value)
        if chooser is not None and chooser.firm:
            _visible(symbol, ladders[symbol][0], _largest(solved, symbol))
    return ladders


def _visible(symbol: str, mu: float, largest: float) -> None:
    """Refuse a scale factor that a user has fixed, at which a plan is a point."""
    if 0.0 < largest < SHORTEST * mu:
        unit = Scale(symbol, mu, UNITS[symbol.split("_")[1]]).per_mm_unit
        raise InputError("plan-too-small", symbol=symbol, mu=f"{mu:g}", unit=unit, size=f"{largest / mu:.2g}")


def finer_of(ladders: Mapping[str, Sequence[float]], choosers: Choosers) -> dict[str, tuple[float, ...]]:
    """Return for each scale factor that nobody has chosen the finer ones of the series, the nearest first."""
    finer = {}
    for symbol, ladder in ladders.items():
        below = steps(ladder[0] / 100.0) if choosers.get(symbol) is None else ()
        finer[symbol] = tuple(mu for mu in reversed(below) if ladder[0] / FINER <= mu < 0.999 * ladder[0])
    return finer


def _crowded(solved: SolvedLinkage, symbol: str) -> bool:
    """Whether the plans of a scale factor draw so many vectors, or hang so many forces, that they need more room."""
    plans = {plan for plan, name in solved.scale_of_plan.items() if name == symbol}
    drawn = [step.plan for step in solved.program if step.verb in DRAWN]
    hung = [step.operands[1].rpartition(".")[0] for step in solved.program if step.verb == "moment"]
    return any(drawn.count(plan) > CROWD or hung.count(plan) > HUNG for plan in plans)


def _largest(solved: SolvedLinkage, symbol: str) -> float:
    """Return the largest quantity on the plans of a scale factor, the size of the mechanism on its own plan."""
    plans, shown = solved.scale_of_plan, solved.shown_on
    if symbol == plans[POSITION]:
        return solved.extent
    drawn = (q.value or 0.0 for q in solved.quantities.values() if plans.get(_plan_of(q.name, shown)) == symbol)
    return max(map(abs, drawn), default=0.0)


def _plan_of(quantity: str, shown: Mapping[str, str]) -> str:
    """Return the plan that shows a quantity: lengths are those of the plan of the mechanism."""
    return POSITION if quantity.startswith("l_") else shown.get(quantity, "")


def by_plan(solved: SolvedLinkage, mus: Mapping[str, float]) -> dict[str, Scale]:
    """Return the scale factors of the plans from their values by symbol."""
    plans = solved.scale_of_plan.items()
    scales = {plan: Scale(symbol, mus[symbol], UNITS[symbol.split("_")[1]]) for plan, symbol in plans}
    if POSITION not in scales:  # of a structure alone nothing is drawn to scale
        return scales
    return {**scales, DRIVER: _of_driver(solved, scales[POSITION])}


def _of_driver(solved: SolvedLinkage, scale: Scale) -> Scale:
    """Return the scale factor of the driver drawn apart: its own, larger one where the crank is short on the plan."""
    driver = solved.mechanism.driver
    if not isinstance(driver, Driver):
        return scale
    crank = abs(solved.point(driver.point) - solved.point(driver.pivot))
    if not 0.0 < crank < CRANK * scale.mu:
        return scale
    finer = [mu for mu in steps(crank / CRANK / 10.0) if mu <= crank / CRANK]
    return Scale(f"{scale.symbol}_{driver.link}", finer[-1], scale.unit)
