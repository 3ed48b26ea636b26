"""Letters of a cam's quantities, by name: in the symbols of each language."""

from __future__ import annotations

from dataclasses import replace

from ...scales.packaged import packaged
from ..words import Words

DRAWING = __name__.rpartition(".cams.")[0]
CHORD = "chord"  # the mark in the index of what is read from chords: above it, it would meet the squares of derivatives
BY_CHORDS = ("mu_s", "mu_ds", "mu_d2s", "mu_v", "mu_a", "S_max", "V_max", "ds_max", "nu", "nu_a")


def lettered(words: Words) -> Words:
    """Return the words with the letters of a cam."""
    table: dict[str, str] = dict(packaged(DRAWING, "texts", f"cams.{words.language}"))
    mark = table.pop(CHORD)
    for name in BY_CHORDS:
        letter, _, index = (table.get(name) or words.symbol(name)).partition("_")
        parts = filter(None, [index.removeprefix("{").removesuffix("}"), mark])
        table[f"{name}_chord"] = f"{letter}_{{{' '.join(parts)}}}"
    symbols = words.notation["symbols"]
    merged = {**symbols, words.language: {**symbols[words.language], **table}}
    # the chain of diagrams is calculated with values of a millimetre, so that the whole sheet has them
    return replace(words, notation={**words.notation, "symbols": merged, "scales": "per mm"})
