"""The perception of the grasp task: it estimates the pose of the box to be grasped from images.

Each image is searched by the detector until the position of the box is known. Then the top face of
the box is tracked from image to image, and the detector searches every `DETECTION_INTERVAL`-th
image, and each image in which the tracker loses the face. A track also ends if its pose is
implausible, or if the tracked corners do not fit the model of the box.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np

from ...base.deprecation import warn_old_name
from ...base.geometry import Array
from ...base.numerics.linear import transform_points
from ..esm.pyramid import Grey, to_grey
from ..tracker import Tracker, quad_error
from .box import BoxPose, BoxSpec
from .box_pose import Sighting, pose_from_face, pose_from_outline
from .camera import View
from .detector import Detector, Pixels
from .target import TargetEstimate

DETECTION_INTERVAL = 5
"""The number of images from one detection to the next during a track."""
MAX_RESIDUAL = 0.06
"""The largest residual of a plausible fit, as a fraction of the length of the box in the image [1];
a residual up to 1.2 px is always plausible."""
MIN_ZNCC = 0.6
"""The minimum ZNCC (`uwsim.algorithms.esm.alignment.zncc`) of a track; below it the track ends."""
MAX_DEVIATION = 0.02
"""The largest standard deviation of the target's position at which a track starts [m]."""
MAX_SEABED_DISTANCE = 0.25
"""The largest distance of a plausible box from the seabed [m]."""

MakeTracker = Callable[[Grey, Array], "Tracker | str"]
"""A function that makes a tracker of a quad in an image; it returns the tracker, or the reason why
the quad cannot be tracked (`Grasp.tracker`)."""


class GraspModel(Protocol):
    """The model of an object that is grasped; see `Grasp.model`."""

    def grasp_point(self, pose: BoxPose) -> Array:
        """Return the point that the jaw grasps in the navigation frame, (3,) [m]."""

    def closing_heading(self, pose: BoxPose) -> float:
        """Return the heading of the axis along which the jaw closes, modulo half a turn [rad]."""


def grasp_point_of(model: GraspModel) -> Callable[[BoxPose], Array]:
    """Return the method `GraspModel.grasp_point` of a model, or ``grip``, its deprecated name."""
    if hasattr(model, "grip"):
        warn_old_name("grip", "grasp_point")
        old_method: Callable[[BoxPose], Array] = model.grip
        return old_method
    return model.grasp_point


class ObjectPerception(Protocol):
    """An estimator of the pose of an object from images; see `Grasp.perception`."""

    def observe(
        self, image: Pixels, view: View, target: TargetEstimate, time: float
    ) -> Sighting | None:
        """Find the object in an image, and update the target (`TargetEstimate.update`).

        Args:
            image: the image, (h, w, 3) RGB.
            view: the camera's intrinsics and its pose at the time of the image.
            target: the estimate of the object's pose, which is updated.
            time: the time of the image [s].

        Returns:
            The measured pose of the object; None if the object was not found, or the measurement
            was rejected as an outlier.
        """

    def reset(self) -> None:
        """Forget earlier images, because the search restarts."""


class Perception:
    """The perception of the box.

    Args:
        detector: the detector of outlines that may be the box.
        make_tracker: the function that makes a tracker of the top face, or returns the reason why
            the face cannot be tracked.
        box: the model of the box.
    """

    def __init__(self, detector: Detector, make_tracker: MakeTracker, box: BoxSpec) -> None:
        self._detector, self._make_tracker, self._box = detector, make_tracker, box
        self._tracker: Tracker | None = None
        self._n_since_detection = 0
        self.contrast = 0.0
        """The `Outline.contrast` of the last plausible outline [1]."""

    @property
    def is_tracking(self) -> bool:
        """True if the top face is being tracked."""
        return self._tracker is not None

    def reset(self) -> None:
        """End the track."""
        self._tracker = None

    def observe(
        self, image: Pixels, view: View, target: TargetEstimate, time: float
    ) -> Sighting | None:
        """Update the target from an image; see `ObjectPerception`."""
        sighting = None
        if self._tracker is not None:
            sighting = self._track(image, view, target)
        self._n_since_detection += 1
        if sighting is None or self._n_since_detection >= DETECTION_INTERVAL:
            self._n_since_detection = 0
            detection = self.detect(image, view, target)
            if detection is not None:
                self._begin_track(image, view, target, detection)
            sighting = detection or sighting
        if sighting is None or not target.update(sighting, time):
            return None
        return sighting

    def detect(self, image: Pixels, view: View, target: TargetEstimate) -> Sighting | None:
        """Detect the box in an image; return the plausible fit of minimum residual, or None."""
        sightings = []
        for outline in self._detector.detect(image, view):
            sighting = pose_from_outline(outline, view, self._box)
            if sighting is not None and self._is_plausible(sighting, view):
                self.contrast = outline.contrast
                sightings.append(sighting)
        return min(sightings, key=lambda candidate: candidate.residual) if sightings else None

    def _is_plausible(self, sighting: Sighting, view: View) -> bool:
        position = sighting.pose.position
        distance = float(position[2] - view.navigation_from_camera.position[2])
        length = self._box.size[1] * view.pinhole.fx / max(distance, 0.1)
        if sighting.residual > max(MAX_RESIDUAL * length, 1.2):
            return False
        return abs(float(position[2]) - view.seabed_depth) < MAX_SEABED_DISTANCE and distance > 0.2

    def _begin_track(
        self, image: Pixels, view: View, target: TargetEstimate, sighting: Sighting
    ) -> None:
        if target.pose is None or target.deviation > MAX_DEVIATION or self._tracker is not None:
            return
        pose = sighting.pose
        quad = view.project(transform_points(self._box.top_face, pose.rotation, pose.position))
        height, width = image.shape[:2]
        if not np.isfinite(quad).all() or quad_error(quad, width, height):
            return
        tracker = self._make_tracker(to_grey(image), quad)
        self._tracker = None if isinstance(tracker, str) else tracker

    def _track(self, image: Pixels, view: View, target: TargetEstimate) -> Sighting | None:
        assert self._tracker is not None
        estimate = self._tracker.step(to_grey(image))
        height, width = image.shape[:2]
        is_lost = not estimate.is_found or estimate.zncc < MIN_ZNCC
        if is_lost or target.pose is None or quad_error(estimate.corners, width, height):
            self._tracker = None
            return None
        sighting = pose_from_face(estimate.corners, view, self._box, target.pose)
        if sighting is None or sighting.residual > 2.0 or not self._is_plausible(sighting, view):
            self._tracker = None
            return None
        return sighting
