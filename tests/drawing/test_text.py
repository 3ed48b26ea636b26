"""Letters: metrics against another reader of the font, markup, symbols of the schools, words in three languages."""

import ast
import math
import re
import string
import tomllib
from functools import cache
from importlib.resources import files
from io import BytesIO
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.ttLib import TTFont
from hypothesis import assume, example, given
from hypothesis import strategies as st

from kulman.docs import lettering
from kulman.drawing import letters
from kulman.drawing.font import FAMILIES, SCREEN, SLANTED, UPRIGHT, font, web_subset
from kulman.drawing.page import extent
from kulman.drawing.shapes import Text
from kulman.drawing.text import CLEAR, DROP, LIFT, escape, lay_out, lettered
from kulman.drawing.words import Words, notations
from kulman.scales.errors import LANGUAGES, InputError, messages
from kulman.scales.packaged import packaged
from kulman.scales.scale import Scale
from kulman.tests.support.printed_numbers import equation_faults, recomputes, table, value
from kulman.tests.support.sheet_cases import Case, drawn, solved
from kulman.tests.support.sources import trees
from kulman.variants.kinds import KINDS
from kulman.variants.reader import load_task
from kulman.variants.shelf import bundled

SCALES = {1e-3: "1:1", 5e-4: "2:1", 4e-4: "2.5:1", 2e-4: "5:1", 2e-3: "1:2", 2.5e-3: "1:2.5", 0.15: "1:150"}


@pytest.mark.parametrize("face", FAMILIES)
def test_characters_have_the_glyphs_that_fonttools_finds(face: str) -> None:
    oracle = TTFont(BytesIO(font(face).data))
    known = {code: oracle.getGlyphID(name) for code, name in oracle.getBestCmap().items()}
    assert [code for code in range(0x10000) if font(face).glyph(chr(code)) != known.get(code, 0)] == []


def test_texts_have_the_widths_that_fonttools_finds(oracle: TTFont) -> None:
    names, metrics = oracle.getBestCmap(), oracle["hmtx"]
    for text in (LETTERS, SIGNS.strip(), "План швидкостей", "Vector plan"):
        expected = sum(metrics[names[ord(letter)]][0] for letter in text) / 1000 * 3.5
        assert lay_out(escape(text), 3.5).width == pytest.approx(expected, rel=1e-12)


def test_letters_of_marks_symbols_and_scales_are_those_of_the_schools_and_of_drawings() -> None:
    nau, iso, bauman = Words.of("uk", "nau"), Words.of("en", "iso"), Words.of("ru", "bauman")

    marks = ("velocity.A3", "velocity.S2", "acceleration.A3", "acceleration.n_BA", "acceleration.k_A3A2")
    assert [nau.mark(mark) for mark in marks] == ["a_{3}", "s_{2}", "a′_{3}", "n", "k"]
    assert [nau.mark(f"forces_23.{number}") for number in (0, 1, 14, 27)] == ["H", "a", "n", "a_{1}"]
    assert iso.mark("forces_23.0") == "o"  # the pole, whose letter no other mark has
    assert "o" not in {iso.mark(f"forces_23.{number}") for number in range(1, 60)}
    reactions = [bauman.symbol(name) for name in ("R_12", "R_01", "h_21", "M_43")]
    assert reactions == ["F_{21}", "F_{10}", "h_{12}", "M_{34}"]  # the link on which it acts first
    assert bauman.scale(Scale("mu_V", 0.05, "m/s")) == "μ_{v} = 20 мм/(м/с)"
    assert {mu: iso.drawn_at(mu) for mu in SCALES} == {mu: f"M {scale}" for mu, scale in SCALES.items()}
    cyrillic = {mu: f"М {scale.replace('.', ',')}" for mu, scale in SCALES.items()}
    assert {mu: nau.drawn_at(mu) for mu in SCALES} == cyrillic


