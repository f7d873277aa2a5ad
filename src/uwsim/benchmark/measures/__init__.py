"""The measures of benchmarks, one module each."""

from __future__ import annotations

from ..metrics.signal import Signal
from .collision import Collision, CollisionSpec
from .control import Control, ControlSpec
from .delivery import Delivery, DeliverySpec
from .distance import Distance, DistanceSpec
from .energy import Energy, EnergySpec
from .euclidean_norm import EuclideanNorm, EuclideanNormSpec
from .grasp import Grasp, GraspSpec
from .insertion import Insertion, InsertionSpec
from .joint_position import JointPosition, JointPositionSpec
from .measure import Measure, MeasureSpec
from .object_centered_on_cam import ObjectCenteredOnCam, ObjectCenteredOnCamSpec
from .outcome import Outcome, OutcomeSpec, connect_outcomes, find_outcome_spec
from .path_following import PathFollowing, PathFollowingSpec
from .position_error import PositionError, PositionErrorSpec
from .reach import Reach, ReachSpec
from .reconstruction_3d import Reconstruction3D, Reconstruction3DSpec
from .reports.detections import Detections, DetectionsSpec
from .reports.map_error import MapError, MapErrorSpec
from .time import Time, TimeSpec
from .tracking_error import TrackingError, TrackingErrorSpec

MEASURES: dict[str, type[MeasureSpec]] = {
    "collision": CollisionSpec,
    "distance": DistanceSpec,
    "euclideanNorm": EuclideanNormSpec,
    "objectCenteredOnCam": ObjectCenteredOnCamSpec,
    "pathFollowing": PathFollowingSpec,
    "positionError": PositionErrorSpec,
    "reconstruction3D": Reconstruction3DSpec,
    "time": TimeSpec,
    "u:control": ControlSpec,
    "u:delivery": DeliverySpec,
    "u:detections": DetectionsSpec,
    "u:energy": EnergySpec,
    "u:grasp": GraspSpec,
    "u:insertion": InsertionSpec,
    "u:jointPosition": JointPositionSpec,
    "u:mapError": MapErrorSpec,
    "u:outcome": OutcomeSpec,
    "u:reach": ReachSpec,
    "u:trackingError": TrackingErrorSpec,
}
"""The spec of each element, in alphabetical order."""

__all__ = [
    "MEASURES",
    "Collision",
    "CollisionSpec",
    "Control",
    "ControlSpec",
    "Delivery",
    "DeliverySpec",
    "Detections",
    "DetectionsSpec",
    "Distance",
    "DistanceSpec",
    "Energy",
    "EnergySpec",
    "EuclideanNorm",
    "EuclideanNormSpec",
    "Grasp",
    "GraspSpec",
    "Insertion",
    "InsertionSpec",
    "JointPosition",
    "JointPositionSpec",
    "MapError",
    "MapErrorSpec",
    "Measure",
    "MeasureSpec",
    "ObjectCenteredOnCam",
    "ObjectCenteredOnCamSpec",
    "Outcome",
    "OutcomeSpec",
    "PathFollowing",
    "PathFollowingSpec",
    "PositionError",
    "PositionErrorSpec",
    "Reach",
    "ReachSpec",
    "Reconstruction3D",
    "Reconstruction3DSpec",
    "Signal",
    "Time",
    "TimeSpec",
    "TrackingError",
    "TrackingErrorSpec",
    "connect_outcomes",
    "find_outcome_spec",
]
