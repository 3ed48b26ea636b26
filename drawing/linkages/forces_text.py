"""Equations of forces: inertia, moments of the rod and the slider, force plans, balance of the driver."""

from __future__ import annotations

import math

from ...plans.linkages.rrp import Dyad
from ..printed import calculation, value_text
from ..table import text_block
from ..view import View
from .equations import Lines, calculated, given, signed, size_of, vector_sum
from .group_view import loads
from .scene import Scene


def forces_block(scene: Scene, width: float) -> View:
    """Return inertia forces, moment equations, vector equations of the force plans, and the driver's balance."""
    lines: Lines = inertia_lines(scene)
    for d in reversed(scene.dyads):
        lines += _group_lines(scene, d)
    lines += _balance_lines(scene)
    return text_block("equations_forces", scene.words["heading.equations_forces"], lines, scene.style, width)


def inertia_lines(scene: Scene) -> Lines:
    """Return the calculations of the inertia forces and moments."""
    w = scene.words
    lines: Lines = []
    for link in scene.solved.mechanism.links:
        force, moment = f"F_i{link.number}", f"M_i{link.number}"
        if link.mass and scene.defined(force):
            a = f"a_{link.centre}"
            lines.append(
                calculated(
                    scene,
                    force,
                    f"{w.symbol(link.mass)}·{w.symbol(a)}",
                    "{}·{}",
                    lambda x, y: x * y,
                    given(scene, link.mass),
                    (size_of(scene, a), False),
                )
            )
        if link.inertia and scene.defined(moment):
            rate = f"epsilon_{link.number}"
            size = abs(scene.solved.values[rate])
            texts, result = calculation(w, lambda x, y: x * y, [given(scene, link.inertia), (size, False)])
            head = f"{w.symbol(moment)} = {w.symbol(link.inertia)}·{w.symbol(rate)} ="
            lines.append((head, f"{texts[0]}·{texts[1]} =", f"{result} {w.unit('N*m')}"))
    return lines


def _group_lines(scene: Scene, d: Dyad) -> Lines:
    w = scene.words
    i, j, k = d.before, d.rod.number, d.slider.number
    tangential, length = f"R_{i}{j}_t", d.length
    mu = scene.scales["position"].mu
    terms, inputs, pattern = [], [], []
    signs: list[float] = []
    for name, point in loads(scene, j):
        moment = scene.solved.values.get(f"_M_{name}_{d.B}", 0.0)
        if point != d.B and moment != 0.0:
            arm = f"h_{j}" if name == f"F_i{j}" else f"h_{name}"
            terms.append((moment, f"{w.symbol(name)}·{w.symbol(arm)}·{w.symbol('mu_l')}"))
            inputs += [(size_of(scene, name), False), (size_of(scene, arm) / mu, False), (mu, True)]
            pattern.append("{}·{}·{}")
            signs.append(math.copysign(1.0, moment))
    if d.rod.inertia and scene.solved.values[f"M_i{j}"] != 0.0:
        moment = scene.solved.values[f"M_i{j}"]
        terms.append((moment, w.symbol(f"M_i{j}")))
        inputs.append((abs(moment), False))
        pattern.append("{}")
        signs.append(math.copysign(1.0, moment))
    lines: Lines = []
    if terms:
        turn = -math.copysign(1.0, scene.solved.values[f"_R_{i}{j}_t"])
        sums = "".join(signed(m, text) for m, text in terms)
        lines.append(
            (
                f"ΣM_{{{d.B}}}({j}) = 0:",
                f"{signed(turn, f'{w.symbol(tangential)}·{w.symbol(length)}', first=True)}{sums} = 0",
            )
        )
        signs = [-turn * sign for sign in signs]
        numbers = "".join(signed(s, p, first=n == 0) for n, (s, p) in enumerate(zip(signs, pattern, strict=True)))
        formula = "".join(signed(s, t, first=n == 0) for n, (s, (_, t)) in enumerate(zip(signs, terms, strict=True)))

        def law(*x: float) -> float:
            total, at = 0.0, 0
            for sign, part in zip(signs, pattern, strict=True):
                count = part.count("{}")
                total += sign * math.prod(x[at : at + count])
                at += count
            return total / x[-1]

        lines.append(
            calculated(
                scene,
                tangential,
                f"({formula})/{w.symbol(length)}",
                f"({numbers})/{{}}",
                law,
                *inputs,
                given(scene, length),
            )
        )
    known = [tangential, *(name for name, _ in (*loads(scene, k), *loads(scene, j)))]
    unknown = [f"R_0{k}", f"R_{i}{j}_n"]
    lines.append(
        vector_sum(w_known=[w.symbol(n, bar=True) for n in known], w_line=[w.symbol(n, bar=True) for n in unknown])
    )
    full = [f"R_{i}{j}", *(name for name, _ in loads(scene, j))]
    lines.append(
        vector_sum(w_known=[w.symbol(n, bar=True) for n in full], w_line=[], unknown=w.symbol(f"R_{k}{j}", bar=True))
    )
    h = f"h_0{k}"
    value = value_text(w, scene.solved.quantities[h].value or 0.0)
    lines.append((f"ΣM_{{{d.B}}}({k}) = 0:", f"{w.symbol(f'R_0{k}')}·{w.symbol(h)} = 0,", f"{w.symbol(h)} = {value}"))
    return lines


def _balance_lines(scene: Scene) -> Lines:
    w, s = scene.words, scene.solved
    driver = s.mechanism.driver
    crank = driver.link
    mu = scene.scales["position"].mu
    lines: Lines = []
    forces = [f"R_{d.rod.number}{crank}" for d in scene.dyads if d.before == crank]
    forces += [name for name, _ in loads(scene, crank)]
    known = [w.symbol(name, bar=True) for name in forces]
    lines.append(vector_sum(w_known=known, w_line=[], unknown=w.symbol(f"R_0{crank}", bar=True)))
    signs = [-math.copysign(1.0, s.values[f"_M_{name}_{driver.pivot}"]) for name in forces]
    total = math.copysign(1.0, s.values["M_bal"])
    arms = [f"h_{name.removeprefix('R_')}" for name in forces]
    if all(scene.defined(arm) for arm in arms):
        signs = [sign * total for sign in signs]
        formula = "".join(
            signed(sign, f"{w.symbol(n)}·{w.symbol(h)}·{w.symbol('mu_l')}", first=i == 0)
            for i, (sign, n, h) in enumerate(zip(signs, forces, arms, strict=True))
        )
        pattern = "".join(signed(sign, "{}·{}·{}", first=i == 0) for i, sign in enumerate(signs))

        def law(*x: float) -> float:
            return sum(sign * x[3 * i] * x[3 * i + 1] * x[3 * i + 2] for i, sign in enumerate(signs))

        inputs = [
            pair
            for n, h in zip(forces, arms, strict=True)
            for pair in ((size_of(scene, n), False), (size_of(scene, h) / mu, False), (mu, True))
        ]
        sense = w["said.ccw" if total > 0 else "said.cw"]
        texts, result = calculation(w, law, inputs)
        head = f"ΣM_{{{driver.pivot}}}({crank}) = 0:"
        lines.append(
            (
                head,
                f"{w.symbol('M_bal')} = {formula} =",
                f"{pattern.format(*texts)} =",
                f"{result} {w.unit('N*m')},",
                sense,
            )
        )
    return lines
