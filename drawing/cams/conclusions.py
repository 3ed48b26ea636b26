"""What a note of a cam concludes: greatest rates, sizes, how the rules of good design are kept, undercuts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from ...plans.cams.cam import PLATE
from ...plans.cams.rules import Rule, rules_of
from .inversion import undercut_notes
from .scene import CamScene

Texts = Mapping[str, str]


def conclusions(scene: CamScene, texts: Texts) -> Iterator[str]:
    """Go through the sentences for the end of the note."""
    solved = scene.solved
    yield _motion(scene, texts)
    yield _chords(scene, texts)
    if solved.roller is not None or solved.rocker is not None:
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
    cam = solved.roller or solved.rocker
    assert cam is not None
    names = {"r_0": cam.sizes.r_0, "R_roller": cam.profile.R, "e": abs(cam.sizes.e)}
    if solved.rocker is not None:
        names["l_OC"] = solved.rocker.sizes.l_OC
    said = {name: scene.stated(name, size) for name, size in names.items()}
    yield texts[f"cam.conclusion.{'roller' if solved.rocker is None else 'rocker'}"].format(**said)
    for rule in rules_of(solved):
        key = f"cam.conclusion.{rule.name}_{'kept' if rule.ok else 'broken'}"
        yield texts[key].format(**_rule(scene, rule))
    yield from _undercuts(scene, undercut_notes(scene, cam.profile.undercuts, rocks=solved.rocker is not None))


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
    plate = scene.solved.plate
    assert plate is not None
    sizes, least = plate.sizes, float(plate.profile.rho_min)
    said = {"r_0_flat": sizes.r_0, "R_plate": sizes.R_plate}
    yield texts["cam.conclusion.plate"].format(**{name: scene.stated(name, size) for name, size in said.items()})
    if 0.0 <= least < math.inf:
        yield texts["cam.conclusion.convex"].format(rho=f"{scene.length(least)} {scene.words.unit('mm')}")
    yield from _undercuts(scene, undercut_notes(scene, plate.profile.undercuts))


def _undercuts(scene: CamScene, notes: tuple[str, ...]) -> Iterator[str]:
    """Join what the sheet says of an undercut profile to a sentence."""
    if notes:
        warning, *places = notes
        yield f"{warning} {'; '.join(places)}."