KINDS_OF_WORDS = ("", "titleblock.", "cams.", "gears.", "hoist.")
LETTERS = string.ascii_letters + string.digits + "абвгґдеєжзиіїйклмнопрстуфхцчшщьюяыэъёЙЇ" + "αβγδεζλμπρστφψωΔΣΦΩ"
SIGNS = " .,;:=+-()/'′″·⊥∥∠√∑→°№«»"
plain = st.text(alphabet=LETTERS + SIGNS + "\\{}_^", max_size=12)
markups = st.recursive(
    plain.map(escape),
    lambda inner: st.one_of(
        st.tuples(inner, inner).map("".join),
        st.tuples(st.sampled_from([r"\bar{", r"\u{", r"\uu{", "_{", "^{"]), inner, st.just("}")).map("".join),
    ),
    max_leaves=6,
)
BAUMAN = Case("5", "A1", "ru", notation="bauman")
NAMES = """V_B V_BA a_BA_n a_BA_t a_A3A2_k a_A3A2_r omega_2 epsilon_3 G_2 M_sum M_sum_3 P_2 h_2 h_21 h_F_3 h_2_A h_F_3_A
R_12 R_12_n R_01 M_43 J_S2 m_2 F_i2 M_i2 F_3 F_i2_couple F_i2_couple_B F_3_couple_C F_sum_couple_C F_sum_3_couple_C
h_lever_F_i2 h_lever_M_i2_B h_lever_M_3_C h_lever_G_2 mu_V mu_a mu_F_23 mu_l F_bal M_bal F_bal_lever
delta_F_bal l_AP2"""
PACKAGE = "kulman.drawing"
PLACE = Path(letters.__file__).parent


@pytest.fixture(scope="module")
def oracle():
    return TTFont(BytesIO(font(UPRIGHT).data))


@pytest.mark.parametrize(("markup", "rules"), [(r"\bar{V}", 1), (r"\u{V_{B}}", 1), (r"\uu{\bar{a}^{n}_{BA}}", 3)])
def test_bars_and_underlines_clear_the_ink(markup, rules):
    layout = lay_out(markup, 3.5)
    ink = [font(run.face).ink(letter)[1] * run.size + run.y for run in layout.runs for letter in run.string]
    tops = [font(run.face).ink(letter)[2] * run.size + run.y for run in layout.runs[:1] for letter in run.string]
    assert len(layout.rules) == rules
    for _, level, _, _ in layout.rules:
        assert level > max(tops) if level > 0 else level < min(ink)
    assert layout.bottom <= min(level for _, level, _, _ in layout.rules) <= layout.top


@given(plain)
def test_escaped_text_shows_as_it_is(text):
    runs = lay_out(escape(text), 3.5).runs
    assert "".join(run.string for run in runs).replace(" ", "") == text.replace(" ", "")


@example("")
@example(r" \u{}")
@given(markups)
def test_every_text_is_as_high_as_its_ink_and_one_without_ink_has_no_height(markup: str) -> None:
    layout = lay_out(markup, 3.5)
    assert 0.0 <= layout.size[1] < math.inf
    if not any(run.string.strip() for run in layout.runs) and not layout.rules:
        assert layout.size[1] == 0.0


@given(markups, markups)
def test_widths_add_up(left, right):
    local = [bool(re.search(r"[А-яҐґЄєІіЇїЁё]", part)) for part in (left, right)]
    assume(local[0] == local[1])  # in a line of Cyrillic words Latin letters are symbols, which are slanted
    whole = lay_out(left + r"\u{}" + right, 3.5)  # the empty group keeps two scripts from being stacked
    assert whole.width == pytest.approx(lay_out(left, 3.5).width + lay_out(right, 3.5).width, abs=1e-9)


