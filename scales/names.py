"""What is asked for: names that exist, else refused with the one that was meant; arguments of the right kind."""

from __future__ import annotations

import difflib
import os
import re
import unicodedata
from collections.abc import Callable, Collection, Iterable, Mapping
from functools import wraps
from inspect import Parameter, signature
from itertools import chain, repeat
from numbers import Integral
from typing import Any, ParamSpec, TypeVar

from .errors import InputError, UnknownNameError, Written, as_one
from .numbers import quote
from .units import UnitName

_CYRILLIC, _LATIN = "АВЕІКМНОРСТУХЅЈаеіоруксхѕј", "ABEIKMHOPCTYXSJaeiopykcxsj"
_ALIKE = str.maketrans(_CYRILLIC, _LATIN)
_GREEK = re.compile(r"GREEK (?:SMALL LETTER |CAPITAL LETTER )?(\w+)")
GREEK = {  # letters, as names of quantities spell them
    ord(sign): found[1].lower().replace("lamda", "lambda")
    for sign in map(chr, range(0x370, 0x400))
    if (found := _GREEK.match(unicodedata.name(sign, "")))
}
LONGEST = 200  # characters of a list of names in a message
P = ParamSpec("P")
R = TypeVar("R")
_PARAMETERS = Parameter.POSITIONAL_OR_KEYWORD, Parameter.VAR_POSITIONAL, Parameter.KEYWORD_ONLY, Parameter.VAR_KEYWORD
_KINDS: dict[str, tuple[type, ...]] = {  # of the parts of what a signature says of an argument
    "None": (type(None),),
    "PathLike": (str, os.PathLike),
    "bool": (bool,),
    "float": (int, float),
    "int": (int, Integral),
    "os.PathLike[str]": (os.PathLike,),
    "str": (str,),
}


def unknown(key: str, asked: object, known: Iterable[str], also: Iterable[str] = (), **data: Any) -> UnknownNameError:
    """Return the error for a name that is not in `known`: with the name that was meant, or with all there are.

    Parameters
    ----------
    key : str
        Message that takes `text` and `known`; the message `key-like` takes `text` and `like`.
    asked : object
        What was asked for; from Python it need not even be a text.
    known : iterable of str
        The names there are.
    also : iterable of str
        Others that may be meant, and are not listed.
    """
    listed, text = list(known), str(asked)
    names = [*listed, *also]
    data = {name: Written(value) if isinstance(value, str) else value for name, value in data.items()}
    if text != latin(text) and latin(text).casefold() in map(str.casefold, names):
        return cyrillic(text)
    plain = unicodedata.normalize("NFKC", text.lstrip("0")).translate(GREEK).casefold().replace("_", "")
    folded = [name for name in names if plain and name.casefold().replace("_", "") == plain]  # mu_v, VB, φ, 03
    if 2 < len(text) < 100 or folded:
        turned = [name for name in names if sorted(name) == sorted(text)]  # l_BA for l_AB
        having = [name for name in names if text.casefold() in name.casefold()]  # scheme-03, crank-rocker
        begun = [name for name in names if re.match(rf"{re.escape(_bare(text))}(?![^\W_])", _bare(name))]  # scheme-1
        only = begun if len(begun) == 1 else having if len(having) == 1 else []
        for meant in folded or turned or only or difflib.get_close_matches(text, names, n=1, cutoff=0.6):
            return UnknownNameError(f"{key}-like", text=quote(text), like=Written(meant), **data)
    listed.sort(key=lambda name: len(text) < 3 or text.casefold() not in name.casefold())  # shaper: first what has it
    shown = ", ".join(listed)
    shown = shown if len(shown) <= LONGEST else f"{shown[:LONGEST].rpartition(', ')[0]}, …"
    return UnknownNameError(key, text=quote(text), known=Written(shown or "—"), **data)


def unknown_given(asked: str, known: Iterable[str], task: str) -> UnknownNameError:
    """Return the error for a given that a task has not; where it has the same speed in its other measure, with that.

    >>> print(unknown_given("ω_1", ["l_AB", "n_1"], "press").text("uk"))
    завдання press не має величини «ω_1», а має n_1; задайте її так: «n_1 = … рад/с»
    """
    names, (kind, line, link) = [*known], asked.translate(GREEK).partition("_")
    for other, unit in (("n", "rad/s"), ("omega", "rpm")):
        if kind != other and kind in ("n", "omega") and f"{other}{line}{link}" in names:
            told = {"text": quote(asked), "task": Written(task), "unit": UnitName(unit)}
            return UnknownNameError("given-speed", like=Written(f"{other}{line}{link}"), **told)
    return unknown("given-unknown", asked, names, task=task)


def _bare(text: str) -> str:
    return re.sub(r"(?<!\d)0+(?=\d)", "", text.casefold())


