"""What is written of a cam: calculations with their numbers, the table of its motion, and the work step by step.

Scale factors, sizes and rules of design stand beside the drawing. An explanatory note numbers the steps, and concludes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ...plans.cams import course
from ...plans.cams.cam import PLATE, VALUES
from ...plans.cams.construction import ACCELERATION, ARC, PLATE_SIZES, ROCKER_SIZES, SIZES
from ...plans.cams.envelopes import Envelope
from ...plans.cams.rules import rules_of
from ...plans.cams.solve import SCALES
from ...scales.scale import Scale
from ..handouts import Shown as Begun
from ..notes.blocks import Sentences, Story
from ..printed import DEGREES, Input, Shown, calculation, segment_decimals, worked
from ..symbols import swept
from ..table import table, text_block, words_of
from ..view import View
from .inversion import undercut_notes
from .scene import MU_DIGITS, SHOWN, CamScene, is_aside, needed

Lines = list[tuple[str, ...]]
MM = Shown("mm", 1e3)
FROM = {SIZES: ("mu_s", "mu_ds"), PLATE_SIZES: ("mu_s", "mu_d2s")}  # scale factors of the diagrams
DRAWN = {"mu_s": "s", "mu_ds": "ds", "mu_d2s": "d2s"}  # what they draw
ANGLES = {SIZES: ("nu", "mu_s", "mu_ds")}  # of the straight line that projects one diagram to the scale of the other
RATES = {  # by time: the law by which each follows from one by the angle of the cam, and its unit
    "mu_v": ("speed_scale", "(m/s)/mm"),
    "mu_a": ("acceleration_scale", "(m/s^2)/mm"),
    "v_max": ("speed_scale", "m/s"),
    "a_max": ("acceleration_scale", "m/s^2"),
}
DECIMALS = 4
PAPER = 2  # decimals of segments on paper
Said = dict[str, str]
Texts = Mapping[str, str]
SAME = 1e-9  # part of the greatest value of its column within which two limits at a jump are one


def scales_block(scene: CamScene, width: float) -> View:
    """Return the calculation of amplitudes, scale factors and greatest rates."""
    values, motion, lines = scene.solved.values, scene.solved.motion, Lines()
    if "l_A2" in values:
        terms = [_drawn(scene, "l_A1", True), Input(float(values["u"]), name="u")]
        lines.append(worked(scene.words, "l_A2", "second_amplitude", terms, MM))
    lines += [*_factors(scene), *_chords(scene)]
    lines.append(_rate(scene, "v_max", "ds_max", motion.ds_max.value))
    if scene.solved.layout.given == ACCELERATION:
        lines.append(_rate(scene, "a_max", "d2s_max", motion.d2s_max.value))
    return text_block("equations_scales", scene.words["heading.scales"], lines, scene.style, width)


def choices_block(scene: CamScene, note: str, width: float) -> View:
    """Return the choices that the task makes in words, what the lines of the diagrams are, and the task's note."""
    words = scene.words
    words_given = ((name, given.value) for name, given in scene.givens.items() if isinstance(given.value, str))
    chosen = ((name, words.choice(name, value)) for name, value in words_given)
    lines: Lines = [(f"{words.texts.get(f'given.cam_{name}', about)}:", said) for name, (about, said) in chosen]
    lines.append(tuple(words["said.cam_curves"].split("|")))
    if (lower := scene.solved.motion.lower).lasts:
        lines.append((words["said.cam_lower"].format(angle=scene.angle("phi_lower", lower.length)),))
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
        texts = (f"{scene.dimension(name, solved.values[name])} {mm}" for name in ("r_0_tangents", "e_tangents"))
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
        text = scene.dimension("r_0_flat_tangent", values["r_0_flat_tangent"])
        lines.append((f"{words['said.cam_tangents']}:", f"{text} {words.unit('mm')}"))
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
    for name, base, pole in [("mu_ds", "mu_s", "H_v")] + [("mu_d2s", "mu_ds", "H_a")] * (
        scene.solved.layout.given == ACCELERATION
    ):
        factors = (Input(mu(factor), name=factor) for factor in (f"{base}{mark}", "mu_phi"))
        terms = [*factors, _drawn(scene, pole, True)]
        lines.append(worked(scene.words, f"{name}{mark}", "derived_scale", terms, Shown("m/mm")))
    if mark:
        return lines
    lines.append(_rate(scene, "mu_v", "mu_ds", mu("mu_ds")))
    if scene.solved.layout.given == ACCELERATION:
        lines.append(_rate(scene, "mu_a", "mu_d2s", mu("mu_d2s")))
    return lines


