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
"""The name of the object that is the ground: nothing picks it up, and without ``<physics>`` it is
fixed, and solid for simulated vehicles."""

MAX_CONTACT_ERROR = 10.0
"""The greatest ``u:contactError`` [m]."""


@dataclass(frozen=True, kw_only=True)
class PhysicsSpec(Spec):
    """A ``<physics>`` block of an object."""

    mass: float = element(default=1.0, minimum=0, original=CLAMPED_NUMBER)
    """The mass; 0 never moves [kg]."""
    inertia: Triple = element(default=ZERO, original=CLAMPED_NUMBER)
    """The inertia about its axes; all zero: that of the ball or box around its shape [kg m2]."""
    collision_shape_type: ShapeType = "box"
    """The collision shape that is made of its mesh."""
    collision_shape: str = ""
    """Another mesh file for the collision shape."""
    linear_damping: float = 0.0
    """The damping of its velocity [1/s]."""
    angular_damping: float = 0.0
    """The damping of its angular velocity [1/s]."""
    is_kinematic: bool = False
    """True if only commands move it."""
    min_linear_limit: Triple = UNIT_SCALE
    """The least position on each axis; min above max is free [m]."""
    max_linear_limit: Triple = ZERO
    """The greatest position on each axis; min above max is free [m]."""
    min_angular_limit: Triple = UNIT_SCALE
    """The least rotation about each axis; min above max is free [rad]."""
    max_angular_limit: Triple = ZERO
    """The greatest rotation about each axis; min above max is free [rad]."""
    volume: float | None = element(namespaced=True, default=None, minimum=0.0)
    """The volume of displaced water; without it the volume of the box around it [m3]."""
    friction: float | None = element(namespaced=True, default=None, minimum=0.0, maximum=10.0)
    """The coefficient of sliding friction in contacts [1]; without it 0.8. Of two objects with a
    value, the greater applies."""
    restitution: float | None = element(namespaced=True, default=None, minimum=0.0, maximum=0.95)
    """The ratio of the speeds after and before a bounce, without the water's drag [1]; without it
    contacts return 0.1 to 0.3, and 0 returns at most 0.03. Of two values the lesser applies."""
    centre_of_mass: Triple | None = element(
        namespaced=True, default=None, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The centre of mass, and of the inertia, in the object's frame [m]; without: its box's
    middle."""

    @property
    def is_loose(self) -> bool:
        """True if forces move it, in a scene with simulated parts."""
        return self.mass > 0.0 and not self.is_kinematic and not self.is_locked

    @property
    def is_locked(self) -> bool:
        """True if its limits allow no motion and no rotation."""
        lower_limits = (*self.min_linear_limit, *self.min_angular_limit)
        return lower_limits == (*self.max_linear_limit, *self.max_angular_limit)


@dataclass(frozen=True, kw_only=True)
class WeatheringSpec(Spec):
    """A ``<u:weathering>``: bright and dark patches on the textures of an object."""

    pattern: int = element(namespaced=True, minimum=0, maximum=1_000_000)
    """The number of the pattern; each differs, 0 is none."""
    strength: float = element(namespaced=True, default=0.15, minimum=0, maximum=1)
    """The strength of the patches: standard deviation of the brightness, relative [1]."""


@dataclass(frozen=True, kw_only=True)
class ObjectSpec(Spec):
    """An ``<object>`` in the water; the one called ``terrain`` cannot be picked up."""

    name: str
    """The name; several may share one, searches find the first."""
    file: str
    """The mesh file."""
    position: Triple = element(
        default=ZERO, original=REQUIRED_BY_DTD, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position in the file's frame [m]."""
    orientation: Triple = element(default=ZERO, parts="rpy", original=REQUIRED_BY_DTD)
    """The orientation in the file's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    scale_factor: Triple = element(
        default=UNIT_SCALE, minimum=1e-6, maximum=1e6, original=CLAMPED_NUMBER
    )
    """The scale along x, y, z [1]."""
    offsetp: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The point of the mesh that becomes the origin of the object [m]."""
    offsetr: Triple = ZERO
    """The rotation of the mesh in the object, about x, y, z: Rx Ry Rz [rad]."""
    physics: PhysicsSpec | None = None
    """The physics of the object, in scenes with physics."""
    buried: float = element(attribute=True, default=0.0)
    """The share of its height under sand [1]."""
    is_solid: bool | None = element("solid", namespaced=True, default=None)
    """1: it has contacts, without `<physics>` as its faces, fixed. 0: everything passes through it,
    and it never moves. Without: solid with `<physics>`, and if it is called `terrain`."""
    contact_error: float | None = element(
        namespaced=True, default=None, minimum=0.0, maximum=MAX_CONTACT_ERROR
    )
    """The greatest distance [m] between its mesh and its contact surface, if it is fixed with its
    faces; 0: none. Without it up to 2000 flat faces are exact; a larger mesh becomes a height field
    or a simpler mesh within 0.03 m."""
    on_floor: OnFloorSpec | None = element(namespaced=True, default=None)
    """The placement on the ground, if it is given."""
    acoustic_material: MaterialName | None = element(namespaced=True, default=None)
    """The material for sonars; without it an object called `terrain` is sand, others are steel."""
    weathering: WeatheringSpec | None = element(namespaced=True, default=None)
    """The bright and dark patches on its textures; None: textures without changes."""
    accepts: tuple[ObjectWarning, ...] = element("accept", namespaced=True, default=())
    """The warnings of `uwsim check` that do not apply here, because the value is intended; the
    section *Plausibility warnings* of the reference lists the names."""

    @property
    def solid(self) -> PhysicsSpec:
        """The ``<physics>``; without one that of the original, a loose box of 1 kg.

        But an object called ``terrain``, or with ``u:solid``, is fixed, with its faces as contact
        surface: in the original it falls too.
        """
        if self.physics is not None:
            return self.physics
        if self.is_ground or self.is_solid:
            return PhysicsSpec(mass=0.0, collision_shape_type="trimesh")
        return PhysicsSpec()

    @property
    def is_ground(self) -> bool:
        """True if the object is called ``terrain``."""
        return self.name == TERRAIN

    def has_contacts(self, *, in_water: bool) -> bool:
        """Return whether it has contacts; ``in_water``: the scene has simulated vehicles."""
        if self.is_solid is not None:
            return self.is_solid
        return self.physics is not None or (in_water and self.is_ground)

    @property
    def localized_from_object(self) -> Pose:
        """The pose in L, without its scale."""
        return Pose.from_rpy(self.position, self.orientation)

    @property
    def object_from_mesh(self) -> Pose:
        """The pose ``Rx Ry Rz(offsetr) T(-offsetp)``: the scale acts outside of it."""
        rotation = rotation_from_xyz(*self.offsetr)
        x, y, z = self.offsetp
        return Pose(product(rotation, [-x, -y, -z]), rotation)
