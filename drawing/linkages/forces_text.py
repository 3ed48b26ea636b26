"""Equations of forces: inertia, moments of the rod and the slider, force plans, balance of the driver."""

from __future__ import annotations

import math

from ...plans.linkages.parts import arm_of
from ...plans.linkages.rrp import Dyad
from ..printed import calculation, value_text
from ..table import text_block
from ..view import View
from .equations import Lines, Term, balanced, calculated, given, signed, size_of, sum_of, vector_sum
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


def arm_terms(scene: Scene, hung: list[tuple[str, str]], about: str, link: int) -> list[Term]:
    """Return the moments of forces on a link about a joint as F * h * mu_l, those that are not zero."""
    w, s, mu = scene.words, scene.solved, scene.scales["position"].mu
    terms = []
    for name, _ in hung:
        moment, arm = s.values.get(f"_M_{name}_{about}", 0.0), arm_of(name, link)
        if moment != 0.0 and scene.defined(arm):
            symbol = f"{w.symbol(name)}·{w.symbol(arm)}·{w.symbol('mu_l')}"
            factors = ((size_of(scene, name), False), (size_of(scene, arm) / mu, False), (mu, True))
            terms.append(Term(moment, symbol, factors))
    return terms


def _group_lines(scene: Scene, d: Dyad) -> Lines:
    """Return the moments of the rod about B, the force plans of the group and the rod, the moments of the slider."""
    w, s = scene.words, scene.solved
    i, j, k = d.before, d.rod.number, d.slider.number
    tangential = f"R_{i}{j}_t"
    on_rod = [(name, point) for name, point in loads(scene, j) if point != d.B]
    terms = arm_terms(scene, on_rod, d.B, j)
    couple = s.values.get(f"M_i{j}", 0.0)
    if couple != 0.0:
        terms.append(Term(couple, w.symbol(f"M_i{j}"), ((abs(couple), False),)))
    lines: Lines = []
    if terms:
        # R^t is drawn as it acts; it stands at A and turns about B against the normal to AB
        turn = math.copysign(1.0, s.values[f"_R_{i}{j}_t"])
        product = signed(-turn, f"{w.symbol(tangential)}·{w.symbol(d.length)}", first=True)
        rest = [signed(term.sign, term.symbol).strip() for term in terms]
        lines.append((f"ΣM_{{{d.B}}}({j}) = 0:", product, *rest, "= 0"))
        numbers, below, result = balanced(scene, terms, turn, given(scene, d.length))
        head = f"{w.symbol(tangential)} = ({' '.join(sum_of(terms, turn))})/{w.symbol(d.length)} ="
        lines.append((head, f"({' '.join(numbers)})/{below} =", f"{result} {w.unit('N')}"))
    else:
        product = f"{w.symbol(tangential)}·{w.symbol(d.length)}"
        lines.append((f"ΣM_{{{d.B}}}({j}) = 0:", f"{product} = 0,", f"{w.symbol(tangential)} = 0"))
    known = [tangential, *(name for name, _ in (*loads(scene, k), *loads(scene, j)))]
    lines.append(vector_sum(_bars(scene, known), _bars(scene, [f"R_0{k}", f"R_{i}{j}_n"])))
    full = [f"R_{i}{j}", *(name for name, _ in loads(scene, j))]
    lines.append(vector_sum(_bars(scene, full), [], w.symbol(f"R_{k}{j}", bar=True)))
    return [*lines, *_slider_lines(scene, d)]


def _slider_lines(scene: Scene, d: Dyad) -> Lines:
    """Return the moments of the slider about B, which say where the guide's reaction stands."""
    w, k = scene.words, d.slider.number
    h = f"h_0{k}"
    off = [(name, point) for name, point in loads(scene, k) if point != d.B]
    terms = arm_terms(scene, off, d.B, k)
    head, product = f"ΣM_{{{d.B}}}({k}) = 0:", f"{w.symbol(f'R_0{k}')}·{w.symbol(h)}"
    if not terms:
        return [(head, f"{product} = 0,", f"{w.symbol(h)} = {value_text(w, scene.solved.quantities[h].value or 0.0)}")]
    turn = math.copysign(1.0, scene.solved.values[f"_M_{k}"])
    numbers, below, result = balanced(scene, terms, turn, (size_of(scene, f"R_0{k}"), False))
    sums = " ".join(sum_of(terms, turn))
    value = f"{w.symbol(h)} = ({sums})/{w.symbol(f'R_0{k}')} ="
    return [(head, value, f"({' '.join(numbers)})/{below} =", f"{result} {w.unit('m')}")]


def _bars(scene: Scene, names: list[str]) -> list[str]:
    return [scene.words.symbol(name, bar=True) for name in names]


def _balance_lines(scene: Scene) -> Lines:
    """Return the force plan of the driver and the moments about its pivot."""
    w, s = scene.words, scene.solved
    driver = s.mechanism.driver
    crank = driver.link
    hung = [(f"R_{d.rod.number}{crank}", d.A) for d in scene.dyads if d.before == crank]
    hung += loads(scene, crank)
    lines: Lines = [vector_sum(_bars(scene, [name for name, _ in hung]), [], w.symbol(f"R_0{crank}", bar=True))]
    terms = arm_terms(scene, hung, driver.pivot, crank)
    head = f"ΣM_{{{driver.pivot}}}({crank}) = 0:"
    if not terms:
        return [*lines, (head, f"{w.symbol('M_bal')} = 0")]
    total = math.copysign(1.0, s.values["M_bal"])
    numbers, _, result = balanced(scene, terms, -total)
    formula = f"{w.symbol('M_bal')} = {' '.join(sum_of(terms, -total))} ="
    sense = w["said.ccw" if total > 0 else "said.cw"]
    return [*lines, (head, formula, f"{' '.join(numbers)} =", f"{result} {w.unit('N*m')},", sense)]
