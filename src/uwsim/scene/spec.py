"""What a scene file says: water, simulation, viewer, vehicles, objects.

.. code-block:: xml

    <UWSimScene>
      <oceanState> <fog> <density>0.1</density> ... </fog> </oceanState>
      <simParams> <offsetr> <x>M_PI</x> <y>0</y> <z>-M_PI_2</z> </offsetr> </simParams>
      <vehicle> <name>girona500</name> <file>data/scenes/g500ARM5.urdf</file> ... </vehicle>
      <object> <name>blackbox</name> <file>objects/blackbox_uib_trimesh.osg</file> ... </object>
      <rosInterfaces> ... </rosInterfaces>
    </UWSimScene>

The fields stand in the order of the original grammar. Positions and angles keep the numbers and
the frame of the file, L; the properties that return a `Pose` know which of UWSim's two Euler
orders holds where. Where the original leaves a value uninitialised, the default is that of its
own macro library.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, get_args

from ..currents import CURRENTS, CurrentSpec
from ..devices.comms import AcousticCommsChannelSpec, CustomCommsChannelSpec
from ..errors import BadSetting
from ..geometry import Pose, rotation_from_xyz
from ..linear import product
from ..schema import MAX_DISTANCE, NAMESPACE, REQUIRED, Original, element
from ..topics import INTERFACES, InterfaceSpec
from .doubts import ObjectDoubt
from .on_floor import OnFloorSpec
from .seawater import sea_water_density
from .variation import DISTRIBUTIONS, VariationSpec
from .vehicle import VehicleSpec

Triple = tuple[float, float, float]

ZERO: Triple = (0.0, 0.0, 0.0)
ONE: Triple = (1.0, 1.0, 1.0)
NIGHT_BLUE: Triple = (0.0, 0.05, 0.3)
TERRAIN = "terrain"
"""An object of this name is the ground: nothing picks it up, and without ``<physics>`` it is
fixed, and solid for simulated vehicles."""
MILD = 15.0
"""Temperature of water of which only the salinity is said [degrees Celsius]."""
Integrator = Literal["implicitfast", "RK4"]


@dataclass(frozen=True, kw_only=True)
class FogSpec:
    """A ``<fog>``: how visibility falls with distance."""

    density: float = element(default=0.1, original=REQUIRED, minimum=0, maximum=1e6)
    """At a distance d the share ``1 - exp(-(density d)^2)`` of what is there is lost [1/m]."""
    color: Triple = element(default=NIGHT_BLUE, parts="rgb", original=REQUIRED)
    """What replaces what cannot be seen [0..1]."""


@dataclass(frozen=True, kw_only=True)
class OceanStateSpec:
    """An ``<oceanState>``: the surface and the water."""

    windx: float = 0.04
    """Wind along x; not normalised, its length scales the waves [1]."""
    windy: float = 0.04
    """Wind along y; not normalised, its length scales the waves [1]."""
    wind_speed: float = 12.0
    """Wind speed of the wave spectrum [m/s]."""
    depth: float = 1000.0
    """Depth of the water, for the speed of waves only: it is no floor [m]."""
    reflection_damping: float = 0.35
    """Factor on waves that run against the wind [1]."""
    wave_scale: float = 1e-7
    """Amplitude of the wave spectrum [1]."""
    is_not_choppy: bool = element(default=False, original=Original(invalid=True))
    """Whether waves move points only up and down."""
    choppy_factor: float = 2.5
    """How far waves move points sideways [1]."""
    crest_foam_height: float = 2.2
    """Height from which crests foam; read and not used, as in the original [m]."""
    ocean_surface_height: float = element(default=0.0, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """Height of the water surface in the world, z up [m]."""
    fog: FogSpec = element(default=FogSpec())
    """How visibility falls with distance."""
    color: Triple = element(default=NIGHT_BLUE, parts="rgb")
    """Light scattered into the view by the water [0..1]."""
    attenuation: Triple = element(
        default=(0.015, 0.0075, 0.005), parts="rgb", minimum=0, maximum=1e6
    )
    """Loss of red, green and blue light on its way [1/m]."""
    density: float | None = element(namespaced=True, default=None, minimum=100.0, maximum=20000.0)
    """Of the water that vehicles and things float in [kg/m3]; when absent that of temperature and
    salinity, and without these the density that the vehicles' sets are given for."""
    temperature: float | None = element(namespaced=True, default=None, minimum=-2.0, maximum=40.0)
    """Of the water, for its density by EOS-80 [degrees Celsius]; 15 where only salinity is said."""
    salinity: float | None = element(namespaced=True, default=None, minimum=0.0, maximum=42.0)
    """Of the water, for its density [g/kg]; 0 where only the temperature is said, 35 in the sea."""
    currents: tuple[CurrentSpec, ...] = element(
        "current", namespaced=True, default=(),
        choice={f"{{{NAMESPACE}}}{name}": spec for name, spec in CURRENTS.items()},
    )  # fmt: skip
    """How the water moves; several add up."""

    @property
    def water_density(self) -> float | None:
        """What the file says of the density [kg/m3]; None if nothing."""
        if self.density is not None:
            return self.density
        if self.temperature is None and self.salinity is None:
            return None
        warmth = MILD if self.temperature is None else self.temperature
        return sea_water_density(warmth, self.salinity or 0.0)


