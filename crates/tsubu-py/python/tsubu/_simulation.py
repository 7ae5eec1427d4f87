"""Simulations: scenes that are moved step by step."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

from tsubu import _html, _tsubu
from tsubu._run import Frame

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike

    from tsubu._scene import Scene

Motion = Union["ArrayLike", Callable[[float], "ArrayLike"]]


class Grains(Mapping[str, "np.ndarray"]):
    """The grains of a simulation as arrays by column, named as in the frames, a row a grain.

    `id` and `group` [-], `position` [m], `velocity` [m/s], `spin` [rad/s], `radius` [m] and `mass` [kg] are views of the engine's own
    memory, which nobody may write to. Taking one copies nothing. Rows are in the order of the engine, which changes when it sorts grains
    anew: `id` says which is which. An array shows the moment it was taken at, and stays right whatever becomes of the grains after that: if
    it is still held when the simulation goes on, the engine goes on with a copy. Other columns (`contact force` [N], `water force` [N],
    `orientation`) are copies in the same order.
    """

    def __init__(self, core: _tsubu.Simulation) -> None:
        self._core = core

    def __getitem__(self, column: str) -> np.ndarray:
        return self._core.grain_column(column)

    def __iter__(self) -> Iterator[str]:
        return iter(name for name, _ in self._core.grain_columns())

    def __len__(self) -> int:
        return len(self._core.grain_columns())

    @property
    def units(self) -> dict[str, str]:
        """The unit of each column."""
        return dict(self._core.grain_columns())

    @property
    def count(self) -> int:
        """How many grains there are now."""
        return self._core.particles

    def __repr__(self) -> str:
        return f"<tsubu.Grains: {self.count} grains; {', '.join(self)}>"


class Wall:
    """A wall of a simulation, as it is now."""

    def __init__(self, sim: Simulation, name: str) -> None:
        self._sim = sim
        self.name = name
        """Its name in the scene."""

    def _now(self, what: str) -> Any:
        return self._sim._core.wall(self.name)[what]

    @property
    def force(self) -> np.ndarray:
        """Force of the grains on it [N]."""
        return self._now("force")

    @property
    def torque(self) -> np.ndarray:
        """Torque of the grains about its centre of rotation [N.m]."""
        return self._now("torque")

    @property
    def displacement(self) -> np.ndarray:
        """How far it has moved from where it was drawn [m]."""
        return self._now("displacement")

    @property
    def centre(self) -> np.ndarray:
        """Its centre of rotation now [m]."""
        return self._now("centre")

    @property
    def vanished(self) -> bool:
        """Whether it has vanished."""
        return self._now("vanished")

    @property
    def velocity(self) -> np.ndarray:
        """Velocity of its centre of rotation [m/s]. Set, it holds until it is set again, from where the wall stands; whatever moved the
        wall before has no say any more. A wall that a host, a servo or the grains move refuses. Its work is `outside work`."""
        return self._now("velocity")

    @velocity.setter
    def velocity(self, velocity: ArrayLike) -> None:
        self._sim._motions.pop(self.name, None)
        self._sim._core.steer(self.name, _three(velocity), _three(self.spin))

    @property
    def spin(self) -> np.ndarray:
        """Spin about its centre of rotation [rad/s]. It is set as the velocity is."""
        return self._now("spin")

    @spin.setter
    def spin(self, spin: ArrayLike) -> None:
        self._sim._core.steer(self.name, _three(self.velocity), _three(spin))

    @property
    def motion(self) -> Motion | None:
        """Who moves it from Python: a function of the time [s] that gives the velocity [m/s], asked in every step for the middle of it;
        a velocity, which holds; or nothing. For other intervals see :meth:`Simulation.drive`."""
        driven = self._sim._motions.get(self.name)
        return driven[0] if driven else None

    @motion.setter
    def motion(self, motion: Motion | None) -> None:
        if callable(motion):
            self._sim.drive(self.name, motion)
        else:
            self.velocity = (0.0, 0.0, 0.0) if motion is None else motion

    def __repr__(self) -> str:
        return f"<tsubu.Wall {self.name!r}>"


class Walls(Mapping[str, Wall]):
    """The walls of a simulation by name."""

    def __init__(self, sim: Simulation) -> None:
        self._sim = sim

    def __getitem__(self, name: str) -> Wall:
        if name not in self._sim._core.wall_names():
            raise KeyError(name)
        return Wall(self._sim, name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._sim._core.wall_names())

    def __len__(self) -> int:
        return len(self._sim._core.wall_names())


class Host:
    """A host of a simulation, as it is now."""

    def __init__(self, name: str, displacement: float, velocity: float, force: float) -> None:
        self.name = name
        """Its name in the scene."""
        self.displacement = displacement
        """Displacement along its direction [m]."""
        self.velocity = velocity
        """Velocity along its direction [m/s]."""
        self.force = force
        """Force of the grains on it along its direction [N]."""

    def __repr__(self) -> str:
        return f"<tsubu.Host {self.name!r}: {self.displacement:.4g} m, {self.velocity:.4g} m/s, {self.force:.4g} N>"


class Hosts(Mapping[str, Host]):
    """The hosts of a simulation by name."""

    def __init__(self, core: _tsubu.Simulation) -> None:
        self._core = core

    def _now(self) -> dict[str, Host]:
        return {told[0]: Host(*told) for told in self._core.hosts()}

    def __getitem__(self, name: str) -> Host:
        return self._now()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._now())

    def __len__(self) -> int:
        return len(self._core.hosts())


class Simulation:
    """A scene that is moved step by step. :meth:`Scene.open` makes it; a `with` block closes it.

    It computes what a run computes, with the same bits, however the steps are cut into calls. It writes no files, watches nothing and ends
    no stage by itself.
    """

    def __init__(self, core: _tsubu.Simulation, scene: Scene) -> None:
        self._core = core
        self._motions: dict[str, tuple[Callable[[float], ArrayLike], int]] = {}
        self._steered: set[str] = set()
        self._aim = (-1, 0.0)
        self._listeners: list[tuple[Callable[[Simulation], object], int]] = []
        self.scene = scene
        """The scene."""
        self.grains = Grains(core)
        """The grains as arrays by column."""
        self.walls = Walls(self)
        """The walls by name."""
        self.hosts = Hosts(core)
        """The hosts by name."""

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self._core.time

    @property
    def steps(self) -> int:
        """Steps since time 0."""
        return self._core.steps

    @property
    def time_step(self) -> float:
        """Time step [s]."""
        return self._core.time_step

    @property
    def stage(self) -> str | None:
        """The name of the present stage, where the scene has stages."""
        return self._core.stage

    @property
    def contacts(self) -> Mapping[str, np.ndarray]:
        """The touching pairs as arrays by column, named as in the frames: `first` and `second` are ids (a wall is -1 less its number),
        `position` [m], `force` [N] on the first, `normal` [-], `overlap` [m]. They are computed anew, at about the cost of a step."""
        return self.frame().contacts

    @property
    def touching(self) -> int:
        """How many pairs touched in the last step."""
        return self._core.touching

    @property
    def energy(self) -> dict[str, float]:
        """The books [J]: what grains, walls and hosts hold now, what each account has come to since time 0, `residual`, what they cannot
        explain, `residual_relative`, its share of the energy turned over [-], and `momentum residual` [N.s]. What functions of Python and
        walls that they move have done is `outside work`."""
        return self._core.energy()

    @property
    def state_hash(self) -> str:
        """Hash of everything that the next step depends on, as in `summary.json` of a run."""
        return self._core.state_hash()

    def advance(self, seconds: float | None = None, steps: int | None = None) -> Simulation:
        """Moves everything by so many seconds, or by so many steps; without either, to the end of the present stage.

        Seconds end with the step that is nearest, and add up from call to call. The interpreter is free for other threads meanwhile. Ctrl-C raises `KeyboardInterrupt`
        between two steps, and the simulation can go on. What a function of Python raises is raised here when its step is done.
        """
        if seconds is not None and steps is not None:
            raise _tsubu.Error("error: `seconds` and `steps` cannot be had together")
        if steps is None and seconds is not None:
            # Seconds add up, whatever was rounded to whole steps before.
            before, wanted = self._aim
            wanted = (wanted if before == self.steps else self.time) + seconds
            steps = self._core.steps_to(wanted) if seconds >= 0 else -1
            self._aim = (self.steps + steps, wanted)
        elif steps is None:
            steps = self._core.steps_left()
        if steps < 0:
            raise _tsubu.Error("error: time does not go back\nhint: open the scene again, or a checkpoint with `resume`")
        if not self._motions and not self._listeners:
            self._core.advance(steps)
            return self
        end = self.steps + steps
        while (now := self.steps) < end:
            after = min(
                (now // every + 1) * every for _, every in [*self._motions.values(), *self._listeners]
            )
            piece = min(after, end) - now
            for name, (function, every) in self._motions.items():
                if now % every == 0 or name not in self._steered:
                    middle = self.time + 0.5 * every * self.time_step
                    self._core.steer(name, _three(function(middle)), _three(self.walls[name].spin))
                    self._steered.add(name)
            self._core.advance(piece)
            for listener, every in list(self._listeners):
                if self.steps % every == 0:
                    listener(self)
        return self

    def next_stage(self) -> bool:
        """Goes over to the next stage of the scene now, whatever the present one waits for; says whether there is one."""
        return self._core.next_stage()

    def add_force(
        self,
        function: Callable[[dict[str, Any]], Any],
        every: int = 1,
        columns: Sequence[str] = ("position", "velocity"),
    ) -> None:
        """From now on a function says what forces act on the grains, in every `every`-th step; they hold in between.

        It is called in the middle of a step with a dictionary: `time` [s] and `step` of its end, and the `columns` as read-only arrays, as
        :attr:`grains` has them: positions of that time, velocities predicted for it. It gives forces [N] as an array of the shape
        (grains, 3), one row for all grains, a pair of forces and torques [N.m], or `None` for no force. Grains that forces do not move
        feel nothing. Work and impulse are in the books, as `outside work`. Several functions add up.

        A call costs some microseconds and what the function does; with a function every step is whole, which costs some per cent. A function that
        names the simulation keeps it alive until :meth:`clear_forces` or :meth:`close`. After a
        resume add it again: with `every=1` the bits are those of a simulation that was never stopped.
        """
        self._core.act(function, every, list(columns))

    def clear_forces(self) -> None:
        """Nobody says what forces act any more."""
        self._core.leave()

    def drive(self, wall: str, function: Callable[[float], ArrayLike], every: int = 1) -> None:
        """From now on a function of the time [s] says the velocity [m/s] of a wall, for `every` steps at a time and for the middle of
        them. It may look at the simulation: between steps all of it can be read."""
        self._core.steer(wall, _three(self.walls[wall].velocity), _three(self.walls[wall].spin))
        self._motions[wall] = (function, max(1, every))
        self._steered.discard(wall)

    def every(self, steps: int, function: Callable[[Simulation], object]) -> None:
        """From now on calls a function with this simulation after every so many steps, for a controller or a record: it may read everything
        and move walls."""
        self._listeners.append((function, max(1, steps)))

    def clear_calls(self) -> None:
        """Calls no functions between steps any more: walls go on with the velocity that they have."""
        self._listeners.clear()
        self._motions.clear()

    def frame(self) -> Frame:
        """This moment as a frame: all columns of grains, contacts and walls, grains in the order of their ids."""
        return Frame(self._core.frame())

    def checkpoint(self, folder: str | os.PathLike[str]) -> None:
        """Writes scene and state into a folder. `scene.open(resume=folder)` goes on from there with the same bits, and so does a scene with
        `start-from`. Functions of Python are not written."""
        self._core.checkpoint(folder)

    def close(self) -> None:
        """Gives the memory back; arrays that are held stay as they are."""
        self._core.close()

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<tsubu.Simulation: t = {self.time:.6g} s, {self.steps} steps, {self.grains.count} grains>"

    def _repr_html_(self) -> str:
        energy = self.energy
        rows = [
            ("time", f"{self.time:.6g} s"),
            ("steps", f"{self.steps} of {self.time_step:.3g} s"),
            ("grains", self.grains.count),
            ("touching pairs", self.touching),
            ("kinetic energy", f"{energy['kinetic'] + energy['rotational']:.4g} J"),
            ("energy residual", f"{energy['residual_relative']:.1e} of the energy turned over"),
        ]
        return _html.table(rows, self.scene.title)


def _three(vector: Any) -> tuple[float, float, float]:
    """Three numbers."""
    try:
        x, y, z = map(float, vector)
    except (TypeError, ValueError):
        raise _tsubu.Error(
            f"error: `{vector}` is no velocity\nhint: give three numbers, along x, y and z, in m/s or rad/s"
        ) from None
    return x, y, z
