"""The task of an environment: the plan of a benchmark with its ``<u:environment>``."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypedDict, get_args

from ..base.external_values import read_number
from ..benchmark.environment import (
    MAX_SIZE,
    ActionSpec,
    ContactSpec,
    EnvironmentSpec,
    ImageSpec,
    RelativePoseSpec,
    TopicFieldSpec,
)
from ..benchmark.environment.spec import MAX_PERIOD
from ..benchmark.updaters import Level
from ..bus import Node
from ..editing import Benchmark, Scene
from ..editing.run_files import write_run_files
from ..errors import BadSetting, UnknownName, did_you_mean, short_repr
from ..messages import Empty
from ..runs.planning.make_plan import make_plan
from ..runs.planning.plan import Plan, Trial
from ..runs.planning.plan_request import PlanRequest
from ..world import ImageContent

IMAGE_CONTENTS: tuple[ImageContent, ...] = get_args(ImageContent)
"""The contents of observed images."""
LISTS = {"observation": "['positionError']", "action": "['/bluerov2/thrusters']"}
"""The parts of an environment that are lists of texts, with an example of each."""
TEXTS = {
    "reward": "'exp(-offset)'",
    "success": "'offset < 0.3'",
    "vehicle": "'bluerov2'",
    "reference": "'offset'",
}
"""The parts of an environment that are texts, with an example of each."""
AGENTS_EXAMPLE = "agents={'bluerov2': {'observation': [...], 'action': [...]}}"


@dataclass(frozen=True, kw_only=True)
class EnvironmentOptions:
    """The parts of an environment that replace those of the benchmark file; None: no change."""

    observation: Sequence[str] | None = None
    """The quantities of the state, as ``positionError``, fields of topics, as
    ``/bluerov2/dvl:velocity``, images of sensors, as ``camera:image``, ``camera:grey=84x84`` or
    ``camera:depth``, and relations of bodies, as ``dock=pose(dock, bluerov2)`` and
    ``touched=contact(dock, bluerov2)``."""
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

    def __post_init__(self) -> None:
        """Raise BadSetting if a part is not of its type; the period has a check of its own."""
        for name, example in LISTS.items():
            value = getattr(self, name)
            if value is None:
                continue
            is_list = isinstance(value, Sequence) and not isinstance(value, str | bytes)
            if not is_list or not all(isinstance(item, str) for item in value):
                raise BadSetting(
                    f"{name} is {short_repr(value)}; expected a list of texts, as {example}."
                )
        for name, example in TEXTS.items():
            value = getattr(self, name)
            if value is not None and not isinstance(value, str):
                raise BadSetting(f"{name} is {short_repr(value)}; expected a text, as {example}.")


class AgentOptions(TypedDict, total=False):
    """The options of the environment of one of several vehicles; `BenchmarkEnv` describes them."""

    observation: Sequence[str] | None
    action: Sequence[str] | None
    reward: str | None
    success: str | None
    reference: str | None
    period: float | None


def read_agents(agents: object) -> dict[str, EnvironmentOptions] | None:
    """Return the options of each agent, from a dictionary for each vehicle; None: those of a file.

    Raises:
        BadSetting: it has another form, or an option is unknown or invalid.
    """
    if agents is None:
        return None
    if not isinstance(agents, Mapping) or not agents:
        raise BadSetting(
            f"agents is {short_repr(agents)}; expected a dictionary with a vehicle at least, as "
            f"{AGENTS_EXAMPLE}."
        )
    known_names = list(AgentOptions.__annotations__)
    options = {}
    for agent, parts in agents.items():
        if not isinstance(parts, Mapping):
            raise BadSetting(
                f"agents[{short_repr(agent)}] is {short_repr(parts)}; expected a dictionary, as "
                f"{AGENTS_EXAMPLE}."
            )
        for name in parts:
            if name not in known_names:
                raise BadSetting(
                    f"agents[{short_repr(agent)}] has no option {short_repr(name)}."
                    f"{did_you_mean(str(name), known_names)} Known: {', '.join(known_names)}."
                )
        options[agent] = EnvironmentOptions(**parts)
    return options


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
    """Read a benchmark and its scene, and return the plan of the environment of one vehicle.

    Raises:
        BadSetting: the benchmark has no environment, environments of several vehicles of which
            none is chosen, or a part of it is invalid.
        UwsimError: a file is invalid.
    """
    plan = read_plan(benchmark, settings=settings, data_path=data_path, scene=scene)
    environments = plan.benchmark.environments
    vehicles = [spec.vehicle for spec in environments]
    if len(environments) > 1 and options.vehicle not in vehicles:
        raise BadSetting(
            f"{plan.benchmark.path}: the benchmark has environments of {len(vehicles)} vehicles; "
            f"expected vehicle={vehicles[0]!r}, or uwsim.make_parallel_env for all of them."
            f"{did_you_mean(options.vehicle or '', vehicles)}"
        )
    spec = next((spec for spec in environments if spec.vehicle == options.vehicle), None)
    return with_environments(
        plan, [change_environment(spec or plan.benchmark.environment, options, plan)]
    )


def make_agents_task(
    benchmark: str | Path | Benchmark,
    agents: Mapping[str, EnvironmentOptions] | None,
    *,
    settings: Mapping[str, float | str],
    data_path: Sequence[str | Path],
    scene: str | Path | Scene | None = None,
) -> Plan:
    """Read a benchmark and its scene, and return the plan of the environments of several vehicles.

    Args:
        benchmark: a benchmark file, a bundled name, or a `Benchmark`.
        agents: the parts of the environment of each vehicle that acts, by its name; None: the
            environments of the file.
        settings: values to change in the scene and the updaters.
        data_path: more folders in which files are searched.
        scene: the scene; None: the scene that the benchmark names.

    Raises:
        BadSetting: there is no environment, their periods differ, or a part of one is invalid.
        UnknownName: the scene has no such vehicle.
        UwsimError: a file is invalid.
    """
    plan = read_plan(benchmark, settings=settings, data_path=data_path, scene=scene)
    specs = {spec.vehicle: spec for spec in plan.benchmark.environments}
    if agents is not None:
        vehicles = [vehicle.name for vehicle in plan.scene.vehicles]
        for name in agents:
            if name not in vehicles:
                raise UnknownName("vehicle", name, vehicles)
        specs = {
            name: change_environment(specs.get(name), replace(options, vehicle=name), plan)
            for name, options in agents.items()
        }
    if not specs:
        raise BadSetting(
            f"{plan.benchmark.path}: the benchmark has no <u:environment>; give agents, as "
            f"{AGENTS_EXAMPLE}."
        )
    periods = sorted({spec.period for spec in specs.values()})
    if len(periods) > 1:
        raise BadSetting(
            f"{plan.benchmark.path}: the environments have the periods "
            f"{', '.join(f'{period:g}' for period in periods)} s; expected the same for all agents."
        )
    return with_environments(plan, list(specs.values()))


def with_environments(plan: Plan, environments: Sequence[EnvironmentSpec]) -> Plan:
    """Return a plan with other environments.

    Raises:
        BadSetting: a part of an environment is invalid.
    """
    measures = plan.benchmark.measures
    if errors := [message for spec in environments for _, message in spec.errors(measures)]:
        raise BadSetting(f"{plan.benchmark.path}: {'; '.join(errors)}.")
    benchmark = replace(plan.benchmark, environments=tuple(environments))
    return replace(plan, benchmark=benchmark, is_blind=True, records_motion=False)


def read_plan(
    benchmark: str | Path | Benchmark,
    *,
    settings: Mapping[str, float | str],
    data_path: Sequence[str | Path],
    scene: str | Path | Scene | None,
) -> Plan:
    """Read a benchmark and its scene, and return the plan of a program outside that acts.

    Raises:
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
    return plan


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
    if options.period is not None:
        _check_period(options.period)
    if options.observation is not None:
        relations = [read_relation(name) for name in options.observation if "(" in name]
        changes["relative_pose"] = tuple(r for r in relations if isinstance(r, RelativePoseSpec))
        changes["contact"] = tuple(r for r in relations if isinstance(r, ContactSpec))
        names = [name for name in options.observation if ":" not in name and "(" not in name]
        parts = [_read_part(name) for name in options.observation if ":" in name]
        changes["observation"] = " ".join(names)
        changes["topic_field"] = tuple(part for part in parts if isinstance(part, TopicFieldSpec))
        changes["image"] = tuple(part for part in parts if isinstance(part, ImageSpec))
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


