"""Starts of a kept model, and checkpoints: CPU time for every bundled scene.

Run ``python benchmarks/checkpoints.py``. ``make`` is `Simulation(model)` of a `SceneModel` that has
been started before, without images; ``first samples`` is what `start` adds: what sensors measure at
step 0. ``copy`` is `State.copy`, ``save`` and ``restore`` are those of `Simulation`, after 0.2 s.
Each figure is the least of many, as other programs only add to it. One JSON on stdout.
"""

from __future__ import annotations

import gc
import time
from collections.abc import Callable

from measure import kept, main

import uwsim
from uwsim.assets.bundled import bundled_files
from uwsim.model.scene_model import SceneModel
from uwsim.simulation import Simulation

START_MS, COPY_MS, SAVE_MS = 10.0, 0.05, 0.2
"""Targets: of a start, of `State.copy` with one vehicle, of `save` of `SAVED`."""
COPIED, SAVED = ("visibility-moving-scene", "currents-scene"), "cirs"
"""Scenes with a target of their own."""
STARTS, CALLS, BATCH = 25, 40, 25
"""Starts; batches of calls, and the calls of each."""
SECONDS = 0.2
"""Simulated before the state is copied [s]."""


def starts(model: SceneModel) -> dict[str, object]:
    """Start the model again and again: CPU time of its parts, and of all of a start [ms]."""
    made, started, whole = [], [], []
    for _ in range(STARTS):
        gc.collect()  # the last simulation, which is no part of the start of the next
        began = time.process_time()
        simulation = Simulation(model, is_blind=True)
        bound = time.process_time()
        simulation.advance(0.0)
        ended = time.process_time()
        simulation.close()
        made.append(bound - began)
        started.append(ended - bound)
        whole.append(ended - began)
    return {
        "make_ms": round(1e3 * min(made), 3),
        "first_samples_ms": round(1e3 * min(started), 3),
        "start_ms": kept(1e3 * min(whole), START_MS),
    }


def least(call: Callable[[], object]) -> float:
    """Least CPU time of a call over some batches [ms]."""
    found = []
    for _ in range(CALLS):
        began = time.process_time()
        for _ in range(BATCH):
            call()
        found.append((time.process_time() - began) / BATCH)
    return 1e3 * min(found)


def checkpoints(simulation: Simulation, scene: str) -> dict[str, object]:
    """Copy, save and restore the state of a simulation: CPU time of each [ms], bytes."""
    saved = simulation.save()
    copy, save = least(simulation.state.copy), least(simulation.save)
    return {
        "copy_ms": kept(copy, COPY_MS) if scene in COPIED else round(copy, 4),
        "save_ms": kept(save, SAVE_MS) if scene == SAVED else round(save, 4),
        "restore_ms": round(least(lambda: simulation.restore(saved)), 4),
        "bytes": len(saved),
    }


def measure() -> dict[str, object]:
    """Measure every bundled scene."""
    found: dict[str, object] = {}
    for scene in bundled_files("scenes"):
        with uwsim.load(scene, is_blind=True) as simulation:
            simulation.advance(SECONDS)
            found[scene] = {
                **starts(simulation.world.model),
                **checkpoints(simulation, scene),
            }
    return found


if __name__ == "__main__":
    main(measure)
