"""Letters of a cam's quantities, by name: in the symbols of each language."""

from __future__ import annotations

import re
from dataclasses import replace

from ...plans.cams.sections import EXACT_OF
from ...scales.packaged import packaged
from ..words import Words

DRAWING = __name__.rpartition(".cams.")[0]
INDEXED = re.compile(r"([^_]+)(?:_\{?(.*?)\}?)?")  # a symbol: its letter, its index
CHORD = "chord"  # the mark in the index of what is read from chords: above it, it would meet the squares of derivatives


def lettered(words: Words) -> Words:
    """Return the words with the letters of a cam."""
    table: dict[str, str] = dict(packaged(DRAWING, "texts", f"cams.{words.language}"))
    mark = table.pop(CHORD)
    for name, exact in EXACT_OF.items():
        letter, index = INDEXED.fullmatch(table.get(exact) or words.symbol(exact)).groups("")  # type: ignore[union-attr]
        table[name] = f"{letter}_{{{' '.join(filter(None, (index, mark)))}}}"
    symbols = words.notation["symbols"]
    merged = {**symbols, words.language: {**symbols[words.language], **table}}
    # the chain of diagrams is calculated with values of a millimetre, so that the whole sheet has them
    return replace(words, notation={**words.notation, "symbols": merged, "scales": "per mm"})
