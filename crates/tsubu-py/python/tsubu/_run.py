"""Runs: what was computed, read back from a folder of results."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

from tsubu import _html, _plots, _tables, _tsubu

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd

KINDS = ("grains", "contacts", "walls", "cells", "globals")


class Frame:
    """One moment of a run: arrays by column, grains in the order of their ids."""

    def __init__(self, core: _tsubu.Frame) -> None:
        self._core = core
        self._kinds: dict[str, tuple[dict[str, np.ndarray], dict[str, str]]] = {}

    def _of(self, kind: str) -> tuple[dict[str, np.ndarray], dict[str, str]]:
        if kind not in self._kinds:
            columns = self._core.columns(kind)
            self._kinds[kind] = (
                {name: array for name, (array, _) in columns.items()},
                {name: unit for name, (_, unit) in columns.items()},
            )
        return self._kinds[kind]

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self._core.time

    @property
    def step(self) -> int:
        """Number of the step."""
        return self._core.step

    @property
    def grains(self) -> dict[str, np.ndarray]:
        """A row a grain: `id`, `group`, `position` [m], `velocity` [m/s], `spin` [rad/s], `radius` [m], `mass` [kg], ..."""
        return self._of("grains")[0]

    @property
    def contacts(self) -> dict[str, np.ndarray]:
        """A row a touching pair: `first`, `second` (ids; a wall is -1 less its number), `position` [m], `force` [N], `normal`,
        `overlap` [m]."""
        return self._of("contacts")[0]

    @property
    def walls(self) -> dict[str, np.ndarray]:
        """A row a vertex of a wall; consecutive rows of equal `outline` form a line or a polygon."""
        return self._of("walls")[0]

    @property
    def cells(self) -> dict[str, np.ndarray]:
        """A row a cell of a lattice."""
        return self._of("cells")[0]

    @property
    def globals(self) -> dict[str, np.ndarray]:
        """What belongs to no row: the periodic box, shapes of grains."""
        return self._of("globals")[0]

    @property
    def units(self) -> dict[str, dict[str, str]]:
        """The unit of each column, by kind."""
        return {kind: self._of(kind)[1] for kind in KINDS if self._of(kind)[1]}

    def to_pandas(self, kind: str = "grains") -> pd.DataFrame:
        """The columns of a kind as a frame of pandas; vectors become `name x`, `name y`, `name z`."""
        pandas = _tables.need("pandas", "tables")
        columns: dict[str, Any] = {}
        units: dict[str, str] = {}
        arrays, of = self._of(kind)
        for name, array in arrays.items():
            parts = [(name, array)]
            if array.ndim == 2:
                axes = "xyz" if array.shape[1] == 3 else "wxyz"
                parts = [(f"{name} {axis}", array[:, at]) for at, axis in enumerate(axes)]
            for part, values in parts:
                columns[part], units[part] = values, of[name]
        frame = pandas.DataFrame(columns)
        frame.attrs["units"] = units
        frame.attrs["time"] = self.time
        return frame

    def to_pyvista(self) -> Any:
        """The grains as points of pyvista, every column an array of theirs. `.glyph(scale="radius")` draws spheres."""
        pyvista = _tables.need("pyvista", "pyvista")
        cloud = pyvista.PolyData(self.grains["position"].copy())
        for name, array in self.grains.items():
            if name != "position":
                cloud.point_data[name] = array
        cloud.field_data["time"] = [self.time]
        return cloud

    def __repr__(self) -> str:
        rows = len(next(iter(self.grains.values()), ()))
        return f"<tsubu.Frame: t = {self.time:.6g} s, {rows} grains; {', '.join(self.grains)}>"


class Frames(Sequence[Frame]):
    """The frames of a run; each is read when it is asked for."""

    def __init__(self, folder: Path) -> None:
        self._found = _tsubu.snapshots(folder)

    @property
    def times(self) -> list[float]:
        """Their times [s]."""
        return [time for time, _ in self._found]

    @overload
    def __getitem__(self, index: int) -> Frame: ...
    @overload
    def __getitem__(self, index: slice) -> list[Frame]: ...
    def __getitem__(self, index: int | slice) -> Frame | list[Frame]:
        if isinstance(index, slice):
            return [Frame(_tsubu.read_frame(path)) for _, path in self._found[index]]
        return Frame(_tsubu.read_frame(self._found[index][1]))

    def __len__(self) -> int:
        return len(self._found)

    def __repr__(self) -> str:
        return f"<tsubu.Frames: {len(self)}>"


class Run:
    """A folder of results: of a run, a sweep, a response, a comparison or a verification. :func:`load` makes it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        """Where it is."""

    @cached_property
    def summary(self) -> dict[str, Any]:
        """`summary.json`: `status`, `particles`, `steps`, `energy`, `state_hash`, `results`, `claims`, ...; empty where there is none."""
        file = self.folder / "summary.json"
        return json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}

    @property
    def results(self) -> dict[str, Any]:
        """Name and value of each result, in SI units; `summary["units"]` has these."""
        return self.summary.get("results", {})

    @cached_property
    def claims(self) -> pd.DataFrame:
        """The claims with their values, ranges and sources."""
        pandas = _tables.need("pandas", "tables")
        verified = self.folder / "verify.json"
        kept = json.loads(verified.read_text(encoding="utf-8")) if verified.is_file() else self.summary
        return pandas.DataFrame(kept.get("claims", []))

    @property
    def warnings(self) -> list[str]:
        """What the reader should know."""
        return self.summary.get("warnings", [])

    @cached_property
    def history(self) -> pd.DataFrame:
        """`history.csv`: a row every output time. The units are in `attrs["units"]`."""
        return _tables.read(self.folder / "history.csv")

    @cached_property
    def tables(self) -> Mapping[str, pd.DataFrame]:
        """All other tables of the folder by their names: `watch/heap`, `sweep`, `response`, `cases`, `compare`, ..."""
        return _Tables(self.folder)

    @cached_property
    def frames(self) -> Frames:
        """The frames that were written."""
        return Frames(self.folder)

    @cached_property
    def runs(self) -> dict[str, Run]:
        """The runs below the folder by their names: cases of a sweep, columns of a comparison."""
        below = sorted(path.parent for path in self.folder.rglob("summary.json") if path.parent != self.folder)
        return {path.relative_to(self.folder).as_posix(): Run(path) for path in below}

    @property
    def scene(self) -> Any:
        """The scene as it was run."""
        from tsubu._scene import Scene

        return Scene.read(self.folder / "scene.toml")

    def to_pyvista(self, frame: int = -1) -> Any:
        """A frame, the last unless told, as points of pyvista."""
        return self._frame(frame).to_pyvista()

    def to_xarray(self) -> Any:
        """All frames as a dataset of xarray over `time` [s] and `id`; where a grain is not there yet, or no more, there is no number."""
        xarray = _tables.need("xarray", "xarray")
        import numpy

        self._frame(0)
        frames = self.frames[:]
        ids = numpy.unique(numpy.concatenate([frame.grains["id"] for frame in frames]))
        data: dict[str, Any] = {}
        for name, array in frames[0].grains.items():
            if name == "id":
                continue
            shape = (len(frames), len(ids), *array.shape[1:])
            whole = numpy.full(shape, numpy.nan)
            for at, frame in enumerate(frames):
                whole[at, numpy.searchsorted(ids, frame.grains["id"])] = frame.grains[name]
            axes = {1: (), 2: ("axis",) if array.shape[-1] == 3 else ("quaternion",)}[array.ndim]
            data[name] = (("time", "id", *axes), whole, {"units": frames[0].units["grains"][name]})
        coordinates: dict[str, Any] = {"time": ("time", [frame.time for frame in frames], {"units": "s"}), "id": ids}
        if any(len(column[0]) > 2 and column[0][2] == "axis" for column in data.values()):
            coordinates["axis"] = ["x", "y", "z"]
        return xarray.Dataset(data, coordinates)

    def _frame(self, at: int) -> Frame:
        if not len(self.frames):
            raise _tsubu.Error(
                f"error: there are no frames in {self.folder}\nhint: say `output.frame-interval` in the scene"
            )
        return self.frames[at]

    def plot(self, *columns: str, ax: Any = None) -> Any:
        """Draws columns of the history against time with matplotlib, in the style of the report, and gives the axes; without columns the
        energies. A run without a history draws its response."""
        return _plots.run(self, columns, ax)

    def report(self) -> Path:
        """Makes figures and a self-contained page in the folder, as `tsubu report` does, and gives the path of the page."""
        return _tsubu.report(self.folder)

    def __repr__(self) -> str:
        told = self.summary.get("status", "a folder of results")
        return f"<tsubu.Run {str(self.folder)!r}: {told}>"

    def _repr_html_(self) -> str:
        summary = self.summary
        units = summary.get("units", {})
        rows: list[tuple[str, str]] = [
            (name.replace("_", " "), _html.number(summary[name]))
            for name in ("status", "method", "particles", "steps", "simulated_seconds", "wall_seconds", "state_hash")
            if name in summary
        ]
        residual = summary.get("energy", {}).get("residual_relative")
        if residual is not None:
            rows.append(("energy residual", f"{residual:.1e} of the energy turned over"))
        numbers = [(name, value) for name, value in self.results.items() if isinstance(value, (int, float))]
        rows += [(name, f"{_html.number(value)} {units.get(name, '')}".rstrip(" -")) for name, value in numbers[:20]]
        if len(numbers) > 20:
            rows.append(("", f"and {len(numbers) - 20} more results"))
        rows += [("claim " + c["name"], "pass" if c["pass"] else "FAIL") for c in summary.get("claims", [])]
        rows += [("warning", text) for text in self.warnings]
        return _html.table(rows, str(self.folder))


