"""Looks up the hydrodynamics of a scene's vehicles and every name that belongs to it.

Names are looked up before anything is simulated, and all errors are reported with their lines:
sets, hydrodynamics files, thrusters that fail, interfaces that want a simulated vehicle, topics
that two interfaces use for different messages, files of currents.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Literal, cast

from ..base.rng import stream
from ..currents import Place, PythonFunctionSpec
from ..devices.fault import FaultSpec
from ..devices.fault_fields import numeric_fields
from ..errors import BadSetting, Diagnostic, SceneError, UnknownName, UwsimError, did_you_mean
from ..scene.hydrodynamics.spec import VehicleHydrodynamics
from ..scene.hydrodynamics.vehicle_file import VehicleError, read_vehicle_into, set_errors
from ..scene.hydrodynamics.vehicle_sets import find_vehicle
from ..scene.settings import HydrodynamicsPlace, locate
from ..scene.urdf.robot import RobotSpec
from ..scene.vehicle import VehicleSpec
from ..schema import NAMESPACE, Diagnostics, Spec, diagnostic_at
from ..sensors.sensor import measured_by
from ..sensors.virtual_camera import VirtualCameraSpec
from ..topics import element_of
from ..topics.thruster_commands import AutopilotTopicSpec, ROSFinsToPATSpec
from ..world import GRAVITY
from .inertias import MAX_BUOYANCY, MIN_MASS, inertias_refused
from .named_sensors import NamedSensors
from .resolved_scene import ResolvedScene
from .robots import find_file

Severity = Literal["error", "warning"]
U = f"{{{NAMESPACE}}}"
DYNAMICS = f"{U}dynamics"
PROFILE = f"{U}profile"
MAX_NAMED = 8
"""Links that one warning names."""
MIN_LIFT = 0.1
"""Smallest change of buoyancy by another density that is reported [N]."""


def read_dynamics(resolved: ResolvedScene) -> dict[int, VehicleHydrodynamics]:
    """Read the hydrodynamics of every vehicle that has ``u:dynamics``, by its number.

    Raises:
        SceneError: a name leads nowhere or a file is wrong; with every error.
    """
    search = Search(resolved)
    if diagnostics := [diagnostic for diagnostic in search.found if diagnostic.severity == "error"]:
        raise SceneError(diagnostics)
    return search.dynamics


def locate_number(dynamics: VehicleHydrodynamics, path: str) -> bool:
    """Whether a path leads to one number of a set, or nowhere, which is reported elsewhere."""
    try:
        return locate(dynamics, path).is_number
    except BadSetting:
        return True


class Search:
    """Resolves the names, and collects what they refer to and those that are unknown.

    Args:
        resolved: the scene, with the robot of each vehicle that has one.
        is_thorough: read currents whole; the user's own functions are not run.
    """

    def __init__(self, resolved: ResolvedScene, *, is_thorough: bool = False) -> None:
        self.dynamics: dict[int, VehicleHydrodynamics] = {}
        """Of each vehicle that is simulated, by its number."""
        self.found: list[Diagnostic] = []
        """All that is wrong or worth knowing."""
        scene, robots = resolved.scene, resolved.robots
        self._scene, self._data_path = scene, resolved.data_path
        self._sensors = NamedSensors(scene)
        for index, vehicle in enumerate(scene.vehicles):
            if vehicle.dynamics is not None and index in robots:
                self._read(index, vehicle.dynamics, robots[index])
                self._refuse_scale(vehicle)
            self._follow_thrusters(index, vehicle)
        self.found += inertias_refused(resolved, self.dynamics)
        self._settle_density()
        self._follow_interfaces()
        self._follow_currents(is_thorough)

    def _read(self, index: int, name: str, robot: RobotSpec) -> None:
        named_by = Path(self._scene.path) if self._scene.path else None
        links = [link.name for link in robot.links]
        joints = [joint.name for joint in robot.joints if joint.moves]
        try:
            path = find_vehicle(name, named_by)
            diagnostics = Diagnostics(path)
            dynamics = read_vehicle_into(path, links, diagnostics, joints)
        except VehicleError as error:
            self.found += error.diagnostics
        except UnknownName as error:
            self._say(str(error), self._scene.vehicles[index], DYNAMICS)
        else:
            self.found += diagnostics.to_list()
            if dynamics is not None:
                self._check_varied(index, dynamics)
                dynamics = self._with_settings(index, dynamics)
                self.dynamics[index] = dynamics
                self._weigh(index, name, robot)
                self._name_massless(index, robot)

    def _with_settings(self, index: int, dynamics: VehicleHydrodynamics) -> VehicleHydrodynamics:
        """Apply what ``--set`` and ``u:vary`` change in a set; errors are reported."""
        vehicle = self._scene.vehicles[index]
        for path, text in vehicle.hydrodynamics:
            dynamics = self._with_setting(index, dynamics, path, text)
        return dynamics

    def _with_setting(
        self, index: int, dynamics: VehicleHydrodynamics, path: str, text: str
    ) -> VehicleHydrodynamics:
        vehicle = self._scene.vehicles[index]
        try:
            changed = locate(dynamics, path).with_value(text)
            errors = set_errors(changed)
        except BadSetting as error:
            changed, errors = dynamics, [str(error)]
        for message in errors:
            name = f"vehicle[{vehicle.name}].hydrodynamics.{path}={text}"
            self._say(f"{name}: {message}", vehicle, DYNAMICS)
        return dynamics if errors else cast(VehicleHydrodynamics, changed)

    def _check_varied(self, index: int, dynamics: VehicleHydrodynamics) -> None:
        """Report what is wrong with a set in which a varied number is at a bound."""
        for variation in self._scene.vary:
            place = locate(self._scene, variation.path)
            if isinstance(place, HydrodynamicsPlace) and place.leaf is self._scene.vehicles[index]:
                if not locate_number(dynamics, place.number):
                    message = f"<u:path> {variation.path}: it is not one number of the set"
                    self._say(message, self._scene.vehicles[index], DYNAMICS)
                    continue
                for bound in variation.bounds:
                    self._with_setting(index, dynamics, place.number, repr(bound))

    def _weigh(self, index: int, name: str, robot: RobotSpec) -> None:
        """Compare a vehicle's weight with its displacement."""
        dynamics, vehicle = self.dynamics[index], self._scene.vehicles[index].name
        place = (self._scene.vehicles[index], DYNAMICS)
        given = {body.link: body.mass for body in dynamics.bodies}
        mass = sum(given.get(link.name) or link.mass for link in robot.links)
        displaced = dynamics.density * sum(body.volume for body in dynamics.bodies)
        message = (
            f"the vehicle {vehicle!r} has {mass:g} kg and displaces {displaced:g} kg of water; "
            f"expected nearly the same (<mass> in kg and <volume> in m3 of the set {name!r})"
        )
        if not mass > 0.0:
            self._say(
                f"the vehicle {vehicle!r} has no mass: neither a link of its URDF nor a <body> of "
                f"{name!r} gives one",
                *place,
            )
        elif displaced > MAX_BUOYANCY * mass:
            self._say(
                f"{message}; {MAX_BUOYANCY:g} times the mass is lighter than any foam", *place
            )

    def _name_massless(self, index: int, robot: RobotSpec) -> None:
        """Warn of links without a mass, which get the engine's minimum."""
        dynamics, vehicle = self.dynamics[index], self._scene.vehicles[index].name
        given = {body.link: body.mass for body in dynamics.bodies}
        names = [one.name for one in robot.links if not (given.get(one.name) or one.mass)]
        if names and len(names) < len(robot.links):  # of one without any mass all is said
            shown = ", ".join(names[:MAX_NAMED]) + (", ..." if len(names) > MAX_NAMED else "")
            self._say(
                f"{len(names)} links of the vehicle {vehicle!r} have no mass and are given "
                f"{1e3 * MIN_MASS:g} g each ({shown}); a <mass> in its URDF or its set says more",
                self._scene.vehicles[index],
                DYNAMICS,
                severity="warning",
            )

    def _settle_density(self) -> None:
        """Choose one density of water: the scene's, or that on which all sets agree."""
        ocean = self._scene.ocean_state
        if wrong := self._profile_errors():
            for said in wrong:
                self._say(f"<u:profile>: {said}", ocean, PROFILE)
            return
        density = ocean.water_density
        given = {index: one.density for index, one in self.dynamics.items()}
        if density is None and len(set(given.values())) > 1:
            message = " and ".join(
                f"{self._scene.vehicles[i].name!r} {value:g}" for i, value in given.items()
            )
            self._say(
                f"the sets of the vehicles are for water of different density ({message} kg/m3); "
                "expected <u:density> in <oceanState>, which says what the water has",
                self._scene.vehicles[max(given)],
                DYNAMICS,
            )
            return
        for index, own in given.items():
            if density is not None and density != own:
                self._trim(index, density)

    def _profile_errors(self) -> list[str]:
        ocean = self._scene.ocean_state
        if ocean.profile is None:
            return []
        if (ocean.density, ocean.temperature, ocean.salinity) != (None, None, None):
            return ["it gives the density; expected no other density, temperature or salinity"]
        return ocean.profile.errors()

    def _trim(self, index: int, density: float) -> None:
        """Change a vehicle's set to another density of water, and report the effect."""
        before = self.dynamics[index]
        self.dynamics[index] = before.in_water(density)
        if self._scene.ocean_state.profile is not None:
            density = self._scene.ocean_state.profile.density_at(self._depth(index))
        lift = GRAVITY * (density - before.density) * sum(body.volume for body in before.bodies)
        name = self._scene.vehicles[index].name
        if abs(lift) >= MIN_LIFT:
            self._say(
                f"the water has {density:.6g} kg/m3 and the set {before.name!r} of {name!r} was "
                f"trimmed in {before.density:.6g}: it is {abs(lift):.3g} N "
                f"{'lighter' if lift > 0.0 else 'heavier'} here than there",
                self._scene.vehicles[index],
                DYNAMICS,
                severity="warning",
            )

    def _depth(self, index: int) -> float:
        """How deep a vehicle begins [m]."""
        vehicle = self._scene.vehicles[index]
        place = (self._scene.world_from_localized @ vehicle.localized_from_base).position
        return self._scene.ocean_state.ocean_surface_height - float(place[2])

    def _refuse_scale(self, vehicle: VehicleSpec) -> None:
        """Masses, volumes and thrusts are those of the size that the files give."""
        if vehicle.scale_factor != (1.0, 1.0, 1.0):
            x, y, z = vehicle.scale_factor
            self._say(
                f"the vehicle {vehicle.name!r} is simulated (<u:dynamics>) and has a <scaleFactor> "
                f"of {x:g} {y:g} {z:g}; expected 1 1 1: what a scaled vehicle weighs and resists "
                "nobody has said. Change its URDF and its hydrodynamics file instead",
                vehicle,
                "scaleFactor",
            )

    def _follow_thrusters(self, index: int, vehicle: VehicleSpec) -> None:
        for fault in vehicle.parts_of(FaultSpec):
            for error in fault.errors(vehicle.sensor_names):
                self._say(error, fault)
            if fault.thruster is None:
                if said := self._no_field(fault, vehicle):
                    self._say(said, fault)
                continue
            if vehicle.dynamics is None:
                self._say(
                    f"the vehicle {vehicle.name!r} has no <u:dynamics>: no thruster of it can fail",
                    fault,
                )
            elif index in self.dynamics:
                names = [thruster.name for thruster in self.dynamics[index].thrusters]
                if fault.thruster not in names:
                    self._say(str(UnknownName("thruster", fault.thruster, names)), fault)

    def _no_field(self, fault: FaultSpec, vehicle: VehicleSpec) -> str | None:
        """Report a field that no message of the sensor of a fault has."""
        named = [part for _, part in vehicle.all_parts() if _name(part) == fault.sensor]
        types = {measured_by(type(part)) for part in named} - {None}
        for interface in self._scene.ros_interfaces:
            if fault.sensor in (_name(interface), getattr(interface, "camera_name", None)):
                types |= set(self._sensors.carried(interface).values())
        known = [path for each in types if each is not None for path in numeric_fields(each())]
        if fault.field is None or not named or fault.field in known:
            return None
        return str(UnknownName("field of numbers", fault.field, sorted(known)))

    def _no_autopilot(
        self, interface: AutopilotTopicSpec, vehicles: Mapping[str, VehicleSpec]
    ) -> str | None:
        """Report why an interface has no autopilot to command."""
        wanted = vehicles.get(interface.vehicle_name)
        if wanted is None:
            near = did_you_mean(interface.vehicle_name, vehicles)
            return f"no vehicle is called {interface.vehicle_name!r}.{near}"
        if wanted.dynamics is None:
            return (
                f"the vehicle {wanted.name!r} has no <u:dynamics>; it takes "
                "no commands of thrusters or fins, and no wrenches"
            )
        found = self.dynamics.get(self._scene.vehicles.index(wanted))
        if isinstance(interface, ROSFinsToPATSpec) and found is not None and not found.fins:
            return f"the hydrodynamics file of the vehicle {wanted.name!r} has no <fin>"
        return None

    def _follow_interfaces(self) -> None:
        vehicles = {vehicle.name: vehicle for vehicle in reversed(self._scene.vehicles)}
        cameras = {
            spec.name for one in self._scene.vehicles for spec in one.parts_of(VirtualCameraSpec)
        }
        topics: dict[str, tuple[type, str]] = {}
        for interface in self._scene.ros_interfaces:
            element = element_of(interface).replace(U, "u:")
            if isinstance(interface, AutopilotTopicSpec) and (
                said := self._no_autopilot(interface, vehicles)
            ):
                self._say(f"<{element}>: {said}", interface)
            named = (
                getattr(interface, "vehicle_name", None),
                getattr(interface, "camera_name", None),
            )
            if named[0] not in (None, *vehicles) or named[1] not in (None, *cameras):
                continue  # left out, as in the original
            if said := self._sensors.error(interface):
                self._say(f"<{element}>: {said}", interface)
            for field, message in self._sensors.carried(interface).items():
                topic = str(getattr(interface, field))
                other, first = topics.setdefault(topic.strip("/"), (message, element))
                if other is not message:
                    self._say(
                        f"<{element}>: the topic {topic!r} carries {_type_name(message)}, but of "
                        f"<{first}> it carries {_type_name(other)}",
                        interface,
                    )

    def _follow_currents(self, is_thorough: bool) -> None:
        place = Place(
            stream=lambda name: stream(0, name),
            find=lambda name: find_file(name, self._scene.path, self._data_path),
        )
        for current in self._scene.ocean_state.currents:
            try:
                current.files(place)
                if is_thorough and isinstance(current, PythonFunctionSpec):
                    current.look_up()
                elif is_thorough:
                    current.bind(place)
            except UwsimError as error:
                self._say(str(error), current)

    def _say(
        self, message: str, spec: Spec, element: str = "", severity: Severity = "error"
    ) -> None:
        """Keep an error of an ``element`` in a spec, or of the spec."""
        file = self._scene.path
        self.found.append(diagnostic_at(spec, message, element, file=file, severity=severity))


def _name(part: object) -> str | None:
    return getattr(part, "name", None)


def _type_name(message: type) -> str:
    """``std_msgs/msg/Bool``."""
    return str(getattr(message, "__msgtype__", message.__name__))
