"""Drawing of markers that programs added over the images of a film, as lines and names."""

from __future__ import annotations

import itertools
from collections.abc import Mapping

import numpy as np
from PIL import Image, ImageDraw

from ...base.geometry import Array, Intrinsics, Pose
from ...results.motion import DrawnMarker
from . import overlay
from .overlay import Pixels

NEAR_DISTANCE = 0.02
"""The depth in front of the camera at which lines are cut off [m]."""
MAX_PIXEL = 20_000.0
"""The absolute value to which image coordinates are clipped [px]."""


def draw_markers(
    frame: Pixels,
    markers: Mapping[str, DrawnMarker],
    world_from_camera: Pose,
    intrinsics: Intrinsics,
    letter_height: int,
) -> Pixels:
    """Return an image with markers: their lines, or a dot and the name of a marker without lines.

    Args:
        frame: the image, (h, w, 3).
        markers: the markers by their names.
        world_from_camera: the pose of the camera; OpenGL axes.
        intrinsics: the intrinsics of the camera.
        letter_height: the height of the letters [px].
    """
    if not markers:
        return frame
    image = Image.fromarray(frame)
    pen = ImageDraw.Draw(image)
    labels: list[tuple[str, Array, str]] = []  # name, image coordinates [px], colour
    for name, marker in markers.items():
        position, quaternion = np.array(marker.pose[:3]), np.array(marker.pose[3:])
        world_from_marker = Pose.from_quaternion(position, quaternion)
        camera_from_marker = world_from_camera.inverse() @ world_from_marker
        for line in marker.lines:
            for begin, end in clip_line(camera_from_marker.transform(np.array(line))):
                ends = np.clip(intrinsics.project(np.stack([begin, end])), -MAX_PIXEL, MAX_PIXEL)
                pen.line([tuple(point) for point in ends.tolist()], fill=marker.colour, width=2)
        if not marker.lines and camera_from_marker.position[2] < -NEAR_DISTANCE:
            pixel = intrinsics.project(camera_from_marker.position[None])[0]
            labels.append((name, pixel, marker.colour))
    for name, pixel, colour in labels:
        u, v = (float(value) for value in np.clip(pixel, -MAX_PIXEL, MAX_PIXEL))
        pen.ellipse((u - 3, v - 3, u + 3, v + 3), fill=colour)
        corner = u + 5.0, v - 5.0 - letter_height
        font = overlay.font(letter_height)
        pen.text(corner, name, fill=colour, font=font, stroke_width=1, stroke_fill="#0c141e")
    return np.asarray(image).copy()


def clip_line(points: Array) -> list[tuple[Array, Array]]:
    """Return the segments of a line in front of the camera, cut off at `NEAR_DISTANCE`.

    Args:
        points: the points of the line in the camera's frame (OpenGL axes), (n, 3) [m].
    """
    parts = []
    for begin, end in itertools.pairwise(points):
        clearances = -begin[2] - NEAR_DISTANCE, -end[2] - NEAR_DISTANCE
        if max(clearances) <= 0.0:
            continue
        total = clearances[0] - clearances[1]
        fraction = clearances[0] / total if min(clearances) < 0.0 else 0.0
        cut = begin + fraction * (end - begin)
        parts.append((cut if clearances[0] < 0.0 else begin, cut if clearances[1] < 0.0 else end))
    return parts
