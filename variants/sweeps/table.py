"""A sweep as text: a readable table, and CSV for spreadsheets."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from ...drawing.words import Words
from ...plans.extremes import Extreme
from ...plans.linkages.cycles.cycle import Cycle
from ...plans.linkages.cycles.diagrams import Curve, Diagrams
from ...plans.linkages.cycles.strokes import OutputMotion
from ...plans.names import role
from ...plans.quantities import unit_of
from ...scales.units import format_unit, unit
from ..spreadsheets.csv_write import csv_text
from ..tables import aligned
from .columns import (
    Column,
    all_columns,
    chosen_columns,
    driver_column,
    driver_name,
    main_columns,
    place_name,
)
from .data import quantities_of

DIGITS = 6
ROUGHLY = 4  # decimals of the angle of an extreme, near which values hardly change
ROUNDING = 1e-12  # part of the largest value of a column below which one is zero
CONSTANT = 1e-7  # part of its size within which a quantity does not change over the cycle
LESS_WANTED = ("h", "delta", "l")  # kinds of quantities whose extremes a reader hardly looks for


def as_table(cycle: Cycle, chosen: tuple[str, ...], words: Words) -> str:
    """Return positions with their main columns, then what holds for the whole cycle."""
    columns = [driver_column(cycle), Column("t", "s", cycle.times)]
    columns += chosen_columns(cycle, chosen) if chosen else main_columns(cycle)
    shown = [column.shown(words.display) for column in columns]
    head = ["", *(f"{column.name}, {format_unit(column.unit, words.language)}" for column in shown)]
    rows = [
        [
            str(k),
            *(_cell(words, column, k) for column in shown),
            "" if status == "ok" else words[f"status.{status}"],
        ]
        for k, status in enumerate(cycle.statuses)
    ]
    parts = [aligned([head, *rows], ()), *_whole_cycle(cycle, words), _extremes(cycle, chosen, words)]
    return "\n\n".join(part for part in parts if part)


def as_csv(cycle: Cycle, chosen: tuple[str, ...], words: Words) -> str:
    """Return all columns as CSV, numbers in full precision."""
    columns = [driver_column(cycle), Column("t", "s", cycle.times)]
    columns += chosen_columns(cycle, chosen) if chosen else all_columns(cycle)
    shown = [column.shown(words.display) for column in columns]
    head = ["k", *(f"{column.name} [{format_unit(column.unit, words.language)}]" for column in shown), "status"]
    rows = ([k, *(column.values[k] for column in shown), status] for k, status in enumerate(cycle.statuses))
    return csv_text([head, *rows], words.language)


def _cell(words: Words, column: Column, k: int) -> str:
    """Return one value of a column less its rounding: beside the largest, and of angles, which at limits have more."""
    value = float(column.values[k])
    size = np.max(np.abs(column.values), initial=0.0, where=np.isfinite(column.values))
    if abs(value) <= ROUNDING * size:
        value = 0.0
    return _number(words, round(value, ROUGHLY) if column.unit == "deg" else value)


def _number(words: Words, value: float) -> str:
    return words.short(float(value) + 0.0, DIGITS) if math.isfinite(value) else "–"


def _whole_cycle(cycle: Cycle, words: Words) -> Iterable[str]:
    """Say what has no position, and how every output moves."""
    apart = [(_at(cycle, words, arc.low), _at(cycle, words, arc.high)) for arc in cycle.reach.apart]
    lines = [words["sweep.apart"].format(low=low, high=high) for low, high in apart]
    lines += [words["sweep.change"].format(at=_at(cycle, words, x, ROUGHLY)) for x in cycle.reach.changes]
    lines += [words["sweep.pole"].format(at=_at(cycle, words, x)) for x in cycle.reach.poles]
    yield "\n".join(lines)
    for motion in cycle.motions:
        yield "\n".join(_output(cycle, motion, words))


def _output(cycle: Cycle, motion: OutputMotion, words: Words) -> Iterable[str]:
    """Say where an output stands dead, how far it moves and how its times compare."""
    output, travel = motion.output, motion.travel
    kind = words["sweep.slider" if output.slides else "sweep.rocker"].format(link=output.link)
    if travel is None:
        yield f"{kind}: {words['sweep.round']}"
        return
    name = place_name(output)
    spots = [
        f"{_at(cycle, words, spot.angle)} ({name} = {_amount(words, spot.place, output.unit)})" for spot in motion.dead
    ]
    yield f"{kind}: {words['sweep.stroke']} {_amount(words, travel.length, output.unit)}"
    if spots:
        yield f"  {words['sweep.dead']}: {'; '.join(spots)}"
    if motion.ratio is not None:
        yield f"  {words['sweep.ratio']}: {words.short(motion.ratio, DIGITS)}"


def _at(cycle: Cycle, words: Words, place: float, decimals: int = 7) -> str:
    """Return a place of the driver, as `phi = 30°`."""
    name = driver_name(cycle)
    if cycle.drive.turns:
        return f"{name} = {words.short(round(math.degrees(place) % 360.0, decimals) % 360.0)}°"
    return f"{name} = {_amount(words, place, 'm')}"


def _amount(words: Words, value: float, of: str) -> str:
    """Return a value with its unit, angles in degrees."""
    if of == "rad":
        return f"{words.short(round(unit('deg').from_si(value), 7), DIGITS)}°"
    shown = words.display.unit(of)
    return f"{words.short(words.display.value(value, of), DIGITS)} {format_unit(shown, words.language)}"


def _extremes(cycle: Cycle, chosen: tuple[str, ...], words: Words) -> str:
    """Return the largest and smallest values with the driver's places, constants left out."""
    names = [name for name in quantities_of(cycle, chosen) if role(name).kind not in LESS_WANTED]
    steps = {step.name: step for step in cycle.program}
    names = [name for name in names if steps[name].law != "opposite"]
    rows = [["", words["sweep.most"], "", words["sweep.least"], ""]]
    for name, (most, least) in cycle.extremes(names).items():
        if _changes(most, least):
            of = words.display.unit(unit_of(name))
            label = f"{name}, {format_unit(of, words.language)}"
            rows.append([label, *(cell for e in (most, least) for cell in _extreme(cycle, words, e, unit_of(name)))])
    if len(rows) == 1:
        return ""
    return aligned(rows, (0, 2, 4))


