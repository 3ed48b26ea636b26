"""Tables, formulas with their numbers and conclusions of a hoist, and what sentences about its drawings name."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from ...plans.hoist.forces import ROPE_1, STRENGTH, strength
from ...plans.hoist.hoist import DRAWN
from ...plans.hoist.model import CIRCLE, section_of
from ...plans.hoist.solve import SCALED, unit_of
from ...plans.laws import form_of
from ...plans.names import role
from ...scales.scale import Scale
from ...scales.units import USUAL, unit
from ..handouts import Shown as Begun
from ..notes.blocks import Story
from ..printed import Input, Shown, Symbol, calculation, number_of, places_of, worked
from ..tables import givens_view, table, text_block, words_of
from ..view import View
from ..words import Given, Words
from .scene import HoistScene

ROUNDING = 12  # digits
READING = 0.3  # mm by which a drawing is read
WIDTH = 120.0  # mm of lines of text
MM = 1e3
Texts = Mapping[str, str]
LARGE, SMALL, DIGITS, PAPER = 1e6, 1e-3, 4, 1  # sizes from which on a number has a power of ten; decimals


def data_table(scene: HoistScene, stated: bool = False) -> View:
    """Return the givens in the task's own units; stresses and areas in those in which people know them.

    Where they are `stated` it says what they are called.
    """
    givens = dict(scene.givens)
    for name, given in givens.items():
        if given.unit in USUAL and not isinstance(given.value, str):
            usual = USUAL[given.unit]
            givens[name] = Given(float(f"{unit(usual).from_si(given.value):.{ROUNDING}g}"), usual)
    numbers = [name for name, given in givens.items() if not isinstance(given.value, str)]
    called = {name: scene.words[f"called.hoist.{name}"] for name in numbers} if stated else None
    return givens_view(givens, scene.words, scene.style, called=called)


def results_table(scene: HoistScene) -> View:
    """Return what is calculated, in two halves side by side."""
    words, solved = scene.words, scene.solved
    cells = []
    for name, quantity in solved.quantities.items():
        if section_of(name) == DRAWN or name in SCALED or (name == "F_12_min" and _rises(scene)):
            continue
        usual = USUAL.get(unit_of(name), unit_of(name))
        value = words["table.calculated"]
        if quantity.value is not None:
            size = unit(usual).from_si(quantity.value)
            value = _number(scene, size) if abs(size) >= LARGE else scene.value(size)
        cells.append([words.symbol(name), value, "" if usual == "1" else words.unit(usual)])
    half = (len(cells) + 1) // 2
    head = _head(words, "symbol", "value", "unit")
    rows = [left + right for left, right in zip(cells[:half], [*cells[half:], ["", "", ""]], strict=False)]
    return table("results", words["heading.hoist_results"], [head + head, *rows], scene.style)


def checks_table(scene: HoistScene) -> View:
    """Return the conditions of validity and strength, each with its number and verdict."""
    words = scene.words
    rows = [_head(words, "check", "condition", "value", "verdict")]
    for check in scene.solved.forces.checks:
        rises = check.name == ROPE_1 and _rises(scene)
        condition = f"{words.symbol('F_12_t1' if rises else check.quantity)} {check.sign} {words.short(check.limit)}"
        unit = f" {words.unit(check.unit)}" if check.unit != "1" else ""
        would = scene.solved.forces.motion is not None and check.name != STRENGTH and not check.ok
        value = f"{words['hoist.would_be']} " * would + scene.value(check.value) + unit
        name = words["hoist.rope_phase_1_rises"] if rises else words[f"hoist.{check.name}"]
        rows.append([name, condition, value, words["said.ok" if check.ok else "said.fails"]])
    return table("checks", words["heading.hoist_checks"], rows, scene.style)


def _rises(scene: HoistScene) -> bool:
    """Whether the rope's force only rises from 0 before the lift-off: then it has no least value after its first."""
    return scene.size("F_12_min") == scene.size("F_12_t1") >= 0.0


def _head(words: Words, *columns: str) -> list[str]:
    return [words[f"table.{column}"] for column in columns]


def begun(scene: HoistScene, steps: int) -> dict[str, Begun]:
    """Return what handouts show of the tables: the two columns in which the checks are asked."""
    return {"checks": Begun(rows=frozenset(), columns=2)}


