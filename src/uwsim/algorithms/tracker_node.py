"""The node of all trackers: images in, corners, centroid and status out.

It subscribes to the images, offers ``autoInit`` and, after the first image, calls
``startBench``. The template is the last image inside the first quad that ``autoInit`` hands in;
every later quad is where the patch is now. A tracker that is lost says so once and stays silent
until ``autoInit`` tells it where to track again; one that could not begin has to be created anew.
Estimates carry no stamp; they are published while the image's callback runs.

Without ``autoInit`` the quad is a parameter, ``corners``, and the template the first image.
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
from .esm.pyramid import Grey, grey
from .tracker import LossTest, Tracker, quad_error

INPUT: Mapping[str, float | str] = {"image_topic": "/uwsim/camera1", "corners": ""}
"""Parameters of what it looks at: the topic of the images; x, y of the quad NW NE SE SW [px] in
the first image, eight numbers, for a benchmark in which nobody calls ``autoInit``."""
LOSS = {"zncc_threshold": 0.5, "lost_frames": 5.0}
"""Parameters of the loss test, the same in every tracker."""


class TrackerNode(abc.ABC):
    """An algorithm under test that follows a quad; a tracker adds `PARAMETERS` and `follow`."""

    PARAMETERS: ClassVar[Mapping[str, float | str]]
    """Every parameter with its default; others are refused."""

    def __init__(self) -> None:
        self._parameters: dict[str, float | str] = dict(self.PARAMETERS)
        self._image: Image | None = None
        self._quad: Array | None = None
        self._told_by = "corners"  # who gave that quad
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
        """Refuse ``corners`` that are no eight numbers, with BadSetting."""
        corners_of(parameters)

    @abc.abstractmethod
    def follow(self, image: Grey, quad: Array) -> Tracker | str:
        """Take a template of ``quad`` (4, 2) [px], or return why it cannot be tracked."""

    def loss_test(self) -> LossTest | None:
        """Make the test whether it is lost; None for one that never is."""
        return LossTest(
            zncc_threshold=self.number("zncc_threshold"),
            frames=max(int(self.number("lost_frames")), 1),
        )

    def start(self, node: Node) -> None:
        """Read the parameters and connect to the bus."""
        self._parameters = chosen(self.PARAMETERS, node.parameters)
        self._quad = corners_of(self._parameters)
        self._node = node
        self._say_status = node.publisher("algorithmStatus", String)
        self._say_corners = node.publisher("cornersTopic", Float32MultiArray)
        self._say_centroid = node.publisher("centroidTopic", Float32MultiArray)
        node.serve("autoInit", GTpublish, self._on_auto_init)
        node.subscribe(self.text("image_topic"), Image, self._on_image)

    def number(self, name: str) -> float:
        """A parameter that is a number."""
        return float(self._parameters[name])

    def text(self, name: str) -> str:
        """A parameter that is a text."""
        return str(self._parameters[name])

    def _on_image(self, message: Image) -> None:
        first = self._image is None
        self._image = message
        if first:
            self._call_start_bench()
            if self._quad is not None and self._tracker is None and not self._has_failed:
                self._begin(message, self._quad, self._told_by)
            return
        if self._tracker is None or self._is_lost:
            return
        estimate = self._tracker.step(grey(pixels_of(message)))
        if estimate.found:
            self._say_corners(floats(estimate.corners.reshape(-1)))
            self._say_centroid(floats(estimate.centroid))
        why = self._loss and self._loss.check(estimate, message.width, message.height)
        if why:
            self._lose(why)

    def _call_start_bench(self) -> None:
        try:
            self._node.call("startBench", Empty())
        except UnknownName:
            return  # the benchmark does not wait for us

    def _on_auto_init(self, request: GTpublish) -> GTpublishResponse:
        truth = np.asarray(request.groundTruth, dtype=np.float64)
        if self._has_failed:
            pass
        elif truth.shape != (8,):
            self._fail(f"autoInit gave {truth.size} numbers instead of 8")
        elif self._image is None:
            self._quad, self._told_by = truth.reshape(4, 2), "autoInit"
        elif self._tracker is None:
            self._begin(self._image, truth.reshape(4, 2), "autoInit")
        else:
            self._place(self._tracker, self._image, truth.reshape(4, 2))
        return GTpublishResponse()

    def _begin(self, message: Image, quad: Array, told_by: str) -> None:
        """Take the template."""
        why = quad_error(quad, message.width, message.height)
        tracker = why or self.follow(grey(pixels_of(message)), quad)
        if isinstance(tracker, str):
            self._fail(f"{told_by}: {tracker}")
            return
        self._tracker = tracker
        self._track()

    def _place(self, tracker: Tracker, message: Image, quad: Array) -> None:
        """Set the estimate to another quad and keep the template."""
        if why := quad_error(quad, message.width, message.height):
            self._lose(f"autoInit: {why}")
            return
        tracker.place(quad)
        self._track()

    def _track(self) -> None:
        self._is_lost = False
        self._loss = self.loss_test()
        self._say_status(String(data="tracking"))

    def _lose(self, why: str) -> None:
        self._is_lost = True
        self._say_status(String(data=f"lost: {why}"))

    def _fail(self, why: str) -> None:
        self._has_failed = True
        self._tracker = None
        self._say_status(String(data=f"failed: {why}"))


def corners_of(parameters: Mapping[str, float | str]) -> Array | None:
    """Return the parameter ``corners`` as a quad (4, 2) [px]; None where it is empty.

    Raises:
        BadSetting: it is not eight finite numbers.
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


def chosen(
    defaults: Mapping[str, float | str], given: Mapping[str, float | str]
) -> dict[str, float | str]:
    """The defaults, overridden by what was given.

    Raises:
        BadSetting: a name that is not among the defaults, or text or less than 0 for a number.
    """
    result = dict(defaults)
    for name, value in given.items():
        if name not in defaults:
            raise BadSetting(
                f"The algorithm has no parameter {name!r}.{did_you_mean(name, defaults)} "
                f"Known: {', '.join(sorted(defaults))}."
            )
        if isinstance(defaults[name], str):
            result[name] = str(value)
            continue
        try:
            result[name] = float(value)
        except ValueError:
            result[name] = math.nan
        if not 0.0 <= float(result[name]) < math.inf:
            raise BadSetting(
                f"Parameter {name!r} of the algorithm is {value!r}; expected a number >= 0."
            )
    return result
