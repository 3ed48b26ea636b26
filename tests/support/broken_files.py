"""Files of mechanisms with one fault each: what is changed, and what is to be said of it."""

from __future__ import annotations

from collections.abc import Sequence

from kulman.variants.making.starter import template
from kulman.variants.shelf import bundled_text

GOOD = template("en")
AT_C = 'point = "C"\nlinks = [3, 0]\nat = ["280 mm", "0 mm"]\n'
AT_B = 'point = "B"\nlinks = [2, 3]\nbranch = 1\n'
LINK_3 = 'points = { C = ["0 mm", "0 mm"], B = ["220 mm", "0 mm"], S3 = ["110 mm", "0 mm"] }\n'
PAIR_AT_C = '[[mechanism.pair]]\nkind = "revolute"\n' + AT_C
DRIVER = "[mechanism.driver]\n"
COUPLE = "[[mechanism.couple]]\n"


def link(number: int, points: str) -> str:
    """Return a link as it stands in a file."""
    return f"[[mechanism.link]]\nnumber = {number}\npoints = {{ {points} }}\n"


def pair(point: str, links: str, more: str = "") -> str:
    """Return a revolute pair as it stands in a file."""
    return f'[[mechanism.pair]]\nkind = "revolute"\npoint = "{point}"\nlinks = [{links}]\n{more}'


def force(number: int, point: str, name: str = "F_3") -> str:
    """Return a load as it stands in a file."""
    return (
        f'[[mechanism.load]]\nname = "{name}"\nlink = {number}\npoint = "{point}"\nmagnitude = "50 N"\n'
        'direction = "0 deg"\n'
    )


SLIDER = '[[mechanism.pair]]\nkind = "prismatic"\npoint = "C"\nlinks = [3, 0]\nthrough = ["0 mm", "0 mm"]\n'
LEVER = link(4, 'D = ["0 mm", "0 mm"], E = ["200 mm", "0 mm"]')

