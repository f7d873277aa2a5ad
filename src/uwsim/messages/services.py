"""Service types, each a request and a response.

A folder for each package holds their texts; a test holds the two together.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from .visualization_msgs import Marker


@dataclass(frozen=True)
class Service:
    """A service type: its ROS name and the classes of its two halves."""

    name: str
    request: type
    response: type


@dataclass(frozen=True)
class Empty:
    """Request of ``std_srvs/srv/Empty``."""

    __msgtype__: ClassVar[str] = "std_srvs/srv/Empty_Request"


@dataclass(frozen=True)
class EmptyResponse:
    """Response of ``std_srvs/srv/Empty``."""

    __msgtype__: ClassVar[str] = "std_srvs/srv/Empty_Response"


@dataclass(frozen=True, eq=False)
class GTpublish:
    """Request of ``underwater_sensor_msgs/srv/GTpublish``: ground truth handed to an algorithm."""

    groundTruth: npt.NDArray[np.float32]  # noqa: N815 - the field's name in ROS
    """For corners: x, y of NW, NE, SE, SW [px], (8,)."""
    __msgtype__: ClassVar[str] = "underwater_sensor_msgs/srv/GTpublish_Request"


@dataclass(frozen=True)
class GTpublishResponse:
    """Response of ``underwater_sensor_msgs/srv/GTpublish``."""

    __msgtype__: ClassVar[str] = "underwater_sensor_msgs/srv/GTpublish_Response"


@dataclass(frozen=True, eq=False)
class SpawnMarker:
    """Request of ``underwater_sensor_msgs/srv/SpawnMarker``: adds, changes or deletes a marker."""

    marker: Marker
    """The marker; its pose is in L, whatever frame its header names."""
    __msgtype__: ClassVar[str] = "underwater_sensor_msgs/srv/SpawnMarker_Request"


@dataclass(frozen=True)
class SpawnMarkerResponse:
    """Response of ``underwater_sensor_msgs/srv/SpawnMarker``."""

    success: bool
    """Whether it was done."""
    status_message: str
    """What was done, or why not."""
    __msgtype__: ClassVar[str] = "underwater_sensor_msgs/srv/SpawnMarker_Response"


EMPTY = Service("std_srvs/srv/Empty", Empty, EmptyResponse)
GT_PUBLISH = Service("underwater_sensor_msgs/srv/GTpublish", GTpublish, GTpublishResponse)
SPAWN_MARKER = Service("underwater_sensor_msgs/srv/SpawnMarker", SpawnMarker, SpawnMarkerResponse)

SERVICES: dict[str, Service] = {each.name: each for each in (EMPTY, GT_PUBLISH, SPAWN_MARKER)}
"""Service types by their names in ROS 2; ``srv/`` has the text of each."""
