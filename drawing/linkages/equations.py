"""Equations of a linkage sheet: structure, vector equations with underlines, and calculations that recompute."""

from __future__ import annotations

import math
from collections.abc import Callable

from ...plans.linkages.rrp import Dyad
from ..printed import calculation, value_text
from ..table import text_block
from ..view import View
from .group_view import loads
from .lever_view import arm_of, hung_on_lever
from .scene import Scene

Lines = list[tuple[str, ...]]
ROMAN = {1: "I", 2: "II", 3: "III"}


def structure_block(scene: Scene, width: float) -> View:
    """Return mobility, groups and the formula of structure."""
    words, s = scene.words, scene.solved.structure
    lines: Lines = [
        (words["structure.count"].format(n=s.moving, p1=s.lower, p2=s.higher),),
        ("W = 3n − 2p_{1} − p_{2} =", f"3·{s.moving} − 2·{s.lower} − {s.higher} = {s.mobility}"),
    ]
    formula = f"I(0, {s.driver})"
    for group in s.groups:
        links = ", ".join(map(str, group.links))
        text = words["structure.group"].format(links=links, view=group.view)
        lines.append(tuple(f"{part}," for part in text.split(", ")[:-1]) + (text.split(", ")[-1],))
        formula += f" → {ROMAN[group.group_class]}_{{{group.view}}}({links})"
    lines.append((words["structure.driver"].format(link=s.driver),))
    head, _, tail = words["structure.formula"].partition("{formula}")
    lines.append((head.strip(), formula + tail))
    return text_block("structure", words["heading.structure"], lines, scene.style, width)


def kinematics_block(scene: Scene, width: float, plans: tuple[str, ...]) -> View:
    """Return the equations of velocities and, where it was built, of accelerations."""
    lines: Lines = _driver_lines(scene, plans)
    for d in scene.dyads:
        lines += _velocity_lines(scene, d)
        if "acceleration" in plans:
            lines += _acceleration_lines(scene, d)
    key = "heading.equations_kinematics" if "acceleration" in plans else "heading.equations_velocity"
    return text_block("equations_kinematics", scene.words[key], lines, scene.style, width)


def forces_block(scene: Scene, width: float) -> View:
    """Return inertia forces, moment equations, vector equations of the force plans, and the driver's balance."""
    lines: Lines = inertia_lines(scene)
    for d in reversed(scene.dyads):
        lines += _group_lines(scene, d)
    lines += _balance_lines(scene)
    return text_block("equations_forces", scene.words["heading.equations_forces"], lines, scene.style, width)


def lever_block(scene: Scene, width: float, with_inertia: bool) -> View:
    """Return the moment equation of Zhukovsky's lever and the comparison of the two balancing moments."""
    lines = (inertia_lines(scene) if with_inertia else []) + _couple_lines(scene) + _lever_lines(scene)
    return text_block("equations_lever", scene.words["heading.equations_lever"], lines, scene.style, width)


def _known(text: str) -> str:
    return f"\\uu{{{text}}}"


def _direction(text: str) -> str:
    return f"\\u{{{text}}}"


def _value(scene: Scene, name: str) -> float:
    item = scene.solved.quantities.get(name)
    return scene.solved.size(name) if item is None else (item.value or 0.0)


def _calculated(
    scene: Scene, name: str, formula: str, pattern: str, law: Callable[..., float], *inputs: tuple[float, bool]
) -> tuple[str, ...]:
    """Return `symbol = formula = numbers = result unit`; `pattern` takes the printed inputs."""
    texts, result = calculation(scene.words, law, inputs)
    unit = scene.words.unit(scene.solved.quantities[name].unit)
    head = f"{scene.words.symbol(name)} = {formula} ="
    return head, f"{pattern.format(*texts)} =", f"{result} {unit}".rstrip()


def _given(scene: Scene, name: str) -> tuple[float, bool]:
    return scene.solved.values[name], True