@pytest.mark.parametrize("language", ["uk", "ru", "en"])
def test_a_font_that_is_missing_is_named_by_its_path_as_it_is(language: str, monkeypatch: pytest.MonkeyPatch) -> None:
    place = SimpleNamespace(origin="/opt/python 3.11/matplotlib/__init__.py")
    monkeypatch.setattr("kulman.drawing.font.find_spec", lambda name: place)
    font.cache_clear()
    with pytest.raises(InputError) as refused:
        font(SCREEN)
    assert "python 3.11/matplotlib" in refused.value.text(language)


def tables(kind: str) -> dict[str, dict[str, str]]:
    """Return the texts of a kind ("" or "titleblock.") by language."""
    found = {language: packaged(PACKAGE, "texts", f"{kind}{language}") for language in LANGUAGES}
    return {language: table.get("titleblock", table) for language, table in found.items()}


def placeholders(template: str) -> list[str]:
    return sorted(name for _, name, _, _ in string.Formatter().parse(template) if name is not None)


@cache
def patterns() -> frozenset[str]:
    """Return the texts in the package's code; what an f-string fills in is a `*`."""
    nodes = [node for tree in trees().values() for node in ast.walk(tree)]
    joined = [node.values for node in nodes if isinstance(node, ast.JoinedStr)]
    filled = ["".join(str(p.value) if isinstance(p, ast.Constant) else "*" for p in values) for values in joined]
    plain = [node.value for node in nodes if isinstance(node, ast.Constant) and isinstance(node.value, str)]
    own = (files("kulman.drawing.moving").joinpath(name).read_text("utf-8") for name in ("page.html", "page.js"))
    pages = [
        f"moving.{key}" for text in own for key in re.findall(r"(?:\{\{said\.|\bW\.|> ?=? ?0, \"|!== 0, \")(\w+)", text)
    ]
    return frozenset((*filled, *plain, *pages))


@cache
def words_of(stem: str) -> frozenset[str]:
    """Return what may stand in place of the `*` of `stem*`: names of the bundled tasks, or any text of the code."""
    if stem not in ("given.", "choice."):
        return patterns()
    givens = [given for task in bundled() for given in load_task(task).givens.values()]
    if stem == "given.":
        return frozenset(given.name for given in givens if given.choices)
    return frozenset(word for given in givens for word in given.choices)


@cache
def composed() -> tuple[re.Pattern[str], ...]:
    """Return what fits the texts of the code that are composed of several words."""
    several = (text for text in patterns() if text.count("*") > 1 and re.match("[a-z]{3}", text))
    return tuple(re.compile(re.escape(text).replace(r"\*", r"(\w+)")) for text in several)


def used(key: str) -> bool:
    """Whether the code names a text, whole or composed of a beginning and a word, or of the name of a subject, too."""
    if key in patterns() or any(key.replace(table, "*", 1) in patterns() for table in KINDS):
        return True
    for made in composed():
        fits = made.fullmatch(key)
        if fits and all(len(word) == 1 or {word, re.sub(r"\d", "*", word)} & patterns() for word in fits.groups()):
            return True
    cuts = [at for at in range(1, len(key)) if key[at - 1] in "._-"]
    stems = [(key[:at], key[at:]) for at in cuts]
    return any(
        word in words_of(stem)
        and not {f"{stem}*", *(f"{stem.replace(kind, '*')}*" for kind in KINDS)}.isdisjoint(patterns())
        for stem, word in stems
    )


@pytest.mark.parametrize("kind", KINDS_OF_WORDS)
def test_every_language_has_the_same_texts_with_the_same_placeholders(kind: str) -> None:
    texts = tables(kind)
    assert texts["uk"].keys() == texts["ru"].keys() == texts["en"].keys()
    if kind in ("", "titleblock."):
        for key in texts["en"]:
            assert len({tuple(placeholders(texts[language][key])) for language in LANGUAGES}) == 1, key


