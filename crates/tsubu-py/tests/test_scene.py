"""Scenes, verdicts and errors."""

import pickle
import subprocess
import sys

import pytest

import tsubu
from conftest import BALLS


def test_a_scene_is_read_set_and_told(tmp_path):
    file = tmp_path / "drop.toml"
    file.write_text(tsubu.template("drop").text)
    scene = tsubu.Scene.read(file)
    assert scene.method == "dem" and scene.title
    count = len(scene.open(threads=1).grains["id"])
    assert count == 1
    before = scene.duration
    assert scene.set("duration", "0.25 s") is scene
    assert scene.duration == 0.25 != before
    assert "duration = 0.25" in scene.resolved


def test_a_wrong_scene_says_what_the_program_says(tmp_path):
    file = tmp_path / "wrong.toml"
    file.write_text(tsubu.template("drop").text.replace("restitution", "restituton", 1))
    with pytest.raises(tsubu.Error) as raised:
        tsubu.Scene.read(file)
    text = str(raised.value)
    assert "restituton" in text and "did you mean `restitution`?" in text and "wrong.toml:" in text
    assert raised.value.code == 2
    line = [sys.executable, "-m", "tsubu", "check", str(file)]
    program = subprocess.run(line, capture_output=True, text=True, check=False)
    assert program.returncode == 2 and program.stderr.strip() == text


def test_a_value_that_does_not_fit_leaves_the_scene_as_it_was(balls):
    with pytest.raises(tsubu.Error, match="no such key|unknown|did you mean"):
        balls.set("particles.balls.cuont", 30)
    with pytest.raises(tsubu.Error, match="is no value of a scene"):
        balls.set("particles.balls.count", object())
    assert len(balls.open(threads=1).grains["id"]) == 60


def test_numpy_values_are_values(balls):
    numpy = pytest.importorskip("numpy")
    balls.set("particles.balls.count", numpy.int64(7)).set("gravity", numpy.float64(3.5))
    assert len(balls.open(threads=1).grains["id"]) == 7


def test_the_verdict_is_text_and_a_table(balls):
    verdict = balls.check()
    assert not verdict.fails and verdict.lines
    assert all(line[:4] in ("ok  ", "warn", "    ") for line in verdict.text.splitlines())
    assert verdict._repr_html_().count("<tr>") == len(verdict.lines)
    assert balls._repr_html_().startswith("<div>")


def test_a_scene_that_blows_up_warns(balls):
    verdict = balls.set("dem.time-step", "1 ms").check()
    assert not verdict.good and "change: " in verdict.text and "dem.time-step" in verdict.text


def test_a_scene_goes_to_other_processes(balls):
    balls.set("particles.balls.count", 9)
    other = pickle.loads(pickle.dumps(balls))
    assert other.open(threads=1).state_hash == balls.open(threads=1).state_hash


def test_a_copy_is_changed_by_itself(balls):
    other = balls.copy().set("particles.balls.count", 5)
    assert len(balls.open(threads=1).grains["id"]) == 60
    assert len(other.open(threads=1).grains["id"]) == 5


def test_text_in_html_is_no_markup():
    scene = tsubu.Scene.from_dict({**BALLS, "title": "<b>bold</b>"})
    assert "<b>bold" not in scene._repr_html_()
