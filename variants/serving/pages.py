"""Pages as the browser gets them: elements that escape what they hold, forms, links that keep task and language."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from html import escape
from itertools import pairwise
from urllib.parse import quote, urlencode

from markdown_it import MarkdownIt

from ...scales.choices import HANDS, SHEETS, SIZES
from ...scales.errors import LANGUAGES, InputError, KulmanError, messages
from ...scales.packaged import packaged
from ..batches.batch import FORMS
from ..marking.keyed import COLUMNS
from ..marking.report import scripts
from ..sheets import BLOCK
from ..shelf import GUIDES, bundled, guide_text
from ..shelf import guides as listed_guides
from .making import GivenField, Job, Judged, Rows, Shown
from .safety import ALLOWED, STUDENT

TONGUES = {"uk": "Українська", "ru": "Русский", "en": "English"}
ANSWERED = ("mm", "mu", "value", "direction")  # columns of a form that are filled in
NORMS = ("gost", "iso")
# what files end in that are sent
TABLES, DRAWINGS, PHOTOS, TOML = ".csv,.xlsx", ".dxf,.svg,.pdf", ".jpg,.jpeg,.png", ".toml"
# of files: what must be seen for them, else forms
SEEN = dict.fromkeys(("sheet", "moving", "positions"), "sheets")
SEEN |= dict.fromkeys(("key", "note", "results", "cycle", "charts"), "answers")
VOID = {"img", "input", "link", "meta"}


class Html(str):
    """Text that is HTML already."""

    __slots__ = ()


def tag(name: str, /, *inside: object, **attributes: object) -> Html:
    """Return an element; texts in it are escaped, what is HTML stays, None and False are left out.

    >>> tag("a", "1 < 2", tag("b", "!"), href="/?a=1&b=2", hidden=False, class_="x", data_at=3)
    '<a href="/?a=1&amp;b=2" class="x" data-at="3">1 &lt; 2<b>!</b></a>'
    """
    said = "".join(
        f" {key.rstrip('_').replace('_', '-')}" + ("" if value is True else f'="{escape(str(value))}"')
        for key, value in attributes.items()
        if value is not None and value is not False
    )
    return Html(f"<{name}{said}>" if name in VOID else f"<{name}{said}>{_joined(inside)}</{name}>")


def _joined(parts: Iterable[object]) -> Html:
    """Return parts one after the other, texts escaped."""
    return Html("".join(part if isinstance(part, Html) else escape(str(part)) for part in parts if part is not None))


@dataclass(frozen=True, slots=True)
class Door:
    """What every page hangs on: what addresses begin with, language, who looks at it, what students may see."""

    root: str
    language: str
    chosen: bool  # whether the address says the language
    role: str
    allowed: str
    kinds: Mapping[str, Sequence[str]]  # files that can be written here, by stem

    @property
    def said(self) -> Mapping[str, str]:
        """The words of pages."""
        return packaged(__package__, "texts", self.language)

    def sees(self, what: str) -> bool:
        """Whether `forms`, `sheets` or `answers` may be seen."""
        return self.role != STUDENT or ALLOWED.index(what) <= ALLOWED.index(self.allowed)

    def link(self, path: str, query: Iterable[tuple[str, str]] = ()) -> str:
        """Return the address of a page; the language goes on."""
        own = [*query, *([("lang", self.language)] if self.chosen else [])]
        return f"{self.root}{quote(path)}" + (f"?{urlencode(own)}" if own else "")

    def told(self, error: KulmanError) -> str:
        """Return the message of an error, without commands where a page has its own words for what they are for."""
        own = f"{error.key}-page"
        return (InputError(own, **error.data) if own in messages(self.language) else error).text(self.language)


def page(
    door: Door,
    title: str,
    *inside: object,
    at: str = "/",
    query: Sequence[tuple[str, str]] = (),
    heading: Html | None = None,
) -> str:
    """Return a whole page; `at` and `query` are its own address, `heading` its title where that has indices."""
    said = door.said
    places = [("/", "nav.tasks"), ("/own", "nav.own")]
    places += [("/class", "nav.class"), ("/marks", "nav.marks")] if door.role != STUDENT else []
    places.append(("/guide", "nav.guides"))
    nav = (tag("a", said[key], href=door.link(to), aria_current="page" if to == at else None) for to, key in places)
    tongues = (
        tag(
            "a",
            TONGUES[one],
            href=replace(door, language=one, chosen=True).link(at, query),
            lang=one,
            aria_current="true" if one == door.language else None,
        )
        for one in LANGUAGES
    )
    head = (
        tag("meta", charset="utf-8"),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("title", f"{title} – {said['name']}"),
        tag("link", rel="icon", href=f"{door.root}/static/icon.svg"),
        tag("link", rel="stylesheet", href=f"{door.root}/static/web.css"),
        tag("script", src=f"{door.root}/static/web.js", defer=True),
    )
    body = (
        tag("a", said["skip"], href="#main", class_="skip"),
        tag(
            "header",
            tag("a", said["name"], href=door.link("/"), class_="name"),
            tag("nav", *nav, aria_label=said["nav"]),
            tag("nav", *tongues, aria_label=said["languages"], class_="tongues"),
        ),
        tag("main", tag("h1", heading or title), *inside, id="main"),
    )
    return f"<!doctype html>\n{tag('html', tag('head', *head), tag('body', *body), lang=door.language)}\n"


def note(*inside: object, kind: str = "note") -> Html:
    """Return a box with what a user should know; `problem` is read out at once."""
    return tag("div", *inside, class_=kind, role="alert" if kind == "problem" else None)


def field(label: object, control: Html, of: str, hint: object = None) -> Html:
    """Return a control under its label."""
    return tag("p", tag("label", label, for_=of), control, tag("small", hint) if hint else None, class_="field")


def _chosen(name: str, options: Iterable[tuple[str, str]], now: str, /, **attributes: object) -> Html:
    """Return a list to choose one from."""
    made = (tag("option", text, value=value, selected=value == now) for value, text in options)
    return tag("select", *made, name=name, id=attributes.pop("id", name), **attributes)


def typed(name: str, value: str = "", /, **attributes: object) -> Html:
    """Return a field to type in."""
    usual = {"id": name, "autocomplete": "off", "maxlength": 200}
    return tag("input", name=name, value=value, **{**usual, **attributes})


def home(door: Door, groups: Mapping[str, Sequence[tuple[str, str, int]]]) -> str:
    """Return the page of all tasks: by subject their ids, titles, numbers of variants."""
    said, parts = door.said, list[Html]()
    for kind, tasks in groups.items():
        cards = [
            tag(
                "li",
                tag(
                    "a",
                    tag("img", src=door.link(f"/picture/{id_}.svg"), alt="", loading="lazy", width=240, height=160),
                    tag("span", title, class_="title"),
                    tag("span", said["home.variants"].format(id=id_, n=n), class_="id"),
                    href=door.link(f"/task/{id_}"),
                ),
            )
            for id_, title, n in tasks
        ]
        parts += [tag("h2", said[f"kind.{kind}"]), tag("ul", *cards, class_="cards")]
    return page(door, said["home.title"], tag("p", said["home.about"]), *parts)


@dataclass(frozen=True, slots=True)
class Place:
    """Where a page about a task is: its path, what its address says, as fields of forms have it."""

    path: str
    query: tuple[tuple[str, str], ...]
    number: int = 1
    handout: bool = False

    def get(self, name: str) -> str:
        """Return what the address says."""
        return dict(self.query).get(name, "")


def settled(place: Place, shown: Shown) -> Place:
    """Return a place whose address says only what is otherwise than usual."""
    said = [("v", shown.variant)]
    said += [pair for pair in place.query if pair[1] and not pair[0].startswith("g.") and pair[0] not in ("v", "of")]
    own = (("g." + name, text) for name, text in shown.own)
    return replace(place, query=(*said, *own))


def task(door: Door, place: Place, shown: Shown) -> str:
    """Return the page of a task: what can be chosen, its sheet, what can be downloaded."""
    said = door.said
    at = settled(place, shown)
    parts = [
        tag("p", shown.note, class_="about") if shown.note else None,
        tag(
            "div",
            _asking(door, place, shown),
            tag("section", *_drawn(door, at, shown), aria_label=said["task.sheet"], class_="sheet"),
            tag("div", _downloads(door, at, shown), class_="side"),
            class_="bench",
        ),
    ]
    return page(door, shown.title, *parts, at=place.path, query=at.query)


def _asking(door: Door, place: Place, shown: Shown) -> Html:
    said = door.said
    variants = [(name, name) for name in shown.variants]
    formats = [("", said["task.smallest"]), *((size, size) for size in SIZES)]
    norms = [("gost", said["norm.gost"]), ("iso", said["norm.iso"])]
    plans = {"": said["task.all"], **dict(shown.plans)}
    plans = {**plans, place.get("only"): plans.get(place.get("only"), place.get("only"))}
    own = (_given(one, dict(shown.own)) for one in shown.fields)
    block = (field(said[f"block.{name}"], typed(name, place.get(name)), name) for name in BLOCK)
    return tag(
        "form",
        field(said["task.variant"], _chosen("v", variants, shown.variant), "v"),
        tag("input", type="hidden", name="of", value=shown.variant),
        field(said["task.plans"], _chosen("only", [*plans.items()], place.get("only")), "only"),
        tag("input", type="hidden", name="lang", value=door.language) if door.chosen else None,
        tag("input", type="hidden", name="view", value="handout") if place.handout else None,
        tag("details", tag("summary", said["task.own"]), *own, open=bool(shown.own)),
        tag(
            "details",
            tag("summary", said["task.block"]),
            field(said["task.format"], _chosen("format", formats, place.get("format")), "format"),
            field(said["task.norm"], _chosen("norm", norms, place.get("norm") or NORMS[0]), "norm"),
            *block,
            open=any(place.get(name) for name in (*BLOCK, "format")),
        ),
        tag("button", said["task.show"], type="submit", class_="main"),
        method="get",
        class_="asking",
        action=f"{door.root}{place.path}",
    )


def _given(one: GivenField, own: Mapping[str, str]) -> Html:
    name = f"g.{one.name}"
    control = _chosen(name, one.choices, one.value) if one.choices else typed(name, one.value, inputmode="text")
    label = _joined((tag("span", Html(one.symbol), title=one.name), tag("span", one.unit, class_="unit")))
    return field(label, control, name) if one.name not in own else tag("div", field(label, control, name), class_="own")


def _drawn(door: Door, place: Place, shown: Shown) -> Iterable[Html | None]:
    said, most = door.said, len(shown.pages)
    if shown.problem is not None:
        yield note(door.told(shown.problem), kind="problem")
        return
    number = min(max(place.number, 1), most)
    turned = [("view", "handout")] if place.handout else []
    if most > 1:
        turns = (
            tag(
                "a",
                str(n),
                href=door.link(place.path, [*place.query, *turned, ("page", str(n))]),
                aria_label=said["task.page"].format(number=n, n=most),
                aria_current="page" if n == number else None,
            )
            for n in range(1, most + 1)
        )
        yield tag("nav", tag("span", said["task.pages"]), *turns, aria_label=said["task.pages"], class_="pager")
    query = [*place.query, *turned, ("page", str(number))]
    alt = said["task.alt"].format(title=shown.title, variant=shown.variant, number=number, n=most)
    source = door.link(f"{place.path}/page.svg", query)
    yield tag("a", tag("img", src=source, alt=alt), href=source, class_="paper")
    for warning in shown.warnings:
        yield note(door.told(warning))


def _downloads(door: Door, place: Place, shown: Shown) -> Html:
    said = door.said
    rows = list[Html]()
    for stem, kinds in door.kinds.items():
        hidden = (stem == "moving" and not shown.moves) or (stem == "roster" and door.role == STUDENT)
        hidden |= stem in ("scan", "positions") and not shown.read
        if hidden or not door.sees(SEEN.get(stem, "forms")):
            continue
        files = (
            tag(
                "a",
                said["task.open"] if (stem, kind) == ("moving", ".html") else kind[1:].upper(),
                href=door.link(f"{place.path}/{stem}{kind}", place.query),
                aria_label=f"{said[f'file.{stem}']}, {kind[1:].upper()}",
            )
            for kind in kinds
        )
        rows.append(tag("li", tag("span", said[f"file.{stem}"]), *files))
    checked = tag("a", said["task.check"], href=door.link(f"{place.path}/check", place.query), class_="button")
    views = list[Html]()
    if door.sees("sheets"):
        to, key = ([], "task.sheet") if place.handout else ([("view", "handout")], "task.blank")
        views = [tag("a", said[key], href=door.link(place.path, [*place.query, *to]), class_="button")]
    return _joined((
        tag("p", checked, *views, class_="buttons"),
        tag("h2", said["task.files"]),
        tag("ul", *rows, class_="files"),
    ))  # fmt: skip


def form(
    door: Door,
    place: Place,
    shown_as: str,
    rows: Rows,
    wanted: Mapping[str, Collection[str]],
    filled: Mapping[str, str],
    problem: str = "",
) -> str:
    """Return the page of the form of measured answers; `filled` are answers by the names of their fields.

    Of each row the columns that are `wanted` can be filled in, and a scale factor that is the student's own.
    """
    said, parts = door.said, list[Html]()
    head = next(number for number, row in enumerate(rows) if len([text for text in row if text]) == len(COLUMNS))
    heads = dict(zip(COLUMNS, rows[head], strict=False))
    hints = [row[0] for row in rows[:head] if len(row) == 1]  # who it is has two cells
    body = list[Html]()
    for number, row in enumerate(rows[head + 1 :], head + 1):
        cells = dict(zip(COLUMNS, (*row, *[""] * len(COLUMNS)), strict=False))
        if not any(row[1:]):
            body.append(tag("tr", tag("th", scripted(cells["name"]), colspan=len(ANSWERED) + 2, scope="rowgroup")))
            continue
        inputs = (
            tag(
                "td",
                typed(
                    f"a.{number}.{COLUMNS.index(column)}",
                    filled.get(f"a.{number}.{COLUMNS.index(column)}", ""),
                    aria_label=f"{cells['symbol']}: {heads[column]}",
                    data_head=heads[column],
                )
                if column in wanted[cells["name"]]
                else "",
            )
            for column in ANSWERED
        )
        vector = tag("small", " ", scripted(cells["vector"])) if cells["vector"] else ""
        symbol = tag("th", scripted(cells["symbol"]), vector, scope="row")
        body.append(tag("tr", symbol, *inputs, tag("td", cells["unit"])))
    labels = (tag("th", heads[column], scope="col") for column in ("symbol", *ANSWERED, "unit"))
    parts = [tag("p", scripted(hint)) for hint in hints]
    table = tag("table", tag("thead", tag("tr", *labels)), tag("tbody", *body), class_="answers")

    def asked(answers: Html, hand: str, **how: str) -> Html:
        """Return a form that asks for answers, and how they are to be judged."""
        own = _tick("own", "1", said["form.own"], "own" in filled)
        return tag(
            "form",
            answers,
            _hand(door, filled.get("preset", "normal"), hand),
            tag("p", own, class_="tick") if door.sees("answers") else None,
            tag("button", said["form.judge"], type="submit", class_="main"),
            method="post",
            action=door.link(f"{place.path}/check", place.query),
            **how,
        )

    known = f"{TABLES},{DRAWINGS},{PHOTOS}"
    drawing = _file(door, "drawing", "form.drawing", known, several=True, required=True, hint="form.drawing_hint")
    both = asked(tag("div", table, class_="scroll"), "preset"), asked(drawing, "hand", enctype="multipart/form-data")
    title = said["form.title"]
    back = tag("p", tag("a", f"← {shown_as}", href=door.link(place.path, place.query)))
    warned = note(problem, kind="problem") if problem else None
    return page(door, title, back, warned, *parts, *both, at=f"{place.path}/check", query=place.query)


def scripted(text: str) -> Html:
    """Return a symbol with its indices lowered and raised."""
    return Html(scripts(text))


def guides(door: Door) -> str:
    """Return the page with the headings of all guides."""
    links = (
        tag("li", tag("a", heading, href=door.link(f"/guide/{topic}")))
        for topic, heading in listed_guides(door.language).items()
    )
    return page(door, door.said["nav.guides"], tag("ul", *links, class_="files"), at="/guide")


def guide(door: Door, topic: str) -> str:
    """Return a guide as a page; `InputError` where there is no such topic."""
    reader = MarkdownIt("commonmark", {"html": False}).enable("table")
    _, title, _, *tokens = reader.parse(guide_text(topic, door.language))
    deeper = 0
    for before, token in pairwise(tokens):
        if before.type.startswith("heading_"):
            deeper |= before.tag == "h1"  # a part that holds what follows: a page has one title
            before.tag = f"h{int(before.tag[1]) + deeper}"
        if before.type == "heading_open":
            before.attrSet("id", re.sub(r"[^\w\s-]", "", token.content.lower()).replace(" ", "-"))
        before.attrs.pop("style", None)  # how a column is aligned: a page takes no style of its own
        links = [link for link in token.children or () if link.type in ("link_open", "link_close")]
        for opens, closes in zip(links[::2], links[1::2], strict=True):
            target = _led_to(door, str(opens.attrGet("href")))
            opens.attrSet("href", target)
            opens.hidden = closes.hidden = not target
    back = tag("p", tag("a", f"← {door.said['nav.guides']}", href=door.link("/guide")))
    text = Html(reader.renderer.render(tokens, reader.options, {}))
    return page(door, title.content, back, tag("div", text, class_="guide"), at=f"/guide/{topic}")


def _led_to(door: Door, target: str) -> str:
    """Return the address of what a guide leads to, nothing where that is no page here."""
    path, mark, part = target.partition("#")
    name = path.rpartition("/")[2].partition(".")[0]
    if not path or "://" in path:
        return target
    if path.endswith(".toml"):
        return door.link(f"/task/{name}") if name in bundled() else ""
    return f"{door.link(f'/guide/{name}')}{mark}{part}" if path.endswith(".md") and name in GUIDES else ""


def own(door: Door, kinds: Sequence[str], text: str, judged: Judged | None, to: str) -> str:
    """Return the page of a task file of one's own, with what the checker says of it; `to` is where it can be seen."""
    said = door.said
    begin = (
        tag("a", said[f"kind.{kind}"], href=door.link("/own", [("kind", kind)]), class_="button") for kind in kinds
    )
    before, _, after = said["own.about"].partition("{guide}")
    explained = tag("a", listed_guides(door.language)["task-file"], href=door.link("/guide/task-file"))
    parts = [tag("p", before, explained, after), tag("p", said["own.begin"], " ", *begin, class_="buttons")]
    if judged is not None:
        parts += _judged(door, judged, to)
    height = min(max(text.count("\n") + 2, 16), 40)
    parts.append(
        tag(
            "form",
            field(
                said["own.text"],
                tag("textarea", text, name="text", id="text", rows=height, spellcheck="false", class_="code"),
                "text",
            ),
            _file(door, "file", "own.file"),
            tag("button", said["own.check"], type="submit", class_="main"),
            method="post",
            enctype="multipart/form-data",
            action=door.link("/own"),
        )
    )
    return page(door, said["own.title"], *parts, at="/own")


