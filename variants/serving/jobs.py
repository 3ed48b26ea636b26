"""Processes that do what requests ask for, each job within bounds of time and memory; one that dies is replaced.

A process works in a folder of its own, which it leaves empty, and ends, and takes the folders with it, when the server
that has started it does, however that ends. Where all of them are killed at once, the next server
removes what they left.
"""

from __future__ import annotations

import gc
import multiprocessing
import os
import shutil
import signal
import stat
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Hashable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import partial
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path
from threading import Lock, Thread
from typing import IO, TYPE_CHECKING, Any, Generic, TypeVar

from ...scales.errors import InputError, KulmanError
from ...scales.kept import collect_seldom
from ..crew import Advance, without_script

if TYPE_CHECKING:
    import asyncio

MEMORY = 2_000_000_000  # bytes of data that a process may have
PREFIX, LOCK = "kulman-serve-", "lock"  # of folders of servers; the file in them that its server keeps locked
LEAVING = 100  # times that a process tries to remove the folder of its server, in about ten seconds
YOUNG = 60.0  # seconds within which a folder may be one of a server that is just beginning
KEPT = "kept"  # the folder of what is to be fetched later
Made = TypeVar("Made")
Make = Callable[..., Any]  # told how far it is, what it is made from


class BusyError(Exception):
    """More is asked for than may wait."""


class CrashError(Exception):
    """A job has failed in a way that no message of ours tells; the text is its trace."""


class Home:
    """The folder of a server for what its processes need on disk."""

    def __init__(self) -> None:
        """Make it, for nobody else to read; remove those that servers have left."""
        for left in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
            with suppress(OSError):
                _sweep(left)
        self.path = Path(tempfile.mkdtemp(prefix=PREFIX))
        self._lock = (self.path / LOCK).open("wb")  # the system lets go of it when this process ends, however that does
        _locked(self._lock)
        (self.path / KEPT).mkdir()

    def remove(self) -> None:
        """Remove it with all that is in it."""
        self._lock.close()
        shutil.rmtree(self.path, ignore_errors=True)


def _sweep(left: Path) -> None:
    """Remove the folder of a server of the same user that has ended; an OSError says that none has."""
    about = left.lstat()
    owned = about.st_uid == os.getuid() if sys.platform != "win32" else True
    # one that has just been made may not have its lock yet
    if stat.S_ISDIR(about.st_mode) and owned and time.time() - about.st_mtime > YOUNG:
        if sys.platform == "win32":
            (left / LOCK).unlink()  # refused while it is open
        else:
            with (left / LOCK).open("rb") as lock:
                _locked(lock)
        shutil.rmtree(left, ignore_errors=True)


def _locked(lock: IO[bytes]) -> None:
    """Lock a file until it is closed, or raise an OSError where another process has."""
    if sys.platform != "win32":
        import fcntl

        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)


class Seat:
    """A process, begun when it is first needed and again where it has died, and what it did last."""

    def __init__(self, folder: Path, memory: int = MEMORY) -> None:
        """Have it work in a folder, which is made."""
        self.folder, self.memory = folder, memory
        self.last: Hashable = None
        self.over = False  # whether no process is begun any more
        self.process: BaseProcess | None = None
        self._pipe: Connection | None = None
        self._changing = Lock()  # nobody begins a process while it is ended for good

    def _begun(self) -> Connection:
        with self._changing:
            return self._alive()

    def _alive(self) -> Connection:
        if self.over:
            raise InputError("serve-died")
        if self._pipe is None or self.process is None or not self.process.is_alive():
            self._stop()
            self.folder.mkdir(exist_ok=True)
            means = multiprocessing.get_context("spawn")  # no copy of a server, which has threads
            self._pipe, other = means.Pipe()
            self.process = means.Process(target=_work, args=(other, str(self.folder), self.memory))
            with without_script():
                self.process.start()
            other.close()
        return self._pipe

    def do(self, make: Make, args: tuple[Any, ...], seconds: float, advance: Advance) -> Any:
        """Return what is made; a process that dies of it is replaced and tried once more.

        Raises
        ------
        KulmanError
            What was asked for cannot be made, takes too long or too much memory, or kills processes.
        CrashError
            Anything else.
        """
        for _ in range(0 if self.over else 2):
            pipe, until, kind = self._begun(), time.monotonic() + seconds, "advance"
            try:
                with suppress(EOFError, OSError):
                    pipe.send((make, args))
                    while pipe.poll(max(until - time.monotonic(), 0.0)):
                        kind, said = pipe.recv()
                        if kind == "made":
                            return said
                        if kind == "refused":
                            raise said
                        if kind == "failed":
                            raise CrashError(said)
                        advance(*said)
                    raise InputError("serve-late", n=round(seconds))
            finally:
                if kind == "advance":  # it is dead, or still at it: its answer would be taken for that to the next job
                    self.stop()
            if self.over:
                break
        raise InputError("serve-died")

    def stop(self, over: bool = False) -> None:
        """End the process, whatever it is at; what it leaves in its folder goes, too. None is begun when it is over."""
        with self._changing:
            self.over |= over
            self._stop()

    def _stop(self) -> None:
        if self.process is not None:
            self.process.kill()
            self.process.join()
        if self._pipe is not None:
            self._pipe.close()
        self.process = self._pipe = None
        shutil.rmtree(self.folder, ignore_errors=True)


