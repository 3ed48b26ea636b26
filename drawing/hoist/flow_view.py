"""The flow chart of the calculation (figure 3 of the article), with the way that these numbers take drawn thick."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from ...plans.hoist.checks import STRENGTH
from ..shapes import Group, Head, Pen, Polyline, Text
from ..text import lay_out
from ..view import Canvas, View
from .scene import HoistScene, canvas_of

STEP = 5.4  # heights of letters from block to block
TALL = 2.0  # heights of letters of a block
PAD = 1.6
POINTED = 2.4  # heights of other blocks that a diamond has
KINDS = {
    "begin": "round",
    "end": "round",
    "data": "slanted",
    "places": "slanted",
    "larger": "diamond",
    "strong": "diamond",
}


def flow_view(scene: HoistScene) -> View:
    """Draw the flow chart."""
    canvas, words, h = canvas_of(scene), scene.words, scene.style.text
    found, ok = scene.solved.forces.found, scene.solved.forces.ok[STRENGTH]
    s = words.symbol
    texts = {
        "begin": words["hoist.begin"],
        "data": words["hoist.data"],
        "places": f"{s('beta_0')}, {s('beta_2')}",
        "reduced": f"m (4), {s('C_01')} (5), {s('C_12')} (7)",
        "roots": f"{s('t_1')} (11), {s('t')}_{{2}} (12)",
        "resting": f"{s('F_12_max')} (10)",
        "hanging": f"{s('T_1')}, {s('P_12_max')} (15′)",
        "larger": f"{s('F_12_max')} > {s('P_12_max')}?",
        "stress": f"{s('sigma_max')} = {s('F_max')}/S",
        "strong": f"[σ]/{s('sigma_max')} ≥ K?",
        "end": words["hoist.end"],
    }
    widest = max(lay_out(text, h).width for text in texts.values()) + 2.0 * PAD * h + 2.0 * TALL * h
    levels = {name: -k * STEP * h for k, name in enumerate(texts)}
    for name, text in texts.items():
        _block(canvas, name, text, (levels[name], widest), h)
    _ways(canvas, scene, levels, widest, found["F_12_max"] > found["P_12_max"], ok)
    return canvas.finish("flow", (words["heading.hoist_flow"],), (words["hoist.taken"],))


def _block(canvas: Canvas, name: str, text: str, place: tuple[float, float], h: float) -> None:
    """Draw a block: rounded, slanted, a diamond or a rectangle, with its text."""
    level, wide = place
    half, up, lean = 0.5 * wide, 0.5 * TALL * h, TALL * h
    kind = KINDS.get(name, "")
    corners = {
        "": ((-half, -up), (half, -up), (half, up), (-half, up)),
        "slanted": ((-half, -up), (half - lean, -up), (half, up), (-half + lean, up)),
        "round": ((-half + up, -up), (half - up, -up), (half, 0.0), (half - up, up), (-half + up, up), (-half, 0.0)),
        "diamond": ((-half - lean, 0.0), (0.0, -POINTED * up), (half + lean, 0.0), (0.0, POINTED * up)),
    }[kind]
    outline = tuple(complex(x, level + y) for x, y in corners)
    canvas.add(Group((Polyline(outline, Pen.MAIN, closed=True, fill="white"),), "block", name))
    canvas.add(Text(complex(0.0, level - 0.5 * h), text, h, "middle", role="block"))


def _ways(canvas: Canvas, scene: HoistScene, levels: dict[str, float], wide: float, resting: bool, ok: bool) -> None:
    """Draw the ways between the blocks; the one that is taken thick, the others thin."""
    names, up, h = list(levels), 0.5 * TALL * scene.style.text, scene.style.text
    for before, after in pairwise(names):
        reach = {name: up * (POINTED if KINDS.get(name) == "diamond" else 1.0) for name in (before, after)}
        taken = before != "strong" or ok
        _way(
            canvas,
            (1j * (levels[before] - reach[before]), 1j * (levels[after] + reach[after])),
            taken,
            f"{before}-{after}",
        )
    words, half = scene.words, 0.5 * wide
    right, left = half + (TALL + 2.2) * h, -half - (TALL + 2.2) * h
    at = levels["larger"]
    answer = words["hoist.yes" if resting else "hoist.no"]
    canvas.add(Text(complex(0.8 * h, at - POINTED * up - 1.4 * h), answer, h, role="answer"))
    back = (
        complex(-half - TALL * h, levels["strong"]),
        complex(left, levels["strong"]),
        complex(left, levels["places"]),
        complex(-half + TALL * h * 0.5, levels["places"]),
    )
    _way(canvas, back, not ok, "strong-places")
    canvas.add(Text(complex(left + 0.4 * h, levels["strong"] + 0.4 * h), words["hoist.no"], h, role="answer"))
    canvas.add(Text(complex(0.8 * h, levels["strong"] - POINTED * up - 1.4 * h), words["hoist.yes"], h, role="answer"))
    greatest = words.symbol("F_12_max" if resting else "P_12_max")
    canvas.add(Text(complex(right - 1.6 * h, at - 0.5 * h), f"{words.symbol('F_max')} = {greatest}", h, role="answer"))


def _way(canvas: Canvas, places: Sequence[complex], taken: bool, name: str) -> None:
    pen = Pen.MAIN if taken else Pen.THIN
    canvas.add(
        Group((Polyline(tuple(places), pen),), "taken" if taken else "way", name),
        Head(places[-1], places[-1] - places[-2]),
    )
