"""A toy subject: all boards run its construction, its laws print themselves, and it needs few modules."""

from __future__ import annotations

import ast
import math
from pathlib import Path

import numpy as np
import pytest

from kulman.drawing.printed import Symbol
from kulman.drawing.words import Words
from kulman.plans.boards.batch import batch, script_of, values_of
from kulman.plans.boards.exact import run
from kulman.plans.laws import LAWS, define, form_of
from kulman.plans.quantities import quantities, shown_on
from kulman.tests.boards.test_names import ROOT, agree
from kulman.tests.support import screw_jack
from kulman.tests.support.screw_jack import LAWS_OF_JACK, jack

pytestmark = pytest.mark.usefixtures("laws")
GIVENS = {"d": 0.036, "p": 0.006, "F": 2.5e4, "omega": 3.0, "rho": math.radians(6.0)}
LAYERS = ("scales", "plans", "drawing", "variants")


@pytest.fixture(name="laws")
def laws_of_jack():
    """Add the laws of the jack to the table, as a subject does when it is imported; take them out again."""
    define(**LAWS_OF_JACK)
    yield
    for law in LAWS_OF_JACK:
        del LAWS[law]


def test_jack_lifts_as_books_say():
    found = quantities(jack(), run(jack(), GIVENS).values, {})

    slope = math.atan2(GIVENS["p"], math.pi * GIVENS["d"])
    assert found["M_1"].value == pytest.approx(0.5 * GIVENS["F"] * GIVENS["d"] * math.tan(slope + GIVENS["rho"]))
    assert found["V_C"].y == pytest.approx(GIVENS["omega"] * GIVENS["p"] / (2.0 * math.pi))
    assert found["R_01"].y == pytest.approx(GIVENS["F"])
    assert {name: found[name].unit for name in ("M_1", "V_C", "R_01", "omega_1", "l_02")} == {
        "M_1": "N*m", "V_C": "m/s", "R_01": "N", "omega_1": "rad/s", "l_02": "m",
    }  # fmt: skip


def test_jack_runs_on_the_boards_of_all_subjects():
    program, wanted = jack(), ("M_1", "V_S", "R_01")
    loads = np.linspace(1e3, 5e4, 7)

    many, codes = batch(program, {**GIVENS, "F": loads}, wanted)

    assert not codes.any()
    for place, load in enumerate(loads.tolist()):
        alone = run(program, {**GIVENS, "F": load})
        assert [many[name][()] if np.ndim(many[name]) == 0 else many[name][place] for name in wanted] == [
            alone.values[name] for name in wanted
        ]
        assert values_of(program, {**GIVENS, "F": load})[0] == {name: alone.values[name] for name in program.names}
    assert "function solve" in script_of(program, GIVENS, wanted)


def test_names_of_the_jack_carry_their_roles():
    program, words = jack(), Words.of("en", "artobolevsky")

    agree(program)

    assert program.plans == ("position", "thread", "velocity", "forces_1")
    assert [step.name for step in program.which(("read",), plan="forces")] == ["F_Q", "R_01"]
    assert shown_on(program)["V_C"] == "velocity"
    assert words.symbol("V_C", bar=True) == "\\bar{v}_{C}"
    assert [words.mark(name) for name in ("velocity.S", "forces_1.1")] == ["s", "a"]


def test_laws_of_the_jack_print_themselves():
    assert str(form_of("thread_circumference")(Symbol.of("d"))) == "π·d"
    assert str(form_of("thread_moment")(Symbol.of("F"), Symbol.of("r"))) == "F·r"


def test_jack_needs_three_modules_and_changes_none():
    source = ast.parse(Path(screw_jack.__file__).read_text(encoding="utf-8"))
    imported = {node.module for node in ast.walk(source) if isinstance(node, ast.ImportFrom) and node.module}
    package = [path for layer in LAYERS for path in (ROOT / layer).rglob("*.py")]

    assert {name for name in imported if name.startswith("kulman")} == {
        "kulman.plans.board", "kulman.plans.laws", "kulman.plans.names",
    }  # fmt: skip
    assert [path for path in package if "jack" in path.read_text(encoding="utf-8")] == []
