"""The HTML page of a gap: one file without scripts, which loads no other file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ...analysis.templates import data_url, template
from ...version import __version__
from ..attribution import Attribution
from ..errors import choose_main_horizon
from ..gap import Gap
from .tables import (
    axis_rows,
    cause_row,
    format_factor,
    format_number,
    horizon_row,
    input_rows,
    rest_row,
    sensor_row,
)

CAPTIONS = {
    "horizon": "Root mean square of the error over the time after the beginning of a window. "
    "Marks: the horizons, with 95 % intervals; hollow: too few independent windows for one.",
    "tracks": "Track of the log, and the simulation from states of the log (dots). "
    "Left: from above. Right: over time.",
    "coefficients": "Share of the error that each coefficient removes in turn, with its factor and "
    "95 % interval, as in the table. Orange: named by the verdict. Grey: unexplained.",
    "spectrum": "Spectral density of the residual acceleration of one step, along the log.",
}


def render(gap: Gap, plots: Mapping[str, Path]) -> str:
    """Return the HTML of the page."""
    error = choose_main_horizon(gap.horizons)
    attribution = gap.attribution
    cards = [
        {
            "label": f"position after {item.horizon:g} s",
            "value": f"{format_number(item.distance.value)} m",
            "note": ""
            if item.share is None
            else f"{100.0 * item.share:.2g} % of {format_number(item.path_length)} m travelled",
        }
        for item in gap.horizons
    ]
    cause = None if attribution is None else attribution.evident_cause
    if cause is not None:
        cards.append(
            {
                "label": cause.coefficient.name,
                "value": format_factor(cause).split(" (")[0],
                "note": f"explains {100.0 * cause.share:.3g} % of the error",
            }
        )
    return template("gap.html.j2").render(
        title=gap.log.path.rsplit("/", 1)[-1],
        scene=gap.scene,
        vehicle=gap.vehicle,
        verdict=gap.verdict,
        cards=cards,
        horizons=[horizon_row(item) for item in gap.horizons],
        tables=[(f"{item.horizon:g} s", axis_rows(gap, item)) for item in gap.horizons],
        main_horizon=f"{error.horizon:g} s",
        causes=_cause_rows(attribution),
        attribution=attribution,
        residual="" if attribution is None else format_number(attribution.residual),
        remainder="" if attribution is None else format_number(attribution.remainder),
        sensors=[sensor_row(residual) for residual in gap.sensors],
        plots=[
            (CAPTIONS[name], data_url(path.read_bytes(), "png")) for name, path in plots.items()
        ],
        inputs=input_rows(gap),
        remarks=gap.remarks,
        version=__version__,
    )


def _cause_rows(attribution: Attribution | None) -> list[tuple[str, ...]]:
    """Return the rows of the causes and of the rest; none without a cause."""
    if attribution is None or not attribution.causes:
        return []
    return [*map(cause_row, attribution.causes), rest_row(attribution)]
