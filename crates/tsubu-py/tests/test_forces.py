"""Forces and motions from Python: they do what they say, and their work is in the books."""

import numpy as np
import pytest

import tsubu


def test_a_spring_swings_a_ball_as_in_the_textbook(free):
    sim = free.open(threads=1)
    mass = sim.grains["mass"][0]
    stiffness = mass * (2 * np.pi * 10.0) ** 2
    sim.add_force(lambda now: -stiffness * now["position"])
    sim.advance(seconds=0.1)
    position = sim.grains["position"][0]
    # A period and 0.01 m: the first step knows no force yet, which is one part in five thousand of a period.
    assert position[0] == pytest.approx(0.01, rel=1e-3)
    sim.advance(seconds=0.025)
    energy = sim.energy
    kinetic = 0.5 * mass * (0.01 * 2 * np.pi * 10) ** 2
    assert energy["outside work"] == pytest.approx(kinetic, rel=5e-3)
    assert abs(energy["residual_relative"]) < 1e-4
    assert energy["momentum residual"] < 1e-12


def test_work_that_is_not_posted_is_refused(free):
    """The gate of the test above refuses books without the account."""
    sim = free.open(threads=1)
    stiffness = sim.grains["mass"][0] * (2 * np.pi * 10.0) ** 2
    sim.add_force(lambda now: -stiffness * now["position"])
    energy = sim.advance(seconds=0.125).energy
    without = energy["residual"] + energy["outside work"]
    turned_over = energy["kinetic"] + energy["outside work"]
    assert abs(without / turned_over) > 0.1


def test_forces_in_a_bed_close_the_books(balls):
    quiet = balls.open(threads=1).advance()
    sim = balls.open(threads=2)

    def wind(now):
        force = np.zeros_like(now["velocity"])
        force[:, 0] = 2e-4 * np.sin(200 * now["time"]) - 1e-4 * now["velocity"][:, 0]
        torque = np.zeros_like(force)
        torque[:, 1] = 1e-8
        return force, torque

    sim.add_force(wind)
    sim.advance()
    assert sim.state_hash != quiet.state_hash
    assert abs(sim.energy["outside work"]) > 0.01 * sim.energy["kinetic"]
    assert abs(sim.energy["residual_relative"]) < 1e-3
    assert sim.energy["momentum residual"] < 1e-10
    single = balls.open(threads=1)
    single.add_force(wind)
    while single.steps < sim.steps:
        single.advance(steps=min(37, sim.steps - single.steps))
    assert single.state_hash == sim.state_hash


def test_a_force_cancels_gravity_and_is_no_contact_force(balls):
    balls.set("walls.floor.shape.plane.point", [0, -1.0])
    sim = balls.open(threads=1)
    sim.add_force(lambda now: np.outer(now["mass"], (0, 0, 9.81)), columns=["mass"])
    start = sim.grains["position"].copy()
    ids = sim.grains["id"].copy()
    sim.advance(seconds=0.02)
    order = {number: at for at, number in enumerate(sim.grains["id"])}
    now = sim.grains["position"][[order[number] for number in ids]]
    # Half a step of free fall, before the force was known.
    assert abs(now - start).max() < 1e-5
    assert abs(sim.grains["contact force"]).max() < 1e-9


def test_forces_hold_between_words_and_follow_their_grains(balls):
    calls = []

    def push(now):
        calls.append(now["step"])
        return np.outer(now["id"] % 2, (1e-4, 0, 0))

    sim = balls.open(threads=1)
    sim.add_force(push, every=10, columns=["id"])
    sim.advance(steps=100)
    assert calls == [1, *range(10, 101, 10)]
    assert abs(sim.energy["residual_relative"]) < 1e-3
    odd = sim.grains["id"] % 2 == 1
    assert sim.grains["velocity"][odd, 0].mean() > 10 * abs(sim.grains["velocity"][~odd, 0].mean())


def test_grains_that_come_and_go_feel_forces(stream):
    sim = stream.open(threads=1)
    sim.add_force(lambda now: (1e-5, 0, 0), every=3)
    sim.advance(seconds=0.09)
    assert abs(sim.energy["residual_relative"]) < 1e-3
    assert sim.energy["outside work"] > 0.0