@dataclass(frozen=True, kw_only=True)
class ShowTrajectorySpec:
    """A ``<showTrajectory>``: the viewer draws where something went."""

    target: str
    """Route of the node to follow."""
    color: Triple = element(default=(1.0, 0.0, 0.0), parts="rgb")
    """Of the line [0..1]."""
    line_style: int = 1
    """1 solid, 2 to 4 dashed."""
    time_window: float = -1.0
    """How long points stay; not above 0: for ever [s]."""


@dataclass(frozen=True, kw_only=True)
class SimParamsSpec:
    """A ``<simParams>``: frames, window, physics, light."""

    disable_shaders: bool = False
    """Whether water and sky are drawn without effects."""
    resw: int = element(default=800, minimum=1)
    """Width of the window [px]."""
    resh: int = element(default=600, minimum=1)
    """Height of the window [px]."""
    offsetp: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """Origin of the file's frame in the world [m]."""
    offsetr: Triple = ZERO
    """Turn of the file's frame in the world, about x, y, z: Rx Ry Rz [rad]."""
    enable_physics: bool = False
    """Whether contacts and gravity act on objects."""
    gravity: Triple = ZERO
    """In the world; all zero stands for (0, 0, -1) [m/s2]."""
    physics_frequency: float = element(default=60.0, above=0)
    """Steps of the original's physics [Hz]."""
    physics_sub_steps: int = 0
    """Most steps per frame; 0 is automatic."""
    physics_solver: str = "Dantzig"
    """Dantzig, SolveProjectedGauss or SequentialImpulse."""
    show_trajectory: tuple[ShowTrajectorySpec, ...] = ()
    """Trails to draw in the viewer."""
    light_rate: float = element(default=1.0, minimum=0, maximum=1e6)
    """Factor on the light of the scene [1]."""
    sun_shadow: bool | None = element(namespaced=True, default=None)
    """Whether vehicles and objects cast the sun's shadow; when absent they do, but not in a scene
    of the original's, which had no shadows."""

    integrator: Integrator = element(namespaced=True, default="implicitfast")
    """How simulated vehicles step in time. ``implicitfast`` bears stiff servos, contacts and light
    things, its errors fall with the square of the step; ``RK4`` with the fourth power, for a
    vehicle alone: servos of arms and contacts need steps so short that it is of no use there."""

    @property
    def original_gravity(self) -> Triple:
        """What things fall with by the original's physics, in the world [m/s2]."""
        return self.gravity if any(self.gravity) else (0.0, 0.0, -1.0)


