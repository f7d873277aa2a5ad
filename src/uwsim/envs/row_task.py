"""The task of rows of free vehicles, from a benchmark whose environment they can step.

Rows (`uwsim.envs.batch`) step one free vehicle each. They observe the state, act by thrusters, and
are rewarded by the distance from the reference.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.expression import parse
from ..base.geometry import Array, Pose, quaternion_from_rotation
from ..benchmark.environment import EnvironmentSpec
from ..benchmark.environment.reward import REWARD_NAMES
from ..benchmark.reference_trajectory import TrajectorySpec
from ..benchmark.triggers.never import NeverSpec
from ..benchmark.updaters import (
    CurrentForceUpdaterSpec,
    NoneSpec,
    RepeatSpec,
    SeaStateUpdaterSpec,
    chain,
)
from ..devices.battery import BatterySpec
from ..errors import BadSetting
from ..model.body_names import vehicle_body
from ..model.scene_model import SceneModel
from ..physics.hydrodynamics.free_vehicle import free_vehicle
from ..physics.hydrodynamics.kernel.free_step import FreeVehicle
from ..runs.planning.plan import Plan
from ..runs.planning.trial_cache import compile_plan
from ..scene.variation import apply_variations
from ..topics.thruster_commands import ROSThrustersToPATSpec
from .batch.flows import n_bodies
from .episode import environment_of, max_steps_of
from .row_water import WATER_PATHS, RowWater

UPDATERS = (CurrentForceUpdaterSpec, SeaStateUpdaterSpec, NoneSpec, RepeatSpec)
"""The updaters whose levels rows can have."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RowPlan:
    """The numbers of a benchmark that rows step."""

    plan: Plan
    """The plan of the benchmark."""
    spec: EnvironmentSpec
    """The environment."""
    trajectory: TrajectorySpec
    """The desired position at each time."""
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
    max_steps: int
    """The number of periods in an episode."""

    def start(self, seed: int) -> tuple[Array, Array]:
        """Return the position in W [m] and the attitude (wxyz) at the start of an episode."""
        scene = apply_variations(self.plan.scene, seed)
        vehicle = scene.vehicles[self.index]
        pose = self.world_from_localized @ Pose.from_rpy(vehicle.position, vehicle.orientation)
        return pose.position, quaternion_from_rotation(pose.rotation)


def plan_rows(plan: Plan, model: SceneModel) -> RowPlan:
    """Return the numbers of a benchmark that rows step.

    Raises:
        BadSetting: rows cannot step it; the message has the reasons.
    """
    spec = environment_of(plan)
    trajectory = spec.trajectory(plan.benchmark.measures)
    reasons = _find_reasons(plan, spec, model)
    if trajectory is None:
        reasons.append("it has no <reference> to a desired position")
    _refuse(plan, reasons)
    assert trajectory is not None
    index = [vehicle.name for vehicle in model.scene.vehicles].index(spec.vehicle)
    root = model.engine_model.body(vehicle_body(index, model.robots[index].root)).id
    vehicle = free_vehicle(model.engine_model, root)
    substeps = max(1, round(spec.period / plan.timestep))
    max_steps = max_steps_of(plan)
    n_steps = substeps * max_steps
    water = RowWater(plan, model, spec.vehicle, n_bodies=n_bodies(vehicle), n_steps=n_steps)
    _refuse(plan, [*water.reasons(), *_find_variations(plan, spec.vehicle, vehicle, root)])
    return RowPlan(
        plan=plan,
        spec=spec,
        trajectory=trajectory,
        vehicle=vehicle,
        water=water,
        index=index,
        world_from_localized=model.scene.world_from_localized,
        substeps=substeps,
        max_steps=max_steps,
    )


def _refuse(plan: Plan, reasons: Sequence[str]) -> None:
    """Raise BadSetting if there is a reason why rows cannot step an environment."""
    if reasons:
        raise BadSetting(
            f"{plan.benchmark.path}: rows cannot step this environment: {'; '.join(reasons)}. "
            "Use stepper='engine'."
        )


def _find_reasons(plan: Plan, spec: EnvironmentSpec, model: SceneModel) -> list[str]:
    """Return the reasons why rows cannot step an environment."""
    reasons = []
    names = [vehicle.name for vehicle in model.scene.vehicles]
    if len(names) != 1 or names.index(spec.vehicle) not in model.dynamics:
        reasons.append("its scene has other than one vehicle with dynamics")
    if any(robot.movable_joints for robot in model.robots.values()):
        reasons.append("its vehicle has moving joints")
    if any(isinstance(part, BatterySpec) for item in model.scene.vehicles for part in item.parts):
        reasons.append("its vehicle has a battery, which may limit its thrusters")
    if spec.reference_vehicle(plan.benchmark.measures) is not None:
        reasons.append("its reference is relative to a vehicle")
    if spec.topic_field:
        reasons.append("it observes topics")
    if spec.relations:
        reasons.append("it observes relations of bodies")
    if spec.image:
        reasons.append("it observes images")
    topics = [
        interface.topic
        for interface in model.scene.ros_interfaces
        if isinstance(interface, ROSThrustersToPATSpec)
    ]
    if [action.topic for action in spec.action] != topics[:1] or any(
        action.limits for action in spec.action
    ):
        reasons.append("its action is not the commands of all thrusters")
    samples = spec.sample_names(plan.benchmark.measures)
    known_names = {spec.reference or "", *REWARD_NAMES}
    reward = parse(spec.reward, [*samples, *REWARD_NAMES])
    other_measures = [name for name in reward.names if name not in known_names]
    if other_measures:
        reasons.append(f"its reward has the measure {', '.join(other_measures)}")
    if other_updaters := [
        updater.name
        for updater in chain(plan.benchmark.scene_updater)
        if not isinstance(updater, UPDATERS)
    ]:
        reasons.append(f"its updater changes {', '.join(other_updaters)}")
    if model.scene.forces:
        reasons.append("its scene has forces")
    solids = [item.name for item in model.scene.objects if item.has_contacts(in_water=True)]
    if solids:
        reasons.append(f"its scene has solid objects ({', '.join(solids[:3])})")
    if not isinstance(plan.benchmark.stop_on, NeverSpec):
        reasons.append("a trigger ends its levels")
    return reasons


def _find_variations(plan: Plan, name: str, vehicle: FreeVehicle, root: int) -> list[str]:
    """Return a reason if ``<u:vary>`` changes the numbers of the vehicle, else nothing."""
    other_paths = (f"vehicle[{name}].position", f"vehicle[{name}].orientation", *WATER_PATHS)
    paths = [item.path for item in plan.scene.vary if not item.path.startswith(other_paths)]
    if not paths:
        return []
    other_vehicle = free_vehicle(compile_plan(plan, 1).engine_model, root)
    is_same = all(
        np.array_equal(np.asarray(a), np.asarray(b))
        for a, b in zip(vehicle, other_vehicle, strict=True)
    )
    return [] if is_same else [f"<u:vary> changes its vehicle ({', '.join(paths)})"]
