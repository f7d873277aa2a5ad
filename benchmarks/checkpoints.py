"""Measure starts of a cached model, and checkpoints, for every bundled scene.

Run ``python benchmarks/checkpoints.py``. ``make`` is `Simulation(model)` of a `SceneModel` with an
earlier start, without images; ``first samples`` are the samples of sensors at step 0.
``copy`` is `State.copy`, ``save`` and ``restore`` are those of `Simulation`, after 0.2 s. Each
figure is the minimum of many, as other programs only add to it. The output is one JSON.
"""

from __future__ import annotations

import gc
import time
from collections.abc import Callable

from measure import main, upper_target_figure

import uwsim
from uwsim.assets.bundled import bundled_files
from uwsim.model.scene_model import SceneModel
from uwsim.simulation import Simulation

START_MS, COPY_MS, SAVE_MS = 10.0, 0.05, 0.2
"""The targets of a start, of `State.copy` with one vehicle, and of `save`."""
COPY_TARGET_SCENES, SAVE_TARGET_SCENE = ("visibility-moving-scene", "currents-scene"), "cirs"
"""The scenes with a target of `State.copy`, and of `save`."""
STARTS, CALLS, BATCH = 25, 40, 25
"""The numbers of starts, of batches of calls, and of calls in a batch."""
SIMULATED_TIME = 0.2
"""The simulation time before the first copy [s]."""


def measure_starts(model: SceneModel) -> dict[str, object]:
    """Measure the CPU time of repeated starts, in parts and as a whole [ms]."""
    make_times, sample_times, start_times = [], [], []
    for _ in range(STARTS):
        gc.collect()  # frees the last simulation before the next start
        start_time = time.process_time()
        simulation = Simulation(model, is_blind=True)
        bind_time = time.process_time()
        simulation.advance(0.0)
        end_time = time.process_time()
        simulation.close()
        make_times.append(bind_time - start_time)
        sample_times.append(end_time - bind_time)
        start_times.append(end_time - start_time)
    return {
        "make_ms": round(1e3 * min(make_times), 3),
        "first_samples_ms": round(1e3 * min(sample_times), 3),
        "start_ms": upper_target_figure(1e3 * min(start_times), START_MS),
    }


def least_cpu_time(call: Callable[[], object]) -> float:
    """Return the minimum CPU time of a call over batches [ms]."""
    cpu_times = []
    for _ in range(CALLS):
        start_time = time.process_time()
        for _ in range(BATCH):
            call()
        cpu_times.append((time.process_time() - start_time) / BATCH)
    return 1e3 * min(cpu_times)


def measure_checkpoints(simulation: Simulation, scene: str) -> dict[str, object]:
    """Measure CPU time of copy, save and restore of a state [ms], and its bytes."""
    state_bytes = simulation.save()
    copy, save = least_cpu_time(simulation.state.copy), least_cpu_time(simulation.save)
    return {
        "copy_ms": upper_target_figure(copy, COPY_MS)
        if scene in COPY_TARGET_SCENES
        else round(copy, 4),
        "save_ms": upper_target_figure(save, SAVE_MS)
        if scene == SAVE_TARGET_SCENE
        else round(save, 4),
        "restore_ms": round(least_cpu_time(lambda: simulation.restore(state_bytes)), 4),
        "bytes": len(state_bytes),
    }


def measure() -> dict[str, object]:
    """Measure every bundled scene."""
    figures: dict[str, object] = {}
    for scene in bundled_files("scenes"):
        with uwsim.load(scene, is_blind=True) as simulation:
            simulation.advance(SIMULATED_TIME)
            figures[scene] = {
                **measure_starts(simulation.world.model),
                **measure_checkpoints(simulation, scene),
            }
    return figures


if __name__ == "__main__":
    main(measure)
