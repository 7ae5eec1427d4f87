"""Two hundred cases on a real Slurm and a real Dask, whose workers are killed at random.

`TSUBU` names the program. Every result is held against that of the same sweep on this machine alone, and no case that is complete is run again.
"""

import contextlib
import csv
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import pytest

import slurm

TSUBU = os.environ["TSUBU"]
CASES = 200

SCENE = """\
title = "Balls in a box that shakes"
gravity = "10 m/s^2"
duration = "{duration}"
[materials.acrylic]
young-modulus = "0.5 GPa"
restitution = 0.75
friction = 0.5
[particles.balls]
material = "acrylic"
count = 20
diameter = "6 mm"
mass = "0.2 g"
start.rows = {{ spacing = 1.1, jitter = 0.5, speed = 0.3 }}
[walls.box]
material = "acrylic"
host = "spring"
shape.box = {{ width = "60 mm", height = "96 mm", depth = "6 mm" }}
[hosts.spring]
structure.oscillator = {{ mass = "86 g", stiffness = "123.4 N/m", damping = "0.08 N s/m" }}
base.sine = {{ amplitude = "5 mm", frequency = "6 Hz" }}
[sweep]
vary = {{ "materials.acrylic.restitution" = [0.5, 0.8], "seed" = {seeds} }}
[response]
frequency-ratio = [0.9, 0.95, 1.0, 1.05]
discard-periods = 2
discard-periods-empty = 2
measure-periods = 4
peak-within = 0.01
seeds = 2
vary = {{ "particles.balls.count" = [0, 20] }}
"""


def tsubu(*words, code=0, **more):
    done = subprocess.run([TSUBU, *map(str, words)], capture_output=True, text=True, **more)
    assert done.returncode == code, f"{words}: {done.returncode}\n{done.stdout}\n{done.stderr}"
    return done


