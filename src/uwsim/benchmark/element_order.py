"""Checks of the order of XML elements in a benchmark file.

The document type definition (DTD) of the original UWSim prescribes that order; uwsim does not.
"""

from __future__ import annotations

from lxml import etree

from ..schema import Diagnostics

GATE_ELEMENTS = ("log", "startOn", "stopOn")
"""The last children of every measure."""
SWEEP_ELEMENTS = ("initialValue", "finalValue", "step", "interval")
"""The first children of an updater that sweeps one value."""
ORDER: dict[str, tuple[str, ...]] = {
    "benchmark": ("measures", "startOn", "stopOn", "function", "sceneUpdater"),
    "measures": (
        "time",
        "collision",
        "positionError",
        "distance",
        "euclideanNorm",
        "objectCenteredOnCam",
        "reconstruction3D",
        "pathFollowing",
    ),
    "time": ("name", *GATE_ELEMENTS),
    "collision": ("name", "target", *GATE_ELEMENTS),
    "positionError": ("name", "target", "position", "topic", *GATE_ELEMENTS),
    "distance": ("name", "target", *GATE_ELEMENTS),
    "euclideanNorm": ("name", "groundTruth", "target", *GATE_ELEMENTS),
    "objectCenteredOnCam": ("name", "target", "camera", *GATE_ELEMENTS),
    "reconstruction3D": ("name", "target", "topic", "from", "levelOfDetail", *GATE_ELEMENTS),
    "pathFollowing": ("name", "target", "topic", "from", *GATE_ELEMENTS),
    "startOn": ("type", "target", "position"),
    "stopOn": ("type", "target", "position"),
    "position": ("x", "y", "z"),
    "groundTruth": ("value", "camera", "target", "publishOn", "from", "to"),
    "sceneFogUpdater": (*SWEEP_ELEMENTS, "sceneUpdater"),
    "sceneLightUpdater": (*SWEEP_ELEMENTS, "sceneUpdater"),
    "cameraNoiseUpdater": (*SWEEP_ELEMENTS, "sceneUpdater"),
    "repeat": ("iterations", "interval", "sceneUpdater"),
    "armMoveUpdater": ("armPosition", "step", "interval", "target", "sceneUpdater"),
    "bagFogUpdater": (
        *SWEEP_ELEMENTS, "bag", "imageTopic", "infoTopic", "imageDepth", "imagePub", "infoPub",
        "sceneUpdater",
    ),
    "currentForceUpdater": (
        "initialValue", "finalValue", "sphericalDirection", "forceVariation", "forcePeriod",
        "directionVariation", "directionPeriod", "random", "step", "interval", "target",
        "sceneUpdater",
    ),
    "sphericalDirection": ("theta", "phi"),
    "directionVariation": ("theta", "phi"),
    "directionPeriod": ("theta", "phi"),
}  # fmt: skip
"""The children of each element, in the order that the DTD prescribes."""

REQUIRED_CHILDREN: dict[str, tuple[str, ...]] = {
    measure: ("startOn", "stopOn") for measure in ORDER["measures"]
}
"""The children that the DTD requires, but that have a default in uwsim."""


def check_order(root: etree._Element, diagnostics: Diagnostics) -> None:
    """Report elements that are out of order or absent: uwsim reads the file, UWSim rejects it."""
    for node in root.iter("*"):
        order = ORDER.get(str(node.tag), ())
        last_index, last_tag = -1, ""
        present_tags = set()
        for child in node.iterchildren("*"):
            tag = str(child.tag)
            present_tags.add(tag)
            if tag not in order:
                continue
            if order.index(tag) < last_index:
                diagnostics.error(
                    child, f"<{tag}> comes after <{last_tag}>; the original expects it before"
                )
            else:
                last_index, last_tag = order.index(tag), tag
        for tag in REQUIRED_CHILDREN.get(str(node.tag), ()):
            if tag not in present_tags:
                diagnostics.error(node, f"<{node.tag}> lacks <{tag}>; the original requires it")
