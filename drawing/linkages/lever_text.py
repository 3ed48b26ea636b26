"""Equation of Zhukovsky's lever, the balancing force and moment, and their difference from the force plans."""

from __future__ import annotations

import math

from ..printed import calculation, value_text
from ..table import text_block
from ..view import View
from .equations import Lines, Term, balanced, given, signed, size_of
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
    driver, mu = s.mechanism.driver, scene.scales["lever"].mu
    terms = []
    for name, _ in hung_on_lever(scene):
        moment, arm = s.values.get(f"_M_{name}_p", 0.0), arm_of(name)
        if moment != 0.0 and scene.defined(arm):
            factors = ((s.size(name), False), (size_of(scene, arm) / mu, False))
            terms.append(Term(moment, f"{w.symbol(name)}·{w.symbol(arm)}", factors))
    balance, speed = s.values["F_bal"], s.values[f"_V_{driver.point}"]
    segment = f"{w.mark('velocity.p')}{w.mark('velocity.' + driver.point)}"
    # F_bal along the crank's normal has the moment -F_bal * V_A, with the signs of both
    turn = math.copysign(1.0, balance * speed)
    own = signed(-turn, f"{w.symbol('F_bal')}·{segment}", first=True)
    rest = [signed(term.sign, term.symbol).strip() for term in terms]
    lines: Lines = [(f"ΣM_{{{w.mark('lever.p')}}} = 0:", own, *rest, "= 0")]
    if terms:
        numbers, below, result = balanced(scene, terms, turn, (abs(speed) / mu, False))
        numbers[0] = f"({numbers[0]}"
        numbers[-1] = f"{numbers[-1]})/{below} ="
        lines.append((f"{w.symbol('F_bal')} =", *numbers, f"{result} {w.unit('N')}"))
    length = s.mechanism.link(driver.link).points[driver.point][0]
    texts, result = calculation(w, lambda x, y: x * y, [(abs(balance), False), given(scene, length)])
    head = f"{w.symbol('M_bal_lever')} = {w.symbol('F_bal')}·{w.symbol(length)} ="
    lines.append((head, f"{texts[0]}·{texts[1]} =", f"{result} {w.unit('N*m')}"))
    return [*lines, *_difference_line(scene)]


def _difference_line(scene: Scene) -> Lines:
    """Return the difference of the two balancing moments in per cent, of their printed values."""
    w, values = scene.words, scene.solved.values
    lever, plan = abs(values["M_bal_lever"]), abs(values.get("M_bal", 0.0))
    if "M_bal" not in values or lever == 0.0:
        return []
    a, b = value_text(w, lever), value_text(w, plan)
    symbols = w.symbol("M_bal_lever"), w.symbol("M_bal")
    head = f"{w.symbol('delta_M_bal')} = ({symbols[0]} − {symbols[1]})/{symbols[0]}·100 % ="
    return [(head, f"({a} − {b})/{a}·100 % =", f"{w.number(values['delta_M_bal'], 2)} %")]
