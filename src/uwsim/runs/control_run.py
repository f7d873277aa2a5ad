"""The control run of a run: a baseline with `frozen`, an algorithm that ignores the images."""

from __future__ import annotations

from dataclasses import replace

from ..benchmark.measures import EuclideanNormSpec
from ..benchmark.updaters import chain
from ..topics.virtual_camera_to_ros_image import VirtualCameraToROSImageSpec
from .planning.plan import AlgorithmUnderTest, Plan
from .run import Run

CONTROL_ALGORITHM = "frozen"
"""The name of the algorithm of the control run."""


def needs_control_run(plan: Plan) -> bool:
    """Return whether a plan needs a control run: its benchmark initialises a tracker.

    Where a current drives the vehicle, the algorithm steers, and `frozen` is no baseline.
    """
    is_driven = any(updater.name == "current" for updater in chain(plan.benchmark.scene_updater))
    return plan.algorithm.name != CONTROL_ALGORITHM and not is_driven and bool(_cameras(plan))


def image_topic(plan: Plan) -> str | None:
    """Return the image topic of the camera in which the tracker follows its target."""
    topics = {
        interface.camera_name: interface.image_topic
        for interface in plan.scene.ros_interfaces
        if isinstance(interface, VirtualCameraToROSImageSpec)
    }
    return next((topics[camera] for camera in _cameras(plan) if camera in topics), None)


def _cameras(plan: Plan) -> list[str | None]:
    return [
        spec.ground_truth.camera
        for spec in plan.benchmark.measures
        if isinstance(spec, EuclideanNormSpec) and spec.ground_truth.publish_on is not None
    ]


def control_run_of(run: Run) -> Run:
    """Return the control run of a run: its plan with `frozen`, without images, in ``control/``."""
    from ..algorithms import load_algorithm
    from ..algorithms.tracker_node import INPUT_PARAMETERS
    from ..results.directory import CONTROL_FOLDER

    topic, default_topic = image_topic(run.plan), str(INPUT_PARAMETERS["image_topic"])
    is_default = topic is None or topic.strip("/") == default_topic.strip("/")
    plan = replace(
        run.plan,
        algorithm=AlgorithmUnderTest(
            cls=load_algorithm(CONTROL_ALGORITHM),
            name=CONTROL_ALGORITHM,
            parameters={} if topic is None or is_default else {"image_topic": topic},
        ),
        is_blind=True,
        udp_address=None,
    )
    inputs = run.inputs.drop_algorithm()
    return Run(
        plan=plan, out=run.out / CONTROL_FOLDER, inputs=inputs, renderer="none", files=run.files
    )
