"""Warnings of `uwsim check` about values that may be intended, and how a file accepts them.

.. code-block:: xml

    <vehicle> ... <u:accept>buoyancy</u:accept> <u:accept>thrust</u:accept> </vehicle>
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

VehicleWarning = Literal[
    "balance", "bottom", "buoyancy", "drag", "friction", "inertia", "passable", "places", "size",
    "start", "strength", "thrust",
]  # fmt: skip
"""Warnings about a vehicle."""
ObjectWarning = Literal["buoyancy", "places", "start"]
"""Warnings about an object."""

PLAUSIBILITY_WARNINGS: Mapping[VehicleWarning, str] = {
    "balance": "Its centre of buoyancy lies below its centre of mass as it begins: it turns over.",
    "bottom": "A DVL finds no bottom where the vehicle begins.",
    "buoyancy": "What it displaces is far from its mass, or more than its shape has room for; "
    "of an object, more than twice its box.",
    "drag": "A link has more drag than its mass bears in one step, or drag and no mass at all.",
    "friction": "The dry friction of a joint is more than its effort: no servo moves it.",
    "inertia": "The inertia of a link is missing, or far from that of its mass and size.",
    "passable": "Simulated vehicles pass through it, or it through everything.",
    "places": "A thruster or the centre of mass or buoyancy lies far off the hull, or the centre "
    "of mass of an object outside the box around it.",
    "size": "It is larger than 50 m or smaller than 5 cm: its meshes may be in millimetres.",
    "start": "It begins in or under the ground, or above the water.",
    "strength": "A thruster would accelerate it by more than 50 m/s2.",
    "thrust": "Its thrusters cannot drive surge, sway, heave and yaw.",
}
"""Name of the warning -> when it is raised."""


def unless_meant(warning: VehicleWarning) -> str:
    """Describe how a file accepts a value that is intended."""
    return f"If that is meant: <u:accept>{warning}</u:accept>"
