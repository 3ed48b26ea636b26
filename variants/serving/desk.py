"""A server at work: its processes, what they have made, task files that were sent, classes that are worked at."""

from __future__ import annotations

import asyncio
import os
import secrets
import shutil
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from importlib.util import find_spec
from typing import Any

from starlette.requests import Request

from ...scales.errors import LANGUAGES, KulmanError
from ...scales.packaged import packaged
from .asking import Sitting, size_of
from .jobs import KEPT, BusyError, CrashError, Crew, Home, Store
from .making import KINDS, Job, Upload, as_sent
from .pages import Door
from .safety import Doors

SECONDS, PHOTO_SECONDS, CLASS_SECONDS = 60.0, 300.0, 3600.0  # that a job may take, photographs, and one for a class
WAITING, CLASSES_WAITING = 100, 4  # jobs that may wait
ANSWERS, OWN_TASKS, DONE = 500, 100, 8  # results, task files, classes that are kept
LARGEST = 200_000_000  # bytes of results kept
# what kinds of files need, or files of a stem
EXTRAS = {".png": "pypdfium2", ".dxf": "ezdxf", ".docx": "docx", "note.pdf": "typst", "scan": "zxingcpp"}


def _writable() -> dict[str, tuple[str, ...]]:
    """Return the kinds of files that can be written here, by stem: some need packages that may be missing."""
    there = {key: find_spec(package) is not None for key, package in EXTRAS.items()}
    return {
        stem: tuple(kind for kind in kinds if all(there.get(one, True) for one in (kind, stem, f"{stem}{kind}")))
        for stem, kinds in KINDS.items()
    }


@dataclass(frozen=True, slots=True)
class Served:
    """An answer that is kept: what it holds, the name of its file."""

    name: str
    data: bytes


class Desk:
    """A server at work: its processes, and what it has made."""

    def __init__(self, doors: Doors, allowed: str, language: str = "", seats: int = 0) -> None:
        """Open it; the language is that of pages whose addresses say none."""
        self.doors, self.allowed, self.language = doors, allowed, language
        self.cores = seats or max(os.cpu_count() or 1, 2)
        self.kinds = _writable()
        self.home = Home()
        self.crew = Crew(self.cores, WAITING, SECONDS, self.home.path, "seat")
        self.photos = Crew(max(self.cores // 2, 1), WAITING, PHOTO_SECONDS, self.home.path, "photo")
        self.classes = Crew(1, CLASSES_WAITING, CLASS_SECONDS, self.home.path, "class")
        self.made = Store[Any](ANSWERS, LARGEST, _size, lambda gone: None)
        self.own = Store[bytes](OWN_TASKS, LARGEST // 10, len, lambda gone: None)
        self.sittings = Store[Sitting](ANSWERS, LARGEST, size_of, lambda gone: None)
        self.jobs = Store[Job](DONE, 10**12, lambda job: 0, self._forget)
        self._making: dict[Any, asyncio.Task[Any]] = {}
        self._running = set[asyncio.Task[None]]()

    def _forget(self, job: Job) -> None:
        (self.home.path / KEPT / f"{job.name}.zip").unlink(missing_ok=True)
        shutil.rmtree(self.home.path / KEPT / job.name, ignore_errors=True)  # what was read of photographs

    def close(self) -> None:
        """End the processes and remove what they have written."""
        self.crew.stop()
        self.photos.stop()
        self.classes.stop()
        self.home.remove()

    def door(self, request: Request) -> Door:
        """Return what a page hangs on: the language of the address, of the settings, or of the browser."""
        said = request.query_params.get("lang", "")
        wanted = (
            part.partition(";")[0].strip()[:2].lower() for part in request.headers.get("accept-language", "").split(",")
        )
        spoken = self.language or next((one for one in wanted if one in LANGUAGES), LANGUAGES[0])
        chosen = said in LANGUAGES
        return Door(
            self.doors.root, said if chosen else spoken, chosen, request.scope["role"], self.allowed, self.kinds
        )

    async def ask(self, key: Any, make: Any, *args: Any, like: Any = None) -> Any:
        """Return what a process makes, from what is kept where it is there; who asks for the same waits for the one."""
        found = self.made.get(key)
        if found is not None:
            return found
        if key not in self._making:
            task = self._making[key] = asyncio.create_task(self.crew.do(make, *args, like=like))
            task.add_done_callback(lambda done: self._making.pop(key, None))
        return self.made.keep(key, await asyncio.shield(self._making[key]))

    def begin(self, title: str, make: Any, language: str, sent: Sequence[Upload], *args: Any) -> Job:
        """Begin the work for a class; what is to be told of it, and of the files that were sent, is in a language."""
        job = Job(secrets.token_hex(12), title)
        self.jobs.keep(job.name, job)
        task = asyncio.create_task(self._class(job, make, (*args, f"{job.name}.zip", self.cores), language, sent))
        self._running.add(task)
        task.add_done_callback(self._running.discard)
        return job

    async def _class(self, job: Job, make: Any, args: tuple[Any, ...], language: str, sent: Sequence[Upload]) -> None:
        words = packaged(__package__, "texts", language)
        try:
            done = await self.classes.do(make, *args, advance=job.advance)
            job.outcome = replace(done, lines=tuple(as_sent(line, sent) for line in done.lines))
        except KulmanError as error:
            job.problem = as_sent(error.text(language), sent)
        except BusyError:
            job.problem = words["busy"]
        except CrashError as crash:
            print(crash, file=sys.stderr)
            job.problem = words["crash"]


def _size(made: Any) -> int:
    """Return about how many bytes something takes that has been made."""
    if isinstance(made, bytes | str):
        return len(made)
    parts = made if isinstance(made, tuple) else getattr(made, "pages", None) or (getattr(made, "data", b""),)
    return 10_000 + sum(len(part) for part in parts if isinstance(part, bytes | str))