def _driver_lines(scene: Scene, plans: tuple[str, ...]) -> Lines:
    w, s = scene.words, scene.solved
    driver = s.mechanism.driver
    omega, n, l, point = f"omega_{driver.link}", driver.speed, s.mechanism.link(driver.link).points[driver.point][0], driver.point
    size = abs(s.values[omega])
    sense = w["said.ccw" if s.values[omega] > 0 else "said.cw"]
    rpm = round(size * 30.0 / math.pi, 9)
    texts, result = calculation(w, lambda x: math.pi * x / 30.0, [(rpm, True)])
    lines: Lines = [
        (f"{w.symbol(omega)} = π{w.symbol(n)}/30 =", f"π·{texts[0]}/30 =", f"{result} {w.unit('rad/s')},", sense),
        _calculated(
            scene, f"V_{point}", f"{w.symbol(omega)}·{w.symbol(l)}", "{}·{}", lambda x, y: x * y, (size, False), _given(scene, l)
        ),
    ]
    if "acceleration" in plans:
        lines.append(
            _calculated(
                scene,
                f"a_{point}",
                f"ω^{{2}}_{{{driver.link}}}·{w.symbol(l)}",
                "{}^{{2}}·{}",
                lambda x, y: x * x * y,
                (size, False),
                _given(scene, l),
            )
        )
    return lines


def _velocity_lines(scene: Scene, d: Dyad) -> Lines:
    w = scene.words
    V, Va, Vba = (w.symbol(name, bar=True) for name in (f"V_{d.B}", f"V_{d.A}", f"V_{d.B}{d.A}"))
    lines: Lines = [
        (f"{_direction(V)} = {_known(Va)} + {_direction(Vba)},", *_directions(scene, d, f"V_{d.B}", f"V_{d.B}{d.A}")),
    ]
    lines += _similarity_lines(scene, d, "velocity", f"V_{d.B}{d.A}")
    rate = f"omega_{d.rod.number}"
    v, size = f"V_{d.B}{d.A}", abs(scene.solved.values[rate])
    line = _rate_line(scene, rate, v, d, size)
    return [*lines, line]


def _rate_line(scene: Scene, rate: str, v: str, d: Dyad, size: float) -> tuple[str, ...]:
    w = scene.words
    length = _given(scene, d.length)
    texts, result = calculation(w, lambda x, y: x / y, [(_value(scene, v), False), length])
    unit = w.unit(scene.solved.quantities[rate].unit)
    sense = "" if size == 0.0 else w["said.ccw" if scene.solved.values[rate] > 0 else "said.cw"]
    head = f"{w.symbol(rate)} = {w.symbol(v)}/{w.symbol(d.length)} ="
    return head, f"{texts[0]}/{texts[1]} =", f"{result} {unit}{', ' if sense else ''}", sense


def _directions(scene: Scene, d: Dyad, along: str, across: str) -> tuple[str, ...]:
    w = scene.words
    return (f"{w.symbol(along, bar=True)} ∥ x–x,", f"{w.symbol(across, bar=True)} ⊥ {d.AB}")


def _similarity_lines(scene: Scene, d: Dyad, plan: str, relative: str) -> Lines:
    w, lines = scene.words, []
    for point, (part, _) in d.rod.points.items():
        if point in (d.A, d.B):
            continue
        a, b, s = (w.mark(f"{plan}.{letter}") for letter in (d.A, d.B, point))
        ab = _value(scene, relative) / scene.scales[plan].mu
        law = lambda x, y, z: x * y / z  # noqa: E731
        texts, result = calculation(w, law, [(ab, False), _given(scene, part), _given(scene, d.length)])
        ratio = f"{w.symbol(part)}/{w.symbol(d.length)}"
        mm = w["unit.mm"]
        lines.append((f"{a}{s} = {a}{b}·{ratio} =", f"{texts[0]}·{texts[1]}/{texts[2]} =", f"{result} {mm}"))
    return lines


def _acceleration_lines(scene: Scene, d: Dyad) -> Lines:
    w = scene.words
    aB, aA, n, t = (w.symbol(name, bar=True) for name in (f"a_{d.B}", f"a_{d.A}", f"a_{d.B}{d.A}_n", f"a_{d.B}{d.A}_t"))
    normal = f"a_{d.B}{d.A}_n"
    v = f"V_{d.B}{d.A}"
    lines: Lines = [
        (
            f"{_direction(aB)} = {_known(aA)} + {_known(n)} + {_direction(t)},",
            f"{n} ∥ {d.AB} ({d.B} → {d.A}),",
            f"{t} ⊥ {d.AB}",
        ),
        _calculated(
            scene, normal, f"V^{{2}}_{{{d.B}{d.A}}}/{w.symbol(d.length)}", "{}^{{2}}/{}", lambda x, y: x * x / y,
            (_value(scene, v), False), _given(scene, d.length),
        ),
        *_similarity_lines(scene, d, "acceleration", f"a_{d.B}{d.A}"),
    ]
    rate, speed = f"epsilon_{d.rod.number}", f"omega_{d.rod.number}"
    lines.append(_rate_line(scene, rate, f"a_{d.B}{d.A}_t", d, abs(scene.solved.values[rate])))
    product = scene.solved.values[rate] * scene.solved.values[speed]
    key = "said.steady" if product == 0.0 else "said.speeds_up" if product > 0 else "said.slows_down"
    text = w[key].format(link=d.rod.number, omega=w.symbol(speed), epsilon=w.symbol(rate))
    lines.append(tuple(text.split("|")))
    return lines


