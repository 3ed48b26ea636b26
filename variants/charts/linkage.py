"""The charts of linkages: speed against accuracy, stability over the cycle, depth of the model."""

from __future__ import annotations

import textwrap
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...drawing.charts.cycle import SPOTS, Abscissa, stability_page
from ...drawing.charts.depth import depth_page, depth_verdict
from ...drawing.formats import format_named
from ...drawing.linkages.ladders import first_scales
from ...drawing.words import GREEK, Words
from ...plans.board import with_needs
from ...plans.boards.exact import SMALL, STATUSES
from ...plans.lab.linkages import DrawnSheet, by_hand, contest
from ...plans.lab.race import Entry
from ...plans.lab.stability import DEAD, Cost, Depth, Stability, depth, stability
from ...plans.linkages.chain import NEEDS
from ...plans.linkages.cycle import Cycle, cycle
from ...plans.linkages.solved import SolvedLinkage, solve_linkage
from ...plans.names import role
from ...plans.quantities import BALANCES, unit_of
from ...scales.choices import SIZES
from ...scales.errors import InputError, PositionError
from ...scales.names import all_known
from ..case import Case
from ..sweeps.linkage import driver_name
from ..tables import Cell, aligned
from . import charts
from .charts import AccuracyChart, Scene

POSITIONS, RACED = 120, 24  # of the cycle that is looked at; those of them at which methods race
LINES = 24  # of the table of stability
LOOKED = 8  # positions at which scale factors are looked for


def _cycle_of(scene: Scene) -> Cycle:
    """Return the cycle with the plans of the case, which is looked at once for all charts."""
    case, count = scene.case, scene.positions or POSITIONS
    if count not in scene.cycles:
        plans = (
            plan for plan in with_needs((*case.plans, "position"), NEEDS) if plan not in ("cycle", "compound", "dead")
        )
        values = case.values
        scene.cycles[count] = cycle(case.task.mechanism, values, tuple(plans), count)
        if not scene.cycles[count].reach.stretches:
            raise _unreachable(case)
    all_known("quantity-unknown", scene.quantities, scene.cycles[count].quantities)
    return scene.cycles[count]


def _unreachable(case: Case) -> PositionError:
    """Return why there is no position to look at."""
    return case.error() or PositionError("no-assembly", status_word="no-assembly", point="", gap="")


def _accuracy(scene: Scene) -> AccuracyChart:
    """Let all methods compete; `chart-no-rivals` where nothing that is wanted can be compared."""
    whole = _cycle_of(scene)
    found = contest(whole, scene.positions or RACED, time.process_time, scene.quantities, charts.EFFORT)
    if not found.kinds:
        raise InputError("chart-no-rivals")
    case, drawn = scene.case, list[Entry]()
    for name in SIZES if case.solved.trouble is None else ():  # a hand, on the formats that have room for every plan
        solved = SolvedLinkage.of(case.solved)
        try:
            _, scales = first_scales(solved, case.choosers, case.plans, format_named(name))
        except InputError:  # too small for a plan, or for a scale factor that was asked for
            continue
        sheet = DrawnSheet(name, solved, {plan: scale.mu for plan, scale in scales.items()})
        drawn += by_hand(whole, sheet, charts.HANDS[scene.hand], found.kinds)
    return AccuracyChart(scene, replace(found, entries=(*found.entries, *drawn)), _places(whole))


def _stability(scene: Scene) -> _StabilityChart:
    """Look at what is lost over the cycle."""
    whole = _cycle_of(scene)
    mus = _scales_of_cycle(scene, whole)
    found = stability(whole, scene.quantities or _usual(whole), mus, charts.HANDS[scene.hand])
    return _StabilityChart(scene, found, whole, _places(whole), mus)


def _depth(scene: Scene) -> _DepthChart:
    """Look at what each part of the model is worth."""
    whole = _cycle_of(scene)
    return _DepthChart(scene, depth(whole, scene.tolerance), _places(whole))


