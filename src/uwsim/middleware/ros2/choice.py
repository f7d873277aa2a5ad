"""The choice of the node: on rclpy if it can be imported, else on Cyclone DDS."""

from __future__ import annotations

import importlib.util
from collections.abc import Mapping

from ...errors import BadSetting, MissingExtra, UwsimError, did_you_mean
from ..log import Log
from .node import Ros2Node
from .settings import settings_from

NODES = ("rclpy", "dds")
"""The kinds of nodes."""
VARIABLE = "UWSIM_ROS2"
"""The variable that selects one of `NODES`; unset or empty: the first that is available."""
REACH = {True: "for nodes on this computer", False: "its ports are open on all addresses"}
"""The texts for a node that only this computer can reach, and for one that others can reach."""
MISSING_EXTRA = "--ros2: neither rclpy nor Cyclone DDS is installed: source a ROS 2, or "
MISSING_EXTRA += "pip install uwsim[ros2]"
"""The error if no kind of node is available."""


def open_node(environment: Mapping[str, str], domain: int | None, log: Log) -> Ros2Node:
    """Join a domain of ROS 2, and report the kind of node.

    Args:
        environment: the environment variables of ROS 2, of Cyclone DDS and ``UWSIM_ROS2``.
        domain: the domain (``--domain``); None: the value of ``ROS_DOMAIN_ID``.
        log: the log of the connection.

    Raises:
        BadSetting: a variable has an invalid value.
        MissingExtra: neither rclpy nor Cyclone DDS is installed.
        UwsimError: the domain cannot be joined.
    """
    kind = read_choice(environment)
    if kind == "dds":
        return _open_dds_node(environment, domain, log)
    try:
        from rclpy.utilities import get_rmw_implementation_identifier

        from .rclpy_node import RclpyNode
    except (ImportError, OSError, RuntimeError) as error:  # the installation may be broken
        if kind == "rclpy":
            raise UwsimError(
                f"--ros2: {VARIABLE}=rclpy, but rclpy cannot be imported: {error}"
            ) from None
        if importlib.util.find_spec("rclpy") is not None:
            log.report(f"rclpy is installed but cannot be imported: {str(error).splitlines()[0]}")
        return _open_dds_node(environment, domain, log)
    node = RclpyNode(settings_from(environment, domain), log)
    log.report(f"a node of rclpy, on {get_rmw_implementation_identifier()}")
    return node


def check(environment: Mapping[str, str], domain: int | None) -> None:
    """Raise an error if no kind of node is available; this does not import rclpy."""
    kind = read_choice(environment)
    if kind == "dds" or importlib.util.find_spec("rclpy") is None:
        _check_dds()
    settings_from(environment, domain)


def read_choice(environment: Mapping[str, str]) -> str:
    """Return the kind of node that the user requests: ``rclpy``, ``dds``, or "" for either."""
    kind = environment.get(VARIABLE, "")
    if kind not in ("", *NODES):
        near = did_you_mean(kind, NODES)
        raise BadSetting(f"{VARIABLE}={kind}: expected {' or '.join(NODES)}.{near}")
    return kind


def _open_dds_node(environment: Mapping[str, str], domain: int | None, log: Log) -> Ros2Node:
    _check_dds()
    from .dds_node import DdsNode

    settings = settings_from(environment, domain)
    node = DdsNode(settings, log, user_xml=environment.get("CYCLONEDDS_URI", ""))
    log.report(f"a node on Cyclone DDS, without rclpy; {REACH[node.is_isolated]}")
    return node


def _check_dds() -> None:
    if importlib.util.find_spec("cyclonedds") is None:
        raise MissingExtra(MISSING_EXTRA)
