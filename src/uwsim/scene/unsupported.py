"""The elements of scene files that are read but not simulated yet."""

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
"""The specs of the parts in each parent element; specs without ``bind`` are not simulated."""


def _is_implemented(spec: type) -> bool:
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
        if not _is_implemented(spec)
    },
}
"""The feature, in words, to which each (parent, element) belongs."""

ORIGINAL_PHYSICS_ELEMENTS = (("simParams", "enablePhysics"), ("simParams", "gravity"))
"""The elements that are simulated if ``enablePhysics`` is 1 and no vehicle has ``u:dynamics``."""
DEPTH_ELEMENT = ("oceanState", "depth")
"""The element that is simulated in a scene with ``<u:waves>``."""
OCEAN_ELEMENTS = tuple(
    ("oceanState", name)
    for name in ("windx", "windy", "windSpeed", "reflectionDamping", "waveScale")
)
"""The elements that are simulated in a scene with ``<u:uwsimOcean>`` in its ``<u:waves>``."""
LIMIT_ELEMENTS = ("minLinearLimit", "maxLinearLimit", "minAngularLimit", "maxAngularLimit")
"""The limits in ``<physics>`` of an object, which are not simulated."""

DISABLED_TEXTS = {"disableShaders": "0", "enablePhysics": "0", "showpath": "0"}
"""The text with which an element has no effect, by element name."""


READ_ONLY = "read, not simulated yet"
READ_WITHOUT_WAVES = "read, not simulated without <u:waves>"
ONLY_WITHOUT_DYNAMICS = "simulated where no vehicle has u:dynamics"
ONLY_WITH_WAVES = "simulated in a scene with u:waves"
ONLY_WITH_OCEAN = "simulated in a scene with u:uwsimOcean"


def describe_limitation(parent: str, name: str) -> str:
    """Return the limitation of the simulation of an element; empty if it is fully simulated.

    Args:
        parent: the name of the element's parent element.
        name: the qualified name of the element.
    """
    if (parent, name) in ORIGINAL_PHYSICS_ELEMENTS:
        return ONLY_WITHOUT_DYNAMICS
    if (parent, name) == DEPTH_ELEMENT:
        return ONLY_WITH_WAVES
    if (parent, name) in OCEAN_ELEMENTS:
        return ONLY_WITH_OCEAN
    return READ_ONLY if (parent, name) in UNSIMULATED_ELEMENTS else ""
