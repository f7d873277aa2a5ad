"""The HTML page of an identification: one file without scripts, which loads no other file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ...analysis.templates import data_url, template
from ...version import __version__
from ..hydrodynamics_file import describe_log
from ..identify import Identification
from ..residuals import CHANNELS
from .tables import (
    COEFFICIENT_HEADER,
    HORIZON_HEADER,
    list_warnings,
    make_coefficient_rows,
    make_horizon_rows,
)

CAPTIONS = {
    "coefficients": "Each coefficient relative to its first guess, with its 95 % interval. A "
    "coefficient whose first guess is 0 is shown in plausible errors. Grey: not determined.",
    "horizon": "Root mean square difference of measured and simulated motion over the time since "
    "the start of a window, from the measured state. Coefficients were fitted without the window.",
    "window": "Velocities over ground of the window with the greatest improvement.",
    "correlations": "Correlations of the coefficients. White dots: above 0.9.",
}
CHANNEL_UNITS = ("m", "rad", "m/s", "rad/s")
"""The units of groups of three channels."""


def render(result: Identification, plots: Sequence[Path], file: str) -> str:
    """Return the HTML of the page.

    Args:
        result: the identification.
        plots: the plots.
        file: the name of the hydrodynamics file.
    """
    settings = result.settings
    return template("identification.html.j2").render(
        title=result.model.name,
        logs=[describe_log(log.path, log.sha256, log.start) for log in result.logs],
        check=result.check.warnings,
        warnings=list_warnings(result),
        advice=result.advice,
        remarks=result.windows.remarks,
        cards=_make_cards(result),
        coefficient_header=COEFFICIENT_HEADER,
        coefficient_rows=make_coefficient_rows(result.uncertainty.estimates),
        horizon_header=HORIZON_HEADER,
        horizon_rows=make_horizon_rows(result.horizons),
        excitation=[
            (
                row.axis,
                f"{row.speed:.3g}",
                f"{row.max_speed:.3g}",
                "m/s" if i < 3 else "rad/s",
                "excited" if row.is_excited else "not excited",
            )
            for i, row in enumerate(result.excitation)
        ],
        noise=[
            (
                channel,
                f"{noise:.3g} {CHANNEL_UNITS[i // 3]}, {ratio:.2g} times that of the measurements",
            )
            for i, (channel, noise, ratio) in enumerate(
                zip(
                    CHANNELS, result.noise.tolist(), result.check.noise_ratios.tolist(), strict=True
                )
            )
            if ratio == ratio  # measured
        ],
        plots=[(CAPTIONS[path.stem], data_url(path.read_bytes(), "png")) for path in plots],
        settings=[
            ("free", ", ".join(settings.free_names)),
            ("windows", f"{len(result.windows)} of {settings.windows.length:g} s"),
            ("step, samples", f"{settings.windows.step:g} s, at most {settings.windows.rate:g} Hz"),
            ("starts, folds", f"{settings.n_starts}, {settings.n_folds}"),
            ("loss, seed", f"{settings.loss}, {settings.seed}"),
            ("first guess", result.model.hydrodynamics.name),
            (
                "standard errors by windows / for white noise",
                f"{result.uncertainty.correction:.2f}",
            ),
        ],
        file=file,
        version=__version__,
    )


def _make_cards(result: Identification) -> list[dict[str, str]]:
    n_determined = sum(estimate.is_determined for estimate in result.uncertainty.estimates)
    cards = [
        {
            "label": "determined",
            "value": f"{n_determined} of {len(result.parameters)}",
            "note": "coefficients",
        },
        {
            "label": "starts",
            "value": f"{result.n_same_minimum} of {result.settings.n_starts}",
            "note": (
                f"reach this minimum; {result.n_unfinished} were above it when they were stopped"
                if result.n_unfinished
                else "reach this minimum"
            ),
        },
    ]
    last_horizon = max((error.horizon for error in result.horizons), default=0.0)
    for error in result.horizons:
        if error.horizon == last_horizon and error.quantity in ("position", "velocity"):
            cards.append(
                {
                    "label": f"{error.quantity} error, {last_horizon:g} s",
                    "value": f"{error.first_error:.2g} → {error.fitted_error:.2g} {error.unit}",
                    "note": "on held-out windows",
                }
            )
    return cards
