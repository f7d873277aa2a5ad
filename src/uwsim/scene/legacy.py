"""Converts obsolete elements of existing scene files before they are read.

What UWSim called otherwise in its first years, or had and dropped, becomes what it is called
today, with a warning; so the specs know only one dialect.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from lxml import etree

from ..schema import NAMESPACE, Diagnostics, parse_number

U = f"{{{NAMESPACE}}}"
BEAM_RANGE = "10"
"""Of the multibeams in the original's scenes; those of March 2013 had none [m]."""

Rule = Callable[[etree._Element, etree._Element, Diagnostics], None]


def upgrade(root: etree._Element, diagnostics: Diagnostics) -> None:
    """Rewrite every old element below ``root`` in place; a warning each."""
    for node in list(root.iter("*")):
        parent = node.getparent()
        if parent is None:
            continue
        rule = RULES.get((str(parent.tag), str(node.tag))) or ANYWHERE.get(str(node.tag))
        if rule is not None:
            rule(node, parent, diagnostics)


def _drop(why: str) -> Rule:
    def rule(node: etree._Element, parent: etree._Element, diagnostics: Diagnostics) -> None:
        diagnostics.warning(node, f"<{node.tag}> in <{parent.tag}> {why}; ignored")
        _remove(node)

    return rule


def _visualize(node: etree._Element, parent: etree._Element, diagnostics: Diagnostics) -> None:
    """``<visualize>`` of an odometry input is a ``<showTrajectory>`` of its vehicle."""
    style = _text(node)
    vehicle = _text(parent.find("vehicleName"))
    root = parent.getroottree().getroot()
    _remove(node)
    diagnostics.warning(node, f"<visualize> is an old way to write <showTrajectory> of {vehicle!r}")
    if style not in ("1", "2", "3", "4") or not vehicle:
        return
    params = root.find("simParams")
    if params is None:
        params = _new(root, "simParams", line=node.sourceline)
    trajectory = _new(params, "showTrajectory", line=node.sourceline)
    _new(trajectory, "target", vehicle, line=node.sourceline)
    _new(trajectory, "lineStyle", style, line=node.sourceline)


def _numpixels(node: etree._Element, parent: etree._Element, diagnostics: Diagnostics) -> None:
    """``<numpixels>`` beams over ``<fieldOfView>`` degrees become first, last and step."""
    wide = parent.find("fieldOfView")
    beams, angle = parse_number(_text(node)), parse_number(_text(wide))
    if wide is None or beams is None or angle is None or beams < 2:
        diagnostics.error(node, "<numpixels> needs two beams or more and a <fieldOfView> [deg]")
        return
    message = "<numpixels> and <fieldOfView> are read as initAngle, finalAngle, angleIncr"
    if parent.find("range") is None:
        message += f"; there is no <range>: {BEAM_RANGE} m, as in the original's scenes"
        _new(parent, "range", BEAM_RANGE, line=node.sourceline)
    diagnostics.warning(node, message)
    for name, value in (
        ("initAngle", -angle / 2),
        ("finalAngle", angle / 2),
        ("angleIncr", angle / (beams - 1)),
    ):
        _new(parent, name, repr(value), line=node.sourceline)
    _remove(node)
    _remove(wide)


def _factor(kind: str) -> Rule:
    """An axis whose factor is 0 is locked: its limits are equal."""

    def rule(node: etree._Element, parent: etree._Element, diagnostics: Diagnostics) -> None:
        locked = [parse_number(_text(node.find(axis))) == 0 for axis in "xyz"]
        diagnostics.warning(node, f"<{node.tag}> is read as min{kind}Limit and max{kind}Limit")
        for name, free in ((f"min{kind}Limit", "1"), (f"max{kind}Limit", "0")):
            if parent.find(name) is None:
                limit = _new(parent, name, line=node.sourceline)
                for axis, is_locked in zip("xyz", locked, strict=True):
                    _new(limit, axis, "0" if is_locked else free, line=node.sourceline)
        _remove(node)

    return rule