def _rate(scene: CamScene, name: str, of: str, value: float) -> tuple[str, ...]:
    """Return how a rate by time follows from one by the angle of the cam."""
    omega = Input(float(scene.solved.values["omega"]), True, name="omega")
    law, unit = RATES[name]
    return worked(scene.words, name, law, [omega, Input(value, name=of)], Shown(unit))


def _chords(scene: CamScene) -> Lines:
    """Return the scale factors by the curves of chords, and by how much these do not close."""
    words, values = scene.words, scene.solved.values
    names = [name for name in ("s_close", "v_close") if name in values]
    gaps = (f"{words.symbol(name)} = {words.number(scene.paper(name), 2)} {words.unit('mm')}" for name in names)
    closing = words["said.cam_closing"].format(values=", ".join(gaps))
    return [(f"{words['said.cam_by_chords']}:",), *_factors(scene, "_chord"), (closing,)]


def _smaller(scene: CamScene) -> tuple[str, ...]:
    """Say that the diagrams are smaller than the lengths given, and with what lengths they are drawn."""
    words, mm = scene.words, scene.words.unit("mm")
    lengths = ((name, words.short(round(scene.paper(name), 2))) for name in ("l_A1", "H_a", "H_v"))
    said = [f"{words.symbol(name)} = {length} {mm};" for name, length in lengths]
    axis = words["said.cam_axis"].format(angle=scene.degrees(scene.mu("mu_phi")))
    return (*words_of(words["said.cam_smaller"].format(part=words.short(scene.reduction))), *said, axis)


def rules(scene: CamScene) -> Lines:
    """Return the rules of good design, each with its numbers and whether it is kept."""
    words, mm, lines = scene.words, scene.words.unit("mm"), Lines()
    for rule in rules_of(scene.solved):
        if rule.of:  # the roller's radius beside the greatest one, a part of a size
            factors = [Input(rule.part, True), Input(rule.size * 1e3)]
            (part, size), limit = calculation(words, lambda a, b: a * b, factors)
            roller = f"{words.symbol('R_roller')} = {words.short(round(rule.value * 1e3, 6))} {mm}"
            text = f"{roller} ≤ {words.short(rule.part)}·{words.symbol(rule.of)} = {part}·{size} = {limit} {mm}"
        else:
            text = f"{scene.angle(f'{rule.name}_min', rule.value)} ≥ {scene.angle(rule.name, rule.limit)}"
        lines.append((text, f"({words['said.ok' if rule.ok else 'said.fails']})"))
    return lines


def offsets_line(scene: CamScene) -> list[str]:
    """Return the offsets permitted at a given r_0, and the one chosen."""
    roller = scene.solved.roller
    if roller is None or roller.offsets is None:
        return []
    found, e = roller.offsets, roller.sizes.e
    sizes, mm = {"e_least": found.least, "e": e, "e_most": found.most}, scene.words.unit("mm")
    least, chosen, most = (f"{scene.dimension(name, size)} {mm}" for name, size in sizes.items())
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
        angles = [course.theta(solved, solved.angles, side) * DEGREES for side in (-1, 1)]
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


# The work as a note tells it.


