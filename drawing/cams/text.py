"""Calculations of a cam with their numbers: scale factors, sizes, rules of design and whether they are kept."""

from __future__ import annotations

import math
from collections.abc import Callable

from ...plans.cams.integration import ACCELERATION
from ...plans.cams.rules import Rule, rules_of
from .. import printed
from ..givens import choice
from ..printed import Formula, Input, Terms, calculation
from ..table import text_block, words_of
from ..view import View
from .offsets import offsets_line
from .scene import CamScene

Lines = list[tuple[str, ...]]


def scales_block(scene: CamScene, width: float) -> View:
    """Return the calculation of amplitudes, scale factors and greatest rates."""
    lines = [*_amplitudes(scene), *_factors(scene), *_chords(scene), *_rates(scene)]
    return text_block("equations_scales", scene.words["heading.scales"], lines, scene.style, width)


def choices_block(scene: CamScene, note: str, width: float) -> View:
    """Return the choices that the task makes in words, what the lines of the diagrams are, and the task's note."""
    words = scene.words
    words_given = ((name, given.value) for name, given in scene.givens.items() if isinstance(given.value, str))
    chosen = ((name, choice(words, name, value)) for name, value in words_given)
    lines: Lines = [(f"{words.texts.get(f'given.cam_{name}', about)}:", said) for name, (about, said) in chosen]
    lines += _about(scene)
    lines += [_smaller(scene)] if scene.reduction != 1.0 else []
    lines += [words_of(note)] if note else []
    return text_block("choices", words["heading.cam_choices"], lines, scene.style, width)


def roller_block(scene: CamScene, width: float) -> View:
    """Return the sizes of the cam for a roller, with the rules for its radius and the transmission angles."""
    solved, words = scene.solved, scene.words
    roller = solved.roller
    assert roller is not None
    mm = words.unit("mm")
    sizes = roller.sizes
    e, s_0 = (sizes.e * 1e3, True), (sizes.s_0 * 1e3, True)
    lines: Lines = [
        worked(
            scene,
            "r_0",
            "√({e}^{{2}} + {s_0}^{{2}})",
            math.hypot,
            [("e", abs(e[0]), False), ("s_0", s_0[0], False)],
            "mm",
        )
    ]
    if "r_0_tangents" in solved.values:
        pair = ((name, float(solved.values[name]) * 1e3) for name in ("r_0_tangents", "e_tangents"))
        texts = (f"{words.symbol(name)} = {words.number(value, 2)} {mm}" for name, value in pair)
        lines.append((f"{words['said.cam_tangents']}:", "; ".join(texts)))
    lines += [(line,) for line in offsets_line(scene)]
    lines += rules(scene)
    return text_block("equations_roller", words["heading.cam_roller"], lines, scene.style, width)


def plate_block(scene: CamScene, width: float) -> View:
    """Return the sizes of the cam for a plate."""
    words, plate = scene.words, scene.solved.plate
    assert plate is not None
    values = scene.solved.values
    lines: Lines = []
    if "r_0_flat_tangent" in values:
        tangent = float(values["r_0_flat_tangent"]) * 1e3
        text = f"{words.symbol('r_0_flat_tangent')} = {words.number(tangent, 2)} {words.unit('mm')}"
        lines.append((f"{words['said.cam_tangents']}:", text))
    rho_flat, r_0 = (("rho_flat", float(values["rho_flat"]) * 1e3, True), ("r_0_flat", plate.sizes.r_0 * 1e3, True))
    least = ("r_0_flat_min", plate.sizes.r_0_min * 1e3, False)
    if plate.given:
        more = f"≥ {words.symbol('rho_flat')} = {words.short(rho_flat[1])} {words.unit('mm')}"
        formula = "{r_0_flat} − {r_0_flat_min}"
        lines.append(worked(scene, "rho_flat_min", formula, lambda a, b: a - b, [r_0, least], "mm", more))
    else:
        formula = "{r_0_flat_min} + {rho_flat}"
        lines.append(worked(scene, "r_0_flat", formula, lambda a, b: a + b, [least, rho_flat], "mm"))
    lines.append(
        worked(
            scene,
            "R_plate",
            "{ds_max} + {margin}",
            lambda a, b: a + b,
            [
                ("ds_max", scene.solved.motion.ds_max.value * 1e3, False),
                ("margin", float(values["margin"]) * 1e3, True),
            ],
            "mm",
        )
    )
    return text_block("equations_plate", words["heading.cam_plate"], lines, scene.style, width)


def worked(
    scene: CamScene, name: str, formula: str, law: Callable[..., float], terms: Terms, unit: str, more: str = ""
) -> tuple[str, ...]:
    """Return `name = formula = numbers = result unit`, printed so that it recomputes."""
    return printed.worked(scene.words, Formula(name, formula, law, terms, unit), more)


def _given_a(scene: CamScene) -> bool:
    return scene.solved.layout.given == ACCELERATION


def _amplitudes(scene: CamScene) -> Lines:
    if "l_A2" not in scene.solved.values:
        return []
    u = float(scene.solved.values["u"])
    terms = [("l_A1", scene.paper("l_A1"), True), ("u", u, False)]
    return [worked(scene, "l_A2", "{l_A1}·{u}/(1 − {u})", lambda a, b: a * b / (1.0 - b), terms, "mm")]


