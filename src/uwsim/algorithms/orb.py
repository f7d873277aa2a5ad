"""``orb``: a tracker by ORB features (Rublee et al. 2011) and a homography (MAGSAC++)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.linear import determinant
from ..base.numerics.opencv import deterministic_opencv
from .direct_tracker import diagonal_intersection
from .esm.alignment import zncc
from .esm.homography import homography_between, normalize_determinant, warp
from .esm.pyramid import Grey
from .esm.template import Template, extract_template
from .tracker import Estimate, Tracker
from .tracker_node import INPUT_PARAMETERS, LOSS_PARAMETERS, TrackerNode

EDGE_MARGIN = 15
"""The width of the border of an image without features; half ORB's smallest patch [px]."""


class Orb(TrackerNode):
    """ORB features detected in every image, and a homography by MAGSAC++ (OpenCV)."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **INPUT_PARAMETERS,
        "features": 1000.0,
        "fast_threshold": 7.0,
        "ratio": 0.85,
        "inlier_distance": 2.0,
        "min_inliers": 8.0,
        **LOSS_PARAMETERS,
    }

    def make_tracker(self, image: Grey, quad: Array) -> Tracker | str:
        """Make a tracker with the features inside ``quad`` (4, 2) [px]."""
        template = extract_template(image, quad)
        if template is None:
            return "the quad is smaller than 8 px or has no contrast"
        tracker = OrbTracker(
            image,
            template,
            quad,
            features=int(self.number("features")),
            fast_threshold=int(self.number("fast_threshold")),
            ratio=self.number("ratio"),
            inlier_distance=self.number("inlier_distance"),
            min_inliers=int(self.number("min_inliers")),
        )
        if tracker.n_features < self.number("min_inliers"):
            return f"only {tracker.n_features} ORB features in the quad"
        return tracker


class OrbTracker(Tracker):
    """A tracker that matches the template's features with those of each image.

    There is no motion model: the whole image is searched. Two features match if each is the nearest
    neighbour of the other by Hamming distance, and if they pass the ratio test. The random
    generator of MAGSAC++ has the same seed in every image.

    Args:
        image: the image of the template, (h, w) [grey level].
        template: the template of the quad.
        quad: the corners of the patch, (4, 2) [px].
        features: the greatest number of features in an image.
        fast_threshold: the minimum brightness step of a feature [grey level].
        ratio: the greatest ratio of the distances of the nearest and the second nearest neighbour.
        inlier_distance: the greatest distance of an inlier from the homography [px].
        min_inliers: the minimum number of inliers of a homography.
    """

    @deterministic_opencv()
    def __init__(
        self,
        image: Grey,
        template: Template,
        quad: Array,
        *,
        features: int,
        fast_threshold: int,
        ratio: float,
        inlier_distance: float,
        min_inliers: int,
    ) -> None:
        import cv2

        self._orb = cv2.ORB.create(
            nfeatures=features,
            edgeThreshold=EDGE_MARGIN,
            patchSize=2 * EDGE_MARGIN + 1,
            fastThreshold=fast_threshold,
        )
        self._matcher = cv2.BFMatcher(cv2.NORM_HAMMING)
        self._ratio, self._min_inliers = ratio, min_inliers
        self._inlier_distance = inlier_distance
        self._template, self._quad, self._centre = template, quad, diagonal_intersection(quad)
        self._homography = np.eye(3)
        mask = np.zeros(image.shape, np.uint8)
        for row, (start, end) in enumerate(template.runs):
            mask[template.top + row, template.left + start : template.left + end] = 255
        self._points, self._descriptors = self._detect(image, mask)

    @property
    def n_features(self) -> int:
        """The number of features of the template."""
        return len(self._points)

    def set_quad(self, quad: Array) -> None:
        """Set the last estimate to ``quad`` (4, 2) [px]; it does not affect `step`."""
        self._homography = homography_between(self._quad, quad)

    @deterministic_opencv()
    def step(self, image: Grey) -> Estimate:
        """Find the patch in the next image (h, w) [grey level]."""
        homography = self._match(image)
        if homography is not None:
            self._homography = homography
        return Estimate(
            corners=warp(self._homography, self._quad),
            centroid=warp(self._homography, self._centre[None])[0],
            zncc=zncc(image, self._template, self._homography),
            is_found=homography is not None,
        )

    def _detect(self, image: Grey, mask: npt.NDArray[np.uint8] | None) -> tuple[Array, Any]:
        """Return the positions (n, 2) [px] and the descriptors of the features in an image."""
        image_8bit = np.clip(np.rint(image), 0, 255).astype(np.uint8)
        keypoints, descriptors = self._orb.detectAndCompute(image_8bit, mask)
        points = np.array([keypoint.pt for keypoint in keypoints]).reshape(-1, 2)
        return points, descriptors

    def _match(self, image: Grey) -> Array | None:
        """Return the homography from the template's image to an image; None if there is none."""
        import cv2

        points, descriptors = self._detect(image, None)
        if len(points) < max(self._min_inliers, 2):
            return None
        neighbours = self._matcher.knnMatch(self._descriptors, descriptors, k=2)
        reverse_matches = self._matcher.match(descriptors, self._descriptors)
        query_indices = {match.queryIdx: match.trainIdx for match in reverse_matches}
        pairs = [
            (nearest_match.queryIdx, nearest_match.trainIdx)
            for nearest_match, second_match in neighbours
            if nearest_match.distance < self._ratio * second_match.distance
            and query_indices[nearest_match.trainIdx] == nearest_match.queryIdx
        ]
        if len(pairs) < self._min_inliers:
            return None
        index = np.array(pairs)
        cv2.setRNGSeed(0)
        matrix, inliers = cv2.findHomography(
            self._points[index[:, 0]],
            points[index[:, 1]],
            cv2.USAC_MAGSAC,
            self._inlier_distance,
        )
        if matrix is None or int(inliers.sum()) < self._min_inliers:
            return None
        return normalize_determinant(matrix) if determinant(matrix) > 1e-9 else None
