"""The task of rows of free vehicles, from a benchmark whose environment they can step.

Rows (`uwsim.envs.compiled`) step one free vehicle each. They observe the state, act by thrusters,
and compute the measures of position and energy.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..base.expression import parse
from ..base.geometry import Pose
from ..benchmark.environment import EnvironmentSpec
from ..benchmark.environment.reward import REWARD_NAMES
from ..benchmark.measures import (
    CollisionSpec,
    EnergySpec,
    GraspSpec,
    MeasureSpec,
    OutcomeSpec,
    PositionErrorSpec,
    TrackingErrorSpec,
    find_outcome_spec,
)
from ..benchmark.triggers.never import NeverSpec
from ..benchmark.triggers.on_init import OnInitSpec
from ..benchmark.updaters import (
    CurrentForceUpdaterSpec,
    NoneSpec,
    RepeatSpec,
    SeaStateUpdaterSpec,
    chain,
    interval,
)
from ..devices.battery import BatterySpec
from ..errors import BadSetting
from ..model.body_names import vehicle_body
from ..model.scene_model import SceneModel
from ..physics.hydrodynamics.columns import N_ADVANCE
from ..physics.hydrodynamics.free_vehicle import free_vehicle
from ..physics.hydrodynamics.kernel.free_step import FreeVehicle
from ..runs.planning.plan import Plan
from ..runs.planning.trial_cache import compile_plan
from ..scene.hydrodynamics.spec import ThrusterSpec
from ..topics.thruster_commands import ROSThrustersToPATSpec
from .batch.flows import n_bodies
from .compiled.outcomes import outcome_reasons
from .episode import environment_of
from .row_water import WATER_PATHS, RowWater

UPDATERS = (CurrentForceUpdaterSpec, SeaStateUpdaterSpec, NoneSpec, RepeatSpec)
"""The updaters whose levels rows can have."""
ROW_CHANNELS = (
    "positionError", "referenceVelocity", "position", "heading", "gravity", "linearVelocity",
    "angularVelocity", "lastAction",
)  # fmt: skip
"""The observed quantities that rows compute, in the order of their codes."""
START_PARTS = (*(f"position.{axis}" for axis in "xyz"), *(f"orientation.{axis}" for axis in "rpy"))
"""The paths of the numbers of a vehicle's start, below the vehicle."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RowPlan:
    """The numbers of a benchmark that rows step."""

    plan: Plan
    """The plan of the benchmark."""
    spec: EnvironmentSpec
    """The environment."""
    measures: tuple[MeasureSpec, ...]
    """The measures that rows compute."""
    outcome: OutcomeSpec | None
    """The outcome, which determines the status; None: that of a complete episode is ``ok``."""
    thrusters: tuple[ThrusterSpec, ...]
    """The thrusters of the vehicle."""
    vehicle: FreeVehicle
    """The numbers of the vehicle."""
    water: RowWater
    """The water of the levels."""
    index: int
    """The index of the vehicle in the scene."""
    world_from_localized: Pose
    """The pose of L in W."""
    substeps: int
    """The number of physics steps in a period."""
    n_steps: int
    """The number of physics steps in an episode."""


class RowsRefused(BadSetting):
    """An environment that rows cannot step, with the reasons."""

    def __init__(self, path: str, reasons: str) -> None:
        self.reasons = f"rows cannot step this environment: {reasons}"
        """The reasons, without the name of the file."""
        super().__init__(f"{path}: {self.reasons}. Use stepper='engine'.")


def plan_rows(plan: Plan, model: SceneModel) -> RowPlan:
    """Return the numbers of a benchmark that rows step.

    Raises:
        RowsRefused: rows cannot step it; the message has the reasons.
    """
    spec = environment_of(plan)
    _refuse(plan, [*_scene_reasons(plan, spec, model), *_level_reasons(plan, spec)])
    index = [vehicle.name for vehicle in model.scene.vehicles].index(spec.vehicle)
    root = model.engine_model.body(vehicle_body(index, model.robots[index].root)).id
    vehicle = free_vehicle(model.engine_model, root)
    measures = tuple(
        measure
        for measure in plan.benchmark.measures
        if _is_computed(measure, spec.vehicle, vehicle)
    )
    outcome = find_outcome_spec(plan.benchmark.measures)
    _refuse(
        plan,
        [
            *_measure_reasons(plan, spec, [measure.name for measure in measures]),
            *outcome_reasons(outcome, measures),
        ],
    )
    n_steps = round((interval(plan.benchmark.scene_updater) or 0.0) / plan.timestep)
    water = RowWater(plan, model, spec.vehicle, n_bodies=n_bodies(vehicle), n_steps=n_steps)
    _refuse(plan, [*water.reasons(), *_find_variations(plan, spec.vehicle, vehicle, root)])
    return RowPlan(
        plan=plan,
        spec=spec,
        measures=measures,
        outcome=outcome,
        thrusters=tuple(model.dynamics[index].thrusters),
        vehicle=vehicle,
        water=water,
        index=index,
        world_from_localized=model.scene.world_from_localized,
        substeps=round(spec.period / plan.timestep),
        n_steps=n_steps,
    )


def start_paths(vehicle: str) -> list[str]:
    """Return the paths of the numbers of a vehicle's start: x, y, z, and the angles of Rx Ry Rz."""
    return [f"vehicle[{vehicle}].{part}" for part in START_PARTS]


