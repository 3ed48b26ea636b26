"""Quantities as people write them, in three languages."""

import math
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kulman.scales.errors import InputError
from kulman.scales.numbers import split_number
from kulman.scales.units import ONE, SYMBOLS, Unit, format_unit, parse, unit

# within the bounds of all numbers in whatever unit
FINITE = st.floats(min_value=1e-5, max_value=1e3) | st.floats(min_value=-1e3, max_value=-1e-5)


@pytest.mark.parametrize(
    ("text", "expected", "value"),
    [
        ("55 mm", "m", 0.055),
        ("55,5 mm", "m", 0.0555),
        ("55.5мм", "m", 0.0555),
        ("1e-3 m", "mm", 1e-3),
        ("12 см", "m", 0.12),
        ("5 мкм", "m", 5e-6),
        ("765 об/хв", "rad/s", 765 * math.pi / 30),
        ("765 об/мин", "rad/s", 765 * math.pi / 30),
        ("765 rpm", "rad/s", 765 * math.pi / 30),
        ("765 r/min", "rad/s", 765 * math.pi / 30),
        ("765 1/min", "rad/s", 765 * math.pi / 30),
        ("765 хв⁻¹", "rad/s", 765 * math.pi / 30),
        ("12 с^-1", "rpm", 12.0),
        ("12 1/s", "rpm", 12.0),
        ("12 рад/с", "rpm", 12.0),
        ("90 град/с", "rad/s", math.pi / 2),
        ("3 с⁻²", "rad/s^2", 3.0),
        ("60°", "rad", math.pi / 3),
        ("60 град", "rad", 60 * math.pi / 180),
        ("30°30′", "rad", 30.5 * math.pi / 180),
        ("-30°30'", "deg", -30.5 * math.pi / 180),
        ("2 кН", "N", 2000.0),
        ("2 кH", "N", 2000.0),  # a Latin H
        ("1 500 Н", "N", 1500.0),
        ("1\u00a0500\u202f000,5 Н", "N", 1500000.5),
        ("−5 Н·м", "N*m", -5.0),
        ("70 N*mm", "N*m", 0.07),
        ("0,015 кг·м²", "kg*m^2", 0.015),
        ("0,015 кг*м2", "kg*m^2", 0.015),
        ("0,015 кг м^2", "kg*m^2", 0.015),
        ("150 g*cm^2", "kg*m^2", 150 / 1e7),
        ("2 МПа", "Pa", 2e6),
        ("2 Н/мм²", "Pa", 2e6),
        ("0,05 (м/с)/мм", "(m/s)/mm", 50.0),
        ("0.05 m/(s*mm)", "(m/s)/mm", 50.0),
        ("0,001 м/мм", "m/mm", 1.0),
        ("15 Н/мм", "N/mm", 15000.0),
        ("250 мс", "s", 0.25),
        ("3 kN*m", "J", 3000.0),
        ("2 кВт", "W", 2000.0),
        (".5 m", "m", 0.5),
        ("5. m", "m", 5.0),
        ("1/3", "1", 1 / 3),
        ("3 / 4 mm", "m", 0.75e-3),
        ("5 1/s", "1/s", 5.0),
    ],
)
def test_a_quantity_is_read_in_si(text: str, expected: str, value: float) -> None:
    assert parse(text, unit(expected)) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "expected", "value"),
    [
        ("55 mm", "m", 55 / 1000),
        ("0.3 mm", "m", 0.3 / 1000),
        ("765 rpm", "rad/s", 765 * math.pi / 30),
        ("123 deg", "rad", 123 * math.pi / 180),
    ],
)
def test_conversion_rounds_no_more_than_the_textbook_formula(text: str, expected: str, value: float) -> None:
    assert parse(text, unit(expected)) == value


