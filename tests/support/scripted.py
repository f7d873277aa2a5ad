"""An algorithm that does what a benchmark file asks of whoever is tested, and nothing more."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import ClassVar

import numpy as np

from uwsim.benchmark.ground_truth import ConstantSpec, CornersFromCameraSpec, RelativeLocationSpec
from uwsim.benchmark.measures import (
    EuclideanNormSpec,
    MeasureSpec,
    PathFollowingSpec,
    PositionErrorSpec,
    Reconstruction3DSpec,
)
from uwsim.benchmark.reader import read_benchmark
from uwsim.benchmark.triggers import ServiceSpec, TopicSpec
from uwsim.bus import Node
from uwsim.errors import BadSetting, UnknownName
from uwsim.messages import (
    Bool,
    Empty,
    Float32MultiArray,
    GTpublish,
    GTpublishResponse,
    Point,
    PointCloud2,
    Pose,
    PoseStamped,
    Quaternion,
    Twist,
    TwistStamped,
    Vector3,
    floats,
    header,
    point_cloud,
)
from uwsim.messages import Path as PathMessage

PERIOD = 0.1
"""Between two estimates of one topic [s]."""
LENGTHS = {CornersFromCameraSpec: 8, RelativeLocationSpec: 3}


class Scripted:
    """Starts, estimates, drives ahead, and stops, by the names that the file gives.

    ``file`` is the benchmark. It says ``error`` more, in each number, than the truth it knows: what
    the file or autoInit gives, else 0. ``drive`` is a topic of twists (none: it stands), ``speed``
    what it says there. ``cloud`` are the points that it reconstructs, x y z x y z ... A service or
    topic that stops a level is used ``stop_after`` seconds after the start, and again and again.
    """

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "file": "",
        "error": 0.0,
        "drive": "",
        "speed": 1.0,
        "cloud": "0 0 1 0 0 1.1",
        "stop_after": 1.0,
    }

    def start(self, node: Node) -> None:
        self._node = node
        self.parameters = {**self.PARAMETERS, **node.parameters}
        spec = read_benchmark(Path(str(self.parameters["file"])))
        for measure in spec.measures:
            self._feed(measure)
        if drive := str(self.parameters["drive"]):
            self._drive(drive)
        starts = [spec.start_on, *(measure.start_on for measure in spec.measures)]
        stops = [spec.stop_on, *(measure.stop_on for measure in spec.measures)]
        for trigger in starts:
            self._fire(trigger)
        again = float(self.parameters["stop_after"])
        begun = node.now

        def stop() -> None:
            if node.now > begun:
                for trigger in stops:
                    self._fire(trigger)
                for trigger in starts[1:]:
                    self._fire(trigger)

        node.create_timer(again, stop)

    def _fire(self, trigger: object) -> None:
        """Call the service, or say yes on the topic, that a trigger waits for."""
        try:
            if isinstance(trigger, ServiceSpec):
                self._node.call(trigger.target, Empty())
            elif isinstance(trigger, TopicSpec):
                self._node.publisher(trigger.target, Bool)(Bool(data=True))
        except (UnknownName, BadSetting):
            pass  # nobody waits just now; or the topic is somebody else's, as a camera's is

    def _feed(self, spec: MeasureSpec) -> None:
        """Publish what a measure listens to."""
        if isinstance(spec, EuclideanNormSpec):
            self._estimate(spec)
        elif isinstance(spec, PositionErrorSpec) and spec.topic is not None:
            self._once(spec.topic, PoseStamped, stamped(*spec.position))
        elif isinstance(spec, PathFollowingSpec) and spec.topic is not None:
            ahead = [stamped(0.0, 0.0, 0.0), stamped(2.0, 0.0, 0.0), stamped(2.0, 2.0, 0.0)]
            self._once(spec.topic, PathMessage, PathMessage(header=header(0.0), poses=ahead))
        elif isinstance(spec, Reconstruction3DSpec):
            publish = self._node.publisher(spec.topic, PointCloud2)
            cloud = np.array(str(self.parameters["cloud"]).split(), dtype=float).reshape(-1, 3)
            self._node.create_timer(PERIOD, lambda: publish(point_cloud(cloud)))

    def _once(self, topic: str, type: type, message: object) -> None:
        self._node.publisher(topic, type)(message)

    def _estimate(self, spec: EuclideanNormSpec) -> None:
        truth = spec.ground_truth
        known = np.zeros(LENGTHS.get(type(truth), 2))
        if isinstance(truth, ConstantSpec):
            known = np.array(truth.values)
        told = {"truth": known}
        publish = self._node.publisher(spec.target, Float32MultiArray)
        error = float(self.parameters["error"])
        self._node.create_timer(PERIOD, lambda: publish(floats(told["truth"] + error)))
        if truth.publish_on is not None:

            def learn(request: GTpublish) -> GTpublishResponse:
                told["truth"] = np.asarray(request.groundTruth, dtype=np.float64)
                return GTpublishResponse()

            self._node.serve(truth.publish_on, GTpublish, learn)

    def _drive(self, topic: str) -> None:
        publish: Callable[[TwistStamped], None] = self._node.publisher(topic, TwistStamped)
        still = Vector3(x=0.0, y=0.0, z=0.0)
        ahead = Vector3(x=float(self.parameters["speed"]), y=0.0, z=0.0)
        self._node.create_timer(
            PERIOD,
            lambda: publish(
                TwistStamped(
                    header=header(self._node.now), twist=Twist(linear=ahead, angular=still)
                )
            ),
        )


def stamped(x: float, y: float, z: float) -> PoseStamped:
    """A pose that is not turned."""
    turn = Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
    return PoseStamped(
        header=header(0.0), pose=Pose(position=Point(x=x, y=y, z=z), orientation=turn)
    )
