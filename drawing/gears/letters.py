"""Letters of a gear pair's quantities, by name: in the symbols of each language."""

from __future__ import annotations

from dataclasses import replace

from ...plans.gears.geometry import POINTS
from ...scales.packaged import packaged
from ..words import Words

DRAWING = __name__.rpartition(".gears.")[0]
OF_POINTS = {"y_1": "y_{1}", "y_2": "y_{2}", "theta_12": "θ_{12}", "theta_21": "θ_{21}"}


def lettered(words: Words) -> Words:
    """Return the words with the letters of a gear pair; what is of a point of the sliding table has its number."""
    table: dict[str, str] = dict(packaged(DRAWING, "texts", f"gears.{words.language}"))
    for name, letter in OF_POINTS.items():
        table |= {f"{name}_{point}": f"{letter}({int(point)})" for point in POINTS}
    symbols = words.notation["symbols"]
    merged = {**symbols, words.language: {**symbols[words.language], **table}}
    return replace(words, notation={**words.notation, "symbols": merged, "scales": "per mm"})