def scales_table(scene: HoistScene) -> View:
    """Return the scale factors, and by how much a reading may err."""
    words = scene.words
    rows = [[*_head(words, "symbol", "value", "unit"), words["hoist.reading"]]]
    found = (symbol for symbol in SCALED if symbol in scene.solved.quantities)
    for symbol in dict.fromkeys((*scene.solved.scale_of_plan.values(), *found)):
        scale = scene.scale(symbol)
        error = f"±{words.short(round(READING * scale.mu, 12))} {words.unit(scale.unit)}"
        rows.append([words.symbol(symbol), words.short(scale.mu), words.unit(scale.per_mm_unit), error])
    return table("scales", words["heading.scales"], rows, scene.style)


def strength_block(scene: HoistScene) -> View:
    """Return the check of strength: force, stress, safety, verdict; and what the article would say."""
    words, found = scene.words, scene.solved.forces.found
    greatest = words.symbol("P_12_max" if found["P_12_max"] >= found["F_12_max"] else "F_12_max")
    ok = scene.solved.forces.ok[STRENGTH]
    safety = _ratio(scene, f"[σ]/{words.symbol('sigma_max')}", ("sigma", 1e-6), ("sigma_max", 1e-6))
    lines: list[tuple[str, ...]] = [
        (f"{words.symbol('F_max')} = {greatest} =", f"{scene.value(found['F_max'])} {words.unit('N')}"),
        _ratio(scene, f"{words.symbol('sigma_max')} = {words.symbol('F_max')}/S", ("F_max", 1.0), ("S", 1e6), "MPa"),
        (*safety, f"{'≥' if ok else '<'} K = {words.short(found['K'])}"),
        (words["hoist.strong" if ok else "hoist.weak"],),
        (f"{words.symbol('dynamic_factor')} = {scene.value(scene.size('dynamic_factor'))}",),
    ]
    printed = strength({"safety": scene.solved.size("_safety_printed"), "K": found["K"]})
    safely = f"[σ]/{words.symbol('sigma_max')} = {scene.value(printed.value)}"
    lines.append(words_of(words["hoist.agrees" if printed.ok == ok else "hoist.disagrees"].format(safety=safely)))
    return text_block("strength", words["heading.hoist_safety"], lines, scene.style, WIDTH)


def _ratio(
    scene: HoistScene, letters: str, above: tuple[str, float], below: tuple[str, float], unit: str = ""
) -> tuple[str, ...]:
    """Return a ratio in letters, with numbers, and its value; a quantity is its name and its unit."""
    words, found = scene.words, scene.solved.forces.found
    inputs = [Input(float(f"{found[n] * times:.{ROUNDING}g}"), exact=n in scene.givens) for n, times in (above, below)]
    (first, second), result = calculation(words, lambda a, b: a / b, inputs)
    return (f"{letters} =", f"{first}/{second} =", f"{result} {words.unit(unit)}" if unit else result)


# quantities that follow from others, and the numbers of their formulas in the article
REDUCED = ("m", "alpha_0", "C_01", "alpha_2", "C_2", "C_k", "C_12", "C", "k", "k_1")
SLACK = "V_t"
LIFTED = ("_y_F_12_t1", "_osc_F_12_t1", "F_12_t1")
STARTED, RATES, HANGING = ("P_m", "D_0"), ("_dy_t1", "_dosc_t1", "_dF_t1"), ("T_1", "P_12_max", "P_12_min")
BENT = ("w_0_max", "x_w0", "w_2_max", "x_w2")
NUMBERS = {"m": "4", "alpha_0": "6", "C_01": "5", **dict.fromkeys(("alpha_2", "C_2", "C_k", "C_12"), "7")}
NUMBERS |= {"F_12_t1": "10", **dict.fromkeys(("T_1", "P_12_max"), "15′")}
UNITS = {"_dF_t1": "N/s", "_dy_t1": "m/s", "_dosc_t1": "m/s"}
# what is read from a drawing, or in several steps, as it is calculated
TOLD_BY = {
    "R": ("hypotenuse", ("D_0", "D_1")),
    "F_12_t1": ("rope_force_of_both", ("C", "C_12", "C_01", "_osc_F_12_t1", "_y_F_12_t1")),
    "_dF_t1": ("rope_force_of_both", ("C", "C_12", "C_01", "_dosc_t1", "_dy_t1")),
}


