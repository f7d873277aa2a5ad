"""The sentence that states which error dominates, and to which coefficient it points."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .attribution import MIN_EVIDENT_SHARE, Attribution, Cause
from .errors import AXES, HorizonError, choose_main_horizon

MAX_SHARE = 0.01
"""The error of the position over the distance travelled below which the simulation follows."""
MAX_DISTANCE = 0.005
"""The error of the position below which the simulation follows [m]."""
MAX_ANGLE = math.radians(1.0)
"""The error of each angle below which the simulation follows [rad]."""
MIN_DEVIATION = 0.005
"""The least deviation of a ratio of velocities from 1 that is worth a clause."""
VERBS = {
    "surge": "moves along x",
    "sway": "moves along y",
    "heave": "moves along z",
    "roll": "rolls",
    "pitch": "pitches",
    "yaw": "yaws",
}


def state_verdict(
    horizons: Sequence[HorizonError], radius: float, attribution: Attribution | None
) -> str:
    """Return the verdict: the dominating error, and the coefficient that it points to.

    Args:
        horizons: the errors at the horizons.
        radius: the radius of gyration, by which angles count as displacements [m].
        attribution: the attribution to coefficients; None: not searched.
    """
    error = choose_main_horizon(horizons)
    if is_followed(error):
        share = "" if error.share is None else f", {100.0 * error.share:.2g} % of the distance"
        return (
            f"The simulation follows the log: {error.distance.value:.2g} m after "
            f"{error.horizon:g} s{share}."
        )
    text = describe_error(error, radius)
    if attribution is None:
        return f"{text}."
    cause = attribution.evident_cause
    if cause is not None:
        return f"{text}; {describe_cause(attribution, cause)}."
    return f"{text}; {_describe_best(attribution)}."


def _describe_best(attribution: Attribution) -> str:
    """Return the clause that no coefficient explains the error, with the best."""
    text = "no coefficient of the vehicle explains it"
    if not attribution.causes:
        return text
    cause = attribution.causes[0]
    share = f"{100.0 * cause.share:.2g} % of the error of {attribution.duration:g} s"
    return f"{text} (the best, {cause.coefficient.name}: {share}, {_state_doubt(cause)})"


def _state_doubt(cause: Cause) -> str:
    """Return the reason for which a coefficient is not evident."""
    if cause.share < MIN_EVIDENT_SHARE:
        return f"below {100.0 * MIN_EVIDENT_SHARE:g} %"
    if cause.low is None or cause.high is None:
        return "without an interval"
    if not cause.coefficient.is_clock and cause.low <= 0.0:
        return "with an interval that has impossible values"
    return "with an interval that has 1, no change"


def is_followed(error: HorizonError) -> bool:
    """Return whether the errors are so small that the simulation follows the log."""
    is_near = error.distance.value < MAX_DISTANCE or (error.share or 1.0) < MAX_SHARE
    return is_near and all(axis.rms.value < MAX_ANGLE for axis in error.axes[3:])


def find_dominating_axis(error: HorizonError, radius: float) -> int:
    """Return the index of the axis with the largest error; angles count times the radius [m]."""
    weights = [axis.rms.value * (1.0 if axis.unit == "m" else radius) for axis in error.axes]
    return max(range(len(weights)), key=weights.__getitem__)


def describe_error(error: HorizonError, radius: float) -> str:
    """Return the clause about the dominating error."""
    index = find_dominating_axis(error, radius)
    axis = error.axes[index]
    name = axis.axis.capitalize()
    if axis.unit == "m":
        return (
            f"{name} dominates: {axis.rms.value:.2g} m of {error.distance.value:.2g} m after "
            f"{error.horizon:g} s"
        )
    return f"{name} dominates: {math.degrees(axis.rms.value):.2g}° after {error.horizon:g} s"


def describe_cause(attribution: Attribution, cause: Cause) -> str:
    """Return the clause about the coefficient that explains the most."""
    motion = _describe_motion(attribution, cause)
    if cause.coefficient.is_clock:
        return _describe_shift(attribution, cause)
    limits = "" if cause.low is None else f" ({cause.low:.3g} to {cause.high:.3g})"
    text = (
        f"{motion}{cause.coefficient.name}: {cause.factor:.3g} times its value{limits} explains "
        f"{100.0 * cause.share:.3g} % of the error of {attribution.duration:g} s"
    )
    if cause.equivalents:
        text += f"; the log cannot tell it from {' or '.join(cause.equivalents)}"
    return text


def _describe_shift(attribution: Attribution, cause: Cause) -> str:
    """Return the clause about the clock of the commands: late if they must begin earlier."""
    direction = "late" if cause.shift < 0.0 else "early"
    limits = ""
    if cause.low is not None and cause.high is not None:
        low, high = sorted((abs(cause.low - 1.0), abs(cause.high - 1.0)))
        limits = f" ({low:.3f} to {high:.3f})"
    text = (
        f"the clock of the commands is {abs(cause.shift):.3f} s{limits} {direction}, which "
        f"explains {100.0 * cause.share:.3g} % of the error of {attribution.duration:g} s"
    )
    if cause.equivalents:
        text += f"; the log cannot tell it from the {' or the '.join(cause.equivalents)}"
    return text


def _describe_motion(attribution: Attribution, cause: Cause) -> str:
    axis = cause.coefficient.key.split("_")[0]
    if axis not in AXES:
        return "this points to the "
    ratio = attribution.speed_ratios[AXES.index(axis)]
    if ratio is None or abs(ratio - 1.0) < MIN_DEVIATION:
        return "this points to the "
    direction = "fast" if ratio > 1.0 else "slowly"
    return (
        f"the simulated vehicle {VERBS[axis]} {100.0 * abs(ratio - 1.0):.2g} % too {direction}, "
        "which points to its "
    )
