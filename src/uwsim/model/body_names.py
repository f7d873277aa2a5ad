"""Names of the bodies, joints and actuators of a scene in MuJoCo's model."""

from __future__ import annotations


def vehicle_body(index: int, link: str) -> str:
    """Return the name in the model of a link of the vehicle at ``index``."""
    return f"vehicle/{index}/{link}"


def vehicle_joint(index: int, joint: str) -> str:
    """Return the name in the model of a joint of the vehicle at ``index``."""
    return f"vehicle/{index}/joint/{joint}"


def vehicle_thruster(index: int, thruster: str) -> str:
    """Return the name in the model of a thruster of the vehicle at ``index``."""
    return f"vehicle/{index}/thruster/{thruster}"


def vehicle_fin(index: int, fin: str) -> str:
    """Return the name in the model of a fin of the vehicle at ``index``."""
    return f"vehicle/{index}/fin/{fin}"


def object_body(index: int) -> str:
    """Return the name in the model of the object at ``index``."""
    return f"object/{index}"


def loose_joint(index: int) -> str:
    """Return the name in the model of the joint of the loose object at ``index``."""
    return f"object/{index}/joint"


def fixture_joint(index: int) -> str:
    """Return the name in the model of the hinge or slide of the object at ``index``."""
    return f"object/{index}/fixture"


def grip_constraint(vehicle: int, link: str, object_index: int) -> str:
    """Return the name in the model of the constraint by which a link holds a loose object."""
    return f"grip/{vehicle}/{link}/{object_index}"


def segment_body(force: int, segment: int) -> str:
    """Return the name in the model of a segment that the force at index ``force`` places."""
    return f"force/{force}/{segment}"


def owner_of(name: str) -> str:
    """Return the owner, ``vehicle/1`` or ``object/1``, of the body or shape with a name."""
    return "/".join(name.split("/")[:2])
