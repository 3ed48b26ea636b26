"""Names carry their roles: they agree with their letters everywhere, and no code takes a name apart."""

from __future__ import annotations

import ast
import pickle
from collections.abc import Iterator
from pathlib import Path

import pytest

from kulman import load_task, solve
from kulman.drawing.words import Words
from kulman.plans.board import POSITION, Program, RecordingBoard
from kulman.plans.linkages.chain import PLANS, construct
from kulman.plans.names import CORIOLIS, NORMAL, Name, mark, role, spelled, vector
from kulman.tests.support.dyads import KINDS, random_dyads
from kulman.tests.support.triads import random_triads
from kulman.variants.shelf import bundled

ROOT = Path(__file__).parents[2]
MOST = 11  # places that take a name apart
APART = {"startswith", "endswith", "partition", "rpartition", "removeprefix", "removesuffix", "split", "rsplit"}
APART |= {"lstrip", "rstrip", "strip"}  # `removeprefix` under another name
# What users write, files and tables of text are taken apart by modules that do nothing else.
READERS = (
    "drawing/formats.py", "drawing/titleblock.py", "drawing/writers.py", "variants/case.py", "variants/checks/",
    "variants/commands/", "variants/making/", "variants/marking/calculations.py", "variants/marking/cells.py",
     "variants/marking/reading.py", "variants/reader.py", "variants/roster.py", "scales/names.py",
    "variants/shelf.py", "variants/spreadsheets/", "variants/task.py",
)  # fmt: skip
# Variables that hold a text, a line of a table, a law, a number as it is written; never a name of a step.
TEXTS = {"argument", "colour", "law", "line", "note", "np", "plain", "re", "roles", "said", "sentence", "source"}
TEXTS |= {"string", "suffix", "text"}
NAMES = {"name", "plan", "symbol", "quantity", "direction", "operand"}  # that may be sliced


def texts(receiver: ast.expr) -> bool:
    """Whether an expression is a text by its form, or by the name of the variable."""
    match receiver:
        case ast.Constant() | ast.JoinedStr():
            return True
        case ast.Call(func=ast.Name(id="str" | "seen" | "aligned" | "_written")):
            return True
        case ast.Call(func=ast.Attribute(attr="format" | "line" | "sub" | "replace" | "join" | "decode", value=value)):
            return not isinstance(value, ast.Name) or value.id not in NAMES
        case ast.Call(func=ast.Attribute(attr=attr, value=value)) if attr in APART | {"lower"}:
            return texts(value)
        case ast.Subscript(value=value):
            return ast.unparse(value).endswith(("words", "said", "w", "texts")) or texts(value)
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name in TEXTS or name.isupper()
    return False


def taken_apart(source: str, texts_too: bool = False) -> Iterator[int]:
    """Go through the lines of a module that take a name apart: by a method of strings, or by a slice.

    A module that reads names calls them texts: there all count.
    """
    for node in ast.walk(ast.parse(source)):
        match node:
            case ast.Call(func=ast.Attribute(attr=attr, value=value)) if attr in APART and (
                texts_too or not texts(value)
            ):
                yield node.lineno
            case ast.Subscript(
                value=ast.Name(id=name) | ast.Attribute(attr=name),
                slice=ast.Slice() | ast.Constant(value=int()) | ast.UnaryOp(operand=ast.Constant(value=int())),
            ) if name in NAMES:
                yield node.lineno
            case ast.Subscript(
                value=ast.Subscript(value=ast.Attribute(attr="operands") | ast.Name(id="operands")), slice=ast.Slice()
            ):
                yield node.lineno


def places() -> list[str]:
    """Return where the package takes names apart."""
    files = sorted(path for layer in ("plans", "drawing", "variants") for path in (ROOT / layer).rglob("*.py"))
    found = [(str(path.relative_to(ROOT)), path) for path in files]
    return [
        f"{file}:{line}"
        for file, path in found
        if not file.startswith(READERS)
        for line in taken_apart(path.read_text(encoding="utf-8"), texts_too=file == "plans/names.py")
    ]


def test_names_are_taken_apart_in_few_places():
    found = places()

    assert len(found) <= MOST, found


@pytest.mark.parametrize(
    ("source", "count"),
    [
        ('step.name.startswith("V_")', 1),
        ('mark.rpartition(".")[2]', 1),
        ("name[-2:-1].isdigit()", 1),
        ('"e_" + step.operands[1][2:]', 1),
        ('plan.partition("_")[0].lstrip("_")', 2),
        ('text.split(","), words["said"].split("|"), "a b".split()', 0),
        ("values[0], name.plan", 0),
    ],
)
def test_count_sees_names_and_passes_texts_over(source, count):
    assert len(list(taken_apart(source))) == count


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


@pytest.mark.parametrize("task", bundled("mechanism"))
def test_role_and_name_agree_on_linkages(task):
    solution = solve(task, next(iter(load_task(task).variants)))

    agree(solution.solved.program)
    plans = dict.fromkeys(role(plan).kind for plan in solution.solved.program.plans)
    assert set(plans) <= {"position", "velocity", "acceleration", "forces", "lever", "V_at", "a_at"}


@pytest.mark.parametrize("kind", [*KINDS, "III"])
def test_role_and_name_agree_on_random_mechanisms(kind):
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


def test_name_is_made_once_and_keeps_its_role_where_it_is_needed():
    board = RecordingBoard()
    board.pole("acceleration.p")
    board.calc(vector("a", "B", "A", "n").size, "given", "a_0")
    board.back(mark("acceleration", "B", NORMAL, "A"), "acceleration.p", "e_AB", "_a_BA_n")
    board.read("a_B", "acceleration.p", "acceleration.n_BA")

    _, back, read = board.steps[1:]

    assert (back.operands[2].of, back.operands[2].about, back.operands[2].part) == ("B", "A", "n")
    assert read.operands[1].kind == NORMAL
    assert back.operands[2].shown == "a_BA_n"


def test_name_is_a_plain_string_for_others():
    name = vector("a", "B", "A", CORIOLIS)

    again = pickle.loads(pickle.dumps(name))

    assert (again, again.kind, again.of, again.about, again.part) == ("a_BA_k", "a", "B", "A", "k")
    assert hash(name) == hash("a_BA_k")
    assert {name: 1}["a_BA_k"] == 1
    assert spelled("forces", 23).plan is POSITION
