"""Reading of the hydrodynamics of a scene's vehicles, and checks of the names in the scene.

All errors are reported, with their lines, before the simulation starts: unknown hydrodynamics sets,
invalid hydrodynamics files, faults of unknown thrusters, interfaces that need a vehicle with
dynamics, topics that two interfaces use for different messages, missing files of currents.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Literal, cast

from ..base.rng import stream
from ..currents import PythonFunctionSpec, SceneContext
from ..devices.fault import FaultSpec
from ..devices.fault_fields import numeric_fields
from ..errors import (
    BadSetting,
    Diagnostic,
    SceneError,
    UnknownName,
    UwsimError,
    did_you_mean,
)
from ..scene.hydrodynamics.spec import VehicleHydrodynamics
from ..scene.hydrodynamics.vehicle_file import VehicleError, read_vehicle_into, set_errors
from ..scene.hydrodynamics.vehicle_sets import find_vehicle
from ..scene.settings import HydrodynamicsLocation, locate
from ..scene.urdf.robot import RobotSpec
from ..scene.vehicle import VehicleSpec
from ..schema import NAMESPACE, Diagnostics, Spec, diagnostic_at
from ..sensors.sensor import find_message_type
from ..sensors.virtual_camera import VirtualCameraSpec
from ..topics import element_name
from ..topics.thruster_commands import AutopilotTopicSpec, ROSFinsToPATSpec
from ..world import GRAVITY
from .inertias import MAX_BUOYANCY, MIN_MASS, check_inertias
from .named_sensors import NamedSensors
from .resolved_scene import ResolvedScene
from .robots import find_file
from .water_errors import find_water_errors

Severity = Literal["error", "warning"]
U = f"{{{NAMESPACE}}}"
DYNAMICS = f"{U}dynamics"
PROFILE = f"{U}profile"
MAX_LISTED_LINKS = 8
"""The greatest number of links that one warning lists."""
MIN_BUOYANCY_CHANGE = 0.1
"""The minimum change of buoyancy in water of another density that is reported [N]."""


def read_dynamics(resolved_scene: ResolvedScene) -> dict[int, VehicleHydrodynamics]:
    """Return the hydrodynamics of every vehicle with ``u:dynamics``, by the vehicle's index.

    Raises:
        SceneError: a name is unknown or a file is invalid; the error has every mistake.
    """
    resolution = NameResolution(resolved_scene)
    if diagnostics := [
        diagnostic for diagnostic in resolution.diagnostics if diagnostic.severity == "error"
    ]:
        raise SceneError(diagnostics)
    return resolution.dynamics


def is_number_path(dynamics: VehicleHydrodynamics, path: str) -> bool:
    """Return whether a path refers to one number of a set; True if invalid (reported elsewhere)."""
    try:
        return locate(dynamics, path).is_number
    except BadSetting:
        return True


class NameResolution:
    """The hydrodynamics of the vehicles, and the errors and warnings about names in a scene.

    Args:
        resolved_scene: the scene with its robots.
        is_thorough: True: also read the files of currents completely. Python functions of currents
            are searched, but not called.
    """

    def __init__(self, resolved_scene: ResolvedScene, *, is_thorough: bool = False) -> None:
        self.dynamics: dict[int, VehicleHydrodynamics] = {}
        """The hydrodynamics of each vehicle with dynamics, by the vehicle's index."""
        self.diagnostics: list[Diagnostic] = []
        """The errors and warnings."""
        scene, robots = resolved_scene.scene, resolved_scene.robots
        self._scene, self._data_path = scene, resolved_scene.data_path
        self._sensors = NamedSensors(scene)
        for index, vehicle in enumerate(scene.vehicles):
            if vehicle.dynamics is not None and index in robots:
                self._read(index, vehicle.dynamics, robots[index])
                self._check_scale(vehicle)
            self._check_thrusters(index, vehicle)
        self.diagnostics += check_inertias(resolved_scene, self.dynamics)
        self._choose_density()
        self._check_interfaces()
        self._check_currents(is_thorough)
        self.diagnostics += find_water_errors(scene, self._data_path)

    def _read(self, index: int, name: str, robot: RobotSpec) -> None:
        named_by = Path(self._scene.path) if self._scene.path else None
        links = [link.name for link in robot.links]
        joints = [joint.name for joint in robot.joints if joint.moves]
        try:
            path = find_vehicle(name, named_by)
            diagnostics = Diagnostics(path)
            dynamics = read_vehicle_into(path, links, diagnostics, joints)
        except VehicleError as error:
            self.diagnostics += error.diagnostics
        except UnknownName as error:
            self._report(str(error), self._scene.vehicles[index], DYNAMICS)
        else:
            self.diagnostics += diagnostics.to_list()
            if dynamics is not None:
                self._check_varied_numbers(index, dynamics)
                dynamics = self._with_settings(index, dynamics)
                self.dynamics[index] = dynamics
                self._check_weight(index, name, robot)
                self._check_massless_links(index, robot)

    def _with_settings(self, index: int, dynamics: VehicleHydrodynamics) -> VehicleHydrodynamics:
        vehicle = self._scene.vehicles[index]
        for path, text in vehicle.hydrodynamics:
            dynamics = self._with_setting(index, dynamics, path, text)
        return dynamics

    def _with_setting(
        self, index: int, dynamics: VehicleHydrodynamics, path: str, text: str
    ) -> VehicleHydrodynamics:
        vehicle = self._scene.vehicles[index]
        try:
            new_dynamics = locate(dynamics, path).with_value(text)
            errors = set_errors(new_dynamics)
        except BadSetting as error:
            new_dynamics, errors = dynamics, [str(error)]
        for message in errors:
            name = f"vehicle[{vehicle.name}].hydrodynamics.{path}={text}"
            self._report(f"{name}: {message}", vehicle, DYNAMICS)
        return dynamics if errors else cast(VehicleHydrodynamics, new_dynamics)

    def _check_varied_numbers(self, index: int, dynamics: VehicleHydrodynamics) -> None:
        for variation in self._scene.vary:
            location = locate(self._scene, variation.path)
            if (
                isinstance(location, HydrodynamicsLocation)
                and location.owner is self._scene.vehicles[index]
            ):
                if not is_number_path(dynamics, location.number):
                    message = f"<u:path> {variation.path}: it is not one number of the set"
                    self._report(message, self._scene.vehicles[index], DYNAMICS)
                    continue
                for bound in variation.bounds:
                    self._with_setting(index, dynamics, location.number, repr(bound))

    def _check_weight(self, index: int, name: str, robot: RobotSpec) -> None:
        dynamics, vehicle = self.dynamics[index], self._scene.vehicles[index].name
        source = (self._scene.vehicles[index], DYNAMICS)
        masses = {body.link: body.mass for body in dynamics.bodies}
        mass = sum(masses.get(link.name) or link.mass for link in robot.links)
        water_mass = dynamics.density * sum(body.volume for body in dynamics.bodies)  # [kg]
        if not mass > 0.0:
            self._report(
                f"the vehicle {vehicle!r} has no mass: neither a link of its URDF nor a <body> of "
                f"{name!r} gives one",
                *source,
            )
        elif water_mass > MAX_BUOYANCY * mass:
            self._report(
                f"the vehicle {vehicle!r} has {mass:g} kg and displaces {water_mass:g} kg of "
                f"water; expected at most {MAX_BUOYANCY:g} times the mass, as of the lightest "
                f"foam. Check <mass> in kg and <volume> in m3 of the set {name!r}",
                *source,
            )

    def _check_massless_links(self, index: int, robot: RobotSpec) -> None:
        dynamics, vehicle = self.dynamics[index], self._scene.vehicles[index].name
        masses = {body.link: body.mass for body in dynamics.bodies}
        names = [link.name for link in robot.links if not (masses.get(link.name) or link.mass)]
        if names and len(names) < len(
            robot.links
        ):  # `_check_weight` reports a vehicle without any mass
            listed_names = names[:MAX_LISTED_LINKS]
            listed_names += ["..."] if len(names) > MAX_LISTED_LINKS else []
            self._report(
                f"{len(names)} links of the vehicle {vehicle!r} have no mass and get "
                f"{1e3 * MIN_MASS:g} g each ({', '.join(listed_names)}). "
                "Set <mass> in its URDF or its set",
                self._scene.vehicles[index],
                DYNAMICS,
                severity="warning",
            )

    def _choose_density(self) -> None:
        """Choose the density of the water: the scene's, or the common density of all sets."""
        ocean = self._scene.ocean_state
        if errors := self._profile_errors():
            for error in errors:
                self._report(f"<u:profile>: {error}", ocean, PROFILE)
            return
        density = ocean.water_density
        densities = {index: dynamics.density for index, dynamics in self.dynamics.items()}
        if density is None and len(set(densities.values())) > 1:
            message = " and ".join(
                f"{self._scene.vehicles[i].name!r} {value:g}" for i, value in densities.items()
            )
            self._report(
                f"the sets of the vehicles are for water of different density ({message} kg/m3); "
                "expected <u:density> in <oceanState>",
                self._scene.vehicles[max(densities)],
                DYNAMICS,
            )
            return
        for index, set_density in densities.items():
            if density is not None and density != set_density:
                self._change_density(index, density)

    def _profile_errors(self) -> list[str]:
        ocean = self._scene.ocean_state
        if ocean.profile is None:
            return []
        if (ocean.density, ocean.temperature, ocean.salinity) != (None, None, None):
            return ["it gives the density; expected no other density, temperature or salinity"]
        return ocean.profile.errors()

    def _change_density(self, index: int, density: float) -> None:
        dynamics = self.dynamics[index]
        self.dynamics[index] = dynamics.scale_to_density(density)
        if self._scene.ocean_state.profile is not None:
            density = self._scene.ocean_state.profile.density_at(self._depth(index))
        buoyancy_change = (
            GRAVITY * (density - dynamics.density) * sum(body.volume for body in dynamics.bodies)
        )
        name = self._scene.vehicles[index].name
        if abs(buoyancy_change) >= MIN_BUOYANCY_CHANGE:
            self._report(
                f"the water has {density:.6g} kg/m3 and the set {dynamics.name!r} of {name!r} is "
                f"trimmed for {dynamics.density:.6g}: the vehicle is {abs(buoyancy_change):.3g} N "
                f"{'lighter' if buoyancy_change > 0.0 else 'heavier'} than in its set",
                self._scene.vehicles[index],
                DYNAMICS,
                severity="warning",
            )

    def _depth(self, index: int) -> float:
        """Compute the depth of a vehicle at the start [m]."""
        vehicle = self._scene.vehicles[index]
        position = (self._scene.world_from_localized @ vehicle.localized_from_base).position
        return self._scene.ocean_state.ocean_surface_height - float(position[2])

    def _check_scale(self, vehicle: VehicleSpec) -> None:
        if vehicle.scale_factor != (1.0, 1.0, 1.0):
            x, y, z = vehicle.scale_factor
            self._report(
                f"the vehicle {vehicle.name!r} has <u:dynamics> and a <scaleFactor> "
                f"of {x:g} {y:g} {z:g}; expected 1 1 1. Its weight and drag are from the files; "
                "change its URDF and its hydrodynamics file instead",
                vehicle,
                "scaleFactor",
            )

    def _check_thrusters(self, index: int, vehicle: VehicleSpec) -> None:
        for fault in vehicle.parts_of(FaultSpec):
            for error in fault.errors(vehicle.sensor_names):
                self._report(error, fault)
            if fault.thruster is None:
                if message := self._field_error(fault, vehicle):
                    self._report(message, fault)
                continue
            if vehicle.dynamics is None:
                self._report(
                    f"the vehicle {vehicle.name!r} has no <u:dynamics>: no thruster of it can fail",
                    fault,
                )
            elif index in self.dynamics:
                names = [thruster.name for thruster in self.dynamics[index].thrusters]
                if fault.thruster not in names:
                    self._report(str(UnknownName("thruster", fault.thruster, names)), fault)

    def _field_error(self, fault: FaultSpec, vehicle: VehicleSpec) -> str | None:
        sensors = [part for _, part in vehicle.all_parts() if _name(part) == fault.sensor]
        types = {find_message_type(type(part)) for part in sensors} - {None}
        for interface in self._scene.ros_interfaces:
            if fault.sensor in (_name(interface), getattr(interface, "camera_name", None)):
                types |= set(self._sensors.message_types(interface).values())
        messages = [message_type() for message_type in types if message_type is not None]
        fields = [path for message in messages for path in numeric_fields(message)]
        if fault.field is None or not sensors or fault.field in fields:
            return None
        return str(UnknownName("field of numbers", fault.field, sorted(fields)))

    def _autopilot_error(
        self, interface: AutopilotTopicSpec, vehicles: Mapping[str, VehicleSpec]
    ) -> str | None:
        vehicle = vehicles.get(interface.vehicle_name)
        if vehicle is None:
            suggestion = did_you_mean(interface.vehicle_name, vehicles)
            return f"no vehicle is called {interface.vehicle_name!r}.{suggestion}"
        if vehicle.dynamics is None:
            return (
                f"the vehicle {vehicle.name!r} has no <u:dynamics>; it accepts "
                "no commands of thrusters or fins, and no wrenches"
            )
        dynamics = self.dynamics.get(self._scene.vehicles.index(vehicle))
        if isinstance(interface, ROSFinsToPATSpec) and dynamics is not None and not dynamics.fins:
            return f"the hydrodynamics file of the vehicle {vehicle.name!r} has no <fin>"
        return None

    def _check_interfaces(self) -> None:
        vehicles = {vehicle.name: vehicle for vehicle in reversed(self._scene.vehicles)}
        cameras = {
            spec.name
            for owner in self._scene.vehicles
            for spec in owner.parts_of(VirtualCameraSpec)
        }
        topics: dict[str, tuple[type, str]] = {}
        for interface in self._scene.ros_interfaces:
            element = element_name(interface).replace(U, "u:")
            if isinstance(interface, AutopilotTopicSpec) and (
                error := self._autopilot_error(interface, vehicles)
            ):
                self._report(f"<{element}>: {error}", interface)
            vehicle_name = getattr(interface, "vehicle_name", None)
            camera_name = getattr(interface, "camera_name", None)
            if vehicle_name not in (None, *vehicles) or camera_name not in (None, *cameras):
                continue  # ignored, as in the original UWSim
            if error := self._sensors.error(interface):
                self._report(f"<{element}>: {error}", interface)
            for field, message in self._sensors.message_types(interface).items():
                topic = str(getattr(interface, field))
                other, other_element = topics.setdefault(topic.strip("/"), (message, element))
                if other is not message:
                    self._report(
                        f"<{element}>: the topic {topic!r} carries {_type_name(message)}, but "
                        f"{_type_name(other)} of <{other_element}>",
                        interface,
                    )

    def _check_currents(self, is_thorough: bool) -> None:
        context = SceneContext(
            stream=lambda name: stream(0, name),
            find=lambda name: find_file(name, self._scene.path, self._data_path),
        )
        for current in self._scene.ocean_state.currents:
            try:
                current.files(context)
                if is_thorough and isinstance(current, PythonFunctionSpec):
                    current.look_up()
                elif is_thorough:
                    current.bind(context)
            except UwsimError as error:
                self._report(str(error), current)

    def _report(
        self, message: str, spec: Spec, element: str = "", severity: Severity = "error"
    ) -> None:
        file = self._scene.path
        self.diagnostics.append(diagnostic_at(spec, message, element, file=file, severity=severity))


def _name(part: object) -> str | None:
    return getattr(part, "name", None)


def _type_name(message: type) -> str:
    return str(getattr(message, "__msgtype__", message.__name__))
