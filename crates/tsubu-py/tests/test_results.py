"""Folders of results as tables, arrays and pictures."""

import json
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import tsubu

pandas = pytest.importorskip("pandas")


@pytest.fixture
def run(balls, tmp_path):
    return balls.run(tmp_path / "out", progress=False)


def test_a_run_is_read_back(run):
    assert run.summary["particles"] == 60
    history = run.history
    assert history["time"].iloc[-1] == pytest.approx(0.05, rel=1e-3) and history.attrs["units"]["kinetic energy"] == "J"
    assert "outside work" in history.columns
    assert len(run.frames) == 6 and run.frames.times[-1] == pytest.approx(0.05, rel=1e-3)
    frame = run.frames[-1]
    assert frame.grains["position"].shape == (60, 3) and frame.units["grains"]["position"] == "m"
    np.testing.assert_array_equal(frame.grains["id"], np.arange(60))
    table = frame.to_pandas()
    assert list(table.columns)[:2] == ["id", "group"] and "position z" in table.columns
    assert table.attrs["units"]["position x"] == "m"
    assert run.scene.title == "Balls in a box"
    assert "finished" in repr(run) and "state hash" in run._repr_html_()
    assert [len(part.grains["id"]) for part in run.frames[:2]] == [60, 60]
    with pytest.raises(IndexError):
        run.frames[99]


def test_the_last_frame_is_where_the_simulation_ends(run, balls):
    sim = balls.open(threads=1).advance()
    np.testing.assert_array_equal(run.frames[-1].grains["position"], sim.frame().grains["position"])


def test_xarray(run):
    pytest.importorskip("xarray")
    data = run.to_xarray()
    assert data.sizes == {"time": 6, "id": 60, "axis": 3}
    assert data.velocity.attrs["units"] == "m/s"
    np.testing.assert_array_equal(data.position.sel(time=data.time[-1]).values, run.frames[-1].grains["position"])


def test_pyvista(run):
    pytest.importorskip("pyvista")
    cloud = run.to_pyvista()
    assert cloud.n_points == 60 and "radius" in cloud.point_data


def test_plots(run):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    axes = run.plot()
    assert axes.get_xlabel() == "time [s]" and axes.get_ylabel() == "energy [J]" and len(axes.lines) >= 3
    assert run.plot("contacts").get_ylabel() == "contacts [-]"
    with pytest.raises(tsubu.Error, match="no column `colour`"):
        run.plot("colour")


def test_a_folder_that_has_results_is_not_written_into(balls, run):
    with pytest.raises(tsubu.Error, match="is not empty"):
        balls.run(run.folder, progress=False)
    again = balls.run(run.folder, progress=False, overwrite=True)
    assert again.summary["state_hash"] == run.summary["state_hash"]
    with pytest.raises(tsubu.Error, match="cannot be had together"):
        balls.run(run.folder, overwrite=True, resume=True)


def test_what_is_no_folder_of_results_is_refused(tmp_path):
    with pytest.raises(tsubu.Error, match="has no results"):
        tsubu.load(tmp_path)
    with pytest.raises(tsubu.Error, match="is not a folder"):
        tsubu.load(tmp_path / "nothing")


def test_progress_is_told(balls, tmp_path):
    shares = []
    balls.set("duration", "0.6 s").run(tmp_path / "out", progress=shares.append)
    assert shares and shares == sorted(shares) and 0 < shares[-1] <= 1

    def stops(share):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        balls.set("duration", "100 s").run(tmp_path / "other", progress=stops)
    assert tsubu.load(tmp_path / "other").summary["status"] == "interrupted"


def test_ctrl_c_keeps_a_checkpoint(balls, tmp_path):
    balls.set("duration", "1000 s")
    threading.Timer(0.7, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt, match="the checkpoint is in"):
        balls.run(tmp_path / "out", progress=False)
    assert time.monotonic() - begun < 20
    summary = tsubu.load(tmp_path / "out").summary
    assert summary["status"] == "interrupted" and (tmp_path / "out/checkpoint").is_dir()
    sim = balls.open(threads=1, resume=tmp_path / "out")
    assert sim.state_hash == summary["state_hash"]