def _places(cycle: Cycle) -> charts.Places:
    """Return what places of the driver are."""
    return charts.Places("rad" if cycle.drive.turns else "m", driver_name(cycle))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class _DepthChart(charts.Chart[Depth]):
    """What simplifications cost over the cycle."""

    heading, noted, page = "chart.depth", "chart.whole", staticmethod(depth_page)
    places: charts.Places

    def table(self, words: Words) -> str:
        """Return a row for every simplification, then what the scene needs."""
        found = self.found
        names = [found.balance, words["chart.reactions"]][: 2 if found.reaction else 1]
        head = ["", *(f"{name}, {words[f'chart.{key}']}, %" for name in names for key in ("max", "rms"))]
        rows = [[*head, self.places.head(words)]]
        for cost in found.costs:
            alone = cost.parts == (cost.key,)
            named = words["chart.without" if alone else f"chart.without.{cost.key}"].format(part=cost.key)
            values = [cost.balance, cost.balance_rms]
            values += [cost.reaction or 0.0, cost.reaction_rms or 0.0] if found.reaction else []
            tidy = (0.0 if value < 1e-10 else value for value in values)
            rows.append([named, *(charts.short(words, value) for value in tidy), self.places.told(words, cost.place)])
        return "\n".join((aligned(rows), "", depth_verdict(found, words, plain=True)))

    def _rows(self) -> Iterator[Sequence[Cell]]:
        errors = ("balance_max [%]", "balance_rms [%]", "reaction_max [%]", "reaction_rms [%]")
        yield "without", "parts", *errors, self.places.column
        for c in self.found.costs:
            found = (c.balance, c.balance_rms, c.reaction, c.reaction_rms)
            yield c.key, " ".join(c.parts), *found, self.places.shown(c.place)

    def _data(self) -> dict[str, Any]:
        found = self.found
        largest = {found.balance: {"value": found.largest_balance, "unit": unit_of(found.balance)}}
        if found.reaction:
            largest[found.reaction] = {"value": found.largest_reaction or 0.0, "unit": "N"}
        data = {"balance": found.balance, "reaction": found.reaction, "largest": largest}
        data |= {name: getattr(found, name) for name in ("tolerance", "needed", "spare")}
        return data | {"spare_cost": found.together.worst, "costs": [self._item(cost) for cost in found.costs]}

    def _item(self, cost: Cost) -> dict[str, Any]:
        return {
            "without": cost.key,
            "parts": list(cost.parts),
            "balance": {"max": cost.balance, "rms": cost.balance_rms},
            "reaction": None if cost.reaction is None else {"max": cost.reaction, "rms": cost.reaction_rms},
            "at": self.places.si(cost.place),
        }


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class _StabilityChart(charts.Chart[Stability]):
    """What is lost over the cycle; `scales` are the scale factors of the hand, by plan."""

    heading, page = "chart.stability", staticmethod(stability_page)
    cycle: Cycle
    places: charts.Places
    scales: Mapping[str, float]

    def _unit(self, name: str) -> str:
        """Return in what a quantity misses."""
        return "mm" if self.found.in_mm[name] else "%"

    def table(self, words: Words) -> str:
        """Return some positions, the worst one of every quantity, special places."""
        found, names = self.found, tuple(self.found.conditions)
        head = [self.places.head(words), words["chart.angle"], *(f"K {name}" for name in names)]
        head += [f"Δ {name}, {words.unit('mm') if found.in_mm[name] else '%'}" for name in names]
        step = max(len(found.places) // LINES, 1)
        rows = [head, *(self._row(i, words) for i in range(0, len(found.places), step))]
        worst = filter(None, (self._worst(name, words) for name in names))
        return "\n".join(
            (aligned(rows, ()), "", *worst, *self._spots(words), textwrap.fill(self.note(words), charts.LINE))
        )

    def _row(self, i: int, words: Words) -> list[str]:
        found, status = self.found, self.found.statuses[i]
        columns = (found.angles, *found.conditions.values(), *(found.misses[name] for name in found.conditions))
        cells = [self.places.told(words, found.places[i]), *(charts.short(words, values[i]) for values in columns)]
        return [*cells, "" if status == "ok" else words[f"status.{status}"]]

    def _worst(self, name: str, words: Words) -> str:
        values = self.found.conditions[name]
        if not np.isfinite(values).any():
            return ""
        i = int(np.nanargmax(values))
        at, lost = self.places.told(words, self.found.places[i]), float(self.found.digits(name)[i])
        condition, digits = (charts.short(words, value) for value in (values[i], lost))
        return words["chart.worst"].format(name=name, condition=condition, digits=digits, place=at)

    def _spots(self, words: Words) -> list[str]:
        """Say where special places are, all that is there on one line."""
        texts: dict[str, list[str]] = {}
        dead: dict[str, list[str]] = {}
        for spot in self.found.spots:
            at = self.places.told(words, spot.place)
            if spot.kind == DEAD:
                dead.setdefault(at, []).append(str(spot.link))
            else:
                texts.setdefault(at, []).append(words[SPOTS[spot.kind]])
        for at, links in dead.items():
            texts.setdefault(at, []).append(words["chart.dead"].format(links=", ".join(links)))
        return [f"{at}: {'; '.join(dict.fromkeys(said))}" for at, said in texts.items()]

    def note(self, words: Words) -> str:
        """Return what the columns are."""
        return words["chart.drawn"].format(hand=words[f"hand.{self.scene.hand}"])

    def _rows(self) -> Iterator[Sequence[Cell]]:
        """Go through all positions."""
        found, names = self.found, tuple(self.found.conditions)
        heads = [self.places.column, "status", "sine", "angle [deg]", "worst"]
        columns = []
        for name in names:
            heads += [f"K_{name}", f"digits_{name}", f"miss_{name} [{self._unit(name)}]"]
            columns += [found.conditions[name], found.digits(name), found.misses[name]]
        yield heads
        for i, at in enumerate(found.places):
            place, status = self.places.shown(at), found.statuses[i]
            head = place, status, float(found.sines[i]), float(found.angles[i])
            yield *head, found.worst[i], *(float(column[i]) for column in columns)

    def _data(self) -> dict[str, Any]:
        found = self.found
        return {
            "hand": self.scene.hand,
            "scales": dict(self.scales),
            "places": [self.places.si(at) for at in found.places],
            "statuses": list(found.statuses),
            "sines": found.sines,
            "worst": list(found.worst),
            "quantities": {
                name: {
                    "condition": found.conditions[name],
                    "digits": found.digits(name),
                    "miss": found.misses[name],
                    "unit": self._unit(name),
                }
                for name in found.conditions
            },
            "spots": [{"kind": spot.kind, "at": self.places.si(spot.place), "link": spot.link} for spot in found.spots],
        }

    def _shown(self, words: Words) -> tuple[Any, ...]:
        kind = role(self.places.name).kind or self.places.name
        unit = "°" if self.cycle.drive.turns else words.unit("mm")
        return (Abscissa(f"{GREEK.get(kind, kind)}, {unit}", self.cycle.drive.turns, self.cycle.reach.apart),)


def _usual(cycle: Cycle) -> tuple[str, ...]:
    """Return velocity and acceleration of a point of the last output, and what balances the driver."""
    known = cycle.quantities
    links = [cycle.mechanism.link(output.link) for output in cycle.outputs[::-1]] or [cycle.mechanism.links[-1]]
    points = [point for link in links for point in link.points if f"V_{point}" in known]
    found = [name for point in points[:1] for name in (f"V_{point}", f"a_{point}") if name in known]
    return (*found, *[name for name in BALANCES if name in known][:1]) or known[:1]


def _scales_of_cycle(scene: Scene, cycle: Cycle) -> dict[str, float]:
    """Return scale factors, by plan, at which plans of all positions find room where lines do not meet flatly.

    They are the coarsest that the task's own choice gives at some positions of the cycle. Refused are a choice that
    gives none at any of them, and a mechanism that none of them can be assembled in.
    """
    case, mus, reason = scene.case, dict[str, float](), None
    values = case.values
    plans = (*case.plans, "position")
    sound: list[SolvedLinkage] = []
    for angles in (cycle.angles, cycle.angles[cycle.codes < STATUSES.index("singular")]):
        places = angles[:: max(len(angles) // LOOKED, 1)]
        solutions = [solve_linkage(cycle.mechanism, {**values, cycle.drive.variable: at}, plans) for at in places]
        sound = [solved for solved in solutions if solved.trouble is None]
        if sound:
            break
    if not sound:
        raise _unreachable(case)
    for solved in [solved for solved in sound if solved.worst_sine()[1] >= SMALL] or sound:
        try:
            _, scales = first_scales(solved, case.choosers, plans)
        except InputError as error:  # the segment that sets a scale factor is zero here
            reason = error
            continue
        for plan, scale in scales.items():
            mus[plan] = max(mus.get(plan, 0.0), scale.mu)
    if reason is not None and not mus:
        raise reason
    return mus


CHARTS: charts.Gallery = {
    "accuracy": (_accuracy, ("quantities", "hand", "positions")),
    "stability": (_stability, ("quantities", "hand", "positions")),
    "depth": (_depth, ("tolerance", "positions")),
}