def _current(node: etree._Element, parent: etree._Element, diagnostics: Diagnostics) -> None:
    """``<current>`` of the benchmarks of 2013: today's ``currentForceUpdater``, at one level."""
    diagnostics.warning(
        node, "<current> is read as <u:current> <u:uwsimSinusoid>, its <forceModule> as <u:speed>"
    )
    current = _new(parent, f"{U}current", line=node.sourceline)
    sinusoid = _new(current, f"{U}uwsimSinusoid", line=node.sourceline)
    for old, new in SINUSOID.items():
        child = node.find(old)
        text = _text(child)
        is_no_period = new.endswith("Period") and parse_number(text) == 0
        if child is not None and text and not is_no_period:  # a period of 0: nothing varies
            _new(sinusoid, U + new, text, line=child.sourceline)
    _remove(node)


def _wrapper(kept: str = "") -> Rule:
    """The elements in a wrapper are read as siblings of it.

    The original takes any device in one, and its interface; of the wrapper that its grammar knows
    the echoes stay in it.
    """

    def rule(node: etree._Element, parent: etree._Element, diagnostics: Diagnostics) -> None:
        _hand_down(node, diagnostics)
        is_first = parent.find(str(node.tag)) is node
        moved = [
            child
            for child in node
            if isinstance(child.tag, str) and not (kept and is_first and _stays(child, kept))
        ]
        if moved:
            names = ", ".join(dict.fromkeys(f"<{child.tag}>" for child in moved))
            diagnostics.warning(node, f"{names} in <{node.tag}>: read as in <{parent.tag}>")
        for place, child in enumerate(moved, start=parent.index(node) + 1):
            parent.insert(place, child)
        is_empty = not any(isinstance(child.tag, str) for child in node)
        if is_empty and not (kept and is_first):
            _remove(node)

    return rule


def _hand_down(wrapper: etree._Element, diagnostics: Diagnostics) -> None:
    """Move a name, a topic or a text of a wrapper, as in files of June 2013, into its device.

    Without an element of a device, ``<type>`` says which it is. Of several devices the first has
    the name; one that has its own keeps it.
    """
    own = [child for child in wrapper if child.tag in OF_DEVICES]
    devices = [
        child for child in wrapper if isinstance(child.tag, str) and child.tag not in OF_DEVICES
    ]
    if not own:
        return
    kind = next((_text(child) for child in own if child.tag == "type"), "")
    if not devices and kind:
        is_interface = wrapper.tag in ("SimulatedDeviceROS", "SimulatedDevicesROS")
        name = f"{kind.removesuffix('ROS')}{'ROS' * is_interface}"
        if NAME_OF_ELEMENT.fullmatch(name):
            devices = [_new(wrapper, name, line=wrapper.sourceline)]
    names = ", ".join(f"<{child.tag}>" for child in own)
    if not devices:
        diagnostics.error(wrapper, f"{names} in <{wrapper.tag}>, which has no device in it")
    else:
        diagnostics.warning(wrapper, f"{names} of <{wrapper.tag}>: read as in <{devices[0].tag}>")
    for child in own:
        wrapper.remove(child)
        if devices and child.tag != "type" and devices[0].find(child.tag) is None:
            devices[0].append(child)


def _stays(child: etree._Element, kept: str) -> bool:
    """Whether a child of a wrapper may stay: an echo; of the echoes' interfaces the first."""
    wrapper = child.getparent()
    is_only = kept == "echo" or (wrapper is not None and wrapper.find(kept) is child)
    return child.tag == kept and is_only


def _rename(new: str) -> Rule:
    def rule(node: etree._Element, parent: etree._Element, diagnostics: Diagnostics) -> None:
        diagnostics.warning(node, f"<{node.tag}> is an old name of <{new}>")
        node.tag = new

    return rule


def _comms_device(node: etree._Element, parent: etree._Element, diagnostics: Diagnostics) -> None:
    """``<CommsDevice>`` is a ``<CustomCommsDevice>`` with other names."""
    diagnostics.warning(node, "<CommsDevice> is an old name of <CustomCommsDevice>")
    node.tag = "CustomCommsDevice"
    for old, new in (("name", "dccommsId"), ("trTime", "intrinsicDelay")):
        child = node.find(old)
        if child is not None:
            child.tag = new
    for name in ("txChannelId", "rxChannelId"):
        if node.find(name) is None:
            _new(node, name, _text(node.find("channelId")) or "0", line=node.sourceline)
    _remove(node.find("channelId"))
    for child in list(node):
        rule = RULES.get(("CustomCommsDevice", str(child.tag)))
        if rule is not None:
            rule(child, node, diagnostics)


