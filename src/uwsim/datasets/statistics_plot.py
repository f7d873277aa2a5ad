"""The histograms of a data set: classes, box sizes, visibility, distance, and water."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..analysis.plots.save import save_plot
from ..analysis.plots.style import PALETTE, styled_figure
from .sensor_record import sensor_of

N_BINS = 24
"""The number of bins of a histogram."""
MAX_CLASSES = 12
"""The greatest number of classes in the plot."""
MAX_NAME = 18
"""The greatest number of letters of a class in the plot."""


def write_statistics(directory: Path, records: Sequence[dict[str, Any]]) -> None:
    """Write ``statistics.png``."""
    instances = [i for record in records for i in record["instances"] if i["visible_pixels"]]
    sizes = [((i["box"][2] - i["box"][0]) * (i["box"][3] - i["box"][1])) ** 0.5 for i in instances]
    water = [record["water"] for record in records if "water" in record]
    is_foggy = len({w.get("fog") for w in water}) > 1
    last_values, last_label = (
        ([w["fog"] for w in water], "fog density [1/m]")
        if is_foggy
        else ([w["light_rate"] for w in water], "light rate")
    )
    if len(set(last_values)) <= 1:
        last_values = [-sensor_of(record)["position"][2] for record in records]
        last_label = "sensor below z = 0 [m]"
    with styled_figure((7.2, 3.6)) as figure:
        axes = figure.subplots(2, 3).flatten()
        counts = Counter(i["class"] for i in instances).most_common(MAX_CLASSES)
        names = [name[:MAX_NAME] for name, _ in reversed(counts)]
        axes[0].barh(names, [count for _, count in reversed(counts)], color=PALETTE[0], height=0.6)
        axes[0].set_xlabel("labelled instances")
        axes[0].grid(visible=False, axis="y")
        for axis, values, label, colour in (
            (axes[1], sizes, "size of the box, sqrt(w h) [px]", PALETTE[1]),
            (axes[2], [i["visibility"] for i in instances], "visible share", PALETTE[2]),
            (axes[3], [i["distance"] for i in instances], "distance [m]", PALETTE[3]),
            (axes[4], [i["truncation"] or 0.0 for i in instances], "truncation", PALETTE[4]),
            (axes[5], last_values, last_label, PALETTE[5]),
        ):
            axis.hist(values or [0.0], bins=N_BINS, color=colour)
            axis.set_xlabel(label)
        for axis in (axes[1], axes[3], axes[4]):
            axis.set_ylabel("instances")
        save_plot(figure, directory / "statistics.png")
