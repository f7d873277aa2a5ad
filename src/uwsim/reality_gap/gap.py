"""The gap between a log and a simulation: what a measurement returns."""

from __future__ import annotations

from dataclasses import dataclass

from ..base.geometry import Array
from ..logs import VehicleLog
from .attribution import Attribution
from .errors import HorizonError
from .residuals import StepResiduals
from .sensor_residuals import SensorResidual
from .settings import GapSettings
from .verdict import state_verdict
from .windows import Windows


@dataclass(frozen=True, kw_only=True, eq=False)
class Gap:
    """The gap between a log and a simulation."""

    log: VehicleLog
    """The log."""
    scene: str
    """The name of the scene."""
    scene_digest: str
    """The hash of the compiled scene."""
    vehicle: str
    """The name of the vehicle."""
    settings: GapSettings
    """The settings."""
    command_kinds: tuple[str, ...]
    """The kinds of commands that were applied."""
    windows: Windows
    """The windows."""
    radius: float
    """The radius of gyration of the vehicle, which weights angles [m]."""
    horizons: tuple[HorizonError, ...]
    """The errors at the horizons."""
    curve_times: Array
    """The times of the curves, (m,) [s]."""
    curves: Array
    """The root mean square of the error over the horizon, (m, 6) [m, rad]."""
    window_errors: dict[float, Array]
    """The errors of the windows of each horizon, (n, 6) [m, rad]."""
    tracks: tuple[tuple[Array, Array], ...]
    """The measured and the simulated positions of windows that do not overlap, (m, 3) [m]."""
    residuals: StepResiduals | None
    """The one-step residuals; None: the log is too short."""
    sensors: tuple[SensorResidual, ...]
    """The residuals of sensors."""
    attribution: Attribution | None
    """The attribution to coefficients; None: not requested."""
    points_down: bool
    """True if z of the scene's frame L points down."""
    is_planar: bool
    """True if the log is planar: only surge, sway and yaw have an error."""
    remarks: tuple[str, ...]
    """The remarks about the log and the comparison."""

    @property
    def axis_indices(self) -> tuple[int, ...]:
        """The indices of the degrees of freedom that the log has."""
        return (0, 1, 5) if self.is_planar else (0, 1, 2, 3, 4, 5)

    @property
    def verdict(self) -> str:
        """The sentence that states which error dominates, and to which coefficient it points."""
        return state_verdict(self.horizons, self.radius, self.attribution)
