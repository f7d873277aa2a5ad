"""Warnings about a vehicle's numbers: likely mistakes of units, signs and powers of ten.

Nothing here is wrong for certain: a lander sinks, a spar buoy is 60 m long. What a vehicle's
``<u:accept>`` names is not asked.
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
from ...physics.actuation.allocation import curve, thrusters_on_base
from ...scene.accepted_warnings import VehicleWarning, unless_meant
from ...scene.hydrodynamics.spec import BodyHydrodynamics, VehicleHydrodynamics, matrix
from ...scene.urdf.kinematics import link_poses
from ...scene.urdf.robot import LinkSpec, RobotSpec
from ...scene.vehicle import VehicleSpec
from ...world import TIMESTEP
from ..subjects import CheckedScene

UNEVEN = 0.1
"""Difference between mass and displaced water, as a share of the greater, that is reported."""
ROOM = 2.0
"""So many times the volume of its boxes nothing displaces [1]."""
HOLLOW = 0.005
"""A share of the volume of its boxes that is too little for a hull [1]."""
LOW = 1e-3
"""Height of the centre of buoyancy under the centre of mass [m]."""
MAX_SIZE, MIN_SIZE = 50.0, 0.05
"""Of a vehicle [m]."""
OFF = 0.5
"""How far off its hull a part of a vehicle lies, as a share of its length."""
MAX_ACCELERATION = 50.0
"""Acceleration by one thruster [m/s2]."""
SPEED = 1.0
"""At which quadratic drag is looked at [m/s]."""
GYRATION = (0.03, 2.0)
"""Radius of gyration as a share of the link's length: least and greatest."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Candidate:
    """A vehicle that is simulated, with all that is known about it."""

    vehicle: VehicleSpec
    """It, in its scene."""
    robot: RobotSpec
    """Its links."""
    dynamics: VehicleHydrodynamics
    """What the water does to them."""
    balance: Balance
    """Its weight and buoyancy."""
    up: Array
    """The upward direction in its base as it begins, (3,)."""
    hull: Hull | None
    """How large it is; None without a shape."""

    @property
    def height(self) -> float:
        """Of its centre of buoyancy over its centre of mass as it begins [m]."""
        return dot(self.balance.centre_of_buoyancy - self.balance.centre_of_mass, self.up)


def size_said(hull: Hull, robot: RobotSpec) -> str:
    """Warn of a vehicle as large as a ship, or smaller than a hand."""
    if MIN_SIZE <= hull.size <= MAX_SIZE:
        return ""
    link, box = max(hull.links.items(), key=lambda each: float(each[1].extent.max()))
    spec = robot.link(link)
    solids = () if spec is None else spec.solids
    file = next((shape.file for shape in solids if shape.file), "")
    named = f"{link!r} ({file})" if file else repr(link)
    return (
        f"it is {hull.size:.4g} m long, its link {named} {box.extent.max():.4g} m; expected "
        f'{MIN_SIZE:g} to {MAX_SIZE:g} m (a mesh in millimetres needs scale="0.001 0.001 0.001" in '
        "the URDF)"
    )


VehicleCheck = Callable[[Candidate], str]
"""Describes what is unlikely about a simulated vehicle; empty if nothing."""


def vehicle_numbers(
    scene: CheckedScene,
    of_hull: Mapping[VehicleWarning, Callable[[Hull, RobotSpec], str]],
    of_simulated: Mapping[VehicleWarning, VehicleCheck],
) -> Iterator[Diagnostic]:
    """Apply checks, by the name of their warning, to one vehicle after another."""
    for index in scene.checked_vehicles:
        vehicle, robot = scene.spec.vehicles[index], scene.robots[index]
        hull = None
        with suppress(UwsimError):  # reported where models are checked
            hull = hull_of(scene.resolved, index)
        texts: list[tuple[VehicleWarning, str, str]] = []
        if hull is not None:
            texts += [(name, "file", check(hull, robot)) for name, check in of_hull.items()]
        if index in scene.dynamics:
            dynamics, pose = scene.dynamics[index], vehicle.localized_from_base
            one = Candidate(
                vehicle=vehicle,
                robot=robot,
                dynamics=dynamics,
                balance=balance_of(robot, dynamics, vehicle.joint_values),
                up=(scene.spec.world_from_localized @ pose).rotation[2],
                hull=hull,
            )
            texts += [(name, DYNAMICS, check(one)) for name, check in of_simulated.items()]
        for warning, element, text in texts:
            if text and warning not in vehicle.accepts:
                message = f"the vehicle {vehicle.name!r}: {text}. {unless_meant(warning)}"
                yield scene.warning(vehicle, message, element)


def buoyancy_said(one: Candidate) -> str:
    """Compare a vehicle's weight with its displacement, and that with its shape."""
    mass, displaced = one.balance.mass, one.balance.displaced_mass
    messages = []
    if abs(displaced - mass) > UNEVEN * max(displaced, mass):
        way = "sinks" if mass > displaced else "rises"
        messages.append(
            f"it has {mass:.6g} kg and displaces {displaced:.6g} kg of water: it {way} with "
            f"{abs(one.balance.buoyancy):.3g} N; expected nearly the same (<mass> in kg and "
            f"<volume> in m3 of the set {one.dynamics.name!r})"
        )
    volume = displaced / one.dynamics.density
    if one.hull is not None and not HOLLOW * one.hull.volume <= volume <= ROOM * one.hull.volume:
        messages.append(
            f"it displaces {volume:.3g} m3 and the boxes around its links hold "
            f"{one.hull.volume:.3g} m3; expected {HOLLOW:g} to {ROOM:g} times that"
        )
    return "; ".join(messages)


