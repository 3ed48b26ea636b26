"""The charts of hoists: speed against accuracy, steps, ways to the lift-off, depth of the model, choice of places."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, astuple, dataclass, replace
from typing import Any

import numpy as np

from ...drawing.charts.curves import roots_page, steps_page
from ...drawing.charts.depth import choice_page, choice_verdict, hoist_page, hoist_verdict
from ...drawing.words import Words
from ...plans.hoist.forces import Choice, choose
from ...plans.hoist.hoist import complete
from ...plans.hoist.solve import SolvedHoist
from ...plans.lab.hoists import Steps, Ways, by_board, by_hand, rivals, root_race, step_limits
from ...plans.lab.integrators import GROWN
from ...plans.lab.ropes import COMPARED, MANY, HoistDepth, depth
from ...scales.errors import InputError
from ...scales.units import unit
from ..tables import Cell, aligned
from . import charts
from .charts import HANDS, PERCENT, AccuracyChart, Chart, Scene, per_cent, short

EVERY = 5  # of the places stands in the tables
TABLED = (("F_max", "kN"), ("sigma_max", "MPa"))


class _HoistStepsChart(Chart[Mapping[str, Steps]]):
    """Errors over the step of every method that integrates: orders, limits of stability, refusals."""

    heading, page = "chart.hoist_stability", staticmethod(steps_page)

    def _parts(self, words: Words) -> Iterator[str]:
        """Go through order and limit of every method, then errors over the step; a dash where a run is refused."""
        heads = ("chart.method", "chart.order", "chart.hoist.limit_head", "chart.hoist.refused_from")
        rows = [[words[key] for key in heads]]
        for method, runs in self.found.items():
            order, refused, limit = runs.order, runs.refused_from, runs.limit
            stable = "∞" if math.isinf(limit) else words.short(limit, 5) if limit else words["chart.hoist.always"]
            since = words["chart.hoist.never"] if refused is None else words.short(refused, 3)
            rows.append([words[f"chart.{method}"], "–" if order is None else words.number(order, 2), stable, since])
        errors = [[words["chart.hoist.step"], *(words[f"chart.{method}"] for method in self.found)]]
        known = {(run["method"], run["step"]): run["error"] for run in self._runs()}
        for z in sorted({z for _, z in known}, reverse=True):
            cells = [short(words, known[m, z]) if (m, z) in known else "" for m in self.found]
            errors.append([words.short(z, 3), *cells])
        yield from (aligned(rows), aligned(errors, ()))

    def note(self, words: Words) -> str:
        """Return what is refused, and why."""
        grown, [ratio, *_] = PERCENT * (GROWN - 1.0), (runs.ratio for runs in self.found.values())
        return words["chart.hoist.limits_note"].format(grown=words.short(grown, 3), ratio=words.short(ratio, 3))

    def _runs(self) -> Iterator[dict[str, Any]]:
        """Go through all runs; one that is refused has no error."""
        for method, runs in self.found.items():
            columns = (column.tolist() for column in (runs.steps, runs.errors, runs.grown))
            for z, error, grown in zip(*columns, strict=True):
                refused = not math.isfinite(error)
                yield {"method": method, "step": z, "error": error, "grown": grown, "refused": refused}

    def _rows(self) -> Iterator[Sequence[Cell]]:
        yield "method", "step [rad]", "error", "grown", "refused", "order", "limit"
        for run in self._runs():
            method, *numbers, refused = run.values()
            yield method, *numbers, int(refused), self.found[method].order, self.found[method].limit

    def _data(self) -> dict[str, Any]:
        return {
            "methods": {
                method: {
                    "order": runs.order,
                    "limit": runs.limit,
                    "stable": math.isinf(runs.limit),
                    "refused_from": runs.refused_from,
                }
                for method, runs in self.found.items()
            },
            "runs": [*self._runs()],
        }


class _HoistRootsChart(Chart[Mapping[str, Ways]]):
    """Ways to the root of the hoist, and to one that is nearly triple."""

    heading, noted, page = "chart.roots", "chart.hoist.roots_note", staticmethod(roots_page)

    def _parts(self, words: Words) -> Iterator[str]:
        """Go through how many evaluations every method takes to which error."""
        for name, ways in self.found.items():
            rows = [[words["chart.method"], words["chart.hoist.evaluations"], words["chart.hoist.reached"]]]
            for method, found in ways.found.items():
                cells = [words[f"chart.{method}"], str(found.evaluations), short(words, ways.error(method))]
                if math.isnan(found.root):
                    cells = [words["chart.hoist.fails"].format(method=cells[0]), "–", "–"]
                rows.append(cells)
            head = words[f"chart.hoist.root.{name}"].format(x=words.short(ways.root, 7))
            yield f"{head}\n{aligned(rows)}"

    def _rows(self) -> Iterator[Sequence[Cell]]:
        """Go through all evaluations."""
        yield "root", "method", "evaluation", "error", "stops", "fails"
        for name, ways in self.found.items():
            for method, found in ways.found.items():
                for i, error in enumerate(ways.errors[method].tolist(), 1):
                    yield name, method, i, error, found.evaluations, int(math.isnan(found.root))

    def _data(self) -> dict[str, Any]:
        return {
            name: {
                "root": ways.root,
                "methods": {
                    method: {
                        "evaluations": found.evaluations,
                        "error": ways.error(method),
                        "errors": ways.errors[method],
                    }
                    for method, found in ways.found.items()
                },
            }
            for name, ways in self.found.items()
        }


class _HoistDepthChart(Chart[HoistDepth]):
    """What simplifications change, and one mass beside ropes of many."""

    heading, noted, page = "chart.hoist_depth", "chart.hoist.depth_note", staticmethod(hoist_page)

    def _parts(self, words: Words) -> Iterator[str]:
        """Go through what simplifications change, ropes of more and more masses, one mass over the rope's weight."""
        rows = [[words["chart.hoist.simpler"], *(f"{name}, %" for name in COMPARED)]]
        for key, changes in self.found.simpler.items():
            cells = [short(words, per_cent(changes[name])) for name in COMPARED]
            rows.append([words[f"chart.hoist.without.{key}"], *cells])
        yield aligned(rows)
        newton, second = (words.spelled(unit) for unit in ("N", "s"))
        heads = [f"t_1, {second}", f"F_12_max, {newton}", f"P_12_max, {newton}"]
        rows = [[words["chart.hoist.masses"], *heads, f"{words['chart.hoist.at_drum']}, {newton}"]]
        rows += [[str(rope.n), *(short(words, value, 7) for value in astuple(rope)[1:])] for rope in self.found.ropes]
        yield aligned(rows, ()) if self.found.ropes else ""
        rows = [["G_2/G_1", "t_1, %", *(f"{words[f'chart.hoist.{key}']}, %" for key in ("at_load", "at_drum"))]]
        for mass in self.found.one_mass:
            errors = (short(words, PERCENT * error) for error in (mass.t_1, mass.at_load, mass.at_drum))
            rows.append([words.short(mass.ratio, 3), *errors])
        head = words["chart.hoist.one_mass"].format(n=MANY)
        yield f"{head}\n{aligned(rows, ())}" if self.found.one_mass else ""
        yield "\n".join(hoist_verdict(self.found, words))

    def _rows(self) -> Iterator[Sequence[Cell]]:
        """Go through simplifications, ropes, weights of the rope."""
        yield "kind", "key", "masses", "ratio", "t_1 [%]", "F_12_max [%]", "P_12_max [%]", "F_max [%]", "F_drum [%]"
        found = self.found
        for key, parts in found.simpler.items():
            yield "simpler", key, 1, None, *(per_cent(parts[name]) for name in COMPARED), None
        for rope in found.ropes:
            others = (rope.t_1, rope.F_12_max, rope.P_12_max, max(rope.F_12_max, rope.P_12_max))
            changes = [PERCENT * (value / found.full[n] - 1.0) for n, value in zip(COMPARED, others, strict=True)]
            drum = PERCENT * (rope.F_drum_max / found.full["F_max"] - 1.0)
            yield "rope", "", rope.n, found.ratio, *changes, drum
        for mass in found.one_mass:
            at_load, at_drum = PERCENT * mass.at_load, PERCENT * mass.at_drum
            yield "one_mass", "", MANY, mass.ratio, PERCENT * mass.t_1, None, None, at_load, at_drum

    def _data(self) -> dict[str, Any]:
        """Return changes and errors in parts."""
        found = self.found
        return {
            "full": dict(found.full),
            "tolerance": found.tolerance,
            "simpler": [{"without": key, "changes": dict(changes)} for key, changes in found.simpler.items()],
            "spare": list(found.spare),
            "ropes": [asdict(rope) for rope in found.ropes],
            "ratio": found.ratio,
            "one_mass": [asdict(one) for one in found.one_mass],
            "here": None if found.here is None else asdict(found.here),
            "enough_to": found.enough_to,
        }


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class _HoistChoiceChart(Chart[Choice]):
    """The spectrum of forces and stresses over the places of load and drum; `S` is the area of the rope, m^2."""

    heading, page = "chart.choice", staticmethod(choice_page)
    S: float

    def _parts(self, words: Words) -> Iterator[str]:
        """Go through forces and stresses over both places, a star where they are permitted, and what the loop finds."""
        yield from (self._grid(name, of, words) for name, of in TABLED)
        yield "\n".join(choice_verdict(self.found, words))

    def _grid(self, name: str, of: str, words: Words) -> str:
        grid = self.found.spectrum
        values, shown = getattr(grid, name), unit(of)
        rows = [["β₀ \\ β₂", *(words.short(float(beta), 3) for beta in grid.beta_2[::EVERY])]]
        for i in range(0, len(grid.beta_0), EVERY):
            cells = [
                words.short(shown.from_si(float(values[i, j])), 4) + ("*" if grid.permitted[i, j] else " ")
                for j in range(0, len(grid.beta_2), EVERY)
            ]
            rows.append([words.short(float(grid.beta_0[i]), 3), *cells])
        head = words["chart.hoist.choice_key"].format(name=name, unit=words.spelled(of))
        return f"{head}\n{aligned(rows, ())}"

    def _rows(self) -> Iterator[Sequence[Cell]]:
        """Go through all pairs of places."""
        yield "beta_0", "beta_2", "F_max [N]", "sigma_max [Pa]", "safety", "permitted", "formulas"
        grid = self.found.spectrum
        for i, j in np.ndindex(*grid.F_max.shape):
            numbers = (float(column[i, j]) for column in (grid.F_max, grid.sigma_max, grid.safety))
            judged = (int(column[i, j]) for column in (grid.permitted, grid.formulas))
            yield round(float(grid.beta_0[i]), 6), round(float(grid.beta_2[j]), 6), *numbers, *judged

    def _data(self) -> dict[str, Any]:
        found, grid = self.found, self.found.spectrum
        columns = ("beta_0", "beta_2", "F_max", "sigma_max", "safety", "permitted", "formulas")
        return {
            "given": asdict(found.given),
            "best": asdict(found.best),
            "safety_required": found.K,
            "found": found.found,
            "trials": [asdict(trial) for trial in found.trials],
            "spectrum": {name: getattr(grid, name) for name in columns},
        }

    def _shown(self, words: Words) -> tuple[Any, ...]:
        return (self.S,)


