"""Quantities as people write them, in three languages; scale factors in both conventions."""

import math
from contextlib import suppress
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

import kulman
from kulman.drawing.words import Words
from kulman.scales.errors import LANGUAGES, InputError
from kulman.scales.numbers import split_number
from kulman.scales.scale import SERIES, Fixed, From, Scale, Segment, chooser, rounded, steps
from kulman.scales.units import ONE, SYMBOLS, Unit, format_unit, parse, unit

GIVEN = {  # scale factors as people give them
    ("mu_V", "0.05"): 0.05,
    ("mu_V", "0,05 (м/с)/мм"): 0.05,
    ("mu_V", "20 mm/(m/s)"): 0.05,
    ("mu_l", "500 мм/м"): 0.002,
    ("mu_F_23", "15 Н/мм"): 15.0,
    ("mu_F_23", "0.04 mm/N"): 25.0,
}


def test_a_given_scale_is_read_and_told_in_either_convention_and_grows_coarser_by_round_steps() -> None:
    scale, words = Scale("mu_V", 0.05, "m/s"), Words.of("uk", "nau")
    per_unit = replace(words, notation={**words.notation, "scales": "mm per unit"})
    ladder = chooser("mu_F_23", "15 N/mm").ladder(lambda name: 1.0)

    for (symbol, text), mu in GIVEN.items():
        found = chooser(symbol, text, firm=True)
        assert isinstance(found, Fixed)
        assert found.mu == pytest.approx(mu, rel=1e-15)
        assert found.ladder(lambda name: 1.0) == (found.mu,)
    assert scale.per_unit == 20.0
    assert words.scale(scale) == "μ_{V} = 0,05 (м/с)/мм"
    assert per_unit.scale(scale) == "μ_{V} = 20 мм/(м/с)"
    assert ladder[:5] == (15.0, 20.0, 25.0, 40.0, 50.0)
    assert all(mu / 10.0 ** len(str(int(mu))[1:]) in SERIES for mu in ladder[1:])
    assert steps(0.003)[:3] == (0.004, 0.005, 0.01)
    assert rounded(0.0500691) == 0.0501


