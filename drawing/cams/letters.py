"""Letters of a cam's quantities, by name: in the symbols of each language."""

from __future__ import annotations

from dataclasses import replace

from ..words import Words

SYMBOLS = (
    *("phi_rise", "phi_upper", "phi_fall", "phi_lower", "u_fall", "l_A1", "l_A2", "A_1", "A_2"),
    *("gamma_rise", "gamma_fall", "gamma_rise_min", "gamma_fall_min"),
    *("mu_ds", "mu_d2s", "S_max", "V_max", "s_max", "ds_max", "v_max", "a_max"),
    *("R_roller", "R_plate", "rho_min", "rho_flat", "margin", "r_0", "s_0", "r_0_flat", "r_0_flat_min"),
    *("r_0_tangents", "e_tangents", "r_0_flat_tangent"),
    *("nu", "nu_a", "mu_theta", "theta", "gamma", "s", "ds", "d2s", "phi", "s_close", "v_close"),
)


def lettered(words: Words) -> Words:
    """Return the words with the letters of a cam; what is read from chords has the same with a mark above."""
    table = {name: words.texts[f"symbol.{name}"] for name in SYMBOLS}
    mark = words["symbol.chord"]
    for name in ("mu_s", "mu_ds", "mu_d2s", "mu_v", "mu_a", "S_max", "V_max", "ds_max", "nu", "nu_a"):
        letter, _, index = (table.get(name) or words.symbol(name)).partition("_")
        table[f"{name}_chord"] = f"{letter}^{{{mark}}}" + (f"_{index}" if index else "")
    symbols = words.notation["symbols"]
    merged = {**symbols, words.language: {**symbols[words.language], **table}}
    return replace(words, notation={**words.notation, "symbols": merged})