def _check_period(period: float) -> None:
    """Raise BadSetting if a period is no number that a benchmark file may have."""
    number = read_number(period)
    if number is None or not 0.0 < number <= MAX_PERIOD:
        raise BadSetting(
            f"period is {short_repr(period)}; expected a number above 0, at most {MAX_PERIOD:g} s."
        )


def _read_part(text: str) -> TopicFieldSpec | ImageSpec:
    """Read a part of an observation: ``TOPIC:FIELD``, or ``SENSOR:CONTENT`` with ``=WxH``.

    Raises:
        BadSetting: the size of an image is invalid.
    """
    name, field = text.rsplit(":", 1)
    word, has_size, size = field.partition("=")
    for content in IMAGE_CONTENTS:
        if word != content or name.startswith("/"):
            continue
        match = re.fullmatch(r"([1-9]\d{0,3})x([1-9]\d{0,3})", size)
        if match is None and has_size:
            raise BadSetting(
                f"observation {text!r}: the size is {size!r}; expected width and height, each 1 to "
                f"{MAX_SIZE} px, as '{name}:{content}=128x96'."
            )
        width, height = (None, None) if match is None else (int(match[1]), int(match[2]))
        if max(width or 1, height or 1) > MAX_SIZE:
            raise BadSetting(
                f"observation {text!r}: the size is {size!r}; expected {MAX_SIZE} px at most."
            )
        return ImageSpec(sensor=name, content=content, width=width, height=height)
    if not name.startswith("/"):
        raise BadSetting(
            f"observation {text[:80]!r}: {word[:60]!r} is no content of an image."
            f"{did_you_mean(word, IMAGE_CONTENTS)} Known: {', '.join(IMAGE_CONTENTS)}; the topic "
            "of a field begins with /."
        )
    return TopicFieldSpec(topic=name, field=field)


def read_relation(text: str) -> RelativePoseSpec | ContactSpec:
    """Read a relation of bodies: ``NAME=pose(BODY, FRAME)`` or ``NAME=contact(BODY, BODY)``.

    The first is the pose of a body in the frame of another.

    Raises:
        BadSetting: the text has another form.
    """
    match = re.fullmatch(r"\s*(\w+)\s*=\s*(pose|contact)\(([^(),]+),([^(),]+)\)\s*", text)
    if match is None:
        raise BadSetting(
            f"observation {text[:80]!r} is no relation; expected 'dock=pose(dock, bluerov2)' or "
            "'touched=contact(dock, bluerov2)'."
        )
    name, kind, first, second = (group.strip() for group in match.groups())
    if kind == "pose":
        return RelativePoseSpec(name=name, to=first, from_=second)
    return ContactSpec(name=name, target=first, other=second)


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
