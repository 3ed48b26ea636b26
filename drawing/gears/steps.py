"""The drawing of a gear pair told step by step, as an explanatory note numbers it; handouts show the same steps."""

from __future__ import annotations

from collections.abc import Mapping

from ...plans.gears.gear import WHEELS
from ...plans.gears.sliding_plan import THETA
from ...scales.scale import Scale
from ..notes.blocks import Story
from .conclusions import conclusions
from .scene import MESHING, GearScene
from .theta_diagram import theta_said

PAPER = 1  # decimals of segments on paper
SIZES = ("g_alpha", "p", "p_b", "rho_f", "l_N1N2", "PW", *(f"s_{i}" for i in WHEELS))
LAID_OFF = tuple(name for name in SIZES if name != "PW")  # at the scale of the meshing; PW is a segment itself
ANGLES = ("alpha_w", *(f"phi_alpha{i}" for i in WHEELS))
RADII = tuple(f"{circle}{i}" for circle in ("w", "b", "a", "f", "") for i in WHEELS)


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
