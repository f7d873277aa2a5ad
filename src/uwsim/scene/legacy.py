"""Old names that real scene files contain, written anew before they are read.

What UWSim called otherwise in its first years, or had and dropped, becomes what it is called
today, with a notice; so the specs know only one dialect.
"""

from __future__ import annotations

from collections.abc import Callable

from lxml import etree

from ..dialect import Faults, number

Rule = Callable[[etree._Element, etree._Element, Faults], None]


def upgrade(root: etree._Element, faults: Faults) -> None:
    """Rewrite every old element below ``root`` in place; a notice each."""
    for node in list(root.iter("*")):
        parent = node.getparent()
        if parent is None:
            continue
        rule = RULES.get((str(parent.tag), str(node.tag)))
        if rule is not None:
            rule(node, parent, faults)


def _drop(why: str) -> Rule:
    def rule(node: etree._Element, parent: etree._Element, faults: Faults) -> None:
        faults.notice(node, f"<{node.tag}> in <{parent.tag}> {why}; ignored")
        _remove(node)

    return rule


def _visualize(node: etree._Element, parent: etree._Element, faults: Faults) -> None:
    """``<visualize>`` of an odometry input is a ``<showTrajectory>`` of its vehicle."""
    style = _text(node)
    vehicle = _text(parent.find("vehicleName"))
    root = parent.getroottree().getroot()
    _remove(node)
    faults.notice(node, f"<visualize> is an old way to write <showTrajectory> of {vehicle!r}")
    if style not in ("1", "2", "3", "4") or not vehicle:
        return
    params = root.find("simParams")
    if params is None:
        params = _new(root, "simParams", line=node.sourceline)
    trajectory = _new(params, "showTrajectory", line=node.sourceline)
    _new(trajectory, "target", vehicle, line=node.sourceline)
    _new(trajectory, "lineStyle", style, line=node.sourceline)


def _numpixels(node: etree._Element, parent: etree._Element, faults: Faults) -> None:
    """``<numpixels>`` beams over ``<fieldOfView>`` degrees become first, last and step."""
    wide = parent.find("fieldOfView")
    beams, angle = number(_text(node)), number(_text(wide))
    if wide is None or beams is None or angle is None or beams < 2:
        faults.add(node, "<numpixels> needs two beams or more and a <fieldOfView> [deg]")
        return
    faults.notice(
        node, "<numpixels> and <fieldOfView> are read as initAngle, finalAngle, angleIncr"
    )
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

    def rule(node: etree._Element, parent: etree._Element, faults: Faults) -> None:
        locked = [number(_text(node.find(axis))) == 0 for axis in "xyz"]
        faults.notice(node, f"<{node.tag}> is read as min{kind}Limit and max{kind}Limit")
        for name, free in ((f"min{kind}Limit", "1"), (f"max{kind}Limit", "0")):
            if parent.find(name) is None:
                limit = _new(parent, name, line=node.sourceline)
                for axis, is_locked in zip("xyz", locked, strict=True):
                    _new(limit, axis, "0" if is_locked else free, line=node.sourceline)
        _remove(node)

    return rule


def _comms_device(node: etree._Element, parent: etree._Element, faults: Faults) -> None:
    """``<CommsDevice>`` is a ``<CustomCommsDevice>`` with other names."""
    faults.notice(node, "<CommsDevice> is an old name of <CustomCommsDevice>")
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
            rule(child, node, faults)


def _max_bit_rate(node: etree._Element, parent: etree._Element, faults: Faults) -> None:
    faults.notice(node, "<maxBitRate> is an old name of <bitrate>")
    if parent.find("bitrate") is None:
        node.tag = "bitrate"
    else:
        _remove(node)


def _packet_errors(node: etree._Element, parent: etree._Element, faults: Faults) -> None:
    """``<minPktErrRatio>`` and ``<pktErrRatioIncPerMeter>`` become an error expression."""
    least, more = parent.find("minPktErrRatio"), parent.find("pktErrRatioIncPerMeter")
    faults.notice(node, f"<{node.tag}> is read as <rateErrorModel>")
    if parent.find("rateErrorModel") is None:
        model = _new(parent, "rateErrorModel", line=node.sourceline)
        _new(model, "errorUnit", "packet", line=node.sourceline)
        formula = f"{_text(least) or '0'}+{_text(more) or '0'}*m"
        _new(model, "errorRateExpr", formula, line=node.sourceline)
    _remove(least)
    _remove(more)


def _mac_protocol(node: etree._Element, parent: etree._Element, faults: Faults) -> None:
    """``<macProtocol>`` once was its name alone."""
    if len(node) == 0 and (name := _text(node)):
        faults.notice(node, f"<macProtocol> {name} is read as <macProtocol> <name>")
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


RULES: dict[tuple[str, str], Rule] = {
    ("ROSOdomToPAT", "visualize"): _visualize,
    ("simParams", "physicsWater"): _drop("is Bullet's fluid, removed from UWSim in 2014"),
    ("simParams", "eye_in_hand"): _drop("never had an effect"),
    ("structuredLightProjector", "visible"): _drop("had no effect since 2013"),
    ("multibeamSensor", "numpixels"): _numpixels,
    ("physics", "linearFactor"): _factor("Linear"),
    ("physics", "angularFactor"): _factor("Angular"),
    ("vehicle", "CommsDevice"): _comms_device,
    ("CustomCommsDevice", "maxBitRate"): _max_bit_rate,
    ("CustomCommsDevice", "bitrateSd"): _drop("was dropped from UWSim-NET"),
    ("CustomCommsDevice", "minPktErrRatio"): _packet_errors,
    ("CustomCommsDevice", "pktErrRatioIncPerMeter"): _packet_errors,
    ("CustomCommsDevice", "macProtocol"): _mac_protocol,
    ("AcousticCommsDevice", "macProtocol"): _mac_protocol,
}
"""(parent, old element) -> what to do with it."""
