"""Column names of a measure's log, with units."""

from __future__ import annotations

from ...benchmark.measures import Measure


def log_columns(measure: Measure) -> tuple[str, ...]:
    """Return the columns of a measure's log with their units: ``total [px]``.

    That of a detail is the detail's; what has statistics among the details, and what is called
    ``value`` or ``total``, is in the measure's own. A column that says its unit itself, or that
    nothing is known about, stays as it is.
    """
    signals = {detail.partition(".")[0] for detail in measure.details} | {"value", "total"}

    def labelled(name: str) -> str:
        unit = measure.detail_units.get(name, measure.unit if name in signals else "1")
        is_bare = name.endswith("]") or name == "n" or unit == "1"
        return name if is_bare else f"{name} [{unit}]"

    return tuple(labelled(name) for name in measure.log_header)
