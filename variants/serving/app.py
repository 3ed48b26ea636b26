"""What is answered to which address; each answer is made by a call that the command line makes, too."""

from __future__ import annotations

import asyncio
import base64
import contextlib
import hashlib
import re
import secrets
import signal
import socket
import sys
import webbrowser
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import FileResponse, HTMLResponse, JSONResponse, RedirectResponse, Response
from starlette.routing import Route
from uvicorn import Config, Server

from ...scales.choices import HANDS, SIZES
from ...scales.errors import InputError, KulmanError
from ...scales.numbers import quote
from ...scales.packaged import home
from ..batches.batch import FORMS
from ..crew import digest_of
from ..kinds import KINDS as SUBJECTS
from ..kinds import MODULES
from ..sheets import BLOCK, PAPER
from ..shelf import GUIDES, bundled, summary
from . import making, pages
from .answering import Questions, marked_alone
from .asking import Sitting
from .desk import Desk, Served
from .jobs import KEPT, BusyError, CrashError
from .making import Asked, Handed, Job, Upload, as_sent
from .pages import Door, Place
from .safety import STUDENT, Gate, Patient, doors_for, read_passwords

CONNECTIONS = 300
PORT = 8765
TYPES = {".svg": "image/svg+xml", ".pdf": "application/pdf", ".png": "image/png", ".zip": "application/zip"}
TEXTS = {".html": "html", ".css": "css", ".js": "javascript"}
TYPES |= {suffix: f"text/{kind}; charset=utf-8" for suffix, kind in TEXTS.items()}
STATIC = ("web.css", "web.js", "icon.svg")
OWN = "own-"  # begins the names of task files of users in addresses
PICTURE = "default-src 'none'; style-src 'unsafe-inline'; font-src data:; img-src data:; sandbox"
_INLINE = re.compile(r"<(style|script)>(.*?)</\1>", re.DOTALL)


def _policy(document: str) -> str:
    """Return what a page that is not the server's own may do: run its own scripts, take its own styles."""
    hashes: dict[str, list[str]] = {"style": [], "script": []}
    for kind, text in _INLINE.findall(document):
        digest = base64.b64encode(hashlib.sha256(text.encode("utf-8")).digest()).decode("ascii")
        hashes[kind].append(f"'sha256-{digest}'")
    scripts, styles = (" ".join(hashes[kind]) or "'none'" for kind in ("script", "style"))
    # attributes of style have no digest; they load nothing
    return (
        f"default-src 'none'; script-src {scripts}; style-src-elem {styles}; "
        "style-src-attr 'unsafe-inline'; img-src data:; font-src data:; base-uri 'none'; form-action 'none'; "
        "frame-ancestors 'none'"
    )


