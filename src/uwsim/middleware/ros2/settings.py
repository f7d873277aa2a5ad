"""Where a ROS 2 graph is looked for: the domain, and which network interfaces are used.

The variables are those of ROS 2 (Jazzy): ``ROS_DOMAIN_ID``, ``ROS_AUTOMATIC_DISCOVERY_RANGE``
(``LOCALHOST``, ``SUBNET``), ``ROS_LOCALHOST_ONLY`` (``1``, ``0``; it takes precedence, as there)
and ``ROS_STATIC_PEERS``. Unlike a node of ROS 2, the simulator keeps to this computer if none is
set.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from xml.sax.saxutils import quoteattr

from ...errors import BadSetting, did_you_mean

NODE = "uwsim"
"""Name of the node."""
MAX_DOMAIN = 232
"""The largest domain whose UDP ports are below 65536."""
RANGES = ("LOCALHOST", "SUBNET")
LOOPBACK = "127.0.0.1"
FRAGMENTS = (
    "<MaxMessageSize>65500B</MaxMessageSize><FragmentSize>65000B</FragmentSize>"
    "<MaxRexmitMessageSize>65500B</MaxRexmitMessageSize>"
)
"""Large datagrams: with fragments of 1.3 kB a reader of Fast DDS loses most images."""
BUFFERS = (
    '<SocketReceiveBufferSize min="default" max="10MB"/>'
    "<Watermarks><WhcHigh>16MB</WhcHigh></Watermarks>"
)
"""Room for several images, received and not acknowledged yet."""


@dataclass(frozen=True, kw_only=True)
class Ros2Settings:
    """Where to look for other participants."""

    domain: int = 0
    """DDS domain, 0 to 232."""
    is_local: bool = True
    """Whether only the loopback interface is used."""
    static_peers: tuple[str, ...] = ()
    """Addresses at which to look for participants besides."""

    @property
    def variables(self) -> dict[str, str]:
        """Variables of ROS 2 by which rclpy looks there, too, where the user has set none."""
        return {"ROS_AUTOMATIC_DISCOVERY_RANGE": RANGES[0] if self.is_local else RANGES[1]}

    def configuration(self, more: str = "") -> str:
        """Return the configuration of Cyclone DDS; ``more`` (``CYCLONEDDS_URI``) overrides it."""
        general, discovery = FRAGMENTS, "<ParticipantIndex>auto</ParticipantIndex>"
        peers = list(self.static_peers)
        if self.is_local:
            general = (
                f'<Interfaces><NetworkInterface address="{LOOPBACK}" multicast="false"/>'
                f"</Interfaces><AllowMulticast>false</AllowMulticast>{FRAGMENTS}"
            )
            peers.insert(0, LOOPBACK)
            discovery += "<SPDPInterval>0.5s</SPDPInterval>"
        if peers:
            found = "".join(f"<Peer address={quoteattr(peer)}/>" for peer in peers)
            discovery += f"<Peers>{found}</Peers>"
        text = (
            '<CycloneDDS><Domain Id="any">'
            f"<General>{general}</General>"
            "<Discovery><MaxAutoParticipantIndex>99</MaxAutoParticipantIndex>"
            f"{discovery}</Discovery><Internal>{BUFFERS}</Internal></Domain></CycloneDDS>"
        )
        return f"{text},{more}" if more else text


def settings_from(environment: Mapping[str, str], domain: int | None = None) -> Ros2Settings:
    """Return the settings; ``domain`` (``--domain``) takes precedence over ``ROS_DOMAIN_ID``.

    Raises:
        BadSetting: a variable has a value that ROS 2 does not know.
    """
    chosen = domain
    where = f"--domain {domain}"
    if chosen is None:
        text = environment.get("ROS_DOMAIN_ID", "") or "0"
        where = f"ROS_DOMAIN_ID={text}"
        if not text.isascii() or not text.isdigit():
            raise BadSetting(f"{where}: expected a number from 0 to {MAX_DOMAIN}.")
        chosen = int(text)
    if not 0 <= chosen <= MAX_DOMAIN:
        raise BadSetting(f"{where}: expected a number from 0 to {MAX_DOMAIN}.")
    peers = environment.get("ROS_STATIC_PEERS", "").split(";")
    return Ros2Settings(
        domain=chosen,
        is_local=_is_local(environment),
        static_peers=tuple(peer.strip() for peer in peers if peer.strip()),
    )


def _is_local(environment: Mapping[str, str]) -> bool:
    only = environment.get("ROS_LOCALHOST_ONLY", "")
    if only in ("0", "1"):
        return only == "1"
    if only:
        raise BadSetting(f"ROS_LOCALHOST_ONLY={only}: expected 1 or 0.")
    found = environment.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "") or "LOCALHOST"
    if found not in RANGES:
        near = did_you_mean(found, RANGES)
        raise BadSetting(
            f"ROS_AUTOMATIC_DISCOVERY_RANGE={found}: expected {' or '.join(RANGES)}.{near}"
        )
    return found == "LOCALHOST"
