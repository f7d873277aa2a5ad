"""Conversion of obsolete elements in scene files, before the files are read.

Elements that the original UWSim has renamed or removed over the years are converted to the present
ones, with a warning, so that the specs describe only one dialect.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from lxml import etree

from ..schema import NAMESPACE, Diagnostics, parse_number

U = f"{{{NAMESPACE}}}"
BEAM_RANGE = "10"
"""The range for multibeams of March 2013, which have none: that in scenes of UWSim [m]."""

Node = etree._Element
Rule = Callable[[Node, Node, Diagnostics], None]


def upgrade(root: Node, diagnostics: Diagnostics) -> None:
    """Convert every obsolete element below ``root`` in place, with a warning for each."""
    for node in list(root.iter("*")):
        parent = node.getparent()
        if parent is None:
            continue
        rule = RULES.get((str(parent.tag), str(node.tag))) or ANY_PARENT_RULES.get(str(node.tag))
        if rule is not None:
            rule(node, parent, diagnostics)


def _drop(reason: str) -> Rule:
    def rule(node: Node, parent: Node, diagnostics: Diagnostics) -> None:
        diagnostics.warning(node, f"<{node.tag}> in <{parent.tag}> {reason}; ignored")
        _remove(node)

    return rule


def _convert_visualize(node: Node, parent: Node, diagnostics: Diagnostics) -> None:
    style = _text(node)
    vehicle = _text(parent.find("vehicleName"))
    root = parent.getroottree().getroot()
    _remove(node)
    diagnostics.warning(node, f"<visualize> is an old way to write <showTrajectory> of {vehicle!r}")
    if style not in ("1", "2", "3", "4") or not vehicle:
        return
    params = root.find("simParams")
    if params is None:
        params = _add(root, "simParams", line=node.sourceline)
    trajectory = _add(params, "showTrajectory", line=node.sourceline)
    _add(trajectory, "target", vehicle, line=node.sourceline)
    _add(trajectory, "lineStyle", style, line=node.sourceline)


def _convert_numpixels(node: Node, parent: Node, diagnostics: Diagnostics) -> None:
    field_of_view = parent.find("fieldOfView")
    n_beams, angle = parse_number(_text(node)), parse_number(_text(field_of_view))
    if field_of_view is None or n_beams is None or angle is None or n_beams < 2:
        diagnostics.error(node, "<numpixels> needs two beams or more and a <fieldOfView> [deg]")
        return
    message = "<numpixels> and <fieldOfView> are read as initAngle, finalAngle, angleIncr"
    if parent.find("range") is None:
        message += f"; there is no <range>: {BEAM_RANGE} m, as in UWSim's scenes"
        _add(parent, "range", BEAM_RANGE, line=node.sourceline)
    diagnostics.warning(node, message)
    for name, value in (
        ("initAngle", -angle / 2),
        ("finalAngle", angle / 2),
        ("angleIncr", angle / (n_beams - 1)),
    ):
        _add(parent, name, repr(value), line=node.sourceline)
    _remove(node)
    _remove(field_of_view)


def _convert_factor(kind: str) -> Rule:
    """Return the rule that converts factors of axes to limits: a factor of 0 locks an axis."""

    def rule(node: Node, parent: Node, diagnostics: Diagnostics) -> None:
        locks = [parse_number(_text(node.find(axis))) == 0 for axis in "xyz"]
        diagnostics.warning(node, f"<{node.tag}> is read as min{kind}Limit and max{kind}Limit")
        for name, bound in ((f"min{kind}Limit", "1"), (f"max{kind}Limit", "0")):
            if parent.find(name) is None:
                limit = _add(parent, name, line=node.sourceline)
                for axis, is_locked in zip("xyz", locks, strict=True):
                    _add(limit, axis, "0" if is_locked else bound, line=node.sourceline)
        _remove(node)

    return rule


def _convert_current(node: Node, parent: Node, diagnostics: Diagnostics) -> None:
    diagnostics.warning(
        node, "<current> is read as <u:current> <u:uwsimSinusoid>, its <forceModule> as <u:speed>"
    )
    current = _add(parent, f"{U}current", line=node.sourceline)
    sinusoid = _add(current, f"{U}uwsimSinusoid", line=node.sourceline)
    for old_name, new_name in SINUSOID_ELEMENTS.items():
        child = node.find(old_name)
        text = _text(child)
        is_no_period = new_name.endswith("Period") and parse_number(text) == 0
        if child is not None and text and not is_no_period:  # a period of 0: no variation
            _add(sinusoid, U + new_name, text, line=child.sourceline)
    _remove(node)


def _unwrap(kept_tag: str = "") -> Rule:
    """Return the rule that moves the elements in a wrapper element to its parent.

    The original UWSim accepts any device, or interface, in these wrappers. Only ``<echo>`` and
    ``<echoROS>`` remain in the wrapper, where the grammar of UWSim allows them.

    Args:
        kept_tag: the name of the elements that remain in the wrapper.
    """

    def rule(node: Node, parent: Node, diagnostics: Diagnostics) -> None:
        _move_to_device(node, diagnostics)
        is_first = parent.find(str(node.tag)) is node
        keeps_echo = bool(kept_tag) and is_first
        elements = [child for child in node if isinstance(child.tag, str)]
        moved_children = [
            child for child in elements if not (keeps_echo and _is_kept(child, kept_tag))
        ]
        if moved_children:
            names = ", ".join(dict.fromkeys(f"<{child.tag}>" for child in moved_children))
            diagnostics.warning(node, f"{names} in <{node.tag}>: read as in <{parent.tag}>")
        for index, child in enumerate(moved_children, start=parent.index(node) + 1):
            parent.insert(index, child)
        is_empty = not any(isinstance(child.tag, str) for child in node)
        if is_empty and not keeps_echo:
            _remove(node)

    return rule


def _move_to_device(wrapper: Node, diagnostics: Diagnostics) -> None:
    """Move a name, topic or text in a wrapper, as in files of June 2013, into its device.

    If the wrapper contains no device, the text of ``<type>`` names the element of the device. If it
    contains several, the elements are moved to the first, unless it has them.
    """
    device_elements = [child for child in wrapper if child.tag in DEVICE_ELEMENTS]
    elements = [child for child in wrapper if isinstance(child.tag, str)]
    devices = [child for child in elements if child.tag not in DEVICE_ELEMENTS]
    if not device_elements:
        return
    kind = next((_text(child) for child in device_elements if child.tag == "type"), "")
    if not devices and kind:
        is_interface = wrapper.tag in ("SimulatedDeviceROS", "SimulatedDevicesROS")
        name = f"{kind.removesuffix('ROS')}{'ROS' * is_interface}"
        if ELEMENT_NAME.fullmatch(name):
            devices = [_add(wrapper, name, line=wrapper.sourceline)]
    names = ", ".join(f"<{child.tag}>" for child in device_elements)
    if not devices:
        diagnostics.error(wrapper, f"{names} in <{wrapper.tag}>, which has no device")
    else:
        diagnostics.warning(wrapper, f"{names} of <{wrapper.tag}>: read as in <{devices[0].tag}>")
    for child in device_elements:
        wrapper.remove(child)
        if devices and child.tag != "type" and devices[0].find(child.tag) is None:
            devices[0].append(child)


def _is_kept(child: Node, kept_tag: str) -> bool:
    """Return whether a child remains in a wrapper: any ``<echo>``, or the first ``<echoROS>``."""
    wrapper = child.getparent()
    is_only = kept_tag == "echo" or (wrapper is not None and wrapper.find(kept_tag) is child)
    return child.tag == kept_tag and is_only


def _rename(new_tag: str) -> Rule:
    def rule(node: Node, parent: Node, diagnostics: Diagnostics) -> None:
        diagnostics.warning(node, f"<{node.tag}> is an old name of <{new_tag}>")
        node.tag = new_tag

    return rule


def _convert_comms_device(node: Node, parent: Node, diagnostics: Diagnostics) -> None:
    diagnostics.warning(node, "<CommsDevice> is an old name of <CustomCommsDevice>")
    node.tag = "CustomCommsDevice"
    for old_name, new_name in (("name", "dccommsId"), ("trTime", "intrinsicDelay")):
        child = node.find(old_name)
        if child is not None:
            child.tag = new_name
    for name in ("txChannelId", "rxChannelId"):
        if node.find(name) is None:
            _add(node, name, _text(node.find("channelId")) or "0", line=node.sourceline)
    _remove(node.find("channelId"))
    for child in list(node):
        rule = RULES.get(("CustomCommsDevice", str(child.tag)))
        if rule is not None:
            rule(child, node, diagnostics)


def _convert_max_bit_rate(node: Node, parent: Node, diagnostics: Diagnostics) -> None:
    diagnostics.warning(node, "<maxBitRate> is an old name of <bitrate>")
    if parent.find("bitrate") is None:
        node.tag = "bitrate"
    else:
        _remove(node)


def _convert_packet_errors(node: Node, parent: Node, diagnostics: Diagnostics) -> None:
    min_ratio, slope = parent.find("minPktErrRatio"), parent.find("pktErrRatioIncPerMeter")
    diagnostics.warning(node, f"<{node.tag}> is read as <rateErrorModel>")
    if parent.find("rateErrorModel") is None:
        model = _add(parent, "rateErrorModel", line=node.sourceline)
        _add(model, "errorUnit", "packet", line=node.sourceline)
        formula = f"{_text(min_ratio) or '0'}+{_text(slope) or '0'}*m"
        _add(model, "errorRateExpr", formula, line=node.sourceline)
    _remove(min_ratio)
    _remove(slope)


def _convert_mac_protocol(node: Node, parent: Node, diagnostics: Diagnostics) -> None:
    if len(node) == 0 and (name := _text(node)):
        diagnostics.warning(node, f"<macProtocol> {name} is read as <macProtocol> <name>")
        node.text = None
        _add(node, "name", name, line=node.sourceline)


def _text(node: Node | None) -> str:
    return "" if node is None else (node.text or "").strip()


def _add(parent: Node, tag: str, text: str | None = None, *, line: object) -> Node:
    node = etree.SubElement(parent, tag)
    node.text = text
    if isinstance(line, int):
        node.sourceline = line  # type: ignore[assignment]  # the stubs type it as an ellipsis
    return node


def _remove(node: Node | None) -> None:
    parent = None if node is None else node.getparent()
    if node is not None and parent is not None:
        parent.remove(node)


SINUSOID_ELEMENTS = {
    "forceModule": "speed",
    "forceVariation": "speedVariation",
    "forcePeriod": "speedPeriod",
    "sphericalDirection/theta": "theta",
    "directionVariation/theta": "thetaVariation",
    "directionPeriod/theta": "thetaPeriod",
    "sphericalDirection/phi": "phi",
    "directionVariation/phi": "phiVariation",
    "directionPeriod/phi": "phiPeriod",
    "random": "random",
}
"""The name of an element in ``<u:uwsimSinusoid>``, by its path in an obsolete ``<current>``."""

DEVICE_ELEMENTS = ("name", "type", "info", "topic", "rate")
"""The elements of a device that files of June 2013 have in its wrapper."""
ELEMENT_NAME = re.compile(r"[A-Za-z]\w{0,40}")

ANY_PARENT_RULES: dict[str, Rule] = {
    "includesFixedAndMimic": _drop("had no effect"),
}
"""The rules for obsolete elements in any parent, by element name."""

FORKS: dict[tuple[str, str], Rule] = {
    ("camera", "oculus"): _drop("is of a fork with head-mounted displays"),
    ("camera", "windshield"): _drop("is of a fork with head-mounted displays"),
    ("rosInterfaces", "ObjectPickedToROS"): _drop("is of a fork of 2013 and not simulated"),
    ("oceanState", "reflection"): _drop("is of usv_sim, a fork for surface vessels"),
    ("simParams", "groundTruth"): _drop("is of usv_sim, a fork for surface vessels"),
    ("rosInterfaces", "OceanSurfaceToROSOceanVehicle"): _drop(
        "is of usv_sim, a fork for surface vessels, and not simulated"
    ),
    ("vehicle", "vehiclePhysics"): _drop("is of a fork with devices of its own; not simulated"),
    ("vehicle", "vehicleMass"): _drop("is of a fork with devices of its own; not simulated"),
}
"""The rule for each (parent, element) that only forks of UWSim define."""

RULES: dict[tuple[str, str], Rule] = {
    **FORKS,
    ("ROSOdomToPAT", "visualize"): _convert_visualize,
    ("oceanState", "current"): _convert_current,
    ("simParams", "disableTextures"): _drop("was an option of UWSim's first years"),
    ("simParams", "physicsWater"): _drop("is Bullet's fluid, removed from UWSim in 2014"),
    ("simParams", "eye_in_hand"): _drop("never had an effect"),
    ("structuredLightProjector", "visible"): _drop("had no effect since 2013"),
    ("multibeamSensor", "numpixels"): _convert_numpixels,
    ("physics", "linearFactor"): _convert_factor("Linear"),
    ("physics", "angularFactor"): _convert_factor("Angular"),
    ("vehicle", "simulatedDevices"): _unwrap(kept_tag="echo"),
    ("vehicle", "simulatedDevice"): _unwrap(),
    ("rosInterfaces", "SimulatedDeviceROS"): _unwrap(kept_tag="echoROS"),
    ("rosInterfaces", "SimulatedDevicesROS"): _unwrap(),
    ("rosInterfaces", "CommsDeviceROS"): _rename("CustomCommsDeviceROS"),
    ("vehicle", "CommsDevice"): _convert_comms_device,
    ("CustomCommsDevice", "maxBitRate"): _convert_max_bit_rate,
    ("CustomCommsDevice", "bitrateSd"): _drop("was dropped from UWSim-NET"),
    ("CustomCommsDevice", "minPktErrRatio"): _convert_packet_errors,
    ("CustomCommsDevice", "pktErrRatioIncPerMeter"): _convert_packet_errors,
    ("CustomCommsDevice", "macProtocol"): _convert_mac_protocol,
    ("AcousticCommsDevice", "macProtocol"): _convert_mac_protocol,
}
"""The rule for each obsolete (parent, element)."""
