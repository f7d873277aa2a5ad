"""The base class of tracking algorithms, which connects a `Tracker` to topics and services.

A tracking algorithm subscribes to images, offers the service ``autoInit`` and, after the first
image, calls ``startBench``. The first quad that ``autoInit`` receives selects the template in the
last image; every later quad is the present position of the patch. The algorithm publishes corners,
centroid and its status. When it has lost the patch, it publishes the loss once, and no estimates
until the next call of ``autoInit``. If it cannot track the first quad, it never restarts. Estimates
have no stamp; they are published while the callback of the image runs.

Without ``autoInit`` the first quad is the parameter ``corners``, in the first image.
"""

from __future__ import annotations

import abc
import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ..base.geometry import Array
from ..bus import Node
from ..errors import BadSetting, UnknownName, did_you_mean
from ..messages import (
    Empty,
    Float32MultiArray,
    GTpublish,
    GTpublishResponse,
    Image,
    String,
    floats,
    pixels_of,
)
from .esm.pyramid import Grey, to_grey
from .tracker import LossTest, Tracker, quad_error

INPUT_PARAMETERS: Mapping[str, float | str] = {"image_topic": "/uwsim/camera1", "corners": ""}
"""The parameters for the input, with their defaults.

``image_topic`` is the topic of the images. ``corners`` is the quad in the first image, for a
benchmark that does not call ``autoInit``: x, y of NW NE SE SW [px], eight numbers."""
LOSS_PARAMETERS = {"zncc_threshold": 0.5, "lost_frames": 5.0}
"""The parameters of the `LossTest`, with their defaults."""


class TrackerNode(abc.ABC):
    """An algorithm that tracks a quad; derived classes define `PARAMETERS` and `make_tracker`."""

    PARAMETERS: ClassVar[Mapping[str, float | str]]
    """The parameters with their defaults; other names are rejected."""

    def __init__(self) -> None:
        self._parameters: dict[str, float | str] = dict(self.PARAMETERS)
        self._image: Image | None = None
        self._quad: Array | None = None
        self._quad_source = "corners"  # the parameter, or the service "autoInit"
        self._tracker: Tracker | None = None
        self._loss: LossTest | None = None
        self._is_lost = False
        self._has_failed = False

    @property
    def parameters(self) -> Mapping[str, float | str]:
        """The parameters in force, after `start`."""
        return dict(self._parameters)

    @staticmethod
    def check_parameters(parameters: Mapping[str, float | str]) -> None:
        """Raise BadSetting if ``corners`` is not eight numbers."""
        parse_corners(parameters)

    @abc.abstractmethod
    def make_tracker(self, image: Grey, quad: Array) -> Tracker | str:
        """Make a tracker of a quad.

        Args:
            image: the image of the template, (h, w) [grey level].
            quad: the corners of the patch, (4, 2) [px].

        Returns:
            The tracker, or a text with the reason why the patch cannot be tracked.
        """

    def loss_test(self) -> LossTest | None:
        """Make the loss test; None for an algorithm that is never lost."""
        return LossTest(
            zncc_threshold=self.number("zncc_threshold"),
            frames=max(int(self.number("lost_frames")), 1),
        )

    def start(self, node: Node) -> None:
        """Read the parameters, and connect to topics and services."""
        self._parameters = merge_parameters(self.PARAMETERS, node.parameters)
        self._quad = parse_corners(self._parameters)
        self._node = node
        self._publish_status = node.publisher("algorithmStatus", String)
        self._publish_corners = node.publisher("cornersTopic", Float32MultiArray)
        self._publish_centroid = node.publisher("centroidTopic", Float32MultiArray)
        node.serve("autoInit", GTpublish, self._on_auto_init)
        node.subscribe(self.text("image_topic"), Image, self._on_image)

    def number(self, name: str) -> float:
        """Return a parameter as a number."""
        return float(self._parameters[name])

    def text(self, name: str) -> str:
        """Return a parameter as text."""
        return str(self._parameters[name])

    def _on_image(self, message: Image) -> None:
        is_first = self._image is None
        self._image = message
        if is_first:
            self._call_start_bench()
            if self._quad is not None and self._tracker is None and not self._has_failed:
                self._start_track(message, self._quad, self._quad_source)
            return
        if self._tracker is None or self._is_lost:
            return
        estimate = self._tracker.step(to_grey(pixels_of(message)))
        if estimate.is_found:
            self._publish_corners(floats(estimate.corners.reshape(-1)))
            self._publish_centroid(floats(estimate.centroid))
        reason = self._loss and self._loss.check(estimate, message.width, message.height)
        if reason:
            self._report_loss(reason)

    def _call_start_bench(self) -> None:
        try:
            self._node.call("startBench", Empty())
        except UnknownName:
            return  # the benchmark does not wait for the call

    def _on_auto_init(self, request: GTpublish) -> GTpublishResponse:
        values = np.asarray(request.groundTruth, dtype=np.float64)
        if self._has_failed:
            pass
        elif values.shape != (8,):
            self._report_failure(f"autoInit gave {values.size} numbers instead of 8")
        elif self._image is None:
            self._quad, self._quad_source = values.reshape(4, 2), "autoInit"
        elif self._tracker is None:
            self._start_track(self._image, values.reshape(4, 2), "autoInit")
        else:
            self._set_quad(self._tracker, self._image, values.reshape(4, 2))
        return GTpublishResponse()

    def _start_track(self, message: Image, quad: Array, source: str) -> None:
        reason = quad_error(quad, message.width, message.height)
        tracker = reason or self.make_tracker(to_grey(pixels_of(message)), quad)
        if isinstance(tracker, str):
            self._report_failure(f"{source}: {tracker}")
            return
        self._tracker = tracker
        self._report_tracking()

    def _set_quad(self, tracker: Tracker, message: Image, quad: Array) -> None:
        if reason := quad_error(quad, message.width, message.height):
            self._report_loss(f"autoInit: {reason}")
            return
        tracker.set_quad(quad)
        self._report_tracking()

    def _report_tracking(self) -> None:
        self._is_lost = False
        self._loss = self.loss_test()
        self._publish_status(String(data="tracking"))

    def _report_loss(self, reason: str) -> None:
        self._is_lost = True
        self._publish_status(String(data=f"lost: {reason}"))

    def _report_failure(self, reason: str) -> None:
        self._has_failed = True
        self._tracker = None
        self._publish_status(String(data=f"failed: {reason}"))


