"""What is drawn of a gear pair when only the first steps have been done: a blank has givens, headings, heads of tables.

The order is that in which the meshing is drawn: rolling circles, line of action, circles, active line, teeth, what is
read off them.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...plans.gears.gear import SHIFTS, WHEELS
from ...plans.gears.geometry import POINTS
from ...plans.gears.meshing_plan import MOST
from ..handouts.begun import Shown
from .scene import GearScene
from .tables import OF_WHEELS, PAIR, named

Stage = tuple[tuple[str, ...], tuple[str, ...]]  # names of what is drawn, and letters


def _both(*names: str) -> tuple[str, ...]:
    """Return names of either wheel, `#` being its number."""
    return tuple(name.replace("#", str(i)) for name in names for i in WHEELS)


MESHING: tuple[Stage, ...] = (
    (("O1O2", "P"), ("P", *_both("O_{#}"))),
    (("t", *_both("d_w#")), ("t",)),
    (("N1N2", *_both("d_b#", "N#")), _both("N_{#}")),
    (_both("d_#", "d_a#", "d_f#"), ()),
    (("A1A2", *_both("A#")), _both("A_{#}")),
    (_both("wheel:#"), ()),
    (_both("L#", "flank_#"), _both("L_{#}")),
    (("position:start", "position:end", *_both("K#")), _both("K_{#}")),
)
PARTS = tuple(str(k) for k in range(MOST + 1))
ROLLING: tuple[Stage, ...] = (
    (("P",), ("P",)),
    (("N1N2", *_both("N#", "d_b#")), _both("N_{#}")),
    (tuple(f"D{i}_{k}" for i in WHEELS for k in PARTS), PARTS),
    (tuple(f"T{i}_{k}" for i in WHEELS for k in (*PARTS, "a")), ()),
    (tuple(f"{i}_{k}" for i in WHEELS for k in (*PARTS, "a")), ()),
    ((*(f"E{i}_{k}" for i in WHEELS for k in (*PARTS, "a")), *_both("involute_#", "d_a#")), ()),
)
ACTION: tuple[Stage, ...] = (
    (("P",), ("P",)),
    (("N1N2", *_both("N#")), _both("N_{#}")),
    (("A1A2", *_both("A#")), _both("A_{#}")),
    (_both("K#", "H#"), _both("K_{#}", "H_{#}")),
)
SLIDING: tuple[Stage, ...] = (
    (("N1", "N2", "P"), ("N_{1}", "N_{2}", "P", "V_{k}", "θ", "ρ_{1}")),
    (("W",), ("W",)),
    ((*_both("V_k#"), *(f"ordinate:y_{i}_{point}" for i in WHEELS for point in POINTS)), _both("V_{k#}")),
    (_both("point:A#"), _both("A_{#}")),
    (
        ("theta_12", "theta_21", *(f"node:theta_{pair}_{point}" for pair in ("12", "21") for point in POINTS)),
        ("θ_{12}", "θ_{21}"),
    ),
)
STAGES = {"meshing": MESHING, "near": MESHING, "rolling": ROLLING, "action": ACTION, "sliding": SLIDING}


def begun(scene: GearScene, steps: int) -> dict[str, Shown]:
    """Return for every view what its first steps draw; of tables the rows of what is given."""
    nothing = frozenset[str]()
    found = {name: _drawn(stages[: steps + 1]) for name, stages in STAGES.items()}
    found["contour"] = Shown(nothing, nothing, notes=False)
    for name in ("points", "checks"):
        found[name] = Shown(nothing, nothing, rows=nothing)
    found["data"] = Shown(nothing, nothing, rows=frozenset(_given(scene)), columns=2)
    return found


def _drawn(stages: tuple[Stage, ...]) -> Shown:
    names = frozenset(name for drawn, _ in stages for name in drawn)
    return Shown(names, frozenset(letter for _, letters in stages for letter in letters), notes=False)


def _given(scene: GearScene) -> Iterator[str]:
    """Go through the first cells of the rows of what is given, and of the heads between them."""
    shifts = [name for name in SHIFTS if name in scene.givens]
    yield ""
    for name, kind in (*PAIR, *OF_WHEELS):
        known = name in ("m", "alpha", "h_a", "h_l", "c", "z") or name in shifts
        if known or (name == "x" and shifts[:2] == ["x_1", "x_2"]):
            yield named(scene, name, kind)
