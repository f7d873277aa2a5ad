"""The spec of an object: mesh, pose, physics, joint of a fixture, course of a pipe or a cable."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..acoustics import MaterialName
from ..base.geometry import UNIT_SCALE, ZERO, Array, Pose, Triple, rotation_from_xyz
from ..base.numerics.linear import product
from ..base.numerics.polyline import round_corners
from ..bathymetry.bathymetry import BathymetrySpec
from ..schema import CLAMPED_NUMBER, MAX_DISTANCE, REQUIRED_BY_DTD, Numbers, Spec, element
from .accepted_warnings import ObjectWarning
from .on_floor import OnFloorSpec

ShapeType = Literal[
    "box", "sphere", "compound box", "compound cylinder", "trimesh", "compound trimesh"
]

TERRAIN = "terrain"
"""The name of the object that is the ground. Devices cannot pick it up. Without ``<physics>`` it is
fixed, and vehicles with dynamics have contacts with it."""

ARC_SPACING = 0.05
"""The greatest length of arc between two points of a bend [m]."""
MAX_LENGTH = 2000.0
"""The greatest length of a course [m]."""
MAX_STRETCHES = 1000
"""The greatest number of buried stretches."""
MAX_TWINES = 20_000
"""The greatest number of twines of a net before its holes are cut."""
MIN_TWINE = 0.01
"""The length below which a piece of twine between holes is left out [m]."""
MIN_AXIS = 1e-6
"""The least length of the axis of a joint, by its greatest component [1]."""
MAX_DOCK = 100.0
"""The greatest inner dimension of a dock [m]."""
MAX_CONTACT_ERROR = 10.0
"""The greatest ``u:contactError`` [m]."""


@dataclass(frozen=True, kw_only=True)
class PhysicsSpec(Spec):
    """A ``<physics>`` block of an object."""

    mass: float = element(default=1.0, minimum=0, original=CLAMPED_NUMBER)
    """The mass; an object with the mass 0 never moves [kg]."""
    inertia: Triple = element(default=ZERO, original=CLAMPED_NUMBER)
    """The moments of inertia about x, y and z; all zero: those of a solid ball or box around the
    collision shape [kg m2]."""
    collision_shape_type: ShapeType = "box"
    """The kind of collision shape that is made from the mesh."""
    collision_shape: str = ""
    """The mesh file for the collision shape; empty: the visible mesh."""
    linear_damping: float = 0.0
    """The damping of the linear velocity [1/s]."""
    angular_damping: float = 0.0
    """The damping of the angular velocity [1/s]."""
    is_kinematic: bool = False
    """True if only commands move the object."""
    min_linear_limit: Triple = UNIT_SCALE
    """The minimum position on each axis; a minimum above the maximum means free [m]."""
    max_linear_limit: Triple = ZERO
    """The greatest position on each axis; a minimum above the maximum means free [m]."""
    min_angular_limit: Triple = UNIT_SCALE
    """The minimum rotation about each axis; a minimum above the maximum means free [rad]."""
    max_angular_limit: Triple = ZERO
    """The greatest rotation about each axis; a minimum above the maximum means free [rad]."""
    volume: float | None = element(namespaced=True, default=None, minimum=0.0)
    """The volume of displaced water; without it the volume of the object's bounding box [m3]."""
    friction: float | None = element(namespaced=True, default=None, minimum=0.0, maximum=10.0)
    """The coefficient of sliding friction in contacts [1]; without it 0.8. Of two objects with a
    value, the greater applies."""
    restitution: float | None = element(namespaced=True, default=None, minimum=0.0, maximum=0.95)
    """The ratio of the speeds after and before a bounce, without the water's drag [1]; without it
    a bounce returns 0.1 to 0.3 of the speed, and with 0 at most 0.03. Of two values the lesser
    applies."""
    centre_of_mass: Triple | None = element(
        namespaced=True, default=None, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The centre of mass, to which the inertia refers, in the object's frame [m]; without it the
    centre of the bounding box."""

    @property
    def is_loose(self) -> bool:
        """True if forces can move the object: it has a mass, is not kinematic and not locked."""
        return self.mass > 0.0 and not self.is_kinematic and not self.is_locked

    @property
    def is_locked(self) -> bool:
        """True if the limits allow neither translation nor rotation."""
        lower_limits = (*self.min_linear_limit, *self.min_angular_limit)
        return lower_limits == (*self.max_linear_limit, *self.max_angular_limit)


@dataclass(frozen=True, kw_only=True)
class ObjectJointSpec(Spec):
    r"""The joint of an object that is fastened to the scene: a handle, a lever, a drawer, a button.

    The object's origin is on the axis, and its pose in the file is the position 0. The force
    (torque of a hinge) of the joint at the position q is

    .. math:: -k\, q - d\, \dot q - F \operatorname{sign} \dot q

    with the stiffness k, the damping d and the dry friction F, which holds the joint at rest up to
    F. Not modelled: breakaway friction above F, wear, backlash, contacts with fixed objects, and a
    second joint: an object with a joint is fastened to the scene, not to another object.
    """

    axis: Triple = element(namespaced=True, default=(0.0, 0.0, 1.0), minimum=-1.0, maximum=1.0)
    """The direction of the axis in the object's frame, of any length from `MIN_AXIS` [1]."""
    lower: float | None = element(
        namespaced=True, default=None, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the lower stop, at most 0 [rad or m]; without it and `<u:upper>` there are no
    stops."""
    upper: float | None = element(
        namespaced=True, default=None, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the upper stop, at least 0 [rad or m]."""
    friction: float = element(namespaced=True, default=0.0, minimum=0.0, maximum=1e6)
    """The dry friction F [N m or N]."""
    damping: float = element(namespaced=True, default=0.0, minimum=0.0, maximum=1e6)
    """The damping d [N m s/rad or N s/m]."""
    stiffness: float = element(namespaced=True, default=0.0, minimum=0.0, maximum=1e6)
    """The stiffness k of the spring that returns the joint to the position 0 [N m/rad or N/m]."""

    def errors(self) -> Iterator[str]:
        """Yield errors of values that are valid one by one, but not together."""
        if max(map(abs, self.axis)) < MIN_AXIS:
            yield f"<u:axis> is {'{:g} {:g} {:g}'.format(*self.axis)}; expected a direction"
        if (self.lower is None) != (self.upper is None):
            yield "one of <u:lower> and <u:upper> is missing; expected both or neither"
        elif self.lower is not None and self.upper is not None and not self.lower < self.upper:
            yield f"<u:lower> {self.lower:g} is not below <u:upper> {self.upper:g}"
        elif (self.lower or 0.0) > 0.0 or (self.upper or 0.0) < 0.0:
            yield f"<u:lower> {self.lower:g} to <u:upper> {self.upper:g} excludes 0, the start"


@dataclass(frozen=True, kw_only=True)
class HingeSpec(ObjectJointSpec):
    """A ``<u:hinge>``: the object turns about the axis; positions in rad, torques in N m."""


@dataclass(frozen=True, kw_only=True)
class SlideSpec(ObjectJointSpec):
    """A ``<u:slide>``: the object moves along the axis; positions in m, forces in N."""


@dataclass(frozen=True, kw_only=True)
class WeatheringSpec(Spec):
    """A ``<u:weathering>``: bright and dark patches on the textures of an object."""

    pattern: int = element(namespaced=True, minimum=0, maximum=1_000_000)
    """The number of the pattern: each number gives other patches, 0 gives none."""
    strength: float = element(namespaced=True, default=0.15, minimum=0, maximum=1)
    """The strength of the patches: standard deviation of the brightness, relative [1]."""


@dataclass(frozen=True, kw_only=True)
class CourseSpec(Spec):
    r"""A ``<u:course>``: the line along which the mesh of an object is repeated and bent.

    Copies of the mesh, end to end along its y axis, follow the line. They are stretched so that a
    whole number of them is as long as the line. A vertex at :math:`(x, y, z)` comes to

    .. math:: c(y) + x\, (t \times n) + z\, n

    with the point c at the length y of the line, the direction t of the line there, and the unit
    vector n across t that is nearest to the object's z axis. Not modelled: the change of length on
    the two sides of a bend, bending stiffness, and motion; a course is fixed.

    With `<u:onFloor>`, the line lies on the ground, of which it evens out the relief over 2 m; its
    clearance is the height of the line above the ground.
    """

    points: Numbers = element(namespaced=True)
    """The x, y and z of each corner of the line, one after the other, in the object's frame [m]."""
    bend_radius: float = element(namespaced=True, default=0.0, minimum=0.0, maximum=MAX_DISTANCE)
    """The radius of the arc that replaces each corner, smaller where the line is too short [m]."""
    buried_share: float = element(namespaced=True, default=0.0, minimum=0.0, maximum=1.0)
    """The share of the line's length that is buried [1]."""
    buried_stretches: int = element(namespaced=True, default=1, minimum=1, maximum=MAX_STRETCHES)
    """The number of buried stretches, of equal length and at equal distances."""
    burial_depth: float = element(namespaced=True, default=0.4, minimum=0.0, maximum=MAX_DISTANCE)
    """The depth by which buried stretches are below the line [m]."""

    def errors(self) -> Iterator[str]:
        """Yield errors of points that are no line."""
        n = len(self.points)
        if n % 3 or n < 6:
            yield f"<u:points> has {n} numbers; expected x y z of two points at least"
            return
        if not all(abs(number) <= MAX_DISTANCE for number in self.points):
            yield f"<u:points> has a number beyond {MAX_DISTANCE:g} m"
            return
        steps = np.diff(np.array(self.points).reshape(-1, 3), axis=0)
        lengths = np.sqrt(np.sum(steps * steps, axis=1))
        if not lengths.all():
            yield "<u:points> repeats a point; expected each point away from the one before it"
        if lengths.sum() > MAX_LENGTH:
            yield f"<u:course> is {lengths.sum():.0f} m long; expected at most {MAX_LENGTH:g} m"

    @property
    def line(self) -> Array:
        """The points of the line with its bends, as if nothing were buried, (n, 3) [m]."""
        corners = np.array(self.points, dtype=np.float64).reshape(-1, 3)
        return round_corners(corners, self.bend_radius, ARC_SPACING)


@dataclass(frozen=True, kw_only=True)
class NetSpec(Spec):
    r"""A ``<u:net>``: a rectangular panel of square meshes with round holes.

    The panel is in the x-z plane of the object, with its centre at the origin. Its twines are
    copies of the object's mesh, a piece of twine along the y axis, which is turned and stretched to
    the length of each. A hole cuts the twines within its circle. Not modelled: bending in a
    current, knots, loose ends, and the drag of the net on the water.
    """

    width: float = element(namespaced=True, exclusive_minimum=0.0, maximum=1000.0)
    """The width of the panel, along x [m]."""
    height: float = element(namespaced=True, exclusive_minimum=0.0, maximum=1000.0)
    """The height of the panel, along z [m]."""
    mesh_side: float = element(namespaced=True, exclusive_minimum=0.0, maximum=1000.0)
    """The side of a mesh; the panel has a whole number of meshes, of sides up to this [m]."""
    holes: Numbers = element(namespaced=True, default=())
    """The place x and z of the centre of each hole, and its radius, one after the other [m]."""

    def errors(self) -> Iterator[str]:
        """Yield errors of the holes and of the number of twines."""
        if len(self.holes) % 3:
            yield f"<u:holes> has {len(self.holes)} numbers; expected x, z and radius of each hole"
        elif any(radius <= 0.0 for radius in self.holes[2::3]):
            yield "<u:holes> has a radius of 0 or below; expected positive radii"
        if (self.width + self.height) / self.mesh_side > MAX_TWINES:
            yield f"<u:meshSide> makes more than {MAX_TWINES} twines; choose a larger one"
        elif self.holes and len(self.holes) % 3 == 0 and not len(self.twines):
            yield "<u:holes> cuts away the whole net; expected smaller holes"

    @property
    def circles(self) -> Array:
        """The place x and z and the radius of each hole, (n, 3) [m]."""
        return np.array(self.holes, dtype=np.float64).reshape(-1, 3)

    @property
    def twines(self) -> Array:
        """The ends x, z, x, z of each piece of twine, (n, 4) [m]."""
        pieces: list[tuple[float, float, float, float]] = []
        for length, other_length, is_level in (
            (self.width, self.height, True),
            (self.height, self.width, False),
        ):
            n = max(1, math.ceil(other_length / self.mesh_side - 1e-9))
            for place in np.linspace(-0.5 * other_length, 0.5 * other_length, n + 1).tolist():
                for start, end in self._pieces(length, place, is_level=is_level):
                    ends = (start, place, end, place)
                    pieces.append(ends if is_level else (place, start, place, end))
        return np.array(pieces, dtype=np.float64).reshape(-1, 4)

    def _pieces(
        self, length: float, place: float, *, is_level: bool
    ) -> Iterator[tuple[float, float]]:
        """Yield the ends of the pieces of a twine between holes [m]."""
        cuts = []
        for x, z, radius in self.circles.tolist():
            centre, distance = (x, z - place) if is_level else (z, x - place)
            if abs(distance) < radius:
                half = math.sqrt(radius * radius - distance * distance)
                cuts.append((centre - half, centre + half))
        start = -0.5 * length
        for low, high in sorted(cuts):
            if low - start > MIN_TWINE:
                yield start, low
            start = max(start, high)
        if 0.5 * length - start > MIN_TWINE:
            yield start, 0.5 * length


@dataclass(frozen=True, kw_only=True)
class DockSpec(Spec):
    r"""A ``<u:dock>``: the inner dimensions of a dock, a funnel before a chamber.

    The x axis of the object points into the dock; its origin is in the middle of the throat, where
    the funnel meets the chamber. The mesh has the funnel from x = -1 to 0, the chamber from 0 to 1,
    and the inner sides at distances of 1 from the axis: `objects/dock_square` has four walls,
    `objects/dock_round` is a cone before a tube. Both are closed behind the chamber. A vertex
    :math:`(x, y, z)` comes to

    .. math:: (l\, x,\ \tfrac12 w(x)\, y,\ \tfrac12 h(x)\, z)

    with the length l of funnel or chamber, and the width w and height h there. Walls are thicker
    where the dock is wider. Not modelled: walls through which water flows, and a latch; see
    `<u:dockingMagnet>`.
    """

    entrance_width: float = element(namespaced=True, exclusive_minimum=0.0, maximum=MAX_DOCK)
    """The inner width of the funnel's entrance, along y [m]."""
    entrance_height: float = element(namespaced=True, exclusive_minimum=0.0, maximum=MAX_DOCK)
    """The inner height of the funnel's entrance, along z [m]."""
    width: float = element(namespaced=True, exclusive_minimum=0.0, maximum=MAX_DOCK)
    """The inner width of the chamber, along y [m]."""
    height: float = element(namespaced=True, exclusive_minimum=0.0, maximum=MAX_DOCK)
    """The inner height of the chamber, along z [m]."""
    funnel_length: float = element(namespaced=True, exclusive_minimum=0.0, maximum=MAX_DOCK)
    """The length of the funnel [m]."""
    length: float = element(namespaced=True, exclusive_minimum=0.0, maximum=MAX_DOCK)
    """The length of the chamber [m]."""


@dataclass(frozen=True, kw_only=True)
class ObjectSpec(Spec):
    """An ``<object>`` of a scene; the object called ``terrain`` is the ground."""

    name: str
    """The name; several objects may share a name, which then refers to the first."""
    file: str
    """The mesh file."""
    position: Triple = element(
        default=ZERO, original=REQUIRED_BY_DTD, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position in the frame of the scene file, L [m]."""
    orientation: Triple = element(default=ZERO, parts="rpy", original=REQUIRED_BY_DTD)
    """The orientation in the frame of the scene file, L: fixed-axis roll, pitch, yaw, Rz Ry Rx
    [rad]."""
    scale_factor: Triple = element(
        default=UNIT_SCALE, minimum=1e-6, maximum=1e6, original=CLAMPED_NUMBER
    )
    """The scale along x, y, z [1]."""
    offsetp: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The point of the mesh, in mesh coordinates, that is the origin of the object [m]."""
    offsetr: Triple = ZERO
    """The rotation of the mesh in the object, about x, y, z: Rx Ry Rz [rad]."""
    physics: PhysicsSpec | None = None
    """The physical properties of the object, in scenes with physics."""
    buried: float = element(attribute=True, default=0.0)
    """The fraction of the object's height that is under sand [1]."""
    is_solid: bool | None = element("solid", namespaced=True, default=None)
    """1: the object has contacts; without `<physics>` it is fixed, with the faces of its mesh as
    contact surface. 0: everything passes through the object, and it never moves. Without this
    element an object is solid if it has `<physics>` or is called `terrain`."""
    contact_error: float | None = element(
        namespaced=True, default=None, minimum=0.0, maximum=MAX_CONTACT_ERROR
    )
    """The greatest distance [m] between mesh and contact surface of a fixed object with a triangle
    mesh; 0: none. Without it a mesh of up to 2000 flat faces is exact, and a larger mesh is
    replaced by a height field or a simpler mesh within 0.03 m."""
    on_floor: OnFloorSpec | None = element(namespaced=True, default=None)
    """The placement on the ground; without it the object begins at its position."""
    course: CourseSpec | None = element(namespaced=True, default=None)
    """The line along which the mesh is repeated and bent, as a pipe or a cable; without it the mesh
    is a single piece."""
    hinge: HingeSpec | None = element(namespaced=True, default=None)
    """The hinge by which the object is fastened to the scene; without it and a `<u:slide>` the
    object is free or fixed. A joint needs `<physics>` with a mass, and a vehicle with `u:dynamics`.
    """
    slide: SlideSpec | None = element(namespaced=True, default=None)
    """The slide by which the object is fastened to the scene."""
    net: NetSpec | None = element(namespaced=True, default=None)
    """The panel of net of which the mesh is a piece of twine; without it the mesh is a single
    piece."""
    dock: DockSpec | None = element(namespaced=True, default=None)
    """The dimensions of a dock that the mesh gets; without it the mesh keeps its shape."""
    bathymetry: BathymetrySpec | None = element(namespaced=True, default=None)
    """The treatment of a file that is a chart of the sea floor; without it the file is a mesh."""
    acoustic_material: MaterialName | None = element(namespaced=True, default=None)
    """The material for sonars; without it an object called `terrain` is sand, others are steel."""
    weathering: WeatheringSpec | None = element(namespaced=True, default=None)
    """The bright and dark patches on the textures; without it textures are unchanged."""
    accepts: tuple[ObjectWarning, ...] = element("accept", namespaced=True, default=())
    """The warnings of `uwsim check` that do not apply, because the value is intended; the section
    *Plausibility warnings* of the reference lists the names."""

    @property
    def solid(self) -> PhysicsSpec:
        """The ``<physics>``; without one, the default of the original UWSim: a loose box of 1 kg.

        Differently from the original UWSim, where it falls, an object without ``<physics>`` is
        fixed, with the faces of its mesh as contact surface, if it is called ``terrain`` or has
        ``u:solid``.
        """
        if self.physics is not None:
            return self.physics
        if self.is_ground or self.is_solid:
            return PhysicsSpec(mass=0.0, collision_shape_type="trimesh")
        return PhysicsSpec()

    @property
    def joint(self) -> ObjectJointSpec | None:
        """The hinge or the slide; None if the object is free or fixed."""
        return self.hinge or self.slide

    @property
    def is_free(self) -> bool:
        """True if forces can move the object in all directions: it is loose, without a joint."""
        return self.solid.is_loose and self.joint is None

    @property
    def is_ground(self) -> bool:
        """True if the object is called ``terrain``, or is a chart of the sea floor."""
        return self.name == TERRAIN or self.bathymetry is not None

    def chart_errors(self) -> Iterator[str]:
        """Yield errors of a chart of the sea floor, and of elements that it excludes."""
        if self.bathymetry is None:
            return
        yield from self.bathymetry.errors()
        exclusions = {
            "<orientation>": any(self.orientation),
            "<scaleFactor>": self.scale_factor != UNIT_SCALE,
            "<offsetp>": any(self.offsetp),
            "<offsetr>": any(self.offsetr),
            "<u:onFloor>": self.on_floor is not None,
            "<u:course>": self.course is not None,
            "<u:net>": self.net is not None,
            "<u:dock>": self.dock is not None,
            "a <physics> with a mass": self.physics is not None and self.physics.is_loose,
        }
        for name, is_present in exclusions.items():
            if is_present:
                yield f"{name} does not apply to a <u:bathymetry>; remove it"

    def has_contacts(self, *, in_water: bool) -> bool:
        """Return whether the object has contacts.

        Args:
            in_water: True if a vehicle of the scene has dynamics.
        """
        if self.is_solid is not None:
            return self.is_solid
        return self.physics is not None or (in_water and self.is_ground)

    @property
    def localized_from_object(self) -> Pose:
        """The pose of the object in L, without scale."""
        return Pose.from_rpy(self.position, self.orientation)

    @property
    def object_from_mesh(self) -> Pose:
        """The pose of the mesh before scaling, ``Rx Ry Rz(offsetr) T(-offsetp)``."""
        rotation = rotation_from_xyz(*self.offsetr)
        x, y, z = self.offsetp
        return Pose(product(rotation, [-x, -y, -z]), rotation)
