"""Tables of a folder of results as frames of pandas."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from tsubu import _tsubu

if TYPE_CHECKING:
    import pandas as pd


def need(package: str, extra: str):
    """A package that not everybody has, or an error that says how to get it."""
    import importlib

    try:
        return importlib.import_module(package)
    except ImportError:
        raise _tsubu.Error(
            f"error: this needs the package `{package}`\nhint: pip install 'tsubu[{extra}]'"
        ) from None


def split_unit(header: str) -> tuple[str, str]:
    """Name and unit of a header cell `name [unit]`."""
    if header.endswith("]") and " [" in header:
        name, unit = header[:-1].rsplit(" [", 1)
        return name, unit
    return header, ""


def read(path: str | os.PathLike[str]) -> pd.DataFrame:
    """A CSV file of a folder of results: columns by name, their units in `attrs["units"]`."""
    pandas = need("pandas", "tables")
    path = Path(path)
    if not path.is_file():
        raise _tsubu.Error(f"error: cannot read {path}: there is no such file")
    with path.open(encoding="utf-8") as file:
        if not file.readline().strip():
            return pandas.DataFrame()
    frame = pandas.read_csv(path)
    pairs = [split_unit(header) for header in frame.columns]
    frame.columns = [name for name, _ in pairs]
    for name, unit in pairs:
        if unit == "text":
            frame[name] = [text if isinstance(text, str) else "" if text != text else str(text) for text in frame[name]]
    frame.attrs["units"] = {name: unit for name, unit in pairs if unit not in ("", "text")}
    return frame
