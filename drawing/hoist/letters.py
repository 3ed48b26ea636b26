"""Letters of a hoist's quantities, by name: in the symbols of each language."""

from __future__ import annotations

from dataclasses import replace

from ...scales.packaged import packaged
from ..words import Words

DRAWING = __name__.rpartition(".hoist.")[0]


def lettered(words: Words, roots: int = 0) -> Words:
    """Return the words with the letters of a hoist that has so many roots of (12)."""
    table: dict[str, str] = dict(packaged(DRAWING, "texts", f"hoist.{words.language}"))
    drawn = table.pop("drawn")
    for n in range(1, roots + 1):
        table |= {f"t_2_{n}": f"t_{{2}}({n})", f"t_2_{n}_drawn": f"t^{{{drawn}}}_{{2}}({n})"}
    symbols = words.notation["symbols"]
    merged = {**symbols, words.language: {**symbols[words.language], **table}}
    return replace(words, notation={**words.notation, "symbols": merged, "scales": "per mm"})