def _judged(door: Door, judged: Judged, to: str) -> Iterable[Html]:
    said, by_line = door.said, dict[int, list[Html]]()
    for kind, found in (("fault", judged.faults), ("remark", judged.remarks)):
        for line, text in found:
            by_line.setdefault(line, []).append(tag("p", text, class_=kind))
    if judged.faults:
        count = said["own.faults"].format(n=len(judged.faults))
        yield note(tag("p", count), *by_line.get(0, []), kind="problem")
    else:
        go = tag("p", tag("a", said["own.see"], href=to, class_="button main"))
        yield note(tag("p", said["own.good"]), *by_line.get(0, []), go)
    lines = judged.text.splitlines()
    around = {n for line in by_line if line for n in range(line - 2, line + 3) if 1 <= n <= len(lines)}
    listed = list[Html]()
    for n in sorted(around):
        marks = by_line.get(n, [])
        if n - 1 not in around and listed:
            listed.append(tag("li", "…", class_="gap", aria_hidden="true"))
        listed.append(tag("li", tag("code", f"{n:>4}  {lines[n - 1]}"), *marks, class_="at" if marks else None))
    beyond = (mark for line in sorted(by_line) if line > len(lines) for mark in by_line[line])
    if listed:
        yield tag("ol", *listed, *beyond, class_="listing")