class _Answers:
    """What answers which address."""

    def __init__(self, desk: Desk) -> None:
        """Answer for a server."""
        self.desk, self.questions = desk, Questions(desk)

    def routes(self) -> list[Route]:
        """Return which address is answered by what."""
        return [
            *self.questions.routes(),
            Route("/", self.home_page),
            Route("/static/{name}", self.static),
            Route("/picture/{task}.svg", self.picture),
            Route("/task/{task}", self.task_page),
            Route("/task/{task}/page.svg", self.sheet_page),
            Route("/task/{task}/check", self.form_page, methods=["GET"]),
            Route("/task/{task}/check", self.judge, methods=["POST"]),
            Route("/task/{task}/{stem}.{suffix}", self.download),
            Route("/result/{name}", self.result),
            Route("/own", self.own_page, methods=["GET"]),
            Route("/own", self.own_checked, methods=["POST"]),
            Route("/guide", self.guides_page),
            Route("/guide/{topic}", self.guide_page),
            Route("/class", self.class_page, methods=["GET"]),
            Route("/class", self.class_begun, methods=["POST"]),
            Route("/marks", self.marks_page, methods=["GET"]),
            Route("/marks", self.marks_begun, methods=["POST"]),
            Route("/job/{name}", self.job_page),
            Route("/job/{name}/state", self.job_state),
            Route("/job/{name}/class.html", self.job_class),
            Route("/job/{name}/{file}.zip", self.job_archive),
        ]

    def asked(self, request: Request) -> Asked:
        """Return what an address asks about a task; one that is not there is 404."""
        name, query = request.path_params["task"], request.query_params.multi_items()
        own = b"" if name in bundled() else self.desk.own.get(name)
        if own is None:
            raise HTTPException(404)
        said = {key: value.strip() for key, value in query if len(value) <= 200 and len(key) <= 100}
        settings = tuple((key[2:], value) for key, value in said.items() if key.startswith("g."))
        how = tuple((key, said[key]) for key in making.HOW if said.get(key))
        block = tuple((key, said[key]) for key in BLOCK if said.get(key))
        return Asked(
            name, own, said.get("v", ""), said.get("of", ""), settings, how, block, self.desk.door(request).language
        )

    def measured(self, request: Request) -> Asked:
        """Return what is asked of who writes what was measured: on the blank, for whom no sheet is to be seen."""
        of = self.asked(request)
        if self.desk.door(request).sees("sheets") or "format" in dict(of.how):
            return of
        return replace(of, how=(*of.how, ("format", PAPER)))

    def place(self, request: Request) -> Place:
        said = [
            (key, value) for key, value in request.query_params.multi_items() if key not in ("lang", "page", "view")
        ]
        number = request.query_params.get("page", "1")
        handout = request.query_params.get("view") == "handout"
        name = request.path_params["task"]
        return Place(
            f"/task/{name}", tuple(said), int(number) if number.isdecimal() and len(number) < 4 else 1, handout
        )

    async def shown(self, request: Request) -> making.Shown:
        of, at = self.asked(request), self.place(request)
        answers = self.desk.door(request).sees("sheets") and not at.handout
        key = of, "shown", answers
        found: making.Shown = await self.desk.ask(key, making.shown, of, answers, like=(of.task, of.variant))
        return found

    async def home_page(self, request: Request) -> Response:
        door, groups = self.desk.door(request), dict[str, list[tuple[str, str, int]]]()
        for table, kind in MODULES.items():
            for id_ in bundled(table):
                about = summary(id_)
                groups.setdefault(kind, []).append((id_, about["title"][door.language], len(about["variants"])))
        return HTMLResponse(pages.home(door, groups))

    async def static(self, request: Request) -> Response:
        name = request.path_params["name"]
        if name not in STATIC:
            raise HTTPException(404)
        return FileResponse(home(__package__) / name, media_type=TYPES[Path(name).suffix])

    async def picture(self, request: Request) -> Response:
        name, language = request.path_params["task"], self.desk.door(request).language
        if name not in bundled():
            raise HTTPException(404)
        data: bytes = await self.desk.ask(("picture", name, language), making.picture, name, language)
        return _file(Served("picture.svg", data), kept=True)

    async def task_page(self, request: Request) -> Response:
        door, at = self.desk.door(request), self.place(request)
        return HTMLResponse(pages.task(door, at, await self.shown(request)))

    async def sheet_page(self, request: Request) -> Response:
        found, number = await self.shown(request), self.place(request).number
        if found.problem is not None:
            raise found.problem
        if not 1 <= number <= len(found.pages):
            raise HTTPException(404)
        return _file(Served("page.svg", found.pages[number - 1]))

    async def download(self, request: Request) -> Response:
        stem, suffix = request.path_params["stem"], f".{request.path_params['suffix']}"
        if suffix not in self.desk.kinds.get(stem, ()):
            raise HTTPException(404)
        if not self.desk.door(request).sees(pages.SEEN.get(stem, "forms")):
            raise HTTPException(403)
        of = self.measured(request) if stem == "form" else self.asked(request)
        name, data = await self.desk.ask((of, stem, suffix), making.made, of, stem, suffix, like=(of.task, of.variant))
        return _file(Served(name, data), as_name=f"{of.task}-{of.variant or '1'}-{name}")

    async def form_page(self, request: Request, filled: Mapping[str, str] | None = None, problem: str = "") -> Response:
        door, of, at = self.desk.door(request), self.measured(request), self.place(request)
        rows, wanted = await self.desk.ask((of, "form"), making.form, of, like=(of.task, of.variant))
        about = await self.shown(request)
        at = pages.settled(at, about)
        return HTMLResponse(pages.form(door, at, about.title, rows, wanted, filled or {}, problem))

    async def judge(self, request: Request) -> Response:
        door, of, form = self.desk.door(request), self.measured(request), await _Form.of(request)
        filled = {name: texts[0][:200] for name, texts in form.texts.items()}
        cells = {
            (int(found[1]), int(found[2])): text.strip()
            for name, text in filled.items()
            if (found := re.fullmatch(r"a\.([0-9]{1,4})\.([0-9])", name)) and text.strip()
        }
        own = "own" in filled or not door.sees("answers")
        preset = filled.get("preset", "normal") if filled.get("preset") in HANDS else "normal"
        at = pages.settled(self.place(request), await self.shown(request))
        files, back = form.files.get("drawing", ()), door.link(f"{at.path}/check", at.query)
        handed = Handed(of, tuple(files), {"preset": preset, "own": own}, alone=True)
        try:
            if files:
                return await marked_alone(self.desk, door, Sitting(secrets.token_hex(12), handed, back))
            report = await self.desk.crew.do(making.answered, of, cells, preset, own, like=(of.task, of.variant))
        except KulmanError as error:
            return await self.form_page(request, filled, as_sent(error.text(door.language), files))
        name, report = secrets.token_hex(12), pages.framed(report, (back, f"← {door.said['form.again']}"))
        self.desk.made.keep(name, Served("report.html", report.encode("utf-8", "replace")))
        return RedirectResponse(door.link(f"/result/{name}"), 303)

    async def result(self, request: Request) -> Response:
        found = self.desk.made.get(request.path_params["name"])
        if not isinstance(found, Served):
            raise HTTPException(404)
        return _file(found, as_name=found.name)

    async def own_page(self, request: Request) -> Response:
        door, kind = self.desk.door(request), request.query_params.get("kind", "")
        text = ""
        if kind in SUBJECTS:
            text = await self.desk.ask(("start", kind, door.language), making.started, kind, door.language)
        return HTMLResponse(pages.own(door, SUBJECTS, text, None, ""))

    async def own_checked(self, request: Request) -> Response:
        door, form = self.desk.door(request), await _Form.of(request)
        upload = form.file("file")
        written = next(iter(form.texts.get("text", ())), "").replace("\r\n", "\n")
        data = upload.data if upload is not None else written.encode("utf-8", "replace")
        judged = await self.desk.crew.do(making.judged, data, door.language)
        name = f"{OWN}{digest_of(data)}"
        if not judged.faults:
            self.desk.own.keep(name, data)
        return HTMLResponse(pages.own(door, SUBJECTS, judged.text, judged, door.link(f"/task/{name}")))

    async def guides_page(self, request: Request) -> Response:
        return HTMLResponse(pages.guides(self.desk.door(request)))

    async def guide_page(self, request: Request) -> Response:
        topic = request.path_params["topic"]
        if topic not in GUIDES:
            raise HTTPException(404)
        return HTMLResponse(pages.guide(self.desk.door(request), topic))

    def listed(self, door: Door) -> list[tuple[str, str]]:
        return [(id_, summary(id_)["title"][door.language]) for id_ in bundled()]

    async def class_page(self, request: Request) -> Response:
        door = _teacher(self.desk.door(request))
        return HTMLResponse(pages.class_(door, self.listed(door)))

    def of_class(self, door: Door, form: _Form) -> tuple[Asked, ...]:
        """Return the tasks that a form chooses, or the one that it brings."""
        own = form.file("own_task")
        if own is not None:
            return (Asked("", own.data, language=door.language),)
        names = [name for name in form.texts.get("tasks", ()) if name in bundled()]
        return tuple(Asked(name, language=door.language) for name in names)

    async def class_begun(self, request: Request) -> Response:
        door, form = _teacher(self.desk.door(request)), await _Form.of(request)
        tasks, roster = self.of_class(door, form), form.file("roster")
        kinds = tuple(kind for kind in form.texts.get("kinds", ()) if kind in FORMS)
        if not tasks or roster is None or not kinds:
            return HTMLResponse(pages.class_(door, self.listed(door), door.said["class.missing"]), 400)
        said = form.said(**dict.fromkeys(BLOCK))
        how: dict[str, Any] = {"kinds": kinds, "merge": "merge" in form.texts, **said}
        how |= {"scan": "scan" in form.texts and "handout" in kinds, **form.said(only=None, digits=None, format=SIZES)}
        title = door.said["class.title"]
        job = self.desk.begin(title, making.drawn_class, door.language, [roster], tasks, roster, how)
        return RedirectResponse(door.link(f"/job/{job.name}"), 303)

    async def marks_page(self, request: Request) -> Response:
        door = _teacher(self.desk.door(request))
        return HTMLResponse(pages.marks(door, self.listed(door)))

    async def marks_begun(self, request: Request) -> Response:
        door, form = _teacher(self.desk.door(request)), await _Form.of(request)
        tasks, roster = self.of_class(door, form), form.file("roster")
        forms = form.files.get("forms", ())
        if not forms:
            return HTMLResponse(pages.marks(door, self.listed(door), door.said["marks.missing"]), 400)
        how = {"own": "own" in form.texts, **form.said(only=None, digits=None, preset=HANDS)}
        of = tasks[0] if tasks else Asked("", language=door.language)
        handed = Handed(of, tuple(forms), how, roster, form.file("rubric"))
        return self.questions.begun(door, Sitting("", handed, door.link("/marks")), told=False)

    def found_job(self, request: Request) -> Job:
        _teacher(self.desk.door(request))
        job = self.desk.jobs.get(request.path_params["name"])
        if job is None:
            raise HTTPException(404)
        return job

    async def job_page(self, request: Request) -> Response:
        door, job = self.desk.door(request), self.found_job(request)
        sitting = self.desk.sittings.get(job.name)
        if sitting is not None and job.outcome is not None and job.outcome.asking is not None:
            sitting.asking = job.outcome.asking
            return RedirectResponse(door.link(f"/asked/{job.name}"), 303)
        return HTMLResponse(pages.job(door, job, sitting is not None and bool(sitting.asks)))

    async def job_state(self, request: Request) -> Response:
        job, door = self.found_job(request), self.desk.door(request)
        return JSONResponse({"done": job.done, "whole": job.whole, "over": job.over, "said": pages.job_far(door, job)})

    async def job_archive(self, request: Request) -> Response:
        job = self.found_job(request)
        if job.outcome is None or not job.outcome.archive:
            raise HTTPException(404)
        # the name is the job's, which is the server's own
        return FileResponse(
            self.desk.home.path / KEPT / job.outcome.archive, filename="class.zip", media_type=TYPES[".zip"]
        )

    async def job_class(self, request: Request) -> Response:
        job = self.found_job(request)
        if job.outcome is None or not job.outcome.page:
            raise HTTPException(404)
        door = self.desk.door(request)
        page = pages.framed(job.outcome.page.decode("utf-8"), (door.link(f"/job/{job.name}"), f"← {job.title}"))
        return _file(Served("class.html", page.encode("utf-8")))


