"""Calculations of a cam with their numbers: scale factors, sizes, rules of design; the table of its motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ...plans.cams.construction import ACCELERATION, PLATE_SIZES, SIZES
from ...plans.cams.course import theta
from ...plans.cams.formulas import ARC
from ...plans.cams.rules import Rule, rules_of
from ...plans.cams.solve import SCALES
from ..printed import DEGREES, Input, Shown, calculation, worked
from ..symbols import swept
from ..table import table, text_block, words_of
from ..view import View
from .scene import CamScene, needed

Lines = list[tuple[str, ...]]
MM = Shown("mm", 1e3)
FROM = {SIZES: ("mu_s", "mu_ds"), PLATE_SIZES: ("mu_s", "mu_d2s")}  # scale factors of the diagrams
DRAWN = {"mu_s": "s", "mu_ds": "ds", "mu_d2s": "d2s"}  # what they draw
ANGLES = {SIZES: ("nu", "mu_s", "mu_ds")}  # of the straight line that projects one diagram to the scale of the other
DECIMALS = 4
SAME = 1e-9  # part of the greatest value of its column within which two limits at a jump are one


def scales_block(scene: CamScene, width: float) -> View:
    """Return the calculation of amplitudes, scale factors and greatest rates."""
    lines = [*_amplitudes(scene), *_factors(scene), *_chords(scene), *_rates(scene)]
    return text_block("equations_scales", scene.words["heading.scales"], lines, scene.style, width)


def choices_block(scene: CamScene, note: str, width: float) -> View:
    """Return the choices that the task makes in words, what the lines of the diagrams are, and the task's note."""
    words = scene.words
    words_given = ((name, given.value) for name, given in scene.givens.items() if isinstance(given.value, str))
    chosen = ((name, words.choice(name, value)) for name, value in words_given)
    lines: Lines = [(f"{words.texts.get(f'given.cam_{name}', about)}:", said) for name, (about, said) in chosen]
    lines += _about(scene)
    lines += [_smaller(scene)] if scene.reduction != 1.0 else []
    lines += [words_of(note)] if note else []
    return text_block("choices", words["heading.cam_choices"], lines, scene.style, width)


def roller_block(scene: CamScene, width: float) -> View:
    """Return the sizes of the cam for a roller, with the rules for its radius and the transmission angles."""
    solved, words = scene.solved, scene.words
    roller = needed(solved.roller)
    mm = words.unit("mm")
    sizes = roller.sizes
    legs = [length("e", abs(sizes.e)), length("s_0", sizes.s_0)]
    lines: Lines = [worked(words, "r_0", "hypotenuse", legs, MM)]
    if "r_0_tangents" in solved.values:
        pair = ((name, float(solved.values[name]) * 1e3) for name in ("r_0_tangents", "e_tangents"))
        texts = (f"{words.symbol(name)} = {words.number(value, 2)} {mm}" for name, value in pair)
        lines.append((f"{words['said.cam_tangents']}:", "; ".join(texts)))
    lines += [(line,) for line in offsets_line(scene)]
    lines += rules(scene)
    return text_block("equations_roller", words["heading.cam_roller"], lines, scene.style, width)


def plate_block(scene: CamScene, width: float) -> View:
    """Return the sizes of the cam for a plate."""
    words, plate = scene.words, needed(scene.solved.plate)
    values = scene.solved.values
    lines: Lines = []
    if "r_0_flat_tangent" in values:
        tangent = float(values["r_0_flat_tangent"]) * 1e3
        text = f"{words.symbol('r_0_flat_tangent')} = {words.number(tangent, 2)} {words.unit('mm')}"
        lines.append((f"{words['said.cam_tangents']}:", text))
    rho_flat, r_0 = length("rho_flat", values["rho_flat"], True), length("r_0_flat", plate.sizes.r_0, True)
    least = length("r_0_flat_min", plate.sizes.r_0_min)
    if plate.given:
        more = f"≥ {words.symbol('rho_flat')} = {words.short(rho_flat.value)} {words.unit('mm')}"
        lines.append((*worked(words, "rho_flat_min", "excess", [r_0, least], MM), more))
    else:
        lines.append(worked(words, "r_0_flat", "enlarged", [least, rho_flat], MM))
    reach = [length("ds_max", scene.solved.motion.ds_max.value), length("margin", values["margin"], True)]
    lines.append(worked(words, "R_plate", "enlarged", reach, MM))
    return text_block("equations_plate", words["heading.cam_plate"], lines, scene.style, width)


