"""Columns that stand one in the place of the other: values under millimetres, millimetres under values."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

from ...scales.units import unit
from .answers import Asked, Line, Mu

NEAR = 0.05  # part by which a product may differ from what it should be
FEWEST = 3  # lines that must tell
CLEAR = math.log(3.0)  # by how much nearer to the task's size a value must be


def put_back(lines: Mapping[str, Line], scales: Mapping[str, Mu], asked: Asked) -> dict[str, Line] | None:
    """Return the lines with segments and values exchanged where nearly all of them only then agree; else None.

    Parameters
    ----------
    scales : mapping of str to Mu
        The scale factors that stand in rows of their own, by symbol.
    """
    told = [verdict for line in lines.values() for verdict in _told(line, scales, asked)]
    if len(told) < FEWEST or sum(told) < 0.8 * len(told):
        return None
    return {name: _in_place(line, asked) for name, line in lines.items()}


def _in_place(line: Line, asked: Asked) -> Line:
    """Return a line exchanged; of a lone number the size tells what it is, for what is calculated has no segment."""
    if line.mm is not None and line.value is not None:
        return _exchanged(line, asked)
    lone = line.value if line.mm is None else unit(asked.unit(line.name)).to_si(line.mm)
    if not lone:
        return line
    quantity = asked.quantities[line.name]
    segment = quantity.mm and unit(asked.unit(line.name)).to_si(quantity.mm)
    is_value = not segment or _apart(lone, quantity.value) <= _apart(lone, segment)
    return line if is_value is (line.mm is None) else _exchanged(line, asked)


def _apart(number: float, other: float | None) -> float:
    """Return the logarithm of the ratio of two magnitudes."""
    return abs(math.log(abs(number / other))) if other else math.inf


def _told(line: Line, scales: Mapping[str, Mu], asked: Asked) -> Iterator[bool]:
    """Say of a line with segment, scale and value whether it is right only when exchanged; nothing where none agrees.

    A scale factor without a unit agrees either way, as value per millimetre and as millimetres per unit: then that
    value is meant which is of the size of the task's.
    """
    quantity = asked.quantities[line.name]
    mu, size = line.mu or scales.get(quantity.scale or ""), abs(quantity.value or 0.0)
    if mu is None or not line.mm or not line.value or not size:
        return
    other = _exchanged(line, asked)
    agrees, instead = _agrees(line, mu), _agrees(other, mu)
    if agrees != instead:
        yield instead
    elif agrees:
        off, then = (_apart(one.value or size, size) for one in (line, other))
        if abs(off - then) > CLEAR:
            yield then < off


def _agrees(line: Line, mu: Mu) -> bool:
    """Whether millimetres times the scale factor, or over it, are the value."""
    assert line.mm is not None
    assert line.value is not None
    return any(abs(line.mm * way - abs(line.value)) <= NEAR * abs(line.value) for way in mu.ways)


def _exchanged(line: Line, asked: Asked) -> Line:
    """Return a line with the two numbers exchanged, each read in the unit of its new column."""
    own = unit(asked.unit(line.name))
    value = None if line.mm is None else own.to_si(line.mm)
    mm = None if line.value is None else abs(own.from_si(line.value))
    return replace(line, mm=mm, value=value, rounded=None)