def _work(pipe: Connection, folder: str, memory: int) -> None:
    """Do one job after the other, until the server ends."""
    for sign in (signal.SIGINT, signal.SIGTERM):  # whoever ends a whole group ends the server, which ends this process
        signal.signal(sign, lambda number, frame: None)
    parent = multiprocessing.parent_process()
    assert parent is not None
    Thread(target=_end_with, args=(parent, Path(folder).parent), daemon=True).start()
    _bound(memory)
    collect_seldom()
    with suppress(OSError):  # the server may have ended meanwhile, and its folder with it
        os.chdir(folder)
    sent = partial(_send, pipe)
    while True:
        try:
            make, args = pipe.recv()
        except (EOFError, OSError):
            break
        sent(*_outcome(make, args, sent))
        gc.collect(0)  # what a job leaves behind is young, and may be large: nobody waits for it
        with suppress(OSError):
            for left in Path(folder).iterdir():
                shutil.rmtree(left, ignore_errors=True) if left.is_dir() else left.unlink(missing_ok=True)
    _leave(Path(folder).parent)


def _send(pipe: Connection, kind: str, said: Any) -> None:
    with suppress(OSError):  # the server has gone: the next look at the pipe tells
        pipe.send((kind, said))


def _outcome(make: Make, args: tuple[Any, ...], sent: Callable[[str, Any], None]) -> tuple[str, Any]:
    try:
        return "made", make(lambda done, whole: sent("advance", (done, whole)), *args)
    except KulmanError as error:
        return "refused", error
    except MemoryError:
        return "refused", InputError("serve-memory")
    except BaseException:  # what typst panics with is no Exception
        return "failed", traceback.format_exc()


def _bound(memory: int) -> None:
    """Bound the memory of this process where the system can."""
    if sys.platform != "win32":
        import resource

        hard = resource.getrlimit(resource.RLIMIT_DATA)[1]
        with suppress(ValueError, OSError):
            resource.setrlimit(resource.RLIMIT_DATA, (memory, hard))


def _end_with(parent: BaseProcess, home: Path) -> None:
    parent.join()
    _leave(home)


def _leave(home: Path) -> None:
    """End this process and remove the folder of its server, which has ended."""
    if sys.platform == "win32":  # it keeps a folder in which somebody is
        os.chdir(home.parent)
    for _ in range(LEAVING):  # other processes, and a job in this one, may still write there
        shutil.rmtree(home, ignore_errors=True)
        if not home.exists():
            break
        time.sleep(0.1)
    os._exit(0)


class Crew:
    """So many processes, and so many jobs that may wait for one."""

    def __init__(self, seats: int, waiting: int, seconds: float, home: Path, name: str) -> None:
        """Have `seats` processes with folders in `home`; no job takes more than so many seconds."""
        self.seats = [Seat(home / f"{name}-{number}") for number in range(seats)]
        self.seconds, self._most = seconds, seats + waiting
        import asyncio  # here: a process that does jobs, and one that has but a single PDF read, do without

        self._idle, self._asked = [*self.seats], 0
        self._free = asyncio.Semaphore(seats)
        self._threads = ThreadPoolExecutor(seats)

    async def do(self, make: Make, *args: Any, like: Hashable = None, advance: Advance | None = None) -> Any:
        """Return what is made of `args`, by the process that did something `like` it last where it is free.

        Raises
        ------
        BusyError
            Too much waits already.
        KulmanError, CrashError
            As of `Seat.do`.
        """
        import asyncio

        if self._asked >= self._most:
            raise BusyError
        self._asked += 1
        # a task of its own: who waits may go, the process is still at it
        job = asyncio.create_task(self._do(make, args, like, advance))
        job.add_done_callback(self._silenced)
        return await asyncio.shield(job)

    def _silenced(self, job: asyncio.Task[Any]) -> None:
        """Let nobody hear of a job that died because all processes have been ended."""
        if self.seats[0].over and not job.cancelled():
            job.exception()  # is retrieved by this

    async def _do(self, make: Make, args: tuple[Any, ...], like: Hashable, advance: Advance | None) -> Any:
        import asyncio

        try:
            async with self._free:
                seat = next((one for one in self._idle if like is not None and one.last == like), self._idle[0])
                self._idle.remove(seat)
                seat.last = like
                job = partial(seat.do, make, args, self.seconds, advance or (lambda done, whole: None))
                try:
                    return await asyncio.get_running_loop().run_in_executor(self._threads, job)
                finally:
                    self._idle.append(seat)
        finally:
            self._asked -= 1

    def stop(self) -> None:
        """End all processes."""
        for seat in self.seats:
            seat.stop(over=True)
        self._threads.shutdown(wait=False, cancel_futures=True)


class Store(Generic[Made]):
    """What has been made, by what it was made from, within so many bytes and items; the longest unused goes first."""

    def __init__(self, items: int, largest: int, size: Callable[[Made], int], gone: Callable[[Made], None]) -> None:
        """Keep so many items of so many bytes in all; who goes is told to `gone`."""
        self.items, self.largest, self._size, self._gone = items, largest, size, gone
        self._made: dict[Hashable, Made] = {}

    def get(self, key: Hashable) -> Made | None:
        """Return what is kept under a key, or None."""
        made = self._made.pop(key, None)
        if made is not None:
            self._made[key] = made
        return made

    def keep(self, key: Hashable, made: Made) -> Made:
        """Keep something under a key."""
        self._made.pop(key, None)
        self._made[key] = made
        while len(self._made) > 1 and (len(self._made) > self.items or self._whole() > self.largest):
            self._gone(self._made.pop(next(iter(self._made))))
        return made

    def _whole(self) -> int:
        return sum(map(self._size, self._made.values()))
