"""The unit and the vertical axis that a Collada file states.

Programs apply different parts of ``<asset> <unit meter=""/> <up_axis/> </asset>``:

- RViz (``mesh_loader.cpp``, ``getMeshUnitRescale``) and Gazebo (``ColladaLoader.cc``) apply the
  unit, and leave the axes as they are.
- OpenSceneGraph, with which UWSim reads files, rotates the vertical axis to z (``daeReader.cpp``,
  ``turnZUp``; Y where the file states none), and leaves the unit to the program, which ignores it.

So the meshes of robot files are read as by RViz, and those of scene files as by UWSim. Neither
applies the assets of single libraries or geometries.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from io import BytesIO
from xml.etree.ElementTree import Element, ParseError, iterparse

import numpy as np

from ..base.geometry import Array

MAX_UNIT = 1e6
"""The greatest unit [m]; greater units, and units below 1 / `MAX_UNIT`, are mistakes."""


@dataclass(frozen=True)
class ColladaAsset:
    """The unit and the axis that a file states, with the defaults of Collada."""

    unit: float = 1.0
    """The length of the file's unit [m]."""
    up_axis: str = "Y"
    """The vertical axis: ``X``, ``Y`` or ``Z``."""
    invalid_unit: str = ""
    """The unit as written, where it is not a length; the file is read in metres then."""

    @property
    def z_up_from_file(self) -> Array:
        """The rotation of the vertical axis to z, as in OpenSceneGraph, (3, 3)."""
        if self.up_axis == "Z":
            return np.eye(3)
        if self.up_axis == "X":  # by 90 degrees about y
            return np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
        return np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])  # about x


def read_collada_asset(data: bytes) -> ColladaAsset:
    """Read the first ``<asset>`` below the root of a ``.dae`` file; defaults where there is none.

    Args:
        data: the file, whose limits are checked; only the part up to the asset is parsed.
    """
    depth = 0
    try:
        for event, element in iterparse(BytesIO(data), events=("start", "end")):
            depth += 1 if event == "start" else -1
            if event == "end" and depth == 1 and _tag(element) == "asset":
                return _parse_asset(element)
            if event == "end" and depth == 1:
                element.clear()
    except (ParseError, LookupError, ValueError):
        pass
    return ColladaAsset()


def _parse_asset(element: Element) -> ColladaAsset:
    children = {_tag(child): child for child in reversed(element)}
    unit, invalid_unit = 1.0, ""
    if "unit" in children and (unit_text := children["unit"].get("meter")) is not None:
        unit = _parse_number(unit_text)
        if not 1.0 / MAX_UNIT <= unit <= MAX_UNIT:
            unit, invalid_unit = 1.0, unit_text.strip()[:40] or "''"
    axis = (children["up_axis"].text or "").strip()[:1] if "up_axis" in children else "Y"
    return ColladaAsset(
        unit=unit, up_axis=axis if axis in "XYZ" and axis else "Y", invalid_unit=invalid_unit
    )


def _parse_number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def _tag(element: Element) -> str:
    return str(element.tag).rpartition("}")[2]
