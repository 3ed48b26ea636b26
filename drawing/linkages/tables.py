"""Tables of a linkage sheet: what is given, and what was measured and calculated."""

from __future__ import annotations

from ...plans.linkages.solved import Solved
from ...plans.quantities import Quantity
from ..printed import segment_decimals, value_text
from ..table import table
from ..view import View
from .scene import Scene

HEADS = {"V": "velocity", "omega": "velocity", "a": "acceleration", "epsilon": "acceleration"}


def kind_of(name: str) -> str:
    """Return the table in which a quantity stands."""
    if name.startswith("h_lever") or name in ("F_bal", "M_bal_lever", "delta_M_bal") or name.endswith("_couple"):
        return "lever"
    return HEADS.get(name.partition("_")[0], "forces")


def givens_table(scene: Scene) -> View:
    """Return the table of the givens in the task's own units."""
    words = scene.words
    rows = [[words["table.symbol"], words["table.value"], words["table.unit"]]]
    for name, given in scene.givens.items():
        if isinstance(given.value, str):
            rows.append(
                [words.texts.get(f"given.{name}", name), words.texts.get(f"choice.{given.value}", given.value), ""]
            )
        else:
            rows.append([words.symbol(name), words.short(given.value), words.unit(given.unit)])
    return table("givens", words["heading.givens"], rows, scene.style)


def kinds_of_results(solved: Solved) -> tuple[str, ...]:
    """Return which tables of results there are."""
    return tuple(dict.fromkeys(kind_of(q.name) for q in _results(solved)))


def results_table(scene: Scene, kind: str) -> View:
    """Return the table of the results of one kind of plan."""
    words = scene.words
    head = [words[f"table.{key}"] for key in ("quantity", "segment", "scale", "value", "unit")]
    rows = [_row(scene, q) for q in _results(scene.solved) if kind_of(q.name) == kind]
    return table(f"results_{kind}", words[f"heading.results_{kind}"], [head, *rows], scene.style)


def _results(solved: Solved) -> list[Quantity]:
    """Return what the tables show: all quantities but points, lengths, and each force of a pair."""
    shown = (q for q in solved.quantities.values() if q.kind != "point" and q.value is not None)
    return [q for q in shown if not q.name.startswith("l_") and "_couple_" not in q.name]


def _row(scene: Scene, q: Quantity) -> list[str]:
    words, value = scene.words, q.value or 0.0
    symbol = words.symbol(q.name)
    unit = words.unit(q.unit)
    plan = scene.solved.shown_on.get(q.name, "")
    if plan not in scene.scales:
        return [symbol, words["table.calculated"], words["table.calculated"], value_text(words, tidy(scene, q)), unit]
    mu = scene.scales[plan].mu
    places, decimals = segment_decimals(value, mu)
    return [symbol, words.number(abs(value) / mu, places), words.short(mu), words.number(abs(value), decimals), unit]


def tidy(scene: Scene, q: Quantity) -> float:
    """Return the value: of a force its magnitude, of a difference 0 where it is rounding noise."""
    value = abs(q.value or 0.0) if q.name.startswith("F") else q.value or 0.0
    return 0.0 if q.name.startswith("delta") and abs(value) < 1e-6 else value
