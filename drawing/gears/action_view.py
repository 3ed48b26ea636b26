"""The line of action straightened: its active part, how many pairs touch where, radii of curvature at its ends."""

from __future__ import annotations

from dataclasses import replace

from ...plans.gears.course import zones
from ..dimensions import linear
from ..figure import ANSWERS, Figure, stages
from ..printed import DEGREES, Input, calculation
from ..shapes import Group, Line, Pen, Polyline, Text
from ..text import lay_out
from ..view import Canvas, View
from ..words import indexed
from .scene import GearScene

LEVEL = 2.2  # heights of letters for each pair that touches
ROW = 1.8  # heights of letters between dimension lines
FIRST = 3.0  # heights of letters from the line to the first of them
# in which points of the line are marked; all others with the pitches
STAGE = {"P": "pole", "N1": "line_of_action", "N2": "line_of_action", "A1": "active_line", "A2": "active_line"}


def action_view(overall: GearScene) -> View:
    """Draw N1N2 along the abscissa, N1 on the left."""
    scene = replace(overall, mu_l=overall.rolled)
    canvas = FIGURE.canvas(scene, coarse=0.0)
    canvas.part(ANSWERS)
    _zones(canvas, scene)
    _line(canvas, scene)
    canvas.part(ANSWERS)
    _dimensions(canvas, scene)
    heading = scene.words["heading.gear_action"], scene.factor(scene.mu_l)
    return canvas.finish(
        "action", heading, (*ratios(scene), *scene.words["said.gear_zones"].split("|"), *_lacking(scene))
    )


def _lacking(scene: GearScene) -> tuple[str, ...]:
    """Say how long the flanks touch, and the contact ratio of that, where undercut or pointed teeth lack a part."""
    words = scene.words
    first, last = scene.touching
    if not scene.lacking:
        return ()
    parts = [Input(length * 1e3) for length in (last - first, scene.size("p_b"))]
    (length, pitch), result = calculation(words, lambda x, y: x / y, parts)
    mm = words.unit("mm")
    ratio = f"{words.symbol('epsilon_flanks')} = {length} {mm}/{pitch} {mm} = {result}"
    return words["said.gear_lacking"].format(length=scene.length(last - first)), ratio


def ratios(scene: GearScene) -> tuple[str, ...]:
    """Return the contact ratio by the active line and by the angles of action, printed so that it recomputes."""
    words = scene.words
    epsilon = words.symbol("epsilon_alpha")
    found = []
    ways = [("g_alpha", "p_b", 1e3, words.unit("mm"))]
    ways += [(f"phi_alpha{i}", f"tau_{i}", DEGREES, "°") for i in (1, 2)]
    for over, under, times, unit in ways:
        inputs = [Input(scene.size(name) * times) for name in (over, under)]
        (a, b), result = calculation(words, lambda x, y: x / y, inputs)
        gap = "" if unit == "°" else " "
        ratio = f"{words.symbol(over)}/{words.symbol(under)} = {a}{gap}{unit}/{b}{gap}{unit}"
        found.append(f"{epsilon} = {ratio} = {result}")
    return tuple(found)


def _zones(canvas: Canvas, scene: GearScene) -> None:
    """Draw over each part as many steps as pairs touch, with their number."""
    label = scene.style.label
    for k, zone in enumerate(zones(scene.solved)):
        a, b, count = scene.drawn(zone.first), scene.drawn(zone.last), zone.pairs
        top = LEVEL * label * count
        corners = complex(a, 0.0), complex(a, top), complex(b, top), complex(b, 0.0)
        canvas.add(Group((Polyline(corners, Pen.THIN),), "zone", f"{k + 1}_{count}"))
        narrow = b - a < lay_out(str(count), label).width + 2.0
        middle = complex(0.5 * (a + b), top + 0.4 * label if narrow else top - 0.5 * (LEVEL + 1.0) * label)
        canvas.add(Text(middle, str(count), label, "middle", role="zone", name=str(k + 1)))


def _line(canvas: Canvas, scene: GearScene) -> None:
    """Draw the line with its points."""
    style, line = scene.style, scene.paper("l_N1N2")
    ends = {"A1": scene.paper("rho_p1"), "P": scene.paper("rho_w1"), "A2": scene.paper("rho_a1")}
    low, high = min(0.0, *ends.values()), max(line, *ends.values())
    canvas.part("line_of_action")
    canvas.add(Line(complex(low, 0.0), complex(high, 0.0), Pen.THIN, role="line-of-action", name="N1N2"))
    canvas.part("active_line")
    first, last = map(scene.drawn, scene.touching) if scene.lacking else (ends["A1"], ends["A2"])
    canvas.add(Line(complex(first, 0.0), complex(last, 0.0), Pen.MAIN, role="active", name="A1A2"))
    pitch = scene.paper("p_b")
    ends |= {"N1": 0.0, "N2": line, "K1": ends["A1"] + pitch, "K2": ends["A2"] - pitch}
    for i, x in ((1, scene.paper("rho_l1")), (2, line - scene.paper("rho_l2"))):
        if 0.0 < x < line:
            ends[f"H{i}"] = x
    for name, x in ends.items():
        canvas.part(STAGE.get(name, "pitches"))
        canvas.add(scene.node(complex(x, 0.0), name, "point"))
        canvas.label(indexed(name), complex(x, 0.0), prefer=-1j, clear=style.node + 0.8)


def _dimensions(canvas: Canvas, scene: GearScene) -> None:
    """Dimension the active line, the base pitch from both its ends, radii of curvature, row by row below the line."""
    names = ("rho_p1", "rho_a1", "l_N1N2", "p_b", "rho_l1", "rho_l2")
    first, last, line, pitch, low_1, low_2 = map(scene.paper, names)
    rows = [
        [("rho_l1", 0.0, low_1, "rho_l1"), ("rho_l2", line - low_2, line, "rho_l2")],
        [("rho_p1", 0.0, first, "rho_p1"), ("rho_p2", last, line, "rho_p2")],
        [("p_b_1", first, first + pitch, "p_b")],
        [("p_b_2", last - pitch, last, "p_b")],
        [("g_alpha", first, last, "g_alpha")],
        [("l_N1N2", 0.0, line, "l_N1N2")],
    ]
    y = -FIRST * scene.style.label
    for row in rows:
        shown = [one for one in row if one[2] - one[1] > 0.0]
        for name, low, high, quantity in shown:
            ends = complex(low, 0.0), complex(high, 0.0)
            linear(canvas, ends, 1j * y, "", name)
            at = ends[0] + 1j * y, ends[1] + 1j * y
            canvas.label(scene.stated(quantity), at, prefer=1j, clear=0.8, height=scene.style.text)
        y -= ROW * scene.style.label * bool(shown)


FIGURE = Figure(
    "action", action_view, ("rolled",), stages("pole", "line_of_action", "active_line", "pitches"), "gear.action"
)
