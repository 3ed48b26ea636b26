"""Text: its metrics against another reader of the font, its markup, and the subset that travels with a sheet."""

import string
from io import BytesIO
from types import SimpleNamespace

import pytest
from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.ttLib import TTFont
from hypothesis import given
from hypothesis import strategies as st

from kulman.drawing.font import SIZE, font, web_subset
from kulman.drawing.page import extent
from kulman.drawing.shapes import Text
from kulman.drawing.text import DROP, SCRIPT, escape, lay_out
from kulman.scales.errors import InputError

LETTERS = string.ascii_letters + string.digits + "абвгґдеєжзиіїйклмнопрстуфхцчшщьюяыэъёЙЇ" + "αβγδεζλμπρστφψωΔΣΦΩ"
SIGNS = " .,;:=+-()/'′″·⊥∥∠√∑→²°№«»"


@pytest.fixture(scope="module")
def oracle():
    return TTFont(BytesIO(font().data))


def test_every_character_of_the_plane_has_the_glyph_that_fonttools_finds(oracle):
    known = {code: oracle.getGlyphID(name) for code, name in oracle.getBestCmap().items()}

    ours = {code: font().glyph(chr(code)) for code in range(0x10000)}

    assert ours == {code: known.get(code, 0) for code in range(0x10000)}


def test_widths_of_text_are_sums_of_fonttools_advances(oracle):
    names, metrics = oracle.getBestCmap(), oracle["hmtx"]

    for text in (LETTERS, SIGNS.strip(), "План швидкостей", "Vector plan"):
        expected = sum(metrics[names[ord(letter)]][0] for letter in text) / 2048 * SIZE * 3.5
        assert lay_out(escape(text), 3.5).width == pytest.approx(expected, rel=1e-12)


def test_a_capital_is_as_high_as_the_text_says():
    layout = lay_out("H", 3.5)

    assert (layout.bottom, layout.top) == (0, pytest.approx(3.5, abs=1e-12))


def test_the_subset_has_the_same_outlines_and_advances(oracle):
    small = TTFont(BytesIO(web_subset(LETTERS + SIGNS)), checkChecksums=2)

    assert set(small.getBestCmap()) == set(map(ord, LETTERS + SIGNS))
    whole_set, small_set = oracle.getGlyphSet(), small.getGlyphSet()
    for code, name in small.getBestCmap().items():
        pens = DecomposingRecordingPen(whole_set), DecomposingRecordingPen(small_set)
        whole_set[oracle.getBestCmap()[code]].draw(pens[0])
        small_set[name].draw(pens[1])
        assert pens[0].value == pens[1].value
        assert small["hmtx"][name] == oracle["hmtx"][oracle.getBestCmap()[code]]


def test_the_subset_is_small():
    assert len(web_subset(LETTERS + SIGNS)) < 12_000


def test_a_character_that_the_font_lacks_is_refused():
    with pytest.raises(InputError) as problem:
        lay_out("速", 3.5)

    assert "U+901F" in problem.value.text("en")


@pytest.mark.parametrize("markup", ["a{b", "a}b", "a_{b", r"\bar{a", r"\x{a}", "\\", r"\bar", r"\u a", "{}"])
def test_broken_markup_is_refused(markup):
    with pytest.raises(InputError) as problem:
        lay_out(markup, 3.5)

    assert problem.value.key == "markup-broken"


def test_sub_and_superscript_stand_one_over_the_other():
    layout = lay_out("a^{n}_{BA}", 5.0)

    base, above, below = layout.runs
    assert above.x == below.x == base.width
    assert above.y > 0 > below.y == -5.0 * DROP
    assert above.size == below.size == pytest.approx(SCRIPT * base.size)
    assert layout.width >= base.width + below.width


def test_a_script_of_a_script_is_no_smaller():
    layout = lay_out("V_{S_{2}}", 5.0)

    assert [run.size / layout.runs[0].size for run in layout.runs] == pytest.approx([1, SCRIPT, SCRIPT])
    assert layout.runs[2].y < layout.runs[1].y