@pytest.mark.parametrize(
    ("text", "expected", "key"),
    [
        ("", "m", "number-empty"),
        ("   ", "m", "number-empty"),
        ("mm", "m", "number-bad"),
        ("nan", "m", "number-bad"),
        ("inf", "m", "number-bad"),
        ("-inf mm", "m", "number-bad"),
        ("1e400", "m", "number-infinite"),
        ("1e-400 mm", "m", "number-infinite"),
        ("1e308 km", "m", "number-infinite"),
        ("1e154 m", "m", "number-infinite"),
        ("-1.1e9 N", "N", "number-infinite"),
        ("9e-13 m", "m", "number-infinite"),
        ("5e-324 mm", "m", "number-infinite"),
        ("1.1e15 Pa", "Pa", "number-infinite"),
        ("9" * 100_000, "m", "number-infinite"),
        ("55 5 mm", "m", "number-bad"),
        ("1,500.5 mm", "m", "number-bad"),
        ("--5 mm", "m", "number-bad"),
        ("١٢ mm", "m", "number-bad"),
        ("0x10 mm", "m", "unit-unknown"),
        ("1/0", "%", "unit-unknown"),
        ("0.5/3", "%", "unit-unknown"),
        ("1/3.5", "%", "unit-unknown"),
        ("1/" + "9" * 400, "%", "number-infinite"),
        ("9" * 400 + "/3", "%", "number-infinite"),
        ("5 furlong", "m", "unit-unknown"),
        ("5 m^99", "m", "unit-unknown"),
        ("5 (m", "m", "unit-unknown"),
        ("5 m)", "m", "unit-unknown"),
        ("5 m/", "m", "unit-unknown"),
        ("5 " + "(" * 100_000, "m", "unit-unknown"),
        ("5 mN", "N", "unit-unknown-like"),
        ("5", "m", "unit-missing"),
        ("5 s", "m", "unit-wrong"),
        ("5 m", "rad", "unit-wrong"),
        ("5 %", "rad", "unit-wrong"),
        ("5 deg", "%", "unit-wrong"),
        ("5 1/s", "rad", "unit-wrong"),
        ("5 rad/s", "rad/s^2", "unit-wrong"),
        ("5 1/m", "rad/s", "unit-wrong"),
    ],
)
def test_what_is_no_quantity_of_the_wanted_kind_is_refused(text: str, expected: str, key: str) -> None:
    with pytest.raises(InputError) as caught:
        parse(text, unit(expected))

    assert caught.value.key == key
    assert all("\n" not in caught.value.text(language) for language in ("uk", "ru", "en"))
    assert len(caught.value.text()) < 200


def test_a_number_without_a_unit_takes_the_default() -> None:
    assert parse("55,5", unit("m"), unit("mm")) == 0.0555
    assert parse("0,5", ONE) == 0.5


@given(
    FINITE, st.sampled_from(sorted(SYMBOLS)), st.sampled_from(("en", "uk", "ru")), st.sampled_from(("", " ", "\u00a0"))
)
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
    st.sampled_from(("en", "uk", "ru")),
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


@pytest.mark.parametrize(
    ("name", "uk", "en"),
    [
        ("m/s", "м/с", "m/s"),
        ("m/s^2", "м/с²", "m/s²"),
        ("N", "Н", "N"),
        ("N*m", "Н·м", "N·m"),
        ("rad/s", "рад/с", "rad/s"),
        ("1/s", "с⁻¹", "1/s"),
        ("1/s^2", "с⁻²", "1/s²"),
        ("kg*m^2", "кг·м²", "kg·m²"),
        ("(m/s)/mm", "(м/с)/мм", "(m/s)/mm"),
        ("(m/s^2)/mm", "(м/с²)/мм", "(m/s²)/mm"),
        ("m/mm", "м/мм", "m/mm"),
        ("N/mm", "Н/мм", "N/mm"),
        ("rpm", "об/хв", "rpm"),
        ("deg", "°", "°"),
        ("%", "%", "%"),
    ],
)
def test_units_are_spelled_as_on_a_sheet(name: str, uk: str, en: str) -> None:
    assert (format_unit(name, "uk"), format_unit(name, "en"), unit(name).name) == (uk, en, name)


def test_powers_can_be_marked_up() -> None:
    assert format_unit("m/s^2", "uk", raised=True) == "м/с^{2}"
    assert format_unit("1/s", "ru", raised=True) == "с^{−1}"


def test_no_two_symbols_share_a_spelling() -> None:
    spellings = [s for name, x in SYMBOLS.items() for s in {name, x.en, x.uk, x.ru, *x.also}]

    assert len(set(spellings)) == len(spellings)
