"""What is asked in the browser of photographs that are not sure: one question a page, a click or a key for each answer.

What has been handed in is kept with its questions and answers in the memory of the server, the longest unused going
first. Where a vector ends is chosen by links, so that no script is needed; with one any place of the picture can be.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path

from ..marking.reading import Ends
from ..photos.asking import ENTRY, OUT, Asking, EndAsk, PageAsk, Told
from ..photos.pictures import PICTURES
from .making import Handed, as_sent
from .pages import Door, Html, note, page, scripted, tag, typed
from .pages import field as labelled

NEAR = 22.0  # mm shown around a vector
FEWEST = 55.0  # mm of a side that is shown
POINT = 0.009  # part of the picture that a spot has
HEAD, PART, WING = 4.0, 0.5, cmath.rect(1.0, 0.2)  # spots, or part of its vector, of an arrowhead; its half angle
RING, REACH = 1.8, 2.2  # spots of the ring at a tail; that can be pressed
PASSED = "?"  # what is answered where nothing can be told
Box = tuple[float, float, float, float]


@dataclass(slots=True)
class Sitting:
    """What has been handed in, what is asked of it, and what has been answered; `back` is the page it came from.

    `students` are those of the roster, with their numbers there.
    """

    name: str
    handed: Handed
    back: str
    asking: Asking = field(default_factory=Asking)
    pages: dict[str, str] = field(default_factory=dict)
    ends: dict[tuple[str, str], Ends | None] = field(default_factory=dict)
    passed: set[str] = field(default_factory=set)

    @property
    def told(self) -> Told:
        """What has been answered."""
        return Told({**self.pages}, {**self.ends}, frozenset(self.passed))

    @property
    def asks(self) -> tuple[PageAsk | EndAsk, ...]:
        """All questions."""
        return *self.asking.pages, *self.asking.ends

    def answered(self, ask: PageAsk | EndAsk) -> bool:
        """Whether there is nothing more to ask."""
        if isinstance(ask, PageAsk):
            return self.passed.issuperset(ask.names)
        return f"{ask.page} {ask.name}" in self.passed or self.pages.get(ask.page) == OUT

    @property
    def left(self) -> list[int]:
        """The numbers of questions that have not been answered, from 1."""
        return [number for number, ask in enumerate(self.asks, 1) if not self.answered(ask)]

    def answer(self, ask: PageAsk | EndAsk, said: str, ends: Ends | None) -> None:
        """Note what is said to a question: of pages whose they are, or which counts; of a vector its ends, or none."""
        if isinstance(ask, EndAsk):
            self.passed.add(f"{ask.page} {ask.name}")
            self.ends.pop((ask.page, ask.name), None)
            if said == OUT or (said != PASSED and ends is not None):
                self.ends[ask.page, ask.name] = None if said == OUT else ends
            return
        self.passed.update(ask.names)
        if ask.kind == "which":
            self.pages.update((one, OUT) for one in ask.pages if said in ask.pages and one != said)
            if self.pages.get(said) == OUT:
                self.pages.pop(said)
        elif said and said != PASSED:
            self.pages.update(dict.fromkeys(ask.pages, said))

    def believed(self, ask: EndAsk) -> tuple[complex | None, complex | None]:
        """Return where a vector begins and ends, as it was read, or as answers to other questions tell."""
        at = dict[int, complex]()
        for one in self.asking.ends:
            ends = self.ends.get((one.page, one.name))
            if ends is not None and (one.page, one.plan) == (ask.page, ask.plan):
                at |= dict(zip(one.marks, ends, strict=True))
        own = self.ends.get((ask.page, ask.name)) or (ask.tail, ask.tip)
        tail, tip = (at.get(mark) if end is None else end for mark, end in zip(ask.marks, own, strict=True))
        return tail, tip

    def sent(self, source: str) -> int:
        """Return which of the files that came a name of ours is, from 0; -1 where it is none of them."""
        number = source.rpartition("/")[2].partition("-")[0]
        return int(number) - 1 if number.isdecimal() and 0 < int(number) <= len(self.handed.files) else -1

    def shown(self, text: str) -> str:
        """Return a text with the names of files as they have come."""
        return as_sent(text, self.handed.sent)


def size_of(sitting: Sitting) -> int:
    """Return how many bytes a sitting takes."""
    asked = sum(len(picture) for ask in sitting.asking.pages for picture in ask.pictures)
    return asked + sum(map(len, sitting.asking.pictures.values())) + sum(len(one.data) for one in sitting.handed.files)


def _head(door: Door, sitting: Sitting, ask: PageAsk | EndAsk, chosen: Chosen) -> str:
    """Return what a question asks."""
    said = door.said
    if isinstance(ask, PageAsk):
        return said[f"ask.{ask.kind}"].format(number=ask.number)
    tail, tip = chosen.over(*sitting.believed(ask))
    key = "ask.is" if tail is not None and tip is not None else "ask.end" if tail is not None else "ask.begin"
    return said[key].format(symbol=ask.symbol)


def _of_whom(sitting: Sitting, ask: PageAsk | EndAsk) -> str:
    """Return whom a question is about, and where."""
    if isinstance(ask, PageAsk):
        parts = [ask.who, *dict.fromkeys(map(sitting.shown, ask.sources))]
    else:
        parts = [ask.who or sitting.shown(ask.source), ask.plan]
    return " · ".join(filter(None, parts))


def overview(door: Door, sitting: Sitting) -> str:
    """Return the page with all questions, and what marks with their answers."""
    said, path, left = door.said, f"/asked/{sitting.name}", sitting.left
    rows = (
        tag(
            "li",
            tag("a", scripted(_head(door, sitting, ask, Chosen())), href=door.link(f"{path}/{number}")),
            tag("span", _of_whom(sitting, ask)),
            tag("span", said["ask.open" if number in left else "ask.answered"]),
        )
        for number, ask in enumerate(sitting.asks, 1)
    )
    first = tag("a", said["ask.go"], href=door.link(f"{path}/{left[0]}"), class_="button main") if left else None
    done = tag("button", said["ask.mark"], type="submit", class_="main" if not left else None, id="done")
    return page(
        door,
        said["ask.title"],
        tag("p", tag("a", f"← {said['ask.back']}", href=sitting.back)),
        *(note(sitting.shown(door.told(problem)), kind="problem") for problem in sitting.asking.notes),
        tag("p", said["ask.about"].format(n=len(left), of=len(sitting.asks))),
        tag("form", first, " ", done, method="post", action=door.link(path), class_="buttons"),
        tag("ul", *rows, class_="files"),
        at=path,
    )


def question(door: Door, sitting: Sitting, number: int, students: Sequence[str], chosen: Chosen) -> str:
    """Return the page of one question; `students` are those of the roster."""
    said, path, ask = door.said, f"/asked/{sitting.name}", sitting.asks[number - 1]
    turns = [(number - 1, "ask.before"), (number + 1, "ask.after")]
    links = (
        tag("a", said[key], href=door.link(f"{path}/{n}"), class_="button")
        for n, key in turns
        if 1 <= n <= len(sitting.asks)
    )
    all_of = tag("a", said["ask.all"], href=door.link(path), class_="button")
    if isinstance(ask, PageAsk):
        body = [*_page_body(door, sitting, ask, f"{path}/{number}", students)]
    else:
        body = [*_end_body(door, sitting, ask, f"{path}/{number}", chosen)]
    about = f"{said['ask.count'].format(n=number, of=len(sitting.asks))} · {_of_whom(sitting, ask)}"
    title = _head(door, sitting, ask, chosen)
    nav = tag("nav", *links, all_of, aria_label=said["ask.title"], class_="buttons")
    inside = tag("p", about, class_="about"), *body, nav
    return page(door, title, *inside, at=f"{path}/{number}", heading=scripted(title))


def _page_body(door: Door, sitting: Sitting, ask: PageAsk, path: str, students: Sequence[str]) -> Iterable[Html]:
    said = door.said
    if ask.reason is not None:
        yield note(sitting.shown(door.told(ask.reason)), kind="problem")
    yield tag("p", said[f"ask.{ask.kind}_about"])

    def button(value: str, text: str, **how: str) -> Html:
        return tag("button", text, type="submit", name="say", value=value, **how)

    def picture(at: int) -> Html:
        number = sitting.sent(ask.sources[at])
        name = sitting.shown(ask.sources[at])
        if not ask.pictures and Path(name).suffix.lower() not in PICTURES:
            return tag("p", name)
        source = f"{path}/{at}.png" if ask.pictures else f"/asked/{sitting.name}/sent/{number}"
        return tag("img", src=door.link(source), alt=f"{said['ask.picture']}: {name}", class_="paper page")

    out = button(OUT, said["ask.out"])
    if ask.kind == "which":
        shown = (
            tag("figure", tag("figcaption", button(one, said["ask.keep"], id=f"keep-{n}", class_="main"),
                " ", sitting.shown(source)), picture(n))
            for n, (one, source) in enumerate(zip(ask.pages, ask.sources, strict=True))
        )  # fmt: skip
        parts = [tag("p", button(PASSED, said["ask.both"])), tag("div", *shown, class_="pair")]
    else:
        named = [button(f"{ENTRY}{n}", name) for n, name in enumerate(students)]
        written = [labelled(said["ask.name"], typed("who"), "who"), tag("button", said["ask.take"], type="submit")]
        choices = tag("div", *(named or written), class_="buttons", role="group", aria_label=said["ask.name"])
        parts = [choices, tag("p", out, " ", button(PASSED, said["ask.pass"])), picture(0)]
    yield tag("form", *parts, method="post", action=door.link(path))


# Where a vector ends.


@dataclass(frozen=True, slots=True)
class Chosen:
    """What the address of a question says: ends that have been moved, which one is being moved, how much is shown."""

    tail: complex | None = None
    tip: complex | None = None
    move: str = ""
    whole: bool = False

    def over(self, tail: complex | None, tip: complex | None) -> tuple[complex | None, complex | None]:
        """Return ends that are believed, or where they have been moved."""
        return (tail if self.tail is None else self.tail), (tip if self.tip is None else self.tip)


def _written(place: complex | None) -> str:
    """Return a place as an address has it."""
    return "" if place is None else f"{place.real:.2f},{place.imag:.2f}"


def place_of(text: str, box: Box) -> complex | None:
    """Return the place that an address has, if it is one within a box."""
    x, comma, y = text.partition(",")
    try:
        place = complex(float(x), float(y)) if comma else None
    except ValueError:
        return None
    inside = place is not None and box[0] <= place.real <= box[2] and box[1] <= place.imag <= box[3]
    return place if inside else None


def _end_body(door: Door, sitting: Sitting, ask: EndAsk, path: str, chosen: Chosen) -> Iterable[Html]:
    said = door.said
    tail, tip = chosen.over(*sitting.believed(ask))
    moved = chosen.move or ("tail" if tail is None else "tip")
    now = {"tail": _written(tail), "tip": _written(tip), "move": chosen.move, "whole": "1" if chosen.whole else ""}

    def link(fragment: str, **more: str) -> str:
        query = [(key, value) for key, value in {**now, **more}.items() if value]
        return f"{door.link(path, query)}#{fragment}"

    box = ask.box if chosen.whole else _near(ask.box, [place for place in (tail, tip) if place is not None])
    symbol = scripted(ask.symbol)
    yes = None
    if tail is not None and tip is not None:
        words = Html(escape(said["ask.yes"]).replace("{symbol}", symbol))
        yes = tag("button", words, type="submit", name="say", value="yes", id="yes", class_="main")
    yield tag(
        "form",
        *(tag("input", type="hidden", name=name, value=now[name]) for name in ("tail", "tip")),
        yes,
        tag("button", said["ask.none"], type="submit", name="say", value=OUT),
        tag("button", said["ask.pass"], type="submit", name="say", value=PASSED),
        method="post",
        action=door.link(path),
        class_="buttons",
    )
    ring = tail is None and tip is not None
    yield tag("p", said[f"ask.how_{moved}"], " ", said["ask.ring"] if ring else "", id="how")
    other, key = ("tip", "ask.tip") if moved == "tail" else ("tail", "ask.tail")
    views = None if box == ask.box and not chosen.whole else tag("a", said["ask.near" if chosen.whole else "ask.whole"],
                href=link("plan", whole="" if chosen.whole else "1"), class_="button")  # fmt: skip
    ways = tag("a", said[key], href=link("plan", move=other), class_="button") if yes is not None else None
    source = door.link(f"/asked/{sitting.name}/plan/{ask.picture}.png")
    yield _plan(door, ask, box, (tail, tip), moved, link, source)
    yield tag("p", ways, " ", views, class_="buttons")


def _near(box: Box, places: Sequence[complex]) -> Box:
    """Return the part of a box that is near to places; all of it where there are less than two."""
    if len(places) < 2:
        return box
    edges = list[tuple[float, float]]()
    for values, low, high in (
        ([place.real for place in places], box[0], box[2]),
        ([place.imag for place in places], box[1], box[3]),
    ):
        middle, half = (min(values) + max(values)) / 2.0, max((max(values) - min(values)) / 2.0 + NEAR, FEWEST / 2.0)
        edges.append((max(middle - half, low), min(middle + half, high)))
    (x0, x1), (y0, y1) = edges
    return x0, y0, x1, y1


def _plan(
    door: Door,
    ask: EndAsk,
    box: Box,
    ends: tuple[complex | None, complex | None],
    moved: str,
    link: Callable[..., str],
    source: str,
) -> Html:
    """Return the picture of a plan with what has been read over it, and the spots at which a vector may end."""
    x0, y0, x1, y1 = ask.box
    said = door.said

    def at(place: complex) -> tuple[str, str]:
        return f"{place.real - x0:.2f}", f"{y1 - place.imag:.2f}"

    def line(a: complex, b: complex, kind: str) -> Html:
        (ax, ay), (bx, by) = at(a), at(b)
        return tag("line", x1=ax, y1=ay, x2=bx, y2=by, class_=kind)

    def circle(place: complex, radius: float, kind: str) -> Html:
        x, y = at(place)
        return tag("circle", cx=x, cy=y, r=radius, class_=kind)

    tail, tip = ends
    dot = POINT * (box[2] - box[0])
    shown = [line(*other, "other") for other in ask.others]
    if tail is not None and tip is not None:
        back = (tail - tip) * min(HEAD * dot / (abs(tail - tip) or 1.0), PART)
        wings = (",".join(at(tip + back * turn)) for turn in (WING, WING.conjugate()))
        head = tag("polygon", points=" ".join((",".join(at(tip)), *wings)), class_="head")
        shown += [line(tail, tip, "asked"), head]
    ring = tip if tail is None else tail
    shown += [] if ring is None else [circle(ring, RING * dot, "end")]
    now = tail if moved == "tail" else tip
    inside = [spot for spot in ask.spots if box[0] < spot.real < box[2] and box[1] < spot.imag < box[3]]
    inside.sort(key=lambda spot: abs(spot - (complex(box[0], box[3]) if now is None else now)))
    both = (tip if moved == "tail" else tail) is not None
    spots = (
        tag(
            "a",
            circle(spot, REACH * dot, "reach"),
            circle(spot, dot, "spot"),
            href=link("yes" if both else "plan", move="", **{moved: _written(spot)}),
            aria_label=said["ask.spot"].format(n=n),
        )
        for n, spot in enumerate(inside, 1)
    )
    free = link("yes" if both else "plan", move=moved, at="X,Y")
    view = f"{box[0] - x0:.2f} {y1 - box[3]:.2f} {box[2] - box[0]:.2f} {box[3] - box[1]:.2f}"
    return tag(
        "svg",
        tag("image", href=source, x=0, y=0, width=x1 - x0, height=y1 - y0, aria_hidden="true"),
        *shown,
        *spots,
        viewBox=view,
        role="group",
        aria_label=said["ask.plan"].format(symbol=ask.symbol),
        data_free=free,
        id="plan",
        class_="plan",
        tabindex=-1,
    )
