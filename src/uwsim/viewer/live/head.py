"""The first message of a live view: the scene, and the columns of the rows of motion."""

from __future__ import annotations

from dataclasses import asdict

from ...results.motion import RATE
from ...results.motion.motion_track import POSITION_STEP, QUATERNION_STEP
from ...simulation import Simulation
from ...simulation.tracked_state import TrackedState
from ..head import scene_head
from ..pack import Blob, make_pack


def head_of(simulation: Simulation, title: str, state: TrackedState) -> bytes:
    """Return the pack with the head of a live view (`uwsim.viewer.head`).

    Args:
        simulation: the simulation, at step 0.
        title: the title of the page.
        state: the poses and signals of which the rows consist.
    """
    blob = Blob()
    head = scene_head(simulation, title, blob, is_live=True)
    head["motion"] = {
        "uwsim_motion": 1,
        "rate": RATE,
        "n": 0,
        "start": 0.0,
        "bodies": list(state.bodies),
        "length": POSITION_STEP,
        "quaternion": QUATERNION_STEP,
        "signals": [asdict(signal) for signal in state.signals],
    }
    return make_pack(head, blob)
