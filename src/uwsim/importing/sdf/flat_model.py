"""A model of SDF without nested models: all links, joints and plug-ins, with resolved poses."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from ...base.geometry import Array, Pose
from ...base.numerics.linear import length, product
from ...errors import SceneError
from ...schema import Diagnostics, quote
from ..report import Place
from .frames import ModelFrames
from .spec import MODEL_FRAME, SEPARATOR, Inertial, Joint, Link, Model, Plugin, Sensor, Visual

WORLD = "world"
"""The name of the world as the parent of a joint."""


@dataclass(frozen=True, kw_only=True)
class FlatLink:
    """A link with the poses of its parts."""

    path: str
    """The name with those of the models around it: ``arm::wrist``."""
    model_from_link: Pose
    """The pose in the frame of the outer model."""
    inertial: Inertial
    """The mass and inertia."""
    link_from_inertial: Pose
    """The centre of mass, and the axes of the inertia."""
    visuals: tuple[tuple[Visual, Pose], ...]
    """The visible shapes, each with its pose in the frame of the link."""
    collisions: tuple[tuple[Visual, Pose], ...]
    """The shapes for contacts and buoyancy, each with its pose in the frame of the link."""
    sensors: tuple[tuple[Sensor, Pose], ...]
    """The sensors, each with its pose in the frame of the link."""
    place: Place
    """The place in the file."""


@dataclass(frozen=True, kw_only=True)
class FlatJoint:
    """A joint between two links."""

    path: str
    """The name with those of the models around it."""
    joint: Joint
    """The joint in the file."""
    parent: str
    """The path of the parent link, or `WORLD`."""
    child: str
    """The path of the child link."""
    child_from_joint: Pose
    """The frame of the joint in the frame of the child."""
    axis: Array
    """The direction of the axis in the frame of the child, a unit vector (3,)."""


@dataclass(frozen=True, kw_only=True)
class FlatPlugin:
    """A plug-in with the model whose names it uses."""

    plugin: Plugin
    """The plug-in."""
    scope: str
    """The path of that model with a separator at the end; "" for the outer model."""


@dataclass(eq=False)
class FlatModel:
    """A model and the models in it.

    Args:
        frames: the frames of the outer model.
        world_from_model: the pose of the outer model in the world.
    """

    frames: ModelFrames
    world_from_model: Pose
    links: dict[str, FlatLink] = field(default_factory=dict, init=False)
    joints: dict[str, FlatJoint] = field(default_factory=dict, init=False)
    plugins: list[FlatPlugin] = field(default_factory=list, init=False)
    _aliases: dict[str, str] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        parts = list(_walk(self.frames, "", Pose.identity()))
        for frames, scope, outer_from_model in parts:
            self._add_names(frames.model, scope)
            for link in frames.model.links:
                flat_link = _flatten_link(link, frames, scope, outer_from_model)
                self.links[flat_link.path] = flat_link
            self.plugins += [
                FlatPlugin(plugin=plugin, scope=scope) for plugin in frames.model.plugins
            ]
        for frames, scope, outer_from_model in parts:
            for joint in frames.model.joints:
                flat_joint = self._flatten_joint(joint, frames, scope, outer_from_model)
                self.joints[flat_joint.path] = flat_joint

    @property
    def model(self) -> Model:
        """The outer model."""
        return self.frames.model

    def find_link(self, name: str, scope: str) -> str | None:
        """Return the path of the link that a name in a model refers to; None if there is none.

        A frame or a joint refers to the link that carries it, a model to its first link.
        """
        path = scope + name
        for _ in range(100):
            if path in self.links:
                return path
            if path not in self._aliases:
                return None
            path = self._aliases[path]
        return None

    def find_joint(self, name: str, scope: str) -> FlatJoint | None:
        """Return the joint of a name in a model; None if there is none."""
        return self.joints.get(scope + name)

    @property
    def canonical_link(self) -> str | None:
        """The path of the link that carries the frame of the model; None without links."""
        return self.find_link(self.model.canonical_link, "") or next(iter(self.links), None)

    def _add_names(self, model: Model, scope: str) -> None:
        first_part = [*(link.name for link in model.links), *(child.name for child in model.models)]
        base = scope + (model.canonical_link or next(iter(first_part), ""))
        for frame in model.frames:
            self._aliases[scope + frame.name] = (
                scope + frame.attached_to if frame.attached_to else base
            )
        for joint in model.joints:
            self._aliases[scope + joint.name] = scope + joint.child
        if scope:
            self._aliases.setdefault(scope.removesuffix(SEPARATOR), base)
        self._aliases[scope + MODEL_FRAME] = base

    def _flatten_joint(
        self, joint: Joint, frames: ModelFrames, scope: str, outer_from_model: Pose
    ) -> FlatJoint:
        parent = WORLD if joint.parent == WORLD else self.find_link(joint.parent, scope)
        child = self.find_link(joint.child, scope)
        if parent is None or child is None:
            name = joint.parent if parent is None else joint.child
            diagnostics = Diagnostics(joint.place.file)
            names = (path.removeprefix(scope) for path in self.links if path.startswith(scope))
            diagnostics.report_unknown(
                joint.place.line,  # type: ignore[arg-type]  # a line is a location, too
                f"joint {joint.name!r}: there is no link {quote(name)}", name, names,
            )  # fmt: skip
            diagnostics.check(SceneError)
        assert parent is not None
        assert child is not None
        model_from_joint = frames.resolve(joint.pose, joint.child)
        child_from_outer = self.links[child].model_from_link.inverse()
        child_from_joint = child_from_outer @ outer_from_model @ model_from_joint
        frame = joint.axis.expressed_in
        model_from_axis = (
            frames.model_from_frame(frame, joint.place.line) if frame else model_from_joint
        )
        child_from_axis = child_from_outer @ outer_from_model @ model_from_axis
        axis = product(child_from_axis.rotation, list(joint.axis.xyz))
        return FlatJoint(
            path=scope + joint.name,
            joint=joint,
            parent=parent,
            child=child,
            child_from_joint=child_from_joint,
            axis=axis / length(axis),
        )


def _walk(
    frames: ModelFrames, scope: str, outer_from_model: Pose
) -> Iterator[tuple[ModelFrames, str, Pose]]:
    """Yield a model and all models in it, with their scope and their pose in the outer model."""
    yield frames, scope, outer_from_model
    for key, child in frames.child_frames.items():
        inner_scope = scope if child.model.is_merged else f"{scope}{child.model.name}{SEPARATOR}"
        pose = frames.nested_pose(key, child.model.place.line)
        yield from _walk(child, inner_scope, outer_from_model @ pose)


def _flatten_link(link: Link, frames: ModelFrames, scope: str, outer_from_model: Pose) -> FlatLink:
    model_from_link = frames.resolve(link.pose, MODEL_FRAME)
    link_from_model = model_from_link.inverse()

    def place(part: Visual | Sensor | Inertial) -> Pose:
        if not part.pose.relative_to:
            return part.pose.pose
        return link_from_model @ frames.resolve(part.pose, link.name)

    return FlatLink(
        path=scope + link.name,
        model_from_link=outer_from_model @ model_from_link,
        inertial=link.inertial,
        link_from_inertial=place(link.inertial),
        visuals=tuple((visual, place(visual)) for visual in link.visuals),
        collisions=tuple((collision, place(collision)) for collision in link.collisions),
        sensors=tuple((sensor, place(sensor)) for sensor in link.sensors),
        place=link.place,
    )
