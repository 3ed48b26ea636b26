"""Equation of Zhukovsky's lever, the balancing force and moment, and their difference from the force plans."""

from __future__ import annotations

import math

from ..printed import calculation, value_text
from ..table import text_block
from ..view import View
from .equations import Lines, given, signed, size_of
from .forces_text import inertia_lines
from .lever_view import arm_of, hung_on_lever
from .scene import Scene


def lever_block(scene: Scene, width: float, with_inertia: bool) -> View:
    """Return the moment equation of Zhukovsky's lever and the comparison of the two balancing moments."""
    lines = (inertia_lines(scene) if with_inertia else []) + _couple_lines(scene) + _lever_lines(scene)
    return text_block("equations_lever", scene.words["heading.equations_lever"], lines, scene.style, width)


def _couple_lines(scene: Scene) -> Lines:
    w = scene.words
    lines: Lines = []
    for d in scene.dyads:
        name, pair = f"M_i{d.rod.number}", f"F_i{d.rod.number}_couple"
        if scene.defined(pair):
            size = abs(scene.solved.values[name])
            texts, result = calculation(w, lambda x, y: x / y, [(size, False), given(scene, d.length)])
            head = (
                f"{w.symbol(pair + '_' + d.B)} = {w.symbol(pair + '_' + d.A)} = {w.symbol(name)}/{w.symbol(d.length)} ="
            )
            lines.append((head, f"{texts[0]}/{texts[1]} =", f"{result} {w.unit('N')}"))
    return lines


def _lever_lines(scene: Scene) -> Lines:
    """Sum of moments about the pole, each force times its arm in mm; solved for F_bal; M_bal; the difference."""
    w, s = scene.words, scene.solved
    driver = s.mechanism.driver
    mu = scene.scales["lever"].mu
    terms = []
    for name, mark in hung_on_lever(scene):
        moment = s.values.get(f"_M_{name}_p", 0.0)
        arm = arm_of(name)
        if name != "_F_bal" and moment != 0.0 and scene.defined(arm):
            terms.append((math.copysign(1.0, moment), name, arm, mark))
    balance = s.values["F_bal"]
    pa = s.size(f"_V_{driver.point}") / mu
    segment = f"{w.mark('velocity.p')}{w.mark('velocity.' + driver.point)}"
    # F_bal along the crank's normal has the moment -F_bal * V_A, with the signs of both
    turn = -math.copysign(1.0, balance * s.values[f"_V_{driver.point}"])
    head = signed(turn, f"{w.symbol('F_bal')}·{segment}", first=True)
    sums = [signed(sign, f"{w.symbol(n)}·{w.symbol(h)}").strip() for sign, n, h, _ in terms]
    lines: Lines = [("ΣM_{p} = 0:", head, *sums, "= 0")]
    signs = [-turn * sign for sign, *_ in terms]
    inputs = [pair for _, n, h, _ in terms for pair in ((s.size(n), False), (size_of(scene, h) / mu, False))]

    def law(*x: float) -> float:
        return sum(sign * x[2 * i] * x[2 * i + 1] for i, sign in enumerate(signs)) / x[-1]

    texts, result = calculation(w, law, [*inputs, (pa, False)])
    products = [
        signed(sign, f"{texts[2 * i]}·{texts[2 * i + 1]}", first=i == 0).strip() for i, sign in enumerate(signs)
    ]
    if products:
        lines.append((f"{w.symbol('F_bal')} = (", *products, f")/{texts[-1]} =", f"{result} {w.unit('N')}"))
    length = s.mechanism.link(driver.link).points[driver.point][0]
    moment = abs(s.values["M_bal_lever"])
    texts, result = calculation(w, lambda x, y: x * y, [(abs(balance), False), given(scene, length)])
    lines.append(
        (
            f"{w.symbol('M_bal_lever')} = {w.symbol('F_bal')}·{w.symbol(length)} =",
            f"{texts[0]}·{texts[1]} =",
            f"{result} {w.unit('N*m')}",
        )
    )
    if "M_bal" in s.quantities and moment > 0.0:
        shown, plan = value_text(w, moment), value_text(w, abs(s.values["M_bal"]))
        pattern = f"({w.symbol('M_bal_lever')} − {w.symbol('M_bal')})/{w.symbol('M_bal_lever')}·100 % ="
        per_cent = s.values["delta_M_bal"]
        lines.append(
            (
                f"{w.symbol('delta_M_bal')} = {pattern}",
                f"({shown} − {plan})/{shown}·100 % =",
                f"{w.number(per_cent, 2)} %",
            )
        )
    return lines
