"""The column names of a measure's log, with units."""

from __future__ import annotations

from ...benchmark.measures import Measure


def log_columns(measure: Measure) -> tuple[str, ...]:
    """Return the columns of a measure's log with their units: ``total [px]``.

    A detail has its own unit. A signal whose statistics are details, and ``value`` and ``total``,
    have the unit of the measure. A name that already contains a unit, or whose unit is unknown or
    1, is unchanged.
    """
    signals = {detail.partition(".")[0] for detail in measure.details} | {"value", "total"}

    def add_unit(name: str) -> str:
        unit = measure.detail_units.get(name, measure.unit if name in signals else "1")
        is_bare = name.endswith("]") or name == "n" or unit == "1"
        return name if is_bare else f"{name} [{unit}]"

    return tuple(add_unit(name) for name in measure.log_header)
