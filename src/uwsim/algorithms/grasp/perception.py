"""From an image to a sighting of the box: detector, pose, and a tracker between detections.

Every image is looked at by the detector until the target is sure; then the top face of the box is
tracked from image to image, and the detector looks at every `DETECT_EVERY`-th, or as soon as the
tracker is lost. A tracked face whose pose is far from the target, or whose corners
do not fit it, ends the track.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import transform_points
from ..esm.pyramid import Grey, to_grey
from ..tracker import Tracker, quad_error
from .box import BoxPose, BoxSpec
from .box_pose import Sighting, pose_from_face, pose_from_outline
from .camera import View
from .detector import Detector, Pixels
from .target import Target

DETECT_EVERY = 5
"""Images from one detection to the next while a track is on."""
MAX_RESIDUAL = 0.06
"""Of a fit, as a share of the length of the box in the image, and at least 1.2 px."""
MIN_ZNCC = 0.6
"""Correlation below which a track ends."""
SURE = 0.02
"""Deviation of the target at which tracking begins [m]."""
TOO_HIGH = 0.25
"""Distance of a box from the bottom beyond which it is none [m]."""

MakeTracker = Callable[[Grey, Array], "Tracker | str"]


class GraspModel(Protocol):
    """What is known of an object that is grasped; one of your own goes to `Grasp.model`."""

    def grip(self, pose: BoxPose) -> Array:
        """Return the point that the jaw takes in the navigation frame, (3,) [m]."""

    def closes(self, pose: BoxPose) -> float:
        """Return the heading of the axis along which the jaw closes, modulo half a turn [rad]."""


class ObjectPerception(Protocol):
    """What finds the object in images; one of your own goes to `Grasp.perception`."""

    def look(self, image: Pixels, view: View, target: Target, time: float) -> Sighting | None:
        """Look at an image (h, w, 3) RGB taken now, at ``time`` [s].

        Give the target what is found (`Target.take`); return the sighting if the target took it.
        """

    def forget(self) -> None:
        """Drop what is kept from earlier images: the search begins anew."""


class Perception:
    """Looks for the box in images."""

    def __init__(self, detector: Detector, make_tracker: MakeTracker, box: BoxSpec) -> None:
        self._detector, self._make_tracker, self._box = detector, make_tracker, box
        self._tracker: Tracker | None = None
        self._since_detection = 0
        self.contrast = 0.0
        """Of the last blob, in deviations of the bottom [1]."""

    @property
    def is_tracking(self) -> bool:
        """Whether a track is on."""
        return self._tracker is not None

    def forget(self) -> None:
        """End the track."""
        self._tracker = None

    def look(self, image: Pixels, view: View, target: Target, time: float) -> Sighting | None:
        """Look at an image (h, w, 3) RGB; the target takes what is found.

        Returns the sighting that the target took; None if there was none.
        """
        sighting = None
        if self._tracker is not None:
            sighting = self._track(image, view, target)
        self._since_detection += 1
        if sighting is None or self._since_detection >= DETECT_EVERY:
            self._since_detection = 0
            detected = self.detect(image, view, target)
            if detected is not None:
                self._begin_track(image, view, target, detected)
            sighting = detected or sighting
        if sighting is None or not target.take(sighting, time):
            return None
        return sighting

    def detect(self, image: Pixels, view: View, target: Target) -> Sighting | None:
        """Return the sighting of the outline that is most like the box, or None."""
        found = []
        for outline in self._detector.detect(image, view):
            sighting = pose_from_outline(outline, view, self._box)
            if sighting is not None and self._is_good(sighting, view):
                self.contrast = outline.contrast
                found.append(sighting)
        return min(found, key=lambda one: one.residual) if found else None

    def _is_good(self, sighting: Sighting, view: View) -> bool:
        place = sighting.pose.place
        distance = float(place[2] - view.navigation_from_camera.position[2])
        length = self._box.size[1] * view.pinhole.fx / max(distance, 0.1)
        if sighting.residual > max(MAX_RESIDUAL * length, 1.2):
            return False
        return abs(float(place[2]) - view.bottom) < TOO_HIGH and distance > 0.2

    def _begin_track(self, image: Pixels, view: View, target: Target, sighting: Sighting) -> None:
        if target.pose is None or target.deviation > SURE or self._tracker is not None:
            return
        pose = sighting.pose
        quad = view.project(transform_points(self._box.face, pose.rotation, pose.place))
        height, width = image.shape[:2]
        if not np.isfinite(quad).all() or quad_error(quad, width, height):
            return
        tracker = self._make_tracker(to_grey(image), quad)
        self._tracker = None if isinstance(tracker, str) else tracker

    def _track(self, image: Pixels, view: View, target: Target) -> Sighting | None:
        assert self._tracker is not None
        estimate = self._tracker.step(to_grey(image))
        height, width = image.shape[:2]
        lost = not estimate.is_found or estimate.zncc < MIN_ZNCC
        if lost or target.pose is None or quad_error(estimate.corners, width, height):
            self._tracker = None
            return None
        sighting = pose_from_face(estimate.corners, view, self._box, target.pose)
        if sighting is None or sighting.residual > 2.0 or not self._is_good(sighting, view):
            self._tracker = None
            return None
        return sighting
