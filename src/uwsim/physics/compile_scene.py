"""Compiles a scene: from its spec to the model that its simulations share."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from ..errors import BadSetting
from ..model.collision.scene_shapes import simulated_shapes
from ..model.dynamics import read_dynamics
from ..model.placement import set_on_floor
from ..model.robots import read_robots
from ..model.scene_model import SceneModel
from ..scene.sim_params import Integrator
from ..scene.spec import SceneSpec, with_integrator
from ..scene.variation import varied
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
    drawn = varied(source, seed)
    robots = read_robots(drawn, folders)
    placed = set_on_floor(drawn, robots, folders)
    dynamics = read_dynamics(placed, robots, folders)
    shapes = simulated_shapes(placed, robots, dynamics, folders)
    return SceneModel(
        source=source,
        varied=drawn,
        scene=placed,
        seed=seed,
        timestep=timestep,
        data_path=folders,
        compatibility=compatibility,
        robots=robots,
        dynamics=dynamics,
        shapes=shapes,
        engine_model=compile_engine_model(placed, robots, dynamics, timestep, shapes),
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
