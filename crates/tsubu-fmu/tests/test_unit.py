"""Units as a tool has them: loaded, validated and moved by FMPy.

`TSUBU_FMU` is the program that packs units, `TSUBU` the program `tsubu`; `cargo xtask fmu` gives both.
"""

import csv
import ctypes
import os
import re
import subprocess
from math import cos, pi, sin
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu

SCENES = Path(__file__).parent / "scenes"
SHAKER = "hosts.structure.structure={ shaker = {} }"


def pack(folder, scene, *arguments):
    """A unit of a scene."""
    unit = folder / f"{scene}.fmu"
    command = [os.environ["TSUBU_FMU"], SCENES / f"{scene}.toml", "-o", unit, *arguments]
    subprocess.run(command, check=True)
    return str(unit)


class Unit:
    """A unit in motion, its variables by name; what it logs is kept."""

    def __init__(self, file, slave=FMU3Slave, start=0.0, folder=None, **told):
        about = fmpy.read_model_description(file)
        self.references = {variable.name: variable.valueReference for variable in about.modelVariables}
        self.log = []
        self.folder = folder or fmpy.extract(file)
        self.slave = slave(
            guid=about.guid,
            unzipDirectory=self.folder,
            modelIdentifier=about.coSimulation.modelIdentifier,
            instanceName="unit",
        )
        self.begin(slave, start, told)

    def begin(self, slave, start, told):
        if slave is FMU2Slave:
            self.slave.instantiate()
            self.slave.setupExperiment(startTime=start)
            self.slave.enterInitializationMode()
        else:
            self.slave.instantiate(logMessage=lambda _, status, kind, text: self.log.append((status, kind, text.decode())))
            self.slave.enterInitializationMode(startTime=start)
        self.tell(**told)
        self.slave.exitInitializationMode()

    def tell(self, **told):
        set_real = self.slave.setFloat64 if hasattr(self.slave, "setFloat64") else self.slave.setReal
        set_real([self.references[name.replace("__", ".")] for name in told], list(told.values()))

    def move(self, host, motion):
        names = ["displacement", "velocity", "acceleration"]
        self.tell(**{f"{host}__base__{name}": value for name, value in zip(names, motion)})

    def __getitem__(self, name):
        get_real = self.slave.getFloat64 if hasattr(self.slave, "getFloat64") else self.slave.getReal
        return get_real([self.references[name]])[0]

    def well(self):
        return bool(self.slave.getBoolean([self.references["well"]])[0])

    def all(self):
        return [self[name] for name in self.references if name != "well"]


def test_units_are_valid(tmp_path):
    """By the schema of the standard and the rules that FMPy knows beyond it; times, hosts and start are what the scene says."""
    for version in ["3", "2"]:
        unit = pack(tmp_path, "ball", "--step", "0.1 ms", "--fmi", version)
        assert validate_fmu(unit) == []
        about = fmpy.read_model_description(unit)
        assert about.modelName == "One ball & a <shaken> casing"
        assert about.defaultExperiment.stopTime == "0.8" and float(about.defaultExperiment.stepSize) == 1e-4
        inputs = {v.name: v.unit for v in about.modelVariables if v.causality == "input"}
        bases = {"displacement": "m", "velocity": "m/s", "acceleration": "m/s2"}
        assert inputs == {f"casing.base.{name}": unit for name, unit in bases.items()}


def test_every_function_of_the_standard_is_there(tmp_path):
    """All that the header of the standard declares; those not supported fail, and say why."""
    unit = Unit(pack(tmp_path, "ball"))
    header = (Path(fmpy.__file__).parent / "c-code/fmi3Functions.h").read_text()
    names = set(re.findall(r"\b(fmi3[A-Z]\w+)TYPE\b", header))
    assert len(names) > 60
    [library] = Path(unit.folder).glob("binaries/*/*")
    library = ctypes.CDLL(str(library))
    assert [name for name in sorted(names) if not hasattr(library, name)] == []
    with pytest.raises(Exception, match="fmi3Error|status 3"):
        unit.slave.getInt32([1])
    assert unit.log[-1] == (3, b"logStatusError", "fmi3GetInt32: not supported: all numbers of this unit are Float64, all truth values outputs")


def weigh(unit, step, duration):
    """The force on the casing over each step once the ball has come to rest, and minus mass times acceleration plus gravity."""
    mass, gravity, rate = 2e-3, 9.8, 2 * pi * 2
    amplitude = 0.3 * 9.8 / rate**2
    told, known = [], []
    for n in range(round(duration / step)):
        time = n * step
        motion = [f(rate * time) * amplitude for f in (sin, lambda x: rate * cos(x), lambda x: -(rate**2) * sin(x))]
        unit.move("casing", motion)
        before = unit["casing.velocity"]
        unit.slave.doStep(time, step)
        if time > 0.2:
            told.append(unit["casing.mean_force"])
            known.append(-mass * (gravity + (unit["casing.velocity"] - before) / step))
    return np.array(told), np.array(known)