@pytest.mark.parametrize(("markup", "rules"), [(r"\bar{V}", 1), (r"\u{V_{B}}", 1), (r"\uu{\bar{a}^{n}_{BA}}", 3)])
def test_bars_and_underlines_clear_the_ink(markup, rules):
    layout = lay_out(markup, 3.5)

    ink = [font().ink(letter)[1] * run.size + run.y for run in layout.runs for letter in run.string]
    tops = [font().ink(letter)[2] * run.size + run.y for run in layout.runs[:1] for letter in run.string]
    assert len(layout.rules) == rules
    for _, level, _, _ in layout.rules:
        assert level > max(tops) if level > 0 else level < min(ink)
    assert layout.bottom <= min(level for _, level, _, _ in layout.rules) <= layout.top


def test_spaces_between_runs_become_distance():
    _, _, after = lay_out("V_{B} = 5", 3.5).runs

    assert after.string == "= 5"
    assert after.x == pytest.approx(lay_out("V_{B} ", 3.5).width, abs=1e-12)


plain = st.text(alphabet=LETTERS + SIGNS + "\\{}_^", max_size=12)
markups = st.recursive(
    plain.map(escape),
    lambda inner: st.one_of(
        st.tuples(inner, inner).map("".join),
        st.tuples(st.sampled_from([r"\bar{", r"\u{", r"\uu{", "_{", "^{"]), inner, st.just("}")).map("".join),
    ),
    max_leaves=6,
)


@given(plain)
def test_escaped_text_shows_as_it_is(text):
    runs = lay_out(escape(text), 3.5).runs

    assert "".join(run.string for run in runs) == text.strip(" ")


@given(markups, markups)
def test_widths_add_up(left, right):
    whole = lay_out(left + r"\u{}" + right, 3.5)  # the empty group keeps two scripts from being stacked

    assert whole.width == pytest.approx(lay_out(left, 3.5).width + lay_out(right, 3.5).width, abs=1e-9)


@given(markups)
def test_runs_lie_inside_the_layout(markup):
    layout = lay_out(markup, 3.5)

    for run in layout.runs:
        assert -1e-9 <= run.x <= run.x + run.width <= layout.width + 1e-9
        low = min(font().ink(letter)[1] for letter in run.string) * run.size + run.y
        high = max(font().ink(letter)[2] for letter in run.string) * run.size + run.y
        assert layout.bottom - 1e-9 <= low <= high <= layout.top + 1e-9


@given(markups)
def test_layout_grows_with_the_letters(markup):
    small, large = lay_out(markup, 2.5), lay_out(markup, 5.0)

    for name in ("width", "top", "bottom"):
        assert getattr(large, name) == pytest.approx(2 * getattr(small, name), abs=1e-9)


@pytest.mark.parametrize(("anchor", "x0"), [("left", 10.0), ("middle", 10 - 7.0), ("right", 10 - 14.0)])
def test_a_box_follows_the_anchor(anchor, x0):
    height = 14.0 / lay_out("Ap", 1.0).width  # 14 mm wide

    x, y, x1, _ = extent((Text(10 + 20j, "Ap", height, anchor),))

    assert (x, x1) == pytest.approx((x0, x0 + 14))
    assert y < 20


def test_a_box_turns_with_its_text():
    upright, lying = Text(0j, "Apex", 3.5), Text(0j, "Apex", 3.5, angle=1.5707963267948966)

    x0, y0, x1, y1 = extent((upright,))

    assert extent((lying,)) == pytest.approx((-y1, x0, -y0, x1))


@pytest.mark.parametrize("language", ["uk", "ru", "en"])
def test_a_font_that_is_missing_is_named_by_its_path_as_it_is(language: str, monkeypatch: pytest.MonkeyPatch) -> None:
    place = SimpleNamespace(origin="/opt/python 3.11/matplotlib/__init__.py")
    monkeypatch.setattr("kulman.drawing.font.find_spec", lambda name: place)
    font.cache_clear()

    with pytest.raises(InputError) as refused:
        font()

    assert "python 3.11/matplotlib" in refused.value.text(language)
