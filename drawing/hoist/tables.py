"""Tables of a hoist: its quantities with their units, what formulas and rope are judged by, scale factors."""

from __future__ import annotations

from dataclasses import replace

from ...plans.check import Check
from ...plans.hoist.forces import STRENGTH, strength
from ...plans.hoist.hoist import DRAWN
from ...plans.hoist.model import section_of
from ...plans.hoist.solve import SCALED, unit_of
from ..handouts import NOTHING, Shown
from ..printed import Input, calculation
from ..table import givens_view, table
from ..view import View
from ..words import Given
from .scene import HoistScene

USUAL = {"Pa": (1e-6, "MPa"), "m^2": (1e6, "mm^2")}
ROUNDING = 12  # digits
READING = 0.3  # mm by which a drawing is read


def data_table(scene: HoistScene) -> View:
    """Return the givens in the task's own units; stresses and areas in those in which people know them."""
    givens = {name: _usual(given) for name, given in scene.givens.items()}
    return givens_view(givens, scene.words, scene.style)


def _usual(given: Given) -> Given:
    times, unit = USUAL.get(given.unit, (1.0, given.unit))
    if isinstance(given.value, str) or times == 1.0:
        return given
    return Given(float(f"{given.value * times:.{ROUNDING}g}"), unit)


def results_table(scene: HoistScene) -> View:
    """Return what is calculated, in two halves side by side."""
    words, solved = scene.words, scene.solved
    cells = []
    for name, quantity in solved.quantities.items():
        if section_of(name) == DRAWN or name in SCALED:
            continue
        times, unit = USUAL.get(unit_of(name), (1.0, unit_of(name)))
        value = words["table.calculated"] if quantity.value is None else scene.value(quantity.value * times)
        cells.append([words.symbol(name), value, "" if unit == "1" else words.unit(unit)])
    half = (len(cells) + 1) // 2
    head = [words["table.symbol"], words["table.value"], words["table.unit"]]
    rows = [left + right for left, right in zip(cells[:half], [*cells[half:], ["", "", ""]], strict=False)]
    return table("results", words["heading.hoist_results"], [head + head, *rows], scene.style)


def checks_table(scene: HoistScene) -> View:
    """Return the conditions of validity and strength, each with its number and verdict."""
    words = scene.words
    head = [words[f"table.{name}"] for name in ("check", "condition", "value", "verdict")]
    rows = [_check_row(scene, check) for check in scene.solved.forces.checks]
    return table("checks", words["heading.hoist_checks"], [head, *rows], scene.style)


def begun() -> dict[str, Shown]:
    """Return what handouts show of the tables: the two columns in which the checks are asked."""
    return {"checks": replace(NOTHING, rows=frozenset(), columns=2)}


def _check_row(scene: HoistScene, check: Check) -> list[str]:
    words = scene.words
    condition = f"{words.symbol(check.quantity)} {check.sign} {words.short(check.limit)}"
    unit = f" {words.unit(check.unit)}" if check.unit != "1" else ""
    verdict = words["said.ok" if check.ok else "said.fails"]
    would = scene.solved.forces.motion is not None and check.name != STRENGTH and not check.ok
    value = f"{words['hoist.would_be']} " * would + scene.value(check.value) + unit
    return [words[f"hoist.{check.name}"], condition, value, verdict]


def scales_table(scene: HoistScene) -> View:
    """Return the scale factors, and by how much a reading may err."""
    words = scene.words
    head = [words["table.symbol"], words["table.value"], words["table.unit"], words["hoist.reading"]]
    rows = []
    symbols = [
        *dict.fromkeys(scene.solved.scale_of_plan.values()),
        *(s for s in SCALED if s in scene.solved.quantities),
    ]
    for symbol in dict.fromkeys(symbols):
        scale = scene.scale(symbol)
        error = f"±{words.short(round(READING * scale.mu, 12))} {words.unit(scale.unit)}"
        rows.append([words.symbol(symbol), words.short(scale.mu), words.unit(scale.per_mm_unit), error])
    return table("scales", words["heading.scales"], [head, *rows], scene.style)


def strength_lines(scene: HoistScene) -> list[tuple[str, ...]]:
    """Return the check of strength as lines: force, stress, safety, verdict; and what the article would say."""
    words, found = scene.words, scene.solved.forces.found
    greatest = words.symbol("P_12_max" if found["P_12_max"] >= found["F_12_max"] else "F_12_max")
    lines: list[tuple[str, ...]] = [
        (f"{words.symbol('F_max')} = {greatest} =", f"{scene.value(found['F_max'])} {words.unit('N')}"),
        _ratio(scene, f"{words.symbol('sigma_max')} = {words.symbol('F_max')}/S", ("F_max", 1.0), ("S", 1e6), "MPa"),
        (
            *_ratio(scene, f"[σ]/{words.symbol('sigma_max')}", ("sigma", 1e-6), ("sigma_max", 1e-6)),
            f"{'≥' if scene.solved.forces.ok[STRENGTH] else '<'} K = {words.short(found['K'])}",
        ),
        (words["hoist.strong" if scene.solved.forces.ok[STRENGTH] else "hoist.weak"],),
        (f"{words.symbol('dynamic_factor')} = {scene.value(scene.size('dynamic_factor'))}",),
    ]
    printed = strength({"safety": scene.solved.size("_safety_printed"), "K": found["K"]})
    if printed.ok != scene.solved.forces.ok[STRENGTH]:
        lines.append((words["hoist.disagrees"].format(safety=scene.value(printed.value)),))
    return lines


def _ratio(
    scene: HoistScene, letters: str, above: tuple[str, float], below: tuple[str, float], unit: str = ""
) -> tuple[str, ...]:
    """Return a ratio in letters, with numbers, and its value; a quantity is its name and its unit."""
    words, found = scene.words, scene.solved.forces.found
    inputs = [
        Input(float(f"{found[name] * times:.{ROUNDING}g}"), exact=name in scene.givens)
        for name, times in (above, below)
    ]
    (first, second), result = calculation(words, lambda a, b: a / b, inputs)
    return (f"{letters} =", f"{first}/{second} =", f"{result} {words.unit(unit)}" if unit else result)
