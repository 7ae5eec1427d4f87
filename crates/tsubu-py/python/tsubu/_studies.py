"""Studies: many runs, one table."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Union

from tsubu import _tables, _tsubu
from tsubu._dask import hand_over
from tsubu._progress import Progress, Shown
from tsubu._scene import Scene

if TYPE_CHECKING:
    import pandas as pd
    from distributed import Client

Folder = Union[str, "os.PathLike[str]"]
AnyScene = Union[Scene, Folder]


def _scene(scene: AnyScene) -> Scene:
    return scene if isinstance(scene, Scene) else Scene.read(scene)


def _table(folder: Path, name: str) -> pd.DataFrame:
    table = _tables.read(folder / f"{name}.csv")
    table.attrs["folder"] = str(folder)
    return table


def sweep(
    scene: AnyScene,
    folder: Folder | None = None,
    overwrite: bool = False,
    threads: int | None = None,
    progress: Progress = True,
    client: Client | None = None,
) -> pd.DataFrame:
    """Runs every case of a scene's `[sweep]`, side by side, and gives a table with a row a case: what was varied, and the results.

    The folder is `out/NAME-sweep` unless told; an interrupted sweep goes on where it was when the same call is made again. Units are in
    `attrs["units"]`; `tsubu.load(folder).runs` has the runs. With a `distributed.Client` each case is a task of Dask's workers, with `threads`
    threads (one unless told); they need this package, and the folder under the same path.
    """
    scene = _scene(scene)
    path = scene._out(folder, "-sweep")
    with Shown("sweep", progress) as shown:
        if client is None:
            scene._core.sweep(path, overwrite, threads or 0, shown)
        else:
            hand_over("sweep", scene, path, overwrite, threads or 1, client, shown)
    return _table(path, "sweep")


def response(
    scene: AnyScene,
    folder: Folder | None = None,
    overwrite: bool = False,
    threads: int | None = None,
    progress: Progress = True,
    client: Client | None = None,
) -> pd.DataFrame:
    """The frequency response of a scene's `[response]`: a row for each case and frequency, with `rms displacement` and
    `peak displacement` [m].

    The folder is `out/NAME-response` unless told; an interrupted response goes on where it was when the same call is made again.
    `tsubu.load(folder).tables["cases"]` has peaks, damping and apparent masses. With a `distributed.Client` the runs are tasks of Dask's
    workers, as in :func:`sweep`.
    """
    scene = _scene(scene)
    path = scene._out(folder, "-response")
    with Shown("response", progress) as shown:
        if client is None:
            scene._core.response(path, overwrite, threads or 0, shown)
        else:
            hand_over("response", scene, path, overwrite, threads or 1, client, shown)
    return _table(path, "response")


def compare(
    scene: AnyScene,
    methods: str | Iterable[str],
    folder: Folder | None = None,
    overwrite: bool = False,
    threads: int | None = None,
    progress: Progress = True,
) -> pd.DataFrame:
    """Runs one scene by several methods and gives a table of what differs and what each cost.

    `methods` is a list of `METHOD` or `NAME=METHOD:KEY=VALUE`, or `"all"`. The folder is `out/NAME-compare` unless told; an interrupted
    comparison goes on where it was when the same call is made again.
    """
    scene = _scene(scene)
    path = scene._out(folder, "-compare")
    listed = methods if isinstance(methods, str) else ",".join(methods)
    with Shown("compare", progress) as shown:
        scene._core.compare(listed, path, overwrite, threads or 0, shown)
    return _table(path, "compare")


def verify(
    names: str | Iterable[str] = (),
    all: bool = False,
    threads: int | None = None,
    progress: Progress = True,
) -> pd.DataFrame:
    """Runs verification cases or studies by their names (without names all quick ones; with `all` the long ones too) and gives a table
    with a row a claim: `case`, `name`, `value`, accepted range `low` to `high`, `pass`, `source`."""
    pandas = _tables.need("pandas", "tables")
    listed = [names] if isinstance(names, str) else list(names)
    with Shown("verify", progress) as shown:
        claims = json.loads(_tsubu.verify(listed, all, threads or 0, shown))
    return pandas.DataFrame([{"case": case, **claim} for case, claim in claims])


def report(folder: Folder) -> Path:
    """Makes figures and a self-contained page of a folder of results, and gives the path of the page."""
    return _tsubu.report(folder)