def _changes(most: Extreme, least: Extreme) -> bool:
    size = max(abs(most.value), abs(least.value))
    return not np.isfinite(size) or most.value - least.value > CONSTANT * size


def _extreme(cycle: Cycle, words: Words, extreme: Extreme, of: str) -> tuple[str, str]:
    """Return an extreme value and where it is."""
    if math.isinf(extreme.value):
        value = "∞" if extreme.value > 0.0 else "−∞"
    else:
        value = words.short(words.display.value(extreme.value, of) + 0.0, DIGITS)
    return value, _at(cycle, words, extreme.at, ROUGHLY)


def as_chords(drawn: Diagrams, of: str, words: Words) -> str:
    """Return the velocities and accelerations of a point or a link by plans and by chords side by side."""
    symbols = ("omega", "epsilon") if drawn.unit == "rad" else ("V", "a")
    curves = ((symbols[0], f"{drawn.unit}/s", drawn.velocity), (symbols[1], f"{drawn.unit}/s^2", drawn.acceleration))
    return "\n\n".join(_chords(f"{symbol}_{of}", unit_name, curve, words) for symbol, unit_name, curve in curves)


def _chords(name: str, of: str, curve: Curve, words: Words) -> str:
    """Return one curve by plans and by chords; of vectors the sizes, and the size of their difference."""
    shown = format_unit(words.display.unit(of), words.language)
    seconds, per_cent = (format_unit(x, words.language) for x in ("s", "%"))
    head = [f"t, {seconds}", f"{name} {words['sweep.plans']}, {shown}", words["sweep.chords"]]
    rows = [[*head, f"{words['sweep.difference']}, {per_cent}"]]
    for t, plan, chord, part in zip(curve.times, curve.plans, curve.chords, curve.per_cent, strict=True):
        values = (abs(x) if np.iscomplexobj(curve.plans) else x for x in (plan, chord))
        cells = (_number(words, words.display.value(float(x), of)) for x in values)
        rows.append([_number(words, t), *cells, words.number(part, 2) if math.isfinite(part) else "–"])
    return aligned(rows, ())
