"""An algorithm that does what a benchmark file requires, and nothing more."""

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
"""The period of the estimates of a topic [s]."""
LENGTHS = {CornersFromCameraSpec: 8, RelativeLocationSpec: 3}


class ScriptedAlgorithm:
    """An algorithm that starts, estimates, drives ahead and stops, by the names of a file.

    ``file`` is the benchmark. Each estimate is the known truth plus ``error``; the truth is that of
    the file or autoInit, otherwise 0. ``drive`` is a topic of twists (empty: at rest), ``speed``
    the commanded speed [m/s]. ``cloud`` has the reconstructed points, x y z x y z ... A service or
    topic that stops a level is used every ``stop_after`` seconds after the start.
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
        stop_delay = float(self.parameters["stop_after"])
        start_time = node.now

        def stop() -> None:
            if node.now > start_time:
                for trigger in stops:
                    self._fire(trigger)
                for trigger in starts[1:]:
                    self._fire(trigger)

        node.create_timer(stop_delay, stop)

    def _fire(self, trigger: object) -> None:
        """Call the service of a trigger, or publish true on its topic."""
        try:
            if isinstance(trigger, ServiceSpec):
                self._node.call(trigger.target, Empty())
            elif isinstance(trigger, TopicSpec):
                self._node.publisher(trigger.target, Bool)(Bool(data=True))
        except (UnknownName, BadSetting):
            pass  # no trigger waits, or the topic has another publisher, such as a camera

    def _feed(self, spec: MeasureSpec) -> None:
        """Publish the inputs of a measure."""
        if isinstance(spec, EuclideanNormSpec):
            self._estimate(spec)
        elif isinstance(spec, PositionErrorSpec) and spec.topic is not None:
            self._publish_once(spec.topic, PoseStamped, stamped_pose(*spec.position))
        elif isinstance(spec, PathFollowingSpec) and spec.topic is not None:
            path_poses = [
                stamped_pose(0.0, 0.0, 0.0),
                stamped_pose(2.0, 0.0, 0.0),
                stamped_pose(2.0, 2.0, 0.0),
            ]
            self._publish_once(
                spec.topic, PathMessage, PathMessage(header=header(0.0), poses=path_poses)
            )
        elif isinstance(spec, Reconstruction3DSpec):
            publish = self._node.publisher(spec.topic, PointCloud2)
            cloud = np.array(str(self.parameters["cloud"]).split(), dtype=float).reshape(-1, 3)
            self._node.create_timer(PERIOD, lambda: publish(point_cloud(cloud)))

    def _publish_once(self, topic: str, type: type, message: object) -> None:
        self._node.publisher(topic, type)(message)

    def _estimate(self, spec: EuclideanNormSpec) -> None:
        truth = spec.ground_truth
        initial_truth = np.zeros(LENGTHS.get(type(truth), 2))
        if isinstance(truth, ConstantSpec):
            initial_truth = np.array(truth.values)
        latest_truth = {"truth": initial_truth}
        publish = self._node.publisher(spec.target, Float32MultiArray)
        error = float(self.parameters["error"])
        self._node.create_timer(PERIOD, lambda: publish(floats(latest_truth["truth"] + error)))
        if truth.publish_on is not None:

            def learn(request: GTpublish) -> GTpublishResponse:
                latest_truth["truth"] = np.asarray(request.groundTruth, dtype=np.float64)
                return GTpublishResponse()

            self._node.serve(truth.publish_on, GTpublish, learn)

    def _drive(self, topic: str) -> None:
        publish: Callable[[TwistStamped], None] = self._node.publisher(topic, TwistStamped)
        angular_velocity = Vector3(x=0.0, y=0.0, z=0.0)
        linear_velocity = Vector3(x=float(self.parameters["speed"]), y=0.0, z=0.0)
        self._node.create_timer(
            PERIOD,
            lambda: publish(
                TwistStamped(
                    header=header(self._node.now),
                    twist=Twist(linear=linear_velocity, angular=angular_velocity),
                )
            ),
        )


def stamped_pose(x: float, y: float, z: float) -> PoseStamped:
    """Return a pose without rotation."""
    orientation = Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
    return PoseStamped(
        header=header(0.0), pose=Pose(position=Point(x=x, y=y, z=z), orientation=orientation)
    )
