"""Scenes opened for tests: what `compile_scene` and `Simulation` take, in one call."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from uwsim.physics.compile_scene import compile_scene
from uwsim.scene.sim_params import Integrator
from uwsim.scene.spec import SceneSpec
from uwsim.simulation import Simulation
from uwsim.world import TIMESTEP


def open_scene(
    scene: SceneSpec,
    *,
    seed: int = 0,
    timestep: float = TIMESTEP,
    data_path: Iterable[Path] = (),
    compatibility: frozenset[str] = frozenset(),
    integrator: Integrator | None = None,
    **options: Any,
) -> Simulation:
    """Compile a scene and open it; ``options`` are those of `Simulation`."""
    model = compile_scene(
        scene,
        seed=seed,
        timestep=timestep,
        data_path=data_path,
        compatibility=compatibility,
        integrator=integrator,
    )
    return Simulation(model, **options)
