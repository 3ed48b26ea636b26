"""A toy subject: a screw jack of three bodies, the base with its nut (0), the screw (1), the cap with the load (2).

A subject is a construction of steps on names that carry their roles, with laws of its own. What this one imports is
all that a construction needs.

Source: any book on machine elements: M = F d/2 tan(lambda + rho) lifts the load, the screw rises by p in a turn.
"""

from __future__ import annotations

import math

from kulman.plans.board import Board, Program, RecordingBoard
from kulman.plans.laws import Law
from kulman.plans.names import Name, between, mark, pole, rate, spelled, vector

DIRECTIONS = ("_right", "_up")  # directions of the drawing

LAWS_OF_JACK: dict[str, Law] = {
    "thread_circumference": lambda d: math.pi * d,
    "thread_radius": lambda d: 0.5 * d,
    "thread_moment": lambda force, radius: force * radius,
}


def thread(board: Board) -> None:
    """Unroll a turn of the thread: the circumference across, the pitch up; its line is the slant."""
    right, up = DIRECTIONS
    board.turn(right, "zero")
    board.normal(up, right)
    board.calc("_circumference", "thread_circumference", "d")
    board.pole(mark("thread", "0"))
    board.lay(mark("thread", "1"), mark("thread", "0"), right, "_circumference")
    board.lay(mark("thread", "2"), mark("thread", "1"), up, "p")
    board.measure(between("l", "0", "2"), mark("thread", "0"), mark("thread", "2"))
    board.direction("e_thread", mark("thread", "0"), mark("thread", "2"), between("l", "0", "2"))
    board.normal("n_thread", "e_thread")


def velocity(board: Board) -> None:
    """v_S lies along the thread; across it has omega d/2, up it lifts the cap: v_C."""
    right, up = DIRECTIONS
    board.calc("_radius", "thread_radius", "d")
    board.calc(rate("omega", 1), "given", "omega")
    board.calc(vector("V", "A").size, "circular_speed", rate("omega", 1), "_radius")
    board.pole(pole("velocity"))
    board.lay(mark("velocity", "A"), pole("velocity"), right, vector("V", "A").size)
    board.read(vector("V", "A"), pole("velocity"), mark("velocity", "A"))
    board.meet(mark("velocity", "S"), mark("velocity", "A"), up, pole("velocity"), "e_thread")
    board.read(vector("V", "S"), pole("velocity"), mark("velocity", "S"))
    board.read(vector("V", "C"), mark("velocity", "A"), mark("velocity", "S"))


def forces(board: Board) -> None:
    """The load, the force across that the handle gives, and R_01, inclined by rho to the normal of the thread."""
    right, up = DIRECTIONS
    plan, reaction, across = spelled("forces", 1), spelled("R", "01", links=(0, 1)), spelled("F", "Q")
    board.turn("_friction", "rho")
    board.incline("_line", "n_thread", "_friction")
    board.pole(f"{plan}.0")
    board.back(f"{plan}.1", f"{plan}.0", up, "F")
    board.meet(f"{plan}.2", f"{plan}.1", right, f"{plan}.0", "_line")
    board.read(across, f"{plan}.1", f"{plan}.2")
    board.read(reaction, f"{plan}.2", f"{plan}.0")
    board.calc(across.size, "component", right, across)
    board.calc(Name("M_1", "M", "1", links=(1,)), "thread_moment", across.size, "_radius")


def jack() -> Program:
    """Return the whole construction."""
    board = RecordingBoard()
    for construction in (thread, velocity, forces):
        construction(board)
    return Program(board.steps)
