"""Warnings about a vehicle's numbers: likely mistakes of units, signs and powers of ten.

The values may be intended: a lander sinks, a spar buoy is 60 m long. A warning is omitted if the
``<u:accept>`` of the vehicle names its check.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import dot
from ...errors import Diagnostic, UwsimError
from ...model.balance import Balance, balance_of
from ...model.collision.hull import Hull, hull_of
from ...model.dynamics import DYNAMICS
from ...model.inertias import MIN_INERTIA
from ...physics.actuation.allocation import thrust_curve, thrusters_on_base
from ...scene.accepted_warnings import VehicleWarning, acceptance_hint
from ...scene.hydrodynamics.spec import BodyHydrodynamics, VehicleHydrodynamics, matrix
from ...scene.urdf.kinematics import link_poses
from ...scene.urdf.robot import LinkSpec, RobotSpec
from ...scene.vehicle import VehicleSpec
from ...world import TIMESTEP
from ..subjects import CheckedScene

MAX_IMBALANCE = 0.1
"""The greatest difference of mass and displaced mass that is not reported, as a fraction of the
greater of them [1]."""
MAX_VOLUME_RATIO = 2.0
"""The greatest ratio of displaced volume to the volume of the link boxes [1]."""
MIN_VOLUME_RATIO = 0.005
"""The minimum ratio of displaced volume to the volume of the link boxes [1]."""
MIN_INSTABILITY = 1e-3
"""The height of the centre of mass above the centre of buoyancy from which it is reported [m]."""
MAX_SIZE, MIN_SIZE = 50.0, 0.05
"""The limits of a vehicle's length [m]."""
MAX_HULL_DISTANCE = 0.5
"""The greatest distance of a part from the hull that is not reported, as a fraction of the
vehicle's length [1]."""
MAX_ACCELERATION = 50.0
"""The greatest expected acceleration by one thruster [m/s2]."""
DRAG_SPEED = 1.0
"""The speed at which quadratic drag is checked [m/s]."""
GYRATION_LIMITS = (0.03, 2.0)
"""The limits of the radius of gyration, as a fraction of the link's length [1]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DynamicVehicle:
    """A vehicle with dynamics (``<u:dynamics>``), with its robot, hydrodynamics and shape."""

    spec: VehicleSpec
    """The spec of the vehicle."""
    robot: RobotSpec
    """The robot of the vehicle, with its links and joints."""
    dynamics: VehicleHydrodynamics
    """The hydrodynamics of the links."""
    balance: Balance
    """The mass, the displaced mass, and the centres of mass and buoyancy in the base frame."""
    up: Array
    """The unit vector in the base frame that points up at the start, (3,)."""
    hull: Hull | None
    """The boxes around the links; None for a vehicle without a shape."""

    @property
    def height(self) -> float:
        """The height of the centre of buoyancy over the centre of mass at the start [m]."""
        return dot(self.balance.centre_of_buoyancy - self.balance.centre_of_mass, self.up)


def describe_size(hull: Hull, robot: RobotSpec) -> str:
    """Describe a vehicle as large as a ship, or smaller than a hand; empty if it is neither."""
    if MIN_SIZE <= hull.size <= MAX_SIZE:
        return ""
    link, box = max(hull.links.items(), key=lambda entry: float(entry[1].extent.max()))
    spec = robot.link(link)
    solids = () if spec is None else spec.solids
    file = next((shape.file for shape in solids if shape.file), "")
    link_name = f"{link!r} ({file})" if file else repr(link)
    return (
        f"it is {hull.size:.4g} m long, its link {link_name} {box.extent.max():.4g} m; expected "
        f"{MIN_SIZE:g} to {MAX_SIZE:g} m. A mesh in millimetres needs "
        'scale="0.001 0.001 0.001" in the URDF'
    )


VehicleCheck = Callable[[DynamicVehicle], str]
"""A function that describes unlikely values of a vehicle with dynamics; empty if all are likely."""


def vehicle_numbers(
    scene: CheckedScene,
    hull_checks: Mapping[VehicleWarning, Callable[[Hull, RobotSpec], str]],
    vehicle_checks: Mapping[VehicleWarning, VehicleCheck],
) -> Iterator[Diagnostic]:
    """Apply checks to each vehicle; the keys are the names that suppress the warnings.

    Args:
        scene: the scene.
        hull_checks: checks of the shape of a vehicle, with or without dynamics.
        vehicle_checks: checks of a vehicle with dynamics.
    """
    for index in scene.checked_vehicles:
        vehicle, robot = scene.spec.vehicles[index], scene.robots[index]
        hull = None
        with suppress(UwsimError):  # reported where models are checked
            hull = hull_of(scene.resolved_scene, index)
        texts: list[tuple[VehicleWarning, str, str]] = []
        if hull is not None:
            texts += [(name, "file", check(hull, robot)) for name, check in hull_checks.items()]
        if index in scene.dynamics:
            dynamics, pose = scene.dynamics[index], vehicle.localized_from_base
            dynamic_vehicle = DynamicVehicle(
                spec=vehicle,
                robot=robot,
                dynamics=dynamics,
                balance=balance_of(robot, dynamics, vehicle.joint_values),
                up=(scene.spec.world_from_localized @ pose).rotation[2],
                hull=hull,
            )
            texts += [
                (name, DYNAMICS, check(dynamic_vehicle)) for name, check in vehicle_checks.items()
            ]
        for warning, element, text in texts:
            if text and warning not in vehicle.accepts:
                message = f"the vehicle {vehicle.name!r}: {text}. {acceptance_hint(warning)}"
                yield scene.warning(vehicle, message, element)


def describe_buoyancy(vehicle: DynamicVehicle) -> str:
    """Describe a mass that is not balanced, or a displaced volume that does not fit the shape."""
    mass, water_mass = vehicle.balance.mass, vehicle.balance.displaced_mass
    messages = []
    if abs(water_mass - mass) > MAX_IMBALANCE * max(water_mass, mass):
        verb = "sinks" if mass > water_mass else "rises"
        messages.append(
            f"it has {mass:.6g} kg and displaces {water_mass:.6g} kg of water: it {verb} with "
            f"{abs(vehicle.balance.buoyancy):.3g} N. Expected nearly the same; check <mass> in kg "
            f"and <volume> in m3 of the set {vehicle.dynamics.name!r}"
        )
    volume = water_mass / vehicle.dynamics.density
    box_volume = volume if vehicle.hull is None else vehicle.hull.volume
    if not MIN_VOLUME_RATIO * box_volume <= volume <= MAX_VOLUME_RATIO * box_volume:
        messages.append(
            f"it displaces {volume:.3g} m3 and the boxes around its links have {box_volume:.3g} "
            f"m3; expected {MIN_VOLUME_RATIO:g} to {MAX_VOLUME_RATIO:g} times that"
        )
    return "; ".join(messages)


def describe_balance(vehicle: DynamicVehicle) -> str:
    """Describe a vehicle without static stability; empty if it is stable."""
    if vehicle.height > -MIN_INSTABILITY or not vehicle.balance.displaced_mass > 0.0:
        return ""
    return (
        f"its centre of buoyancy is {-vehicle.height:.3g} m below its centre of mass at the start: "
        "it turns over; expected above. If it begins upside down: a vehicle whose z points up, in "
        "a file whose z points down, has the roll M_PI"
    )


def describe_positions(vehicle: DynamicVehicle) -> str:
    """Describe thrusters, fins and centres that are far from the hull; empty if none is."""
    if vehicle.hull is None:
        return ""
    values = vehicle.spec.joint_values
    thrusters = thrusters_on_base(vehicle.robot, vehicle.dynamics.thrusters, values)
    positions = [(f"thruster {unit.name!r}", np.array(unit.position)) for unit in thrusters]
    links = link_poses(vehicle.robot, values)
    positions += [
        (f"fin {fin.name!r}", links[fin.link].transform(np.array([fin.position]))[0])
        for fin in vehicle.dynamics.fins
    ]
    positions.append(("centre of mass", vehicle.balance.centre_of_mass))
    positions.append(("centre of buoyancy", vehicle.balance.centre_of_buoyancy))
    size = vehicle.hull.size
    far_parts = [
        f"its {name} {distance:.3g} m"
        for name, position in positions
        if (distance := vehicle.hull.distance(position)) > MAX_HULL_DISTANCE * size
    ]
    if not far_parts:
        return ""
    return (
        f"far from its hull, which is {size:.3g} m long, is {_list_first(far_parts)}; expected "
        "on it (<position> is in metres, in the frame of the link)"
    )


def describe_strength(vehicle: DynamicVehicle) -> str:
    """Describe thrusters that are too strong for the vehicle; empty if none is."""
    messages = []
    for thruster in vehicle.dynamics.thrusters:
        thrusts, _ = thrust_curve(thruster)
        max_thrust = float(max(-thrusts[0], thrusts[-1]))
        if thruster.saturation is not None:
            max_thrust = min(max_thrust, max(map(abs, thruster.saturation)))
        if max_thrust > MAX_ACCELERATION * vehicle.balance.mass:
            messages.append(f"{thruster.name!r} gives {max_thrust:.3g} N")
    if not messages:
        return ""
    return (
        f"its thruster {messages[0]} for {vehicle.balance.mass:.4g} kg; expected less than "
        f"{MAX_ACCELERATION:g} m/s2 (<forward> and <backward> in N)"
    )


def describe_inertia(vehicle: DynamicVehicle) -> str:
    """Describe links whose inertia does not fit their mass and size; empty if none does."""
    messages = []
    for link, mass, body in _links(vehicle):
        box = None if vehicle.hull is None else vehicle.hull.links.get(link.name)
        if mass <= 0.0 or box is None:
            continue
        inertia = link.inertia if body is None or body.inertia is None else body.inertia
        moments = inertia[:3]
        has_inertia = min(moments) > 0.0
        max_moment = max(moments) if has_inertia else MIN_INERTIA
        edges = np.sort(box.extent)
        min_radius, max_radius = (share * edges[2] for share in GYRATION_LIMITS)
        if min_radius <= math.sqrt(max_moment / mass) <= max_radius and min(moments) >= 0.0:
            continue
        # the greatest moment of inertia of a homogeneous box of the link's size
        box_moment = mass / 12.0 * float(edges[1] ** 2 + edges[2] ** 2)
        messages.append(
            f"its link {link.name!r} has {mass:.4g} kg and the inertia {_list(moments)}"
            + ("" if has_inertia else f" (it is simulated with {MIN_INERTIA:g})")
            + f"; a box of its size, {_list(box.extent)} m, has {box_moment:.2g} kg m2 at most"
        )
    return "; ".join(messages[:3])


def describe_drag(vehicle: DynamicVehicle) -> str:
    """Describe links that are so light that their drag stops them in a step; empty if none is."""
    messages = []
    joints, root = vehicle.robot.joints, vehicle.robot.root
    moving_links = {joint.child for joint in joints if joint.moves} | {root}
    for link, mass, body in _links(vehicle):
        if body is None or link.name not in moving_links:
            continue
        damping = matrix(body.linear_damping) + DRAG_SPEED * matrix(body.quadratic_damping)
        drag = np.diag(damping)[:3]
        if not drag.any():
            continue
        added_mass = np.diag(matrix(body.added_mass))[:3]
        steps = float((TIMESTEP * drag / np.maximum(mass + added_mass, 1e-9)).max())
        if mass <= 0.0:
            messages.append(f"its link {link.name!r} has drag and no mass")
        elif steps > 1.0 and body.implicitness < 1.0:
            messages.append(
                f"its link {link.name!r} has {mass:.3g} kg and a drag of {drag.max():.3g} N at 1 "
                "m/s, which stops it in a step. Expected <implicitness> 1, or less drag"
            )
    return "; ".join(messages[:3])


def describe_friction(vehicle: DynamicVehicle) -> str:
    """Describe joints that their servos cannot move; empty if there are none."""
    joints = [
        f"{joint.name!r} ({joint.friction:.3g} of {joint.effort:.3g})"
        for joint in vehicle.robot.movable_joints
        if 0.0 < joint.effort <= joint.friction
    ]
    if not joints:
        return ""
    return (
        f"the dry friction of its joint {_list_first(joints)} is more than its effort: no "
        'servo moves it. Expected less <dynamics friction="..."> in the URDF [N m or N]'
    )


def _links(
    vehicle: DynamicVehicle,
) -> Iterator[tuple[LinkSpec, float, BodyHydrodynamics | None]]:
    """Yield each link with its mass [kg] and its hydrodynamics, if it has any."""
    for link in vehicle.robot.links:
        body = vehicle.dynamics.body(link.name)
        yield link, link.mass if body is None or body.mass is None else body.mass, body


def _list_first(items: Sequence[str]) -> str:
    remainder = f" and {len(items) - 3} more" if len(items) > 3 else ""
    return f"{', '.join(items[:3])}{remainder}"


def _list(values: object) -> str:
    return " ".join(f"{value:.3g}" for value in np.asarray(values).tolist())