def story(scene: CamScene, scales: Mapping[str, Scale], texts: Texts) -> Story:
    """Return what the note of a cam says beside its views, and what their stages are told with: lengths as drawn.

    The sentences of `texts` are by key.
    """
    followers = scene.solved.cam.followers
    named = texts["cam.and"].join(texts[f"cam.for.{follower}"] for follower in followers)
    aim = Sentences((texts["cam.aims" if len(followers) > 1 else "cam.aim"].format(followers=named),))
    said = _said(scene, texts)
    return Story(conclusions=tuple(conclusions(scene, texts)), before={"givens": (aim,)}, texts=texts, said=said)


def begun(scene: CamScene, steps: int) -> dict[str, Begun]:
    """Return what handouts show of the table: section lines, and their angles from the first step on."""
    return {"motion": Begun(columns=2 if steps else 1)}


def _said(scene: CamScene, texts: Texts) -> Said:
    """Return what sentences may name: quantities with letters and units, lengths on paper."""
    solved, found = scene.solved, {}
    units = {name: VALUES[name] for name in solved.givens if name in VALUES}
    units |= {name: quantity.unit for name, quantity in solved.quantities.items()}
    for name in (name for name, unit in units.items() if unit in ("m", "rad")):
        value = float(solved.values[name])
        found[name] = scene.stated(name, value) if units[name] == "m" else scene.angle(name, value)
    found |= _of_task(scene) | _of_diagrams(scene, texts)
    if solved.rolling is not None:
        found |= _of_pressure(scene)
    if solved.roller is not None:
        found |= _of_roller_sizes(scene, texts)
    if solved.rocker is not None:
        found |= _of_rocker(scene)
    if solved.plate is not None:
        found |= _of_plate(scene)
    if solved.draws_profiles:  # the plans of the cam begin with their scale and the first circles
        beside = ("l_OC",) if solved.rocker is not None else ("e",) * is_aside(scene)
        radii = ("r_0", *beside) if solved.rolling is not None else ()
        found |= {"scale": scene.words.drawn_at(scene.mu_l), "radii": ", ".join(found[name] for name in radii)}
    return found


def on_paper(scene: CamScene, mm: float) -> str:
    """Return a length on paper with its unit, without zeros at the end."""
    return f"{scene.words.short(round(mm, PAPER))} {scene.words.unit('mm')}"


def read(scene: CamScene, plan: str, name: str, metres: float) -> str:
    """Return a size as it is read from a plan: its millimetres times the scale factor."""
    words, mu = scene.words, float(f"{scene.scale(plan).mu:.{MU_DIGITS}g}")
    places, decimals = segment_decimals(metres, mu)
    product = f"{words.number(metres / mu, places)}·{words.short(mu)} = {words.number(metres, decimals)}"
    return f"{words.symbol(name)} = {product} {words.unit('m')} = {scene.length(metres)} {words.unit('mm')}"


def _of_task(scene: CamScene) -> Said:
    """Return what the task gives, and the section lines."""
    solved, words = scene.solved, scene.words
    division, motion = solved.layout.division, solved.motion
    phases = [phase for phase in motion.phases[:3] if phase.lasts]
    lengths = ((f"phi_{p.name}", p.length / scene.across.mu) for p in phases)
    found = {"last": str(division.last), "n_rise": str(division.top)}
    found["n_fall"] = str(division.last - division.leave)
    found["phases"] = ", ".join(f"{words.symbol(name)} = {on_paper(scene, mm)}" for name, mm in lengths)
    found["angles"] = ", ".join(scene.angle(f"phi_{p.name}", p.length) for p in phases)
    return found | {"per_mm": words["said.cam_axis"].format(angle=scene.degrees(scene.across.mu))}