def story(scene: HoistScene, scales: Mapping[str, Scale], texts: Mapping[str, str]) -> Story:
    """Return what the note of a hoist says beside its views: formulas with numbers, and how each drawing is made.

    The `scales` are by plan, the sentences of `texts` by key.
    """
    moved = scene.solved.forces.motion is not None
    slack = (SLACK,) if scene.size("slack") > 0.0 else ()
    rate = f"{scene.words.symbol('_dF_t1')} = {_number(scene, scene.size('_dF_t1'))} {scene.words.unit('N/s')}"
    rates = ((rate,),) if moved else _lines(scene, RATES)
    circle = (*_lines(scene, STARTED), *rates, *_lines(scene, ("D_1", "R")))
    equations = {
        "model": _lines(scene, (*REDUCED, *slack)),
        "lift_off": () if moved else _lift_off(scene),
        "extremes": () if moved else _resting(scene),
        "circle": circle if moved else (*circle, _angle(scene), *_lines(scene, HANGING)),
        "beams": _lines(scene, BENT),
    }
    said = _said(scene, scales)
    head, told = (data_table(scene, stated=True),), tuple(_conclusions(scene, texts))
    return Story(equations=equations, conclusions=told, texts=texts, said=said, head=head)


def formula(scene: HoistScene, told: str) -> tuple[str, ...]:
    """Return the formula of a quantity with letters, with numbers and its value; what is infinite is not put in."""
    step = scene.solved.program.by_name[told]
    law, names = TOLD_BY.get(told) or (step.law, step.operands)
    return (*_worked(scene, told, law, names), *([_cited(NUMBERS[told])] if told in NUMBERS else []))


