"""What processes of a server are given to do in tests; they import nothing else."""

from __future__ import annotations

import gc
import os
import time
from pathlib import Path
from typing import Any


class Circle:
    """What only a look for garbage removes; it is told in a file."""

    def __init__(self, gone: str) -> None:
        self.own, self.gone = self, gone

    def __del__(self) -> None:
        Path(self.gone).touch()


def leaves(advance: Any, gone: str) -> int:
    Circle(gone)
    return gc.get_threshold()[0]


def sleeps(advance: Any, seconds: float) -> str:
    advance(1, 2)
    time.sleep(seconds)
    return os.getcwd()


def dies(advance: Any) -> None:
    os.kill(os.getpid(), 9)


def dies_once(advance: Any, file: str) -> str:
    if not os.path.exists(file):
        Path(file).touch()
        dies(advance)
    return "done"


def takes(advance: Any, size: int) -> int:
    return len(bytearray(size))


def fails(advance: Any) -> None:
    Path("left").write_text("x")
    raise ZeroDivisionError