def balance_said(one: Candidate) -> str:
    """Warn of a vehicle without static stability."""
    if one.height > -LOW or not one.balance.displaced_mass > 0.0:
        return ""
    return (
        f"its centre of buoyancy lies {-one.height:.3g} m below its centre of mass as it begins: "
        "it turns over; expected above (or it begins upside down: a vehicle whose z points up, in "
        "a file whose z points down, has the roll M_PI)"
    )


def places_said(one: Candidate) -> str:
    """Warn of thrusters, fins and centres that lie far off the hull."""
    if one.hull is None:
        return ""
    thrusters = thrusters_on_base(one.robot, one.dynamics.thrusters, one.vehicle.joint_values)
    places = [(f"thruster {each.name!r}", np.array(each.position)) for each in thrusters]
    links = link_poses(one.robot, one.vehicle.joint_values)
    places += [
        (f"fin {fin.name!r}", links[fin.link].transform(np.array([fin.position]))[0])
        for fin in one.dynamics.fins
    ]
    places.append(("centre of mass", one.balance.centre_of_mass))
    places.append(("centre of buoyancy", one.balance.centre_of_buoyancy))
    size = one.hull.size
    far = [
        f"its {name} {distance:.3g} m"
        for name, place in places
        if (distance := one.hull.distance(place)) > OFF * size
    ]
    if not far:
        return ""
    return (
        f"far off its hull, which is {size:.3g} m long, lies {_shortened(far)}; expected "
        "on it (<position> is in metres, in the frame of the link)"
    )


def strength_said(one: Candidate) -> str:
    """Warn of thrusters that are too strong for the vehicle."""
    strong = []
    for thruster in one.dynamics.thrusters:
        thrusts, _ = curve(thruster)
        greatest = float(max(-thrusts[0], thrusts[-1]))
        if thruster.saturation is not None:
            greatest = min(greatest, max(map(abs, thruster.saturation)))
        if greatest > MAX_ACCELERATION * one.balance.mass:
            strong.append(f"{thruster.name!r} gives {greatest:.3g} N")
    if not strong:
        return ""
    return (
        f"its thruster {strong[0]} for {one.balance.mass:.4g} kg; expected less than "
        f"{MAX_ACCELERATION:g} m/s2 (<forward> and <backward> in N)"
    )


def inertia_said(one: Candidate) -> str:
    """Warn of links whose inertia does not fit their mass and size."""
    messages = []
    for link, mass, body in _links(one):
        box = None if one.hull is None else one.hull.links.get(link.name)
        if mass <= 0.0 or box is None:
            continue
        given = link.inertia if body is None or body.inertia is None else body.inertia
        moments = given[:3]
        is_said = min(moments) > 0.0
        used = max(moments) if is_said else MIN_INERTIA
        edges = np.sort(box.extent)
        least, greatest = (share * edges[2] for share in GYRATION)
        if least <= math.sqrt(used / mass) <= greatest and min(moments) >= 0.0:
            continue
        usual = mass / 12.0 * float(edges[1] ** 2 + edges[2] ** 2)  # the greatest of its box
        messages.append(
            f"its link {link.name!r} has {mass:.4g} kg and the inertia {_list(moments)}"
            + ("" if is_said else f" (it is simulated with {MIN_INERTIA:g})")
            + f"; a box of its size, {_list(box.extent)} m, has {usual:.2g} kg m2 at most"
        )
    return "; ".join(messages[:3])


def drag_said(one: Candidate) -> str:
    """Warn of links that are too light for their drag."""
    messages = []
    moving = {joint.child for joint in one.robot.joints if joint.moves} | {one.robot.root}
    for link, mass, body in _links(one):
        if body is None or link.name not in moving:
            continue
        drag = np.diag(matrix(body.linear_damping) + SPEED * matrix(body.quadratic_damping))[:3]
        if not drag.any():
            continue
        added = np.diag(matrix(body.added_mass))[:3]
        steps = float((TIMESTEP * drag / np.maximum(mass + added, 1e-9)).max())
        if mass <= 0.0:
            messages.append(f"its link {link.name!r} has drag and no mass")
        elif steps > 1.0 and body.implicitness < 1.0:
            messages.append(
                f"its link {link.name!r} has {mass:.3g} kg and a drag of {drag.max():.3g} N at 1 "
                "m/s, which stops it within a step; expected <implicitness> 1, or less drag"
            )
    return "; ".join(messages[:3])


def friction_said(one: Candidate) -> str:
    """Warn of joints that their servos cannot move."""
    held = [
        f"{joint.name!r} ({joint.friction:.3g} of {joint.effort:.3g})"
        for joint in one.robot.movable
        if 0.0 < joint.effort <= joint.friction
    ]
    if not held:
        return ""
    return (
        f"the dry friction of its joint {_shortened(held)} is more than its effort: no "
        'servo moves it; expected less (<dynamics friction="..."> of the URDF, N m or N)'
    )


def _links(one: Candidate) -> Iterator[tuple[LinkSpec, float, BodyHydrodynamics | None]]:
    for link in one.robot.links:
        body = one.dynamics.body(link.name)
        yield link, link.mass if body is None or body.mass is None else body.mass, body


def _shortened(items: Sequence[str]) -> str:
    """Return the first three of a list in words, and how many more there are."""
    more = f" and {len(items) - 3} more" if len(items) > 3 else ""
    return f"{', '.join(items[:3])}{more}"


def _list(values: object) -> str:
    return " ".join(f"{value:.3g}" for value in np.asarray(values).tolist())