def _teacher(door: Door) -> Door:
    if door.role == STUDENT:
        raise HTTPException(403)
    return door


@dataclass(frozen=True, slots=True)
class _Form:
    """What a form says: by the names of its fields texts, and files that have been chosen."""

    texts: Mapping[str, Sequence[str]]
    files: Mapping[str, Sequence[Upload]]

    @classmethod
    async def of(cls, request: Request) -> _Form:
        """Read it."""
        texts, files = dict[str, list[str]](), dict[str, list[Upload]]()
        async with request.form(max_files=1000, max_fields=3000) as form:
            for name, part in form.multi_items():
                if isinstance(part, str):
                    texts.setdefault(name, []).append(part)
                elif part.filename:
                    files.setdefault(name, []).append(Upload(part.filename, await part.read()))
        return cls(texts, files)

    def text(self, name: str) -> str:
        """Return what a field says, without spaces round it."""
        return next(iter(self.texts.get(name, ())), "").strip()

    def file(self, name: str) -> Upload | None:
        """Return the file that has been chosen, if one has."""
        return next(iter(self.files.get(name, ())), None)

    def said(self, **known: Sequence[str] | None) -> dict[str, str]:
        """Return what fields say that are filled in, of those that have known words nothing else."""
        texts = {name: self.text(name)[:200] for name in known}
        return {name: text for name, text in texts.items() if text and text in (known[name] or (text,))}


