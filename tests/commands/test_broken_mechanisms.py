"""Mechanism files as newcomers break them: one line each, with file, line, key, what is wrong and what was expected."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from kulman import cli, solve
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.broken_files import BROKEN, GOOD, LOADED, PRESS, broken
from kulman.variants.reader import read_text


@pytest.mark.parametrize("name", [*BROKEN, *LOADED])
def test_fault_is_named_with_its_place_and_what_was_expected(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    key, place, said = BROKEN[name][1:] if name in BROKEN else LOADED[name][2:]
    monkeypatch.chdir(tmp_path)
    Path("mine.toml").write_text(broken(name), encoding="utf-8")
    _, faults = read_text(broken(name), "mine.toml")
    fault = next(fault for fault in faults if getattr(fault, "cause", fault).key == key)
    line = int(str(fault).split(":")[1])

    assert f"{place}: " in fault.text("en")
    assert said in fault.text("en")
    assert 1 <= line <= broken(name).count("\n") + 1
    for language in LANGUAGES:
        monkeypatch.setenv("LC_ALL", f"{language}.UTF-8")
        with pytest.raises(SystemExit) as stopped:
            cli.main(["solve", "mine.toml"])
        out, err = capsys.readouterr()
        assert (stopped.value.code, out, err.count("\n")) == (2, "", 1)
        assert err.startswith("mine.toml:")
        assert "{" not in err
        assert len(err) < 330


@pytest.mark.parametrize("name", BROKEN)
def test_first_fault_stands_where_the_file_was_changed(name: str) -> None:
    text = broken(name)
    changed = [i for i, line in enumerate(text.splitlines(), 1) if line not in GOOD.splitlines()]
    changed = changed or [
        i for i, (new, old) in enumerate(zip(text.splitlines(), GOOD.splitlines(), strict=False), 1) if new != old
    ]
    _, faults = read_text(text, "mine.toml")
    line = int(str(faults[0]).split(":")[1])

    structural = BROKEN[name][1] in {"links-rigid", "links-free", "link-loose", "no-construction"}
    assert structural or min(abs(line - i) for i in changed) <= 8


@pytest.mark.parametrize(
    ("edits", "said"),
    [
        pytest.param(
            [("l_AB = 260", "l_AB = 26"), ('"220 mm"', '"22 mm"')],
            "in any position of the crank: here",
            id="loop never closed",
        ),
        pytest.param([("l_OA = 100", "l_OA = 230")], "the nearest positions that can be", id="loop not closed here"),
    ],
)
def test_loop_that_does_not_close_is_refused_with_status_three(
    edits: Sequence[tuple[str, str]],
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    text = GOOD.replace("phi = 60", "phi = 150")
    for old, new in edits:
        text = text.replace(old, new)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")
    Path("mine.toml").write_text(text, encoding="utf-8")

    with pytest.raises(SystemExit) as stopped:
        cli.main(["solve", "mine.toml"])
    reason = solve("mine.toml").reason

    out, err = capsys.readouterr()
    assert (stopped.value.code, out, err.count("\n")) == (3, "", 1)
    assert said in err
    assert "mm are missing at B" in err
    assert reason is not None
    assert len({reason.text(language) for language in LANGUAGES}) == 3


ALONE = (
    pytest.param(GOOD.replace('n_1 = { unit = "rpm" }', 'n_1 = { unit = "rpmm" }'), "unit-unknown-like", id="unit"),
    pytest.param(
        GOOD.replace('n_1 = { unit = "rpm" }', 'n_1 = { unt = "rpm" }'), "key-unknown-like", id="key of a given"
    ),
    pytest.param(GOOD.replace('n_1 = { unit = "rpm" }', "n_1 = {}"), "given-kind", id="given of no kind"),
    pytest.param(PRESS.replace("at = [0, 0.35, 0.35", "at = [0, 0.35, 0.3"), "diagram-stroke", id="places"),
    pytest.param(PRESS.replace('over = "stroke"', 'over = "path"'), "diagram-over", id="diagram"),
    pytest.param(PRESS.replace('values = ["0 N", "0 N", ', 'values = ["0 N", '), "diagram-uneven", id="values"),
)


@pytest.mark.parametrize(("text", "key"), ALONE)
def test_what_follows_from_a_fault_is_no_other_fault(text: str, key: str) -> None:
    assert text not in (GOOD, PRESS)
    _, faults = read_text(text, "mine.toml")

    assert [getattr(fault, "cause", fault).key for fault in faults] == [key]


def test_setting_with_a_cyrillic_letter_says_so() -> None:
    with pytest.raises(InputError) as refused:
        solve("nau-slider-crank", set={"l_\u041e\u0410": "55 mm"})

    assert refused.value.key == "name-cyrillic"
    assert all(refused.value.text(language).endswith(("O", "same")) for language in LANGUAGES)


def test_without_a_change_the_file_is_good() -> None:
    assert read_text(GOOD, "mine.toml")[1] == ()
