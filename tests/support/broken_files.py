"""Files of mechanisms with one fault each: what is changed, and what is to be said of it."""

from __future__ import annotations

from kulman.variants.making.starter import _template
from kulman.variants.shelf import bundled_text

GOOD = _template("en")
AT_C = 'point = "C"\nlinks = [3, 0]\nat = ["280 mm", "0 mm"]\n'
AT_B = 'point = "B"\nlinks = [2, 3]\nbranch = 1\n'
LINK_3 = 'points = { C = ["0 mm", "0 mm"], B = ["220 mm", "0 mm"], S3 = ["110 mm", "0 mm"] }\n'
PAIR_AT_C = '[[mechanism.pair]]\nkind = "revolute"\n' + AT_C
DRIVER = "[mechanism.driver]\n"
COUPLE = "[[mechanism.couple]]\n"


def link(number: int, points: str) -> str:
    return f"[[mechanism.link]]\nnumber = {number}\npoints = {{ {points} }}\n"


def pair(point: str, links: str, more: str = "") -> str:
    return f'[[mechanism.pair]]\nkind = "revolute"\npoint = "{point}"\nlinks = [{links}]\n{more}'


def force(number: int, point: str, name: str = "F_3") -> str:
    return (
        f'[[mechanism.load]]\nname = "{name}"\nlink = {number}\npoint = "{point}"\nmagnitude = "50 N"\n'
        'direction = "0 deg"\n'
    )


SLIDER = '[[mechanism.pair]]\nkind = "prismatic"\npoint = "C"\nlinks = [3, 0]\nthrough = ["0 mm", "0 mm"]\n'
LEVER = link(4, 'D = ["0 mm", "0 mm"], E = ["200 mm", "0 mm"]')