def _refuse(plan: Plan, reasons: Iterable[str]) -> None:
    """Raise RowsRefused if there is a reason why rows cannot step an environment."""
    if text := "; ".join(reasons):
        raise RowsRefused(plan.benchmark.path, text)


def _scene_reasons(plan: Plan, spec: EnvironmentSpec, model: SceneModel) -> Iterator[str]:
    """Yield the reasons in the scene why rows cannot step an environment."""
    vehicles = model.scene.vehicles
    names = [vehicle.name for vehicle in vehicles]
    if len(names) != 1 or names.index(spec.vehicle) not in model.dynamics:
        yield "its scene has other than one vehicle with dynamics"
    if any(robot.movable_joints for robot in model.robots.values()):
        yield "its vehicle has moving joints"
    if any(isinstance(part, BatterySpec) for item in vehicles for part in item.parts):
        yield "its vehicle has a battery, which may limit its thrusters"
    if spec.reference_vehicle(plan.benchmark.measures) is not None:
        yield "its reference is relative to a vehicle"
    if any(vehicle.on_floor is not None for vehicle in plan.scene.vehicles):
        yield "its vehicle begins on the floor"
    topics = [
        interface.topic
        for interface in model.scene.ros_interfaces
        if isinstance(interface, ROSThrustersToPATSpec)
    ]
    if [action.topic for action in spec.action] != topics[:1] or any(
        action.limits for action in spec.action
    ):
        yield "its action is not the commands of all thrusters"
    if model.scene.forces:
        yield "its scene has forces"
    solids = [item.name for item in model.scene.objects if item.has_contacts(in_water=True)]
    if solids:
        yield f"its scene has solid objects ({', '.join(solids[:3])})"


def _level_reasons(plan: Plan, spec: EnvironmentSpec) -> Iterator[str]:
    """Yield the reasons in the levels and the observation why rows cannot step an environment."""
    if spec.topic_field:
        yield "it observes topics"
    if other_channels := [name for name in spec.channels if name not in ROW_CHANNELS]:
        yield f"it observes {', '.join(other_channels)}"
    if spec.relations:
        yield "it observes relations of bodies"
    if spec.image:
        yield "it observes images"
    updaters = chain(plan.benchmark.scene_updater)
    if other_updaters := [item.name for item in updaters if not isinstance(item, UPDATERS)]:
        yield f"its updater changes {', '.join(other_updaters)}"
    if interval(plan.benchmark.scene_updater) is None:
        yield "its levels have no <interval>"
    n_substeps = spec.period / plan.timestep
    if round(n_substeps) < 1 or abs(n_substeps - round(n_substeps)) > 1e-9:
        yield f"its period of {spec.period:g} s is no multiple of the step of {plan.timestep:g} s"
    if not isinstance(plan.benchmark.stop_on, NeverSpec):
        yield "a trigger ends its levels"
    for measure in plan.benchmark.measures:
        if isinstance(measure, CollisionSpec | GraspSpec):
            yield f"its measure {measure.name} may end a level"
    if plan.compatibility:
        yield f"it has the compatibility {', '.join(sorted(plan.compatibility))}"


def _measure_reasons(plan: Plan, spec: EnvironmentSpec, measures: Sequence[str]) -> Iterator[str]:
    """Yield the measures that reward and success need and rows do not compute."""
    names = spec.sample_names(plan.benchmark.measures)
    known_names = (*measures, *REWARD_NAMES)
    for kind, text in (("reward", spec.reward), ("success", spec.success or "0")):
        names_used = parse(text, [*names, *REWARD_NAMES]).names
        if other_names := [name for name in names_used if name not in known_names]:
            yield f"its {kind} has the measure {', '.join(other_names)}"
    if spec.reference is not None and spec.reference not in measures:
        yield f"its reference {spec.reference} is no measure that rows compute"


def _find_variations(plan: Plan, name: str, vehicle: FreeVehicle, root: int) -> list[str]:
    """Return a reason if ``<u:vary>`` changes the numbers of the vehicle, else nothing."""
    other_paths = (f"vehicle[{name}].position", f"vehicle[{name}].orientation", *WATER_PATHS)
    paths = [item.path for item in plan.scene.vary if not item.path.startswith(other_paths)]
    if not paths:
        return []
    if any(path.startswith("simParams") for path in paths):
        return [f"<u:vary> changes the frame of its scene ({', '.join(paths)})"]
    other_vehicle = free_vehicle(compile_plan(plan, 1).engine_model, root)
    is_same = all(
        np.array_equal(np.asarray(a), np.asarray(b))
        for a, b in zip(vehicle, other_vehicle, strict=True)
    )
    return [] if is_same else [f"<u:vary> changes its vehicle ({', '.join(paths)})"]


def _is_computed(measure: MeasureSpec, vehicle: str, numbers: FreeVehicle) -> bool:
    """Return whether rows compute a measure: a distance of the vehicle, or its energy."""
    if not isinstance(measure.start_on, OnInitSpec) or not isinstance(measure.stop_on, NeverSpec):
        return False
    if isinstance(measure, EnergySpec):
        has_inflow = bool(np.any(numbers.actuators[:, N_ADVANCE] > 0.0))
        return measure.target == vehicle and not has_inflow
    if isinstance(measure, PositionErrorSpec):
        return measure.target == vehicle and measure.topic is None
    if not isinstance(measure, TrackingErrorSpec) or measure.trajectory.shape == "square":
        return False
    return measure.target == vehicle and measure.relative_to is None
