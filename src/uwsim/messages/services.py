"""The service types of UWSim, each with a class for the request and one for the response.

The ``.srv`` files in the folders of the packages define them; a test compares both.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from .visualization_msgs import Marker


@dataclass(frozen=True)
class Service:
    """A service type: its ROS name and the classes of its request and response."""

    name: str
    """The name in ROS 2, such as ``std_srvs/srv/Empty``."""
    request: type
    """The class of requests."""
    response: type
    """The class of responses."""


@dataclass(frozen=True)
class Empty:
    """The request of ``std_srvs/srv/Empty``."""

    __msgtype__: ClassVar[str] = "std_srvs/srv/Empty_Request"


@dataclass(frozen=True)
class EmptyResponse:
    """The response of ``std_srvs/srv/Empty``."""

    __msgtype__: ClassVar[str] = "std_srvs/srv/Empty_Response"


@dataclass(frozen=True, eq=False)
class GTpublish:
    """The request of ``underwater_sensor_msgs/srv/GTpublish``: ground truth for an algorithm."""

    groundTruth: npt.NDArray[np.float32]  # noqa: N815 - the field's name in ROS
    """The values; for the corners of a patch, x and y of its NW, NE, SE, SW corner [px], (8,)."""
    __msgtype__: ClassVar[str] = "underwater_sensor_msgs/srv/GTpublish_Request"


@dataclass(frozen=True)
class GTpublishResponse:
    """The response of ``underwater_sensor_msgs/srv/GTpublish``."""

    __msgtype__: ClassVar[str] = "underwater_sensor_msgs/srv/GTpublish_Response"


@dataclass(frozen=True, eq=False)
class SpawnMarker:
    """The request of ``underwater_sensor_msgs/srv/SpawnMarker``: a marker to add or delete."""

    marker: Marker
    """The marker; its pose is in L, the frame of the scene, whatever frame its header names."""
    __msgtype__: ClassVar[str] = "underwater_sensor_msgs/srv/SpawnMarker_Request"


@dataclass(frozen=True)
class SpawnMarkerResponse:
    """The response of ``underwater_sensor_msgs/srv/SpawnMarker``."""

    success: bool
    """True if the request succeeded."""
    status_message: str
    """The effect of the request, or the reason of its failure."""
    __msgtype__: ClassVar[str] = "underwater_sensor_msgs/srv/SpawnMarker_Response"


EMPTY_SERVICE = Service("std_srvs/srv/Empty", Empty, EmptyResponse)
GT_PUBLISH = Service("underwater_sensor_msgs/srv/GTpublish", GTpublish, GTpublishResponse)
SPAWN_MARKER = Service("underwater_sensor_msgs/srv/SpawnMarker", SpawnMarker, SpawnMarkerResponse)

SERVICES: dict[str, Service] = {
    kind.name: kind for kind in (EMPTY_SERVICE, GT_PUBLISH, SPAWN_MARKER)
}
"""The service types by their names in ROS 2."""
