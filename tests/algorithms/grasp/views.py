"""A camera over a box, and images of it that are drawn with polygons."""

import cv2
import numpy as np

from uwsim.algorithms.grasp.box import BoxPose, BoxSpec
from uwsim.algorithms.grasp.camera import Pinhole, View
from uwsim.base.geometry import Pose, rotation_from_rpy
from uwsim.base.numerics.linear import transform_points

PINHOLE = Pinhole(fx=207.8, fy=207.8, cx=159.5, cy=119.5, width=320, height=240)
BOX = BoxSpec()
BOTTOM = 5.0
ORANGE, SAND = (247, 107, 18), (120, 118, 100)


def view(height: float = 1.5, tilt: float = 0.5) -> View:
    """From a height over the bottom, tilted aft; the top of the image is north."""
    down = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    rotation = rotation_from_rpy(0.0, -tilt, 0.0) @ down
    return View(
        pinhole=PINHOLE,
        navigation_from_camera=Pose(np.array([0.0, 0.0, BOTTOM - height]), rotation),
        seabed_depth=BOTTOM,
    )


def pose(x: float, y: float, heading: float) -> BoxPose:
    return BoxPose(position=np.array([x, y, BOTTOM - 0.07]), heading=heading)


def faces(where: BoxPose, seen: View) -> list[np.ndarray]:
    """Top and, where the camera sees them, the long sides, in the image."""
    x, y, z = BOX.corners.max(axis=0)
    camera = where.rotation.T @ (seen.navigation_from_camera.position - where.position)
    shown = [BOX.top_face]
    for sign in (-1.0, 1.0):
        if sign * camera[0] > x:
            side = [(sign * x, a, b) for a, b in ((-y, z), (y, z), (y, -z), (-y, -z))]
            shown.append(np.array(side))
    return [seen.project(transform_points(one, where.rotation, where.position)) for one in shown]


def draw(where: BoxPose | None, seen: View, *, fog: float = 1.0, seed: int = 0) -> np.ndarray:
    """An image (240, 320, 3); ``fog`` is the transmission."""
    image = np.full((240 * 4, 320 * 4, 3), SAND, np.uint8)
    if where is not None:
        for face in faces(where, seen):
            corners = np.rint(face * 4.0 + 1.5).astype(np.int32)
            cv2.fillConvexPoly(image, corners, ORANGE)
    small = cv2.resize(image, (320, 240), interpolation=cv2.INTER_AREA).astype(float)
    veiled = fog * small + (1.0 - fog) * np.array([5.0, 33.0, 43.0])
    noise = np.random.Generator(np.random.Philox(seed)).normal(0.0, 2.5, veiled.shape)
    return np.clip(np.rint(veiled + noise), 0, 255).astype(np.uint8)
