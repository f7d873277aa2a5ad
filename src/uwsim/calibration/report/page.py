"""The HTML page of a calibration: one file without scripts, which loads no other file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ...analysis.templates import data_url, template
from ...version import __version__
from ..calibrate import Calibration
from ..estimate import Estimate
from .numbers import format_value
from .tables import GATE_WORDS, make_rows

CAPTIONS = {
    "fit": "Loss of each reading, with its standard deviation: against the reference water, or, "
    "without one, against the geometry alone. Lines: the fit. Right: the residuals.",
    "contrast": "Contrast of a detail that is left over the range, for the fitted water.",
}


def render(calibration: Calibration, plots: Sequence[Sequence[Path]], source: str) -> str:
    """Return the HTML of the page.

    Args:
        calibration: the result.
        plots: the plots of each water.
        source: the name of the set-up.
    """
    gates = [
        {
            "name": gate.name,
            "subject": gate.subject,
            "word": GATE_WORDS[gate.is_passed],
            "text": gate.text,
        }
        for gate in calibration.gates
    ]
    return template("calibration.html.j2").render(
        title=source,
        waters=[
            {
                "name": water.name,
                "dose": None if water.dose is None else f"{water.dose:g}",
                "channels": [result.estimate.channel for result in water.channels],
                "rows": make_rows(water),
                "remarks": water.remarks,
                "plots": [
                    (CAPTIONS[path.stem.rsplit("-", 1)[1]], data_url(path.read_bytes(), "png"))
                    for path in paths
                ],
                "cards": [
                    {
                        "label": f"{result.estimate.channel}: c",
                        "value": _describe_attenuation(result.estimate),
                        "note": _describe_length(result.estimate),
                    }
                    for result in water.channels
                ],
            }
            for water, paths in zip(calibration.waters, plots, strict=True)
        ],
        references=[
            (name, f"{water.absorption:.4g}", f"{water.scattering:.4g}")
            for name, water in calibration.measurements.references.items()
        ],
        accuracy=calibration.measurements.accuracy,
        gates=gates,
        version=__version__,
    )


def _describe_attenuation(estimate: Estimate) -> str:
    error = estimate.standard_deviations["beam_attenuation"]
    value = format_value(estimate.water.beam_attenuation, error)
    return f"{value} ± {format_value(error, error)} m⁻¹"


def _describe_length(estimate: Estimate) -> str:
    return f"attenuation length {1.0 / max(estimate.water.beam_attenuation, 1e-6):.2f} m"
