"""Elements that are read and not simulated yet: a warning for each kind."""

from __future__ import annotations

from lxml import etree

from ..devices import DEVICES
from ..schema import NAMESPACE, Diagnostics
from ..sensors import SENSORS
from ..topics import INTERFACES, InterfaceSpec

WAVES = (
    "windx",
    "windy",
    "windSpeed",
    "depth",
    "reflectionDamping",
    "waveScale",
    "isNotChoppy",
    "choppyFactor",
    "crestFoamHeight",
)

FAMILIES: dict[str, dict[str, type]] = {
    "vehicle": {**SENSORS, **DEVICES},
    "simulatedDevices": {"echo": DEVICES["echo"]},
    "rosInterfaces": {n: spec for n, spec in INTERFACES.items() if n != "SimulatedDeviceROS"},
    "SimulatedDeviceROS": {"echoROS": INTERFACES["echoROS"]},
}
"""Element -> the parts that may stand in it; those without ``bind`` are not simulated."""


def _is_simulated(spec: type) -> bool:
    """Whether a sensor, device or interface does anything."""
    return spec.is_simulated() if issubclass(spec, InterfaceSpec) else hasattr(spec, "bind")


UNSUPPORTED: dict[tuple[str, str], str] = {
    **{("oceanState", name): "waves" for name in WAVES},
    ("simParams", "disableShaders"): "the window",
    ("simParams", "enablePhysics"): "physics of contacts",
    ("simParams", "gravity"): "physics of contacts",
    ("simParams", "physicsFrequency"): "physics of contacts",
    ("simParams", "physicsSubSteps"): "physics of contacts",
    ("simParams", "physicsSolver"): "physics of contacts",
    ("virtualCamera", "showpath"): "showpath",
    **{
        (parent, name): name
        for parent, parts in FAMILIES.items()
        for name, spec in parts.items()
        if not _is_simulated(spec)
    },
}
"""(parent, element) -> what it belongs to."""

FALL = (("simParams", "enablePhysics"), ("simParams", "gravity"))
"""Simulated where ``enablePhysics`` is 1 and no vehicle has ``u:dynamics``."""
LIMITS = ("minLinearLimit", "maxLinearLimit", "minAngularLimit", "maxAngularLimit")
"""Of an object's physics; not simulated."""

OFF = {"disableShaders": "0", "enablePhysics": "0", "showpath": "0"}
"""An element with this text asks for nothing."""


READ_ONLY = "read, not simulated yet"
FALLS_ALONE = "simulated where no vehicle has u:dynamics"


def limit_of(parent: str, name: str) -> str:
    """Describe what of an element below ``parent`` is not simulated; empty: nothing."""
    if (parent, name) in FALL:
        return FALLS_ALONE
    return READ_ONLY if (parent, name) in UNSUPPORTED else ""


def not_simulated(root: etree._Element, diagnostics: Diagnostics) -> None:
    """Report every kind of element that is read and not simulated yet, with its lines."""
    lines: dict[str, list[int]] = {}
    is_dynamic = root.find(f"vehicle/{{{NAMESPACE}}}dynamics") is not None
    falls = not is_dynamic and (root.findtext("simParams/enablePhysics") or "").strip() == "1"
    for node in root.iter("*"):
        parent = node.getparent()
        if parent is None:
            continue
        place = (str(parent.tag), str(node.tag))
        kind = UNSUPPORTED.get(place)
        if place in FALL and falls:
            kind = None
        elif (is_dynamic or falls) and parent.tag == "physics" and node.tag in LIMITS:
            kind = "limits of objects"
        if kind is not None and OFF.get(str(node.tag)) != (node.text or "").strip():
            lines.setdefault(kind, []).append(_line(node))
    for kind, where in sorted(lines.items(), key=lambda entry: entry[1][0]):
        shown = sorted(set(where))
        listed = ", ".join(map(str, shown[:8])) + (", ..." if len(shown) > 8 else "")
        many = "line" if len(shown) == 1 else "lines"
        diagnostics.warning(shown[0], f"{READ_ONLY}: {kind} ({many} {listed})")


def _line(node: etree._Element) -> int:
    return int(str(node.sourceline or 0))
