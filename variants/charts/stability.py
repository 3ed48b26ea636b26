"""The chart of stability over the cycle of one variant: rows, table, CSV, JSON, picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ...drawing.charts.stability import SPOTS
from ...drawing.linkages.layout.ladders import first_scales
from ...drawing.words import GREEK, Words
from ...plans.boards.exact import SMALL, STATUSES
from ...plans.hands.hand import preset
from ...plans.linkages.accuracy.stability import DEAD, Stability, stability
from ...plans.linkages.cycles.cycle import Cycle
from ...plans.linkages.solved import SolvedLinkage, solve_linkage
from ...plans.names import role
from ...plans.quantities import BALANCES
from ...scales.errors import InputError, PositionError
from ..spreadsheets.csv_write import Cell
from ..sweeps.columns import driver_name
from ..tables import aligned
from .data import (
    Scene,
    as_csv,
    driver_unit,
    finite,
    place,
    place_column,
    place_head,
    place_si,
    place_value,
    short,
    wrapped,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LINES = 24  # of the table
LOOKED = 12  # positions at which scale factors are looked for


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class StabilityChart:
    """What is lost over the cycle; `scales` are the scale factors of the hand, by plan."""

    heading: ClassVar[str] = "chart.stability"
    scene: Scene
    cycle: Cycle
    found: Stability
    scales: Mapping[str, float]

    def table(self, words: Words) -> str:
        """Return some positions, the worst one of every quantity, special places."""
        found, names = self.found, tuple(self.found.conditions)
        mm = {name: "mm" if found.in_mm[name] else "%" for name in names}
        head = [place_head(self.cycle, words), words["chart.angle"]]
        head += [f"K {name}" for name in names] + [f"Δ {name}, {_unit(mm[name], words)}" for name in names]
        step = max(len(found.places) // LINES, 1)
        rows = [[*self._row(i, words), self._status(i, words)] for i in range(0, len(found.places), step)]
        worst = [self._worst(name, words) for name in names]
        return "\n".join(
            (aligned([head, *rows], ()), "", *filter(None, worst), *self._spots(words), wrapped(self.note(words)))
        )

    def _row(self, i: int, words: Words) -> list[str]:
        found = self.found
        cells = [place(self.cycle, words, found.places[i]), short(words, found.angles[i])]
        cells += [short(words, values[i]) for values in found.conditions.values()]
        return cells + [short(words, found.misses[name][i]) for name in found.conditions]

    def _status(self, i: int, words: Words) -> str:
        status = self.found.statuses[i]
        return "" if status == "ok" else words[f"status.{status}"]

    def _worst(self, name: str, words: Words) -> str:
        values = self.found.conditions[name]
        if not np.isfinite(values).any():
            return ""
        i = int(np.nanargmax(values))
        at, digits = place(self.cycle, words, self.found.places[i]), short(words, float(self.found.digits(name)[i]))
        return words["chart.worst"].format(name=name, condition=short(words, values[i]), digits=digits, place=at)

    def _spots(self, words: Words) -> list[str]:
        """Say where special places are, all that is there on one line."""
        texts: dict[str, list[str]] = {}
        dead: dict[str, list[str]] = {}
        for spot in self.found.spots:
            at = place(self.cycle, words, spot.place)
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

    def csv(self, words: Words) -> bytes:
        """Return all positions."""
        found, names = self.found, tuple(self.found.conditions)
        head = [place_column(driver_unit(self.cycle)), "status", "sine", "angle [deg]", "worst"]
        for name in names:
            head += [f"K_{name}", f"digits_{name}", f"miss_{name} [{'mm' if found.in_mm[name] else '%'}]"]
        rows = []
        for i, at in enumerate(found.places):
            row: list[Cell] = [place_value(driver_unit(self.cycle), at), found.statuses[i], float(found.sines[i])]
            row += [float(found.angles[i]), found.worst[i]]
            for name in names:
                values = found.conditions[name], found.digits(name), found.misses[name]
                row += [float(value[i]) for value in values]
            rows.append(row)
        return as_csv(head, rows, words)

    def to_json(self) -> dict[str, Any]:
        """Return all positions as data."""
        found = self.found
        return {
            "hand": self.scene.hand,
            "scales": dict(self.scales),
            "places": [place_si(driver_unit(self.cycle), at) for at in found.places],
            "statuses": list(found.statuses),
            "sines": [finite(value) for value in found.sines],
            "worst": list(found.worst),
            "quantities": {
                name: {
                    "condition": [finite(value) for value in found.conditions[name]],
                    "digits": [finite(value) for value in found.digits(name)],
                    "miss": [finite(value) for value in found.misses[name]],
                    "unit": "mm" if found.in_mm[name] else "%",
                }
                for name in found.conditions
            },
            "spots": [
                {"kind": spot.kind, "at": place_si(driver_unit(self.cycle), spot.place), "link": spot.link}
                for spot in found.spots
                for spot in found.spots
            ],
        }

    def figure(self, words: Words) -> Figure:
        """Draw the picture."""
        from ...drawing.charts.stability import Abscissa, stability_page

        name = driver_name(self.cycle)
        kind = role(name).kind or name
        symbol = GREEK.get(kind, kind)
        unit = "°" if self.cycle.drive.turns else words.unit("mm")
        along = Abscissa(f"{symbol}, {unit}", self.cycle.drive.turns)
        title, apart = self.scene.title(self.heading), self.cycle.reach.apart
        return stability_page(self.found, apart, words, title, along, self.scene.hand)


def _unit(unit: str, words: Words) -> str:
    return words.unit(unit) if unit == "mm" else unit


def stability_chart(scene: Scene, cycle: Cycle, names: Sequence[str]) -> StabilityChart:
    """Look at quantities over the cycle; without `names` at the motion of the output and what balances the driver."""
    mus = scales_of_cycle(scene, cycle)
    found = stability(cycle, tuple(names) or usual(cycle), mus, preset(scene.hand).hand)
    return StabilityChart(scene, cycle, found, mus)


def usual(cycle: Cycle) -> tuple[str, ...]:
    """Return velocity and acceleration of a point of the last output, and what balances the driver."""
    known = cycle.quantities
    links = [cycle.mechanism.link(output.link) for output in cycle.outputs[::-1]] or [cycle.mechanism.links[-1]]
    points = [point for link in links for point in link.points if f"V_{point}" in known]
    found = [name for point in points[:1] for name in (f"V_{point}", f"a_{point}") if name in known]
    return (*found, *[name for name in BALANCES if name in known][:1]) or known[:1]


def scales_of_cycle(scene: Scene, cycle: Cycle) -> dict[str, float]:
    """Return scale factors, by plan, at which plans of all positions find room where lines do not meet flatly.

    They are the coarsest that the task's own choice gives at some positions of the cycle.

    Raises
    ------
    InputError
        What is chosen gives none at any of them.
    PositionError
        None of them can be assembled.
    """
    case, mus, reason = scene.case, dict[str, float](), None
    values = case.task.values(case.variant, case.settings)
    plans = (*case.plans, "position")
    sound: list[SolvedLinkage] = []
    for angles in (cycle.angles, cycle.angles[cycle.codes < STATUSES.index("singular")]):
        places = angles[:: max(len(angles) // LOOKED, 1)]
        solutions = [solve_linkage(cycle.mechanism, {**values, cycle.drive.variable: at}, plans) for at in places]
        sound = [solved for solved in solutions if solved.trouble is None]
        if sound:
            break
    if not sound:
        raise case.solved.error() or PositionError("no-assembly", status_word="no-assembly", point="", gap="")
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
