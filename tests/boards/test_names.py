"""Names carry their roles: they agree with their letters everywhere, and no code takes a name apart."""

from __future__ import annotations

import ast
import math
import pickle
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from kulman import solve
from kulman.drawing.printed import Symbol
from kulman.drawing.words import Words
from kulman.plans.board import POSITION, Program, RecordingBoard
from kulman.plans.boards.batch import batch, script_of
from kulman.plans.boards.exact import run
from kulman.plans.laws import LAWS, define, form_of
from kulman.plans.linkages.chain import PLANS, construct
from kulman.plans.names import CORIOLIS, NORMAL, Name, mark, role, spelled, vector
from kulman.plans.quantities import quantities, shown_on
from kulman.tests.support import screw_jack
from kulman.tests.support.cases import some
from kulman.tests.support.dyads import KINDS, random_dyads, random_triads
from kulman.tests.support.screw_jack import LAWS_OF_JACK, jack
from kulman.tests.support.sources import trees
from kulman.variants.shelf import bundled

ROOT = Path(__file__).parents[2]
MOST = 4  # places that take a name apart
APART = {"startswith", "endswith", "partition", "rpartition", "removeprefix", "removesuffix", "split", "rsplit"}
APART |= {"lstrip", "rstrip", "strip", "isdigit"}
NAMES = {"name", "names", "plan", "mark", "symbol", "quantity", "direction", "operand", "operands", "force", "point"}
# What users write, files and tables of text are taken apart by modules that do nothing else.
READERS = (
    "drawing/formats.py", "drawing/titleblock.py", "drawing/writers.py", "variants/case.py", "variants/checks/",
    "variants/commands/", "variants/drawings/", "variants/making/", "variants/marking/", "variants/reader.py",
    "variants/roster.py", "variants/shelf.py", "variants/spreadsheets/", "variants/task.py",
)  # fmt: skip


def of_name(receiver: ast.expr) -> bool:
    """Whether an expression is a name of a step, an operand of one, or a part of such."""
    match receiver:
        case ast.Name(id=word) | ast.Attribute(attr=word):
            return word in NAMES
        case ast.Subscript(value=value) | ast.Call(func=ast.Attribute(value=value)):
            return of_name(value)
    return False


def taken_apart(tree: ast.AST) -> Iterator[int]:
    """Go through the lines of a module that take a name apart: by a method of strings, or by a slice."""
    for node in ast.walk(tree):
        match node:
            case ast.Call(func=ast.Attribute(attr=attr, value=value)) if attr in APART and of_name(value):
                yield node.lineno
            case ast.Subscript(value=value, slice=ast.Slice()) if of_name(value) and not whole(value):
                yield node.lineno


def whole(value: ast.expr) -> bool:
    """Whether a list of names is meant."""
    return isinstance(value, ast.Name | ast.Attribute) and ast.unparse(value).endswith(("names", "operands"))


def test_names_are_taken_apart_in_few_places() -> None:
    found = [
        f"{path}:{line}"
        for path, tree in trees().items()
        if path.parts[0] in ("plans", "drawing", "variants") and not str(path).startswith(READERS)
        for line in taken_apart(tree)
    ]
    assert len(found) <= MOST, found


@pytest.mark.parametrize(
    ("source", "count"),
    [
        ('step.name.startswith("V_")', 1),
        ('mark.rpartition(".")[2]', 1),
        ("name[-2:-1].isdigit()", 2),
        ('"e_" + step.operands[1][2:]', 1),
        ('plan.partition("_")[0].lstrip("_")', 2),
        ('text.split(","), words["said"].split("|"), "a b".split()', 0),
        ("values[0], name.plan, step.operands[1:], names[:3]", 0),
    ],
)
def test_count_sees_names_and_passes_texts_over(source: str, count: int) -> None:
    assert len(list(taken_apart(ast.parse(source)))) == count


def agree(program: Program) -> None:
    """Check that all names of a program have roles that say what their letters say."""
    made: dict[str, str] = {}
    by_role, by_letters = (Words.of("en", "artobolevsky") for _ in range(2))
    for step in program:
        for name in (step.name, *step.operands):
            assert isinstance(name, Name), name
            assert name.hidden == (name[:1] == "_"), name
            assert name.plan == (name.rpartition(".")[0] or POSITION), name
            assert made.setdefault(name, name.kind) == name.kind, f"{name} is of two kinds"
        if step.verb in ("read", "calc", "arm") and not step.name.hidden:
            name = step.name
            assert name.startswith(f"{name.kind}_"), name
            numbered = any(map(str.isdigit, name))  # a sum of couples on one link, M_sum, needs no number
            assert not numbered or all(str(number) in name for number in name.links), name
            assert by_role.symbol(name) == by_letters.symbol(str(name)), name


@pytest.mark.parametrize("task", some(bundled("mechanism"), *range(0, 99, 3)))
def test_role_and_name_agree_on_linkages(task: str) -> None:
    program = solve(task).solved.program

    agree(program)
    plans = dict.fromkeys(role(plan).kind for plan in program.plans)
    assert set(plans) <= {"position", "velocity", "acceleration", "forces", "lever", "V_at", "a_at"}


