"""Protocols of the simulation for measures, triggers, updaters, sensors, devices and forces.

Positions are in W, the world frame of the simulation (z up). The transform
``world_from_localized`` relates it to L, the frame of files, topics and results. All returned
arrays are copies.
"""

from __future__ import annotations

from .connections import (
    Address,
    ByteStream,
    Connections,
    DatagramPort,
    ServerStream,
    TerminalStream,
)
from .parts import (
    GRAVITY,
    TIMESTEP,
    Actuators,
    Attachment,
    Body,
    BodyMotion,
    Box,
    Camera,
    CompiledVehicle,
    Contact,
    Flow,
    ImageContent,
    ImageView,
    LineOfSight,
    Mount,
    MovingBody,
    Rays,
    Segments,
    Surroundings,
    TetherControl,
    WaterSurface,
)
from .views import DeviceWorld, ForceWorld, SensorWorld, Stage, StageWater, TimedWorld, World

__all__ = [
    "GRAVITY",
    "TIMESTEP",
    "Actuators",
    "Address",
    "Attachment",
    "Body",
    "BodyMotion",
    "Box",
    "ByteStream",
    "Camera",
    "CompiledVehicle",
    "Connections",
    "Contact",
    "DatagramPort",
    "DeviceWorld",
    "Flow",
    "ForceWorld",
    "ImageContent",
    "ImageView",
    "LineOfSight",
    "Mount",
    "MovingBody",
    "Rays",
    "Segments",
    "SensorWorld",
    "ServerStream",
    "Stage",
    "StageWater",
    "Surroundings",
    "TerminalStream",
    "TetherControl",
    "TimedWorld",
    "WaterSurface",
    "World",
]
