"""Letters that depend on the mechanism: guides x–x, y–y; ends n_2, n_3 on one plan; second forces of couples."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import combinations

from ...plans.linkages.guides import guide_letters
from ...plans.linkages.parts import SYMBOLS
from ...plans.linkages.solved import SolvedLinkage
from ...plans.names import CORIOLIS, COUPLE, NORMAL, role
from ..words import Words
from .reading import Reading, read

__all__ = ["guide_letters", "lettered"]


def lettered(words: Words, solved: SolvedLinkage) -> Words:
    """Return the words for the sheet of one mechanism."""
    reading = read(solved.program)
    frame = str(len(solved.mechanism.links) + 1) if words.notation["frame"] == "last" else "0"
    return replace(
        words,
        seconds=_seconds(reading),
        letters=_ends(reading, words),
        frame=frame,
        ends=_joints(solved),
        parted=solved.mechanism.parted,
    )


def _seconds(reading: Reading) -> frozenset[str]:
    """Return the second force of each couple on the lever, and its arm."""
    found = set()
    for step in reading.program:
        if step.law == "opposite" and role(step.name).part == COUPLE:
            found.add(step.name)
            found.update(arm.name for moment in reading.users(step.name) for arm in reading.users(moment.name))
    return frozenset(name for name in found if role(name).part == COUPLE or role(name).kind == "h")


def _joints(solved: SolvedLinkage) -> dict[str, str]:
    """Return links by their ends, `O_{1}B`: by the two joints that are farthest apart, in the order of the link."""
    named = {}
    for link in solved.mechanism.links:
        joints = {pair.point for pair in solved.mechanism.pairs if link.number in pair.links}
        pairs = combinations([point for point in link.points if point in joints], 2)
        at = {point: complex(*(solved.values[xy] for xy in place)) for point, place in link.points.items()}
        ends = max(pairs, key=lambda ends: abs(at[ends[1]] - at[ends[0]]), default=())
        if ends:
            named[str(link.number)] = "".join(re.sub(r"(\d+)", r"_{\1}", end) for end in ends)
    return named


def _ends(reading: Reading, words: Words) -> dict[str, str]:
    """Return the letters of ends of normal parts and accelerations of Coriolis where a plan has several of them."""
    letters: dict[str, str] = {}
    for kind, key in ((NORMAL, "normal_end"), (CORIOLIS, "coriolis_end")):
        marks = [mark for name in reading.made if (mark := role(name)).plan in SYMBOLS and mark.kind == kind]
        for plan in dict.fromkeys(mark.plan for mark in marks):
            here, taken = [mark for mark in marks if mark.plan == plan], set[str]()
            for mark in here if len(here) > 1 else ():
                link = _link_of(reading, mark)
                index = mark.letters if link in (*taken, "") else link
                taken.add(link)
                letters[mark] = f"{words.notation[key]}_{{{index}}}"
    return letters


def _link_of(reading: Reading, mark: str) -> str:
    """Return the number of the link whose turning makes the vector that ends at a mark; of a guide for Coriolis."""
    step = reading.made[mark]
    made = reading.step(step.operands[1 if step.verb == "chain" else 2])
    names = made.operands if made else ()
    # the law of a normal part takes omega itself, or the relative velocity from which omega is read
    rates = [name for name in names if role(name).kind == "omega"]
    rates += [user.name for name in names for user in reading.users(name) if user.law == "turning"]
    return role(rates[0]).of if rates else ""
