"""Scenes: what is asked."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Union

from tsubu import _html, _tsubu
from tsubu._progress import Progress, Shown
from tsubu._run import Run, load
from tsubu._simulation import Simulation

Folder = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Line:
    """One judgement on a scene."""

    good: bool
    """Whether there is nothing to change."""
    text: str
    """What was found."""
    advice: str
    """What to change, with the key; empty where nothing needs changing."""

    def __str__(self) -> str:
        word = "ok  " if self.good else "warn"
        return f"{word} {self.text}" + (f"\n       change: {self.advice}" if self.advice else "")


@dataclass(frozen=True)
class Verdict:
    """What `tsubu check` says of a scene, a line a judgement."""

    lines: tuple[Line, ...]
    """The judgements, in the order in which `tsubu check` prints them."""
    fails: bool
    """Whether the run would be refused, or would fail."""

    @property
    def good(self) -> bool:
        """Whether no line is a warning."""
        return all(line.good for line in self.lines)

    @property
    def text(self) -> str:
        """All lines, as the program prints them."""
        return "\n".join(map(str, self.lines))

    def __str__(self) -> str:
        return self.text

    def __iter__(self) -> Iterator[Line]:
        return iter(self.lines)

    def _repr_html_(self) -> str:
        return _html.table((("ok" if line.good else "warn"), line.text, line.advice) for line in self.lines)


class Scene:
    """A scene that is right: materials, grains, walls, laws, and what is to be done with them.

    Made by :meth:`read` or :meth:`from_dict`; a scene that is wrong raises :class:`Error` with all that is wrong with it.
    """

    def __init__(self, core: _tsubu.Scene, folder: str, changes: tuple[tuple[str, Any], ...] = ()) -> None:
        self._core = core
        self._folder = folder
        self._changes = changes

    @staticmethod
    def read(path: Folder, set: Mapping[str, Any] | None = None) -> Scene:
        """Reads a scene file, or the `scene.toml` in a folder; `set` changes keys, as :meth:`set` does."""
        path = Path(path)
        inside = path / "scene.toml"
        file = inside if inside.is_file() else path
        # Files that it names are looked for beside it, wherever this process goes.
        scene = Scene(_tsubu.Scene.read(file, []), os.path.abspath(file.parent))
        for key, value in (set or {}).items():
            scene.set(key, value)
        return scene

    @staticmethod
    def from_dict(scene: Mapping[str, Any], folder: Folder = ".") -> Scene:
        """A scene from a dictionary with the tables and keys of a scene file: `{"duration": "1 s", "materials": {...}}`.

        Keys are written as in the file, with dashes. Quantities are SI numbers, or text with a unit. Files that it names are looked
        for in `folder`.
        """
        folder = os.path.abspath(folder)
        return Scene(_tsubu.Scene.from_dict(dict(scene), folder), folder)

    def set(self, key: str, value: Any) -> Scene:
        """Gives a key another value, as `--set` does: `scene.set("particles.balls.count", 30)`; gives the scene back.

        A value that does not fit raises :class:`Error`, and the scene stays as it was.
        """
        self._core = self._core.with_value(key, value)
        self._changes += ((key, value),)
        return self

    def copy(self) -> Scene:
        """A scene like this one, to be changed by itself."""
        return Scene(self._core, self._folder, self._changes)

    @property
    def title(self) -> str:
        """Its title."""
        return self._core.title

    @property
    def method(self) -> str:
        """The method that runs it: `dem`, `lattice`, ..."""
        return self._core.method

    @property
    def duration(self) -> float:
        """How long it is simulated [s]; of a scene with stages, the first at most."""
        return self._core.duration

    @property
    def text(self) -> str:
        """What was typed, without changes."""
        return self._core.text

    @property
    def resolved(self) -> str:
        """The scene in SI numbers with every default written out, as `scene.toml` in a run folder has it."""
        return self._core.resolved()

    def check(self) -> Verdict:
        """Judges the scene without running it: is it resolved well enough, and what will it cost?"""
        fails, lines = self._core.check()
        return Verdict(tuple(Line(*line) for line in lines), fails)

    def run(
        self,
        folder: Folder | None = None,
        progress: Progress = True,
        overwrite: bool = False,
        resume: bool = False,
        threads: int | None = None,
    ) -> Run:
        """Runs the scene to its end, into a folder, and gives what is there; the same bits as `tsubu run`.

        `folder` is `out/` and the scene's name unless told. `progress` shows progress on stderr, or is called with the share that is
        done. `overwrite` replaces the results that are in the folder, `resume` goes on from its checkpoint. `threads` is the number of
        threads, one a core unless told; results are the same for any.

        Ctrl-C raises `KeyboardInterrupt` once a checkpoint is written. The interpreter is free for other threads meanwhile.
        """
        if overwrite and resume:
            raise _tsubu.Error("error: `overwrite` and `resume` cannot be had together")
        folder = self._out(folder, "")
        existing = "overwrite" if overwrite else "resume" if resume else "refuse"
        with Shown("run", progress) as shown:
            self._core.run(folder, existing, threads or 0, shown)
        return load(folder)

    def open(self, threads: int | None = None, resume: Folder | None = None) -> Simulation:
        """Opens the scene to be moved step by step, at its begin.

        `resume` names a folder with a checkpoint of this scene, from :meth:`Simulation.checkpoint` or from a run: it is opened there.
        `threads` is the number of threads, one a core unless told; results are the same for any. For simulations side by side in
        Python's threads one thread each is best.
        """
        return Simulation(self._core.open(threads or 0, resume), self)

    def _out(self, folder: Folder | None, suffix: str) -> Path:
        if folder is not None:
            return Path(folder)
        file = Path(self._core.name)
        name = file.stem if file.stem != "scene" else Path(os.path.abspath(file)).parent.name
        return Path("out") / f"{name}{suffix}"

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self._core.name, self._core.text, self._folder, self._changes)

    def __repr__(self) -> str:
        return f"<tsubu.Scene {self._core.name!r}: {self.title or 'without a title'}, method {self.method}>"

    def _repr_html_(self) -> str:
        changes = "".join(f"\n# set: {key} = {value}" for key, value in self._changes)
        return _html.text(self.text.rstrip() + changes, self.title)


def _restored(name: str, text: str, folder: str, changes: tuple[tuple[str, Any], ...]) -> Scene:
    """A scene in another process."""
    scene = Scene(_tsubu.Scene.parse(name, text, folder), folder)
    for key, value in changes:
        scene.set(key, value)
    return scene


def templates() -> dict[str, str]:
    """The example scenes: name, and a line about each."""
    return {name: about for name, about, _, _ in _tsubu.templates()}


def template(name: str) -> Scene:
    """An example scene by its name, as `tsubu new` writes it; one that names files must be written by the program."""
    known = {name: (text, files) for name, _, text, files in _tsubu.templates()}
    if name not in known:
        raise _tsubu.Error(f"error: there is no template `{name}`\nhint: there are {', '.join(known)}")
    text, files = known[name]
    if files:
        raise _tsubu.Error(f"error: `{name}` has files beside it\nhint: write it with `tsubu new {name}` and read that")
    return Scene(_tsubu.Scene.parse(f"{name}.toml", text, os.getcwd()), os.getcwd())
