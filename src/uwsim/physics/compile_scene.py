"""The compilation of a scene from its spec to the model that all its simulations share."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from ..errors import BadSetting
from ..model.collision.scene_shapes import engine_shapes
from ..model.dynamics import read_dynamics
from ..model.placement import set_on_floor
from ..model.resolved_scene import ResolvedScene, SimulatedScene
from ..model.robots import read_robots
from ..model.scene_model import SceneModel
from ..scene.sim_params import Integrator
from ..scene.spec import SceneSpec, with_integrator
from ..scene.variation import apply_variations
from ..world import TIMESTEP
from .engine_model import compile_engine_model

MAX_SHOWN_LETTERS = 60
"""The largest number of letters of an invalid argument in an error message."""


def compile_scene(
    scene: SceneSpec,
    *,
    seed: int = 0,
    timestep: float = TIMESTEP,
    data_path: Iterable[Path] = (),
    compatibility: frozenset[str] = frozenset(),
    integrator: Integrator | None = None,
) -> SceneModel:
    """Compile a scene.

    Args:
        scene: the spec of the scene.
        seed: the seed of the scene's variations, which are drawn here.
        timestep: the length of a step [s].
        data_path: the folders in which files are searched.
        compatibility: the names of the compatibility quirks that are on.
        integrator: ``implicitfast`` or ``RK4``; by default the integrator of the scene file.

    Raises:
        AssetNotFound: a file is missing; with every folder searched.
        SceneError: a file is invalid, or a name is unknown; with every error.
        BadHydrodynamics: the hydrodynamics are invalid; with every error.
        BadSetting: the scene is not a spec; the timestep is not positive, or too long for stable
            dynamics.
    """
    if not isinstance(scene, SceneSpec):
        raise BadSetting(
            f"A scene to compile is a {type(scene).__name__}, {repr(scene)[:MAX_SHOWN_LETTERS]}; "
            "expected a SceneSpec, which read_scene returns."
        )
    folders = tuple(map(Path, data_path))
    source = with_integrator(scene, integrator)
    variant = apply_variations(source, seed)
    draft = ResolvedScene(scene=variant, robots=read_robots(variant, folders), data_path=folders)
    resolved_scene = replace(draft, scene=set_on_floor(draft))
    dynamics = read_dynamics(resolved_scene)
    simulated_scene = SimulatedScene(
        **vars(resolved_scene),
        dynamics=dynamics,
        shapes=engine_shapes(resolved_scene, dynamics),
        timestep=timestep,
    )
    return SceneModel(
        **vars(simulated_scene),
        source=source,
        varied_scene=variant,
        seed=seed,
        compatibility=compatibility,
        engine_model=compile_engine_model(simulated_scene),
    )


def recompile(model: SceneModel, seed: int) -> SceneModel:
    """Compile the scene of a model for another seed; return the model itself for the same seed."""
    if seed == model.seed:
        return model
    return compile_scene(
        model.source,
        seed=seed,
        timestep=model.timestep,
        data_path=model.data_path,
        compatibility=model.compatibility,
    )
