"""The unit and the vertical axis that a Collada file states of itself.

Programs differ in what they apply of ``<asset> <unit meter=""/> <up_axis/> </asset>``:

- RViz (``mesh_loader.cpp``, ``getMeshUnitRescale``) and Gazebo (``ColladaLoader.cc``) apply the
  unit, and leave the axes as they are.
- OpenSceneGraph, with which UWSim reads files, turns the vertical axis to z (``daeReader.cpp``,
  ``turnZUp``; Y where the file states none), and leaves the unit to the program, which does
  nothing with it.

So the meshes of robot files are read as by RViz, and those of scene files as by UWSim. Assets of
single libraries or geometries count nowhere.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from io import BytesIO
from xml.etree.ElementTree import Element, ParseError, iterparse

import numpy as np

from ..base.geometry import Array

LARGEST_UNIT = 1e6
"""Units beyond this, or below one over it, are taken for mistakes [m]."""


@dataclass(frozen=True)
class ColladaAsset:
    """What a file states, with the defaults of Collada."""

    unit: float = 1.0
    """Length of its unit [m]."""
    up_axis: str = "Y"
    """``X``, ``Y`` or ``Z``."""
    wrong_unit: str = ""
    """Its unit as written, where that is no length; it is read in metres then."""

    @property
    def z_up_from_file(self) -> Array:
        """The turn that takes its vertical axis to z as OpenSceneGraph does, (3, 3)."""
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
                return _asset(element)
            if event == "end" and depth == 1:
                element.clear()
    except (ParseError, LookupError, ValueError):
        pass
    return ColladaAsset()


def _asset(element: Element) -> ColladaAsset:
    children = {_tag(child): child for child in reversed(element)}
    unit, wrong = 1.0, ""
    if "unit" in children and (written := children["unit"].get("meter")) is not None:
        unit = _number(written)
        if not 1.0 / LARGEST_UNIT <= unit <= LARGEST_UNIT:
            unit, wrong = 1.0, written.strip()[:40] or "''"
    axis = (children["up_axis"].text or "").strip()[:1] if "up_axis" in children else "Y"
    return ColladaAsset(
        unit=unit, up_axis=axis if axis in "XYZ" and axis else "Y", wrong_unit=wrong
    )


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def _tag(element: Element) -> str:
    """The tag without its namespace."""
    return str(element.tag).rpartition("}")[2]
