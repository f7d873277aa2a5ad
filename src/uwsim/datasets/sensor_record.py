"""The part of a record that describes its sensor: a camera, or a sonar."""

from __future__ import annotations

from typing import Any


def sensor_of(record: dict[str, Any]) -> dict[str, Any]:
    """Return the camera or the sonar of a record, with ``width``, ``height`` and ``position``."""
    sensor: dict[str, Any] = record["camera"] if "camera" in record else record["sonar"]
    return sensor
