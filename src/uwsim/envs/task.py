"""The task of an environment: the plan of a benchmark with its ``<u:environment>``."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ..benchmark.environment import ActionSpec, EnvironmentSpec, TopicFieldSpec
from ..benchmark.updaters import Level
from ..bus import Node
from ..editing import Benchmark, Scene
from ..editing.run_files import write_run_files
from ..errors import BadSetting, UnknownName
from ..messages import Empty
from ..runs.planning.make_plan import make_plan
from ..runs.planning.plan import Plan, Trial
from ..runs.planning.plan_request import PlanRequest


@dataclass(frozen=True, kw_only=True)
class EnvironmentOptions:
    """The parts of an environment that replace those of the benchmark file; None: no change."""

    observation: Sequence[str] | None = None
    """The quantities of the state, as ``positionError``, and fields of topics, as
    ``/bluerov2/dvl:velocity``."""
    action: Sequence[str] | None = None
    """The topics of the commands, as ``/bluerov2/thrusters``, with axes and limits as
    ``/cmd_vel:vx=0.5,wz=1``."""
    reward: str | None = None
    """The expression of the reward."""
    success: str | None = None
    """The expression of the success."""
    vehicle: str | None = None
    """The vehicle."""
    reference: str | None = None
    """The measure with the desired position."""
    period: float | None = None
    """The time between two actions [s]."""


class OuterPolicy:
    """The algorithm of an environment: it does nothing, as the program outside acts."""

    def start(self, node: Node) -> None:
        """Start a benchmark that waits for the service ``startBench``."""
        with suppress(UnknownName):
            node.call("startBench", Empty())


def make_task(
    benchmark: str | Path | Benchmark,
    options: EnvironmentOptions,
    *,
    settings: Mapping[str, float | str],
    data_path: Sequence[str | Path],
    scene: str | Path | Scene | None = None,
) -> Plan:
    """Read a benchmark and its scene, and return the plan of its environment.

    Raises:
        BadSetting: the benchmark has no environment, or a part of it is invalid.
        UwsimError: a file is invalid.
    """
    with tempfile.TemporaryDirectory(prefix="uwsim-") as folder:
        files = write_run_files(benchmark, scene, Path(folder))
        plan = make_plan(
            PlanRequest(
                benchmark=files.benchmark,
                scene=files.scene,
                algorithm="uwsim.envs.task:OuterPolicy",
                algorithm_class=OuterPolicy,
                in_process=True,
                mode="independent",
                settings=[f"{path}={value}" for path, value in settings.items()],
                data_path=(*(Path(folder) for folder in data_path), *files.folders),
                plugins=files.plugins,
            )
        )
    if isinstance(benchmark, Benchmark):  # its written file is gone
        plan = replace(plan, benchmark=replace(plan.benchmark, path=benchmark.path))
    if isinstance(scene, Scene):
        plan = replace(plan, scene=replace(plan.scene, path=scene.path))
    environment = change_environment(plan.benchmark.environment, options, plan)
    if errors := [message for _, message in environment.errors(plan.benchmark.measures)]:
        raise BadSetting(f"{plan.benchmark.path}: {'; '.join(errors)}.")
    benchmark_spec = replace(plan.benchmark, environment=environment)
    return replace(plan, benchmark=benchmark_spec, is_blind=True)


def change_environment(
    spec: EnvironmentSpec | None, options: EnvironmentOptions, plan: Plan
) -> EnvironmentSpec:
    """Return an environment with some parts replaced; without one, a new environment.

    Raises:
        BadSetting: a new environment lacks observations or actions.
    """
    changes: dict[str, Any] = {
        name: value
        for name in ("reward", "success", "vehicle", "reference", "period")
        if (value := getattr(options, name)) is not None
    }
    if options.observation is not None:
        names = [name for name in options.observation if ":" not in name]
        fields = [name.rsplit(":", 1) for name in options.observation if ":" in name]
        changes["observation"] = " ".join(names)
        changes["topic_field"] = tuple(TopicFieldSpec(topic=t, field=f) for t, f in fields)
    if options.action is not None:
        changes["action"] = tuple(read_action(text) for text in options.action)
    if spec is None:
        if options.observation is None or options.action is None:
            raise BadSetting(
                f"{plan.benchmark.path}: the benchmark has no <u:environment>; give observation "
                "and action, as observation=['positionError'], action=['/bluerov2/thrusters']."
            )
        vehicles = [vehicle.name for vehicle in plan.scene.vehicles]
        spec = EnvironmentSpec(vehicle=vehicles[0] if vehicles else "", action=())
    return replace(spec, **changes)


def read_action(text: str) -> ActionSpec:
    """Read the commands of an action: ``TOPIC``, ``TOPIC:AXIS,AXIS`` or ``TOPIC:AXIS=LIMIT,...``.

    Raises:
        BadSetting: a limit is no number.
    """
    topic, _, axes = text.partition(":")
    parts = [part.strip() for part in axes.split(",") if part.strip()]
    names = [part.partition("=")[0] for part in parts]
    limits = [part.partition("=")[2] or "1" for part in parts]
    try:
        numbers = tuple(float(limit) for limit in limits)
    except ValueError:
        raise BadSetting(
            f"action {text!r}: a limit is no number; expected '/cmd_vel:vx=0.5,wz=1'."
        ) from None
    return ActionSpec(topic=topic, axes=" ".join(names), limits=numbers)


def trial_of(seed: int, level: Level) -> Trial:
    """Return the trial of an episode: one level alone."""
    return Trial(index=0, repeat=0, seed=seed, levels=(level,), is_independent=True)