def test_what_a_force_raises_is_raised(balls):
    sim = balls.open(threads=1)

    def fails(now):
        if now["step"] == 7:
            raise ZeroDivisionError("at the seventh step")

    sim.add_force(fails)
    with pytest.raises(ZeroDivisionError, match="seventh"):
        sim.advance(steps=100)
    assert sim.steps == 7
    sim.clear_forces()
    assert sim.advance().state_hash == balls.open(threads=1).advance().state_hash


@pytest.mark.parametrize(
    ("answer", "text"),
    [
        (np.zeros((3, 3)), "have the shape"),
        (np.zeros(60), "have the shape"),
        (np.full((60, 3), np.nan), "row 0 is not a number"),
        ("north", "could not convert"),
    ],
)
def test_wrong_forces_are_refused(balls, answer, text):
    sim = balls.open(threads=1)
    sim.add_force(lambda now: answer)
    with pytest.raises((tsubu.Error, ValueError), match=text):
        sim.advance(steps=1)


def test_a_force_sees_no_simulation_in_the_middle_of_a_step(balls):
    sim = balls.open(threads=1)
    sim.add_force(lambda now: sim.grains["position"])
    with pytest.raises(tsubu.Error, match="in the middle of a step"):
        sim.advance(steps=1)
    with pytest.raises(KeyError):
        sim.add_force(lambda now: None, columns=["colour"])


def test_a_wall_moves_as_it_is_told(balls, tmp_path):
    sim = balls.set("duration", 1).set("dem.largest-overlap", 0.3).open(threads=1).advance(seconds=0.02)
    lid = sim.walls["lid"]
    assert abs(lid.displacement).max() == 0.0
    begun = sim.time
    lid.velocity = (0, 0, -1.0)
    while lid.force[2] == 0.0 and sim.time < 0.2:
        sim.advance(steps=5)
    sim.advance(steps=5)
    assert lid.displacement[2] == pytest.approx(-1.0 * (sim.time - begun), rel=1e-9) and lid.velocity[2] == -1.0
    energy = sim.energy
    assert energy["outside work"] > 0.0 and energy["wall work"] == 0.0
    assert abs(energy["residual_relative"]) < 1e-3
    sim.checkpoint(tmp_path / "kept")
    again = balls.open(threads=1, resume=tmp_path / "kept")
    assert again.state_hash == sim.state_hash
    assert again.advance(steps=20).state_hash == sim.advance(steps=20).state_hash
    lid.motion = None
    place = lid.displacement[2]
    sim.advance(steps=20)
    assert lid.displacement[2] == place and lid.motion is None


def test_a_function_moves_a_wall(balls):
    sim = balls.open(threads=1)
    lid = sim.walls["lid"]
    lid.motion = lambda time: (0, 0, -3 * np.sin(60 * time))
    assert callable(lid.motion)
    sim.advance(seconds=0.04)
    assert lid.displacement[2] == pytest.approx(-3 * (1 - np.cos(60 * 0.04)) / 60, rel=1e-4)
    assert abs(sim.energy["residual_relative"]) < 1e-3
    sim.clear_calls()
    sim.advance(steps=3)


def test_a_controller_is_ten_lines(balls):
    """A lid that presses with a force that is wanted, by its velocity."""
    sim = balls.set("duration", 1).open(threads=1)
    lid, wanted = sim.walls["lid"], 0.05

    lid.velocity = (0, 0, -0.5)
    while lid.force[2] == 0.0:
        sim.advance(steps=20)

    def control(sim):
        lid.velocity = (0, 0, np.clip(0.2 * (lid.force[2] - wanted), -0.5, 0.5))

    sim.every(5, control)
    sim.advance(seconds=0.3)
    forces = []
    sim.every(5, lambda sim: forces.append(lid.force[2]))
    sim.advance(seconds=0.1)
    assert np.mean(forces) == pytest.approx(wanted, rel=0.2)
    assert abs(sim.energy["residual_relative"]) < 2e-3


def test_walls_that_forces_move_are_not_steered():
    sim = tsubu.template("damper").open(threads=1)
    with pytest.raises(tsubu.Error, match="host"):
        sim.walls["box"].velocity = (0, 0, 1)


def test_walls_in_the_plane_stay_in_it(balls):
    sim = balls.open(threads=1)
    with pytest.raises(tsubu.Error, match="in the plane"):
        sim.walls["lid"].velocity = (0, 1, 0)
    with pytest.raises(tsubu.Error, match="no velocity"):
        sim.walls["lid"].velocity = 3
    with pytest.raises(tsubu.Error, match="finite"):
        sim.walls["lid"].velocity = (0, 0, float("nan"))