def _worked(scene: HoistScene, told: str, law: str, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return how a law gives a quantity, in letters and in numbers, so that it recomputes."""
    inputs, result = [_input(scene, name) for name in names], _input(scene, told)
    unit = UNITS.get(told) or unit_of(told)
    unit = "" if unit == "1" else unit
    if all(math.isfinite(one.value) for one in inputs):
        return worked(scene.words, told, law, inputs, Shown(unit, result.times, places_of(result.told), result.sign))
    letters = form_of(law)(*(Symbol.of(scene.words.symbol(name)) for name in names))
    value = f"= {_number(scene, scene.size(told))} {scene.words.unit(unit) if unit else ''}".rstrip()
    return f"{scene.words.symbol(told)} = {letters}", value


def _angle(scene: HoistScene) -> tuple[str, ...]:
    """Return the angle from the starting point of the circle to its right end, from 0 to 2π."""
    right = scene.size("D_0") > 0.0
    law = f"angle_{'left' if not right else 'above' if scene.size('D_1') >= 0.0 else 'below'}"
    return _worked(scene, "phi_1", law, ("D_1", "D_0"))


def _input(scene: HoistScene, name: str) -> Input:
    """Return a quantity as it is printed, a very large or small one before its power of ten."""
    text = _number(scene, scene.size(name))
    told, _, power = text.partition("·10^{")
    times = 10.0 ** -number_of(power.rstrip("}")) if power else 1.0
    value = float(f"{scene.size(name) * times:.{ROUNDING}g}")
    exact = name in scene.givens or (math.isfinite(value) and value == number_of(told))
    return Input(value, exact, name=name, sign=text.removeprefix(told), times=times, told="" if exact else told)


def _cited(number: str) -> str:
    """Return what refers to an equation of the article, the first of the sources of a note."""
    return f"[1, ({number})]"


def _lines(scene: HoistScene, names: tuple[str, ...]) -> tuple[tuple[str, ...], ...]:
    """Return formulas, without what is nothing because a beam is rigid."""
    return tuple(formula(scene, name) for name in names if role(name).kind != "w" or scene.size(name))


def _number(scene: HoistScene, value: float) -> str:
    """Return a number, a very large or small one with a power of ten."""
    size = abs(value)
    if math.isinf(value):
        return scene.value(value)
    if size == 0.0 or SMALL <= size < LARGE:
        return scene.words.short(value) if value == round(value, 2) else scene.value(value)
    power = math.floor(math.log10(size))
    return f"{scene.words.short(float(f'{value * 10.0**-power:.{DIGITS}g}'))}·10^{{{power}}}".replace("{-", "{−")


def _lift_off(scene: HoistScene) -> tuple[tuple[str, ...], ...]:
    V = scene.words.symbol("V_t")
    wound = form_of("wound")(*(Symbol.of(letter) for letter in (V, "a", "t")))
    _, *height = _worked(scene, "_height", "ratio", ("P_st", "C"))
    return (
        (f"y(t) = {wound}",),
        (f"δ(t) = (a/k^{{2}})·(1 − cos kt) + ({V}/k)·sin kt",),
        ("y(t) − δ(t) = mg/C", *height, _cited("11")),
        (scene.stated("t_1", unit="s"),),
    )


def _resting(scene: HoistScene) -> tuple[tuple[str, ...], ...]:
    words = scene.words
    V, ratio = words.symbol("V_t"), f"({words.symbol('C_01')}/{words.symbol('C_12')})"
    force = f"F_{{12}}(t) = C·[({words.symbol('C_12')}/{words.symbol('C_01')})·δ(t) + y(t)]"
    return (
        (f"(a/k)·sin kt + {V}·cos kt = −{ratio}·({V} + a·t)", _cited("12")),
        (force, _cited("10")),
        *_lines(scene, LIFTED),
        (scene.stated("F_12_max"),),
    )


def _said(scene: HoistScene, scales: Mapping[str, Scale]) -> dict[str, str]:
    """Return what sentences may name: quantities with letters and units, the circle on paper."""
    words = scene.words
    forces = ("P_st", "P_m", "F_12_t1", "F_12_max", "P_12_max", "P_12_min", "R")
    found = {name: scene.stated(name) for name in forces}
    found |= {name: scene.stated(name, unit="s") for name in ("t_1", "T_1")}
    found |= {name: scene.stated(name, unit="m") for name in ("l_0", "b_0", "l_2", "b_2", "L", "x_w0", "x_w2")}
    found["phi_1"] = scene.stated("phi_1", unit="rad")
    mu = scales[CIRCLE].mu if CIRCLE in scales else 1.0
    drawn = {f"{name}_drawn": scene.size(name) / mu for name in ("P_m", "R")}
    return found | {name: f"{words.number(size, PAPER)} {words.unit('mm')}" for name, size in drawn.items()}


def _conclusions(scene: HoistScene, texts: Texts) -> Iterator[str]:
    """Go through the sentences for the end of the note."""
    yield texts["hoist.conclusion.lift_off"].format(t_1=scene.stated("t_1", unit="s"), F_12_t1=scene.stated("F_12_t1"))
    # the greatest force of the rope, compared with that of the load at rest
    after = scene.size("P_12_max") >= scene.size("F_12_max")
    force = scene.stated("P_12_max" if after else "F_12_max")
    when = scene.stated("T_1" if after else "t_F12_max", unit="s")
    factor = f"{scene.words.symbol('dynamic_factor')} = {scene.value(scene.size('dynamic_factor'))}"
    greatest = texts[f"hoist.conclusion.greatest_{'after' if after else 'before'}"]
    yield greatest.format(force=force, P_st=scene.stated("P_st"), factor=factor, when=when)
    if scene.solved.forces.motion is None:
        first = scene.stated("F_12_t1" if _rises(scene) else "F_12_min")
        yield texts["hoist.conclusion.valid"].format(F_12_min=first, P_12_min=scene.stated("P_12_min"))
    else:
        wrong = (check.name for check in scene.solved.forces.checks if not check.ok)
        yield from (texts[f"hoist.conclusion.{name}"] for name in wrong if name != STRENGTH)
    ok = scene.solved.forces.ok[STRENGTH]
    safety = f"[σ]/{scene.words.symbol('sigma_max')} = {scene.value(scene.size('safety'))}"
    limit = f"{'≥' if ok else '<'} K = {scene.words.short(scene.size('K'))}"
    stress = scene.stated("sigma_max", scene.size("sigma_max") * 1e-6, "MPa")
    yield texts[f"hoist.conclusion.{'strong' if ok else 'weak'}"].format(stress=stress, safety=f"{safety} {limit}")
    if scene.solved.forces.motion is None:  # where the rope goes slack the article says little
        exact, printed = scene.size("P_12_max"), scene.size("P_12_max_printed")
        part = scene.words.number(100.0 * abs(printed - exact) / exact, 1)
        key = f"hoist.conclusion.article_{'more' if printed >= exact else 'less'}"
        yield texts[key].format(printed=scene.stated("P_12_max_printed"), part=part)
    yield from _bent(scene, texts)


def _bent(scene: HoistScene, texts: Texts) -> Iterator[str]:
    """Tell how far the beams that are not rigid bend, in parts of their spans, too."""
    said = []
    for i in scene.solved.layout.bent:
        name, span = f"w_{i}_max", scene.size(f"l_{i}")
        bent = scene.stated(name, scene.size(name) * MM, "mm")
        part = f"{scene.words.symbol(f'l_{i}')}/{round(span / scene.size(name))}"
        said.append(f"{bent} ({part})")
    if said:
        yield texts["hoist.conclusion.bent"].format(said="; ".join(said))