def inertia_lines(scene: Scene) -> Lines:
    """Return the calculations of the inertia forces and moments."""
    w, lines = scene.words, []
    for link in scene.solved.mechanism.links:
        force, moment = f"F_i{link.number}", f"M_i{link.number}"
        if link.mass and scene.defined(force):
            a = f"a_{link.centre}"
            lines.append(
                _calculated(scene, force, f"{w.symbol(link.mass)}·{w.symbol(a)}", "{}·{}", lambda x, y: x * y,
                            _given(scene, link.mass), (_value(scene, a), False))
            )
        if link.inertia and scene.defined(moment):
            rate = f"epsilon_{link.number}"
            size = abs(scene.solved.values[rate])
            texts, result = calculation(w, lambda x, y: x * y, [_given(scene, link.inertia), (size, False)])
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
            inputs += [(_value(scene, name), False), (_value(scene, arm) / mu, False), (mu, True)]
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
        sums = "".join(_signed(m, text) for m, text in terms)
        lines.append(
            (
                f"ΣM_{{{d.B}}}({j}) = 0:",
                f"{_signed(turn, f'{w.symbol(tangential)}·{w.symbol(length)}', first=True)}{sums} = 0",
            )
        )
        signs = [-turn * sign for sign in signs]
        numbers = "".join(_signed(s, p, first=n == 0) for n, (s, p) in enumerate(zip(signs, pattern, strict=True)))
        formula = "".join(_signed(s, t, first=n == 0) for n, (s, (_, t)) in enumerate(zip(signs, terms, strict=True)))

        def law(*x: float) -> float:
            total, at = 0.0, 0
            for sign, part in zip(signs, pattern, strict=True):
                count = part.count("{}")
                total += sign * math.prod(x[at : at + count])
                at += count
            return total / x[-1]

        lines.append(
            _calculated(scene, tangential, f"({formula})/{w.symbol(length)}", f"({numbers})/{{}}", law, *inputs, _given(scene, length))
        )
    known = [tangential, *(name for name, _ in (*loads(scene, k), *loads(scene, j)))]
    unknown = [f"R_0{k}", f"R_{i}{j}_n"]
    lines.append(_vector_sum(w_known=[w.symbol(n, bar=True) for n in known], w_line=[w.symbol(n, bar=True) for n in unknown]))
    full = [f"R_{i}{j}", *(name for name, _ in loads(scene, j))]
    lines.append(_vector_sum(w_known=[w.symbol(n, bar=True) for n in full], w_line=[], unknown=w.symbol(f"R_{k}{j}", bar=True)))
    h = f"h_0{k}"
    value = value_text(w, scene.solved.quantities[h].value or 0.0)
    lines.append((f"ΣM_{{{d.B}}}({k}) = 0:", f"{w.symbol(f'R_0{k}')}·{w.symbol(h)} = 0,", f"{w.symbol(h)} = {value}"))
    return lines


def _vector_sum(w_known: list[str], w_line: list[str], unknown: str = "") -> tuple[str, ...]:
    parts = [_known(text) for text in w_known] + [_direction(text) for text in w_line] + ([unknown] if unknown else [])
    chunks = [parts[0], *(f"+ {part}" for part in parts[1:])]
    return (*chunks, "= 0")


def _signed(sign: float, text: str, first: bool = False) -> str:
    if first:
        return text if sign > 0 else f"−{text}"
    return f" + {text}" if sign > 0 else f" − {text}"


