"""Views of cams, gears and hoists compute nothing that is not a mark: what is drawn there is read off the construction.

Layout remains: letters and frames beside marks, by millimetres that are added to them, by parts of a way between two,
and by directions. So in these folders nothing computes on arrays, no module of trigonometry is imported, no law is
applied, and nothing that is read is multiplied or divided by something else that is read, as a length by a scale
factor. What is laid out about a centre takes `polar`, and an angle between two directions is read by `swept`, as a
protractor reads it: only in the modules of `ROUND`.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

DRAWING = Path(__file__).parents[2] / "drawing"
SUBJECTS = ("hoist", "gears", "cams")
MODULES = {path: path.read_text(encoding="utf-8") for name in SUBJECTS for path in (DRAWING / name).glob("*.py")}
# of the module math what tells finite numbers and rounds them for print
PRINTING = {"ceil", "floor", "inf", "isfinite", "isinf", "isnan", "isclose", "log10", "tau"}
READING = {"mm", "point", "places", "size", "values", "sizes", "mu", "mus", "mu_l", "found", "motion"}
# modules that print, or choose scale factors
TEXTS = {"steps", "text", "sheet"}
TO_PAPER = {"mm", "places", "paper"}  # by which scenes take marks to millimetres
ROUND = {"inversion", "profile_view", "sizes_view", "text"}
PRODUCTS = (ast.Mult, ast.Div, ast.FloorDiv, ast.Mod, ast.Pow, ast.MatMult)


def faults(text: str, module: str = "view") -> list[str]:
    """Return what a module computes, with the lines.

    One that prints may set numbers beside one another, one of what turns may lay out and read angles.
    """
    tree = ast.parse(text)
    functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef) and module not in TEXTS]
    scopes = [function for function in functions if module != "scene" or function.name not in TO_PAPER]
    turns = module in ROUND
    return [*_imported(tree), *_applied(tree, turns), *(fault for scope in scopes for fault in _multiplied(scope))]


def _imported(tree: ast.Module) -> Iterator[str]:
    """Go through imports of what computes."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names = {alias.name for alias in node.names}
            yield from (
                f"{node.lineno}: import {name}" for name in sorted(names & {"numpy", "cmath", "scipy", "shapely"})
            )
        if isinstance(node, ast.ImportFrom) and node.module in ("numpy", "cmath"):
            yield f"{node.lineno}: from {node.module}"
        if isinstance(node, ast.ImportFrom) and node.module == "math":
            yield from (f"{node.lineno}: math.{a.name}" for a in node.names if a.name not in PRINTING)
        of_math = isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "math"
        if of_math and node.attr not in PRINTING:
            yield f"{node.lineno}: math.{node.attr}"


def _applied(tree: ast.Module, turns: bool) -> Iterator[str]:
    """Go through laws that are applied, and through directions that are taken."""
    names = {"LAWS"} if turns else {"LAWS", "polar", "swept"}
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and node.id in names:
            yield f"{node.lineno}: {node.id}"


def _multiplied(function: ast.FunctionDef) -> Iterator[str]:
    """Go through products and quotients of two things that are read, and through roots of the sum of their squares."""
    names = _read_names(function)
    for node in ast.walk(function):
        product = isinstance(node, ast.BinOp) and isinstance(node.op, PRODUCTS)
        if product and _is_read(node.left, names) and _is_read(node.right, names):
            yield f"{node.lineno}: {ast.unparse(node)}"
        match node:
            case ast.Call(func=ast.Name(id="abs"), args=[ast.Call(func=ast.Name(id="complex"), args=[a, b])]):
                if _is_read(a, names) and _is_read(b, names):
                    yield f"{node.lineno}: {ast.unparse(node)}"


def _read_names(function: ast.FunctionDef) -> set[str]:
    """Return the variables of a function that hold what is read."""
    names: set[str] = set()
    while True:
        before = len(names)
        for node in ast.walk(function):
            for target, value in _assignments(node):
                if _is_read(value, names):
                    names |= {n.id for n in ast.walk(target) if isinstance(n, ast.Name)}
        if len(names) == before:
            return names


def _assignments(node: ast.AST) -> Iterator[tuple[ast.expr, ast.expr]]:
    if isinstance(node, ast.Assign):
        for target in node.targets:
            pairs = isinstance(target, ast.Tuple) and isinstance(node.value, ast.Tuple)
            if pairs and len(target.elts) == len(node.value.elts):
                yield from zip(target.elts, node.value.elts, strict=True)
            else:
                yield target, node.value
    elif isinstance(node, (ast.For, ast.comprehension)):
        yield node.target, node.iter


def _is_read(expression: ast.expr, names: set[str]) -> bool:
    """Whether an expression has a part that is read off what is solved; a text of it counts for nothing."""
    if isinstance(expression, (ast.JoinedStr, ast.Compare)):
        return False
    if isinstance(expression, ast.IfExp):
        return _is_read(expression.body, names) or _is_read(expression.orelse, names)
    if isinstance(expression, ast.Name):
        return expression.id in names
    if isinstance(expression, ast.Attribute) and expression.attr in READING:
        return True
    parts = (child for child in ast.iter_child_nodes(expression) if isinstance(child, (ast.expr, ast.comprehension)))
    return any(_is_read(part, names) for part in parts if isinstance(part, ast.expr))


@pytest.mark.parametrize("path", MODULES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_views_compute_nothing_that_is_not_a_mark(path: Path) -> None:
    assert faults(MODULES[path], path.stem) == []


@pytest.mark.parametrize(
    "text",
    [
        "import numpy as np",
        "import math\nx = math.sin(1.0)",
        "from math import hypot",
        "from cmath import phase",
        "def view(scene):\n    return LAWS['ratio'](1.0, 2.0)",
        "def view(scene):\n    return abs(complex(scene.size('e'), scene.size('s_0')))",
        "def view(scene):\n    return polar(3.0, scene.size('phi'))",
        "def view(scene):\n    return swept(scene.mm('A'), 1j)",
        "def view(scene):\n    return scene.size('L') / scene.scale('mu_l').mu",
        "def view(scene):\n    a, b = scene.mm('A'), scene.mm('B')\n    way = b - a\n    return way / abs(way)",
        "def view(scene):\n    return [k * scene.mm('A') for k in scene.places('s')]",
    ],
)
def test_what_computes_is_found(text: str) -> None:
    assert len(faults(text)) == 1


def test_layout_is_left_alone() -> None:
    text = (
        "def view(scene):\n    a, b = scene.mm('A'), scene.mm('B')\n    return 0.5 * (a + b) + 2.0j * scene.style.text"
    )
    assert faults(text) == []
    assert len(MODULES) > 10