def named(text: str, known: Iterable[str]) -> str:
    """Return the one known name that is written as `text` but for Greek letters and `_`; else the text as it is.

    >>> named("φ", ["phi", "l_AB"]), named("lAB", ["phi", "l_AB"]), named("lab", ["phi", "l_AB"])
    ('phi', 'l_AB', 'lab')
    """
    names = [*known]
    plain = unicodedata.normalize("NFKC", text).translate(GREEK).replace("_", "")
    found = [name for name in names if name.replace("_", "") == plain]
    return found[0] if text not in names and len(found) == 1 else text


def latin(text: str) -> str:
    """Return `text` with Latin letters for the Cyrillic ones that look like them."""
    return text.translate(_ALIKE)


def cyrillic(text: str) -> UnknownNameError:
    """Return the error for a name with a Cyrillic letter that looks like a Latin one."""
    letter = next(letter for letter in text if letter in _CYRILLIC)
    return UnknownNameError("name-cyrillic", text=quote(text), n=text.index(letter) + 1, letter=latin(letter))


def seen(text: str) -> str:
    """Return a text without the signs that nobody sees: those that turn a line about, of no width, of control.

    Ends of lines and tabs stay, and letters that are no letters (lone surrogates), which `legible` refuses.

    >>> seen("Ko\u202eval\u200b\x07")
    'Koval'
    """
    if text.isprintable():
        return text
    return "".join(sign for sign in text if unicodedata.category(sign) not in ("Cf", "Cc") or sign in "\n\t")


# What callers of the Python API hand over.


def of_kind(name: str, value: object, kinds: tuple[type, ...], expected: str) -> None:
    """Refuse the argument `name` unless its value is of one of `kinds`; `expected` says so in Python's words.

    Raises
    ------
    InputError
        The value is of another kind.
    """
    if not isinstance(value, kinds):
        raise InputError("argument-type", name=name, expected=expected, text=quote(type(value).__name__))


def of_its_kinds(*block: str) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Let a function refuse arguments that are not of the kind that its signature says, that it lacks or does not know.

    Arguments whose kinds are not all in `_KINDS` are left to the function; `block` are the names of its `**block`.

    >>> of_its_kinds()(latin)(3)
    Traceback (most recent call last):
    kulman.scales.errors.InputError: text: expected str, not int
    """

    def of_one(function: Callable[P, R]) -> Callable[P, R]:
        arguments_of = signature(function).parameters.values()
        notes = {one.name: "" if one.annotation is one.empty else one.annotation for one in arguments_of}
        by_kind = {kind: [one.name for one in arguments_of if one.kind is kind] for kind in _PARAMETERS}
        usual, several, named_only, others = by_kind.values()
        places, known = [*usual, *several], [*usual, *named_only, *block]
        needed = [one.name for one in arguments_of if one.default is one.empty and one.name not in (*several, *others)]

        @wraps(function)
        def checked(*arguments: P.args, **named: P.kwargs) -> R:
            if block or not others:
                own = [name for name in known if name != "self"]
                all_known("argument-unknown", named, own, "argument-given" if "set" in known else None)
            if lacking := [name for name in needed if name not in {*places[: len(arguments)], *named}]:
                raise InputError("argument-missing", name=", ".join(lacking))
            if not several and (len(arguments) > len(usual) or {*usual[: len(arguments)]} & {*named}):
                raise InputError("argument-unnamed", known=", ".join(usual), text=quote(arguments[-1]))
            for name, value in (*zip(chain(places, repeat(places[-1])), arguments, strict=False), *named.items()):
                note = notes.get(name, notes.get("block", ""))
                kinds = [_KINDS.get(part) for part in note.split(" | ")]
                if None not in kinds:
                    of_kind(name, value, tuple(kind for several in kinds for kind in several or ()), note)
            return function(*arguments, **named)

        return checked

    return of_one


def by_name(name: str, value: Mapping[str, Any] | None) -> dict[str, Any]:
    """Return the argument `name`, a mapping from names, as a dict; nothing for None."""
    if value is None:
        return {}
    of_kind(name, value, (Mapping,), "dict[str, ...]")
    for key in value:
        of_kind(name, key, (str,), "dict[str, ...]")
    return dict(value)


def names_of(
    argument: str, value: str | Iterable[str | int] | None, kinds: tuple[type, ...] = (str,), once: bool = True
) -> tuple[str, ...]:
    """Return names that are given each alone or several with commas between, each of these `kinds`; none for None.

    Each stands there `once`, if that is not otherwise.
    """
    if value is None:
        return ()
    of_kind(argument, value, (str, Iterable), "list[str]")
    items = (value,) if isinstance(value, str) else tuple(value)
    for item in items:
        of_kind(argument, item, kinds, "list[str]")
    names = [one.strip() for item in items for one in str(item).split(",") if one.strip()]
    return tuple(dict.fromkeys(names) if once else names)


def all_known(key: str, names: Iterable[str], known: Collection[str], unlike: str | None = None) -> None:
    """Refuse, with the message `key`, the names that are not known; with that of `unlike` one that is like none."""
    faults = [unknown(key, name, known) for name in names if name not in known]
    if unlike is not None:
        faults = [UnknownNameError(unlike, **one.data) if one.key == key else one for one in faults]
    if faults:
        raise as_one(faults)
