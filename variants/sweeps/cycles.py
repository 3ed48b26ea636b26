"""The cycle of a linkage as columns of numbers, and told: a readable table, CSV for spreadsheets, JSON."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...drawing.words import Words
from ...plans.linkages.cycles.cycle import Curve, Cycle, Diagrams
from ...plans.linkages.cycles.strokes import Output, OutputMotion
from ...plans.linkages.mechanism import Mechanism
from ...plans.names import role
from ...plans.quantities import BALANCES, unit_of
from ...plans.solved import Columned
from ...plans.zeros import Extreme
from ...scales.units import format_unit, unit
from ..tables import aligned, csv_text
from .sweeps import numbers

Array = NDArray[Any]
DIGITS = 6
ROUGHLY = 4  # decimals of the angle of an extreme, near which values hardly change
ROUNDING = 1e-12  # part of the largest value of a column below which one is zero
CONSTANT = 1e-7  # part of its size within which a quantity does not change over the cycle
LESS_WANTED = ("h", "delta", "l")  # kinds of quantities whose extremes a reader hardly looks for


def driver_column(cycle: Cycle) -> Columned:
    """Return where the driver stands: an angle within a turn, or a travel."""
    name = driver_name(cycle)
    if not cycle.drive.turns:
        return Columned(name, "m", cycle.angles)
    turn = 2.0 * np.pi
    within = cycle.angles % turn
    return Columned(name, "rad", np.where(np.abs(within - turn) < 1e-12, 0.0, within))


def driver_name(cycle: Cycle) -> str:
    """Return the name of the driver's variable, `phi` or `s` where the task has a literal in its place."""
    variable = cycle.drive.variable
    return ("phi" if cycle.drive.turns else "s") if role(variable).hidden else variable


def place_name(output: Output) -> str:
    """Return the name of an output's place: the travel of a slider, the angle of a rocker."""
    return f"{'s' if output.slides else 'phi'}_{output.link}"


def output_columns(cycle: Cycle, output: Output) -> list[Columned]:
    """Return place, velocity and acceleration of a link on the frame, as far as the plans go."""
    if output.place not in cycle.values:
        return []
    place = Columned(place_name(output), output.unit, output.places(cycle.values))
    rates = [(output.rate, "V", "m/s"), (output.change, "a", "m/s^2")]
    if not output.slides:
        rates = [(output.rate, "omega", "rad/s"), (output.change, "epsilon", "rad/s^2")]
    found = ((f"{symbol}_{output.link}", of, cycle.values.get(name or "")) for name, symbol, of in rates)
    return [place, *(Columned(name, of, values) for name, of, values in found if values is not None)]


def quantity_columns(name: str, values: Array, point: bool = False) -> Iterator[Columned]:
    """Go through the columns of a quantity: of a vector its size and components, of a point its coordinates."""
    of = unit_of(name)
    if not np.iscomplexobj(values):
        yield Columned(name, of, values)
        return
    if not point:
        yield Columned(name, of, np.hypot(values.real, values.imag))
    yield Columned(f"{name}.x", of, values.real)
    yield Columned(f"{name}.y", of, values.imag)


def all_columns(cycle: Cycle) -> list[Columned]:
    """Return columns of the links on the frame, of all points and of all quantities."""
    columns = [column for output in cycle.outputs for column in output_columns(cycle, output)]
    seen = {column.name for column in columns}
    points = [name for name in letters(cycle.mechanism) if name in cycle.values]
    for name in (*points, *cycle.quantities):
        if name not in seen:
            columns += quantity_columns(name, cycle.values[name], name in points)
    return columns


def main_columns(cycle: Cycle) -> list[Columned]:
    """Return the columns of a readable table: how the outputs move, and what balances the driver."""
    columns = [column for output in cycle.outputs for column in output_columns(cycle, output)]
    balance = next((name for name in BALANCES if name in cycle.values), None)
    return columns + (list(quantity_columns(balance, cycle.values[balance])) if balance else [])


def chosen_columns(cycle: Cycle, chosen: tuple[str, ...]) -> list[Columned]:
    """Return the columns of points, by their letters, and of links, by their numbers."""
    columns: list[Columned] = []
    outputs = {str(output.link): output for output in cycle.outputs}
    for one in chosen:
        if one in outputs:
            columns += output_columns(cycle, outputs[one])
        for name in (one, f"V_{one}", f"a_{one}", f"omega_{one}", f"epsilon_{one}"):
            if name in cycle.values and all(column.name != name for column in columns):
                columns += quantity_columns(name, cycle.values[name], name == one)
    return columns


def letters(mechanism: Mechanism) -> tuple[str, ...]:
    """Return the letters of all points."""
    points = (point for link in mechanism.links for point in link.points)
    return tuple(dict.fromkeys((*mechanism.frame_points, *points)))


