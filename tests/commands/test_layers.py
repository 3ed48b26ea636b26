"""Imports run one way: scales <- plans <- drawing <- variants <- cli; heavy ones wait until they are needed."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

import pytest

from kulman.tests.support.sources import imports, trees

LAYERS = ("scales", "plans", "drawing", "variants", "cli")
COMMAND = "import contextlib, kulman.cli\nwith contextlib.suppress(SystemExit): kulman.cli.main(['{}'])"
HEAVY = ("numpy", "shapely", "svgwrite", "matplotlib", "reportlab", "docx", "lxml", "fontTools", "pypdfium2", "mpmath")


def imported(tree: ast.Module, path: Path) -> Iterator[tuple[str, ...]]:
    """Go through the modules of the package that a file imports, `TYPE_CHECKING` ones too, as parts from the root."""
    package = path.parts[:-1]
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = package[: len(package) - node.level + 1]
            if node.module:
                yield (*base, *node.module.split("."))
            else:
                yield from ((*base, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield ("", *str(node.module).split("."))
        elif isinstance(node, ast.Import):
            yield from (("", *alias.name.split(".")) for alias in node.names)


def circles(imports: Mapping[str, set[str]]) -> list[set[str]]:
    """Return the modules that import one another, on whatever way, lazily or for a type."""
    reached = {module: {module} | targets for module, targets in imports.items()}
    for through in imports:  # a module reaches what the ones that it reaches do
        for module, targets in reached.items():
            if through in targets:
                reached[module] = targets | reached[through]
    within = (frozenset(m for m in reached if m in reached[n] and n in reached[m]) for n in reached)
    return [set(circle) for circle in dict.fromkeys(within) if len(circle) > 1]


@cache
def modules() -> dict[str, set[str]]:
    """Return the modules of the package, `plans.laws`, with those that each imports."""
    named = {".".join(path.with_suffix("").parts).removesuffix(".__init__"): path for path in trees()}
    found: dict[str, set[str]] = {}
    for module, path in named.items():
        targets = found[module] = set()
        for node in imports()[path].body:
            if isinstance(node, ast.ImportFrom) and node.level:
                base = (*path.parts[: len(path.parts) - node.level], *filter(None, (node.module or "").split(".")))
                names = (".".join((*base, alias.name)) for alias in node.names)
                home = ".".join(base) or "__init__"
                targets.update(name if name in named else home for name in names)
    return found


def test_no_modules_import_one_another() -> None:
    assert circles(modules()) == []


def test_a_circle_of_imports_is_noticed() -> None:
    assert circles({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}}) == [{"a", "b", "c"}]
    assert circles({"a": {"b"}, "b": {"c"}, "c": set()}) == []
    assert {"variants.case", "scales.errors"} <= modules()["variants.kinds.cam"]
    assert "scales.version" in modules()["__init__"]


def test_only_the_command_line_speaks_to_click() -> None:
    found = {path.as_posix() for path, tree in imports().items() if ("", "click") in imported(tree, path)}
    users = {module for module, targets in modules().items() if any("variants.commands" in one for one in targets)}

    assert {path for path in found if not path.startswith("variants/commands/")} == {"cli.py"}
    assert {module for module in users if not module.startswith("variants.commands.")} == {"cli"}


def layer(parts: tuple[str, ...]) -> int | None:
    name = parts[0].removesuffix(".py") if parts else ""
    return LAYERS.index(name) if name in LAYERS else None


def wrong_imports(tree: ast.Module, path: Path) -> list[str]:
    """Return the imports of a file that lead to a higher layer, or name the package absolutely."""
    own = layer(path.parts)
    found = []
    for target in imported(tree, path):
        other = layer(target)
        absolute = target[0] == "" and target[1] in ("kulman", *LAYERS, "tests", "benchmarks")
        upward = own is not None and other is not None and other > own
        if absolute or upward:
            found.append(".".join(target))
    return found


def test_no_module_imports_from_a_higher_layer() -> None:
    wrong = {path.as_posix(): wrong_imports(tree, path) for path, tree in imports().items()}

    assert {path: found for path, found in wrong.items() if found} == {}


@pytest.mark.parametrize(
    ("path", "source"),
    [
        pytest.param("drawing/a.py", "from ..variants import load_task", id="name of a higher layer"),
        pytest.param("drawing/a.py", "from .. import variants", id="higher layer itself"),
        pytest.param("plans/linkages/a.py", "from ...drawing.shapes import Line", id="from a folder below"),
        pytest.param("scales/a.py", "if TYPE_CHECKING:\n    from ..plans.board import Board", id="for a type"),
        pytest.param("plans/a.py", "def f():\n    from ..drawing import shapes", id="inside a function"),
        pytest.param("variants/a.py", "from ..cli import main", id="command line"),
        pytest.param("drawing/a.py", "import kulman.plans", id="absolute"),
        pytest.param("drawing/a.py", "from kulman.plans import board", id="absolute name"),
    ],
)
def test_import_to_a_higher_layer_is_noticed(path: str, source: str) -> None:
    assert wrong_imports(ast.parse(source), Path(path)) != []


@pytest.mark.parametrize(
    ("path", "source"),
    [
        ("variants/a.py", "from ..drawing.shapes import Line"),
        (
            "plans/linkages/a.py",
            "from ...scales.errors import InputError\nfrom ..board import Board\nfrom . import rrp",
        ),
        ("cli.py", "from .variants import load_task\nfrom . import __version__"),
        ("scales/a.py", "import math\nfrom typing import Any"),
    ],
)
def test_import_from_a_lower_layer_is_allowed(path: str, source: str) -> None:
    assert wrong_imports(ast.parse(source), Path(path)) == []


def test_every_folder_of_the_package_is_a_layer() -> None:
    folders = {path.parts[0] for path in trees() if len(path.parts) > 1}

    assert folders == set(LAYERS) - {"cli"}


def loaded(code: str) -> set[str]:
    """Run `code` in a fresh Python; return the heavy packages that it has loaded."""
    report = f"{code}\nimport sys\nprint('LOADED', *(name for name in {HEAVY!r} if name in sys.modules))"
    done = subprocess.run([sys.executable, "-c", report], capture_output=True, text=True, encoding="utf-8", check=True)
    line = next(line for line in done.stdout.splitlines() if line.startswith("LOADED"))
    return set(line.split()[1:])


@pytest.mark.parametrize(
    "code",
    [
        pytest.param("import kulman", id="import kulman"),
        pytest.param("import kulman.cli", id="import kulman.cli"),
        pytest.param("import kulman.plans.linkages.chain", id="record a construction"),
        pytest.param(
            "import contextlib, kulman.cli\nwith contextlib.suppress(SystemExit): kulman.cli.main(['list'])", id="list"
        ),
        pytest.param(
            "import contextlib, kulman.cli\nwith contextlib.suppress(SystemExit): kulman.cli.main(['--help'])",
            id="help",
        ),
        pytest.param(
            "import contextlib, kulman.cli\n"
            "with contextlib.suppress(SystemExit): kulman.cli.main(['solve', 'nau-slider-crank', '-v', '3'])",
            id="solve",
        ),
    ],
)
def test_nothing_heavy_is_loaded(code: str) -> None:
    assert loaded(code) == set()


def test_heavy_package_is_noticed() -> None:
    assert loaded("import kulman.plans.boards.batch") == {"numpy"}