def length(name: str, value: float, exact: bool = False) -> Input:
    """Return a length, m, as it goes into a formula."""
    return Input(float(value) * 1e3, exact, name=name, times=1e3)


def _given_a(scene: CamScene) -> bool:
    return scene.solved.layout.given == ACCELERATION


def _amplitudes(scene: CamScene) -> Lines:
    if "l_A2" not in scene.solved.values:
        return []
    u = float(scene.solved.values["u"])
    terms = [_drawn(scene, "l_A1", True), Input(u, name="u")]
    return [worked(scene.words, "l_A2", "second_amplitude", terms, MM)]


def _drawn(scene: CamScene, name: str, exact: bool = False) -> Input:
    """Return a length on paper as it goes into a formula."""
    return Input(scene.paper(name), exact, name=name, times=1e3)


def _factors(scene: CamScene, mark: str = "") -> Lines:
    """Return mu_s from the drawn stroke, and what follows from it; `mark` is that of chords."""
    solved, mu = scene.solved, scene.mu
    h = float(solved.values["h"])
    highest = scene.paper("S_max_chord") if mark else solved.motion.h / mu("mu_s")
    terms = [Input(h, solved.rocker is None, name="h"), Input(highest, name=f"S_max{mark}", times=1e3)]
    lines = [worked(scene.words, f"mu_s{mark}", "scale_factor", terms, Shown("m/mm"))]
    for name, base, pole in [("mu_ds", "mu_s", "H_v")] + [("mu_d2s", "mu_ds", "H_a")] * _given_a(scene):
        factors = (Input(mu(factor), name=factor) for factor in (f"{base}{mark}", "mu_phi"))
        terms = [*factors, _drawn(scene, pole, True)]
        lines.append(worked(scene.words, f"{name}{mark}", "derived_scale", terms, Shown("m/mm")))
    if mark:
        return lines
    lines.append(_rate(scene, "mu_v", "speed_scale", "mu_ds", mu("mu_ds"), "(m/s)/mm"))
    if _given_a(scene):
        lines.append(_rate(scene, "mu_a", "acceleration_scale", "mu_d2s", mu("mu_d2s"), "(m/s^2)/mm"))
    return lines


def _rate(scene: CamScene, name: str, law: str, of: str, value: float, unit: str) -> tuple[str, ...]:
    """Return how a rate by time follows from one by the angle of the cam."""
    omega = Input(float(scene.solved.values["omega"]), True, name="omega")
    return worked(scene.words, name, law, [omega, Input(value, name=of)], Shown(unit))


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
    motion = scene.solved.motion
    lines = [_rate(scene, "v_max", "speed_scale", "ds_max", motion.ds_max.value, "m/s")]
    if _given_a(scene):
        lines.append(_rate(scene, "a_max", "acceleration_scale", "d2s_max", motion.d2s_max.value, "m/s^2"))
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


def offsets_line(scene: CamScene) -> list[str]:
    """Return the offsets permitted at a given r_0, and the one chosen."""
    roller, words = scene.solved.roller, scene.words
    if roller is None or roller.offsets is None:
        return []
    found, e = roller.offsets, roller.sizes.e
    sizes = {"e_least": found.least, "e": e, "e_most": found.most}
    least, chosen, most = (f"{words.symbol(n)} = {scene.length(size)} {words.unit('mm')}" for n, size in sizes.items())
    if e < found.least:
        return [f"{chosen} < {least}"]
    return [f"{chosen} > {most}" if e > found.most else f"{least} ≤ {chosen} ≤ {most}"]


