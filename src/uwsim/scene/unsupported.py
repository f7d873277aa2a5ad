"""Elements that are read and not simulated yet: a warning for each kind."""

from __future__ import annotations

from ..devices import DEVICES
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