def _shown(cycle: Cycle, columns: list[Columned], words: Words) -> list[Columned]:
    """Return the driver's place, the time and columns in the units of the words, angles in degrees."""
    in_degrees: Callable[[Any], Any] = unit("deg").from_si
    shown: Callable[[Any, str], Any] = words.display.value
    return [
        Columned(column.name, "deg", in_degrees(column.values))
        if column.unit == "rad"
        else Columned(column.name, words.display.unit(column.unit), shown(column.values, column.unit))
        for column in (driver_column(cycle), Columned("t", "s", cycle.times), *columns)
    ]


def as_table(cycle: Cycle, chosen: tuple[str, ...], words: Words) -> str:
    """Return positions with their main columns, then what holds for the whole cycle."""
    shown = _shown(cycle, chosen_columns(cycle, chosen) if chosen else main_columns(cycle), words)
    head = ["", *(f"{column.name}, {format_unit(column.unit, words.language)}" for column in shown)]
    statuses = ["" if status == "ok" else words[f"status.{status}"] for status in cycle.statuses]
    rows = [[str(k), *(_cell(words, column, k) for column in shown), said] for k, said in enumerate(statuses)]
    parts = [aligned([head, *rows], ()), *_whole_cycle(cycle, words), _extremes(cycle, chosen, words)]
    return "\n\n".join(part for part in parts if part)


def as_csv(cycle: Cycle, chosen: tuple[str, ...], words: Words) -> str:
    """Return all columns as CSV, numbers in full precision."""
    shown = _shown(cycle, chosen_columns(cycle, chosen) if chosen else all_columns(cycle), words)
    head = ["k", *(f"{column.name} [{format_unit(column.unit, words.language)}]" for column in shown), "status"]
    rows = ([k, *(column.values[k] for column in shown), status] for k, status in enumerate(cycle.statuses))
    return csv_text([head, *rows], words.language)


def _cell(words: Words, column: Columned, k: int) -> str:
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


def as_json(cycle: Cycle, chosen: tuple[str, ...]) -> dict[str, Any]:
    """Return the cycle as data; `chosen` points and links only, or all."""
    names = quantities_of(cycle, chosen)
    found = cycle.extremes(names)
    turns = cycle.drive.turns
    return {
        "driver": {
            "name": driver_name(cycle),
            "kind": "crank" if turns else "slider",
            "unit": "rad" if turns else "m",
            "sense": cycle.drive.sense,
            "speed": cycle.speed,
            "zero": cycle.zero,
        },
        "places": numbers(cycle.angles),
        "times": numbers(cycle.times),
        "statuses": list(cycle.statuses),
        "points": {name: _vector(cycle.values[name], "m") for name in points_of(cycle, chosen)},
        "quantities": {name: _quantity(name, cycle.values[name]) for name in names},
        "outputs": [_output_data(cycle, motion) for motion in cycle.motions],
        "extremes": {
            name: {"unit": unit_of(name), "max": _extreme_data(most), "min": _extreme_data(least)}
            for name, (most, least) in found.items()
        },
        "unreachable": [{"from": arc.low, "to": arc.high} for arc in cycle.reach.apart],
        "change_points": list(cycle.reach.changes),
        "parallel_guides": list(cycle.reach.poles),
    }


def points_of(cycle: Cycle, chosen: tuple[str, ...]) -> tuple[str, ...]:
    """Return the points that were chosen, or all."""
    return tuple(name for name in letters(cycle.mechanism) if name in cycle.values and (not chosen or name in chosen))


def quantities_of(cycle: Cycle, chosen: tuple[str, ...]) -> tuple[str, ...]:
    """Return the quantities of what was chosen, or all."""
    if not chosen:
        return cycle.quantities
    wanted = {f"{symbol}_{one}" for one in chosen for symbol in ("V", "a", "omega", "epsilon")}
    return tuple(name for name in cycle.quantities if name in wanted)


def _quantity(name: str, values: NDArray[Any]) -> dict[str, Any]:
    if np.iscomplexobj(values):
        size = np.hypot(values.real, values.imag)
        return {"unit": unit_of(name), "value": numbers(size), **_vector(values)}
    return {"unit": unit_of(name), "value": numbers(values)}


def _vector(values: NDArray[Any], unit: str | None = None) -> dict[str, Any]:
    head = {} if unit is None else {"unit": unit}
    return head | {"x": numbers(values.real), "y": numbers(values.imag)}


def _output_data(cycle: Cycle, motion: OutputMotion) -> dict[str, Any]:
    output, travel = motion.output, motion.travel
    return {
        "link": output.link,
        "kind": "slider" if output.slides else "rocker",
        "unit": output.unit,
        "places": numbers(output.places(cycle.values)) if output.place in cycle.values else None,
        "dead": [
            {"at": spot.angle, "place": spot.place, "end": "high" if spot.high else "low"} for spot in motion.dead
        ],
        "stroke": None if travel is None else travel.length,
        "low": None if travel is None else {"at": travel.angle_low, "place": travel.low},
        "high": None if travel is None else {"at": travel.angle_high, "place": travel.high},
        "time_ratio": motion.ratio,
    }


def _extreme_data(extreme: Extreme) -> dict[str, Any]:
    """Return an extreme value; one without bound is null."""
    return {"value": extreme.value if math.isfinite(extreme.value) else None, "at": extreme.at}
