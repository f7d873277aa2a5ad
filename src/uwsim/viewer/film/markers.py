"""Spawned markers over the images of a film, as lines and names."""

from __future__ import annotations

import itertools
from collections.abc import Mapping

import numpy as np
from PIL import Image, ImageDraw

from ...base.geometry import Array, Intrinsics, Pose
from ...results.motion import DrawnMarker
from . import overlay
from .overlay import Pixels

CLOSE = 0.02
"""Lines are cut so far ahead of the viewer [m]."""
FAR = 20_000.0
"""Pixels farther from the image's corner are moved here [px]."""


def draw_markers(
    frame: Pixels,
    markers: Mapping[str, DrawnMarker],
    world_from_camera: Pose,
    lens: Intrinsics,
    letters: int,
) -> Pixels:
    """Return an image with its markers: their lines, or the names of those that have none.

    Args:
        frame: (h, w, 3).
        markers: name -> how it is drawn.
        world_from_camera: where the viewer is; OpenGL axes.
        lens: the pinhole.
        letters: their size [px].
    """
    if not markers:
        return frame
    picture = Image.fromarray(frame)
    pen = ImageDraw.Draw(picture)
    words: list[tuple[str, Array, str]] = []
    for name, look in markers.items():
        world_from_marker = Pose.from_quaternion(np.array(look.pose[:3]), np.array(look.pose[3:]))
        camera_from_marker = world_from_camera.inverse() @ world_from_marker
        for line in look.lines:
            for begin, end in ahead(camera_from_marker.transform(np.array(line))):
                ends = np.clip(lens.project(np.stack([begin, end])), -FAR, FAR)
                pen.line([tuple(each) for each in ends.tolist()], fill=look.colour, width=2)
        if not look.lines and camera_from_marker.position[2] < -CLOSE:
            words.append((name, lens.project(camera_from_marker.position[None])[0], look.colour))
    for name, place, colour in words:
        u, v = (float(value) for value in np.clip(place, -FAR, FAR))
        pen.ellipse((u - 3, v - 3, u + 3, v + 3), fill=colour)
        at = u + 5.0, v - 5.0 - letters
        pen.text(
            at, name, fill=colour, font=overlay.font(letters), stroke_width=1, stroke_fill="#0c141e"
        )
    return np.asarray(picture).copy()


def ahead(points: Array) -> list[tuple[Array, Array]]:
    """Return the parts of a line (n, 3) in the camera's frame that are ahead of the camera."""
    parts = []
    for begin, end in itertools.pairwise(points):
        depths = -begin[2] - CLOSE, -end[2] - CLOSE
        if max(depths) <= 0.0:
            continue
        share = depths[0] / (depths[0] - depths[1]) if min(depths) < 0.0 else 0.0
        between = begin + share * (end - begin)
        parts.append((between if depths[0] < 0.0 else begin, between if depths[1] < 0.0 else end))
    return parts
