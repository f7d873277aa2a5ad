"""The spec of an object: mesh, pose, physics."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..acoustics import MaterialName
from ..base.geometry import UNIT_SCALE, ZERO, Pose, Triple, rotation_from_xyz
from ..base.numerics.linear import product
from ..schema import CLAMPED_NUMBER, MAX_DISTANCE, REQUIRED_BY_DTD, Spec, element
from .accepted_warnings import ObjectWarning
from .on_floor import OnFloorSpec

ShapeType = Literal[
    "box", "sphere", "compound box", "compound cylinder", "trimesh", "compound trimesh"
]

TERRAIN = "terrain"
"""An object of this name is the ground: nothing picks it up, and without ``<physics>`` it is
fixed, and solid for simulated vehicles."""

MAX_CONTACT_ERROR = 10.0
"""Greatest ``u:contactError`` [m]."""


@dataclass(frozen=True, kw_only=True)
class PhysicsSpec(Spec):
    """A ``<physics>`` block of an object."""

    mass: float = element(default=1.0, minimum=0, original=CLAMPED_NUMBER)
    """Its mass; 0 never moves [kg]."""
    inertia: Triple = element(default=ZERO, original=CLAMPED_NUMBER)
    """About its axes; all zero: that of the ball, or of the box around its shape [kg m2]."""
    collision_shape_type: ShapeType = "box"
    """What is made of its mesh for contacts."""
    collision_shape: str = ""
    """Another file to make the shape from."""
    linear_damping: float = 0.0
    """Of its velocity [1/s]."""
    angular_damping: float = 0.0
    """Of its turning [1/s]."""
    is_kinematic: bool = False
    """Whether it is moved by commands alone."""
    min_linear_limit: Triple = UNIT_SCALE
    """Where an axis may go from; min above max is free [m]."""
    max_linear_limit: Triple = ZERO
    """Where an axis may go to; min above max is free [m]."""
    min_angular_limit: Triple = UNIT_SCALE
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
    give 0.1 to 0.3 back, and 0 gives at most 0.03. Of two that say one the lesser counts."""
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
class WeatheringSpec(Spec):
    """A ``<u:weathering>``: clouds of light and dark on the textures of an object."""

    pattern: int = element(namespaced=True, minimum=0, maximum=1_000_000)
    """Number of the pattern; each is another, 0 is none."""
    strength: float = element(namespaced=True, default=0.15, minimum=0, maximum=1)
    """How strong the clouds are: standard deviation of the brightness, relative [1]."""


@dataclass(frozen=True, kw_only=True)
class ObjectSpec(Spec):
    """An ``<object>``: a thing in the water; the one called ``terrain`` cannot be picked up."""

    name: str
    """Its name; several may share one, searches find the first."""
    file: str
    """Its mesh."""
    position: Triple = element(
        default=ZERO, original=REQUIRED_BY_DTD, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """In the file's frame [m]."""
    orientation: Triple = element(default=ZERO, parts="rpy", original=REQUIRED_BY_DTD)
    """In the file's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    scale_factor: Triple = element(
        default=UNIT_SCALE, minimum=1e-6, maximum=1e6, original=CLAMPED_NUMBER
    )
    """Scale along x, y, z [1]."""
    offsetp: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """Point of the mesh that becomes the origin of the object [m]."""
    offsetr: Triple = ZERO
    """Turn of the mesh in the object, about x, y, z: Rx Ry Rz [rad]."""
    physics: PhysicsSpec | None = None
    """Its physics, where physics is on."""
    buried: float = element(attribute=True, default=0.0)
    """How much of its height lies under sand [1]."""
    is_solid: bool | None = element("solid", namespaced=True, default=None)
    """1: it can be touched, without `<physics>` as its faces, fixed. 0: everything passes through
    it, and it stays where it is. Without: solid with `<physics>`, and if it is called `terrain`."""
    contact_error: float | None = element(
        namespaced=True, default=None, minimum=0.0, maximum=MAX_CONTACT_ERROR
    )
    """Greatest distance [m] between its mesh and what is touched of it, where it stands fixed as
    its faces; 0: none. Without it up to 2000 flat faces are touched as they are, and of more a
    height field or a simpler mesh within 0.03 m."""
    on_floor: OnFloorSpec | None = element(namespaced=True, default=None)
    """Whether it is set on the ground."""
    acoustic_material: MaterialName | None = element(namespaced=True, default=None)
    """What sonars take it for; without it an object called `terrain` is sand, others are steel."""
    weathering: WeatheringSpec | None = element(namespaced=True, default=None)
    """Clouds of light and dark on its textures; None: as they are."""
    accepts: tuple[ObjectWarning, ...] = element("accept", namespaced=True, default=())
    """Warnings of `uwsim check` that do not apply here, because the value is intended; the
    section *Plausibility warnings* of the reference lists the names."""

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
        """Whether others touch it, with simulated vehicles in the scene (``in_water``) or not."""
        if self.is_solid is not None:
            return self.is_solid
        return self.physics is not None or (in_water and self.is_ground)

    @property
    def localized_from_object(self) -> Pose:
        """Its pose in L, without its scale."""
        return Pose.from_rpy(self.position, self.orientation)

    @property
    def object_from_mesh(self) -> Pose:
        """``Rx Ry Rz(offsetr) T(-offsetp)``: the scale acts outside of it."""
        rotation = rotation_from_xyz(*self.offsetr)
        x, y, z = self.offsetp
        return Pose(product(rotation, [-x, -y, -z]), rotation)
