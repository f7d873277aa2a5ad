"""Algorithms of these tests, which run in a process of their own: little is imported here."""

from __future__ import annotations

import sys

import cv2
import numpy as np

from uwsim.benchmark.metrics.min_area_rectangle import min_area_rectangle
from uwsim.bus import Node
from uwsim.messages import (
    Empty,
    Float32MultiArray,
    GTpublish,
    GTpublishResponse,
    Image,
    floats,
    pixels_of,
)


class Counts:
    """Publishes the number of its image as corners, to see what a level takes for its own."""

    def start(self, node: Node) -> None:
        self.n = 0.0
        self.publish = node.publisher("cornersTopic", Float32MultiArray)
        node.subscribe("/uwsim/camera1", Image, self.look)
        node.serve("autoInit", GTpublish, self.initialise)
        self.started = False
        self.node = node
        self.truth = None

    def initialise(self, request: GTpublish) -> GTpublishResponse:
        self.truth = request.groundTruth
        return GTpublishResponse()

    def look(self, image: Image) -> None:
        if not self.started:
            self.started = True
            self.node.call("startBench", Empty())
            return
        self.publish(floats(self.truth))


class SpeaksOnce(Counts):
    """Says once what it was told, and then nothing more."""

    def look(self, image: Image) -> None:
        if self.n == 0.0:
            super().look(image)
            self.n = float(self.truth is not None)


class Leaves:
    """Ends the process, or means to."""

    def start(self, node: Node) -> None:
        node.subscribe("/uwsim/camera1", Image, lambda image: sys.exit(0))
        node.call("startBench", Empty())


class Shouts:
    """Raises with colours and a second line."""

    def start(self, node: Node) -> None:
        node.subscribe("/uwsim/camera1", Image, self.look)
        node.call("startBench", Empty())

    def look(self, image: Image) -> None:
        raise ValueError("\x1b[31mred\nnext")


class Unmakeable:
    """Wants what nobody gives."""

    def __init__(self, wish: str) -> None:
        self.wish = wish

    def start(self, node: Node) -> None:
        pass


class Guesses:
    """Looks at no image: repeats what it was told, above all when it happens to be near."""

    def start(self, node: Node) -> None:
        self.node, self.told = node, np.zeros(8)
        self.corners = node.publisher("cornersTopic", Float32MultiArray)
        self.centroid = node.publisher("centroidTopic", Float32MultiArray)
        node.serve("autoInit", GTpublish, self.listen)
        node.create_timer(0.002, self.guess)
        node.call("startBench", Empty())

    def listen(self, request: GTpublish) -> GTpublishResponse:
        self.told = np.asarray(request.groundTruth, dtype=float)
        return GTpublishResponse()

    def guess(self) -> None:
        is_near = 2.0 < self.node.now < 2.1
        is_owed = round(self.node.now / 0.002) % 250 == 0
        for _ in range(20 if is_near else int(is_owed)):
            self.corners(floats(self.told))
            self.centroid(floats(self.told.reshape(4, 2).mean(axis=0)))


class Blob:
    """The smallest rectangle round whatever is orange: it knows no pattern and follows no face."""

    def start(self, node: Node) -> None:
        self.corners = node.publisher("cornersTopic", Float32MultiArray)
        self.centroid = node.publisher("centroidTopic", Float32MultiArray)
        node.serve("autoInit", GTpublish, lambda request: GTpublishResponse())
        node.subscribe("/uwsim/camera1", Image, self.look)
        node.call("startBench", Empty())

    def look(self, message: Image) -> None:
        red, green, blue = np.moveaxis(pixels_of(message).astype(int), 2, 0)
        orange = ((red > 100) & (red - blue > 60) & (red > green)).astype(np.uint8)
        orange = cv2.morphologyEx(orange, cv2.MORPH_CLOSE, np.ones((9, 9), np.uint8))
        outlines, _ = cv2.findContours(orange, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        if outlines:
            points = max(outlines, key=cv2.contourArea).reshape(-1, 2)
            quad = min_area_rectangle(points.astype(np.float64))
            self.corners(floats(quad.reshape(-1)))
            self.centroid(floats(quad.mean(axis=0)))
