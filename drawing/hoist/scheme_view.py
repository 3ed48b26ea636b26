"""The hoist drawn: its scheme and dynamic model, its beams as they bend, and the flow chart of its calculation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from ...plans.hoist.construction import BENT, FORCE, LETTERS, SCHEME, SECTIONS
from ...plans.hoist.forces import STRENGTH
from ...plans.hoist.solve import OF_BEAM, bent
from ..figure import Figure, stages
from ..page import Layer
from ..shapes import Arrow, Circle, Group, Head, Line, Pen, Polyline, Text
from ..symbols import COILS, coils, fixed_pivot, hatching, revolute, unit
from ..text import lay_out
from ..view import Canvas, View, linear
from .scene import HoistScene

LOAD = 0.45  # of the rope's length, the height of the load at most
BOX = 12.0  # mm, the load's height at most
DRUM = 3.0  # mm, radius
SPRING, HALF = 26.0, 4.0  # mm: length of a spring, half its width
MASS = 11.0, 13.0  # mm: half the width and the height of the mass
LEG = 4.0  # mm, straight ends of a spring
ARROW = 13.0  # mm, an arrow
STAGE_OF_BEAM = {"0": "support", "2": "bridge"}  # stages
APART = 14.0  # mm between the beams
SAME = 0.5  # mm
STEP = 5.4  # heights of letters from block to block
TALL = 2.0  # heights of letters of a block
PAD = 1.6
POINTED = 2.4  # heights of other blocks that a diamond has
KINDS = {"begin": "round", "end": "round", "data": "slanted", "places": "slanted"}
KINDS |= {"larger": "diamond", "strong": "diamond"}


def _scheme_view(scene: HoistScene) -> View:
    """Draw the scheme with its dimensions."""
    canvas, words, style = SCHEME_FIGURE.canvas(scene), scene.words, scene.style
    at = {mark: scene.mm(f"{SCHEME}.{mark}") for mark in ("O1", "O2", "A0", "A2", "B1", "B2")}
    rope = abs(at["A2"] - at["A0"])
    canvas.part("support")
    tall = min(BOX, LOAD * rope)
    corners = tuple(at["A0"] + complex(x * 0.8 * tall, y * tall) for x, y in ((-1, 0), (1, 0), (1, 1), (-1, 1)))
    canvas.group("link", "1", Polyline(corners, Pen.MAIN, closed=True, fill="white"))
    canvas.part("rope", Line(at["A0"] + 1j * tall, at["A2"], Pen.MAIN, role="rope", name="L"))
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


def _dimensions(canvas: Canvas, scene: HoistScene, at: dict[str, complex]) -> None:
    """Dimension spans, the places of load and drum from the nearer ends, and the rope."""
    layout, drop = scene.solved.layout, -1j * (scene.style.pivot[1] + 2.0 * scene.style.pair + 8.0)
    step = -1j * 3.2 * scene.style.text
    for i, ends, mark in ((0, ("O1", "O2"), "A0"), (2, ("B1", "B2"), "A2")):
        canvas.part(STAGE_OF_BEAM[str(i)])
        near = ends[0] if layout.near[i // 2] == "left" else ends[1]
        pair = tuple(sorted((at[near], at[mark]), key=lambda p: p.real))
        linear(canvas, (pair[0], pair[1]), drop, scene.stated(f"b_{i}", unit="m"), f"b_{i}")
        linear(canvas, (at[ends[0]], at[ends[1]]), drop + step, scene.stated(f"l_{i}", unit="m"), f"l_{i}")
    canvas.part("rope")
    far = max(at["O2"].real, at["B2"].real) + scene.style.pivot[2]
    linear(canvas, (at["A0"], at["A2"]), complex(far - at["A0"].real), scene.stated("L", unit="m"), "L")


def _rolling_support(at: complex, name: str, scene: HoistScene) -> Group:
    """Return a support that can roll: circle, triangle, rollers on a hatched line."""
    width, height, base = scene.style.pivot
    pivot = fixed_pivot(at, name, scene.style)
    foot = at - 1j * (height + scene.style.pair)
    radius = 0.14 * height
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
    canvas.add(Text(0.5 * (bottom + top) - 0.35j * h, "m", h, "middle", role="label"))
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
    return canvas.finish("model", (words["heading.hoist_model"],))


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
    canvas.label(words["hoist.beam_0" if i == 0 else "hoist.beam_2"], feet[0], prefer=-1.0 + 0j, clear=2.0)
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


BEAMS_FIGURE = Figure("beams", _beams_view, ("part",), stages("axes", "bent", "greatest"), "hoist.beams")


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
    boxes = max(lay_out(f"{s('F_max')} = {s(name)}", h).width for name in ("F_12_max", "P_12_max")) + 1.4 * h
    widest = max(widest, 2.0 * boxes + 4.0 * h)
    order = [*texts]
    beyond = order.index("stress")  # a level more, for the two boxes before it
    levels = {name: -(k + (k >= beyond)) * STEP * h for k, name in enumerate(order)}
    for name, text in texts.items():
        _block(canvas, name, text, (1j * levels[name], widest), h)
    _ways(canvas, scene, levels, widest, found["F_12_max"] > found["P_12_max"], ok)
    return canvas.finish("flow", (words["heading.hoist_flow"],), (words["hoist.taken"],))


def _block(canvas: Canvas, name: str, text: str, place: tuple[complex, float], h: float) -> None:
    """Draw a block about its middle, as wide: rounded, slanted, a diamond or a rectangle, with its text."""
    at, wide = place
    half, up, lean = 0.5 * wide, 0.5 * TALL * h, TALL * h
    kind = KINDS.get(name, "")
    corners = {
        "": ((-half, -up), (half, -up), (half, up), (-half, up)),
        "slanted": ((-half, -up), (half - lean, -up), (half, up), (-half + lean, up)),
        "round": ((-half + up, -up), (half - up, -up), (half, 0.0), (half - up, up), (-half + up, up), (-half, 0.0)),
        "diamond": ((-half - lean, 0.0), (0.0, -POINTED * up), (half + lean, 0.0), (0.0, POINTED * up)),
    }[kind]
    outline = tuple(at + complex(*corner) for corner in corners)
    canvas.group("block", name, Polyline(outline, Pen.MAIN, closed=True, fill="white"))
    canvas.add(Text(at - 0.5j * h, text, h, "middle", role="block"))


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
    strong, places = levels["strong"], levels["places"]
    corners = (-corner, strong), (left, strong), (left, places), (-0.5 * wide + TALL * h * 0.5, places)
    back = [complex(*at) for at in corners]
    _way(canvas, back, not ok, "strong-places")
    canvas.add(Text(complex(left + 0.4 * h, strong + 0.4 * h), words["hoist.no"], h, role="answer"))
    below = strong - POINTED * up - 1.4 * h
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
        _block(canvas, name, text, (at, 2.0 * half), h)
        first = complex(side * corner, level), complex(side * corner, middle), at + side * half
        _way(canvas, first, taken, f"larger-{name}")
        joint = complex(at.real, low + up + 1.6 * h)
        _way(canvas, (at - 1j * up, joint, complex(0.0, joint.imag), 1j * (low + up)), taken, f"{name}-stress")
        beside = complex(side * (corner - 0.4 * h), level - 2.2 * h)
        canvas.add(Text(beside, answers[side < 0], h, "right" if side > 0 else "left", role="answer"))


def _way(canvas: Canvas, places: Sequence[complex], taken: bool, name: str) -> None:
    line = Polyline(tuple(places), Pen.MAIN if taken else Pen.THIN)
    canvas.add(Group((line,), "taken" if taken else "way", name), Head(places[-1], places[-1] - places[-2]))
