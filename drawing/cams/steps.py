"""The work on a cam told step by step, as an explanatory note numbers it, and what the note concludes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from ...plans.cams.cam import PLATE
from ...plans.cams.construction import ACCELERATION, PLATE_SIZES, ROCKER_SIZES, SIZES
from ...plans.cams.course import analogue, permitted, pressed, theta, transmission, turning
from ...plans.cams.motion import FALL, RISE
from ...plans.cams.rules import Rule, rules_of
from ...scales.scale import Scale
from ..handouts import Shown as Begun
from ..notes.blocks import Sentences, Story
from ..printed import segment_decimals
from .inversion import undercut_notes
from .scene import MU_DIGITS, CamScene, is_aside, needed
from .sizes_view import SHOWN
from .text import offsets_line, ratio

PAPER = 2  # decimals of segments on paper
Said = dict[str, str]
Texts = Mapping[str, str]


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
    solved = scene.solved
    found = _of_task(scene) | _of_diagrams(scene, texts)
    if solved.rolling is not None:
        found |= _of_pressure(scene)
    if solved.roller is not None:
        found |= _of_roller(scene, texts)
    if solved.rocker is not None:
        found |= _of_rocker(scene)
    if solved.plate is not None:
        found |= _of_plate(scene)
    return found | _of_profiles(scene) if solved.draws_profiles else found


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
    found = {"h": scene.stated("h", motion.h), "last": str(division.last), "n_rise": str(division.top)}
    found["n_fall"] = str(division.last - division.leave)
    found["phases"] = ", ".join(f"{words.symbol(name)} = {on_paper(scene, mm)}" for name, mm in lengths)
    found["angles"] = ", ".join(f"{words.symbol(f'phi_{p.name}')} = {scene.degrees(p.length)}" for p in phases)
    found["per_mm"] = words["said.cam_axis"].format(angle=scene.degrees(scene.across.mu))
    for name in ("gamma_rise", "gamma_fall"):
        if name in solved.givens:
            found[name] = f"{words.symbol(name)} = {scene.degrees(solved.givens[name])}"
    for name in ("R_roller", "l_rocker", "rho_flat", "margin", "r_0", "e", "l_OC"):
        if name in solved.givens:
            found[name] = scene.stated(name, solved.givens[name])
    return found


def _of_diagrams(scene: CamScene, texts: Texts) -> Said:
    """Return poles, greatest ordinates and closing errors, mm of paper."""
    solved, words = scene.solved, scene.words
    names = ("H_a", "H_v", "v_close", "s_close", "S_max_chord", "l_A1", "l_A2")
    drawn = {name: scene.paper(name) for name in names if name in solved.values}
    most = {"S_max": (0.0, solved.motion.h, "mu_s"), "V_max": (0.0, solved.motion.ds_max.value, "mu_ds")}
    drawn |= {name: value / scene.mu(mu) for name, (_, value, mu) in most.items()}
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
    solved, words = scene.solved, scene.words
    line = pressed(scene.solved, SHOWN)
    angle = float(theta(solved, solved.angles[line]))
    shown = {"theta": angle, "gamma": transmission(angle)}
    found = {name: f"{words.symbol(name)}_{{{line}}} = {scene.degrees(value)}" for name, value in shown.items()}
    for name in ("gamma_rise_min", "gamma_fall_min"):
        found[name] = f"{words.symbol(name)} = {scene.degrees(solved.values[name])}"
    limits = {phase: abs(limit) for phase, limit in permitted(solved)}
    found |= {f"theta_{phase}": f"[θ] = {scene.degrees(limits[phase])}" for phase in (RISE, FALL)}
    return found | {"line": str(line), "rho_min": scene.stated("rho_min", needed(solved.rolling).profile.rho_min)}


def _of_roller(scene: CamScene, texts: Texts) -> Said:
    """Return what is read from S over ds/dphi, and what the plan of the cam begins with."""
    solved, words, roller = scene.solved, scene.words, needed(scene.solved.roller)
    sizes, sides = roller.sizes, (texts["cam.right"], texts["cam.left"])
    found = {name: scene.stated(name, float(solved.values[name])) for name in ("r_0_tangents", "e_tangents")}
    found |= {"r_0": scene.stated("r_0", sizes.r_0), "e": scene.stated("e", abs(sizes.e))}
    found |= {"r_0_read": read(scene, SIZES, "r_0", sizes.r_0), "offsets": "".join(offsets_line(scene))}
    found["rise_side"], found["fall_side"] = sides[:: solved.cam.sense]
    found |= {"ratio_s": ratio(scene, "mu_s", "mu_s_ds"), "ratio_ds": ratio(scene, "mu_ds", "mu_s_ds")}
    found["mu_s_ds"] = scene.factor(scene.scale(SIZES))
    line = pressed(scene.solved, SHOWN)
    ds = abs(analogue(solved, line).real)
    found["OP"] = f"OP_{{{line}}} = |{words.symbol('ds')}| = {scene.length(ds)} {words.unit('mm')}"
    return found


def _of_profiles(scene: CamScene) -> Said:
    """Return what the plans of the cam begin with: their scale, the radii of the first circles."""
    solved = scene.solved
    radii: dict[str, float] = {}
    if solved.rocker is not None:
        radii = {"r_0": solved.rocker.sizes.r_0, "l_OC": solved.rocker.sizes.l_OC}
    elif solved.roller is not None:
        radii = {"r_0": solved.roller.sizes.r_0}
        if is_aside(scene):
            radii["e"] = abs(solved.roller.sizes.e)
    drawn = ", ".join(scene.stated(name, radius) for name, radius in radii.items())
    return {"scale": scene.words.drawn_at(scene.mu_l), "radii": drawn}


def _of_rocker(scene: CamScene) -> Said:
    """Return what is read from the positions of a rocker, and what the plan of the cam begins with."""
    solved, words, cam = scene.solved, scene.words, needed(scene.solved.rocker)
    sizes = {"r_0": cam.sizes.r_0, "l_OC": cam.sizes.l_OC}
    found = {name: scene.stated(name, size) for name, size in sizes.items()}
    found |= {f"{name}_read": read(scene, ROCKER_SIZES, name, size) for name, size in sizes.items()}
    found |= {"l_rocker": scene.stated("l_rocker", cam.sizes.l), "l_letter": words.symbol("l_rocker")}
    found |= {"l_rocker_paper": on_paper(scene, cam.sizes.l / scene.mu_l), "l_OC_letter": words.symbol("l_OC")}
    angles = {"psi": cam.rocker.motion.h, "psi_0": float(solved.values["psi_0"])}
    found |= {name: f"{words.symbol(name)} = {scene.degrees(angle)}" for name, angle in angles.items()}
    dpsi = abs(turning(solved, pressed(solved, SHOWN)))
    return found | {"ratio": words.short(float(f"{dpsi:.4g}"))}


def _of_plate(scene: CamScene) -> Said:
    """Return what is read from S over d2s/dphi2, and the plate."""
    solved, words, plate = scene.solved, scene.words, needed(scene.solved.plate)
    sizes = plate.sizes
    found = {"r_0_flat": scene.stated("r_0_flat", sizes.r_0), "mu_s_d2s": scene.factor(scene.scale(PLATE_SIZES))}
    found["r_0_flat_min_read"] = read(scene, PLATE_SIZES, "r_0_flat_min", sizes.r_0_min)
    found["r_0_flat_tangent"] = scene.stated("r_0_flat_tangent", float(solved.values["r_0_flat_tangent"]))
    found |= {"ratio_s_d2s": ratio(scene, "mu_s", "mu_s_d2s"), "ratio_d2s": ratio(scene, "mu_d2s", "mu_s_d2s")}
    if "rho_flat_min" in solved.values:
        found["rho_flat_min"] = scene.stated("rho_flat_min", float(solved.values["rho_flat_min"]))
    parts = scene.length(solved.motion.ds_max.value), scene.length(solved.values["margin"])
    total = f"{' + '.join(parts)} = {scene.length(sizes.R_plate)} {words.unit('mm')}"
    return found | {"R_plate_sum": f"{words.symbol('R_plate')} = {total}"}


def conclusions(scene: CamScene, texts: Texts) -> Iterator[str]:
    """Go through the sentences for the end of the note."""
    solved = scene.solved
    yield _motion(scene, texts)
    yield _chords(scene, texts)
    if solved.rolling is not None:
        yield from _roller(scene, texts)
    if solved.plate is not None:
        yield from _plate(scene, texts)
    elif PLATE in solved.cam.followers and solved.motion.velocity_jumps:
        yield texts["cam.conclusion.no_plate"]


def _motion(scene: CamScene, texts: Texts) -> str:
    """Tell the greatest velocity, and the greatest acceleration of a law that has one."""
    words, values = scene.words, scene.solved.values
    units = {"v_max": "m/s", "a_max": "m/s^2"}
    said = {
        name: f"{words.symbol(name)} = {scene.value(float(values[name]))} {words.unit(unit)}"
        for name, unit in units.items()
        if name in values
    }
    moved = texts["cam.roller_centre" if scene.solved.layout.rocks else "cam.follower"]
    return texts[f"cam.conclusion.{'motions' if 'a_max' in said else 'motion'}"].format(of=moved, **said)


def _chords(scene: CamScene, texts: Texts) -> str:
    """Compare the stroke that chords draw with that of the exact curve."""
    words = scene.words
    exact, drawn = scene.solved.motion.h / scene.mu("mu_s"), scene.paper("S_max_chord")
    gap = f"{words.symbol('s_close')} = {words.number(scene.paper('s_close'), 2)} {words.unit('mm')}"
    part = words.number(100.0 * abs(drawn - exact) / exact, 2)
    return texts["cam.conclusion.chords"].format(part=part, s_close=gap)


def _roller(scene: CamScene, texts: Texts) -> Iterator[str]:
    """Tell the sizes of a cam for a roller, the rules, and where the profile is undercut."""
    solved = scene.solved
    cam = needed(solved.rolling)
    names = {"r_0": cam.sizes.r_0, "R_roller": cam.profile.R, "e": abs(cam.sizes.e)}
    if solved.rocker is not None:
        names["l_OC"] = solved.rocker.sizes.l_OC
    said = {name: scene.stated(name, size) for name, size in names.items()}
    yield texts[f"cam.conclusion.{'roller' if solved.rocker is None else 'rocker'}"].format(**said)
    for rule in rules_of(solved):
        key = f"cam.conclusion.{rule.name}_{'kept' if rule.ok else 'broken'}"
        yield texts[key].format(**_rule(scene, rule))
    yield from _undercuts(undercut_notes(scene, cam.profile.undercuts, rocks=solved.rocker is not None))


def _rule(scene: CamScene, rule: Rule) -> dict[str, str]:
    """Return a rule's numbers: sizes of the roller in mm, transmission angles in degrees."""
    words = scene.words
    if rule.of:
        limit = f"{scene.length(rule.limit)} {words.unit('mm')}"
        part = f"{words.short(rule.part)}·{words.symbol(rule.of)}"
        return {"part": part, "limit": limit, rule.of: scene.stated(rule.of, rule.size)}
    return {
        "value": f"{words.symbol(f'{rule.name}_min')} = {scene.degrees(rule.value)}",
        "limit": f"{words.symbol(rule.name)} = {scene.degrees(rule.limit)}",
    }


def _plate(scene: CamScene, texts: Texts) -> Iterator[str]:
    """Tell the sizes of a cam for a plate, and how its profile is curved."""
    plate = needed(scene.solved.plate)
    sizes, least = plate.sizes, float(plate.profile.rho_min)
    said = {"r_0_flat": sizes.r_0, "R_plate": sizes.R_plate}
    yield texts["cam.conclusion.plate"].format(**{name: scene.stated(name, size) for name, size in said.items()})
    if 0.0 <= least < math.inf:
        yield texts["cam.conclusion.convex"].format(rho=f"{scene.length(least)} {scene.words.unit('mm')}")
    yield from _undercuts(undercut_notes(scene, plate.profile.undercuts))


def _undercuts(notes: tuple[str, ...]) -> Iterator[str]:
    """Join what the sheet says of an undercut profile to a sentence."""
    if notes:
        warning, *places = notes
        yield f"{warning} {'; '.join(places)}."