# The key of the first fault; what its line names, and what its message says; then what is replaced by what, in turns.
BROKEN: dict[str, tuple[str, ...]] = {
    "guide without a direction": ("key-missing", "mechanism.pair", "'direction' is missing", PAIR_AT_C, SLIDER),
    "guide through no point": ("key-missing", "mechanism.pair", "'through' is missing", PAIR_AT_C,
        SLIDER.replace('through = ["0 mm", "0 mm"]', 'direction = "0 deg"')),
    "mobility nought, with a brace": ("links-rigid", "mechanism.link",
        "links 2, 3, 4 cannot move against one another: one of their pairs or links is redundant (mobility W = 0",
        COUPLE, link(4, 'S2 = ["0 mm", "0 mm"], S3 = ["200 mm", "0 mm"]') + COUPLE, PAIR_AT_C,
        PAIR_AT_C + pair("S2", "2, 4") + pair("S3", "3, 4")),
    "mobility two": ("links-free", "mechanism.link",
        "nothing holds links 2, 3, 4: mobility W = 2 with 4 moving links and 5 pairs, expected W = 1", AT_C,
        'point = "C"\nlinks = [3, 4]\n', COUPLE, link(4, 'C = ["0 mm", "0 mm"], D = ["200 mm", "0 mm"]') + COUPLE,
        PAIR_AT_C[:20], pair("D", "4, 0", 'at = ["400 mm", "0 mm"]\n') + PAIR_AT_C[:20]),
    "rocker without its pivot": ("link-loose", "mechanism.link", "link 3 hangs loose: its pairs: 1", PAIR_AT_C, ""),
    "link with one pair": ("point-unknown", "mechanism.link.centre", "it has: C, B, D", COUPLE, LEVER + COUPLE, LINK_3,
        LINK_3.replace("S3", "D"), PAIR_AT_C, PAIR_AT_C + pair("D", "3, 4")),
    "link without pairs": ("link-loose", "mechanism.link",
        "link 4 hangs loose: its pairs: 0, expected 2 or more (mobility W = 4", COUPLE, LEVER + COUPLE),
    "links off the frame": ("links-apart", "mechanism.link",
        "no chain of pairs leads from links 4, 5 to the frame (link 0)", COUPLE,
        link(4, 'D = ["0 mm", "0 mm"], E = ["9 mm", "0 mm"]') + link(5, 'D = ["0 mm", "0 mm"], E = ["9 mm", "0 mm"]')
        + pair("D", "4, 5") + pair("E", "4, 5") + COUPLE),
    "two drivers": ("toml-twice", "", "stated a second time", DRIVER, DRIVER + 'link = 3\npivot = "C"\n' + DRIVER),
    "two drivers in a list": ("driver-twice", "mechanism.driver", "one driver", DRIVER, "[[mechanism.driver]]\n"),
    "driver off the frame": ("driver-pivot", "mechanism.driver.pivot",
        "the driver, link 2, turns about a revolute pair with the frame (link 0), and this is none",
        'link = 1\npivot = "O"\npoint = "A"', 'link = 2\npivot = "A"\npoint = "B"'),
    "driver at rest": ("not-positive", "speed", "must be greater than zero", 'speed = "n_1"', 'speed = "0 rpm"'),
    "unknown point in a load": ("point-unknown", "mechanism.load.point", "link 3 has no point 'K'; it has: C, B, S3",
        COUPLE, force(3, "K") + COUPLE),
    "load on the frame": ("load-frame", "mechanism.load.link",
        "link 0 is the frame; a load acts on a moving link, one of: 1, 2, 3", COUPLE, force(0, "C") + COUPLE),
    "couple on no link": ("link-unknown", "mechanism.couple.link", "there are", "link = 3\nmagn", "link = 5\nmagn"),
    "unknown link in a pair": ("link-unknown", "links", "there is no link 4", "links = [2, 3]", "links = [2, 4]"),
    "point of another link in a pair": ("point-unknown", "mechanism.pair.point",
        "link 2 has no point 'O'; it has: A, B, S2", 'point = "B"\nlinks = [2, 3]', 'point = "O"\nlinks = [2, 3]'),
    "pivot without a place": ("key-missing", "mechanism.pair", "'at' is missing", AT_C, AT_C.split("at = ")[0]),
    "place in a pair of moving links": ("pair-at", "mechanism.pair.at", "with the frame (link 0) only", AT_B,
        AT_B + 'at = ["0 mm", "0 mm"]\n'),
    "pair of a link with itself": ("pair-same", "mechanism.pair.links", "two different links, not link 3 with itself",
        "links = [2, 3]", "links = [3, 3]"),
    "wrong kind of pair": ("pair-kind", "mechanism.pair.kind",
        "'hinge' is not a kind of pair; expected one of: revolute, prismatic", 'kind = "revolute"\n' + AT_B,
        'kind = "hinge"\n' + AT_B),
    "joints that coincide": ("joints-coincide", "mechanism.link", "link 3: its joints C and B coincide",
        'B = ["220 mm", "0 mm"]', 'B = ["0 mm", "0 mm"]'),
    "length of nought": ("not-positive", "variant.l_AB", "must be greater than zero", "l_AB = 260", "l_AB = 0"),
    "negative mass": ("negative", "mechanism.link.mass", "must not be negative", '"2.4 kg"', '"-2.4 kg"'),
    "negative mass of a variant": ("negative", "variant.m_2", "must not be negative", "m_2 = 2.6", "m_2 = -2.6"),
    "mass without a centre": ("key-missing", "mechanism.link", "'centre' is missing", 'centre = "S3"\n', ""),
    "missing branch": ("branch-missing", "mechanism.pair",
        "expected branch = 1 where B lies to the left of the way from A to C, or branch = -1", "branch = 1\n", ""),
    "branch at the crank": ("branch-needless", "mechanism.pair.branch",
        "'branch' means nothing at A: it is for the inner pair of a dyad of three revolute pairs", "links = [1, 2]\n",
        "links = [1, 2]\nbranch = 1\n"),
    "point in Cyrillic": ("name-cyrillic", "mechanism.pair.point", "character 1 is a Cyrillic letter; type the Latin A",
        'point = "A"\nlinks', 'point = "\u0410"\nlinks'),
    "length in Cyrillic": ("name-cyrillic", "mechanism.link.points.B",
        "character 4 is a Cyrillic letter; type the Latin B", '"l_AB"', '"l_A\u0412"'),
    "letter of a point in Cyrillic": ("name-cyrillic", "", "type the Latin C", 'points = { C = ["0 mm"',
        'points = { \u0421 = ["0 mm"'),
    "point with a dash": ("type-name", "mechanism.pair.point", "'A-1' is no name; expected a Latin letter",
        'point = "A"\nlinks', 'point = "A-1"\nlinks'),
    "letters of a length turned round": ("value-unknown-like", "mechanism.link.points.B", "did you mean 'l_AB'?",
        '"l_AB"', '"l_BA"'),
    "length without a unit": ("unit-missing", "points.B", "expected one such as mm", '"220 mm"', "220"),
    "speed without a unit": ("unit-missing", "driver.speed", "one such as rpm", 'speed = "n_1"', "speed = 120"),
    "unit without quotes": ("toml-bare", "", "stands in straight quotes: phi = \"60 deg\"", "phi = 60",
        "phi = 60 deg"),
    "comma without quotes": ("toml-bare", "", "stands in straight quotes", "l_OA = 100", "l_OA = 100,5"),
    "branch of two": ("sign-bad", "branch", "'2': a sense or a branch is 1 or -1", "branch = 1\n", "branch = 2\n"),
    "group of class four": ("no-construction", "mechanism.link",
        "links 2, 3, 4, 5 form a group of class IV, for which there is no construction; with another link",
        'l_AB", "0 mm"]', 'l_AB", "0 mm"], F = ["90 mm", "60 mm"]', LINK_3,
        'points = { B = ["0 mm", "0 mm"], D = ["150 mm", "0 mm"], S3 = ["70 mm", "0 mm"] }\n', PAIR_AT_C,
        link(4, 'D = ["0 mm", "0 mm"], E = ["150 mm", "0 mm"], C = ["90 mm", "90 mm"]')
        + link(5, 'E = ["0 mm", "0 mm"], F = ["150 mm", "0 mm"]') + pair("D", "3, 4") + pair("E", "4, 5")
        + pair("F", "5, 2") + pair("C", "4, 0", 'at = ["280 mm", "0 mm"]\n')),
    "unknown unit": ("unit-unknown", "mechanism.link.mass", "unknown unit 'kq'; known are", '"2.4 kg"', '"2.4 kq"'),
    "no unit": ("unit-missing", "mechanism.link.mass", "'2.4' has no unit; expected one such as kg", '"2.4 kg"', "2.4"),
    "unit of another kind": ("value-wrong", "mechanism.pair.at", "expected one in m", '"280 mm"', '"280 deg"'),
    "unknown name": ("value-unknown-like", "points.S2", "did you mean 'l_AS2'?", '"l_AS2", ', '"l_AC2", '),
    "letter of two points": ("name-twice", "mechanism.link.points.A", "'A' would name two different things",
        'S3 = ["110', 'A = ["110', 'centre = "S3"', 'centre = "A"'),
    "point twice": ("toml-twice", "", "'B' is stated a second time", 'S3 = ["110', 'B = ["110'),
    "link twice": ("link-number", "mechanism.link.number", "different numbers", "number = 3\n", "number = 2\n"),
    "two loads of one name": ("id-twice", "mechanism.load.name", "'F_3' stands here a second time", COUPLE,
        force(3, "B") + force(2, "B") + COUPLE),
    "variant without a given": ("key-missing", "variant", "'n_1' is missing", "n_1 = 120\n", ""),
}  # fmt: skip