# What is replaced by what; the key of the first fault; what its line names, and what its message says was expected.
BROKEN: dict[str, tuple[Sequence[tuple[str, str]], str, str, str]] = {
    "guide without a direction": ([(PAIR_AT_C, SLIDER)], "key-missing", "mechanism.pair", "'direction' is missing"),
    "guide through no point": (
        [(PAIR_AT_C, SLIDER.replace('through = ["0 mm", "0 mm"]', 'direction = "0 deg"'))],
        "key-missing",
        "mechanism.pair",
        "'through' is missing",
    ),
    "mobility nought, with a brace": (
        [
            (COUPLE, link(4, 'S2 = ["0 mm", "0 mm"], S3 = ["200 mm", "0 mm"]') + COUPLE),
            (PAIR_AT_C, PAIR_AT_C + pair("S2", "2, 4") + pair("S3", "3, 4")),
        ],
        "links-rigid",
        "mechanism.link",
        "links 2, 3, 4 cannot move against one another: one of their pairs or links is redundant (mobility W = 0",
    ),
    "mobility two": (
        [
            (AT_C, 'point = "C"\nlinks = [3, 4]\n'),
            (COUPLE, link(4, 'C = ["0 mm", "0 mm"], D = ["200 mm", "0 mm"]') + COUPLE),
            (PAIR_AT_C[:20], pair("D", "4, 0", 'at = ["400 mm", "0 mm"]\n') + PAIR_AT_C[:20]),
        ],
        "links-free",
        "mechanism.link",
        "nothing holds links 2, 3, 4: mobility W = 2 with 4 moving links and 5 pairs, expected W = 1",
    ),
    "rocker without its pivot": ([(PAIR_AT_C, "")], "link-loose", "mechanism.link", "link 3 hangs loose: its pairs: 1"),
    "link with one pair": (
        [(COUPLE, LEVER + COUPLE), (LINK_3, LINK_3.replace("S3", "D")), (PAIR_AT_C, PAIR_AT_C + pair("D", "3, 4"))],
        "point-unknown",
        "mechanism.link.centre",
        "it has: C, B, D",
    ),
    "link without pairs": (
        [(COUPLE, LEVER + COUPLE)],
        "link-loose",
        "mechanism.link",
        "link 4 hangs loose: its pairs: 0, expected 2 or more (mobility W = 4",
    ),
    "links off the frame": (
        [
            (
                COUPLE,
                link(4, 'D = ["0 mm", "0 mm"], E = ["9 mm", "0 mm"]')
                + link(5, 'D = ["0 mm", "0 mm"], E = ["9 mm", "0 mm"]')
                + pair("D", "4, 5")
                + pair("E", "4, 5")
                + COUPLE,
            )
        ],
        "links-apart",
        "mechanism.link",
        "no chain of pairs leads from links 4, 5 to the frame (link 0)",
    ),
    "two drivers": ([(DRIVER, DRIVER + 'link = 3\npivot = "C"\n' + DRIVER)], "toml-twice", "", "stated a second time"),
    "two drivers in a list": ([(DRIVER, "[[mechanism.driver]]\n")], "driver-twice", "mechanism.driver", "one driver"),
    "driver off the frame": (
        [('link = 1\npivot = "O"\npoint = "A"', 'link = 2\npivot = "A"\npoint = "B"')],
        "driver-pivot",
        "mechanism.driver.pivot",
        "the driver, link 2, turns about a revolute pair with the frame (link 0), and this is none",
    ),
    "driver at rest": ([('speed = "n_1"', 'speed = "0 rpm"')], "not-positive", "speed", "must be greater than zero"),
    "unknown point in a load": (
        [(COUPLE, force(3, "K") + COUPLE)],
        "point-unknown",
        "mechanism.load.point",
        "link 3 has no point 'K'; it has: C, B, S3",
    ),
    "load on the frame": (
        [(COUPLE, force(0, "C") + COUPLE)],
        "load-frame",
        "mechanism.load.link",
        "link 0 is the frame; a load acts on a moving link, one of: 1, 2, 3",
    ),
    "couple on no link": ([("link = 3\nmagn", "link = 5\nmagn")], "link-unknown", "mechanism.couple.link", "there are"),
    "unknown link in a pair": ([("links = [2, 3]", "links = [2, 4]")], "link-unknown", "links", "there is no link 4"),
    "point of another link in a pair": (
        [('point = "B"\nlinks = [2, 3]', 'point = "O"\nlinks = [2, 3]')],
        "point-unknown",
        "mechanism.pair.point",
        "link 2 has no point 'O'; it has: A, B, S2",
    ),
    "pivot without a place": ([(AT_C, AT_C.split("at = ")[0])], "key-missing", "mechanism.pair", "'at' is missing"),
    "place in a pair of moving links": (
        [(AT_B, AT_B + 'at = ["0 mm", "0 mm"]\n')],
        "pair-at",
        "mechanism.pair.at",
        "with the frame (link 0) only",
    ),
    "pair of a link with itself": (
        [("links = [2, 3]", "links = [3, 3]")],
        "pair-same",
        "mechanism.pair.links",
        "two different links, not link 3 with itself",
    ),
    "wrong kind of pair": (
        [('kind = "revolute"\n' + AT_B, 'kind = "hinge"\n' + AT_B)],
        "pair-kind",
        "mechanism.pair.kind",
        "'hinge' is not a kind of pair; expected one of: revolute, prismatic",
    ),
    "joints that coincide": (
        [('B = ["220 mm", "0 mm"]', 'B = ["0 mm", "0 mm"]')],
        "joints-coincide",
        "mechanism.link",
        "link 3: its joints C and B coincide",
    ),
    "length of nought": ([("l_AB = 260", "l_AB = 0")], "not-positive", "variant.l_AB", "must be greater than zero"),
    "negative mass": ([('"2.4 kg"', '"-2.4 kg"')], "negative", "mechanism.link.mass", "must not be negative"),
    "negative mass of a variant": ([("m_2 = 2.6", "m_2 = -2.6")], "negative", "variant.m_2", "must not be negative"),
    "mass without a centre": ([('centre = "S3"\n', "")], "key-missing", "mechanism.link", "'centre' is missing"),
    "missing branch": (
        [("branch = 1\n", "")],
        "branch-missing",
        "mechanism.pair",
        "expected branch = 1 where B lies to the left of the way from A to C, or branch = -1",
    ),
    "branch at the crank": (
        [("links = [1, 2]\n", "links = [1, 2]\nbranch = 1\n")],
        "branch-needless",
        "mechanism.pair.branch",
        "'branch' means nothing at A: it is for the inner pair of a dyad of three revolute pairs",
    ),
    "point in Cyrillic": (
        [('point = "A"\nlinks', 'point = "\u0410"\nlinks')],
        "name-cyrillic",
        "mechanism.pair.point",
        "character 1 is a Cyrillic letter; type the Latin A",
    ),
    "length in Cyrillic": (
        [('"l_AB"', '"l_A\u0412"')],
        "name-cyrillic",
        "mechanism.link.points.B",
        "character 4 is a Cyrillic letter; type the Latin B",
    ),
    "letter of a point in Cyrillic": (
        [('points = { C = ["0 mm"', 'points = { \u0421 = ["0 mm"')],
        "name-cyrillic",
        "",
        "type the Latin C",
    ),
    "point with a dash": (
        [('point = "A"\nlinks', 'point = "A-1"\nlinks')],
        "type-name",
        "mechanism.pair.point",
        "'A-1' is no name; expected a Latin letter",
    ),
    "letters of a length turned round": (
        [('"l_AB"', '"l_BA"')],
        "value-unknown-like",
        "mechanism.link.points.B",
        "did you mean 'l_AB'?",
    ),
    "length without a unit": ([('"220 mm"', "220")], "unit-missing", "points.B", "expected one such as mm"),
    "speed without a unit": ([('speed = "n_1"', "speed = 120")], "unit-missing", "driver.speed", "one such as rpm"),
    "unit without quotes": (
        [("phi = 60", "phi = 60 deg")],
        "toml-bare",
        "",
        "a value with a unit or a decimal comma stands in quotes",
    ),
    "comma without quotes": ([("l_OA = 100", "l_OA = 100,5")], "toml-bare", "", "stands in quotes"),
    "branch of two": ([("branch = 1\n", "branch = 2\n")], "sign-bad", "branch", "'2': a sense or a branch is 1 or -1"),
    "group of class four": (
        [
            ('l_AB", "0 mm"]', 'l_AB", "0 mm"], F = ["90 mm", "60 mm"]'),
            (LINK_3, 'points = { B = ["0 mm", "0 mm"], D = ["150 mm", "0 mm"], S3 = ["70 mm", "0 mm"] }\n'),
            (
                PAIR_AT_C,
                link(4, 'D = ["0 mm", "0 mm"], E = ["150 mm", "0 mm"], C = ["90 mm", "90 mm"]')
                + link(5, 'E = ["0 mm", "0 mm"], F = ["150 mm", "0 mm"]')
                + pair("D", "3, 4")
                + pair("E", "4, 5")
                + pair("F", "5, 2")
                + pair("C", "4, 0", 'at = ["280 mm", "0 mm"]\n'),
            ),
        ],
        "no-construction",
        "mechanism.link",
        "links 2, 3, 4, 5 form a group of class IV, for which there is no construction; with another link",
    ),
    "unknown unit": ([('"2.4 kg"', '"2.4 kq"')], "unit-unknown", "mechanism.link.mass", "unknown unit 'kq'; known are"),
    "no unit": (
        [('"2.4 kg"', "2.4")],
        "unit-missing",
        "mechanism.link.mass",
        "'2.4' has no unit; expected one such as kg",
    ),
    "unit of another kind": ([('"280 mm"', '"280 deg"')], "value-wrong", "mechanism.pair.at", "expected one in m"),
    "unknown name": ([('"l_AS2", ', '"l_AC2", ')], "value-unknown-like", "points.S2", "did you mean 'l_AS2'?"),
    "letter of two points": (
        [('S3 = ["110', 'A = ["110'), ('centre = "S3"', 'centre = "A"')],
        "name-twice",
        "mechanism.link.points.A",
        "'A' would name two different things",
    ),
    "point twice": ([('S3 = ["110', 'B = ["110')], "toml-twice", "", "'B' is stated a second time"),
    "link twice": ([("number = 3\n", "number = 2\n")], "link-number", "mechanism.link.number", "different numbers"),
    "two loads of one name": (
        [(COUPLE, force(3, "B") + force(2, "B") + COUPLE)],
        "id-twice",
        "mechanism.load.name",
        "'F_3' stands here a second time",
    ),
    "variant without a given": ([("n_1 = 120\n", "")], "key-missing", "variant", "'n_1' is missing"),
}