def test_a_run_is_resumed_with_the_same_bits(balls, tmp_path):
    whole = balls.run(tmp_path / "whole", progress=False)
    balls.set("output.checkpoint-interval", "10 ms")

    def stops(share):
        raise KeyboardInterrupt

    resumed = balls.copy().set("duration", "1 s")
    with pytest.raises(KeyboardInterrupt):
        resumed.run(tmp_path / "cut", progress=stops)
    end = resumed.run(tmp_path / "cut", progress=False, resume=True)
    assert end.summary["state_hash"] == resumed.open().advance().state_hash
    assert whole.summary["state_hash"] != end.summary["state_hash"]


def test_ctrl_c_stops_a_simulation_between_steps(balls):
    sim = balls.open(threads=1)
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        sim.advance(seconds=1000)
    steps = sim.steps
    assert balls.open(threads=1).advance(steps=steps).state_hash == sim.state_hash
    sim.add_force(lambda now: time.sleep(0.001))
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        sim.advance(seconds=1000)


def test_a_sweep_is_a_table(balls, tmp_path):
    balls.set("sweep.vary", {"particles.balls.count": [5, 10]})
    table = tsubu.sweep(balls, tmp_path / "sweep", progress=False)
    assert len(table) == 2 and "units" in table.attrs
    assert len(tsubu.load(tmp_path / "sweep").runs) == 2
    again = tsubu.sweep(balls, tmp_path / "sweep", progress=False)
    pandas.testing.assert_frame_equal(table, again)
    del balls
    with pytest.raises(tsubu.Error, match=r"has no `\[sweep\]`"):
        tsubu.sweep(tsubu.template("drop"), tmp_path / "none", progress=False)



def test_a_client_of_dask_does_the_runs(tmp_path, balls):
    """Bit for bit what this process does alone; with the client's workers in processes of their own."""
    distributed = pytest.importorskip("distributed")
    balls.set("sweep.vary", {"seed": [1, 2, 3]})
    alone = tsubu.sweep(balls, tmp_path / "alone", progress=False)
    cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    with cluster, distributed.Client(cluster) as client:
        table = tsubu.sweep(balls, tmp_path / "dask", progress=False, client=client)
        hashes = {path.parent.name: path.stat().st_mtime_ns for path in (tmp_path / "dask").rglob("summary.json")}
        tsubu.sweep(balls, tmp_path / "dask", progress=False, client=client)
    again = {path.parent.name: path.stat().st_mtime_ns for path in (tmp_path / "dask").rglob("summary.json")}
    assert hashes == again and len(again) == 3
    cost = ["wall seconds"]
    assert table.drop(columns=cost).equals(alone.drop(columns=cost))


def test_a_response_is_a_table(tmp_path):
    scene = tsubu.template("damper").set("method", "lattice")
    scene.set("response.vary", {"particles.balls.count": [0, 10]})
    scene.set("response.frequency-ratio", [0.95, 1.0])
    scene.set("response.discard-periods", 2).set("response.measure-periods", 2)
    table = tsubu.response(scene, tmp_path / "response", progress=False)
    assert {"frequency", "rms displacement"} <= set(table.columns) and len(table) == 4
    run = tsubu.load(tmp_path / "response")
    assert len(run.tables["cases"]) == 2
    assert run.plot().get_xlabel() == "frequency [Hz]"


def test_a_comparison_is_a_table(tmp_path):
    scene = tsubu.template("damper").set("duration", "0.05 s")
    table = tsubu.compare(scene, ["dem", "lattice"], tmp_path / "compare", progress=False)
    assert len(table) >= 1 and len(tsubu.load(tmp_path / "compare").runs) == 2
    with pytest.raises(tsubu.Error, match="hint"):
        tsubu.compare(scene, "magic", tmp_path / "other")


def test_verification_is_a_table():
    table = tsubu.verify(_quickest(), progress=False)
    assert table["pass"].all() and {"case", "name", "value", "low", "high", "source"} <= set(table.columns)
    with pytest.raises(tsubu.Error):
        tsubu.verify("no-such-case")


def _quickest():
    """The first case of the list."""
    line = subprocess.run([sys.executable, "-m", "tsubu", "verify", "--list"], capture_output=True, text=True, check=True)
    return line.stdout.splitlines()[1].split()[0]


def test_a_page_is_made(run):
    page = tsubu.report(run.folder)
    assert page.name == "report.html" and page.is_file()


def test_json_and_module_agree(run):
    with open(run.folder / "summary.json") as file:
        assert json.load(file) == run.summary
