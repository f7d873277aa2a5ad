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
"""The parts that an element may contain; those without ``bind`` are not simulated."""


def _is_simulated(spec: type) -> bool:
    return spec.is_simulated() if issubclass(spec, InterfaceSpec) else hasattr(spec, "bind")


UNSIMULATED_ELEMENTS: dict[tuple[str, str], str] = {
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
"""The feature to which (parent, element) belongs."""

ORIGINAL_PHYSICS_ELEMENTS = (("simParams", "enablePhysics"), ("simParams", "gravity"))
"""The elements that are simulated if ``enablePhysics`` is 1 and no vehicle has ``u:dynamics``."""
LIMIT_ELEMENTS = ("minLinearLimit", "maxLinearLimit", "minAngularLimit", "maxAngularLimit")
"""The limits of an object's physics, which are not simulated."""

DISABLED_TEXTS = {"disableShaders": "0", "enablePhysics": "0", "showpath": "0"}
"""The text with which an element has no effect."""


READ_ONLY = "read, not simulated yet"
ONLY_WITHOUT_DYNAMICS = "simulated where no vehicle has u:dynamics"


def describe_limit(parent: str, name: str) -> str:
    """Describe the part of an element below ``parent`` that is not simulated; empty for none."""
    if (parent, name) in ORIGINAL_PHYSICS_ELEMENTS:
        return ONLY_WITHOUT_DYNAMICS
    return READ_ONLY if (parent, name) in UNSIMULATED_ELEMENTS else ""
