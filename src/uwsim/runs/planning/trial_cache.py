"""The objects that the trials of one process share: renderers, and the models of scenes."""

from __future__ import annotations

from ...base.digest import digest_of
from ...model.scene_model import SceneModel
from ...physics.compile_scene import compile_scene
from ...simulation import RendererPool
from .plan import Plan

N_MODELS = 2
"""The number of models that are kept: trials of a run and of its control run may
alternate."""


def compile_plan(plan: Plan, seed: int) -> SceneModel:
    """Compile the scene of a plan for a seed.

    Raises:
        UwsimError: the scene cannot be compiled.
    """
    return compile_scene(
        plan.scene,
        seed=seed,
        timestep=plan.timestep,
        data_path=plan.data_path,
        compatibility=plan.compatibility,
    )


class TrialCache:
    """A cache of objects that do not change from trial to trial. Use it from one thread.

    Files that change while a run executes end the run (`uwsim.runs.input_watch`), so that a model
    is never older than its files.
    """

    def __init__(self) -> None:
        self.renderers = RendererPool()
        """The pool from which each trial takes its renderer."""
        self._models: dict[object, SceneModel] = {}  # in the order of last use

    def model(self, plan: Plan, seed: int) -> SceneModel:
        """Return the model of a plan's scene for a seed; it is compiled at the first request.

        Raises:
            UwsimError: the scene cannot be compiled.
        """
        key = digest_of(plan.scene), seed, plan.timestep, plan.data_path, plan.compatibility
        model = self._models.pop(key, None)
        if model is None:
            model = compile_plan(plan, seed)
        self._models[key] = model
        for unused_key in list(self._models)[:-N_MODELS]:
            del self._models[unused_key]
        return model

    def close(self) -> None:
        """Release the graphics contexts."""
        self.renderers.close()
        self._models.clear()