def _factors(scene: CamScene, mark: str = "") -> Lines:
    """Return mu_s from the drawn stroke, and what follows from it; `mark` is that of chords."""
    solved, mu = scene.solved, scene.mu
    h, omega = (float(solved.values[name]) for name in ("h", "omega"))
    highest = scene.paper("S_max_chord") if mark else solved.motion.h / mu("mu_s")
    lines = [
        worked(
            scene,
            f"mu_s{mark}",
            "{h}/{S_max" + mark + "}",
            lambda a, b: a / b,
            [("h", h, solved.rocker is None), (f"S_max{mark}", highest, False)],
            "m/mm",
        )
    ]
    chain = [("mu_ds", "mu_s", "H_v")] + [("mu_d2s", "mu_ds", "H_a")] * _given_a(scene)
    for name, base, pole in chain:
        terms = [
            (f"{base}{mark}", mu(f"{base}{mark}"), False),
            ("mu_phi", mu("mu_phi"), False),
            (pole, scene.paper(pole), True),
        ]
        formula = f"{{{base}{mark}}}/({{mu_phi}}·{{{pole}}})"
        lines.append(worked(scene, f"{name}{mark}", formula, lambda a, b, c: a / (b * c), terms, "m/mm"))
    if mark:
        return lines
    terms = [("omega", omega, True), ("mu_ds", mu("mu_ds"), False)]
    lines.append(worked(scene, "mu_v", "{omega}·{mu_ds}", lambda a, b: a * b, terms, "(m/s)/mm"))
    if _given_a(scene):
        terms = [("omega", omega, True), ("mu_d2s", mu("mu_d2s"), False)]
        lines.append(worked(scene, "mu_a", "{omega}^{{2}}·{mu_d2s}", lambda a, b: a * a * b, terms, "(m/s^2)/mm"))
    return lines


def _chords(scene: CamScene) -> Lines:
    """Return the scale factors by the curves of chords, and by how much these do not close."""
    words, values = scene.words, scene.solved.values
    names = [name for name in ("s_close", "v_close") if name in values]
    gaps = (f"{words.symbol(name)} = {words.number(scene.paper(name), 2)} {words.unit('mm')}" for name in names)
    closing = words["said.cam_closing"].format(values=", ".join(gaps))
    return [(f"{words['said.cam_by_chords']}:",), *_factors(scene, "_chord"), (closing,)]


def _about(scene: CamScene) -> Lines:
    """Say what the lines of the diagrams are, and what is not drawn."""
    words, lower_dwell = scene.words, scene.solved.motion.lower
    said: Lines = [tuple(words["said.cam_curves"].split("|"))]
    if lower_dwell.lasts:
        lower = f"{words.symbol('phi_lower')} = {scene.degrees(lower_dwell.length)}"
        said.append((words["said.cam_lower"].format(angle=lower),))
    return said


def _smaller(scene: CamScene) -> tuple[str, ...]:
    """Say that the diagrams are smaller than the lengths given, and with what lengths they are drawn."""
    words, mm = scene.words, scene.words.unit("mm")
    lengths = ((name, words.short(round(scene.paper(name), 2))) for name in ("l_A1", "H_a", "H_v"))
    said = [f"{words.symbol(name)} = {length} {mm};" for name, length in lengths]
    axis = words["said.cam_axis"].format(angle=scene.degrees(scene.mu("mu_phi")))
    return (*words_of(words["said.cam_smaller"].format(part=words.short(scene.reduction))), *said, axis)


def _rates(scene: CamScene) -> Lines:
    """Return the greatest velocity and acceleration of the follower."""
    solved = scene.solved
    omega = float(solved.values["omega"])
    terms = [("omega", omega, True), ("ds_max", solved.motion.ds_max.value, False)]
    lines = [worked(scene, "v_max", "{omega}·{ds_max}", lambda a, b: a * b, terms, "m/s")]
    if _given_a(scene):
        terms = [("omega", omega, True), ("d2s_max", solved.motion.d2s_max.value, False)]
        lines.append(worked(scene, "a_max", "{omega}^{{2}}·{d2s_max}", lambda a, b: a * a * b, terms, "m/s^2"))
    return lines


def rules(scene: CamScene) -> Lines:
    """Return the rules of good design, each with its numbers and whether it is kept."""
    lines: Lines = []
    for rule in rules_of(scene.solved):
        sides = _of_roller(scene, rule) if rule.of else _of_transmission(scene, rule)
        lines.append((sides, f"({scene.words['said.ok' if rule.ok else 'said.fails']})"))
    return lines


def _of_roller(scene: CamScene, rule: Rule) -> str:
    """Return the roller's radius beside the greatest one, a part of a size."""
    words, mm = scene.words, scene.words.unit("mm")
    (part, size), limit = calculation(words, lambda a, b: a * b, [Input(rule.part, True), Input(rule.size * 1e3)])
    roller = f"{words.symbol('R_roller')} = {words.short(round(rule.value * 1e3, 6))} {mm}"
    return f"{roller} ≤ {words.short(rule.part)}·{words.symbol(rule.of)} = {part}·{size} = {limit} {mm}"


def _of_transmission(scene: CamScene, rule: Rule) -> str:
    """Return the least transmission angle of a phase beside the one permitted."""
    least, permitted = (scene.words.symbol(name) for name in (f"{rule.name}_min", rule.name))
    return f"{least} = {scene.degrees(rule.value)} ≥ {permitted} = {scene.degrees(rule.limit)}"
