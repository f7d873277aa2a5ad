"""The options of a vehicle that follows a real one while the scene runs."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Literal, cast

from ...errors import BadSetting, ErrorCollector, UnknownName, did_you_mean
from .completion import complete_names
from .help_texts import FOLLOW, option

if TYPE_CHECKING:
    from ...devices.motion.follow_pose import Axes, FollowPoseSpec
    from ...scene.spec import SceneSpec
    from ...simulation import Simulation
    from .connections import ConnectionOptions

SOURCES = ("ros1", "ros2", "web", "mavlink")
"""The kinds of sources of poses."""
AXES = ("localized", "enu", "ned")
"""The axes of poses."""
MESSAGE_TYPES = ("odometry", "pose")
"""The types of messages with poses."""
EXPECTED = "expected ros1:/TOPIC, ros2:/TOPIC, web:/TOPIC or mavlink:PORT"
LOCAL_ADDRESS = "127.0.0.1"


@dataclass(frozen=True, kw_only=True)
class FollowOptions:
    """The options of a vehicle that follows a real one."""

    follow: Annotated[
        str | None,
        option(
            FOLLOW,
            "--follow",
            metavar="[VEHICLE=]SOURCE",
            help="A vehicle, the first without a name, follows poses: ros1:/odom, ros2:/odom or "
            "web:/odom (Odometry; /TOPIC:pose for PoseStamped), or mavlink:PORT of UDP.",
        ),
    ] = None
    axes: Annotated[
        str | None,
        option(
            FOLLOW,
            "--follow-axes",
            metavar="localized|enu|ned",
            help="Axes of the poses: of the scene file, of REP 103, or north, east, down "
            "[localized; MAVLink ned].",
            autocompletion=complete_names(AXES),
        ),
    ] = None
    delay: Annotated[
        float,
        option(
            FOLLOW,
            "--follow-delay",
            metavar="SECONDS",
            help="Time from the measurement of a pose to its arrival, over which it is predicted.",
            min=0.0,
            max=10.0,
        ),
    ] = 0.0
    timeout: Annotated[
        float,
        option(
            FOLLOW,
            "--follow-timeout",
            metavar="SECONDS",
            help="Time without a pose after which the last one is stale.",
            min=0.001,
            max=1e6,
        ),
    ] = 0.5
    stop_when_stale: Annotated[
        bool,
        option(
            FOLLOW,
            "--stop-when-stale",
            help="Sensors publish nothing while poses are stale [they observe from the last pose].",
        ),
    ] = False

    def check(self, connections: ConnectionOptions, errors: ErrorCollector) -> None:
        """Collect the errors of the options."""
        if self.follow is None:
            with errors.collect():
                if self.axes is not None or self.delay > 0.0 or self.stop_when_stale:
                    raise BadSetting(
                        "--follow-axes, --follow-delay and --stop-when-stale need --follow."
                    )
            return
        with errors.collect():
            source, name, message_type = self._parse()
            if source != "mavlink" and source not in connections.transports:
                raise BadSetting(f"--follow {self.follow}: needs --{source}.")
            if source == "mavlink" and not (name.isdigit() and 0 < int(name) < 65536):
                raise BadSetting(f"--follow {self.follow}: {name!r} is no port; {EXPECTED}.")
            if message_type not in MESSAGE_TYPES:
                near = did_you_mean(message_type, MESSAGE_TYPES)
                raise BadSetting(
                    f"--follow {self.follow}: {message_type!r} is no type of poses; expected "
                    f"{' or '.join(MESSAGE_TYPES)}.{near}"
                )
        with errors.collect():
            if self.axes is not None and self.axes not in AXES:
                raise BadSetting(f"--follow-axes {self.axes}: expected one of {', '.join(AXES)}.")

    def _parse(self) -> tuple[str, str, str]:
        """Return the kind of the source, its topic or port, and the type of its messages."""
        assert self.follow is not None
        address = self.follow.rpartition("=")[2]
        source, colon, name = address.partition(":")
        if source not in SOURCES or not colon or not name:
            raise BadSetting(f"--follow {self.follow}: {EXPECTED}.{did_you_mean(source, SOURCES)}")
        topic, _, message_type = name.partition(":")
        return source, topic, message_type or "odometry"

    def find_vehicle(self, scene: SceneSpec) -> str:
        """Return the vehicle that follows, or would follow: the first; empty without any.

        Raises:
            UnknownName: the scene has no vehicle of the requested name.
            BadSetting: a vehicle is to follow, but the scene has none.
        """
        names = [vehicle.name for vehicle in scene.vehicles]
        requested_name = (self.follow or "").rpartition("=")[0]
        if not names:
            if self.follow is None:
                return ""
            raise BadSetting("--follow: the scene has no vehicle.")
        if requested_name and requested_name not in names:
            raise UnknownName("vehicle", requested_name, names)
        return requested_name or names[0]

    def change_scene(self, scene: SceneSpec) -> SceneSpec:
        """Return the scene whose vehicle follows; the same without ``--follow``."""
        from ...virtual_sensors import replace_motion

        if self.follow is None:
            return scene
        return replace_motion(scene, self.find_vehicle(scene), self._make_spec())

    def _make_spec(self) -> FollowPoseSpec:
        from ...devices.motion.follow_pose import FollowPoseSpec

        source, name, message_type = self._parse()
        policy: Literal["hold", "stop"] = "stop" if self.stop_when_stale else "hold"
        if source == "mavlink":
            return FollowPoseSpec(
                mavlink_port=int(name), delay=self.delay, timeout=self.timeout, on_timeout=policy
            )
        return FollowPoseSpec(
            topic=name,
            type=cast("Literal['odometry', 'pose']", message_type),
            axes=cast("Axes", self.axes or "localized"),
            delay=self.delay,
            timeout=self.timeout,
            on_timeout=policy,
        )

    def choose_pace(self, connections: ConnectionOptions) -> ConnectionOptions:
        """Return the connections with the pace of real time, if MAVLink messages are followed."""
        if connections.speed is not None or not self._is_mavlink:
            return connections
        return replace(connections, speed=1.0)

    @property
    def _is_mavlink(self) -> bool:
        return self.follow is not None and self._parse()[0] == "mavlink"

    def find_address(self, udp_address: str | None) -> str | None:
        """Return the address at which datagrams are received: of ``--udp-address``, or local."""
        return udp_address or (LOCAL_ADDRESS if self._is_mavlink else None)

    @contextmanager
    def open_report(self, simulation: Simulation, *, as_json: bool) -> Iterator[None]:
        """Print the counts and the delays of the poses that arrived, at the end of the block."""
        try:
            yield
        finally:
            self._print_report(simulation, as_json=as_json)

    def _print_report(self, simulation: Simulation, *, as_json: bool) -> None:
        from ...devices.motion.follow_pose import PoseFollower

        for device in simulation.world.devices:
            if isinstance(device, PoseFollower):
                for line in device.report:
                    print(line, file=sys.stderr if as_json else sys.stdout)
