"""Warnings of `uwsim check` about implausible values, and how a scene file accepts such a value.

.. code-block:: xml

    <vehicle> ... <u:accept>buoyancy</u:accept> <u:accept>thrust</u:accept> </vehicle>
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

VehicleWarning = Literal[
    "balance", "bottom", "buoyancy", "drag", "friction", "inertia", "passable", "places", "size",
    "start", "strength", "thrust", "waves",
]  # fmt: skip
"""The names of warnings about a vehicle."""
ObjectWarning = Literal["buoyancy", "places", "start"]
"""The names of warnings about an object."""

PLAUSIBILITY_WARNINGS: Mapping[VehicleWarning, str] = {
    "balance": "Its centre of buoyancy is below its centre of mass at the start: it turns over.",
    "bottom": "A DVL detects no seabed at the start.",
    "buoyancy": "Its displaced water is far from its mass, or too much for its shape; for an "
    "object, more than twice its box.",
    "drag": "The drag of a link stops its mass in one step, or it has drag and no mass.",
    "friction": "The dry friction of a joint is more than its effort: no servo moves it.",
    "inertia": "The inertia of a link is missing, or far from that of its mass and size.",
    "passable": "Vehicles with dynamics pass through it, or it through everything.",
    "places": "A thruster or the centre of mass or buoyancy is far from the hull. The centre of "
    "mass of an object is outside the box around it.",
    "size": "It is larger than 50 m or smaller than 5 cm: its meshes may be in millimetres.",
    "start": "It begins in or under the ground, or above the water.",
    "strength": "A thruster would accelerate it by more than 50 m/s2.",
    "thrust": "Its thrusters cannot drive surge, sway, heave and yaw.",
    "waves": "It is longer than a fifth of the waves, which it would diffract.",
}
"""The condition of each warning, by the name of the warning."""


def acceptance_hint(warning: VehicleWarning) -> str:
    """Return the hint how a scene file accepts a value that is intended."""
    return f"If intended: <u:accept>{warning}</u:accept>"