def _file(served: Served, as_name: str = "", kept: bool = False) -> Response:
    """Return a file; what a browser shows is shown with its own rules, which let nothing be loaded."""
    suffix = Path(served.name).suffix
    headers = {"Cache-Control": "private, max-age=3600"} if kept else {}
    if suffix == ".svg":
        headers["Content-Security-Policy"] = PICTURE
    elif suffix == ".html":
        headers["Content-Security-Policy"] = _policy(served.data.decode("utf-8"))
    if as_name and suffix != ".html":
        headers["Content-Disposition"] = f'attachment; filename="{re.sub(r"[^A-Za-z0-9._-]", "-", as_name)}"'
    return Response(served.data, media_type=TYPES.get(suffix, "application/octet-stream"), headers=headers)


def _application(desk: Desk) -> Gate:
    """Return the server as an ASGI application."""

    def told(
        key: str, status: int, headers: Mapping[str, str] | None = None
    ) -> Callable[[Request, Exception], Response]:
        def answer(request: Request, problem: Exception) -> Response:
            door = desk.door(request)
            return HTMLResponse(pages.refusal(door, door.said["problem"], door.said[key]), status, headers)

        return answer

    def refused(request: Request, problem: Exception) -> Response:
        assert isinstance(problem, KulmanError)
        door = desk.door(request)
        return HTMLResponse(pages.refusal(door, door.said["problem"], problem.text(door.language)), 422)

    def http(request: Request, problem: Exception) -> Response:
        assert isinstance(problem, HTTPException)
        key = {404: "missing", 403: "teachers"}.get(problem.status_code, "problem")
        return told(key, problem.status_code, problem.headers)(request, problem)

    def crashed(request: Request, problem: Exception) -> Response:
        print(problem, file=sys.stderr)
        return told("crash", 500)(request, problem)

    @contextlib.asynccontextmanager
    async def open_desk(app: Starlette) -> AsyncIterator[None]:
        warming = [asyncio.create_task(desk.crew.do(making.warmed)) for _ in range(desk.cores)]
        try:
            yield
        finally:
            for task in warming:
                task.cancel()
            desk.close()

    handlers: Mapping[Any, Any] = {
        KulmanError: refused,
        BusyError: told("busy", 503, {"Retry-After": "10"}),
        CrashError: crashed,
        HTTPException: http,
    }
    return Gate(Starlette(routes=_Answers(desk).routes(), exception_handlers=handlers, lifespan=open_desk), desk.doors)