def test_a_ball_at_rest_is_a_rigid_mass(tmp_path):
    """Below 1 g it stays on the floor, and its force is m (a + g), downwards. Control: the force with the other sign is refused."""
    unit = Unit(pack(tmp_path, "ball", "--step", "0.1 ms"), casing__base__velocity=0.3 * 9.8 / (2 * pi * 2))
    told, known = weigh(unit, 1e-4, 0.8)
    error = lambda force: np.abs(force - known).max() / np.abs(known).max()
    assert error(told) < 1e-3, error(told)
    assert error(-told) > 1
    assert unit.well()
    # What the base did is in the grains, or lost; books close.
    assert abs(unit["energy_residual"]) < 1e-3
    assert unit["dissipated_energy"] > 0


def outside(unit, step, duration, sign=1, load="force"):
    """The structure of the scene moved here, by velocity Verlet, under the force of the grains there: displacement at each ms."""
    mass, stiffness, damping = 86e-3, 123.4, 0.08
    amplitude, rate = 0.5e-3, 2 * pi * 6.028767
    base = lambda t: (amplitude * sin(rate * t), amplitude * rate * cos(rate * t))
    u, v, a = 0.0, 0.0, damping * amplitude * rate / mass
    way = [0.0]
    each = round(1e-3 / step)
    for n in range(round(duration / step)):
        unit.move("structure", [u, v, a])
        unit.slave.doStep(n * step, step)
        force = sign * unit[f"structure.{load}"]
        y, y_rate = base((n + 1) * step)
        u += step * (v + 0.5 * step * a)
        half = v + 0.5 * step * a
        a = (force - damping * (half - y_rate) - stiffness * (u - y)) / (mass + 0.5 * step * damping)
        v = half + 0.5 * step * a
        if (n + 1) % each == 0:
            way.append(u)
    return np.array(way)


