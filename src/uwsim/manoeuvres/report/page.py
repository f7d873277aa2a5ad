"""The HTML page of manoeuvres: one file without scripts, which loads no other file."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from ...analysis.templates import data_url, template
from ...version import __version__
from ..experiment import Experiment
from ..trials import TrialResults
from .tables import MISSING_VALUE, NumberTable, format_angle, format_number

CAPTIONS = {
    "turning-circle": "Tracks of the turning circles from above, in lengths of the vehicle. "
    "Outlines: the hull.",
    "zigzag": "Heading and rudder in the zig-zags. Dashed: the change of heading at which the "
    "rudder is reversed. Numbers: overshoots.",
    "spiral": "Steady yaw rate over the rudder angle. A vehicle that is stable on its course has a "
    "single curve; a loop is its width of indifference.",
    "stop": "Crash stop and pull-outs. A yaw rate that remains after a pull-out is that of an "
    "unstable vehicle.",
    "tow": "Tows along a rail: force over steady speed, with the fit.",
    "tank": "Bollard pull of all thrusters ahead, and free decays after release at 10°.",
}


def render(
    experiment: Experiment,
    trials: TrialResults,
    tables: Sequence[NumberTable],
    plots: Sequence[Path],
    source: str,
) -> str:
    """Return the HTML of the page.

    Args:
        experiment: the vehicle.
        trials: the results of the manoeuvres.
        tables: the tables.
        plots: the paths of the plots, with the names of `CAPTIONS`.
        source: the name of the scene.
    """
    limit = float(experiment.parameters["limit"])
    return template("manoeuvres.html.j2").render(
        title=experiment.vehicle,
        source=source,
        length=f"{experiment.length:.4g}",
        has_rudder=experiment.is_steered_by_fins,
        limit=f"{limit:.1f}",
        moment=f"{float(experiment.parameters['yaw_moment']) * math.radians(limit):.3g}",
        ahead=f"{float(experiment.parameters['ahead']):.3g}",
        cards=make_cards(trials, experiment.length),
        tables=tables,
        plots=[(CAPTIONS[path.stem], data_url(path.read_bytes(), "png")) for path in plots],
        version=__version__,
    )


def make_cards(trials: TrialResults, length: float) -> list[dict[str, str]]:
    """Return the cards at the top of the page: label, value and note of each."""
    overshoots = trials.zigzags[0].overshoots
    first_overshoot = overshoots[0].angle if overshoots else None
    resolution = math.degrees(trials.spiral.resolution)
    n_met = sum(criterion.is_met for criterion in trials.criteria)
    rows = (
        (
            "tactical diameter",
            add_unit(format_number(trials.turns[0].tactical_diameter, length, 2), " L"),
            "to starboard, rudder hard over",
        ),
        ("first overshoot 10/10", add_unit(format_angle(first_overshoot), "°"), "of a zig-zag"),
        (
            "loop of the spiral",
            add_unit(format_angle(trials.spiral.loop_width), "°"),
            f"± {resolution:.2f}°; 0: stable on its course",
        ),
        (
            "track reach",
            add_unit(format_number(trials.stop.track_reach, length, 2), " L"),
            "crash stop",
        ),
        ("criteria of ships", f"{n_met} of {len(trials.criteria)} met", "IMO MSC.137(76)"),
    )
    return [{"label": label, "value": value, "note": note} for label, value, note in rows]


def add_unit(text: str, unit: str) -> str:
    """Return a number with its unit; a value that was not reached has none."""
    return text if text == MISSING_VALUE else text + unit
