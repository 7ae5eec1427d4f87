"""What the tests share: small scenes that end in a moment."""

import copy

import pytest

import tsubu

BALLS = {
    "title": "Balls in a box",
    "seed": 5,
    "duration": "0.05 s",
    "materials": {"glass": {"density": 2500, "young-modulus": "5 MPa", "restitution": 0.6, "friction": 0.4}},
    "particles": {
        "balls": {
            "material": "glass",
            "count": 60,
            "diameter": "4 mm",
            "start": {"rows": {"region": {"low": [-0.02, 0.01], "high": [0.02, 0.08]}}},
        }
    },
    "walls": {
        "floor": {"material": "glass", "shape": {"plane": {}}},
        "left": {"material": "glass", "shape": {"plane": {"point": [-0.025, 0], "normal": "x"}}},
        "lid": {"material": "glass", "shape": {"plane": {"point": [0, 0.12], "normal": "-z"}}},
        "right": {"material": "glass", "shape": {"plane": {"point": [0.025, 0], "normal": "-x"}}},
    },
    "contact": {"normal": {"hertz": {}}, "tangential": {"mindlin": {}}},
    "output": {"history-interval": "5 ms", "frame-interval": "10 ms"},
}

STREAM = {
    **{key: BALLS[key] for key in ("seed", "materials", "walls", "contact")},
    "duration": "0.1 s",
    "particles": {
        "beads": {
            "material": "glass",
            "count": 40,
            "diameter": "4 mm",
            "start": {
                "stream": {
                    "region": {"low": [-0.02, 0.08], "high": [0.02, 0.11]},
                    "rate": "2000 1/s",
                    "velocity": [0, -0.5],
                }
            },
        }
    },
    "removal": {"below": {"behind": {"point": [0.0, 0.02], "normal": "z"}}},
}

FREE = {
    "duration": "0.2 s",
    "gravity": 0,
    "materials": {"glass": {"density": 2500, "young-modulus": "5 MPa", "restitution": 0.6}},
    "particles": {
        "ball": {
            "material": "glass",
            "count": 1,
            "diameter": "4 mm",
            "start": {"at": {"position": [[0.01, 0.0]]}},
        }
    },
    "dem": {"time-step": "20 us"},
}


@pytest.fixture
def balls():
    """60 balls fall in a box."""
    return tsubu.Scene.from_dict(copy.deepcopy(BALLS))


@pytest.fixture
def stream():
    """Beads come in as a stream, and vanish."""
    return tsubu.Scene.from_dict(copy.deepcopy(STREAM))


@pytest.fixture
def free():
    """One ball that nothing acts on."""
    return tsubu.Scene.from_dict(copy.deepcopy(FREE))
