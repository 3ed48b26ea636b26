"""Structure in words: mobility, groups in order of attachment, formula of structure."""

from __future__ import annotations

from itertools import groupby

from ....plans.linkages.structure import KINDS, Group, Structure
from ...table import text_block
from ...view import View
from ..scene import Scene
from .equations import Lines

CLASSES = {2: "II", 3: "III", 4: "IV"}


def structure_block(scene: Scene, width: float) -> View:
    """Return mobility, groups and the formula of structure."""
    words, s = scene.words, scene.solved.structure
    lines: Lines = [
        (words["structure.count"].format(n=s.moving, p1=s.lower, p2=s.higher),),
        ("W = 3n − 2p_{1} − p_{2} =", f"3·{s.moving} − 2·{s.lower} − {s.higher} = {s.mobility}"),
        *(_group(scene, group) for group in s.groups),
        (words["structure.driver"].format(frame=words.frame, link=s.driver),),
    ]
    text, _, tail = words["structure.formula"].partition("{formula}")
    first, *rest = formula(s, words.frame)
    lines.append((text.strip(), first, *rest[:-1], *(f"{last}{tail}" for last in rest[-1:])))
    return text_block("structure", words["heading.structure"], lines, scene.style, width)


def _group(scene: Scene, group: Group) -> tuple[str, ...]:
    """Return a group's links, class, order and kind, in chunks."""
    words = scene.words
    text = words["structure.group"].format(
        links=_links(group), group_class=CLASSES[group.group_class], order=group.order
    )
    *parts, last = text.split(", ")
    if group.kind in KINDS:
        parts, last = [*parts, last], words[f"kind.{group.kind}"]
    return (*(f"{part}," for part in parts), last)


def formula(structure: Structure, frame: str = "0") -> list[str]:
    """Return the formula of structure in chunks: groups that hang on the same links before stand side by side, ∥."""
    chunks = [f"I({frame}, {structure.driver})"]
    for _, groups in groupby(_levels(structure), key=lambda item: item[0]):
        texts = [f"{CLASSES[g.group_class]}_{{{g.view or g.order}}}({_links(g)})" for _, g in groups]
        chunks.append("→ " + " ∥ ".join(texts))
    return chunks


def _levels(structure: Structure) -> list[tuple[int, Group]]:
    """Return the groups with the length of the chain that leads to each from the driver, by this length."""
    level = {0: 0, structure.driver: 0}
    found = []
    for group in structure.groups:
        own = 1 + max(level[number] for number in group.before)
        level |= dict.fromkeys(group.links, own)
        found.append((own, group))
    return sorted(found, key=lambda item: item[0])


def _links(group: Group) -> str:
    return ", ".join(map(str, sorted(group.links)))