# The same of a press with a load diagram over its stroke, and of one with a group of class III.
PRESS, AUTOMATON = bundled_text("scheme-13-toggle-press"), bundled_text("scheme-20-press-automaton")
START = AUTOMATON[AUTOMATON.index("[[mechanism.start]]") : AUTOMATON.index("[mechanism.stroke]")]
RAM = PRESS[PRESS.index('[[mechanism.pair]]\nkind = "prismatic"') : PRESS.index("[mechanism.driver]")]
LOADED: dict[str, tuple[str, ...]] = {  # the good text first
    "stroke of a link off the frame": (PRESS, "stroke-link", "mechanism.stroke.link",
        "link 4 is not an output: expected a slider or a rocker on the frame that does not drive",
        "[mechanism.stroke]\nlink = 5", "[mechanism.stroke]\nlink = 4"),
    "stroke of the driver": (PRESS, "stroke-link", "mechanism.stroke.link", "link 1 is not an output",
        "[mechanism.stroke]\nlink = 5", "[mechanism.stroke]\nlink = 1"),
    "load in a stroke of nothing": (PRESS, "stroke-missing", "mechanism.load",
        "no output is named: expected [mechanism.stroke] with the key 'link'", "[mechanism.stroke]\nlink = 5\n", ""),
    "diagram with unequal columns": (PRESS, "diagram-uneven", "mechanism.diagram.values",
        "the diagram has 5 places, but 4 values here", 'values = ["0 N", "0 N", ', 'values = ["0 N", '),
    "diagram with places that decrease": (PRESS, "diagram-stroke", "mechanism.diagram.at",
        "parts of the stroke from 0 to 1 and must not decrease", "at = [0, 0.35, 0.35, 0.9, 1]",
        "at = [0, 0.35, 0.3, 0.9, 1]"),
    "diagram over nothing": (PRESS, "diagram-over", "mechanism.diagram.over", "expected one of: stroke, angle",
        'over = "stroke"', 'over = "time"'),
    "load in no stroke": (PRESS, "stroke-unknown-like", "mechanism.load.stroke", "did you mean 'working'?",
        'stroke = "working"', 'stroke = "work"'),
    "load by an unknown diagram": (PRESS, "value-unknown", "mechanism.load.magnitude",
        "'p_press' is neither a given nor set by a choice", 'magnitude = "p_drawing"', 'magnitude = "p_press"'),
    "force that resists a pivot": (PRESS, "load-still", "mechanism.load",
        "C is a pivot and does not move, so that there is nothing to resist", 'link = 5\npoint = "D"\nmagnitude',
        'link = 3\npoint = "C"\nmagnitude'),
    "mass twice": (PRESS, "follows-from", "mechanism.link.mass", "'mass' follows from 'per_length': state one of them",
        'per_length = "q"\n', 'per_length = "q"\nmass = "2 kg"\n'),
    "gravity without a unit": (PRESS, "unit-missing", "mechanism.gravity", "expected one such as m/s^2", '"9.81 m/s^2"',
        "9.81"),
    "triad without a start": (AUTOMATON, "start-missing", "mechanism.link",
        "say in [[mechanism.start]] where its central link 3 stands", START, ""),
    "start of a leg": (AUTOMATON, "start-leg", "mechanism.start.link",
        "the central link of a group of class III: of link 3, not of link 4", "[[mechanism.start]]\nlink = 3",
        "[[mechanism.start]]\nlink = 4"),
    "branch in a triad": (AUTOMATON, "branch-triad", "mechanism.pair.branch",
        "means nothing at C, a pair of a group of class III: [[mechanism.start]] says which way",
        'point = "C"\nlinks = [3, 4]\n', 'point = "C"\nlinks = [3, 4]\nbranch = 1\n'),
    "output without its guide": (PRESS, "link-loose", "mechanism.link", "link 5 hangs loose: its pairs: 1", RAM, ""),
    "output without its guide, its stroke": (PRESS, "stroke-link", "mechanism.stroke.link", "link 5 is not an output",
        RAM, ""),
    "start at no angle": (AUTOMATON, "key-missing", "mechanism.start", "the key 'driver' is missing",
        'driver = "90 deg"\n', ""),
}  # fmt: skip


def broken(name: str) -> tuple[str, str, str, str]:
    """Return a good file with its fault; key, place and words of the fault."""
    text, key, place, said, *edits = (GOOD, *BROKEN[name]) if name in BROKEN else LOADED[name]
    for old, new in zip(edits[::2], edits[1::2], strict=True):
        assert old in text, old
        text = text.replace(old, new, 1)
    return text, key, place, said