def test_every_text_and_message_is_used_and_every_table_of_words_is_read() -> None:
    keys = [*tables("")["en"], *tables("titleblock.")["en"], *(key.removesuffix("-like") for key in messages("en"))]
    names = {path.name for path in files(PACKAGE).joinpath("texts").iterdir()}
    assert [key for key in keys if not (used(key) or used(key.removesuffix("-page")))] == []
    assert [key for key in ("heading.nothing", "given.nothing", "choice.rotation") if used(key)] == []
    assert names == {f"{kind}{language}.toml" for kind in KINDS_OF_WORDS for language in LANGUAGES}


def test_every_choice_of_a_bundled_task_has_words_that_are_looked_up_by_key() -> None:
    texts: dict[str, Any] = tables("")["en"]
    for task in map(load_task, bundled()):
        for one in task.givens.values():
            if one.choices:
                assert {f"given.{one.name}", *(f"choice.{word}" for word in one.choices)} <= texts.keys()
    for language in LANGUAGES:
        assert Words.of(language, "nau")["heading.velocity"] == tables("")[language]["heading.velocity"]


def test_every_notation_has_the_same_keys_and_every_task_names_one() -> None:
    tables_of = {name: packaged(PACKAGE, "notations", name) for name in notations()}
    first = next(iter(tables_of.values()))
    for school in tables_of.values():
        assert school.keys() == first.keys()
        assert school["letters"].keys() == first["letters"].keys()
        assert school["parts"].keys() == first["parts"].keys()
        assert school["symbols"].keys() == set(LANGUAGES)
        assert all(symbols.keys() == first["symbols"]["en"].keys() for symbols in school["symbols"].values())
    assert {load_task(task).notation for task in bundled()} <= tables_of.keys()


def test_the_subset_is_small_and_has_the_same_outlines_and_advances(oracle: TTFont) -> None:
    data = web_subset(UPRIGHT, LETTERS + SIGNS)
    small = TTFont(BytesIO(data), checkChecksums=2)

    assert len(data) < 12_000
    assert set(small.getBestCmap()) == set(map(ord, LETTERS + SIGNS))
    whole_set, small_set = oracle.getGlyphSet(), small.getGlyphSet()
    for code, name in small.getBestCmap().items():
        pens = DecomposingRecordingPen(whole_set), DecomposingRecordingPen(small_set)
        whole_set[oracle.getBestCmap()[code]].draw(pens[0])
        small_set[name].draw(pens[1])
        assert pens[0].value == pens[1].value
        assert small["hmtx"][name] == oracle["hmtx"][oracle.getBestCmap()[code]]


@pytest.mark.parametrize("face", FAMILIES)
def test_a_table_of_a_subset_that_cannot_be_shorter_is_read_as_it_is(face: str) -> None:
    whole = TTFont(BytesIO(font(face).data))
    for count in range(2, 32):
        small = TTFont(BytesIO(web_subset(face, LETTERS[count : 2 * count])))
        for code, name in small.getBestCmap().items():
            assert small["hmtx"][name] == whole["hmtx"][whole.getBestCmap()[code]]


@pytest.mark.parametrize(
    "markup", ["d", "F_{T}", "\\bar{R}^{n}_{1f}", "j", "p′_{y}", "W = f", "А", "μ_{l} = 0,5 м/мм", ""]
)
def test_the_size_of_a_text_is_that_of_its_ink(markup: str) -> None:
    layout = lay_out(markup, 5.0)
    ends = [end for rule in layout.rules for end in rule[::2]]
    for run in layout.runs:
        whole, x = TTFont(BytesIO(font(run.face).data)), run.x
        for letter in run.string:
            name = whole.getBestCmap()[ord(letter)]
            glyph, unit = whole["glyf"][name], run.size / whole["head"].unitsPerEm
            ends += [x + edge * unit for edge in (glyph.xMin, glyph.xMax)] if glyph.numberOfContours else []
            x += whole["hmtx"][name][0] * unit
    ends = ends or [0.0]
    assert (layout.left, layout.right) == pytest.approx((min(ends), max(ends)), abs=1e-6)
    assert layout.size == pytest.approx((max(ends) - min(ends), layout.top - layout.bottom))


