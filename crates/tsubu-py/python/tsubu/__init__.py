"""Granular dynamics: one scene, several methods, books that close.

A scene is read from a file or a dictionary, changed, judged and run::

    import tsubu

    scene = tsubu.Scene.read("damper.toml").set("particles.balls.count", 30)
    print(scene.check())
    run = scene.run("out/damper")
    run.history.plot(x="time", y="kinetic energy")

or opened and moved step by step, with arrays of the grains at hand::

    sim = scene.open()
    sim.advance(seconds=0.1)
    fastest = abs(sim.grains["velocity"]).max()

Everything is in SI units. What goes wrong is an :class:`Error` with the text, the place and the hint of the program.
"""

from tsubu._tsubu import Error, __version__
from tsubu._run import Frame, Frames, Run, load
from tsubu._scene import Line, Scene, Verdict, template, templates
from tsubu._simulation import Grains, Host, Hosts, Simulation, Wall, Walls
from tsubu._studies import compare, report, response, sweep, verify

__all__ = [
    "Error",
    "Frame",
    "Frames",
    "Grains",
    "Host",
    "Hosts",
    "Line",
    "Run",
    "Scene",
    "Simulation",
    "Verdict",
    "Wall",
    "Walls",
    "__version__",
    "compare",
    "load",
    "report",
    "response",
    "sweep",
    "template",
    "templates",
    "verify",
]