def _balance_lines(scene: Scene) -> Lines:
    w, s = scene.words, scene.solved
    driver = s.mechanism.driver
    crank = driver.link
    mu = scene.scales["position"].mu
    lines: Lines = []
    forces = [f"R_{d.rod.number}{crank}" for d in scene.dyads if d.before == crank]
    forces += [name for name, _ in loads(scene, crank)]
    known = [w.symbol(name, bar=True) for name in forces]
    lines.append(_vector_sum(w_known=known, w_line=[], unknown=w.symbol(f"R_0{crank}", bar=True)))
    signs = [-math.copysign(1.0, s.values[f"_M_{name}_{driver.pivot}"]) for name in forces]
    total = math.copysign(1.0, s.values["M_bal"])
    arms = [f"h_{name.removeprefix('R_')}" for name in forces]
    if all(scene.defined(arm) for arm in arms):
        signs = [sign * total for sign in signs]
        formula = "".join(
            _signed(sign, f"{w.symbol(n)}·{w.symbol(h)}·{w.symbol('mu_l')}", first=i == 0)
            for i, (sign, n, h) in enumerate(zip(signs, forces, arms, strict=True))
        )
        pattern = "".join(_signed(sign, "{}·{}·{}", first=i == 0) for i, sign in enumerate(signs))

        def law(*x: float) -> float:
            return sum(sign * x[3 * i] * x[3 * i + 1] * x[3 * i + 2] for i, sign in enumerate(signs))

        inputs = [pair for n, h in zip(forces, arms, strict=True) for pair in ((_value(scene, n), False), (_value(scene, h) / mu, False), (mu, True))]
        sense = w["said.ccw" if total > 0 else "said.cw"]
        texts, result = calculation(w, law, inputs)
        head = f"ΣM_{{{driver.pivot}}}({crank}) = 0:"
        lines.append((head, f"{w.symbol('M_bal')} = {formula} =", f"{pattern.format(*texts)} =", f"{result} {w.unit('N*m')},", sense))
    return lines


def _couple_lines(scene: Scene) -> Lines:
    w, lines = scene.words, []
    for d in scene.dyads:
        name, pair = f"M_i{d.rod.number}", f"F_i{d.rod.number}_couple"
        if scene.defined(pair):
            size = abs(scene.solved.values[name])
            texts, result = calculation(w, lambda x, y: x / y, [(size, False), _given(scene, d.length)])
            head = f"{w.symbol(pair + '_' + d.B)} = {w.symbol(pair + '_' + d.A)} = {w.symbol(name)}/{w.symbol(d.length)} ="
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
    head = _signed(turn, f"{w.symbol('F_bal')}·{segment}", first=True)
    sums = [_signed(sign, f"{w.symbol(n)}·{w.symbol(h)}").strip() for sign, n, h, _ in terms]
    lines: Lines = [("ΣM_{p} = 0:", head, *sums, "= 0")]
    signs = [-turn * sign for sign, *_ in terms]
    inputs = [pair for _, n, h, _ in terms for pair in ((s.size(n), False), (_value(scene, h) / mu, False))]

    def law(*x: float) -> float:
        return sum(sign * x[2 * i] * x[2 * i + 1] for i, sign in enumerate(signs)) / x[-1]

    texts, result = calculation(w, law, [*inputs, (pa, False)])
    products = [
        _signed(sign, f"{texts[2 * i]}·{texts[2 * i + 1]}", first=i == 0).strip() for i, sign in enumerate(signs)
    ]
    if products:
        lines.append((f"{w.symbol('F_bal')} = (", *products, f")/{texts[-1]} =", f"{result} {w.unit('N')}"))
    length = s.mechanism.link(driver.link).points[driver.point][0]
    moment = abs(s.values["M_bal_lever"])
    texts, result = calculation(w, lambda x, y: x * y, [(abs(balance), False), _given(scene, length)])
    lines.append((f"{w.symbol('M_bal_lever')} = {w.symbol('F_bal')}·{w.symbol(length)} =", f"{texts[0]}·{texts[1]} =", f"{result} {w.unit('N*m')}"))
    if "M_bal" in s.quantities and moment > 0.0:
        shown, plan = value_text(w, moment), value_text(w, abs(s.values["M_bal"]))
        pattern = f"({w.symbol('M_bal_lever')} − {w.symbol('M_bal')})/{w.symbol('M_bal_lever')}·100 % ="
        per_cent = s.values["delta_M_bal"]
        lines.append(
            (f"{w.symbol('delta_M_bal')} = {pattern}", f"({shown} − {plan})/{shown}·100 % =", f"{w.number(per_cent, 2)} %")
        )
    return lines
