"""The views of a live scene: one for each kind of part, each exactly its Protocol.

`measure_view` for measures and triggers, `stage_view` for scene updaters, `sensor_view`,
`device_view`, `force_view` and `topic_view` for what they are named after.
"""

from __future__ import annotations
