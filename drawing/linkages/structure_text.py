"""Structure in words: mobility, groups in order of attachment, formula of structure."""

from __future__ import annotations

from ..table import text_block
from ..view import View
from .equations import Lines
from .scene import Scene

CLASSES = {1: "I", 2: "II", 3: "III"}


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
        *parts, last = text.split(", ")
        lines.append((*(f"{part}," for part in parts), last))
        formula += f" → {CLASSES[group.group_class]}_{{{group.view}}}({links})"
    lines.append((words["structure.driver"].format(link=s.driver),))
    head, _, tail = words["structure.formula"].partition("{formula}")
    lines.append((head.strip(), formula + tail))
    return text_block("structure", words["heading.structure"], lines, scene.style, width)