@pytest.mark.parametrize("markup", ["|s′|", "(V)", "[F]", "|f| = 1"])
def test_letters_that_lean_do_not_run_into_the_mark_behind_them(markup: str) -> None:
    inside, closing = lay_out(markup, 5.0).runs[1:3]

    over = font(inside.face).beyond(inside.string[-1])[1] * inside.size
    assert over > 0.0
    assert closing.x >= inside.x + inside.width + over + CLEAR * 5.0 - 1e-9


@pytest.mark.soak
@pytest.mark.parametrize(("face", "slanted"), [(UPRIGHT, False), (SLANTED, True)])
def test_fonts_are_what_the_strokes_give(face: str, slanted: bool) -> None:
    assert lettering.built(slanted) == font(face).data


def test_letters_have_the_heights_and_widths_of_the_standard() -> None:
    """GOST 2.304, type B, in h/10: how wide letters are, and how high capitals, digits and small letters."""
    wide = {8: "ЖФШЪ", 7: "АДМХЫЮ", 5: "ГЕЗС2567890", 6: "БВИЙКЛНОПРТУЧЬЭЯ4"}
    for width, which in wide.items():
        assert {letter for letter in which if abs(letters.glyphs()[letter].width - width) > 0.61} == set()
    for letter in "АБВГЕЖЗИКЛМНОПРСТУФХЧШЪЫЬЭЮЯ0123456789ABCDEFGHIJKLMNOPRSTUVWXYZ":
        _, low, high = font(UPRIGHT).ink(letter)
        assert (low * 1370, high * 1370) == pytest.approx((0.0, 1000.0), abs=30.5), letter
    for letter in "авгежзиклмнопстхчшъыьэюяacemnorsuvwxz":
        _, low, high = font(UPRIGHT).ink(letter)
        assert (low * 1370, high * 1370) == pytest.approx((0.0, 700.0), abs=30.5), letter


def test_a_letter_leans_by_75_degrees_and_is_as_wide_as_upright() -> None:
    upright, slanted = (TTFont(BytesIO(font(face).data)) for face in (UPRIGHT, SLANTED))
    assert upright["hmtx"].metrics.keys() == slanted["hmtx"].metrics.keys()
    for name, (advance, _) in upright["hmtx"].metrics.items():
        assert slanted["hmtx"][name][0] == advance
    stem = slanted["glyf"][slanted.getBestCmap()[ord("I")]]
    assert (stem.xMax - stem.xMin - 100) / (1000 - 100) == pytest.approx(math.tan(math.radians(15)), abs=0.02)


def test_all_words_of_sheets_are_set_in_drafting_letters() -> None:
    """What is not is drawn by the screen font: nothing that the texts of sheets, notations and tasks have."""
    files = (*PLACE.glob("texts/*.toml"), *PLACE.glob("notations/*.toml"), *PLACE.parent.glob("variants/tasks/*.toml"))
    shown = set("".join(str(tomllib.loads(file.read_text(encoding="utf-8"))) for file in files)) - set(
        "#₀₁₂"
    )  # of sources
    assert {letter for letter in shown if letter > " " and not font(UPRIGHT).glyph(letter)} == set()


@pytest.mark.parametrize(
    ("markup", "leaning"),
    [
        ("pa", ["pa"]),
        ("i, j, m", ["i", "j", "m"]),
        ("0,3m", ["m"]),
        ("N", ["N"]),
        ("a′b′", ["a′b′"]),
        ("max", []),
        ("Механізм V-подібного двигуна", []),
        ("Код аркуша: DSV-EGB", []),
    ],
)
def test_latin_letters_are_symbols_where_words_and_units_have_others(markup: str, leaning: list[str]) -> None:
    with lettered("gost", "uk"):
        assert [run.string for run in lay_out(markup, 5.0).runs if run.face == SLANTED] == leaning


