"""The contents of SDF files, as they are written: poses with the names of their frames."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from lxml import etree

from ...base.geometry import UNIT_SCALE, Array, Pose, Triple
from ..report import Place

MODEL_FRAME = "__model__"
"""The name of the frame of the model in which it is used."""
SEPARATOR = "::"
"""The separator between the name of a nested model and a name in it."""

ShapeKind = Literal["box", "cylinder", "sphere", "capsule", "ellipsoid", "cone", "plane", "mesh"]
Colour = tuple[float, float, float, float]


@dataclass(frozen=True, kw_only=True)
class FramedPose:
    """A pose in a named frame."""

    pose: Pose = field(default_factory=Pose.identity)
    """The pose."""
    relative_to: str = ""
    """The frame; empty: the default frame of the element."""
    line: int = 0
    """The line, for messages."""


@dataclass(frozen=True, kw_only=True)
class Shape:
    """The geometry of a visual or a collision."""

    kind: ShapeKind
    """The kind."""
    size: Triple = UNIT_SCALE
    """The extent along x, y and z [m]; the length of a capsule includes its caps."""
    uri: str = ""
    """The name of the file of a mesh."""
    folder: Path = Path()
    """The file that names the mesh."""
    scale: Triple = UNIT_SCALE
    """The scale of a mesh [1]."""
    submesh: str = ""
    """The only part of the mesh that is used; empty: the whole mesh."""
    normal: Triple = (0.0, 0.0, 1.0)
    """The normal of a plane [1]."""


@dataclass(frozen=True, kw_only=True)
class Visual:
    """A ``<visual>`` or a ``<collision>``."""

    name: str
    """The name."""
    pose: FramedPose
    """The pose in the frame of the link."""
    shape: Shape
    """The shape."""
    colour: Colour | None
    """The diffuse colour and the opacity [0..1]; None without a material."""
    place: Place
    """The place in the file."""


@dataclass(frozen=True, kw_only=True)
class Inertial:
    """An ``<inertial>``: mass, inertia about the centre of mass, and added mass."""

    mass: float = 1.0
    """The mass [kg]; 1 is SDF's default."""
    pose: FramedPose = field(default_factory=FramedPose)
    """The centre of mass and the axes of the inertia, in the frame of the link."""
    inertia: tuple[float, float, float, float, float, float] = (1.0, 1.0, 1.0, 0.0, 0.0, 0.0)
    """The inertia: xx, yy, zz, xy, xz, yz [kg m2]; 1 1 1 is SDF's default."""
    added_mass: Array | None = None
    """The added mass of ``<fluid_added_mass>`` in the frame of the inertia, (6, 6)."""


@dataclass(frozen=True, kw_only=True)
class Sensor:
    """A ``<sensor>``."""

    name: str
    """The name."""
    kind: str
    """The type, as ``imu``; of a custom sensor its ``gz:type``."""
    pose: FramedPose
    """The pose in the frame of the link."""
    node: etree._Element
    """The element."""
    place: Place
    """The place in the file."""


@dataclass(frozen=True, kw_only=True)
class Link:
    """A ``<link>``."""

    name: str
    """The name."""
    pose: FramedPose
    """The pose in the frame of the model."""
    inertial: Inertial
    """The mass and inertia."""
    visuals: tuple[Visual, ...]
    """The visible shapes."""
    collisions: tuple[Visual, ...]
    """The shapes for contacts and buoyancy."""
    sensors: tuple[Sensor, ...]
    """The sensors."""
    place: Place
    """The place in the file."""


@dataclass(frozen=True, kw_only=True)
class Axis:
    """An ``<axis>`` of a joint."""

    xyz: Triple = (0.0, 0.0, 1.0)
    """The direction [1]."""
    expressed_in: str = ""
    """The frame of the direction; empty: the frame of the joint."""
    lower: float = -1e16
    """The lower limit [rad or m]."""
    upper: float = 1e16
    """The upper limit [rad or m]."""
    effort: float = -1.0
    """The greatest effort [N m or N]; negative: unlimited."""
    velocity: float = -1.0
    """The greatest speed [rad/s or m/s]; negative: unlimited."""
    damping: float = 0.0
    """The viscous damping [N m s/rad or N s/m]."""
    friction: float = 0.0
    """The dry friction [N m or N]."""


@dataclass(frozen=True, kw_only=True)
class Joint:
    """A ``<joint>``."""

    name: str
    """The name."""
    kind: str
    """The type."""
    parent: str
    """The parent link, or ``world``."""
    child: str
    """The child link."""
    pose: FramedPose
    """The pose in the frame of the child."""
    axis: Axis
    """The first axis."""
    place: Place
    """The place in the file."""


@dataclass(frozen=True, kw_only=True)
class Frame:
    """A ``<frame>``."""

    name: str
    """The name."""
    attached_to: str
    """The link or frame that carries it; empty: the model."""
    pose: FramedPose
    """The pose in the frame that carries it."""


@dataclass(frozen=True, kw_only=True)
class Plugin:
    """A ``<plugin>``."""

    kind: str
    """The kind without prefix and version of Gazebo: ``hydrodynamics``."""
    name: str
    """The name or, without one, the file."""
    node: etree._Element
    """The element."""
    place: Place
    """The place in the file."""


@dataclass(frozen=True, kw_only=True)
class Model:
    """A ``<model>``, included files among them."""

    name: str
    """The name."""
    pose: FramedPose
    """The pose of the placement frame in the frame of the world or the model around it."""
    placement_frame: str
    """The frame that the pose places; empty: that of the model."""
    canonical_link: str
    """The link that carries the frame of the model; empty: the first link."""
    is_static: bool
    """True if it never moves."""
    is_merged: bool
    """True if its links are part of the model that includes it, without a prefix."""
    links: tuple[Link, ...]
    """The links."""
    joints: tuple[Joint, ...]
    """The joints."""
    frames: tuple[Frame, ...]
    """The frames."""
    models: tuple[Model, ...]
    """The nested models."""
    plugins: tuple[Plugin, ...]
    """The plug-ins."""
    file: Path
    """The file."""
    place: Place
    """The place in the file."""


@dataclass(frozen=True, kw_only=True)
class SdfWorld:
    """A ``<world>``, or a model alone."""

    name: str
    """The name."""
    models: tuple[Model, ...]
    """The models."""
    frames: tuple[Frame, ...]
    """The frames of the world."""
    plugins: tuple[Plugin, ...]
    """The plug-ins of the world."""
    is_model: bool
    """True if the file has a model without a world: the plug-ins of a world are unknown."""
    earth_origin: tuple[float, float] | None
    """The latitude and longitude of the origin [deg]; None if the file has none."""
