"""Open scenes for tests: `compile_scene` and `Simulation` in one call."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from uwsim.assets.bundled import bundled_files
from uwsim.base.digest import digest_of
from uwsim.model.scene_model import SceneModel
from uwsim.physics.compile_scene import compile_scene
from uwsim.scene.sim_params import Integrator
from uwsim.scene.spec import SceneSpec
from uwsim.simulation import Simulation
from uwsim.world import TIMESTEP

N_MODELS = 6
"""The number of models of bundled scenes that a test process caches."""
_MODELS: dict[object, SceneModel] = {}  # in the order of use


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
    """Compile a scene and open it; ``options`` are those of `Simulation`.

    The model of a bundled scene is cached, also for a changed spec of it.
    """
    folders = tuple(data_path)
    key = digest_of(scene), scene.path, seed, timestep, folders, compatibility, integrator
    model = _MODELS.pop(key, None) or compile_scene(
        scene,
        seed=seed,
        timestep=timestep,
        data_path=folders,
        compatibility=compatibility,
        integrator=integrator,
    )
    if Path(scene.path) in bundled_files("scenes").values():
        _MODELS[key] = model
    for key_to_drop in list(_MODELS)[:-N_MODELS]:
        del _MODELS[key_to_drop]
    return Simulation(model, **options)
