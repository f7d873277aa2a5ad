"""The frames of a model of SDF: poses that are relative to named frames.

A name in a model is a link, a joint, a frame or a nested model; ``arm::wrist`` is a name in the
nested model ``arm``. The rules are those of SDFormat 1.7 and later ("Pose frame semantics").
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from ...base.geometry import Pose
from ...errors import SceneError
from ...schema import Diagnostics, quote
from .spec import MODEL_FRAME, SEPARATOR, FramedPose, Model

MAX_CHAIN = 500
"""The greatest number of frames between a frame and the model."""


@dataclass(frozen=True, kw_only=True)
class _Entry:
    """A named frame."""

    pose: FramedPose
    """The pose."""
    default_frame: str
    """The frame of the pose, if it names none."""


@dataclass(eq=False)
class ModelFrames:
    """The poses of the named frames of a model in the frame of the model.

    Args:
        model: the model.
    """

    model: Model
    _entries: dict[str, _Entry] = field(default_factory=dict, init=False)
    _child_frames: dict[str, ModelFrames] = field(default_factory=dict, init=False)
    _poses: dict[str, Pose] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        model = self.model
        for link in model.links:
            self._entries[link.name] = _Entry(pose=link.pose, default_frame=MODEL_FRAME)
        for joint in model.joints:
            self._entries[joint.name] = _Entry(pose=joint.pose, default_frame=joint.child)
        for frame in model.frames:
            default = frame.attached_to or MODEL_FRAME
            self._entries[frame.name] = _Entry(pose=frame.pose, default_frame=default)
        for index, child in enumerate(model.models):
            is_hidden = child.is_merged or child.name in self._child_frames
            key = f"{index}{SEPARATOR}" if is_hidden else child.name
            self._child_frames[key] = ModelFrames(child)

    @property
    def child_frames(self) -> dict[str, ModelFrames]:
        """The frames of the nested models, by their names; those of merged ones are not names."""
        return self._child_frames

    def model_from_frame(self, name: str, line: int, chain: tuple[str, ...] = ()) -> Pose:
        """Return the pose of a named frame in the frame of the model.

        Raises:
            SceneError: there is no such frame, or it depends on itself.
        """
        if name in ("", MODEL_FRAME):
            return Pose.identity()
        if name not in self._poses:
            if name in chain or len(chain) > MAX_CHAIN:
                self._fail(line, f"the pose of {quote(name)} depends on itself")
            self._poses[name] = self._find(name, line, (*chain, name))
        return self._poses[name]

    def resolve(self, pose: FramedPose, default_frame: str, chain: tuple[str, ...] = ()) -> Pose:
        """Return a pose in the frame of the model."""
        frame = pose.relative_to or default_frame
        return self.model_from_frame(frame, pose.line, chain) @ pose.pose

    def nested_pose(self, name: str, line: int, chain: tuple[str, ...] = ()) -> Pose:
        """Return the pose of a nested model in the frame of the model."""
        frames = self._child_frames[name]
        pose = self.resolve(frames.model.pose, MODEL_FRAME, chain)
        placement_frame = frames.model.placement_frame
        return pose @ frames.model_from_frame(placement_frame, line).inverse()

    def _find(self, name: str, line: int, chain: tuple[str, ...]) -> Pose:
        if (entry := self._entries.get(name)) is not None:
            return self.resolve(entry.pose, entry.default_frame, chain)
        head, _, tail = name.partition(SEPARATOR)
        if head in self._child_frames:
            pose = self.nested_pose(head, line, chain)
            return pose @ self._child_frames[head].model_from_frame(tail, line) if tail else pose
        for key, frames in self._child_frames.items():
            if frames.model.is_merged and frames.has_frame(name):
                return self.nested_pose(key, line, chain) @ frames.model_from_frame(name, line)
        diagnostics = Diagnostics(self.model.place.file)
        diagnostics.report_unknown(
            line,  # type: ignore[arg-type]  # a line is a location, too
            f"model {self.model.name!r} has no frame {quote(name)}",
            name,
            self.names(),
        )
        diagnostics.check(SceneError)
        raise AssertionError("an error was reported")

    def has_frame(self, name: str) -> bool:
        """Return whether the model has a frame of this name."""
        head, _, tail = name.partition(SEPARATOR)
        if head in self._child_frames:
            return not tail or self._child_frames[head].has_frame(tail)
        merged_frames = (frames for frames in self._child_frames.values() if frames.model.is_merged)
        return name in self._entries or any(frames.has_frame(name) for frames in merged_frames)

    def names(self) -> Iterator[str]:
        """Yield the names of the frames."""
        yield from self._entries
        for name, frames in self._child_frames.items():
            if frames.model.is_merged:
                yield from frames.names()
            else:
                yield name

    def _fail(self, line: int, message: str) -> None:
        diagnostics = Diagnostics(self.model.place.file)
        diagnostics.error(line or None, message)
        diagnostics.check(SceneError)