def rocker_block(scene: CamScene, width: float) -> View:
    """Return the sizes of the cam for a rocker, with the rules for its roller and the transmission angles."""
    cam, words = needed(scene.solved.rocker), scene.words
    sizes, swing = cam.sizes, cam.rocker.motion.h
    travel = [Input(swing * DEGREES, True, name="psi", times=DEGREES), length("l_rocker", sizes.l, True)]
    given = "l_OC" in scene.givens
    sides = [length("l_rocker", sizes.l, True), length("l_OC", sizes.l_OC, given), length("r_0", sizes.r_0)]
    lines: Lines = [
        (f"{words['said.cam_arc']}:",),
        worked(words, "h", ARC, travel, MM),
        (f"{words['said.cam_first_angle']}:",),
        worked(words, "psi_0", "angle_of_triangle", sides, Shown("deg", DEGREES)),
        *rules(scene),
    ]
    return text_block("equations_rocker", words["heading.cam_rocker"], lines, scene.style, width)


SIZES_OF = {"roller": roller_block, "rocker": rocker_block, "plate": plate_block}


def transfer(scene: CamScene, plan: str) -> tuple[str, ...]:
    """Return by how much the ordinates of both diagrams are multiplied, and the angle of the projecting line."""
    words = scene.words
    ratios = [f"{words.symbol(DRAWN[mu])}: {ratio(scene, mu, SCALES[plan])}" for mu in FROM[plan]]
    lines = [words["said.cam_equal"], ";  ".join(ratios)]
    if plan in ANGLES:
        nu, over, under = ANGLES[plan]
        angle = scene.degrees(swept(1.0 + 0j, complex(scene.mu(under), scene.mu(over))))
        lines.append(f"tg {words.symbol(nu)} = {ratio(scene, over, under)};  {words.symbol(nu)} = {angle}")
    return tuple(lines)


def ratio(scene: CamScene, over: str, under: str) -> str:
    """Return the ratio of two scale factors in letters and its value."""
    ratio = scene.words.short(round(scene.mu(over) / scene.mu(under), DECIMALS))
    return f"{scene.words.symbol(over)}/{scene.words.symbol(under)} = {ratio}"


def motion_table(scene: CamScene) -> View:
    """Return travel, analogues and pressure angle by section lines; at a jump the limits before and after it."""
    solved, words = scene.solved, scene.words
    before, after = (solved.motion.at(solved.angles, side) for side in (-1, 1))
    columns = [[words.number(float(phi) * DEGREES, 2) for phi in solved.angles]]
    columns += [_column(scene, [a * 1e3, b * 1e3]) for a, b in zip(before, after, strict=True)]
    mm = words.unit("mm")
    head = [words["table.cam_row"], f"{words.symbol('phi')}, °"]
    head += [f"{words.symbol(name)}, {mm}" for name in ("s", "ds", "d2s")]
    if solved.rolling is not None:
        angles = [theta(solved, solved.angles, side) * DEGREES for side in (-1, 1)]
        columns.append(_column(scene, angles))
        head.append(f"{words.symbol('theta')}, °")
    rows = [[str(i), *cells] for i, cells in enumerate(zip(*columns, strict=True))]
    return table("motion", words["heading.cam_table"], [head, *rows], scene.style)


def _column(scene: CamScene, limits: Sequence[Any]) -> list[str]:
    """Return the cells of a column, two numbers where the limits from both sides differ."""
    least = SAME * max(abs(value) for side in limits for value in side.tolist())
    cells = []
    for a, b in zip(*(side.tolist() for side in limits), strict=True):
        texts = [scene.words.number(value, 2) for value in ((a,) if abs(b - a) <= least else (a, b))]
        cells.append(" / ".join(texts))
    return cells
