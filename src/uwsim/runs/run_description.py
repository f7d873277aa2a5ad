"""The entry ``run`` of a result, which describes its plan."""

from __future__ import annotations

from functools import cache
from importlib.metadata import version

import numpy as np

from ..results.run_info import RunInfo
from ..version import __version__
from .own_process.program import clients_of
from .planning.plan import Plan


def describe_plan(plan: Plan, renderer: str) -> RunInfo:
    """Return the description of a plan, as far as it is known before the run."""
    return RunInfo(
        seed=plan.seed,
        repeats=plan.repeats,
        mode=plan.mode,
        algorithm=plan.algorithm.name,
        clients=clients_of(plan),
        parameters=dict(sorted(plan.algorithm.parameters.items())),
        settings=plan.settings,
        levels=plan.level_choices,
        track=None if plan.track is None else (plan.track.name, plan.track.sources),
        compatibility=tuple(sorted(plan.compatibility)),
        timestep=(plan.timestep, "s"),
        version=__version__,
        physics=physics_engine(),
        renderer=renderer,
        numpy=np.__version__,
    )


@cache
def physics_engine() -> str:
    """Return the name and version of the physics engine, which takes milliseconds to find."""
    return f"mujoco {version('mujoco')}"