def scene(folder, duration="0.3 s", seeds=CASES // 2):
    path = folder / "balls.toml"
    path.write_text(SCENE.format(duration=duration, seeds=list(range(1, seeds + 1))))
    return path


def rows(folder):
    """`sweep.csv` without what a case cost."""
    with open(folder / "sweep.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        row.pop("wall seconds [s]")
    return rows


def hashes(folder):
    return {path.parent.name: json.loads(path.read_text())["state_hash"] for path in folder.glob("cases/*/summary.json")}


@pytest.fixture(scope="session")
def local(tmp_path_factory):
    """The same sweep and the same response by this machine alone."""
    folder = tmp_path_factory.mktemp("local")
    path = scene(folder)
    tsubu("sweep", path, "-q", "-o", folder / "sweep")
    tsubu("response", path, "-q", "-o", folder / "response")
    return folder


@pytest.fixture
def cluster():
    if slurm.missing():
        pytest.skip(f"no Slurm: {', '.join(slurm.missing())} (Debian: slurmctld, slurmd, slurm-client, munge)")
    home = tempfile.mkdtemp(prefix="slurm")
    running = slurm.Slurm(home)
    yield running
    running.close()
    shutil.rmtree(home)


class Witness:
    """Sees cases come to their ends, and that none of them is touched again."""

    def __init__(self, folder):
        self.folder, self.seen, self.again, self.stop = folder, {}, [], False
        self.thread = threading.Thread(target=self.look_on)
        self.thread.start()

    def look_on(self):
        while not self.stop:
            self.look()
            time.sleep(0.05)

    def look(self):
        for path in self.folder.glob("cases/*/summary.json"):
            try:
                about, text = path.stat(), path.read_text()
            except FileNotFoundError:
                continue
            mark = (about.st_mtime_ns, about.st_ino)
            if path in self.seen:
                if self.seen[path] != mark:
                    self.again.append(path.parent.name)
            elif '"finished"' in text:
                self.seen[path] = mark

    def close(self):
        self.stop = True
        self.thread.join()
        self.look()
        assert not self.again, f"run again though complete: {self.again}"


@pytest.fixture
def witness(tmp_path):
    seeing = Witness(tmp_path / "out")
    yield seeing
    seeing.close()


def tasks(folder):
    """Processes that do cases of a folder."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            words = (process / "cmdline").read_bytes().decode().split("\0")
        except (FileNotFoundError, ProcessLookupError):
            continue
        if words[0].endswith("tsubu") and str(folder) in words and "--case" in words:
            found.append(int(process.name))
    return found


def test_slurm_does_what_is_missing_and_nothing_else(local, cluster, witness, tmp_path):
    path, out = scene(tmp_path), tmp_path / "out"
    command = ["sweep", path, "-o", out, "--launcher", "slurm", "--per-task", 4]
    tsubu(*command, env=cluster.environment)
    refused = tsubu(*command, code=2, env=cluster.environment)
    assert "has not ended" in refused.stderr
    chance, killed = random.Random(), 0
    while killed < 3:
        time.sleep(chance.uniform(1, 4))
        if running := tasks(out):
            os.kill(chance.choice(running), signal.SIGKILL)
            killed += 1
    slurm.wait(cluster.over, "the end of the array")
    missing = [row for row in rows(out) if row["status [text]"] != "finished"]
    assert 3 <= len(missing) <= 12, missing
    assert all("launch/" in row["remark [text]"] or "not begun" in row["remark [text]"] for row in missing), missing
    assert f"{len(missing)} cases missing" in (out / "report.html").read_text()
    tsubu(*command, env=cluster.environment)
    asked = (out / "launch/runs").read_text().split()
    assert sorted(asked) == sorted(row["folder [text]"].removeprefix("cases/") for row in missing)
    slurm.wait(cluster.over, "the end of the second array")
    assert rows(out) == rows(local / "sweep")
    assert hashes(out) == hashes(local / "sweep") and len(hashes(out)) == CASES
    numbers = (out / "launch/slurm").read_text()
    tsubu(*command, env=cluster.environment)
    assert numbers == (out / "launch/slurm").read_text(), "something was submitted though nothing is missing"


def test_a_requeued_task_goes_on_from_its_checkpoint(cluster, tmp_path):
    path, out = scene(tmp_path, duration="5 s", seeds=1), tmp_path / "out"
    case = "restitution=0.5,seed=1"
    changes = ["--set", "output.checkpoint-interval=0.2 s", "--set", "output.history-interval=0.01 s"]
    changes += ["--set", "sweep.vary.\"materials.acrylic.restitution\"=[0.5]"]
    tsubu("sweep", path, *changes, "-q", "-o", tmp_path / "local")
    tsubu("sweep", path, *changes, "-o", out, "--launcher", "slurm", env=cluster.environment)
    saved = out / "cases" / case / "checkpoint/state.tsubu"
    slurm.wait(saved.exists, "a checkpoint")
    begun = (out / "cases" / case / "history.csv").stat().st_ino
    number = (out / "launch/slurm").read_text().split()[0]
    cluster.told("scontrol", "requeue", f"{number}_0")
    slurm.wait(cluster.over, "the end of the array")
    said = (out / "launch" / f"{number}_0.txt").read_text()
    assert said.count(f"case {case}: begun") == 2 and said.count(f"case {case}: finished") == 1, said
    assert (out / "cases" / case / "history.csv").stat().st_ino == begun, "it began anew"
    assert hashes(out) == hashes(tmp_path / "local")


@contextlib.contextmanager
def small_disk(folder):
    """A disk with room for the scene, and for little else."""
    folder.mkdir(parents=True)
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=32k", "tsubu", folder], capture_output=True, text=True)
    if mounted.returncode != 0:
        pytest.skip(f"no disk can be made here: {mounted.stderr.strip()}")
    try:
        yield
    finally:
        subprocess.run(["umount", folder], check=True)


def test_a_full_disk_leaves_the_others_to_be_done(cluster, witness, tmp_path):
    path, out = scene(tmp_path, seeds=3), tmp_path / "out"
    changes = ["--set", "output.history-interval=0.1 ms"]
    tsubu("sweep", path, *changes, "-q", "-o", tmp_path / "local")
    command = ["sweep", path, *changes, "-o", out, "--launcher", "slurm", "--per-task", 1]
    case = "restitution=0.5,seed=2"
    tsubu("sweep", path, *changes, "-o", out, "--gather", code=3)
    with small_disk(out / "cases" / case):
        tsubu(*command, env=cluster.environment)
        slurm.wait(cluster.over, "the end of the array")
        others = [row for row in rows(out) if row["folder [text]"] != f"cases/{case}"]
        assert len(others) == 5 and all(row["status [text]"] == "finished" for row in others), others
        (full,) = [row for row in rows(out) if row not in others]
        assert full["status [text]"] != "finished" and "no space left" in full["remark [text]"].lower(), full
        assert "no space left" in (out / "report.html").read_text().lower()
    tsubu(*command, env=cluster.environment)
    assert (out / "launch/runs").read_text().split() == [case]
    slurm.wait(cluster.over, "the end of the second array")
    assert rows(out) == rows(tmp_path / "local") and hashes(out) == hashes(tmp_path / "local")


def test_each_case_runs_on_the_ranks_of_its_allocation(cluster, tmp_path):
    path, out = scene(tmp_path, seeds=1), tmp_path / "out"
    command = ["sweep", path, "-o", out, "--launcher", "slurm", "--ranks", 2, "--per-task", 1]
    if "built without" in subprocess.run([TSUBU, *map(str, command), "--dry-run"], capture_output=True, text=True).stderr:
        pytest.skip("the program knows no MPI (Debian: libopenmpi-dev, openmpi-bin, libclang-dev)")
    tsubu("sweep", path, "-q", "-o", tmp_path / "local")
    allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    tsubu(*command, env={**cluster.environment, **allowed, "SBATCH_PARTITION": "pair"})
    slurm.wait(cluster.over, "the end of the array")
    said = "\n".join(file.read_text() for file in (out / "launch").glob("*.txt"))
    assert hashes(out) == hashes(tmp_path / "local") and len(hashes(out)) == 2, said
    for summary in out.glob("cases/*/summary.json"):
        assert json.loads(summary.read_text())["ranks"]["count"] == 2


def test_slurm_does_a_response_round_by_round(local, cluster, tmp_path):
    path, out = scene(tmp_path), tmp_path / "out"
    tsubu("response", path, "-o", out, "--launcher", "slurm", "--per-task", 3, env=cluster.environment)
    slurm.wait(cluster.over, "the end of the rounds")
    assert len(list((out / "launch").glob("*_last.txt"))) > 1, "there was one round"
    assert (out / "response.csv").read_text() == (local / "response/response.csv").read_text()
    assert (out / "report.html").exists()


DESIGN = """
[design]
runs = 30
mass-limit = "6 g"
vary = { "particles.balls.count" = [10, 20, 30, 40] }
"""


def test_slurm_does_a_design_round_by_round(cluster, tmp_path):
    path, out = scene(tmp_path), tmp_path / "out"
    text = path.read_text().replace("discard-periods = 2\n", "").replace("discard-periods-empty = 2\n", "")
    text = text.replace("5 mm", "0.5 mm").replace("[0.9, 0.95, 1.0, 1.05]", "{ from = 0.9, to = 1.05 }")
    path.write_text(text + DESIGN)
    tsubu("design", path, "--set", "method=lattice", "-q", "-o", tmp_path / "local")
    tsubu("design", path, "--set", "method=lattice", "-o", out, "--launcher", "slurm", env=cluster.environment)
    slurm.wait(cluster.over, "the end of the rounds")
    assert len(list((out / "launch").glob("*_last.txt"))) > 2, "it did not choose"
    for file in ["design.csv", "curves.csv", "best.toml"]:
        assert (out / file).read_text() == (tmp_path / "local" / file).read_text()


def test_slurm_does_a_verification(cluster, tmp_path):
    cases, out = ["drop-lattice", "gutt-haff", "damped-contact"], tmp_path / "out"
    tsubu("verify", *cases, "-q", "-o", tmp_path / "local")
    command = ["verify", *cases, "-o", out, "--launcher", "slurm"]
    tsubu(*command, env=cluster.environment)
    slurm.wait(cluster.over, "the end of the array")
    claims = [json.loads((folder / "verify.json").read_text())["claims"] for folder in (out, tmp_path / "local")]
    assert claims[0] == claims[1] and (out / "report.html").exists()
    numbers = (out / "launch/slurm").read_text()
    tsubu(*command, env=cluster.environment)
    assert numbers == (out / "launch/slurm").read_text(), "something was submitted though nothing is missing"


class Dask:
    """A scheduler and three workers, one thread each; without a nanny, which would start them again."""

    def __init__(self, folder):
        self.folder, self.workers = folder, []
        self.address = f"tcp://127.0.0.1:{slurm.free(1)[0]}"
        host, port = self.address.removeprefix("tcp://").split(":")
        self.scheduler = self.start("scheduler", "--host", host, "--port", port, "--no-dashboard")
        for _ in range(3):
            self.add()

    def add(self):
        self.workers.append(
            self.start("worker", self.address, "--no-nanny", "--nthreads", "1", "--no-dashboard", "--memory-limit", "0")
        )

    def start(self, *words):
        quiet = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        return subprocess.Popen([sys.executable, "-m", "dask", *words], cwd=self.folder, **quiet)

    def close(self):
        for process in [*self.workers, self.scheduler]:
            process.terminate()
            process.wait(timeout=60)


@pytest.fixture
def dask(tmp_path):
    running = Dask(tmp_path)
    yield running
    running.close()


def test_dask_loses_workers_and_no_case(local, dask, witness, tmp_path):
    path, out = scene(tmp_path), tmp_path / "out"
    # The Python of these tests is the one that has Dask.
    environment = {**os.environ, "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"}
    words = ["sweep", path, "-o", out, "--launcher", "dask", "--scheduler", dask.address, "--per-task", 4]
    command = subprocess.Popen([TSUBU, *map(str, words)], env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    chance = random.Random()
    for _ in range(3):
        slurm.wait(lambda: tasks(out), "a task")
        time.sleep(chance.uniform(1, 4))
        lost = dask.workers.pop(chance.randrange(len(dask.workers)))
        lost.kill()
        lost.wait()
        dask.add()
    said = command.communicate(timeout=600)
    assert command.returncode == 0, said
    assert rows(out) == rows(local / "sweep")
    assert hashes(out) == hashes(local / "sweep") and len(hashes(out)) == CASES


def test_dask_does_a_response_round_by_round(local, dask, tmp_path):
    path, out = scene(tmp_path), tmp_path / "out"
    environment = {**os.environ, "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"}
    environment["DASK_SCHEDULER_ADDRESS"] = dask.address
    tsubu("response", path, "-o", out, "--launcher", "dask", "--per-task", 3, env=environment)
    assert (out / "response.csv").read_text() == (local / "response/response.csv").read_text()