def _max_bit_rate(node: etree._Element, parent: etree._Element, diagnostics: Diagnostics) -> None:
    diagnostics.warning(node, "<maxBitRate> is an old name of <bitrate>")
    if parent.find("bitrate") is None:
        node.tag = "bitrate"
    else:
        _remove(node)


def _packet_errors(node: etree._Element, parent: etree._Element, diagnostics: Diagnostics) -> None:
    """``<minPktErrRatio>`` and ``<pktErrRatioIncPerMeter>`` become an error expression."""
    least, more = parent.find("minPktErrRatio"), parent.find("pktErrRatioIncPerMeter")
    diagnostics.warning(node, f"<{node.tag}> is read as <rateErrorModel>")
    if parent.find("rateErrorModel") is None:
        model = _new(parent, "rateErrorModel", line=node.sourceline)
        _new(model, "errorUnit", "packet", line=node.sourceline)
        formula = f"{_text(least) or '0'}+{_text(more) or '0'}*m"
        _new(model, "errorRateExpr", formula, line=node.sourceline)
    _remove(least)
    _remove(more)


def _mac_protocol(node: etree._Element, parent: etree._Element, diagnostics: Diagnostics) -> None:
    """``<macProtocol>`` once was its name alone."""
    if len(node) == 0 and (name := _text(node)):
        diagnostics.warning(node, f"<macProtocol> {name} is read as <macProtocol> <name>")
        node.text = None
        _new(node, "name", name, line=node.sourceline)


def _text(node: etree._Element | None) -> str:
    return "" if node is None else (node.text or "").strip()


def _new(
    parent: etree._Element, tag: str, text: str | None = None, *, line: object
) -> etree._Element:
    node = etree.SubElement(parent, tag)
    node.text = text
    if isinstance(line, int):
        node.sourceline = line  # type: ignore[assignment]  # the stubs type it as an ellipsis
    return node


def _remove(node: etree._Element | None) -> None:
    parent = None if node is None else node.getparent()
    if node is not None and parent is not None:
        parent.remove(node)


SINUSOID = {
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
"""Element of a ``<current>`` -> of a ``<u:uwsimSinusoid>``."""

OF_DEVICES = ("name", "type", "info", "topic", "rate")
"""Elements that files of June 2013 have in a wrapper and not in the device in it."""
NAME_OF_ELEMENT = re.compile(r"[A-Za-z]\w{0,40}")

ANYWHERE: dict[str, Rule] = {
    "includesFixedAndMimic": _drop("had no effect"),
}
"""Obsolete element, whatever its parent -> its conversion."""

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
"""(parent, element) of forks of UWSim -> what to do with it."""

RULES: dict[tuple[str, str], Rule] = {
    **FORKS,
    ("ROSOdomToPAT", "visualize"): _visualize,
    ("oceanState", "current"): _current,
    ("simParams", "disableTextures"): _drop("was an option of UWSim's first years"),
    ("simParams", "physicsWater"): _drop("is Bullet's fluid, removed from UWSim in 2014"),
    ("simParams", "eye_in_hand"): _drop("never had an effect"),
    ("structuredLightProjector", "visible"): _drop("had no effect since 2013"),
    ("multibeamSensor", "numpixels"): _numpixels,
    ("physics", "linearFactor"): _factor("Linear"),
    ("physics", "angularFactor"): _factor("Angular"),
    ("vehicle", "simulatedDevices"): _wrapper(kept="echo"),
    ("vehicle", "simulatedDevice"): _wrapper(),
    ("rosInterfaces", "SimulatedDeviceROS"): _wrapper(kept="echoROS"),
    ("rosInterfaces", "SimulatedDevicesROS"): _wrapper(),
    ("rosInterfaces", "CommsDeviceROS"): _rename("CustomCommsDeviceROS"),
    ("vehicle", "CommsDevice"): _comms_device,
    ("CustomCommsDevice", "maxBitRate"): _max_bit_rate,
    ("CustomCommsDevice", "bitrateSd"): _drop("was dropped from UWSim-NET"),
    ("CustomCommsDevice", "minPktErrRatio"): _packet_errors,
    ("CustomCommsDevice", "pktErrRatioIncPerMeter"): _packet_errors,
    ("CustomCommsDevice", "macProtocol"): _mac_protocol,
    ("AcousticCommsDevice", "macProtocol"): _mac_protocol,
}
"""(parent, old element) -> what to do with it."""