def _file(
    door: Door, name: str, label: str, accept: str = TOML, several: bool = False, required: bool = False, hint: str = ""
) -> Html:
    """Return a file to be chosen."""
    control = tag("input", type="file", name=name, id=name, accept=accept, multiple=several, required=required)
    return field(door.said[label], control, name, hint and door.said[hint])


def _tick(name: str, value: str, label: str, checked: bool = False) -> Html:
    """Return a box to be ticked, before its label."""
    return tag("label", tag("input", type="checkbox", name=name, value=value, checked=checked), " ", label)


def _hand(door: Door, now: str = "normal", place: str = "preset") -> Html:
    """Return the choice of how exactly is drawn."""
    hands = [(name, door.said[f"hand.{name}"]) for name in HANDS]
    return field(door.said["form.preset"], _chosen("preset", hands, now, id=place), place)


def _of_class(door: Door, at: str, problem: str, button: str, *fields: Html | None) -> str:
    """Return the page on which the sheets of a class or its marks are asked for: a form that is sent with files."""
    said = door.said
    digits = field(said["class.digits"], typed("digits"), "digits", said["class.digits_hint"])
    plans = field(said["class.plans"], typed("only"), "only", said["class.plans_hint"])
    send = tag("button", said[button], type="submit", class_="main")
    asked = tag(
        "form", *fields, plans, digits, send, method="post", enctype="multipart/form-data", action=door.link(f"/{at}")
    )
    warned = note(problem, kind="problem") if problem else None
    return page(door, said[f"{at}.title"], warned, tag("p", said[f"{at}.about"]), asked, at=f"/{at}")


