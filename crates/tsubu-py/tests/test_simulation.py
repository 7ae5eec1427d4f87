"""Simulations: the bits of a run, however the steps are cut."""

import gc
import multiprocessing
import os
import subprocess
import sys
import threading

import numpy as np
import pytest

import tsubu
from conftest import BALLS


def test_a_run_and_a_simulation_end_in_the_same_state(balls, tmp_path):
    run = balls.run(tmp_path / "out", progress=False)
    assert run.summary["status"] == "finished"
    for threads in (1, 2):
        whole = balls.open(threads=threads).advance()
        assert whole.state_hash == run.summary["state_hash"]
    pieces = balls.open(threads=2)
    sizes = iter([1, 2, 3, 50, 7] * 1000)
    while (left := run.summary["steps"] - pieces.steps) > 0:
        pieces.advance(steps=min(next(sizes), left))
        pieces.grains["position"], pieces.energy, pieces.contacts
    assert pieces.state_hash == run.summary["state_hash"]
    seconds = balls.open()
    for _ in range(10):
        seconds.advance(seconds=0.005)
    assert seconds.steps == run.summary["steps"] and seconds.state_hash == run.summary["state_hash"]
    other = balls.copy().set("seed", 6).open().advance()
    assert other.state_hash != run.summary["state_hash"]


def test_the_program_ends_in_the_same_state(balls, tmp_path):
    run = balls.run(tmp_path / "module", progress=False)
    line = ["run", str(tmp_path / "module"), "-o", str(tmp_path / "program"), "--quiet", "--threads", "1"]
    subprocess.run([sys.executable, "-m", "tsubu", *line], check=True)
    assert tsubu.load(tmp_path / "program").summary["state_hash"] == run.summary["state_hash"]


def test_a_checkpoint_goes_on_with_the_same_bits(balls, tmp_path):
    whole = balls.open(threads=1).advance()
    half = balls.open(threads=1).advance(seconds=0.02)
    half.checkpoint(tmp_path / "kept")
    again = balls.open(threads=1, resume=tmp_path / "kept")
    assert again.time == half.time and again.state_hash == half.state_hash
    assert again.advance().state_hash == whole.state_hash
    with pytest.raises(tsubu.Error, match="another scene"):
        balls.copy().set("gravity", 3).open(resume=tmp_path / "kept")
    half.checkpoint(tmp_path / "kept")


def test_a_scene_starts_from_a_checkpoint(balls, tmp_path):
    balls.open(threads=1).advance(seconds=0.02).checkpoint(tmp_path / "kept")
    later = balls.copy().set("start-from", str(tmp_path / "kept")).set("gravity", 0).open(threads=1)
    assert later.time == pytest.approx(0.02, rel=1e-3)


def test_stages_are_gone_over_by_hand():
    stages = [
        {"name": "fall", "duration": "20 ms"},
        {"name": "float", "duration": "10 ms", "set": {"gravity": 1.0}},
    ]
    scene = tsubu.Scene.from_dict({**{k: v for k, v in BALLS.items() if k != "duration"}, "stage": stages})
    sim = scene.open(threads=1)
    assert sim.stage == "fall"
    sim.advance()
    assert sim.time == pytest.approx(0.02, rel=1e-3)
    assert sim.next_stage() and sim.stage == "float"
    sim.advance()
    assert sim.time == pytest.approx(0.03, rel=1e-3) and not sim.next_stage()
    assert sim.energy["changes of stage"] != 0.0
    assert abs(sim.energy["residual_relative"]) < 1e-3


def test_books_walls_hosts_and_contacts(balls):
    sim = balls.open(threads=1).advance()
    energy = sim.energy
    assert abs(energy["residual_relative"]) < 1e-3 and energy["outside work"] == 0.0
    weight = sim.grains["mass"].sum() * 9.81
    assert list(sim.walls) == ["floor", "left", "lid", "right"]
    assert sim.walls["floor"].force[2] < 0 and abs(sim.walls["floor"].force[2]) < 50 * weight
    with pytest.raises(KeyError):
        sim.walls["roof"]
    contacts = sim.contacts
    assert set(contacts) >= {"first", "second", "position", "force", "normal", "overlap"}
    assert len(contacts["force"]) >= sim.touching > 0
    on_floor = contacts["second"] == -1
    np.testing.assert_allclose(-contacts["force"][on_floor].sum(axis=0), sim.walls["floor"].force, rtol=0.01, atol=1e-12)
    assert len(sim.hosts) == 0
    host = tsubu.template("damper").open(threads=1).advance(steps=50).hosts["leaf-spring"]
    assert host.displacement != 0.0 and "m/s" in repr(host)
    assert sim._repr_html_()


def test_automata_are_simulations_too():
    scene = tsubu.template("damper").set("method", "lattice")
    sim = scene.open(threads=1).advance(steps=200)
    before = sim.grains["position"]
    copy = before.copy()
    sim.advance(steps=200)
    assert (before == copy).all() and len(sim.grains["id"]) == 50
    with pytest.raises(tsubu.Error, match="lets itself be acted on"):
        sim.add_force(lambda now: None)


def test_simulations_side_by_side_in_threads(balls):
    hashes = {}

    def work(seed):
        sim = balls.copy().set("seed", seed).open(threads=1)
        for _ in range(20):
            sim.advance(seconds=0.0025)
        hashes[seed] = sim.state_hash

    threads = [threading.Thread(target=work, args=(seed,)) for seed in (1, 2, 3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for seed in (1, 2, 3):
        assert hashes[seed] == balls.copy().set("seed", seed).open(threads=1).advance().state_hash


def test_the_interpreter_is_free_while_steps_are_made(balls):
    balls.set("duration", 100)
    sim = balls.open(threads=1)
    counted, done = 0, threading.Event()

    def step():
        sim.advance(steps=20000)
        done.set()

    worker = threading.Thread(target=step)
    worker.start()
    while not done.wait(0.001):
        counted += 1
        if counted == 5:
            with pytest.raises(tsubu.Error, match="in the middle of a step"):
                sim.energy
    worker.join()
    assert counted > 5


def _hash(scene):
    return scene.open().advance().state_hash


@pytest.mark.parametrize("method", ["fork", "spawn"])
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_other_processes_get_the_same(balls, method):
    here = _hash(balls)
    with multiprocessing.get_context(method).Pool(2) as pool:
        assert pool.map(_hash, [balls, balls, balls]) == [here] * 3


def test_a_simulation_that_fails_says_why_and_stays_failed(balls):
    sim = balls.set("dem.largest-overlap", 0.02).set("gravity", 900).open(threads=1)
    with pytest.raises(tsubu.Error, match="step [0-9]+, t = ") as raised:
        sim.advance(seconds=1)
    assert raised.value.code == 3 and "hint: " in str(raised.value)
    with pytest.raises(tsubu.Error, match="has failed"):
        sim.advance(steps=1)


def test_what_is_closed_is_closed(balls):
    with balls.open(threads=1) as sim:
        positions = sim.grains["position"]
        kept = positions.copy()
    with pytest.raises(tsubu.Error, match="closed"):
        sim.time
    sim.close()
    gc.collect()
    assert (positions == kept).all()


def _resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="memory is read from /proc")
def test_memory_is_flat_over_a_thousand_opens(balls):
    def once():
        with balls.open(threads=1) as sim:
            sim.grains["position"], sim.walls["floor"].force
            sim.add_force(lambda now: None)
            sim.advance(steps=3)

    for _ in range(200):
        once()
    gc.collect()
    before = _resident()
    for _ in range(1000):
        once()
    gc.collect()
    assert _resident() - before < 4 << 20
