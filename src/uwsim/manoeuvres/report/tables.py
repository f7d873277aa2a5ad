"""The tables of a report: numbers as text, for the terminal and for the page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ...benchmark.metrics.manoeuvres import Criterion, TurningCircle, ZigZag
from ..tank import AXES, RELEASE_ANGLE, TankResults
from ..trials import TrialResults

MISSING_VALUE = "not reached"


@dataclass(frozen=True, kw_only=True)
class NumberTable:
    """A table of a report."""

    title: str
    """The title."""
    columns: tuple[str, ...]
    """The headings of the columns; the first column has names."""
    rows: tuple[tuple[str, ...], ...]
    """The cells of each row."""
    note: str = ""
    """A remark below the table; empty without one."""


def make_tables(
    trials: TrialResults, tank: TankResults | None, length: float
) -> tuple[NumberTable, ...]:
    """Return the tables of all manoeuvres and experiments.

    Args:
        trials: the results of the manoeuvres.
        tank: the results of the tank; None if they were not made.
        length: the length of the vehicle [m].
    """
    tables = [
        turning_table(trials.turns, length),
        zigzag_table(trials.zigzags, length),
        course_table(trials),
        stopping_table(trials, length),
        criteria_table(trials.criteria),
    ]
    if tank is not None:
        tables += [tow_table(tank), decay_table(tank)]
    return tuple(tables)


def turning_table(turns: Sequence[TurningCircle], length: float) -> NumberTable:
    """Return the table of the turning circles."""
    rows = [
        ("rudder [°]", *(f"{math.degrees(turn.rudder):.1f}" for turn in turns)),
        ("speed of the approach [m/s]", *(f"{turn.approach_speed:.3f}" for turn in turns)),
    ]
    for name, values in (
        ("advance [L]", [turn.advance for turn in turns]),
        ("transfer [L]", [turn.transfer for turn in turns]),
        ("tactical diameter [L]", [turn.tactical_diameter for turn in turns]),
        ("steady diameter [L]", [turn.steady_diameter for turn in turns]),
    ):
        rows.append((name, *(format_number(value, length, 2) for value in values)))
    rows += [
        ("time to 90° [s]", *(format_number(turn.time_90, 1.0, 2) for turn in turns)),
        ("time to 180° [s]", *(format_number(turn.time_180, 1.0, 2) for turn in turns)),
        ("loss of speed [%]", *(f"{100.0 * turn.speed_loss:.1f}" for turn in turns)),
        ("steady yaw rate [°/s]", *(f"{math.degrees(turn.yaw_rate):.2f}" for turn in turns)),
        ("drift angle [°]", *(f"{math.degrees(turn.drift_angle):.2f}" for turn in turns)),
        ("change of depth [m]", *(f"{turn.depth_change:.2f}" for turn in turns)),
    ]
    return NumberTable(
        title="Turning circle, rudder hard over",
        columns=("", "to starboard", "to port"),
        rows=tuple(rows),
    )


def zigzag_table(zigzags: Sequence[ZigZag], length: float) -> NumberTable:
    """Return the table of the zig-zags."""
    rows: list[tuple[str, ...]] = [
        ("rudder [°]", *(f"{math.degrees(zigzag.rudder):.1f}" for zigzag in zigzags)),
        (
            "initial turning time [s]",
            *(format_number(zigzag.initial_turning_time, 1.0, 2) for zigzag in zigzags),
        ),
        (
            "initial turning distance [L]",
            *(format_number(zigzag.initial_turning_distance, length, 2) for zigzag in zigzags),
        ),
    ]
    for index, name in enumerate(("first", "second", "third")):
        cells = []
        for zigzag in zigzags:
            if index < len(zigzag.overshoots):
                overshoot = zigzag.overshoots[index]
                cells.append(f"{math.degrees(overshoot.angle):.2f} ({overshoot.time_to_check:.2f})")
            else:
                cells.append(MISSING_VALUE)
        rows.append((f"{name} overshoot [°] (time to check [s])", *cells))
    rows.append(("period [s]", *(format_number(zigzag.period, 1.0, 2) for zigzag in zigzags)))
    return NumberTable(title="Zig-zag", columns=("", "10°/10°", "20°/20°"), rows=tuple(rows))


def course_table(trials: TrialResults) -> NumberTable:
    """Return the table of spiral and pull-out: whether the vehicle holds its course."""
    spiral, out = trials.spiral, trials.pull_out
    width = format_angle(spiral.loop_width)
    if spiral.loop_width is not None:
        width += f" ± {math.degrees(spiral.resolution):.2f}"
    return NumberTable(
        title="Course stability: spiral and pull-out",
        columns=("", "value"),
        rows=(
            ("width of the loop, direct spiral [°]", width),
            ("width of the loop, reverse spiral [°]", format_angle(spiral.reverse_width)),
            ("height of the loop [°/s]", format_angle(spiral.loop_height)),
            ("neutral rudder angle [°]", format_angle(spiral.neutral_angle)),
            ("residual yaw rate of the pull-out [°/s]", f"{math.degrees(out.residual_rate):.2f}"),
        ),
        note="The accuracy of the direct spiral is the step of the rudder at its ends.",
    )


def stopping_table(trials: TrialResults, length: float) -> NumberTable:
    """Return the table of the crash stop."""
    stop = trials.stop
    return NumberTable(
        title="Crash stop",
        columns=("", "value"),
        rows=(
            ("speed of the approach [m/s]", f"{stop.approach_speed:.3f}"),
            ("track reach [L]", format_number(stop.track_reach, length, 2)),
            ("head reach [L]", format_number(stop.head_reach, length, 2)),
            (
                "lateral deviation to starboard [L]",
                format_number(stop.lateral_deviation, length, 2),
            ),
            ("time [s]", format_number(stop.time, 1.0, 2)),
            ("change of heading [°]", format_angle(stop.heading_change)),
        ),
    )


def criteria_table(criteria: Sequence[Criterion]) -> NumberTable:
    """Return the table of IMO's criteria."""
    rows = []
    for criterion in criteria:
        unit = {"L": "L", "deg": "°"}[criterion.unit]
        value = MISSING_VALUE if criterion.value is None else f"{criterion.value:.2f} {unit}"
        verdict = "met" if criterion.is_met else "not met"
        rows.append((criterion.name, value, f"{criterion.limit:g} {unit}", verdict))
    return NumberTable(
        title="Criteria of IMO MSC.137(76)",
        columns=("", "value", "limit", ""),
        rows=tuple(rows),
        note="The criteria are those for ships; no underwater vehicle is obliged to meet them.",
    )