SPELLED = {  # in Ukrainian and English
    "m/s": ("м/с", "m/s"),
    "m/s^2": ("м/с²", "m/s²"),
    "N*m": ("Н·м", "N·m"),
    "1/s": ("с⁻¹", "1/s"),
    "1/s^2": ("с⁻²", "1/s²"),
    "kg*m^2": ("кг·м²", "kg·m²"),
    "(m/s)/mm": ("(м/с)/мм", "(m/s)/mm"),
    "(m/s^2)/mm": ("(м/с²)/мм", "(m/s²)/mm"),
    "N/mm": ("Н/мм", "N/mm"),
    "rpm": ("об/хв", "rpm"),
    "deg": ("°", "°"),
    "%": ("%", "%"),
}
REFUSED = {  # by key and the unit that is expected
    ("number-empty", "m"): ("", "   "),
    ("number-bad", "m"): ("mm", "nan", "inf", "-inf mm", "55 5 mm", "28, 5 mm", "6,,", "1,500.5 mm", "--5 mm", "١٢ mm"),
    ("number-infinite", "m"): ("1e400", "1e-400 mm", "1e308 km", "1e154 m", "9e-13 m", "5e-324 mm", "9" * 100_000),
    ("number-infinite", "N"): ("-1.1e9 N",),
    ("number-infinite", "Pa"): ("1.1e15 Pa",),
    ("number-infinite", "%"): ("1/" + "9" * 400, "9" * 400 + "/3"),
    ("unit-unknown", "m"): ("0x10 mm", "5 furlong", "5·103 mm", "5 m^99", "5 (m", "5 m)", "5 m/", "5 " + "(" * 100_000),
    ("unit-unknown", "%"): ("1/0", "0.5/3", "1/3.5"),
    ("unit-unknown-like", "N"): ("5 mN",),
    ("unit-missing", "m"): ("5",),
    ("unit-wrong", "m"): ("5 s",),
    ("unit-wrong", "rad"): ("5 m", "5 %", "5 1/s"),
    ("unit-wrong", "%"): ("5 deg",),
    ("unit-wrong", "rad/s^2"): ("5 rad/s",),
    ("unit-wrong", "rad/s"): ("5 1/m",),
}
READ = {  # SI value, by the unit that is expected and the text
    "m": {
        "55 mm": 55 / 1000,
        "55,5 mm": 0.0555,
        "55.5мм": 0.0555,
        "12 см": 0.12,
        "12 см.": 0.12,
        "5 мкм": 5e-6,
        "3 / 4 mm": 0.75e-3,
    }
    | {".5 m": 0.5, "5. m": 5.0, "5, m": 5.0, "0.3 mm": 0.3 / 1000},
    "mm": dict.fromkeys(("1e-3 m", "1*10^-3 m", "1 · 10⁻³ м", "1х10^(−3) м", "1,0×10**-3 м"), 1e-3),
    "rad/s": {"90 град/с": math.pi / 2}
    | dict.fromkeys(
        ("765 об/хв", "765 об./мин.", "765 об/мин", "765 rpm", "765 r/min", "765 1/min", "765 хв⁻¹"), 765 * math.pi / 30
    ),
    "rpm": {"12 с^-1": 12.0, "12 1/s": 12.0, "12 рад/с": 12.0},
    "rad/s^2": {"3 с⁻²": 3.0},
    "rad": {"60°": math.pi / 3, "60 град": 60 * math.pi / 180, "30°30′": 30.5 * math.pi / 180},
    "deg": {"-30°30'": -30.5 * math.pi / 180, "123 deg": 123 * math.pi / 180},
    "N": {
        "2 кН": 2000.0,
        "2 кH": 2000.0,
        "1 500 Н": 1500.0,
        "2 кн": 2000.0,
        "1500 н": 1500.0,
        "1,5·10³ Н": 1500.0,
        "1\u00a0500\u202f000,5 Н": 1500000.5,
    },  # a Latin H
    "N*m": {"−5 Н·м": -5.0, "70 N*mm": 0.07, "5 N.m": 5.0, "5 Н.м.": 5.0}
    | {"5 Нм": 5.0, "5Nm": 5.0, "5 кНм": 5000.0, "70 Нмм": 0.07}
    | {"5 нм": 5.0, "5 н·м": 5.0, "5 н м": 5.0, "5 кнм": 5000.0, "70 нмм": 0.07},
    "kg*m^2": {"0,015 кг·м²": 0.015, "0,015 кг*м2": 0.015, "0,015 кг м^2": 0.015, "150 g*cm^2": 150 / 1e7}
    | dict.fromkeys(("0,015 кгм²", "0,015 kgm^2", "0,015 кгм2"), 0.015),
    "(m/s^2)/mm": {"2 (м/сек.²)/мм.": 2000.0},
    "Pa": {"2 МПа": 2e6, "2 Н/мм²": 2e6, "2 н/мм²": 2e6, "5 кпа": 5000.0},
    "(m/s)/mm": {"0,05 (м/с)/мм": 50.0, "0.05 m/(s*mm)": 50.0},
    "m/mm": {"0,001 м/мм": 1.0},
    "N/mm": {"15 Н/мм": 15000.0},
    "s": {"250 мс": 0.25},
    "J": {"3 kN*m": 3000.0},
    "W": {"2 кВт": 2000.0},
    "1": {"1/3": 1 / 3},
    "1/s": {"5 1/s": 5.0},
}
# within the bounds of all numbers in whatever unit
FINITE = st.floats(min_value=1e-5, max_value=1e3) | st.floats(min_value=-1e3, max_value=-1e-5)


@pytest.mark.parametrize(("key", "expected"), REFUSED)
def test_what_is_no_quantity_of_the_wanted_kind_is_refused(key: str, expected: str) -> None:
    for text in REFUSED[key, expected]:
        with pytest.raises(InputError) as caught:
            parse(text, unit(expected))

        assert caught.value.key == key
        assert all("\n" not in caught.value.text(language) for language in LANGUAGES)
        assert len(caught.value.text()) < 200


