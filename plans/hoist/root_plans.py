"""The equations (11) and (12) solved by drawing: where two curves cross, joined from section line to section line.

On `lift_off` points `Y0` .. lie on the parabola y - m g / C, `O0` .. on the sinusoid osc; `X` is where their chords
cross, and its abscissa is the time of the lift-off as it is drawn. On `extremes` points `W0` .. lie on the sinusoid
V cos k t + (a/k) sin k t, the straight line -(C_01/C_12) (V + a t) runs from `L0` to `L1`; `X1` .. are their crossings,
at which the force of the rope is greatest and least in turn. Abscissas have the scale factor mu_t1, ordinates mu_y and
mu_v; where the load swings too often before the lift-off only the last swings are drawn.
"""

from __future__ import annotations

from collections.abc import Iterable

from ..board import Board
from ..names import Name, role
from .diagram_plan import line, part, point
from .hoist import DRAWN
from .model import HORIZONTAL

LIFT_OFF, EXTREMES = "lift_off", "extremes"


def lift_off_plan(board: Board, sections: int, crossed: int) -> None:
    """Draw parabola and sinusoid of (11); they cross in the section after the line `crossed`."""
    for i in range(sections + 1):
        board.calc(seen(i), "product", "_section", part(i, 1))
        lift_off_points(board, i)
    for curve in "YO":
        chord(board, LIFT_OFF, curve, crossed)
    board.meet(f"{LIFT_OFF}.X", *_on(LIFT_OFF, "Y", crossed), *_on(LIFT_OFF, "O", crossed))
    read_time(board, drawn("t_1"), LIFT_OFF, "X")


def drawn(name: str) -> Name:
    """Return the name of a quantity as a drawing gives it."""
    return Name(f"{name}_{DRAWN}", role(name).kind, role(name).of, part=DRAWN)


def seen(i: int | str) -> str:
    """Return the name of the time of a section line, counted from the first one."""
    return f"_t_{i}_{LIFT_OFF}_seen"


def lift_off_points(board: Board, i: int | str) -> None:
    """Mark parabola and sinusoid on the line `i`, or on any of its own time."""
    time = f"_t_{i}_{LIFT_OFF}"
    board.calc(time, "later", "_begin", seen(i))
    abscissa = line(board, LIFT_OFF, f"f{i}", seen(i), "mu_t1")
    board.calc(f"_y_{i}", "wound", "V_t", "a", time)
    board.calc(f"_parabola{i}", "excess", f"_y_{i}", "_height")
    board.calc(f"_sinusoid{i}", "oscillation", "V_t", "a", "k", time)
    point(board, LIFT_OFF, f"Y{i}", abscissa, f"_parabola{i}", "mu_y")
    point(board, LIFT_OFF, f"O{i}", abscissa, f"_sinusoid{i}", "mu_y")


def extremes_plan(board: Board, sections: int, crossed: Iterable[int]) -> None:
    """Draw sinusoid and straight line of (12), which cross in the sections after the lines `crossed`."""
    for i in range(sections + 1):
        extremes_point(board, i)
    for k, i in enumerate((0, sections)):
        board.calc(f"_winding{k}", "winding_speed", "V_t", "a", f"_t_{i}_{LIFT_OFF}")
        board.calc(f"_share{k}", "product", "_ratio", f"_winding{k}")
        board.calc(f"_line{k}", "opposite", f"_share{k}")
        point(board, EXTREMES, f"L{k}", f"_abscissa_{EXTREMES}_f{i}", f"_line{k}", "mu_v")
    chord(board, EXTREMES, "L", 0)
    for n, i in enumerate(crossed, 1):
        chord(board, EXTREMES, "W", i)
        board.meet(f"{EXTREMES}.X{n}", *_on(EXTREMES, "W", i), *_on(EXTREMES, "L", 0))
        board.calc(f"t_2_{n}", "given", f"_t_2_{n}_exact")
        read_time(board, drawn(f"t_2_{n}"), EXTREMES, f"X{n}")


def extremes_point(board: Board, i: int | str) -> None:
    """Mark the sinusoid of (12) on the line `i`, or on any of its own time, when (11) is drawn there."""
    abscissa = line(board, EXTREMES, f"f{i}", seen(i), "mu_t1")
    board.calc(f"_wave{i}", "oscillation_rate", "V_t", "a", "k", f"_t_{i}_{LIFT_OFF}")
    point(board, EXTREMES, f"W{i}", abscissa, f"_wave{i}", "mu_v")


def chord(board: Board, plan: str, curve: str, i: int) -> None:
    """Join the points of a curve on the section line `i` and the next one."""
    ends = f"{plan}.{curve}{i}", f"{plan}.{curve}{i + 1}"
    board.measure(f"_{plan}_{curve}{i}_length", *ends)
    board.direction(f"_{plan}_{curve}{i}", *ends, f"_{plan}_{curve}{i}_length")


def _on(plan: str, curve: str, i: int) -> tuple[str, str]:
    """Return a point of a chord, and its direction."""
    return f"{plan}.{curve}{i}", f"_{plan}_{curve}{i}"


def read_time(board: Board, name: str, plan: str, mark: str) -> None:
    """Read the abscissa of a mark as a time, beginning with that of the first section line."""
    board.read(f"_{name}_segment", f"{plan}.f0", f"{plan}.{mark}")
    board.calc(f"_{name}_length", "component", f"_{name}_segment", HORIZONTAL)
    board.calc(f"_{name}_seen", "product", f"_{name}_length", "mu_t1")
    board.calc(name, "later", "_begin", f"_{name}_seen")