def _listening(host: str, port: int | None) -> socket.socket:
    """Return a socket that listens at a port; where none is said at the usual one, or any that is free.

    Raises InputError: it cannot be had.
    """
    for number in (PORT, 0) if port is None else (port,):
        with contextlib.suppress(OSError, OverflowError):
            return socket.create_server((host, number), family=socket.AF_INET6 if ":" in host else socket.AF_INET)
    raise InputError("serve-port", host=quote(host), port=PORT if port is None else port)


def serve(
    passwords: str | None,
    allowed: str,
    language: str,
    tell: Callable[[str], None],
    host: str,
    port: int | None,
    names: tuple[str, ...],
    opened: bool,
) -> None:
    """Serve until somebody stops it.

    Parameters
    ----------
    passwords : str, optional
        The file of passwords; without it a token in the address lets in.
    allowed : {"forms", "sheets", "answers"}
        What students see.
    language : str
        That of pages whose addresses say none; where it is empty that of the browser.
    tell : callable
        Told the address; it is `opened` in a browser where that is wanted.
    host, port, names
        Where to listen, and by which other names the server is called.

    Raises
    ------
    InputError
        Passwords cannot be read, or are missing where others could ask, or nothing can listen there.
    """
    doors = doors_for(host, names, None if passwords is None else read_passwords(passwords))
    listens = _listening(host, port)
    number = listens.getsockname()[1]
    shown = f"[{host}]" if ":" in host else "127.0.0.1" if host == "0.0.0.0" else host
    address = f"http://{shown}:{number}{doors.root}/"
    # what is begun is also ended where the signal comes before the server listens for it, or once more after it
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(0))
    bounds: Any = {"limit_concurrency": CONNECTIONS, "timeout_graceful_shutdown": 3, "timeout_keep_alive": 5}
    quiet: Any = {"log_level": "warning", "access_log": False, "server_header": False}
    with listens, contextlib.closing(Desk(doors, allowed, language)) as desk:
        config = Config(_application(desk), http=Patient, ws="none", lifespan="on", **quiet, **bounds)
        tell(address)
        if opened:
            webbrowser.open(address)
        Server(config).run(sockets=[listens])
