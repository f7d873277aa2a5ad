"""Which node the simulator is: one of rclpy where it can be imported, else one on Cyclone DDS."""

from __future__ import annotations

import importlib.util
from collections.abc import Mapping

from ...errors import BadSetting, MissingExtra, UwsimError, did_you_mean
from ..log import Log
from .node import Ros2Node
from .settings import settings_from

NODES = ("rclpy", "dds")
VARIABLE = "UWSIM_ROS2"
"""By which a user chooses one of `NODES`; unset or empty: what there is."""
REACH = {True: "for nodes on this computer", False: "its ports are open on all addresses"}
"""Whether other computers cannot reach a node -> what is said of it."""
MISSING = "--ros2: neither rclpy nor Cyclone DDS is installed: source a ROS 2, or pip install "
MISSING += "uwsim[ros2]"


def open_node(environment: Mapping[str, str], domain: int | None, log: Log) -> Ros2Node:
    """Join a domain of ROS 2, and say by what.

    Args:
        environment: variables of ROS 2, of Cyclone DDS and ``UWSIM_ROS2``.
        domain: ``--domain``; None: that of ``ROS_DOMAIN_ID``.
        log: of the connection.

    Raises:
        BadSetting: a variable has a value that is not known.
        MissingExtra: there is neither rclpy nor Cyclone DDS.
        UwsimError: the domain cannot be joined.
    """
    chosen = choice(environment)
    if chosen == "dds":
        return _dds(environment, domain, log)
    try:
        from rclpy.utilities import get_rmw_implementation_identifier

        from .rclpy_node import RclpyNode
    except (ImportError, OSError, RuntimeError) as error:  # of a broken installation, too
        if chosen == "rclpy":
            raise UwsimError(
                f"--ros2: {VARIABLE}=rclpy, and it cannot be imported: {error}"
            ) from None
        if importlib.util.find_spec("rclpy") is not None:
            log.report(f"rclpy is there, and cannot be imported: {str(error).splitlines()[0]}")
        return _dds(environment, domain, log)
    node = RclpyNode(settings_from(environment, domain), log)
    log.report(f"a node of rclpy, on {get_rmw_implementation_identifier()}")
    return node


def check(environment: Mapping[str, str], domain: int | None) -> None:
    """Raise an error if a node can be had in no case; rclpy is not imported for it."""
    chosen = choice(environment)
    if chosen == "dds" or importlib.util.find_spec("rclpy") is None:
        _find_dds()
    settings_from(environment, domain)


def choice(environment: Mapping[str, str]) -> str:
    """Return what the user asks for: ``rclpy``, ``dds``, or nothing."""
    found = environment.get(VARIABLE, "")
    if found not in ("", *NODES):
        near = did_you_mean(found, NODES)
        raise BadSetting(f"{VARIABLE}={found}: expected {' or '.join(NODES)}.{near}")
    return found


def _dds(environment: Mapping[str, str], domain: int | None, log: Log) -> Ros2Node:
    _find_dds()
    from .dds_node import DdsNode

    settings = settings_from(environment, domain)
    node = DdsNode(settings, log, more=environment.get("CYCLONEDDS_URI", ""))
    reach = (
        "for nodes on this computer" if node.is_closed else "its ports are open on all addresses"
    )
    log.report(f"a node on Cyclone DDS, without rclpy; {reach}")
    return node


def _find_dds() -> None:
    if importlib.util.find_spec("cyclonedds") is None:
        raise MissingExtra(MISSING)
