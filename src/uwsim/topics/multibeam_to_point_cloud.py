r"""u:multibeamToPointCloud2: the hits of a multibeam or profiling sonar as a point cloud.

.. code-block:: xml

    <u:multibeamToPointCloud2>
      <name>multibeam</name> <topic>/g500/multibeam/points</topic> <rate>10</rate>
    </u:multibeamToPointCloud2>

A beam at the angle :math:`a` with the range :math:`r` is the point :math:`(r \cos a, r \sin a, 0)`
in the frame of the sensor's LaserScan; a beam without a hit within the maximum range is left out.
Each message is a separate sample: its noise differs from that of the LaserScan of the same time.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import ClassVar

import numpy as np

from ..messages import LaserScan, PointCloud2, point_cloud, seconds
from .interface import Interface, TopicWorld, sample_rate
from .sensor_topic import SensorPublisher, SensorTopicSpec


@dataclass(frozen=True, kw_only=True)
class MultibeamToPointCloud2Spec(SensorTopicSpec):
    """A publisher of the hits of a multibeam or profiling sonar as sensor_msgs/PointCloud2."""

    sources: ClassVar[tuple[str, ...]] = ("multibeamSensor", "ProfilingSonar")

    @classmethod
    def message_types(cls) -> Mapping[str, type]:
        """Return the message type."""
        return {"topic": PointCloud2}

    def bind(self, world: TopicWorld) -> Interface:
        """Start to publish; raise UnknownName if there is no such sensor."""
        sensor = world.sensors.sensor(self.name, self.sources)
        publish = world.sensors.publisher(self.name, self.topic, PointCloud2)
        publisher = SensorPublisher(sensor, partial(_publish_cloud, publish), lambda: world.time)
        world.create_timer(sample_rate(self.rate, world), publisher.publish)
        return publisher


def _publish_cloud(publish: Callable[[object], None], scan: object) -> None:
    assert isinstance(scan, LaserScan)
    publish(scan_point_cloud(scan))


def scan_point_cloud(scan: LaserScan) -> PointCloud2:
    """Return the hits of a scan as points in the frame of the scan [m]."""
    ranges = scan.ranges.astype(np.float64)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
    is_hit = scan.ranges < np.float32(scan.range_max)
    ranges, angles = ranges[is_hit], angles[is_hit]
    points = np.stack([ranges * np.cos(angles), ranges * np.sin(angles), 0.0 * ranges], axis=1)
    time = seconds(scan.header.stamp)
    return point_cloud(points, time=time, frame_id=scan.header.frame_id)
