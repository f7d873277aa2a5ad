"""Identification of hydrodynamic coefficients from logs, with intervals and provenance.

.. code-block:: python

    model = open_vehicle(make_scene("my_rov.xml"))
    settings = IdentifySettings(free_names=("added_mass", "drag", "thrust"))
    result = identify([read_log("dive.csv")], model, settings)
    print(result.uncertainty.estimates, result.advice)
"""

from __future__ import annotations

from .identify import Identification, IdentifySettings, identify
from .uncertainty import Estimate, WeakDirection
from .vehicle_model import VehicleModel, make_scene, open_vehicle
from .windows import WindowSettings

__all__ = [
    "Estimate",
    "Identification",
    "IdentifySettings",
    "VehicleModel",
    "WeakDirection",
    "WindowSettings",
    "identify",
    "make_scene",
    "open_vehicle",
]
