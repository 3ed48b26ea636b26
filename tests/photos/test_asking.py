"""What is asked of photographs, and what follows from answers: whose pages are, which counts, where vectors end.

Of vectors, whose questions take longest, `tests/serving/test_asking.py` asks by default, these tests in the soak.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from kulman import check
from kulman.plans.marking.answers import Verdict
from kulman.scales.errors import InputError
from kulman.tests.photos.stacks import TASK, Stack
from kulman.variants.marking.checks import Check, reported
from kulman.variants.marking.marked import Desk
from kulman.variants.marking.reading import Answers, stem_of
from kulman.variants.photos.asking import OUT, EndAsk, Told, ends_asked, gathered, page_of
from kulman.variants.photos.pictures import Photo
from kulman.variants.roster import Entry, Roster, Who
from kulman.variants.serving.making import _Asker

Settled = list[tuple[Desk, Answers, list[EndAsk]]]


@pytest.fixture(scope="module")
def ready(stack: Stack) -> Check:
    return check(TASK, roster=stack.roster, lang="en")


@pytest.fixture(scope="module")
def read(stack: Stack, ready: Check) -> list[Answers]:
    return ready.read(*map(str, stack.pictures), warn=lambda error: None)


@pytest.fixture(scope="module")
def settled(ready: Check, read: list[Answers]) -> Settled:
    """The students, once all that is asked of pages has been answered, with what is asked of their vectors."""
    _, asks = gathered(read, ready.roster, Told())
    pages = {"whose": ("#1", 0), "unread": (OUT, 0), "which": (OUT, 1)}
    said = {page: pages[ask.kind][0] for ask in asks for page in ask.pages[pages[ask.kind][1] :]}
    found, left = gathered(read, ready.roster, Told(said, {}, frozenset(name for ask in asks for name in ask.names)))
    assert not left
    desks = [Desk(ready) for _ in found]  # each keeps what it has read
    return [(desk, answers, ends_asked(desk, answers)[0]) for desk, answers in zip(desks, found, strict=True)]


def test_what_is_asked_of_pages(ready: Check, read: list[Answers]) -> None:
    found, asks = gathered(read, ready.roster, Told())

    told = {ask.kind: [Path(source).name for source in ask.sources] for ask in asks}
    assert told == {
        "whose": ["IMG_2001.jpg"],
        "unread": ["IMG_2002.jpg"],
        "which": ["І. Петренко-2.jpg", "І. Петренко-2 (1).jpg"],
    }
    assert len(found) == 4  # nothing is lost where nobody answers
    assert all(picture.startswith(b"\x89PNG") for ask in asks for picture in ask.pictures)


def test_nothing_is_asked_of_a_student_whose_mechanism_does_not_assemble() -> None:
    short = Entry(Who(student="Koval"), "1", {"l_AB": "1 mm"}, "r:2")
    asker = _Asker(replace(check(TASK, lang="en"), roster=Roster((short,))))

    assert asker.begin()(Answers("x.jpg", short.who, {}, {}, {})) == ([], {})


@pytest.mark.soak
def test_photographs_that_have_been_asked_about_are_worth_what_typed_forms_are(
    stack: Stack, ready: Check, settled: Settled
) -> None:
    typed = {one.who.student: ready.mark(one).marked.mark for one in ready.read(str(stack.typed))}
    marks = {}
    for desk, answers, asks in settled:
        truth = stack.truth[answers.who.student]
        ends = {ask.name: (truth[ask.name].tail, truth[ask.name].tip) for ask in asks}
        of_class = replace(answers, told=ends, plans=frozenset())  # nobody has handed in the other pages
        marks[answers.who.student] = desk.mark(of_class).mark

    assert any(asks for *_, asks in settled)  # or the stack asks for nothing
    assert marks == typed
    assert sorted(marks.values()) != [100.0, 100.0]  # one has made a mistake


@pytest.mark.soak
def test_what_is_not_answered_costs_nothing_and_what_is_not_drawn_is_missing(settled: Settled) -> None:
    desk, answers, asks = settled[0]
    name = asks[0].name

    unanswered, absent = desk.mark(answers), desk.mark(replace(answers, told={name: None}))

    assert name not in {line.name for line in unanswered.lines}
    assert {line.verdict for line in absent.lines if line.name == name} == {Verdict.MISSING}
    assert absent.mark < unanswered.mark


@pytest.mark.soak
def test_what_was_believed_and_the_spots_lie_on_what_was_drawn(stack: Stack, settled: Settled) -> None:
    for _, answers, asks in settled:
        truth = stack.truth[answers.who.student]
        for ask in asks:
            for believed, true in ((ask.tail, truth[ask.name].tail), (ask.tip, truth[ask.name].tip)):
                assert believed is None or abs(believed - true) < 1.0
                assert abs(ask.snapped(true + 0.5) - true) < 1.0
                assert ask.snapped(true + 500.0) == true + 500.0  # there is nothing near it
                assert ask.box[0] < true.real < ask.box[2]
                assert ask.box[1] < true.imag < ask.box[3]


@pytest.mark.soak
def test_a_sheet_that_is_returned_shows_what_has_been_told(stack: Stack, settled: Settled) -> None:
    desk, answers, asks = settled[0]
    truth = stack.truth[answers.who.student][asks[0].name]
    told = replace(answers, told={asks[0].name: (truth.tail, truth.tip)})

    pages = [next(iter(reported(desk, one)[0].files(Path("x.png"))))[1] for one in (answers, told)]

    assert pages[0] != pages[1]
    assert desk.mark(told).seen is not None


def photo(number: int, picture: bytes, sheet: str = "A") -> Photo:
    code = ("KULMAN", "T", "1", sheet, str(number), "UK", "A4", "0")
    return Photo("x", number, {}, 0j, code if sheet else (), picture)


def answers_of(source: str, *photos: Photo, who: str = "") -> Answers:
    return Answers(source, Who(student=who), {"sheet": photos[0].sheet}, {}, {}, photos=photos)


def test_pages_of_a_student_come_together_from_files_of_one_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kulman.variants.photos.asking._small", lambda photo: b"")
    one, other, again = photo(2, b"1"), photo(3, b"2"), photo(2, b"1")
    files = [answers_of("001-koval-2.jpg", one), answers_of("002-koval-3.jpg", other), answers_of("003-x.jpg", again)]

    found, asks = gathered(files, None, Told())

    assert [[photo.number for photo in answers.photos] for answers in found] == [[2, 3]]  # the same picture counts once
    assert not asks


def test_a_student_who_is_chosen_later_gets_the_page_and_is_asked_which_one_counts(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("kulman.variants.photos.asking._small", lambda photo: b"")
    roster = Roster((Entry(Who(student="Koval"), "1", {}, "r:2"), Entry(Who(student="Bondar"), "2", {}, "r:3")))
    named, nameless = photo(2, b"1"), photo(2, b"2")
    files = [answers_of("a", named, who="Koval"), answers_of("b", nameless, who="img 1")]
    _, (whose,) = gathered(files, roster, Told())

    said = Told({page_of(nameless): "#0"}, {}, frozenset(whose.names))
    found, (which,) = gathered(files, roster, said)

    assert (whose.kind, which.kind, which.who) == ("whose", "which", "Koval")
    assert {*which.pages} == {page_of(named), page_of(nameless)}
    assert [one.who.student for one in found] == ["Koval", "Koval"]
    done, none = gathered(files, roster, Told({**said.pages, page_of(named): OUT}, {}, frozenset(which.names)))
    assert ([one.photos for one in done], none) == ([(nameless,)], [])


def test_a_picture_that_cannot_be_read_is_told_of_its_student(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kulman.variants.photos.asking._small", lambda photo: b"")
    roster = Roster((Entry(Who(student="Koval"), "1", {}, "r:2"), Entry(Who(student="Bondar"), "2", {}, "r:3")))
    broken = InputError("photo-few", file="002-img.jpg")
    files = [
        answers_of("001-koval.jpg", photo(2, b"1"), who="Koval"),
        Answers("002-img.jpg", Who(), {}, {}, {}, unread=broken),
    ]

    beside, alone = (gathered(files, roster, Told({"002-img.jpg": said}))[0] for said in ("#0", "#1"))

    assert [(one.who.student, one.problems, one.unread) for one in beside] == [("Koval", (broken,), None)]
    assert [(one.who.student, one.unread) for one in alone] == [("Koval", None), ("Bondar", broken)]
    assert len(gathered(files, roster, Told({"002-img.jpg": OUT}))[0]) == 1


def test_in_a_stack_the_id_of_a_sheet_tells_the_student(ready: Check, read: list[Answers]) -> None:
    code = next(one.about["sheet"] for one in read if one.about.get("variant") == "7")
    sheets = {code: [entry for entry in (ready.roster.entries if ready.roster else ()) if entry.variant == "7"]}
    nameless = next(one for one in read if one.about.get("sheet") == code)

    assert ready._named(nameless, sheets).who.student == "О. Коваль"
    assert ready._named(nameless, {}).who.student != "О. Коваль"


@pytest.mark.parametrize(
    ("source", "stem"),
    [("forms/007-Koval-2.jpg", "Koval"), ("Koval (1).png", "Koval"), ("IMG_2001.jpg", "IMG"), ("koval.pdf", "koval")],
)
def test_a_name_has_no_number_of_a_page(source: str, stem: str) -> None:
    assert stem_of(source) == stem


def test_told_vectors_make_other_answers(read: list[Answers]) -> None:
    assert replace(read[0], told={"V_B": None}).digest != read[0].digest