def class_(door: Door, tasks: Sequence[tuple[str, str]], problem: str = "") -> str:
    """Return the page on which a class's sheets are asked for."""
    said = door.said
    ticks = (
        _tick("kinds", kind, said.get(f"as.{kind}", f"{said['file.sheet']}, {kind.upper()}"), kind in ("pdf", "note"))
        for kind in FORMS
        if kind not in SHEETS or f".{kind}" in door.kinds["sheet"]
    )
    choices = (tag("option", f"{title} ({id_})", value=id_) for id_, title in tasks)
    several = tag("select", *choices, name="tasks", id="tasks", multiple=True, size=8)
    sizes = [("", said["task.smallest"]), *((size, size) for size in SIZES)]
    return _of_class(
        door,
        "class",
        problem,
        "class.draw",
        field(said["class.tasks"], several, "tasks", said["class.several"]),
        _file(door, "own_task", "class.own"),
        _file(door, "roster", "class.roster", TABLES, required=True, hint="class.columns"),
        tag("fieldset", tag("legend", said["class.kinds"]), *ticks, class_="ticks"),
        tag("p", _tick("merge", "1", said["class.merge"]), class_="tick"),
        tag("p", _tick("scan", "1", said["class.scan"]), class_="tick") if "scan" in door.kinds else None,
        field(said["task.format"], _chosen("format", sizes, ""), "format"),
        *(field(said[f"block.{name}"], typed(name), name) for name in BLOCK if name not in ("student", "group")),
    )