def tow_table(tank: TankResults) -> NumberTable:
    """Return the table of tows and coast-downs, beside the numbers of the hydrodynamics file."""
    rows = []
    for tow in tank.tows:
        linear, quadratic = tow.file_damping
        rows.append(
            (
                AXES[tow.axis],
                format_damping(tow.resistance.linear, tow.resistance.quadratic),
                f"{linear:.4g}",
                f"{tow.resistance.quadratic:.4g}",
                f"{quadratic:.4g}",
                f"{tow.mass:.4g}",
                f"{tow.file_mass:.4g}",
            )
        )
    return NumberTable(
        title="Tow and coast-down",
        columns=(
            "axis", "linear", "file", "quadratic", "file", "mass with added mass", "file",
        ),
        rows=tuple(rows),
        note="SI units. A tow measures hull, fins and links; the columns of the file have the "
        "bodies alone.",
    )  # fmt: skip


def decay_table(tank: TankResults) -> NumberTable:
    """Return the table of the free decays, beside the closed form."""
    rows = []
    for record in tank.decays:
        decay, expected = record.decay, record.file_period
        amplitude = 0.5 * RELEASE_ANGLE
        rows.append(
            (
                AXES[record.axis],
                "no swing" if decay is None else f"{decay.period:.3f}",
                "" if expected is None else f"{expected:.3f}",
                "" if decay is None else f"{decay.damping_ratio(amplitude):.3f}",
                "" if decay is None else format_damping(decay.linear, decay.quadratic),
                "" if decay is None else f"{decay.quadratic:.3g}",
            )
        )
    return NumberTable(
        title="Free decay",
        columns=(
            "axis", "natural period [s]", "closed form [s]", "damping ratio at 5°",
            "linear p₁ [1/s]", "quadratic p₂ [1/rad]",
        ),
        rows=tuple(rows),
    )  # fmt: skip


def format_number(value: float | None, divisor: float, digits: int) -> str:
    """Return a number with a number of decimals, or that it was not reached."""
    return MISSING_VALUE if value is None else f"{value / divisor:.{digits}f}"


def format_damping(linear: float, quadratic: float) -> str:
    """Return a linear damping as text, 0 if it is less than a thousandth of the quadratic one."""
    return "0" if linear < 1e-3 * quadratic else f"{linear:.4g}"


def format_angle(value: float | None) -> str:
    """Return an angle [rad] in degrees with two decimals, or that it was not reached."""
    return MISSING_VALUE if value is None else f"{math.degrees(value):.2f}"
