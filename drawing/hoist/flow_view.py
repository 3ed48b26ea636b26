"""The flow chart of the calculation (figure 3 of the article), with the way that these numbers take drawn thick."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from ...plans.hoist.forces import STRENGTH
from ..shapes import Group, Head, Pen, Polyline, Text
from ..text import lay_out
from ..view import Canvas, View
from .scene import HoistScene

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
    canvas, words, h = Canvas(scene.style), scene.words, scene.style.text
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
    widest = max(widest, 2.0 * _box(scene) + 4.0 * h)
    order = [*texts]
    beyond = order.index("stress")  # a level more, for the two boxes before it
    levels = {name: -(k + (k >= beyond)) * STEP * h for k, name in enumerate(order)}
    for name, text in texts.items():
        _block(canvas, name, text, (levels[name], widest), h)
    _ways(canvas, scene, levels, widest, found["F_12_max"] > found["P_12_max"], ok)
    return canvas.finish("flow", (words["heading.hoist_flow"],), (words["hoist.taken"],))


def _box(scene: HoistScene) -> float:
    """Return the width of the box that takes one of both forces."""
    texts = (f"{scene.words.symbol('F_max')} = {scene.words.symbol(name)}" for name in ("F_12_max", "P_12_max"))
    return max(lay_out(text, scene.style.text).width for text in texts) + 1.4 * scene.style.text


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
    words, h = scene.words, scene.style.text
    up, corner = 0.5 * TALL * h, 0.5 * wide + TALL * h
    for before, after in pairwise(levels):
        if before == "larger":
            continue
        reach = {name: up * (POINTED if KINDS.get(name) == "diamond" else 1.0) for name in (before, after)}
        ends = 1j * (levels[before] - reach[before]), 1j * (levels[after] + reach[after])
        _way(canvas, ends, before != "strong" or ok, f"{before}-{after}")
    _choice(canvas, scene, levels, corner, resting)
    left = -corner - 2.2 * h
    back = (
        complex(-corner, levels["strong"]),
        complex(left, levels["strong"]),
        complex(left, levels["places"]),
        complex(-0.5 * wide + TALL * h * 0.5, levels["places"]),
    )
    _way(canvas, back, not ok, "strong-places")
    canvas.add(Text(complex(left + 0.4 * h, levels["strong"] + 0.4 * h), words["hoist.no"], h, role="answer"))
    below = levels["strong"] - POINTED * up - 1.4 * h
    canvas.add(Text(complex(0.8 * h, below), words["hoist.yes"], h, role="answer"))


def _choice(canvas: Canvas, scene: HoistScene, levels: dict[str, float], corner: float, resting: bool) -> None:
    """Draw both ways out of the question which force is the larger, with what each takes, until they meet."""
    words, h = scene.words, scene.style.text
    up, level, low = 0.5 * TALL * h, levels["larger"], levels["stress"]
    middle = level - STEP * h
    answers = {True: words["hoist.yes"], False: words["hoist.no"]}
    for side, name, taken in ((-1, "F_12_max", resting), (1, "P_12_max", not resting)):
        text = f"{words.symbol('F_max')} = {words.symbol(name)}"
        half = 0.5 * lay_out(text, h).width + 0.7 * h
        at = complex(side * (half + 0.8 * h), middle)
        outline = tuple(at + complex(x * half, y * up) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
        canvas.add(Group((Polyline(outline, Pen.MAIN, closed=True, fill="white"),), "block", name))
        canvas.add(Text(at - 0.5j * h, text, h, "middle", role="block"))
        first = complex(side * corner, level), complex(side * corner, middle), at + side * half
        _way(canvas, first, taken, f"larger-{name}")
        joint = complex(at.real, low + up + 1.6 * h)
        _way(canvas, (at - 1j * up, joint, complex(0.0, joint.imag), 1j * (low + up)), taken, f"{name}-stress")
        beside = complex(side * (corner - 0.4 * h), level - 2.2 * h)
        canvas.add(Text(beside, answers[side < 0], h, "right" if side > 0 else "left", role="answer"))


def _way(canvas: Canvas, places: Sequence[complex], taken: bool, name: str) -> None:
    pen = Pen.MAIN if taken else Pen.THIN
    canvas.add(
        Group((Polyline(tuple(places), pen),), "taken" if taken else "way", name),
        Head(places[-1], places[-1] - places[-2]),
    )
