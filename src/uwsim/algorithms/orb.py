"""``orb``: ORB features (Rublee et al. 2011) and a homography by MAGSAC++, by OpenCV."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.linear import determinant
from ..base.numerics.opencv import deterministic_opencv
from .direct_tracker import crossing
from .esm.alignment import zncc
from .esm.homography import between, unimodular, warp
from .esm.pyramid import Grey
from .esm.template import Template, take_template
from .tracker import Estimate, Tracker
from .tracker_node import INPUT, LOSS, TrackerNode

MARGIN = 15
"""How far from an image's rim ORB looks for features, and half its smallest patch [px]."""


class Orb(TrackerNode):
    """ORB features detected in every image, and a homography by MAGSAC++ (OpenCV)."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **INPUT,
        "features": 1000.0,
        "fast_threshold": 7.0,
        "ratio": 0.85,
        "inlier_distance": 2.0,
        "min_inliers": 8.0,
        **LOSS,
    }

    def follow(self, image: Grey, quad: Array) -> Tracker | str:
        """Remember the features inside the quad."""
        template = take_template(image, quad)
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
    """Matches the template's features in each image; remembers no motion.

    Matches are mutual nearest neighbours by Hamming distance that pass the ratio test. The random
    draws of MAGSAC begin anew from the same seed in every image.
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
            edgeThreshold=MARGIN,
            patchSize=2 * MARGIN + 1,
            fastThreshold=fast_threshold,
        )
        self._matcher = cv2.BFMatcher(cv2.NORM_HAMMING)
        self._ratio, self._min_inliers = ratio, min_inliers
        self._inlier_distance = inlier_distance
        self._template, self._quad, self._centre = template, quad, crossing(quad)
        self._homography = np.eye(3)
        mask = np.zeros(image.shape, np.uint8)
        for row, (first, last) in enumerate(template.runs):
            mask[template.top + row, template.left + first : template.left + last] = 255
        self._points, self._descriptors = self._detect(image, mask)

    @property
    def n_features(self) -> int:
        """Number of features remembered."""
        return len(self._points)

    def place(self, quad: Array) -> None:
        """Set the last estimate to ``quad``; the next image is searched as a whole all the same."""
        self._homography = between(self._quad, quad)

    @deterministic_opencv()
    def step(self, image: Grey) -> Estimate:
        """Find the patch in the next image."""
        homography = self._match(image)
        if homography is not None:
            self._homography = homography
        return Estimate(
            corners=warp(self._homography, self._quad),
            centroid=warp(self._homography, self._centre[None])[0],
            zncc=zncc(image, self._template, self._homography),
            found=homography is not None,
        )

    def _detect(self, image: Grey, mask: npt.NDArray[np.uint8] | None) -> tuple[Array, Any]:
        bytes_image = np.clip(np.rint(image), 0, 255).astype(np.uint8)
        keypoints, descriptors = self._orb.detectAndCompute(bytes_image, mask)
        points = np.array([keypoint.pt for keypoint in keypoints]).reshape(-1, 2)
        return points, descriptors

    def _match(self, image: Grey) -> Array | None:
        import cv2

        points, descriptors = self._detect(image, None)
        if len(points) < max(self._min_inliers, 2):
            return None
        there = self._matcher.knnMatch(self._descriptors, descriptors, k=2)
        back = {m.queryIdx: m.trainIdx for m in self._matcher.match(descriptors, self._descriptors)}
        pairs = [
            (best.queryIdx, best.trainIdx)
            for best, second in there
            if best.distance < self._ratio * second.distance
            and back[best.trainIdx] == best.queryIdx
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
        return unimodular(matrix) if determinant(matrix) > 1e-9 else None
