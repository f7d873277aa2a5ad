"""The order of elements that the original's grammar prescribes for a benchmark file."""

from __future__ import annotations

from lxml import etree

from ..schema import Diagnostics

GATE = ("log", "startOn", "stopOn")
SWEEP = ("initialValue", "finalValue", "step", "interval")
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
    "time": ("name", *GATE),
    "collision": ("name", "target", *GATE),
    "positionError": ("name", "target", "position", "topic", *GATE),
    "distance": ("name", "target", *GATE),
    "euclideanNorm": ("name", "groundTruth", "target", *GATE),
    "objectCenteredOnCam": ("name", "target", "camera", *GATE),
    "reconstruction3D": ("name", "target", "topic", "from", "levelOfDetail", *GATE),
    "pathFollowing": ("name", "target", "topic", "from", *GATE),
    "startOn": ("type", "target", "position"),
    "stopOn": ("type", "target", "position"),
    "position": ("x", "y", "z"),
    "groundTruth": ("value", "camera", "target", "publishOn", "from", "to"),
    "sceneFogUpdater": (*SWEEP, "sceneUpdater"),
    "sceneLightUpdater": (*SWEEP, "sceneUpdater"),
    "cameraNoiseUpdater": (*SWEEP, "sceneUpdater"),
    "repeat": ("iterations", "interval", "sceneUpdater"),
    "armMoveUpdater": ("armPosition", "step", "interval", "target", "sceneUpdater"),
    "bagFogUpdater": (
        *SWEEP, "bag", "imageTopic", "infoTopic", "imageDepth", "imagePub", "infoPub",
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
"""Element -> its children in order."""

REQUIRED: dict[str, tuple[str, ...]] = {
    measure: ("startOn", "stopOn") for measure in ORDER["measures"]
}
"""Children that the original requires although they have a default."""


def check_order(root: etree._Element, diagnostics: Diagnostics) -> None:
    """Report elements that uwsim reads and the original's grammar refuses."""
    for node in root.iter("*"):
        order = ORDER.get(str(node.tag), ())
        last, shown = -1, ""
        present = set()
        for child in node.iterchildren("*"):
            tag = str(child.tag)
            present.add(tag)
            if tag not in order:
                continue
            if order.index(tag) < last:
                diagnostics.error(
                    child, f"<{tag}> comes after <{shown}>; the original expects it before"
                )
            else:
                last, shown = order.index(tag), tag
        for tag in REQUIRED.get(str(node.tag), ()):
            if tag not in present:
                diagnostics.error(node, f"<{node.tag}> lacks <{tag}>; the original requires it")
