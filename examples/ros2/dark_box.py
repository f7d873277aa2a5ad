"""Track a dark box in images: as a node of ROS 2 in lock-step, and as a class in uwsim.

    uwsim bench visibility --ros2 --client dark_box       python examples/ros2/dark_box.py
    uwsim bench visibility --algorithm examples/ros2/dark_box.py:DarkBox

Both give the same rows, because simulation time waits for the node. The corners are those of the
upright rectangle around all pixels that are darker than a threshold.
"""

import sys
from pathlib import Path

import numpy as np

MAX_GREY_LEVEL = 40
"""The grey level below which a pixel belongs to the box."""


def find_corners(data, width: int, height: int) -> list[float]:
    """Return x, y of NW, NE, SE, SW [px], or an empty list if no pixel is dark."""
    pixels = np.frombuffer(bytes(data), dtype=np.uint8).reshape(height, width, -1)
    rows, columns = np.nonzero(pixels.max(axis=2) < MAX_GREY_LEVEL)
    if not len(rows):
        return []
    west, east = float(columns.min()), float(columns.max())
    north, south = float(rows.min()), float(rows.max())
    return [west, north, east, north, east, south, west, south]


def compute_centre(corners: list[float]) -> list[float]:
    """Return x, y of the middle of the rectangle [px]."""
    west, north, east, _, _, south, _, _ = corners
    return [(west + east) / 2, (north + south) / 2]


class DarkBox:
    """The tracker as an algorithm in the process of the simulation."""

    def start(self, node) -> None:
        """Subscribe to the images; the first image starts the benchmark."""
        from uwsim.messages import Empty, Float32MultiArray, Image, floats

        self.has_begun, self.node = False, node
        publish = node.publisher("/cornersTopic", Float32MultiArray)
        publish_centre = node.publisher("/centroidTopic", Float32MultiArray)

        def track(image: Image) -> None:
            if corners := find_corners(image.data, image.width, image.height):
                publish(floats(corners))
                publish_centre(floats(compute_centre(corners)))
            if not self.has_begun:
                self.has_begun = True
                node.call("startBench", Empty())

        node.subscribe("/uwsim/camera1", Image, track)


class DarkBoxNode:
    """The tracker as a node of ROS 2."""

    def __init__(self, lockstep) -> None:
        from sensor_msgs.msg import Image
        from std_msgs.msg import Float32MultiArray

        self.has_begun, self.lockstep, self.message = False, lockstep, Float32MultiArray
        self.publish = lockstep.publisher("/cornersTopic", Float32MultiArray)
        self.publish_centre = lockstep.publisher("/centroidTopic", Float32MultiArray)
        lockstep.subscribe("/uwsim/camera1", Image, self.track)

    def track(self, image) -> None:
        """Publish corners and centre of the box; the first image starts the benchmark."""
        if corners := find_corners(image.data, image.width, image.height):
            self.publish(self.message(data=corners))
            self.publish_centre(self.message(data=compute_centre(corners)))
        if not self.has_begun:
            self.has_begun = True
            self.lockstep.call("startBench")


if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parent))
    from lockstep import run

    run("dark_box", DarkBoxNode)