def test_units_that_are_known_are_told_as_people_write_them() -> None:
    with pytest.raises(InputError) as caught:
        parse("5 furlong", unit("m"))

    for language, spelled in {
        "uk": "об/хв, рад/с, кг, кг·м², Н",
        "ru": "об/мин",
        "en": "rpm, rad/s, kg, kg*m^2",
    }.items():
        assert spelled in caught.value.text(language)


def test_units_are_spelled_as_on_a_sheet_and_no_two_share_a_spelling() -> None:
    for name, (uk, en) in SPELLED.items():
        assert (format_unit(name, "uk"), format_unit(name, "en"), unit(name).name) == (uk, en, name)
    assert format_unit("m/s^2", "uk", raised=True) == "м/с^{2}"
    assert format_unit("1/s", "ru", raised=True) == "с^{−1}"
    spellings = [s for name, x in SYMBOLS.items() for s in {name, x.en, x.uk, x.ru, *x.also}]
    assert len(set(spellings)) == len(spellings)


@given(FINITE, st.sampled_from(sorted(SYMBOLS)), st.sampled_from(LANGUAGES), st.sampled_from(("", " ", "\u00a0")))
def test_every_symbol_is_read_back_in_every_language(value: float, name: str, language: str, space: str) -> None:
    written = unit(name)
    text = f"{value!r}{space}{format_unit(written, language)}".replace(".", "," if language != "en" else ".")
    assert parse(text, written) == written.to_si(value)
    assert written.from_si(written.to_si(value)) == pytest.approx(value, rel=1e-15)


@given(
    st.lists(
        st.tuples(st.sampled_from(sorted(set(SYMBOLS) - {"rpm", "rev"})), st.integers(-4, 4).filter(bool)),
        min_size=1,
        max_size=4,
        unique_by=lambda power: power[0],
    ),
    st.sampled_from(LANGUAGES),
)
def test_every_product_of_powers_is_read_back(powers: list[tuple[str, int]], language: str) -> None:
    written = Unit(tuple(powers))
    for text in (written.name, format_unit(written, language)):
        if len(text) <= 40:
            read = unit(text)
            assert sorted(read.powers) == sorted(written.powers)
            assert read.dimension == written.dimension


@given(st.text())
def test_any_text_is_a_quantity_or_an_input_error(text: str) -> None:
    for read in (lambda: parse(text, unit("m")), lambda: unit(text)):
        with suppress(InputError):
            read()


@given(st.integers(-(10**12), 10**12))
def test_thousands_may_stand_apart(value: int) -> None:
    for space in " \u00a0\u2009\u202f":
        assert split_number(f"{value:,}".replace(",", space) + " Н") == (value, "Н")


def test_a_chosen_segment_is_read_by_its_letters_a_scale_to_begin_with_may_be_coarser() -> None:
    assert chooser("mu_a", "p'a'=80 mm") == Segment("a_A", 80.0)
    assert chooser("mu_V", "ps2=6 cm") == Segment("V_S2", 60.0)
    assert chooser("mu_l", "AB=13 cm") == Segment("l_AB", 130.0)
    assert chooser("mu_V", "exactly pa=80 mm") == chooser("mu_V", "pa=80 mm", firm=True) == Segment("V_A", 80.0, True)
    assert chooser("mu_F_23", "from 15 N/mm") == From(15.0)
    assert chooser("mu_V", "from 20 mm/(m/s)").ladder(lambda name: 1.0)[:3] == (0.05, 0.1, 0.2)
    for text in (
        "from",
        "from pa=80",
        "abc",
        "-5",
        "0",
        "20 mm/s",
        "pa=0",
        "qa=5",
        "1e400",
        "",
        "nearly pa=80",
        "exactly",
    ):
        with pytest.raises(InputError):
            chooser("mu_V", text)


