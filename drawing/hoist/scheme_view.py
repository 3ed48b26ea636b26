"""The hoist drawn: its scheme and dynamic model, its beams as they bend, and the flow chart of its calculation."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from ...plans.hoist.construction import BENT, FORCE, LETTERS, SCHEME, SECTIONS
from ...plans.hoist.forces import STRENGTH
from ...plans.hoist.solve import OF_BEAM, bent
from ..dimensions import linear
from ..figure import Figure, stages
from ..page import Layer
from ..shapes import Arc, Arrow, Circle, Group, Head, Line, Pen, Polyline, Text
from ..symbols import COILS, HALF_TURN, coils, fixed_pivot, hatching, revolute, unit
from ..text import lay_out, symbol
from ..view import Canvas, View
from .scene import HoistScene
from .text import formula

LONGEST = 26.0  # mm of a rope in a picture that need not be to scale
TORN, ACROSS = 1.5, 2.5  # mm: half the gap of a broken rope, half its strokes
LOAD = 0.45  # of the rope's length, the height of the load at most
BOX = 12.0  # mm, the load's height at most
DRUM = 3.0  # mm, radius
SPRING, HALF = 26.0, 4.0  # mm: length of a spring, half its width
MASS = 11.0, 13.0  # mm: half the width and the height of the mass
LEG = 4.0  # mm, straight ends of a spring
ARROW = 13.0  # mm, an arrow
OF_ROLLER = 0.14  # radius of the rollers of a support, in its heights
ROW_OF_DIMENSIONS = 3.2  # heights of letters from dimension to dimension
STAGE_OF_BEAM = {"0": "support", "2": "bridge"}  # stages
APART = 14.0  # mm between the beams
SAME = 0.5  # mm
TALL, RHOMBUS = 3.0, 5.6  # heights of letters of a block, and of a question
GAP, JOINED = 2.0, 1.6  # heights of letters between blocks, and more of them where two ways meet
ASIDE = 2.4  # heights of letters from a question to the way beside it
PAD = 0.9  # heights of letters on both sides of the text of a block
LEAN = 1.5  # heights of letters by which the sides of data lean
KINDS = {"begin": "terminator", "end": "terminator", "data": "data", "places": "data"}
KINDS |= {"larger": "decision", "strong": "decision"}


def picture(scene: HoistScene) -> View:
    """Draw the scheme to stand beside a question: a long rope is broken."""
    return _scheme_view(scene, LONGEST)


def _scheme_view(scene: HoistScene, longest: float = math.inf) -> View:
    """Draw the scheme with its dimensions, with no longer rope than so many millimetres."""
    canvas, words, style = SCHEME_FIGURE.canvas(scene), scene.words, scene.style
    canvas.breaks = {"extension": False}
    at = {mark: scene.mm(f"{SCHEME}.{mark}") for mark in ("O1", "O2", "A0", "A2", "B1", "B2")}
    rope = min(abs(at["A2"] - at["A0"]), longest)
    lower = at["A2"] - at["A0"] - 1j * rope
    at |= {mark: at[mark] - lower for mark in ("A2", "B1", "B2")}
    canvas.part("support")
    tall = min(BOX, LOAD * rope)
    corners = tuple(at["A0"] + complex(x * 0.8 * tall, y * tall) for x, y in ((-1, 0), (1, 0), (1, 1), (-1, 1)))
    canvas.group("link", "1", Polyline(corners, Pen.MAIN, closed=True, fill="white"))
    canvas.part("rope", *_rope(at["A0"] + 1j * tall, at["A2"], broken=bool(lower)))
    canvas.group("drum", "A2", Circle(at["A2"], DRUM, Pen.MAIN, fill="white"))
    for left, right, number in (("O1", "O2", "0"), ("B1", "B2", "2")):
        canvas.part(STAGE_OF_BEAM[number], Group((Line(at[left], at[right]),), "link", number))
        supports = fixed_pivot(at[left], left, style), _rolling_support(at[right], right, scene)
        canvas.add(*(replace(one, layer=Layer.RESULT.value) for one in supports))  # they cover the ends of the beam
    for mark, letter in (("A0", "A_{0}"), ("A2", "A_{2}")):
        canvas.part("support" if mark == "A0" else "rope")
        canvas.label(letter, at[mark], prefer=(1.0 + 1j) if mark == "A2" else (1.0 - 1j), clear=DRUM)
    canvas.keep_clear(*corners)
    canvas.part("support")
    h, name = style.label, words.symbol("G_1")
    if tall > 1.5 * h and 1.6 * tall > lay_out(name, h).width + 1.0:
        canvas.add(Text(at["A0"] + complex(0.0, 0.5 * (tall - h) + 0.1 * h), name, h, "middle", role="label"))
    else:
        canvas.label(name, at["A0"] + complex(0.8 * tall, 0.5 * tall), prefer=1.0 + 0j, clear=1.0)
    _dimensions(canvas, scene, at)
    ratio = f"{words.drawn_at(scene.mus['mu_l'])};  {scene.factors('mu_l')}"
    return canvas.finish("scheme", (words["heading.hoist_scheme"], ratio))


def _rope(low: complex, high: complex, *, broken: bool) -> Iterator[Line]:
    """Go through the lines of a rope, torn in its middle where it is broken."""
    if not broken:
        yield Line(low, high, Pen.MAIN, role="rope", name="L")
        return
    middle = 0.5 * (low + high)
    for end, at in ((low, middle - 1j * TORN), (high, middle + 1j * TORN)):
        yield Line(end, at, Pen.MAIN, role="rope", name="L")
        yield Line(at - complex(ACROSS, 0.5 * ACROSS), at + complex(ACROSS, 0.5 * ACROSS), Pen.THIN)


def _dimensions(canvas: Canvas, scene: HoistScene, at: dict[str, complex]) -> None:
    """Dimension spans, the places of load and drum from the nearer ends, and the rope."""
    style, layout = scene.style, scene.solved.layout
    low = (1.0 + 2.0 * OF_ROLLER) * style.pivot[1] + style.pair + style.hatch[0]  # of the lowest strokes of a support
    for i, ends, mark, side, bodies in (
        (0, ("O1", "O2"), "A0", -1j, (low + 1.0, 1.0)),
        (2, ("B1", "B2"), "A2", 1j, (style.pair + 1.0, DRUM + 1.0)),
    ):
        canvas.part(STAGE_OF_BEAM[str(i)])
        first, step = side * (max(bodies) + 2.0 * style.text), side * ROW_OF_DIMENSIONS * style.text
        near, gaps = ends[0] if layout.near[i // 2] == "left" else ends[1], bodies
        pair = at[near], at[mark]
        if pair[0].real > pair[1].real:
            pair, gaps = pair[::-1], bodies[::-1]
        linear(canvas, pair, first, scene.stated(f"b_{i}", unit="m"), f"b_{i}", bodies=gaps)
        whole = at[ends[0]], at[ends[1]]
        linear(canvas, whole, first + step, scene.stated(f"l_{i}", unit="m"), f"l_{i}", bodies=(bodies[0], bodies[0]))
    canvas.part("rope")
    far = max(at["O2"].real, at["B2"].real) + style.pivot[2]
    bodies = (at["O2"].real - at["A0"].real + style.pair + 1.0, at["B2"].real - at["A2"].real + style.pair + 1.0)
    rope, out = (at["A0"], at["A2"]), complex(far - at["A0"].real)
    linear(canvas, rope, out, scene.stated("L", unit="m"), "L", bodies=bodies)


def _rolling_support(at: complex, name: str, scene: HoistScene) -> Group:
    """Return a support that can roll: circle, triangle, rollers on a hatched line."""
    width, height, base = scene.style.pivot
    pivot = fixed_pivot(at, name, scene.style)
    foot = at - 1j * (height + scene.style.pair)
    radius = OF_ROLLER * height
    below = foot - 2j * radius
    rollers = tuple(Circle(foot + complex(x * 0.3 * width, -radius), radius, Pen.THIN) for x in (-1, 0, 1))
    ends = below - 0.5 * base, below + 0.5 * base
    kept = tuple(shape for shape in pivot.shapes if not (isinstance(shape, Line) and shape.role == "hatch"))
    ground = Line(*ends), *hatching(*ends, -1j, scene.style)
    return Group((Group(kept, "pivot", name), Group((*rollers, *ground), "rollers", name)), "support", name)


SCHEME_FIGURE = Figure("scheme", _scheme_view, ("mu_l",), stages("blank", "support", "rope", "bridge"), "hoist.scheme")


def _model_view(scene: HoistScene) -> View:
    """Draw the model with its axis, springs, forces."""
    canvas, words = MODEL.canvas(scene), scene.words
    canvas.part("model")
    half, tall = MASS
    bottom = 1j * SPRING
    top = bottom + 1j * tall
    end = top + 1j * SPRING
    canvas.add(Group((Line(-14.0 + 0j, 14.0 + 0j), *hatching(-14.0 + 0j, 14.0 + 0j, -1j, scene.style)), "ground", "0"))
    canvas.add(_spring(0j, bottom, "C_01"), _spring(top, end, "C_12"))
    box = tuple(complex(x, y) for x, y in ((-half, SPRING), (half, SPRING), (half, top.imag), (-half, top.imag)))
    canvas.add(Group((Polyline(box, Pen.MAIN, closed=True, fill="white"),), "link", "m"), Line(end - 9.0, end + 9.0))
    h = scene.style.label
    canvas.add(Text(0.5 * (bottom + top) - 0.35j * h, symbol("m"), h, "middle", role="label"))
    for name, at in (("C_01", 0.28 * bottom), ("C_12", 0.5 * (top + end))):
        canvas.label(words.symbol(name), at - HALF, prefer=-1.0 + 0j, clear=1.0)
    _arrow(canvas, end + 6.0, end + 6.0 + 1j * ARROW, f"{words.symbol('V_t')}, a")
    _arrow(canvas, top + 6.0, top + 6.0 + 1j * ARROW, words.symbol("F_12"))
    _arrow(canvas, bottom + 6.0, bottom + 6.0 - 1j * ARROW, words.symbol("F_01"))
    _arrow(canvas, bottom - 8.5, bottom - 8.5 - 1j * ARROW, "mg")
    axis = complex(half + 12.0, 0.0)
    canvas.add(Line(axis, axis + end, Pen.THIN, role="axis"), Head(axis + end, 1j))
    canvas.add(Line(axis - 2.0, axis + 2.0, Pen.THIN))
    canvas.label("s", axis + end, prefer=1.0 + 0j, clear=1.2)
    said = " ".join(formula(scene, "V_t"))  # the speed with which the rope becomes taut
    if not scene.size("slack"):
        said = scene.stated("V_t", unit="m/s").replace(" = ", f" = {words.symbol('V_0')} = ")
    return canvas.finish("model", (words["heading.hoist_model"],), (said, words["said.arrows"]))


def _arrow(canvas: Canvas, tail: complex, tip: complex, letter: str) -> None:
    canvas.add(Arrow(tail, tip, name=letter))
    canvas.label(letter, tip, prefer=(1.0 + 0j) if tip.real > 0.0 else (-1.0 + 0j), clear=1.2)


def _spring(a: complex, b: complex, name: str) -> Group:
    """Return a spring from `a` to `b`."""
    leg = LEG * unit(b - a)
    step = (b - a - 2.0 * leg) / (2 * COILS)
    bends = coils([a + leg + step * (k + 0.5) for k in range(2 * COILS)], -HALF)
    return Group((Polyline((a, a + leg, *bends, b - leg, b), Pen.THIN),), "spring", name)


MODEL = Figure("model", _model_view, stages=stages("blank", "model"), key="hoist.model")


def _beams_view(scene: HoistScene) -> View:
    """Draw the bent beams under their axes."""
    canvas, words, low = BEAMS_FIGURE.canvas(scene), scene.words, 0.0
    for i in scene.solved.layout.bent:
        low = _beam(canvas, scene, i, low) - APART
    heading = (words["heading.hoist_beams"], scene.factors("mu_w", "mu_x"))
    return canvas.finish("beams", heading, (words["hoist.from_farther"],))


def _beam(canvas: Canvas, scene: HoistScene, i: int, top: float) -> float:
    """Draw one beam with its axis at `top`; return how low it reaches, mm."""
    plan, words, by = BENT[i], scene.words, 1j * top
    feet = [scene.mm(f"{plan}.f{n}") + by for n in range(SECTIONS + 1)]
    canvas.part("axes", Line(feet[0], feet[-1], Pen.AXIS, role="axis", name=plan))
    canvas.part("bent")
    for letter, force in zip(LETTERS, FORCE[i], strict=False):
        points = tuple(place + by for place in scene.places(bent(scene.solved, i, letter, force)))
        nodes = (scene.node(scene.mm(f"{plan}.{letter}{n}") + by, f"{letter}{n}") for n in range(1, SECTIONS))
        pen = Pen.MAIN if letter == LETTERS[0] else Pen.THIN
        canvas.add(Group((Polyline(points, pen),), "curve", f"{plan}_{letter}"), *nodes)
        canvas.small(words.symbol(force), points[2 * OF_BEAM // 3], -1j, 1.2)
    canvas.part("axes")
    for end in (feet[0], feet[-1]):
        canvas.add(revolute(end, plan, scene.style))
    clear = scene.style.pair + 1.5
    canvas.small(words["hoist.beam_0" if i == 0 else "hoist.beam_2"], feet[0], prefer=-1.0 + 0j, clear=clear)
    places = [("M", "fM", f"w_{i}_max")]
    if abs(scene.mm(f"{plan}.A") - scene.mm(f"{plan}.M")) > SAME:  # in the middle of the beam they are one
        places.insert(0, ("A", "fA", f"w_{i}"))
    for mark, foot, name in places:
        canvas.part("bent" if mark == "A" else "greatest")
        at, above = scene.mm(f"{plan}.{mark}") + by, scene.mm(f"{plan}.{foot}") + by
        canvas.add(Line(above, at, Pen.THIN, role="deflection", name=name), scene.node(at, name, filled=True))
        said = scene.stated(name, float(scene.solved.quantities[name].value or 0.0) * 1e3, "mm")
        canvas.small(said, at, -1.0 - 1j if mark == "A" else 1.0 - 1j, 1.2)
    canvas.part("greatest")
    ends = scene.mm(f"{plan}.fM") + by, feet[-1]
    linear(canvas, ends, 6j, scene.stated(f"x_w{i}", unit="m"), f"x_w{i}")
    return top + min(scene.mm(f"{plan}.M").imag, 0.0)


BEAMS_FIGURE = Figure(
    "beams", _beams_view, ("part",), stages("axes", bent=("", "circle.ends"), greatest=""), "hoist.beams"
)


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
    wide = max(_width(text, KINDS.get(name, ""), h) for name, text in texts.items())
    chosen = {name: f"{s('F_max')} = {s(name)}" for name in ("F_12_max", "P_12_max")}
    narrow = max(_width(text, "", h) for text in chosen.values())
    levels, low = {}, 0.0
    for name in texts:
        low -= (TALL + GAP + JOINED) * h * (name == "stress")  # below the two boxes before it
        up = _half(name, h)
        levels[name] = low - up
        low -= 2.0 * up + GAP * h
    for name, text in texts.items():
        _block(canvas, name, text, (1j * levels[name], wide), h)
    _ways(canvas, scene, levels, wide, ok)
    left = _choice(canvas, scene, levels, chosen, (wide, narrow), found["F_12_max"] > found["P_12_max"])
    _back(canvas, scene, levels, wide, left - GAP * h, not ok)
    return canvas.finish("flow", (words["heading.hoist_flow"],), (words["hoist.taken"],))


def _half(name: str, h: float) -> float:
    """Return half the height of a block."""
    return 0.5 * h * (RHOMBUS if KINDS.get(name) == "decision" else TALL)


def _width(text: str, kind: str, h: float) -> float:
    """Return how wide a block must be for its text: a rhombus is narrower above and below its middle."""
    wide = lay_out(text, h).width + 2.0 * PAD * h
    if kind == "decision":
        return wide / (1.0 - 2.0 * PAD / RHOMBUS)
    return wide + {"data": LEAN, "terminator": TALL / 2.0}.get(kind, 0.0) * h


def _block(canvas: Canvas, name: str, text: str, place: tuple[complex, float], h: float) -> None:
    """Draw a block about its middle, as wide, as GOST 19.701 has it: terminator, data, decision or process."""
    (at, wide), up, lean, kind = place, _half(name, h), 0.5 * LEAN * h, KINDS.get(name, "")
    half = 0.5 * wide
    if kind == "terminator":
        straight = complex(half - up, 0.0)
        sides = (Line(at + i - straight, at + i + straight, Pen.THIN) for i in (1j * up, -1j * up))
        ends = ((at + straight, -0.5 * HALF_TURN), (at - straight, 0.5 * HALF_TURN))
        canvas.group("block", name, *sides, *(Arc(end, up, turn, HALF_TURN, Pen.THIN) for end, turn in ends))
    else:
        corners = {
            "": ((-half, -up), (half, -up), (half, up), (-half, up)),
            "data": ((-half - lean, -up), (half - lean, -up), (half + lean, up), (lean - half, up)),
            "decision": ((-half, 0.0), (0.0, -up), (half, 0.0), (0.0, up)),
        }[kind]
        outline = tuple(at + complex(*corner) for corner in corners)
        canvas.group("block", name, Polyline(outline, Pen.THIN, closed=True))
    canvas.add(Text(at - 0.5j * h, text, h, "middle", role="block"))


def _ways(canvas: Canvas, scene: HoistScene, levels: dict[str, float], wide: float, ok: bool) -> None:
    """Draw the ways from block to block; what is taken is thick, all else thin."""
    h = scene.style.text
    for before, after in pairwise(levels):
        if before != "larger":
            ends = 1j * (levels[before] - _half(before, h)), 1j * (levels[after] + _half(after, h))
            _way(canvas, ends, before != "strong" or ok, f"{before}-{after}")
    below = levels["strong"] - _half("strong", h) - 1.3 * h
    canvas.add(Text(complex(0.7 * h, below), scene.words["hoist.yes"], h, role="answer"))


def _choice(
    canvas: Canvas,
    scene: HoistScene,
    levels: dict[str, float],
    texts: Mapping[str, str],
    widths: tuple[float, float],
    resting: bool,
) -> float:
    """Draw both ways out of the question which force is the larger, with what each takes, until they meet.

    The `widths` are those of the question and of the boxes that follow; returned is how far they reach to the left.
    """
    words, h, (wide, narrow) = scene.words, scene.style.text, widths
    level, low, up = levels["larger"], levels["stress"] + _half("stress", h), 0.5 * TALL * h
    corner, beside = 0.5 * wide, 0.5 * wide + ASIDE * h
    answers = {-1: words["hoist.yes"], 1: words["hoist.no"]}
    beside = max(beside, 0.5 * narrow + 0.5 * GAP * h)
    middle = level - _half("larger", h) - GAP * h - up
    for (name, text), side, taken in zip(texts.items(), answers, (resting, not resting), strict=True):
        at = complex(side * beside, middle)
        _block(canvas, name, text, (at, narrow), h)
        first = complex(side * corner, level), complex(side * beside, level), at + 1j * up
        _way(canvas, first, taken, f"larger-{name}")
        joint = complex(at.real, low + (GAP + 0.5 * JOINED) * h)
        _way(canvas, (at - 1j * up, joint, joint - at.real, 1j * low), taken, f"{name}-stress")
        place = complex(side * (corner + 0.3 * h), level + 0.5 * h)
        canvas.add(Text(place, answers[side], h, "left" if side > 0 else "right", role="answer"))
    return -beside - 0.5 * narrow


def _back(canvas: Canvas, scene: HoistScene, levels: dict[str, float], wide: float, left: float, taken: bool) -> None:
    """Draw the way back from the question of strength to other places of load and drum."""
    h, strong, places = scene.style.text, levels["strong"], levels["places"]
    corners = (-0.5 * wide, strong), (left, strong), (left, places), (-0.5 * wide, places)
    _way(canvas, [complex(*corner) for corner in corners], taken, "strong-places")
    at = complex(-0.5 * wide - 0.3 * h, strong + 0.5 * h)
    canvas.add(Text(at, scene.words["hoist.no"], h, "right", role="answer"))


def _way(canvas: Canvas, places: Sequence[complex], taken: bool, name: str) -> None:
    """Draw a way; its line ends inside of the arrowhead, lest it blunt the tip."""
    *_, before, end = places
    inside = end - unit(end - before) * (0.6 * canvas.style.arrow)
    line = Polyline((*places[:-1], inside), Pen.MAIN if taken else Pen.THIN)
    canvas.add(Group((line,), "taken" if taken else "way", name), Head(end, end - before))
