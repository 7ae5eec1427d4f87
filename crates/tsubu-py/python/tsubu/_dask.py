"""Runs of a study, done by workers of Dask."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from tsubu._scene import Scene

if TYPE_CHECKING:
    from distributed import Client


def _task(study: str, folder: str, name: str, threads: int) -> str:
    """On a worker: does a run in a process of its own, and tells what it said."""
    words = [study, folder, "-o", folder, "--quiet", "--threads", str(threads), "--case", name]
    done = subprocess.run([sys.executable, "-m", "tsubu", *words], stdin=subprocess.DEVNULL, capture_output=True)
    return done.stderr.decode(errors="replace")


def hand_over(
    study: str,
    scene: Scene,
    folder: Path,
    overwrite: bool,
    threads: int,
    client: Client,
    shown: Callable[[float], object] | None,
) -> None:
    """Hands all runs that are missing to the workers, round by round, and makes the tables."""
    from distributed import as_completed

    folder = folder.absolute()
    missing = scene._core.missing(study, folder, True, overwrite)
    asked: set[str] = set()
    # A run that failed or was lost is not asked for again.
    while missing and not asked.intersection(missing):
        asked.update(missing)
        logs = folder / "launch"
        logs.mkdir(exist_ok=True)
        futures = {client.submit(_task, study, str(folder), name, threads, pure=False): name for name in missing}
        try:
            for done, future in enumerate(as_completed(futures), 1):
                name = futures[future]
                lost = f"case {name}: begun\nerror: {future.exception()!r}\n"
                (logs / f"{name}.txt").write_text(future.result() if future.status == "finished" else lost)
                if shown:
                    shown(done / len(futures))
        finally:
            client.cancel(list(futures))
        missing = scene._core.missing(study, folder, False, False)
    scene._core.gather(study, folder)
