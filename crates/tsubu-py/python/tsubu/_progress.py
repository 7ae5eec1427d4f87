"""Progress of long work, on stderr."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Union

Progress = Union[bool, Callable[[float], object]]

PAUSE = 2.0


class Told:
    """One line that is written over on a terminal, a line now and then elsewhere."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.last = time.monotonic()
        self.next = 0.1
        self.terminal = sys.stderr.isatty()

    def __call__(self, share: float) -> None:
        now = time.monotonic()
        if self.terminal:
            if now - self.last >= 0.1:
                self.last = now
                print(f"\r{self.name}  {100 * share:3.0f} %", end="", file=sys.stderr, flush=True)
        elif self.next <= share < 1 and now - self.last >= PAUSE:
            self.last = now
            self.next = int(10 * share + 1e-9) / 10 + 0.1
            print(f"{self.name}: {100 * share:.0f} %", file=sys.stderr, flush=True)

    def end(self) -> None:
        if self.terminal:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


class Shown:
    """Shows progress while it is entered: as `progress` says, by a function of the user's, or not at all."""

    def __init__(self, name: str, progress: Progress) -> None:
        self.told = Told(name) if progress is True else None
        self.call = self.told if self.told else progress if callable(progress) else None

    def __enter__(self) -> Callable[[float], object] | None:
        return self.call

    def __exit__(self, *_: object) -> None:
        if self.told:
            self.told.end()
