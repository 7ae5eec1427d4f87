"""Arrays of grains: nothing is copied when one is taken, and none is ever wrong, whatever becomes of the grains."""

import gc

import numpy as np
import pytest


def test_a_view_copies_nothing(balls):
    sim = balls.open(threads=1)
    first, second = sim.grains["position"], sim.grains["position"]
    assert np.shares_memory(first, second) and not first.flags.owndata
    assert first.shape == (60, 3) and first.dtype == np.float64
    assert sim.grains["id"].dtype == np.uint32 and sim.grains["mass"].shape == (60,)
    # No array is held when the steps are made: the engine goes on in its own memory.
    address = first.ctypes.data
    del first, second
    gc.collect()
    sim.advance(steps=1)
    assert sim.grains["position"].ctypes.data == address


def test_nobody_writes_into_a_view(balls):
    position = balls.open(threads=1).grains["position"]
    with pytest.raises(ValueError, match="read-only"):
        position[0] = 0.0
    with pytest.raises(ValueError):
        position.flags.writeable = True


def test_columns_have_the_names_and_units_of_frames(balls):
    sim = balls.open(threads=1).advance()
    frame = sim.frame()
    assert set(sim.grains) == set(frame.grains)
    assert sim.grains.units["velocity"] == "m/s" == frame.units["grains"]["velocity"]
    order = np.argsort(sim.grains["id"])
    for name in sim.grains:
        np.testing.assert_array_equal(sim.grains[name][order], frame.grains[name])
    with pytest.raises(KeyError):
        sim.grains["colour"]


def _moves_on(sim, step):
    """Arrays that are held, and what was in them."""
    held = {name: sim.grains[name] for name in ("id", "position", "velocity", "spin", "radius", "mass", "group")}
    kept = {name: array.copy() for name, array in held.items()}
    slices = held["position"][::2, 1]
    step()
    # Memory that was freed would be written over by now.
    [np.full(array.shape, 7.5) for array in held.values() for _ in range(20)]
    gc.collect()
    for name, array in held.items():
        np.testing.assert_array_equal(array, kept[name])
    np.testing.assert_array_equal(slices, kept["position"][::2, 1])
    return held


def test_a_view_outlives_steps(balls):
    sim = balls.open(threads=1)
    held = _moves_on(sim, lambda: sim.advance(steps=1))
    assert not np.shares_memory(held["position"], sim.grains["position"])


def test_a_view_outlives_sorting(balls):
    # A few grains are not sorted at all.
    balls.set("walls.lid.shape.plane.point", [0, 0.5]).set("particles.balls.start.rows.region.high", [0.02, 0.45])
    sim = balls.set("particles.balls.count", 700).open(threads=2)
    before = sim.grains["id"].copy()
    _moves_on(sim, lambda: sim.advance(seconds=0.2))
    assert (sim.grains["id"] != before).any(), "the grains were not sorted anew"


def test_a_view_outlives_insertion_and_removal(stream):
    sim = stream.open(threads=1)
    sim.advance(seconds=0.01)
    come = sim.grains.count
    assert 0 < come < 40
    _moves_on(sim, lambda: sim.advance(seconds=0.01))
    assert sim.grains.count > come
    most = sim.grains.count
    for _ in range(100):
        _moves_on(sim, lambda: sim.advance(seconds=0.005))
        if sim.grains.count < most:
            return
        most = max(most, sim.grains.count)
    pytest.fail("no grain was removed")


def test_a_view_outlives_its_simulation(balls):
    sim = balls.open(threads=1).advance(steps=10)
    position = sim.grains["position"]
    kept = position.copy()
    del sim
    gc.collect()
    [np.full(position.shape, 7.5) for _ in range(50)]
    np.testing.assert_array_equal(position, kept)


def test_an_array_that_a_force_keeps_stays_right(balls):
    sim = balls.open(threads=1)
    seen = []

    def watch(now):
        seen.append((now["position"], now["position"].copy(), now["time"]))

    sim.add_force(watch)
    sim.advance(steps=50)
    assert len(seen) == 50 and seen[-1][2] == pytest.approx(sim.time)
    for kept, copy, _ in seen:
        np.testing.assert_array_equal(kept, copy)
    np.testing.assert_array_equal(seen[-1][0], sim.grains["position"])
    assert sim.advance().state_hash == balls.open(threads=1).advance().state_hash, "a force of nothing changed bits"