def inside(folder):
    """The same scene run by `tsubu` itself: its history."""
    subprocess.run([os.environ["TSUBU"], "run", SCENES / "impact.toml", "-o", folder / "run", "--quiet"], check=True)
    with open(folder / "run/history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def test_a_structure_outside_moves_as_one_inside(tmp_path):
    """An oscillator that is moved in Python under the force of the unit goes where `structure.oscillator` goes in a run, with the same energies.
    Control: with the sign of the force wrong it does not."""
    known = inside(tmp_path)
    way = known["host structure displacement [m]"]
    difference = lambda found: np.abs(found - way).max() / np.abs(way).max()
    unit = Unit(pack(tmp_path, "impact", "--set", SHAKER))
    # Not to the last digit: the step of the contact knows of the mass of a structure inside, 43 times that of the ball.
    assert difference(outside(unit, 1e-5, 1.0)) < 1e-4
    assert unit["kinetic_energy"] == pytest.approx(known["kinetic energy [J]"][-1], rel=1e-3)
    assert unit["dissipated_energy"] == pytest.approx(known["normal damping [J]"][-1], rel=1e-3)
    # Steps of a third of an impact, and of more than a whole one, of which the force at their ends misses a part.
    for step, load, most in [(1e-4, "force", 2e-2), (5e-4, "mean_force", 4e-2)]:
        unit = Unit(pack(tmp_path, "impact", "--set", SHAKER, "--step", str(step)))
        assert difference(outside(unit, step, 1.0, load=load)) < most
        assert unit["dissipated_energy"] == pytest.approx(known["normal damping [J]"][-1], rel=5e-2)
        unit = Unit(pack(tmp_path, "impact", "--set", SHAKER, "--step", str(step)))
        assert difference(outside(unit, step, 1.0, sign=-1, load=load)) > 0.1


@pytest.mark.parametrize("method", ["dem", "lattice"])
def test_the_base_of_a_structure_inside_is_told(tmp_path, method):
    """A unit with the structure inside, whose base is told the sine of the scene, goes where a run goes. Control: told nothing it does not."""
    scene = SCENES.parents[3] / "scenes/damper.toml"
    changes = [f"method={method}", "dem.time-step=5e-6", "duration=0.3"]
    changes = [word for change in changes for word in ("--set", change)]
    subprocess.run([os.environ["TSUBU"], "run", scene, "-o", tmp_path / "run", "--quiet", *changes], check=True)
    with open(tmp_path / "run/history.csv", newline="") as file:
        known = {name: float(value) for name, value in list(csv.DictReader(file))[-1].items()}
    way = known["host leaf-spring displacement [m]"]
    file = str(tmp_path / "damper.fmu")
    subprocess.run([os.environ["TSUBU_FMU"], scene, "-o", file, "--step", "0.1 ms", *changes], check=True)
    amplitude, rate = 0.5e-3, 2 * pi * 5.7
    unit, still = Unit(file, **{"leaf-spring__base__velocity": amplitude * rate}), Unit(file)
    for n in range(3000):
        phase = rate * n * 1e-4
        unit.move("leaf-spring", [amplitude * sin(phase), amplitude * rate * cos(phase), -amplitude * rate**2 * sin(phase)])
        unit.slave.doStep(n * 1e-4, 1e-4)
        still.slave.doStep(n * 1e-4, 1e-4)
    assert unit["time"] == pytest.approx(known["time [s]"], abs=1e-9)
    assert unit["leaf-spring.displacement"] == pytest.approx(way, rel=1e-4)
    assert unit["base_work"] == pytest.approx(known["base work [J]"], rel=1e-4)
    assert abs(still["leaf-spring.displacement"] / way - 1) > 0.1


def test_a_tool_of_its_own_moves_it(tmp_path):
    """`simulate_fmu`, with inputs as a table, starts at another time than 0 too."""
    unit = pack(tmp_path, "ball", "--step", "1 ms")
    found = fmpy.simulate_fmu(unit, start_time=2.0, stop_time=2.3, output_interval=1e-3)
    assert found["time"][-1] == pytest.approx(2.3)
    assert found["casing.mean_force"][-1] == pytest.approx(-2e-3 * 9.8, rel=1e-3)
    assert np.abs(found["casing.displacement"]).max() == 0


def test_instances_do_not_meddle(tmp_path):
    """Two of one library, moved in turn, have the bits of one alone; so has one that was reset, one that went back to a state, and a unit of
    version 2.0."""
    file = pack(tmp_path, "ball", "--step", "0.1 ms")

    def go(unit, steps):
        for n in steps:
            unit.move("casing", [1e-3 * sin(n * 1e-2), 0.1 * cos(n * 1e-2), -10 * sin(n * 1e-2)])
            unit.slave.doStep(n * 1e-4, 1e-4)

    alone, one = Unit(file), Unit(file)
    two = Unit(file, folder=one.folder)
    go(alone, range(600))
    for n in range(600):
        go(one, [n])
        if n < 300:
            two.move("casing", [0, 0, 1])
            two.slave.doStep(n * 1e-4, 1e-4)
    assert one.all() == alone.all() != two.all()

    one.slave.reset()
    one.slave.enterInitializationMode()
    one.slave.exitInitializationMode()
    go(one, range(300))
    state = one.slave.getFMUState()
    go(one, range(300, 600))
    assert one.all() == alone.all()
    one.slave.setFMUState(state)
    assert one["time"] == pytest.approx(0.03)
    go(one, range(300, 600))
    assert one.all() == alone.all()
    one.slave.freeFMUState(state)

    older = Unit(pack(tmp_path, "ball", "--step", "0.1 ms", "--fmi", "2"), FMU2Slave)
    go(older, range(600))
    assert older.all() == alone.all()
    for unit in [alone, one, two, older]:
        unit.slave.terminate()
        unit.slave.freeInstance()


def test_what_is_wrong_is_said(tmp_path):
    """By the logger, in the words of the project; a step that does not fit moves nothing, and one that does goes on."""
    unit = Unit(pack(tmp_path, "ball", "--step", "0.1 ms"))

    def refused(point, step):
        with pytest.raises(Exception):
            unit.slave.doStep(point, step)
        status, _, text = unit.log[-1]
        assert status == 3
        return text

    text = refused(0, 1.03e-4)
    assert "must be a whole number of them" in text and "hint: take 0.0001" in text, text
    assert "where the grains are at 0 s" in refused(0.5, 1e-4)
    unit.slave.doStep(0, 1e-4)
    assert unit["time"] == 1e-4

    with pytest.raises(Exception):
        unit.tell(casing__force=1.0)
    assert "`casing.force` cannot be set" in unit.log[-1][2]

    # A casing that is torn away crushes the ball: the step fails, values can still be read, nothing goes on.
    unit.move("casing", [0.0, 300.0, 1e6])
    assert "overlaps" in refused(1e-4, 1e-4) and not unit.well()
    assert "reset the instance" in refused(2e-4, 1e-4)


def test_a_scene_that_was_changed_is_refused(tmp_path):
    """The scene in a unit is bound to its description."""
    file = pack(tmp_path, "ball")
    about, folder, log = fmpy.read_model_description(file), fmpy.extract(file), []
    scene = Path(folder) / "resources/scene.toml"
    scene.write_text(scene.read_text().replace("9.8", "9.7"))
    slave = FMU3Slave(guid=about.guid, unzipDirectory=folder, modelIdentifier="tsubu", instanceName="changed")
    with pytest.raises(Exception):
        slave.instantiate(logMessage=lambda _, status, kind, text: log.append(text.decode()))
    assert "do not belong together" in log[0]


def test_a_scene_without_a_base_is_no_unit(tmp_path):
    """Said when it is packed; nothing is written."""
    scene = tmp_path / "free.toml"
    text = (SCENES / "ball.toml").read_text().replace('host = "casing"\n', "").split("[hosts.casing]")
    scene.write_text(text[0] + "[contact]" + text[1].split("[contact]")[1])
    done = subprocess.run([os.environ["TSUBU_FMU"], scene, "-o", tmp_path / "free.fmu"], capture_output=True, text=True)
    assert done.returncode == 2 and "no host of this scene has a `base`" in done.stderr
    assert not (tmp_path / "free.fmu").exists()