@dataclass(frozen=True, kw_only=True)
class ViewerCameraSpec:
    """A ``<camera>``: the viewer's, in the world (z up)."""

    free_motion: bool = element(default=True, original=Original(invalid=True))
    """1: the mouse moves it; 0: it follows ``objectToTrack``."""
    object_to_track: str = ""
    """Route of the node to follow."""
    fov: float = element(default=60.0, above=0, below=180)
    """Vertical field of view [deg]."""
    aspect_ratio: float = element(default=1.33, above=0)
    """Width over height [1]."""
    near: float = -1.0
    """Near plane; automatic unless both planes are given [m]."""
    far: float = -1.0
    """Far plane; automatic unless both planes are given [m]."""
    position: Triple = element(
        default=(-5.0, -5.0, 8.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Of the viewer in the world [m]."""
    look_at: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """Where it looks, in the world [m]."""


@dataclass(frozen=True, kw_only=True)
class NedOriginSpec:
    """A ``<nedOrigin>``: where on Earth the pose inputs of ``<fdm>`` count from."""

    lat: float = element(default=0.0, original=Original(lenient=True, required=True))
    """Latitude [deg]."""
    lon: float = element(default=0.0, original=Original(lenient=True, required=True))
    """Longitude [deg]."""


@dataclass(frozen=True, kw_only=True)
class NetTracingScriptSpec:
    """A ``<netTracingScript>``: a plug-in that watches the network simulation."""

    class_name: str = element(default="", original=REQUIRED)
    """Name of the plug-in; empty or "default" is the built-in one."""
    lib_path: str = ""
    """Library that holds it."""
    log_to_file: str = ""
    """File to log to."""
    log_to_console: bool = True
    """Whether to log to the console."""
    async_log: bool = True
    """Whether to log in the background."""


@dataclass(frozen=True, kw_only=True)
class PhysicsSpec:
    """A ``<physics>`` block of an object."""

    mass: float = element(default=1.0, minimum=0)
    """Its mass; 0 never moves [kg]."""
    inertia: Triple = ZERO
    """About its axes; all zero: from its shape [kg m2]."""
    collision_shape_type: str = "box"
    """box, sphere, compound box, compound cylinder, trimesh or compound trimesh."""
    collision_shape: str = ""
    """Another file to make the shape from."""
    linear_damping: float = 0.0
    """Of its velocity [1/s]."""
    angular_damping: float = 0.0
    """Of its turning [1/s]."""
    is_kinematic: bool = False
    """Whether it is moved by commands alone."""
    min_linear_limit: Triple = ONE
    """Where an axis may go from; min above max is free [m]."""
    max_linear_limit: Triple = ZERO
    """Where an axis may go to; min above max is free [m]."""
    min_angular_limit: Triple = ONE
    """Where a turn may go from; min above max is free [rad]."""
    max_angular_limit: Triple = ZERO
    """Where a turn may go to; min above max is free [rad]."""
    volume: float | None = element(namespaced=True, default=None, minimum=0.0)
    """Water it displaces; without it the volume of the box around it [m3]."""
    friction: float | None = element(namespaced=True, default=None, minimum=0.0, maximum=10.0)
    """Coefficient of sliding friction with whatever touches it [1]; without it 0.8. Of two objects
    that say one the greater counts."""
    restitution: float | None = element(namespaced=True, default=None, minimum=0.0, maximum=0.95)
    """Speed after a bounce by the speed before, away from the water's drag [1]; without it contacts
    give 0.1 to 0.3 back."""
    centre_of_mass: Triple | None = element(
        namespaced=True, default=None, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """In the object's frame [m]; without it the middle of its box. Inertia is about it."""

    @property
    def is_loose(self) -> bool:
        """Whether forces move it, in a scene where anything is simulated."""
        return self.mass > 0.0 and not self.is_kinematic and not self.is_locked

    @property
    def is_locked(self) -> bool:
        """Whether limits leave it no way to move or turn."""
        lowest = (*self.min_linear_limit, *self.min_angular_limit)
        return lowest == (*self.max_linear_limit, *self.max_angular_limit)


@dataclass(frozen=True, kw_only=True)
class WeatheringSpec:
    """A ``<u:weathering>``: clouds of light and dark on the textures of an object."""

    pattern: int = element(namespaced=True, minimum=0, maximum=1_000_000)
    """Number of the pattern; each is another, 0 is none."""
    strength: float = element(namespaced=True, default=0.15, minimum=0, maximum=1)
    """How strong the clouds are: standard deviation of the brightness, relative [1]."""


@dataclass(frozen=True, kw_only=True)
class ObjectSpec:
    """An ``<object>``: a thing in the water; the one called ``terrain`` cannot be picked up."""

    name: str
    """Its name; several may share one, searches find the first."""
    file: str
    """Its mesh."""
    position: Triple = element(
        default=ZERO, original=REQUIRED, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """In the file's frame [m]."""
    orientation: Triple = element(default=ZERO, parts="rpy", original=REQUIRED)
    """In the file's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    scale_factor: Triple = element(default=ONE, minimum=1e-6, maximum=1e6)
    """Scale along x, y, z [1]."""
    offsetp: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """Point of the mesh that becomes the origin of the object [m]."""
    offsetr: Triple = ZERO
    """Turn of the mesh in the object, about x, y, z: Rx Ry Rz [rad]."""
    physics: PhysicsSpec | None = None
    """How it moves when physics is on."""
    buried: float = element(attribute=True, default=0.0)
    """How much of its height lies under sand [1]."""
    is_solid: bool | None = element("solid", namespaced=True, default=None)
    """1: it can be touched, without `<physics>` as its faces, fixed. 0: everything passes through
    it, and it stays where it is. Without: solid with `<physics>`, and if it is called `terrain`."""
    on_floor: OnFloorSpec | None = element(namespaced=True, default=None)
    """Whether it is set on the ground."""
    weathering: WeatheringSpec | None = element(namespaced=True, default=None)
    """Clouds of light and dark on its textures; None: as they are."""
    accepts: tuple[ObjectDoubt, ...] = element("accept", namespaced=True, default=())
    """Warnings of `uwsim check` that do not apply here, because the value is intended; the
    section *Doubts* of the reference lists the names."""

    @property
    def solid(self) -> PhysicsSpec:
        """Its ``<physics>``; without one what the original gives it, a loose box of 1 kg.

        But an object called ``terrain`` stands fixed, as its faces: in the original it falls too.
        So does what is said to be ``u:solid``.
        """
        if self.physics is not None:
            return self.physics
        if self.is_ground or self.is_solid:
            return PhysicsSpec(mass=0.0, collision_shape_type="trimesh")
        return PhysicsSpec()

    @property
    def is_ground(self) -> bool:
        """Whether it is called ``terrain``."""
        return self.name == TERRAIN

    def is_touched(self, *, in_water: bool) -> bool:
        """Whether others touch it, beside vehicles that are simulated (``in_water``) or not."""
        if self.is_solid is not None:
            return self.is_solid
        return self.physics is not None or (in_water and self.is_ground)

    @property
    def localized_from_object(self) -> Pose:
        """Where it stands in L, without its scale."""
        return Pose.from_rpy(self.position, self.orientation)

    @property
    def object_from_mesh(self) -> Pose:
        """``Rx Ry Rz(offsetr) T(-offsetp)``: the scale acts outside of it."""
        rotation = rotation_from_xyz(*self.offsetr)
        x, y, z = self.offsetp
        return Pose(product(rotation, [-x, -y, -z]), rotation)


@dataclass(frozen=True, kw_only=True)
class SceneSpec:
    """A ``<UWSimScene>``."""

    ocean_state: OceanStateSpec = element(default=OceanStateSpec())
    """The surface and the water."""
    sim_params: SimParamsSpec = element(default=SimParamsSpec())
    """Frames, window, physics, light."""
    camera: ViewerCameraSpec | None = None
    """The viewer's camera."""
    ned_origin: NedOriginSpec | None = None
    """Where on Earth the scene lies."""
    net_tracing_script: NetTracingScriptSpec | None = None
    """Watches the network simulation."""
    custom_comms_channels: tuple[CustomCommsChannelSpec, ...] = element(
        "CustomCommsChannel", default=()
    )
    """Channels described by delays."""
    acoustic_comms_channels: tuple[AcousticCommsChannelSpec, ...] = element(
        "AcousticCommsChannel", default=()
    )
    """Acoustic channels."""
    vehicles: tuple[VehicleSpec, ...] = element("vehicle", default=())
    """The robots."""
    objects: tuple[ObjectSpec, ...] = element("object", default=())
    """Everything else."""
    ros_interfaces: tuple[InterfaceSpec, ...] = element(choice=INTERFACES, default=())
    """Topics in and out."""
    vary: tuple[VariationSpec, ...] = element(namespaced=True, choice=DISTRIBUTIONS, default=())
    """Values that are drawn anew for each seed."""
    path: str = dataclasses.field(default="", compare=False, metadata={"path": True})
    """The file it was read from."""
    is_original: bool = dataclasses.field(default=False, compare=False, metadata={"path": True})
    """Whether it names the original's DTD: models that are nowhere are then labelled boxes."""

    @property
    def nominal(self) -> SceneSpec:
        """The same without variations: as the file says, whatever the seed."""
        return dataclasses.replace(self, vary=())

    @property
    def has_sun_shadows(self) -> bool:
        """Whether vehicles and objects cast the sun's shadow."""
        asked = self.sim_params.sun_shadow
        return not self.is_original if asked is None else asked

    @cached_property
    def world_from_localized(self) -> Pose:
        """W from L: what ``simParams`` says."""
        return Pose.from_xyz(self.sim_params.offsetp, self.sim_params.offsetr)

    @property
    def stands_on_floor(self) -> bool:
        """Whether anything is to be set on the ground."""
        vehicles, objects = self.vehicles, self.objects
        return any(one.on_floor is not None for one in vehicles) or any(
            one.on_floor is not None for one in objects
        )

    @property
    def is_dynamic(self) -> bool:
        """Whether a vehicle is simulated."""
        return any(vehicle.dynamics is not None for vehicle in self.vehicles)

    @property
    def is_original_physics(self) -> bool:
        """Whether the original's physics is asked for: ``enablePhysics``, nothing in water."""
        return self.sim_params.enable_physics and not self.is_dynamic

    @property
    def has_uwsim_physics(self) -> bool:
        """Whether objects move by the original's physics."""
        return self.is_original_physics and any(
            physics.is_loose for physics in self.solid_objects.values()
        )

    @property
    def simulated_solids(self) -> dict[int, PhysicsSpec]:
        """What can be touched beside vehicles in simulated water, by number.

        Objects with ``<physics>`` or ``u:solid`` 1, and ``terrain``; nothing with ``u:solid`` 0.
        """
        is_dynamic = self.is_dynamic
        return {
            i: thing.solid
            for i, thing in enumerate(self.objects)
            if thing.is_touched(in_water=is_dynamic)
        }

    @property
    def solid_objects(self) -> dict[int, PhysicsSpec]:
        """What can be touched, by number: `simulated_solids`; by the original's physics all.

        All, too, and fixed, where nothing is solid: there the original ends when asked for
        contacts. Nothing with ``u:solid`` 0.
        """
        objects = {i: thing for i, thing in enumerate(self.objects) if thing.is_solid is not False}
        if self.is_original_physics:
            return {i: thing.solid for i, thing in objects.items()}
        if solids := self.simulated_solids:
            return solids
        return {
            i: dataclasses.replace(thing.solid, is_kinematic=True) for i, thing in objects.items()
        }


def with_integrator(scene: SceneSpec, integrator: Integrator | None) -> SceneSpec:
    """Return the scene with an integrator of somebody's choice, where there is one.

    Raises:
        BadSetting: there is none of that name.
    """
    if integrator is None:
        return scene
    if integrator not in get_args(Integrator):
        raise BadSetting(
            f"The integrator is {integrator!r}; expected {' or '.join(get_args(Integrator))}."
        )
    changed = dataclasses.replace(scene.sim_params, integrator=integrator)
    return dataclasses.replace(scene, sim_params=changed)
