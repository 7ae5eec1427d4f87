"""What the door to Python costs: steps in pieces against steps at once and a run, and functions that are asked in every step.

`python bench.py` with the package installed from a release wheel. Ways go in turn, on one thread, and each time is the least of all rounds: processor
time, which other programs on the machine disturb little, and time on the wall.
"""

import argparse
import platform
import tempfile
import time

import numpy as np

import tsubu

GRAINS = 10_000
PIECE = 100


def scene(grains):
    """A bed of balls in a box, in space, that has come to rest."""
    half = 12.5 * 4.2e-3
    return tsubu.Scene.from_dict(
        {
            "dimension": 3,
            "duration": "1 s",
            "seed": 3,
            "materials": {
                "glass": {"density": 2500, "young-modulus": "10 MPa", "poisson-ratio": 0.25, "restitution": 0.5, "friction": 0.4}
            },
            "particles": {
                "balls": {
                    "material": "glass",
                    "count": grains,
                    "diameter": "4 mm",
                    "start": {"rows": {"region": {"low": [-half, -half, 0.0], "high": [half, half, 0.2]}}},
                }
            },
            "walls": {
                "box": {
                    "material": "glass",
                    "shape": {"box": {"width": 2 * half, "depth": 2 * half, "height": 0.3}},
                }
            },
            "contact": {"normal": {"hertz": {}}, "tangential": {"mindlin": {}}},
            "output": {"history-interval": "0.5 s"},
        }
    )


def measured(work):
    wall, processor = time.perf_counter(), time.process_time()
    work()
    return np.array([time.process_time() - processor, time.perf_counter() - wall])


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--steps", type=int, default=400)
    options.add_argument("--rounds", type=int, default=7)
    options.add_argument("--settle", type=float, default=0.25)
    chosen = options.parse_args()
    steps = chosen.steps
    bed = scene(GRAINS)
    with tempfile.TemporaryDirectory() as folder:
        sim = bed.open(threads=1)
        sim.advance(seconds=chosen.settle)
        sim.checkpoint(f"{folder}/bed")
        sim.close()

        def opened():
            return bed.open(threads=1, resume=f"{folder}/bed")

        def ready(function=None, **options):
            sim = opened()
            if function:
                sim.add_force(function, **options)
            sim.advance(steps=50)
            return sim

        def pieces(sim, size):
            for _ in range(steps // size):
                sim.advance(steps=size)

        def look(sim):
            for _ in range(steps // PIECE):
                sim.advance(steps=PIECE)
                sim.grains["position"].max()

        zeros = np.zeros((GRAINS, 3))
        go = lambda sim: sim.advance(steps=steps)
        ways = {
            "at once": (ready(), go),
            f"pieces of {PIECE}": (ready(), lambda sim: pieces(sim, PIECE)),
            f"pieces of {PIECE}, positions looked at": (ready(), look),
            "pieces of 1": (ready(), lambda sim: pieces(sim, 1)),
            "empty function every step": (ready(lambda now: None), go),
            "empty function, no columns": (ready(lambda now: None, columns=()), go),
            "zero forces every step": (ready(lambda now: zeros), go),
            "zero forces every 10th": (ready(lambda now: zeros, every=10), go),
            "a spring to the middle": (ready(lambda now: -1e-6 * now["position"]), go),
        }
        times = {name: np.full(2, np.inf) for name in ways}
        for _ in range(chosen.rounds):
            for name, (sim, work) in ways.items():
                times[name] = np.minimum(times[name], measured(lambda: work(sim)))
        # A run writes and opens as well: two lengths of it, and the difference.
        time_step = ways["at once"][0].time_step
        touching = ways["at once"][0].touching
        lengths = {50: np.full(2, np.inf), 50 + 2 * steps: np.full(2, np.inf)}
        for _ in range(chosen.rounds):
            for count in lengths:
                short = bed.copy().set("start-from", f"{folder}/bed")
                short.set("duration", count * time_step)
                work = lambda: short.run(f"{folder}/run", progress=False, overwrite=True, threads=1)
                lengths[count] = np.minimum(lengths[count], measured(work))
        run = (lengths[50 + 2 * steps] - lengths[50]) / 2
    print(f"{GRAINS} grains, {touching} touching pairs, {steps} steps, least of {chosen.rounds} rounds, one thread")
    print(f"Python {platform.python_version()}, NumPy {np.__version__}, {platform.machine()}")
    base = times["at once"]
    print(f"{'':40} {'processor':>12} {'wall':>12}   ms a step; over `at once`")
    for name, (processor, wall) in {**times, "a run, less its beginning": run}.items():
        told = f"{1e3 * processor / steps:12.4f} {1e3 * wall / steps:12.4f}"
        print(f"{name:40} {told}   {100 * (processor / base[0] - 1):+6.1f} % {100 * (wall / base[1] - 1):+6.1f} %")


if __name__ == "__main__":
    main()
