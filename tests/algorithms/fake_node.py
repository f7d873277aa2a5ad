"""A node on a desk: what an algorithm published, and the images we hand it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from uwsim.errors import UnknownName
from uwsim.messages import Float32MultiArray, GTpublish, Image, String, image


class FakeNode:
    def __init__(self, *, parameters: Mapping[str, float | str] | None = None) -> None:
        self.parameters: Mapping[str, float | str] = parameters or {}
        self.now = 0.0
        self.rng = np.random.Generator(np.random.Philox(0))
        self.published: list[tuple[str, Any]] = []
        self.readers: dict[str, Callable[[Any], None]] = {}
        self.services: dict[str, Callable[[Any], object]] = {}
        self.calls: list[str] = []
        self.known_services: dict[str, Callable[[Any], object]] = {"startBench": lambda _: None}

    def subscribe(self, topic: str, type: type[Any], callback: Callable[[Any], None]) -> None:
        self.readers[topic] = callback

    def publisher(self, topic: str, type: type[Any]) -> Callable[[Any], None]:
        def publish(message: Any) -> None:
            assert isinstance(message, type)
            self.published.append((topic, message))

        return publish

    def serve(self, name: str, type: type[Any], handler: Callable[[Any], object]) -> None:
        self.services[name] = handler

    def call(self, name: str, request: object) -> object:
        if name not in self.known_services:
            raise UnknownName("service", name, self.known_services)
        self.calls.append(name)
        return self.known_services[name](request)

    def create_timer(self, period_s: float, callback: Callable[[], None]) -> None:
        raise NotImplementedError

    def show(self, pixels: np.ndarray, topic: str = "/uwsim/camera1") -> None:
        """Hand an image over, of grey levels or RGB, rounded to 8 bits."""
        if pixels.dtype != np.uint8:
            pixels = np.clip(np.rint(pixels), 0, 255).astype(np.uint8)
        message: Image = image(pixels, time=self.now)
        self.readers[topic](message)
        self.now += 0.03

    def auto_init(self, quad: np.ndarray) -> None:
        self.services["autoInit"](GTpublish(np.asarray(quad, dtype=np.float32).reshape(-1)))

    @property
    def statuses(self) -> list[str]:
        return [m.data for t, m in self.published if isinstance(m, String)]

    @property
    def corners(self) -> list[np.ndarray]:
        return [m.data.reshape(4, 2) for t, m in self.published if t == "cornersTopic"]

    @property
    def centroids(self) -> list[np.ndarray]:
        return [m.data for t, m in self.published if t == "centroidTopic"]

    def messages(self, topic: str) -> list[Float32MultiArray]:
        return [m for t, m in self.published if t == topic]