def _of_diagrams(scene: CamScene, texts: Texts) -> Said:
    """Return poles, greatest ordinates and closing errors, mm of paper."""
    solved, words = scene.solved, scene.words
    names = ("H_a", "H_v", "v_close", "s_close", "S_max_chord", "l_A1", "l_A2")
    drawn = {name: scene.paper(name) for name in names if name in solved.values}
    drawn["S_max"] = solved.motion.h / scene.mu("mu_s")
    drawn["V_max"] = solved.motion.ds_max.value / scene.mu("mu_ds")
    found = {name: f"{words.symbol(name)} = {on_paper(scene, mm)}" for name, mm in drawn.items()}
    for name in {"v_close", "s_close"} & drawn.keys():
        found[name] = f"{words.symbol(name)} = {words.number(drawn[name], PAPER)} {words.unit('mm')}"
    amplitudes = ("l_A1", "l_A2") if solved.layout.given == ACCELERATION else ("l_A1",)
    found["amplitudes"] = ", ".join(found[name] for name in amplitudes if name in found)
    jumps = solved.layout.division.jumps
    lines = ", ".join(map(str, jumps))
    return found | {"jumps": texts["cam.jumps"].format(lines=lines) if jumps else ""}


def _of_pressure(scene: CamScene) -> Said:
    """Return the angles of the position that is shown, the least ones of each phase, the permitted ones."""
    solved = scene.solved
    line = course.pressed(solved, SHOWN)
    angle = float(course.theta(solved, solved.angles[line]))
    found = {"theta": scene.angle("theta", angle, line)}
    found["gamma"] = scene.angle("gamma", course.transmission(angle), line)
    found |= {f"theta_{phase}": f"[θ] = {scene.degrees(abs(limit))}" for phase, limit in course.permitted(solved)}
    return found | {"line": str(line), "rho_min": scene.stated("rho_min", needed(solved.rolling).profile.rho_min)}


def _of_roller_sizes(scene: CamScene, texts: Texts) -> Said:
    """Return what is read from S over ds/dphi, and what the plan of the cam begins with."""
    solved, words, roller = scene.solved, scene.words, needed(scene.solved.roller)
    sizes, sides = roller.sizes, (texts["cam.right"], texts["cam.left"])
    found = {"e": scene.stated("e", abs(sizes.e)), "mu_s_ds": scene.factor(scene.scale(SIZES))}
    found |= {"r_0_read": read(scene, SIZES, "r_0", sizes.r_0), "offsets": "".join(offsets_line(scene))}
    found["rise_side"], found["fall_side"] = sides[:: solved.cam.sense]
    found |= {"ratio_s": ratio(scene, "mu_s", "mu_s_ds"), "ratio_ds": ratio(scene, "mu_ds", "mu_s_ds")}
    line = course.pressed(scene.solved, SHOWN)
    ds = abs(course.analogue(solved, line).real)
    found["OP"] = f"OP_{{{line}}} = |{words.symbol('ds')}| = {scene.length(ds)} {words.unit('mm')}"
    return found


def _of_rocker(scene: CamScene) -> Said:
    """Return what is read from the positions of a rocker, and what the plan of the cam begins with."""
    solved, words, cam = scene.solved, scene.words, needed(scene.solved.rocker)
    sizes = {"r_0": cam.sizes.r_0, "l_OC": cam.sizes.l_OC}
    found = {f"{name}_read": read(scene, ROCKER_SIZES, name, size) for name, size in sizes.items()}
    found |= {"l_letter": words.symbol("l_rocker"), "l_OC_letter": words.symbol("l_OC")}
    found["l_rocker_paper"] = on_paper(scene, cam.sizes.l / scene.mu_l)
    dpsi = abs(course.turning(solved, course.pressed(solved, SHOWN)))
    return found | {"ratio": words.short(float(f"{dpsi:.4g}"))}


def _of_plate(scene: CamScene) -> Said:
    """Return what is read from S over d2s/dphi2, and the plate."""
    solved, words, plate = scene.solved, scene.words, needed(scene.solved.plate)
    sizes = plate.sizes
    found = {"r_0_flat_min_read": read(scene, PLATE_SIZES, "r_0_flat_min", sizes.r_0_min)}
    found["mu_s_d2s"] = scene.factor(scene.scale(PLATE_SIZES))
    found |= {"ratio_s_d2s": ratio(scene, "mu_s", "mu_s_d2s"), "ratio_d2s": ratio(scene, "mu_d2s", "mu_s_d2s")}
    parts = scene.length(solved.motion.ds_max.value), scene.length(solved.values["margin"])
    total = f"{' + '.join(parts)} = {scene.length(sizes.R_plate)} {words.unit('mm')}"
    return found | {"R_plate_sum": f"{words.symbol('R_plate')} = {total}"}


