"""Settings of the discovery of a ROS 2 graph: the domain, and the network interfaces.

The variables are those of ROS 2 (Jazzy): ``ROS_DOMAIN_ID``, ``ROS_AUTOMATIC_DISCOVERY_RANGE``
(``LOCALHOST``, ``SUBNET``), ``ROS_LOCALHOST_ONLY`` (``1``, ``0``; it takes precedence, as there)
and ``ROS_STATIC_PEERS``. Unlike a node of ROS 2, the simulator uses only this computer if none is
set.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from xml.sax.saxutils import quoteattr

from ...errors import BadSetting, did_you_mean

NODE = "uwsim"
"""The name of the node."""
MAX_DOMAIN = 232
"""The largest domain whose UDP ports are below 65536."""
RANGES = ("LOCALHOST", "SUBNET")
"""The supported values of ``ROS_AUTOMATIC_DISCOVERY_RANGE``."""
LOOPBACK = "127.0.0.1"
"""The address of the loopback interface."""
FRAGMENTS = (
    "<MaxMessageSize>65500B</MaxMessageSize><FragmentSize>65000B</FragmentSize>"
    "<MaxRexmitMessageSize>65500B</MaxRexmitMessageSize>"
)
"""The size of datagrams; with fragments of 1.3 kB, a reader on Fast DDS loses most images."""
BUFFERS = (
    '<SocketReceiveBufferSize min="default" max="10MB"/>'
    "<Watermarks><WhcHigh>16MB</WhcHigh></Watermarks>"
)
"""The size of buffers, for several images that are received but not acknowledged yet."""


@dataclass(frozen=True, kw_only=True)
class Ros2Settings:
    """The domain and the network interfaces of the discovery."""

    domain: int = 0
    """The DDS domain, 0 to 232."""
    is_local: bool = True
    """True if only the loopback interface is used."""
    static_peers: tuple[str, ...] = ()
    """The addresses of computers with further participants."""

    @property
    def variables(self) -> dict[str, str]:
        """The discovery range as an environment variable of ROS 2, for rclpy."""
        return {"ROS_AUTOMATIC_DISCOVERY_RANGE": RANGES[0] if self.is_local else RANGES[1]}

    def configuration(self, user_xml: str = "") -> str:
        """Return the settings of Cyclone DDS, overridden by ``user_xml`` (``CYCLONEDDS_URI``)."""
        network, discovery = FRAGMENTS, "<ParticipantIndex>auto</ParticipantIndex>"
        peers = list(self.static_peers)
        if self.is_local:
            network = (
                f'<Interfaces><NetworkInterface address="{LOOPBACK}" multicast="false"/>'
                f"</Interfaces><AllowMulticast>false</AllowMulticast>{FRAGMENTS}"
            )
            peers.insert(0, LOOPBACK)
            discovery += "<SPDPInterval>0.5s</SPDPInterval>"
        if peers:
            peer_elements = "".join(f"<Peer address={quoteattr(peer)}/>" for peer in peers)
            discovery += f"<Peers>{peer_elements}</Peers>"
        text = (
            '<CycloneDDS><Domain Id="any">'
            f"<General>{network}</General>"
            "<Discovery><MaxAutoParticipantIndex>99</MaxAutoParticipantIndex>"
            f"{discovery}</Discovery><Internal>{BUFFERS}</Internal></Domain></CycloneDDS>"
        )
        return f"{text},{user_xml}" if user_xml else text


def settings_from(environment: Mapping[str, str], domain: int | None = None) -> Ros2Settings:
    """Return the settings; ``domain`` (``--domain``) takes precedence over ``ROS_DOMAIN_ID``.

    Raises:
        BadSetting: a variable has a value that ROS 2 does not accept.
    """
    domain_id = domain
    source = f"--domain {domain}"
    if domain_id is None:
        text = environment.get("ROS_DOMAIN_ID", "") or "0"
        source = f"ROS_DOMAIN_ID={text}"
        if not text.isascii() or not text.isdigit():
            raise BadSetting(f"{source}: expected a number from 0 to {MAX_DOMAIN}.")
        domain_id = int(text)
    if not 0 <= domain_id <= MAX_DOMAIN:
        raise BadSetting(f"{source}: expected a number from 0 to {MAX_DOMAIN}.")
    peers = environment.get("ROS_STATIC_PEERS", "").split(";")
    return Ros2Settings(
        domain=domain_id,
        is_local=_is_local(environment),
        static_peers=tuple(peer.strip() for peer in peers if peer.strip()),
    )


def _is_local(environment: Mapping[str, str]) -> bool:
    localhost_only = environment.get("ROS_LOCALHOST_ONLY", "")
    if localhost_only in ("0", "1"):
        return localhost_only == "1"
    if localhost_only:
        raise BadSetting(f"ROS_LOCALHOST_ONLY={localhost_only}: expected 1 or 0.")
    scope = environment.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "") or "LOCALHOST"
    if scope not in RANGES:
        near = did_you_mean(scope, RANGES)
        raise BadSetting(
            f"ROS_AUTOMATIC_DISCOVERY_RANGE={scope}: expected {' or '.join(RANGES)}.{near}"
        )
    return scope == "LOCALHOST"
