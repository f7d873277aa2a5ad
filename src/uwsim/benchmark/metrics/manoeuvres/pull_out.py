r"""The pull-out: the yaw rate that remains when the rudder is put amidships in a turn.

A vehicle turns steadily; then the rudder is put to its neutral angle. Pull-outs from turns to both
sides of a vehicle that is stable on its course end at the same yaw rate. An unstable vehicle keeps
on turning to the side of its turn: half the difference is its *residual yaw rate* (ITTC
7.5-04-02-01; Burcher 1971).
"""

from __future__ import annotations

from dataclasses import dataclass

from .track import ManoeuvreTrack


@dataclass(frozen=True, kw_only=True)
class PullOut:
    """The numbers of pull-outs from turns to both sides."""

    starboard_rate: float
    """The yaw rate that remains after a turn to starboard [rad/s]."""
    port_rate: float
    """The yaw rate that remains after a turn to port, negative to port [rad/s]."""

    @property
    def residual_rate(self) -> float:
        """The residual yaw rate, half the difference [rad/s]."""
        return 0.5 * abs(self.starboard_rate - self.port_rate)


def measure_pull_out(starboard: ManoeuvreTrack, port: ManoeuvreTrack) -> PullOut:
    """Compute the numbers of pull-outs; the manoeuvres begin with the rudder amidships.

    Args:
        starboard: the track of a pull-out from a turn to starboard.
        port: the track of a pull-out from a turn to port.
    """
    return PullOut(
        starboard_rate=starboard.compute_steady_mean(starboard.yaw_rates),
        port_rate=port.compute_steady_mean(port.yaw_rates),
    )
