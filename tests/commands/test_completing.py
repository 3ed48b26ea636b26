"""What a shell offers for TAB: asked as the shells ask, through the environment."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from kulman import cli
from kulman.scales.choices import FORMATS
from kulman.tests.support.commands import Run
from kulman.variants.commands.helping import told
from kulman.variants.shelf import GUIDES, bundled, summary

Offered = Callable[..., list[str]]  # to a line, and a shell: what it may go on with


@pytest.fixture
def offered(run: Run, monkeypatch: pytest.MonkeyPatch) -> Offered:
    """Asks as bash does after a line: what it may go on with."""

    def asking(line: str, shell: str = "bash") -> list[str]:
        monkeypatch.setenv("_KULMAN_COMPLETE", f"{shell}_complete")
        monkeypatch.setenv("COMP_WORDS", line)
        monkeypatch.setenv("COMP_CWORD", str(len(line.split(" ")) - 1))
        status, shown, err = run()
        assert (status, err) == (0, "")
        return [row.removeprefix("plain,") for row in shown.splitlines() if row]

    return asking


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("kulman so", ["solve"]),
        ("kulman solve --form", ["--format"]),
        ("kulman solve madi-c", ["file,madi-c", "madi-cam"]),
        ("kulman show ", [*bundled()]),
        ("kulman new --from scheme-09", ["scheme-09-shaper"]),
        ("kulman solve nau-slider-crank -v e", ["example"]),
        ("kulman solve nau-slider-crank --lang uk -v e", ["example"]),
        ("kulman --lang ru batch madi-cam nau-slider-crank --variant V", []),
        ("kulman sheet madi-gear --only mesh", ["meshing"]),
        ("kulman sheet madi-gear --format a", [*FORMATS]),
        ("kulman sheet madi-gear -o x", ["x.svg", "x.pdf", "x.png", "x.dxf", "x.html", "x.ggb"]),
        ("kulman sheet madi-gear -o x.p", ["x.pdf", "x.png"]),
        ("kulman sheet madi-gear -o ../my.sheets/", ["file,../my.sheets/"]),
        ("kulman variants nau-slider-crank --quantities M_bal,omega_", ["M_bal,omega_1", "M_bal,omega_2"]),
        ("kulman solve nau-slider-crank --set l_", ["l_OA=", "l_AB=", "l_AS2="]),
        ("kulman sweep nau-slider-crank -v 3 --set r", ["rotation=cw", "rotation=ccw"]),
        ("kulman check nau-slider-crank --scale mu_V", ["mu_V="]),
        ("kulman variants nau-slider-crank --range n", ["n_1="]),
        ("kulman batch madi-cam --set no-such", []),
        ("kulman chart madi-gear --chart ", ["scale"]),
        ("kulman solve nau-slider-crank --hand c", ["cad", "careful"]),
        ("kulman solve nau-slider-crank --notation ba", ["bauman"]),
        ("kulman check nau-slider-crank --roster c", ["file,c"]),
        ("kulman batch nau-slider-crank --out c", ["dir,c"]),
        ("kulman guide ", [*GUIDES]),
        ("kulman help sw", ["sweep"]),
        ("kulman solve no-such-task -v ", []),
        ("kulman sovle ", sorted(cli.commands.commands)),
    ],
)
def test_a_shell_is_offered_what_the_line_may_go_on_with(line: str, words: list[str], offered: Offered) -> None:
    assert offered(line) == words


def test_a_shell_shows_what_commands_and_tasks_are_in_the_language_of_messages(
    offered: Offered, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("KULMAN_LANG", "uk")

    assert offered("kulman swe", "zsh") == ["plain", "sweep", " ".join(told("sweep", "about", "uk").split())]
    assert offered("kulman show madi-c", "zsh")[-1] == summary("madi-cam")["title"]["uk"]


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_a_shell_is_told_how_to_ask(shell: str, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("_KULMAN_COMPLETE", f"{shell}_source")

    assert f"_KULMAN_COMPLETE={shell}_complete" in run()[1]