def marks(door: Door, tasks: Sequence[tuple[str, str]], problem: str = "") -> str:
    """Return the page on which what a class has handed in is uploaded."""
    said, known = door.said, f"{TABLES},{DRAWINGS},{PHOTOS}"
    choices = [("", said["marks.named"]), *((id_, f"{title} ({id_})") for id_, title in tasks)]
    return _of_class(
        door,
        "marks",
        problem,
        "marks.mark",
        field(said["class.task"], _chosen("tasks", choices, ""), "tasks"),
        _file(door, "own_task", "class.own"),
        _file(door, "forms", "marks.forms", known, several=True, required=True, hint="marks.several"),
        _file(door, "roster", "marks.roster", TABLES),
        _file(door, "rubric", "marks.rubric"),
        _hand(door),
        tag("p", _tick("own", "1", said["form.own"]), class_="tick"),
    )


def job_far(door: Door, work: Job) -> str:
    """Return how far the work for a class is, in words."""
    return door.said["job.far"].format(done=work.done, whole=work.whole or "…")


def job(door: Door, work: Job, asked: bool = False) -> str:
    """Return the page of the work for a class: how far it is, or what has come of it, and if it was `asked` about."""
    said, path = door.said, f"/job/{work.name}"
    if work.problem:
        body = [note(work.problem, kind="problem")]
    elif work.outcome is None:
        far = job_far(door, work)
        bar = tag("progress", far, value=work.done if work.whole else None, max=work.whole or 1, aria_label=far)
        body = [tag("p", bar, " ", tag("output", far), id="far", data_state=f"{door.root}{path}/state"),
                tag("p", tag("a", said["job.look"], href=door.link(path)))]  # fmt: skip
    else:
        body = [tag("p", tag("a", said["job.fetch"], href=door.link(f"{path}/{work.name}.zip"), class_="button main",
                             download=True))]  # fmt: skip
        if work.outcome.page:
            body.append(tag("p", tag("a", said["job.page"], href=door.link(f"{path}/class.html"), class_="button")))
        if asked:  # answers can be changed, and all be marked anew
            again = tag("a", said["ask.all"], href=door.link(f"/asked/{work.name}"), class_="button")
            body.append(tag("p", again))
        body.append(tag("ul", *(tag("li", line) for line in work.outcome.lines), class_="lines"))
    return page(door, work.title, *body, at=path)


def refusal(door: Door, title: str, text: str) -> str:
    """Return a page that says why there is nothing to see."""
    return page(
        door, title, note(text, kind="problem"), tag("p", tag("a", door.said["home.back"], href=door.link("/")))
    )


def framed(document: str, *links: tuple[str, str]) -> str:
    """Return a page that is not the server's own, a report, as the main part of one with links before it."""
    words = (_joined((tag("a", text, href=href), " · " * (n < len(links)))) for n, (href, text) in enumerate(links, 1))
    back = tag("nav", *words, aria_label=links[0][1])
    return document.replace("<body>", f"<body>{back}<main>", 1).replace("</body>", "</main></body>", 1)