@pytest.mark.parametrize("kind", [*KINDS, "III"])
def test_role_and_name_agree_on_random_mechanisms(kind: str) -> None:
    carries = {"RPP": (False, False), "PRP": (False, True)}.get(kind, (True,))
    triad = kind == "III"
    mechanism, *_ = random_triads("RRP", (1, 2, 3), 1, 1) if triad else random_dyads(kind, (2, 3), carries, 1, 1)

    _, program = construct(mechanism, tuple(plan for plan in PLANS if plan != "cycle"))

    agree(program)
    letters = {point for link in mechanism.links for point in link.points}
    for step in program:
        if step.verb == "read" and not step.name.hidden and step.name.kind in ("V", "a"):
            of = role(step.name.of)
            assert of in letters or of.links or of[:1] == "X", step.name
            assert step.name.about in ("", *letters) or role(step.name.about).links or step.name.about[:1] == "X"


def test_name_is_made_once_and_keeps_its_role_where_it_is_needed() -> None:
    board = RecordingBoard()
    board.pole("acceleration.p")
    board.calc(vector("a", "B", "A", "n").size, "given", "a_0")
    board.back(mark("acceleration", "B", NORMAL, "A"), "acceleration.p", "e_AB", "_a_BA_n")
    board.read("a_B", "acceleration.p", "acceleration.n_BA")

    _, back, read = board.steps[1:]

    assert (back.operands[2].of, back.operands[2].about, back.operands[2].part) == ("B", "A", "n")
    assert read.operands[1].kind == NORMAL
    assert back.operands[2].shown == "a_BA_n"


def test_name_is_a_plain_string_for_others() -> None:
    name = vector("a", "B", "A", CORIOLIS)

    again = pickle.loads(pickle.dumps(name))

    assert (again, again.kind, again.of, again.about, again.part) == ("a_BA_k", "a", "B", "A", "k")
    assert hash(name) == hash("a_BA_k")
    assert {name: 1}["a_BA_k"] == 1
    assert spelled("forces", 23).plan is POSITION


# A toy subject: all boards run its construction, its laws print themselves, and it needs few modules.
GIVENS = {"d": 0.036, "p": 0.006, "F": 2.5e4, "omega": 3.0, "rho": math.radians(6.0)}


@pytest.fixture(name="laws")
def laws_of_jack() -> Iterator[None]:
    """Add the laws of the jack to the table, as a subject does when it is imported; take them out again."""
    define(**LAWS_OF_JACK)
    yield
    for law in LAWS_OF_JACK:
        del LAWS[law]


@pytest.mark.usefixtures("laws")
def test_jack_lifts_as_books_say() -> None:
    found = quantities(jack(), run(jack(), GIVENS).values, {})

    slope = math.atan2(GIVENS["p"], math.pi * GIVENS["d"])
    assert found["M_1"].value == pytest.approx(0.5 * GIVENS["F"] * GIVENS["d"] * math.tan(slope + GIVENS["rho"]))
    assert found["V_C"].y == pytest.approx(GIVENS["omega"] * GIVENS["p"] / (2.0 * math.pi))
    assert found["R_01"].y == pytest.approx(GIVENS["F"])
    assert {name: found[name].unit for name in ("M_1", "V_C", "R_01", "omega_1", "l_02")} == {
        "M_1": "N*m", "V_C": "m/s", "R_01": "N", "omega_1": "rad/s", "l_02": "m",
    }  # fmt: skip


@pytest.mark.usefixtures("laws")
def test_jack_runs_on_the_boards_of_all_subjects() -> None:
    program, wanted = jack(), ("M_1", "V_S", "R_01")
    loads = np.linspace(1e3, 5e4, 7)

    many, codes = batch(program, {**GIVENS, "F": loads}, wanted)

    assert not codes.any()
    for place, load in enumerate(loads.tolist()):
        alone = run(program, {**GIVENS, "F": load})
        assert [many[name][()] if np.ndim(many[name]) == 0 else many[name][place] for name in wanted] == [
            alone.values[name] for name in wanted
        ]
    assert "function solve" in script_of(program, GIVENS, wanted)


@pytest.mark.usefixtures("laws")
def test_names_of_the_jack_carry_their_roles_and_its_laws_print_themselves() -> None:
    program, words = jack(), Words.of("en", "artobolevsky")

    agree(program)

    assert program.plans == ("position", "thread", "velocity", "forces_1")
    assert [step.name for step in program.which(("read",), plan="forces")] == ["F_Q", "R_01"]
    assert shown_on(program)["V_C"] == "velocity"
    assert words.symbol("V_C", bar=True) == "\\bar{v}_{C}"
    assert [words.mark(name) for name in ("velocity.S", "forces_1.1")] == ["s", "a"]
    assert str(form_of("thread_circumference")(Symbol.of("d"))) == "π·d"
    assert str(form_of("thread_moment")(Symbol.of("F"), Symbol.of("r"))) == "F·r"


def test_jack_needs_three_modules_and_changes_none() -> None:
    source = ast.parse(Path(screw_jack.__file__).read_text(encoding="utf-8"))
    imported = {node.module for node in ast.walk(source) if isinstance(node, ast.ImportFrom) and node.module}
    package = [path for layer in ("scales", "plans", "drawing", "variants") for path in (ROOT / layer).rglob("*.py")]

    assert {name for name in imported if name.startswith("kulman")} == {
        "kulman.plans.board", "kulman.plans.laws", "kulman.plans.names",
    }  # fmt: skip
    assert [path for path in package if "jack" in path.read_text(encoding="utf-8")] == []
