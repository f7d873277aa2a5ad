r"""A vehicle whose motion is given: by a table of poses, such as the trajectory of a real mission.

.. code-block:: xml

    <vehicle> ...
      <u:scriptedMotion> <u:file>trajectory.csv</u:file> </u:scriptedMotion>
    </vehicle>

.. code-block:: text

    time [s],x [m],y [m],z [m],qw,qx,qy,qz
    0.00,2.01,0.15,2.51,1,0,0,0
    0.02,2.02,0.15,2.51,0.9999,0,0,0.0141

Poses are in L, the frame of the scene file. At each step the vehicle is at the pose of the step's
time, interpolated between the lines (`uwsim.devices.motion.pose_track`). Velocities for sensors
follow from the motion; neither forces nor commands move the vehicle. Not modelled: thrusters,
loads and the vehicle's battery, which are those of a vehicle that is held.
"""

from __future__ import annotations

import csv
import io
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...base.files.input_files import read_bytes
from ...base.geometry import Array, Pose
from ...base.record import Record
from ...errors import AssetError, BadSetting
from ...schema import element
from ...world import DeviceWorld
from ..device import Device, DeviceSpec, DeviceVehicle
from .pose_track import GapPolicy, PoseTrack
from .prescribed_vehicle import PrescribedVehicle, move_vehicle

COLUMNS = ("time", "x", "y", "z", "qw", "qx", "qy", "qz")
"""The columns of a table of poses, in their order."""
TITLES = "time [s],x [m],y [m],z [m],qw,qx,qy,qz"
"""The first line of a table of poses."""
MAX_BYTES = 256 * 2**20
"""The greatest size of a table [bytes]."""
MAX_POSES = 2_000_000
"""The greatest number of poses."""


@dataclass(frozen=True, kw_only=True)
class ScriptedMotionSpec(DeviceSpec):
    """A ``<u:scriptedMotion>``: the vehicle follows a table of poses."""

    file: str = element(namespaced=True)
    """The CSV file with the columns time [s], x, y, z [m] in L, and qw, qx, qy, qz."""
    start: float = element(namespaced=True, default=0.0, minimum=-1e9, maximum=1e9)
    """The time in the table at the start of the simulation [s]."""
    max_gap: float = element(namespaced=True, default=1.0, exclusive_minimum=0.0)
    """The longest time between two poses that is no gap [s]."""
    gaps: GapPolicy = element(namespaced=True, default="hold")
    """The treatment of gaps: ``hold`` the last pose, ``interpolate``, or ``refuse`` the table."""

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> ScriptedMotion:
        """Create the motion; `ScriptedMotion.follow` sets its poses."""
        assert isinstance(vehicle, PrescribedVehicle)
        return ScriptedMotion(self, vehicle, world.world_from_localized)

    def read(self, path: Path) -> PoseTrack:
        """Read the table; raise AssetError if it is invalid."""
        times, positions, quaternions = read_poses(path, name=self.file)
        try:
            return PoseTrack(times, positions, quaternions, max_gap=self.max_gap, gaps=self.gaps)
        except BadSetting as error:
            raise AssetError(f"{self.file}: {error}", name=self.file) from None


@dataclass(slots=True)
class ScriptedMotionState(Record):
    """The state of a scripted motion."""

    has_begun: bool = False
    """True if the vehicle has been placed at the first pose."""


class ScriptedMotion(Device):
    """The motion of a vehicle along poses.

    Args:
        spec: the spec.
        vehicle: the vehicle.
        world_from_localized: the pose of L in W.
    """

    def __init__(
        self, spec: ScriptedMotionSpec, vehicle: PrescribedVehicle, world_from_localized: Pose
    ) -> None:
        self.spec = spec
        """The spec."""
        self.vehicle = vehicle
        """The vehicle that moves."""
        self._world_from_localized = world_from_localized
        self._track: PoseTrack | None = None
        self.state: ScriptedMotionState = ScriptedMotionState()

    def follow(self, track: PoseTrack) -> None:
        """Set the poses, in L; the vehicle is placed at the pose of the present time next."""
        self._track = track

    def animate(self, time: float) -> None:
        """Place the vehicle at the pose of a time [s]."""
        if self._track is None:
            return
        pose = self._track.pose(time + self.spec.start)
        move_vehicle(
            self.vehicle, self._world_from_localized @ pose, is_start=not self.state.has_begun
        )
        self.state.has_begun = True


def read_poses(path: Path, *, name: str) -> tuple[Array, Array, Array]:
    """Read a table of poses: times (n,) [s], positions (n, 3) [m], quaternions wxyz (n, 4).

    Raises:
        AssetError: the table lacks a column, has another number of cells, or is too long.
    """
    text = read_bytes(path, name=name, at_most=MAX_BYTES).decode("utf-8-sig", errors="replace")
    lines = csv.reader(io.StringIO(text))
    header = [title.partition("[")[0].strip() for title in next(lines, [])]
    if tuple(header) != COLUMNS:
        raise AssetError(
            f"{name}:1: has the columns {', '.join(header)[:80]}; expected {', '.join(COLUMNS)}.",
            name=name,
        )
    rows: list[list[float]] = []
    for number, line in enumerate(lines, start=2):
        if not line:
            continue
        if len(rows) >= MAX_POSES:
            raise AssetError(f"{name}: has more than {MAX_POSES} poses.", name=name)
        if len(line) != len(COLUMNS):
            raise AssetError(
                f"{name}:{number}: has {len(line)} cells; expected {len(COLUMNS)}.", name=name
            )
        try:
            rows.append([float(cell) if cell.strip() else math.nan for cell in line])
        except ValueError:
            raise AssetError(f"{name}:{number}: has a cell that is no number.", name=name) from None
    numbers = np.array(rows, dtype=np.float64).reshape(-1, len(COLUMNS))
    return numbers[:, 0], numbers[:, 1:4], numbers[:, 4:8]


def write_poses(times: Array, positions: Array, quaternions: Array) -> str:
    """Return the text of a table of poses; `read_poses` returns the same numbers."""
    rows = np.column_stack([times, positions, quaternions]).tolist()
    lines = (",".join("" if math.isnan(x) else repr(x) for x in row) for row in rows)
    return "\n".join([TITLES, *lines]) + "\n"