# The same of a press with a load diagram over its stroke, and of one with a group of class III.
PRESS, AUTOMATON = bundled_text("scheme-13-toggle-press"), bundled_text("scheme-20-press-automaton")
START = AUTOMATON[AUTOMATON.index("[[mechanism.start]]") : AUTOMATON.index("[mechanism.stroke]")]
RAM = PRESS[PRESS.index('[[mechanism.pair]]\nkind = "prismatic"') : PRESS.index("[mechanism.driver]")]
LOADED: dict[str, tuple[str, Sequence[tuple[str, str]], str, str, str]] = {
    "stroke of a link off the frame": (
        PRESS,
        [("[mechanism.stroke]\nlink = 5", "[mechanism.stroke]\nlink = 4")],
        "stroke-link",
        "mechanism.stroke.link",
        "link 4 is not an output: expected a slider or a rocker on the frame that does not drive",
    ),
    "stroke of the driver": (
        PRESS,
        [("[mechanism.stroke]\nlink = 5", "[mechanism.stroke]\nlink = 1")],
        "stroke-link",
        "mechanism.stroke.link",
        "link 1 is not an output",
    ),
    "load in a stroke of nothing": (
        PRESS,
        [("[mechanism.stroke]\nlink = 5\n", "")],
        "stroke-missing",
        "mechanism.load",
        "no output is named: expected [mechanism.stroke] with the key 'link'",
    ),
    "diagram with unequal columns": (
        PRESS,
        [('values = ["0 N", "0 N", ', 'values = ["0 N", ')],
        "diagram-uneven",
        "mechanism.diagram.values",
        "the diagram has 5 places, but 4 values here",
    ),
    "diagram with places that decrease": (
        PRESS,
        [("at = [0, 0.35, 0.35, 0.9, 1]", "at = [0, 0.35, 0.3, 0.9, 1]")],
        "diagram-stroke",
        "mechanism.diagram.at",
        "parts of the stroke from 0 to 1 and must not decrease",
    ),
    "diagram over nothing": (
        PRESS,
        [('over = "stroke"', 'over = "time"')],
        "diagram-over",
        "mechanism.diagram.over",
        "expected one of: stroke, angle",
    ),
    "load in no stroke": (
        PRESS,
        [('stroke = "working"', 'stroke = "work"')],
        "stroke-unknown-like",
        "mechanism.load.stroke",
        "did you mean 'working'?",
    ),
    "load by an unknown diagram": (
        PRESS,
        [('magnitude = "p_drawing"', 'magnitude = "p_press"')],
        "value-unknown",
        "mechanism.load.magnitude",
        "'p_press' is neither a given nor set by a choice",
    ),
    "force that resists a pivot": (
        PRESS,
        [('link = 5\npoint = "D"\nmagnitude', 'link = 3\npoint = "C"\nmagnitude')],
        "load-still",
        "mechanism.load",
        "C is a pivot and does not move, so that there is nothing to resist",
    ),
    "mass twice": (
        PRESS,
        [('per_length = "q"\n', 'per_length = "q"\nmass = "2 kg"\n')],
        "follows-from",
        "mechanism.link.mass",
        "'mass' follows from 'per_length': state one of them",
    ),
    "gravity without a unit": (
        PRESS,
        [('"9.81 m/s^2"', "9.81")],
        "unit-missing",
        "mechanism.gravity",
        "expected one such as m/s^2",
    ),
    "triad without a start": (
        AUTOMATON,
        [(START, "")],
        "start-missing",
        "mechanism.link",
        "say in [[mechanism.start]] where its central link 3 stands",
    ),
    "start of a leg": (
        AUTOMATON,
        [("[[mechanism.start]]\nlink = 3", "[[mechanism.start]]\nlink = 4")],
        "start-leg",
        "mechanism.start.link",
        "the central link of a group of class III: of link 3, not of link 4",
    ),
    "branch in a triad": (
        AUTOMATON,
        [('point = "C"\nlinks = [3, 4]\n', 'point = "C"\nlinks = [3, 4]\nbranch = 1\n')],
        "branch-triad",
        "mechanism.pair.branch",
        "means nothing at C, a pair of a group of class III: [[mechanism.start]] says which way",
    ),
    "output without its guide": (
        PRESS,
        [(RAM, "")],
        "link-loose",
        "mechanism.link",
        "link 5 hangs loose: its pairs: 1",
    ),
    "output without its guide, its stroke": (
        PRESS,
        [(RAM, "")],
        "stroke-link",
        "mechanism.stroke.link",
        "link 5 is not an output",
    ),
    "start at no angle": (
        AUTOMATON,
        [('driver = "90 deg"\n', "")],
        "key-missing",
        "mechanism.start",
        "the key 'driver' is missing",
    ),
}


def broken(name: str) -> str:
    """Return a good file with its fault."""
    text, edits = (GOOD, BROKEN[name][0]) if name in BROKEN else LOADED[name][:2]
    for old, new in edits:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text
