"""The views of a running scene: the part of its interface that each kind of component may use.

Each view implements one protocol of `uwsim.world` or `uwsim.topics`. `measure_view` is for measures
and triggers, `stage_view` for scene updaters, `sensor_view` for sensors, `device_view` for devices,
`force_view` for forces, and `topic_view` for the elements of ``<rosInterfaces>``.
"""

from __future__ import annotations
