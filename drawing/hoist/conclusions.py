"""What a note of a hoist concludes: lift-off, the greatest force beside the static one, strength, bent beams."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...plans.hoist.checks import STRENGTH
from .scene import HoistScene

MM = 1e3
Texts = Mapping[str, str]


def conclusions(scene: HoistScene, texts: Texts) -> Iterator[str]:
    """Go through the sentences for the end of the note."""
    yield texts["hoist.conclusion.lift_off"].format(t_1=scene.stated("t_1", unit="s"), F_12_t1=scene.stated("F_12_t1"))
    yield _greatest(scene, texts)
    yield from _validity(scene, texts)
    yield _strength(scene, texts)
    yield from _article(scene, texts)
    yield from _bent(scene, texts)


def _greatest(scene: HoistScene, texts: Texts) -> str:
    """Compare the greatest force of the rope with that of the load at rest."""
    words = scene.words
    after = scene.size("P_12_max") >= scene.size("F_12_max")
    force = scene.stated("P_12_max" if after else "F_12_max")
    factor = f"{words.symbol('dynamic_factor')} = {scene.value(scene.size('dynamic_factor'))}"
    when = scene.stated("T_1" if after else "t_F12_max", unit="s")
    key = f"hoist.conclusion.greatest_{'after' if after else 'before'}"
    return texts[key].format(force=force, P_st=scene.stated("P_st"), factor=factor, when=when)


def _validity(scene: HoistScene, texts: Texts) -> Iterator[str]:
    """Tell whether the rope stays taut and the load off its support, so that the formulas hold."""
    if scene.solved.forces.motion is None:
        least = {name: scene.stated(name) for name in ("F_12_min", "P_12_min")}
        yield texts["hoist.conclusion.valid"].format(**least)
        return
    for check in scene.solved.forces.checks:
        if check.name != STRENGTH and not check.ok:
            yield texts[f"hoist.conclusion.{check.name}"]


def _strength(scene: HoistScene, texts: Texts) -> str:
    """Tell stress and safety of the rope."""
    words, ok = scene.words, scene.solved.forces.ok[STRENGTH]
    safety = f"[σ]/{words.symbol('sigma_max')} = {scene.value(scene.size('safety'))}"
    limit = f"K = {words.short(scene.size('K'))}"
    stress = scene.stated("sigma_max", scene.size("sigma_max") * 1e-6, "MPa")
    key = f"hoist.conclusion.{'strong' if ok else 'weak'}"
    return texts[key].format(stress=stress, safety=f"{safety} {'≥' if ok else '<'} {limit}")


def _article(scene: HoistScene, texts: Texts) -> Iterator[str]:
    """Tell by how much the article's formula differs; where the rope goes slack both say little of one another."""
    exact, printed = scene.size("P_12_max"), scene.size("P_12_max_printed")
    if scene.solved.forces.motion is None:
        part = scene.words.number(100.0 * abs(printed - exact) / exact, 1)
        key = f"hoist.conclusion.article_{'more' if printed >= exact else 'less'}"
        yield texts[key].format(printed=scene.stated("P_12_max_printed"), part=part)


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