def _swinging(scene: Scene) -> tuple[SolvedHoist, dict[str, float]]:
    """Return a hoist on a support that yields, whose formulas are valid, and its givens."""
    solved = SolvedHoist.of(scene.case.solved)
    givens = complete(solved.givens)
    if math.isinf(givens["I_0"]):
        raise InputError("chart-hoist-rigid")
    if solved.forces.motion is not None:
        raise InputError("chart-hoist-one-sided", command=scene.case.command("solve"))
    return solved, givens


def _accuracy(scene: Scene) -> AccuracyChart:
    """Let all methods compete, a board and a hand that draw among them."""
    (solved, givens), case = _swinging(scene), scene.case
    found = rivals(givens, time.process_time, charts.EFFORT)
    mus = {plan: scale.mu for plan, scale in case.kind.first_scales(solved, case.choosers, case.plans)[1].items()}
    drawn = (*by_board(solved, time.process_time), *by_hand(solved, mus, HANDS[scene.hand]))
    return AccuracyChart(
        scene, replace(found, entries=(*found.entries, *drawn)), charts.Places("s"), "chart.hoist_compared"
    )


def _choice(scene: Scene) -> _HoistChoiceChart:
    """Look for the places of load and drum."""
    givens = complete(SolvedHoist.of(scene.case.solved).givens)
    return _HoistChoiceChart(scene, choose(givens), givens["S"])


CHARTS: charts.Gallery = {
    "accuracy": (_accuracy, ("hand",)),
    "stability": (lambda scene: _HoistStepsChart(scene, step_limits(_swinging(scene)[1])), ()),
    "roots": (lambda scene: _HoistRootsChart(scene, root_race(_swinging(scene)[1])), ()),
    "depth": (
        lambda scene: _HoistDepthChart(scene, depth(complete(scene.case.solved.givens), 0.01 * scene.tolerance)),
        ("tolerance",),
    ),
    "choice": (_choice, ()),
}