@given(st.floats(1e-6, 1e6), st.floats(5.0, 300.0))
def test_a_wished_length_takes_the_round_scale_nearest_to_it_and_an_exact_one_has_it(
    size: float, wished: float
) -> None:
    ladder = chooser("mu_V", f"pa={wished!r} mm").ladder(lambda name: size)
    decade = 10.0 ** math.floor(math.log10(size / wished))
    nearest = min(abs(size / (m * e) - wished) for m in SERIES for e in (decade / 10.0, decade, decade * 10.0))

    assert all(any(math.isclose(mu / 10.0 ** math.floor(math.log10(mu) + 1e-9), m) for m in SERIES) for mu in ladder)
    assert list(ladder) == sorted(set(ladder))
    assert abs(size / ladder[0] - wished) == pytest.approx(nearest, abs=1e-6)
    for exact in (chooser("mu_V", f"exactly pa={wished!r} mm"), chooser("mu_V", f"pa={wished!r} mm", firm=True)):
        (mu,) = exact.ladder(lambda name: size)
        assert size / mu == pytest.approx(wished, abs=0.005)
        assert len(f"{mu:e}".split("e")[0].rstrip("0")) <= 7  # six digits and their point


def test_a_task_has_round_scales_of_which_the_example_has_those_of_its_guide_and_a_user_asks_for_exact_ones() -> None:
    example = kulman.solve("nau-slider-crank", "example")
    assert (example.scales["mu_V"].mu, round(example["V_A"].mm, 2)) == (0.05, 80.11)
    assert (example.scales["mu_a"].mu, round(example["a_A"].mm, 2)) == (4.0, 80.22)
    for variant in "0123456789":
        scales = kulman.solve("nau-slider-crank", variant).scales
        assert all(scales[s].mu == steps(scales[s].mu)[0] for s in ("mu_l", "mu_V", "mu_a")), variant
    exact = kulman.solve("nau-slider-crank", "example", scales={"pa": 80})
    assert exact["V_A"].mm == pytest.approx(80.0, abs=0.005)


def test_scales_of_the_crank_draw_it_as_its_own_velocity_and_round_ones_come_from_the_series() -> None:
    crank = kulman.solve("nau-slider-crank", "3", scales={"mu_V": "crank", "mu_a": "crank"})
    rounded = kulman.solve("nau-slider-crank", "3", scales={"mu_V": "round 60 mm"})
    assert (crank["V_A"].mm, crank["a_A"].mm) == pytest.approx((crank["l_OA"].mm,) * 2, abs=1e-3)
    assert rounded.scales["mu_V"].mu == 0.1
    assert max(rounded[name].mm for name in ("V_A", "V_B", "V_BA", "V_S2")) <= 60.0


def test_quantities_are_read_in_si_and_rounded_no_more_than_by_the_textbook_formula() -> None:
    for expected, texts in READ.items():
        for text, value in texts.items():
            assert parse(text, unit(expected)) == pytest.approx(value, rel=1e-15), text
    for text, expected in (("55 mm", "m"), ("0.3 mm", "m"), ("765 rpm", "rad/s"), ("123 deg", "deg")):
        assert parse(text, unit(expected)) == READ[expected][text]
    assert parse("55,5", unit("m"), unit("mm")) == 0.0555  # a number alone takes the default
    assert parse("0,5", ONE) == 0.5


def test_numbers_are_as_short_as_twelve_digits_are() -> None:
    numbers = 0.1 + 0.2, 2.0 / 3.0, 2e-5 / 3.0, 12.0, 0.0

    assert [*map(Words.of("en", "nau").short, numbers)] == ["0.3", "0.666666666667", "0.00000666666666667", "12", "0"]


def test_numbers_of_few_digits_have_no_exponent_where_they_are_rounded_up_to_the_next_power_of_ten() -> None:
    """How many times a scale factor was too large was `1e+02`."""
    short = Words.of("uk", "nau").short

    assert [short(x, 2) for x in (99.4, 99.999, 100.0, 1 / 0.01000001)] == ["99", "100", "100", "100"]
    assert [short(-9.9996, 4), short(9.9994e-5, 4), short(9.9996e-5, 4)] == ["−10", "0,00009999", "0,0001"]