class _Tables(Mapping[str, "pd.DataFrame"]):
    """Tables that are read when they are asked for."""

    def __init__(self, folder: Path) -> None:
        files = [*folder.glob("*.csv"), *(folder / "watch").glob("*.csv")]
        named = {file.relative_to(folder).with_suffix("").as_posix(): file for file in sorted(files)}
        named.pop("history", None)
        self._files = named
        self._read: dict[str, pd.DataFrame] = {}

    def __getitem__(self, name: str) -> pd.DataFrame:
        if name not in self._read:
            self._read[name] = _tables.read(self._files[name])
        return self._read[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._files)

    def __len__(self) -> int:
        return len(self._files)


def load(folder: str | os.PathLike[str]) -> Run:
    """Reads a folder of results: a run, a sweep, a response, a comparison or a verification."""
    path = Path(folder)
    tables = ("history.csv", "sweep.csv", "response.csv", "atlas.csv", "prediction.csv", "posterior.csv", "compare.csv")
    known = ("summary.json", *tables, "verify.json")
    if not any((path / name).is_file() for name in known):
        there = "has no results" if path.is_dir() else "is not a folder"
        raise _tsubu.Error(f"error: {path} {there}\nhint: name the folder that `run`, `sweep`, `response` or `compare` wrote")
    return Run(path)