def conclusions(scene: CamScene, texts: Texts) -> Iterator[str]:
    """Go through the sentences for the end of the note."""
    solved, words, values = scene.solved, scene.words, scene.solved.values
    rates = [name for name in ("v_max", "a_max") if name in values]
    said = {name: f"{scene.value(float(values[name]))} {words.unit(RATES[name][1])}" for name in rates}
    said = {name: f"{words.symbol(name)} = {rate}" for name, rate in said.items()}
    moved = texts["cam.roller_centre" if solved.layout.rocks else "cam.follower"]
    yield texts[f"cam.conclusion.{'motions' if 'a_max' in said else 'motion'}"].format(of=moved, **said)
    exact, drawn = solved.motion.h / scene.mu("mu_s"), scene.paper("S_max_chord")  # of the stroke
    gap = f"{words.symbol('s_close')} = {words.number(scene.paper('s_close'), PAPER)} {words.unit('mm')}"
    part = words.number(100.0 * abs(drawn - exact) / exact, 2)
    yield texts["cam.conclusion.chords"].format(part=part, s_close=gap)
    if solved.rolling is not None:
        yield from _roller(scene, texts)
    if solved.plate is not None:
        yield from _plate(scene, texts)
    elif PLATE in solved.cam.followers and solved.motion.velocity_jumps:
        yield texts["cam.conclusion.no_plate"]


def _roller(scene: CamScene, texts: Texts) -> Iterator[str]:
    """Tell the sizes of a cam for a roller, the rules, and where the profile is undercut."""
    solved, words, cam = scene.solved, scene.words, needed(scene.solved.rolling)
    names = {"r_0": cam.sizes.r_0, "R_roller": cam.profile.R, "e": abs(cam.sizes.e)}
    if solved.rocker is not None:
        names["l_OC"] = solved.rocker.sizes.l_OC
    said = {name: scene.stated(name, size) for name, size in names.items()}
    yield texts[f"cam.conclusion.{'roller' if solved.rocker is None else 'rocker'}"].format(**said)
    for rule in rules_of(solved):
        if rule.of:
            part = f"{words.short(rule.part)}·{words.symbol(rule.of)}"
            limit = f"{scene.length(rule.limit)} {words.unit('mm')}"
            said = {"part": part, "limit": limit, rule.of: scene.stated(rule.of, rule.size)}
        else:
            said = {"value": scene.angle(f"{rule.name}_min", rule.value), "limit": scene.angle(rule.name, rule.limit)}
        yield texts[f"cam.conclusion.{rule.name}_{'kept' if rule.ok else 'broken'}"].format(**said)
    yield from _undercuts(scene, cam.profile)


def _plate(scene: CamScene, texts: Texts) -> Iterator[str]:
    """Tell the sizes of a cam for a plate, and how its profile is curved."""
    plate = needed(scene.solved.plate)
    sizes, least = plate.sizes, float(plate.profile.rho_min)
    said = {"r_0_flat": sizes.r_0, "R_plate": sizes.R_plate}
    yield texts["cam.conclusion.plate"].format(**{name: scene.stated(name, size) for name, size in said.items()})
    if 0.0 <= least < math.inf:
        yield texts["cam.conclusion.convex"].format(rho=f"{scene.length(least)} {scene.words.unit('mm')}")
    yield from _undercuts(scene, plate.profile)


def _undercuts(scene: CamScene, profile: Envelope) -> Iterator[str]:
    """Join what the sheet says of an undercut profile to a sentence."""
    if notes := undercut_notes(scene, profile):
        warning, *places = notes
        yield f"{warning} {'; '.join(places)}."
