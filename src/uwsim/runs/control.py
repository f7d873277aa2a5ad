"""The control of a run: `frozen`, which ignores the images, for comparison with a tracker."""

from __future__ import annotations

from dataclasses import replace

from ..benchmark.measures import EuclideanNormSpec
from ..benchmark.updaters import chain
from ..topics.virtual_camera_to_ros_image import VirtualCameraToROSImageSpec
from .planning.plan import AlgorithmUnderTest, Plan
from .run import Run

CONTROL = "frozen"
"""The algorithm."""


def wants_control(plan: Plan) -> bool:
    """Whether `frozen` should run, too: a tracker is initialised with its target.

    Where a current drives the vehicle the algorithm steers, and `frozen` is no control.
    """
    drifts = any(updater.name == "current" for updater in chain(plan.benchmark.scene_updater))
    return plan.algorithm.name != CONTROL and not drifts and bool(_cameras(plan))


def image_topic(plan: Plan) -> str | None:
    """Image topic of the camera of the tracker's target."""
    topics = {
        interface.camera_name: interface.image_topic
        for interface in plan.scene.ros_interfaces
        if isinstance(interface, VirtualCameraToROSImageSpec)
    }
    return next((topics[camera] for camera in _cameras(plan) if camera in topics), None)


def _cameras(plan: Plan) -> list[str | None]:
    """Cameras of the targets of trackers."""
    return [
        spec.ground_truth.camera
        for spec in plan.benchmark.measures
        if isinstance(spec, EuclideanNormSpec) and spec.ground_truth.publish_on is not None
    ]


def control_of(run: Run) -> Run:
    """Return the same with `frozen`, into ``control/``."""
    from ..algorithms import load_algorithm
    from ..algorithms.tracker_node import INPUT
    from ..results.directory import CONTROL as FOLDER

    topic, usual = image_topic(run.plan), str(INPUT["image_topic"])
    is_usual = topic is None or topic.strip("/") == usual.strip("/")
    plan = replace(
        run.plan,
        algorithm=AlgorithmUnderTest(
            cls=load_algorithm(CONTROL),
            name=CONTROL,
            parameters={} if topic is None or is_usual else {"image_topic": topic},
        ),
        is_blind=True,
    )
    inputs = run.inputs.drop_algorithm()
    return Run(plan=plan, out=run.out / FOLDER, inputs=inputs, renderer="none", files=run.files)