def parse_corners(parameters: Mapping[str, float | str]) -> Array | None:
    """Parse the parameter ``corners`` as a quad (4, 2) [px]; None if it is empty.

    Raises:
        BadSetting: the parameter is not eight finite numbers.
    """
    text = str(parameters.get("corners", ""))
    if not text.strip():
        return None
    try:
        numbers = np.array([float(word) for word in text.replace(",", " ").split()])
    except ValueError:
        numbers = np.empty(0)
    if numbers.shape != (8,) or not np.isfinite(numbers).all():
        raise BadSetting(
            f"Parameter 'corners' of the algorithm is {text!r}; expected eight numbers: x, y of "
            "the corners NW NE SE SW [px]."
        )
    return numbers.reshape(4, 2)


def merge_parameters(
    defaults: Mapping[str, float | str], parameters: Mapping[str, float | str]
) -> dict[str, float | str]:
    """Return the defaults, replaced by the parameters of the user where these exist.

    Raises:
        BadSetting: a name has no default, or a number is negative or text.
    """
    settings = dict(defaults)
    for name, value in parameters.items():
        if name not in defaults:
            raise BadSetting(
                f"The algorithm has no parameter {name!r}.{did_you_mean(name, defaults)} "
                f"Known: {', '.join(sorted(defaults))}."
            )
        if isinstance(defaults[name], str):
            settings[name] = str(value)
            continue
        try:
            settings[name] = float(value)
        except ValueError:
            settings[name] = math.nan
        if not 0.0 <= float(settings[name]) < math.inf:
            raise BadSetting(
                f"Parameter {name!r} of the algorithm is {value!r}; expected a number >= 0."
            )
    return settings