@pytest.mark.parametrize(
    ("markup", "leaning"),
    [
        ("V_{B} = 5,622 м/с", ["V", "B"]),
        ("μ_{l} = 0,0008 м/мм", ["μ", "l"]),
        ("група Ассура II класу", []),
        ("ланка 2, точка B", ["B"]),
        ("R_{12} sin φ = 40 N", ["R", "12", "φ"]),
        ("mass 5 kg", []),
        ("Velocity plan", []),
        ("\\bar{a}^{n}_{BA} = 3 m/s^{2}", ["a", "n", "BA"]),
        ("4S7-31W", []),
        ("O. Lys", []),
        ("Format A4", []),
        ("V_{t} cos kt + (a/k) sin kt", ["V", "t", "kt", "a", "k", "kt"]),
        ("a point of link 2", []),
        ("V клас", []),
        ("ТММ.26.V01.001", []),
        ("I(0, 1) → II_{2}(2, 3)", []),
        ("Zabolotna O. V.", []),
        ("сила в точці B. Далі", ["B"]),
        ("a′s′_{2} = a′b′·AS_{2}/AB", ["a′s′", "2", "a′b′", "AS", "2", "AB"]),
        ("a′", ["a′"]),
        ("0 – the working stroke begins, e – it ends", ["e"]),
    ],
)
def test_symbols_of_quantities_lean_and_words_units_and_functions_do_not(markup: str, leaning: list[str]) -> None:
    runs = lay_out(markup, 5.0).runs
    assert [run.string for run in runs if run.face == SLANTED] == leaning
    with lettered("gost-slanted"):
        assert {run.face for run in lay_out(markup, 5.0).runs} == {SLANTED}
    with lettered("dejavu"):
        assert {run.face for run in lay_out(markup, 5.0).runs} == {SCREEN}


def test_drafting_letters_take_less_room_than_those_of_screens_and_an_unknown_lettering_is_refused() -> None:
    heading, scale = "План прискорень механізму", "μ_{a} = 10,7 (м/с^{2})/мм"
    with lettered("dejavu"):
        wide = lay_out(heading, 5.0).width, lay_out(scale, 5.0).width
    assert lay_out(heading, 5.0).width < 0.8 * wide[0]
    assert lay_out(scale, 5.0).width < 0.85 * wide[1]
    with pytest.raises(InputError, match="gost-slanted"), lettered("gost-slantd"):
        pass


@pytest.mark.parametrize("markup", ["a{b", "a}b", "a_{b", r"\bar{a", r"\x{a}", "\\", r"\bar", r"\u a", "{}", "速"])
def test_broken_markup_and_letters_that_the_font_lacks_are_refused(markup: str) -> None:
    with pytest.raises(InputError) as problem:
        lay_out(markup, 3.5)
    assert problem.value.key == "markup-broken" or "U+901F" in problem.value.text("en")


def test_scripts_have_the_next_smaller_size_of_the_standard() -> None:
    sizes = [
        lay_out("V_{B}", height).runs[1].size / lay_out("V", 1.0).runs[0].size for height in (10.0, 7.0, 5.0, 3.5, 2.5)
    ]

    assert sizes == pytest.approx([7.0, 5.0, 3.5, 2.5, 1.8])
    assert lay_out("V_{B}", 4.0).runs[1].size == pytest.approx(5 / 7 * lay_out("V", 4.0).runs[0].size)


