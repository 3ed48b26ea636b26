"""The drawing of a gear pair told step by step, as an explanatory note numbers it, and what the note concludes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from ...plans.check import AT_LEAST, AT_MOST, Check, rule_of
from ...plans.gears.construction import MESHING, THETA
from ...plans.gears.gear import WHEELS
from ...scales.scale import Scale
from ..notes.blocks import Story
from .scene import GearScene
from .sliding_view import theta_said
from .tables import number_of

PAPER = 1  # decimals of segments on paper
SIZES = ("g_alpha", "p", "p_b", "rho_f", "l_N1N2", "PW", *(f"s_{i}" for i in WHEELS))
LAID_OFF = tuple(name for name in SIZES if name != "PW")  # at the scale of the meshing; PW is a segment itself
ANGLES = ("alpha_w", *(f"phi_alpha{i}" for i in WHEELS))
RADII = tuple(f"{circle}{i}" for circle in ("w", "b", "a", "f", "") for i in WHEELS)
BROKEN = {AT_LEAST: "<", AT_MOST: ">"}
RULES = ("undercut", "interference", "contact_ratio", "contact_flanks", "tip")
ENDS = {"theta_12": "A1", "theta_21": "A2"}  # where on the active line a wheel slides most: at the root of its teeth
Texts = Mapping[str, str]


def story(scene: GearScene, scales: Mapping[str, Scale], texts: Mapping[str, str]) -> Story:
    """Return what the note of a gear pair says beside its views: the steps of each, lengths of the meshing on paper.

    Parameters
    ----------
    scales : mapping of str to Scale
        By plan.
    texts : mapping of str to str
        The sentences, by key.
    """
    theta = scales[THETA].mu if THETA in scales else scene.size("mu_theta") * 1e-3
    said = _said(scene, scales[MESHING].mu if MESHING in scales else 1e-3, theta)
    return Story(conclusions=tuple(conclusions(scene, texts)), texts=texts, said=said)


def _said(scene: GearScene, mu: float, mu_theta: float) -> dict[str, str]:
    """Return what sentences may name: sizes with letters and units, angles, radii and segments on paper."""
    words, sizes = scene.words, scene.solved.sizes
    mm = words.unit("mm")
    found = {name: f"{scene.stated(name)} {mm}" for name in SIZES} | {name: scene.angle(name) for name in ANGLES}
    for name in RADII:
        found[f"r_{name}"] = f"{words.number(0.5 * sizes[f'd_{name}'] / mu, PAPER)} {mm}"
    for name in LAID_OFF:
        found[f"{name}_drawn"] = f"{words.number(sizes[name] / mu, PAPER)} {mm}"
    for i, rolled in zip(WHEELS, scene.solved.layout.rollings, strict=True):
        found[f"parts_{i}"] = str(rolled.parts)
    found["mu_theta"] = theta_said(words, mu_theta)
    return found


def conclusions(scene: GearScene, texts: Texts) -> Iterator[str]:
    """Go through the sentences for the end of the note."""
    lengths = {name: f"{scene.stated(name)} {scene.words.unit('mm')}" for name in ("a", "a_w")}
    numbers = {name: _plain(scene, name) for name in ("x_1", "x_2")}
    yield texts["gear.conclusion.shifts"].format(alpha_w=scene.angle("alpha_w"), **lengths, **numbers)
    for rule in RULES:
        yield from _judged(scene, texts, rule)
    yield from _wear(scene, texts)


def _plain(scene: GearScene, name: str) -> str:
    return f"{scene.words.symbol(name)} = {scene.words.short(round(scene.size(name), 4))}"


def _judged(scene: GearScene, texts: Texts, rule: str) -> Iterator[str]:
    """Tell whether a rule is kept: of all wheels, or of which it is not."""
    checks = [check for check in scene.solved.checks if rule_of(check)[0] == rule]
    broken = [check for check in checks if not check.ok]
    if not checks:
        return
    said = "; ".join(_compared(scene, check) for check in broken or checks)
    yield texts[f"gear.conclusion.{rule}_{'broken' if broken else 'kept'}"].format(said=said)
    ratio = checks[0].value
    if rule == "contact_ratio" and 1.0 < ratio < 2.0:
        part = scene.words.number(100.0 * (ratio - 1.0), 0)
        yield texts["gear.conclusion.pairs"].format(part=part)


def _compared(scene: GearScene, check: Check) -> str:
    """Return a quantity beside its limit, as they stand to one another."""
    words = scene.words
    sign = check.sign if check.ok else BROKEN[check.relation]
    value, limit = (number_of(scene, check, side) for side in (check.value, check.limit))
    of = f"{words.symbol(check.of)} = " if check.of else ""
    return f"{words.symbol(check.quantity)} = {value} {sign} {of}{limit}"


def _wear(scene: GearScene, texts: Texts) -> Iterator[str]:
    """Tell where the wheels slide most, and which of them more."""
    values = {name: scene.size(f"{name}_{end}") for name, end in ENDS.items()}
    if not all(map(math.isfinite, values.values())):
        return
    words = scene.words
    said = {name: f"{words.symbol(name)} = {words.number(value, 2)}" for name, value in values.items()}
    sizes = {round(abs(value), 2) for value in values.values()}
    worse = "both" if len(sizes) == 1 else max(values, key=lambda name: abs(values[name]))
    yield texts[f"gear.conclusion.wear_{worse}"].format(**said)
