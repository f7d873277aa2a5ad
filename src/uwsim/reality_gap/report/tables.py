"""The rows of the tables of a gap, for the terminal and the page."""

from __future__ import annotations

import math

from ..attribution import Attribution, Cause
from ..errors import AxisError, Estimate, HorizonError
from ..gap import Gap
from ..sensor_residuals import SensorResidual


def format_estimate(estimate: Estimate, factor: float = 1.0) -> str:
    """Return a number with its interval: ``0.42 (0.38 to 0.47)``."""
    value = format_number(factor * estimate.value)
    if estimate.low is None or estimate.high is None:
        return value
    low, high = (format_number(factor * limit) for limit in (estimate.low, estimate.high))
    return f"{value} ({low} to {high})"


def format_number(value: float) -> str:
    """Return a number with three significant digits, and at most four decimals."""
    if abs(value) < 5e-5:
        return "0"
    digits = min(4, max(0, 2 - math.floor(math.log10(abs(value)))))
    return f"{value:.{digits}f}"


def axis_rows(gap: Gap, error: HorizonError) -> list[tuple[str, str, str, str]]:
    """Return axis and unit, RMS, bias, and displacement ratio of each degree of freedom."""
    return [
        (
            f"{axis.axis} [{'m' if axis.unit == 'm' else '°'}]",
            format_estimate(axis.rms, _factor(axis)),
            format_estimate(axis.bias, _factor(axis)),
            "–" if axis.ratio is None else f"{axis.ratio:.3f}",
        )
        for axis in (error.axes[index] for index in gap.axis_indices)
    ]


def horizon_row(error: HorizonError) -> tuple[str, str, str, str, str]:
    """Return horizon, windows, error of the position, distance travelled, and their ratio."""
    share = "–" if error.share is None else f"{100.0 * error.share:.2g} %"
    return (
        f"{error.horizon:g} s",
        f"{error.n_windows} ({error.n_blocks:.3g} independent)",
        f"{format_estimate(error.distance)} m",
        f"{format_number(error.path_length)} m",
        share,
    )


def cause_row(cause: Cause) -> tuple[str, str, str, str, str]:
    """Return coefficient, factor, share of the error, confidence, and place in the file."""
    confidence = "–" if cause.confidence is None else f"{100.0 * cause.confidence:.3g} %"
    return (
        cause.coefficient.name,
        format_factor(cause),
        format_share(cause.share),
        confidence,
        cause.coefficient.advice,
    )


def rest_row(attribution: Attribution) -> tuple[str, str, str, str, str]:
    """Return the row of the share that no coefficient explains."""
    return ("unexplained", "", format_share(attribution.unexplained_share), "", "")


def format_share(share: float) -> str:
    """Return a share in percent: ``33.8 %``."""
    return "< 0.1 %" if share < 1e-3 else f"{100.0 * share:.3g} %"


def format_factor(cause: Cause) -> str:
    """Return a factor, or the shift of the clock, with its interval: ``× 1.5 (1.4 to 1.6)``."""
    if cause.coefficient.is_clock:
        limits = (
            ""
            if cause.low is None or cause.high is None
            else f" ({cause.low - 1.0:+.3f} to {cause.high - 1.0:+.3f})"
        )
        return f"{cause.shift:+.3f} s{limits}"
    limits = "" if cause.low is None else f" ({cause.low:.4g} to {cause.high:.4g})"
    return f"× {cause.factor:.4g}{limits}"


def sensor_row(residual: SensorResidual) -> tuple[str, str, str, str, str]:
    """Return sensor, quantity, RMS, bias, and deviation of the measured readings."""
    return (
        residual.sensor,
        f"{residual.quantity} [{residual.unit}]",
        f"{residual.rms:.3g}",
        f"{residual.bias:.3g}",
        f"{residual.measured_deviation:.3g}",
    )


def input_rows(gap: Gap) -> list[tuple[str, str]]:
    """Return the names and values of the inputs."""
    log = gap.log
    twists = "none" if log.motion is None else log.motion.twist_source
    return [
        ("log", f"{log.path.rsplit('/', 1)[-1]}, {log.duration:.1f} s, {log.format}"),
        ("hash of the log", log.sha256),
        ("twists", "of the log" if twists == "log" else "estimated from the poses"),
        ("scene, vehicle", f"{gap.scene}, {gap.vehicle}"),
        ("commands", ", ".join(gap.command_kinds)),
        ("windows", f"{len(gap.windows.starts)}, every {gap.windows.spacing:.3g} s"),
        ("radius of gyration", f"{gap.radius:.3g} m"),
        ("seed", str(gap.settings.seed)),
    ]


def _factor(axis: AxisError) -> float:
    return 1.0 if axis.unit == "m" else math.degrees(1.0)