def test_scripts_stand_one_over_the_other_and_are_no_smaller_in_scripts() -> None:
    layout, capital, deep = lay_out("a^{n}_{BA}", 5.0), lay_out("H", 3.5), lay_out("V_{S_{2}}", 5.0)
    _, _, after = lay_out("V_{B} = 5", 3.5).runs

    base, above, below = layout.runs
    assert below.x == base.width
    assert above.x == pytest.approx(base.width + 5.0 * (CLEAR + LIFT * math.tan(math.radians(15))))  # along the slope
    assert above.y > 0 > below.y == -5.0 * DROP
    assert above.size == below.size == pytest.approx(3.5 / 5.0 * base.size)
    assert layout.width >= base.width + below.width
    assert [run.size / deep.runs[0].size for run in deep.runs] == pytest.approx([1, 0.7, 0.7])
    assert deep.runs[2].y < deep.runs[1].y
    assert (capital.bottom, capital.top) == (0, pytest.approx(3.5, abs=1e-12))  # a capital is as high as it says
    assert after.string == "= 5"  # spaces between runs become distance
    assert after.x == pytest.approx(lay_out("V_{B} ", 3.5).width, abs=1e-12)


@given(markups)
def test_runs_lie_inside_the_layout_which_grows_with_the_letters(markup: str) -> None:
    layout, large = lay_out(markup, 3.5), lay_out(markup, 7.0)
    for run in layout.runs:
        assert -1e-9 <= run.x <= run.x + run.width <= layout.width + 1e-9
        low = min(font(run.face).ink(letter)[1] for letter in run.string) * run.size + run.y
        high = max(font(run.face).ink(letter)[2] for letter in run.string) * run.size + run.y
        assert layout.bottom - 1e-9 <= low <= high <= layout.top + 1e-9
    twice = (2 * layout.width, 2 * layout.top, 2 * layout.bottom)
    assert (large.width, large.top, large.bottom) == pytest.approx(twice, abs=1e-9)


@pytest.mark.parametrize(("anchor", "x0"), [("left", 10.0), ("middle", 10 - 7.0), ("right", 10 - 14.0)])
def test_a_box_follows_the_anchor_and_turns_with_its_text(anchor: str, x0: float) -> None:
    height = 14.0 / lay_out("Ap", 1.0).width  # 14 mm wide
    upright, lying = (extent((Text(0j, "Apex", 3.5, anchor, angle=angle),)) for angle in (0.0, math.pi / 2))
    x, y, x1, _ = extent((Text(10 + 20j, "Ap", height, anchor),))
    assert (x, x1) == pytest.approx((x0, x0 + 14))
    assert y < 20
    assert lying == pytest.approx((-upright[3], upright[0], -upright[1], upright[2]))


@pytest.mark.parametrize("notation", notations())
@pytest.mark.parametrize("language", LANGUAGES)
def test_symbols_are_markup_without_names_and_two_quantities_have_two(notation: str, language: str) -> None:
    words = Words.of(language, notation)
    for name in NAMES.split():
        symbol = words.symbol(name)
        assert symbol.count("{") == symbol.count("}") == symbol.count("_{") + symbol.count("^{"), symbol
        assert "__" not in symbol, symbol
        assert words.symbol(name, bar=True).startswith("\\bar{"), symbol
    names = [name for name in NAMES.split() if "couple" not in name]
    assert len({words.symbol(name) for name in names}) == len(names)


def test_sheet_of_bauman_has_segments_that_divide_by_its_scale_factors_and_angles_of_vectors() -> None:
    sheet, velocity = drawn(BAUMAN), solved(BAUMAN)["V_B"]
    results = {name: table(sheet[name]) for name in sheet.names if name.startswith("results_")}

    shown = [row for name, rows in results.items() if name != "results_lever" for row in rows if row[1] != "–"]
    assert len(shown) > 20
    for symbol, mm, scale, printed, *_ in shown:
        assert recomputes(value(mm) / value(scale), printed), symbol
    assert equation_faults(sheet)[1] == []
    rows = {row[0]: row for row in results["results_velocity"]}
    assert velocity.x is not None
    assert rows["v_{B}"][-2:] == ["0,0" if velocity.x > 0 else "180,0", "–"]
    assert rows["ω_{2}"][-2] == "–"
    assert rows["ω_{2}"][-1] in ("по час. стр.", "против час. стр.")
