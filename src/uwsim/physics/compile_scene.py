"""Compiles a scene: from its spec to the model that its simulations share."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from ..errors import BadSetting
from ..model.collision.scene_shapes import simulated_shapes
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

MAX_SHOWN = 60
"""Most letters of a wrong argument in an error."""


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
        scene: spec of the scene.
        seed: of its variations, which are drawn here.
        timestep: length of a step [s].
        data_path: folders in which files are looked for.
        compatibility: names of the compatibility quirks that are on.
        integrator: ``implicitfast`` or ``RK4`` instead of the file's (`SimParamsSpec`).

    Raises:
        AssetNotFound: a file is nowhere; names every folder searched.
        SceneError: a file is wrong, or a name leads nowhere; with every error.
        BadHydrodynamics: the hydrodynamics are wrong; with every error.
        BadSetting: it is no scene; the step is no time, or longer than the physics bears.
    """
    if not isinstance(scene, SceneSpec):
        raise BadSetting(
            f"A scene is compiled from what read_scene returns, not of a {type(scene).__name__}: "
            f"{repr(scene)[:MAX_SHOWN]}."
        )
    folders = tuple(map(Path, data_path))
    source = with_integrator(scene, integrator)
    drawn = apply_variations(source, seed)
    read = ResolvedScene(scene=drawn, robots=read_robots(drawn, folders), data_path=folders)
    placed = replace(read, scene=set_on_floor(read))
    dynamics = read_dynamics(placed)
    simulated = SimulatedScene(
        **vars(placed),
        dynamics=dynamics,
        shapes=simulated_shapes(placed, dynamics),
        timestep=timestep,
    )
    return SceneModel(
        **vars(simulated),
        source=source,
        varied_scene=drawn,
        seed=seed,
        compatibility=compatibility,
        engine_model=compile_engine_model(simulated),
    )


def recompile(model: SceneModel, seed: int) -> SceneModel:
    """Compile the scene of a model for another seed; returns the model itself for the same."""
    if seed == model.seed:
        return model
    return compile_scene(
        model.source,
        seed=seed,
        timestep=model.timestep,
        data_path=model.data_path,
        compatibility=model.compatibility,
    )
