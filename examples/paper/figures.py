"""Figures: camera images and the law of visibility, laid out as in a paper."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

from uwsim.analysis.plots import FAINT, MARKERS, PALETTE, styled_figure

Pixels = npt.NDArray[np.uint8]
Points = tuple[Sequence[float], Sequence[float]]


def visibility(fog: float, distance: float) -> float:
    """What the fog takes away of a contrast, ``1 - exp(-(fog * distance)^2)``: 0 clear, 1 gone."""
    return 1.0 - math.exp(-((fog * distance) ** 2))


def image_grid(
    images: Sequence[Pixels], captions: Sequence[str], *, columns: int, width: float = 6.6
) -> Figure:
    """Lay images of one size out in rows, with captions (a), (b), ... below.

    Args:
        images: (h, w, 3) each.
        captions: One an image.
        columns: Images a row.
        width: Of the figure [inch].
    """
    rows = math.ceil(len(images) / columns)
    height, across = images[0].shape[:2]
    each = width / columns
    with styled_figure((width, rows * (each * height / across + 0.28))) as figure:
        grid = figure.subplots(rows, columns, squeeze=False).ravel()
        for i, axes in enumerate(grid):
            axes.axis("off")
            if i < len(images):
                axes.imshow(images[i], interpolation="nearest")
                letter = f"({chr(ord('a') + i)}) " if len(images) > 1 else ""
                axes.text(
                    0.5, -0.03, letter + captions[i], ha="center", va="top",
                    transform=axes.transAxes,
                )  # fmt: skip
    return figure


def image_with_inset(
    scene: Pixels, inset: Pixels, *, share: float = 0.36, width: float = 6.6
) -> Figure:
    """Show a scene with a camera's image in its lower right corner, framed in white.

    Args:
        scene: (h, w, 3).
        inset: (h, w, 3), any size.
        share: Width of the inset as a share of the scene's.
        width: Of the figure [inch].
    """
    height, across = scene.shape[:2]
    high = share * across * inset.shape[0] / inset.shape[1] / height
    with styled_figure((width, width * height / across)) as figure:
        figure.set_layout_engine("none")
        axes = figure.add_axes((0, 0, 1, 1))
        axes.imshow(scene, interpolation="nearest", aspect="auto")
        axes.axis("off")
        margin = 0.02
        small = figure.add_axes((1 - share - margin, margin * across / height, share, high))
        small.imshow(inset, interpolation="nearest", aspect="auto")
        small.set_xticks([])
        small.set_yticks([])
        small.grid(False)
        for spine in small.spines.values():
            spine.set(visible=True, color="white", linewidth=2.0)
    return figure


def visibility_over_distance(measured: Mapping[float, Points]) -> Figure:
    """Draw measured visibility over distance for several fogs, on the law.

    Args:
        measured: Fog density [1/m] -> (distances [m], visibilities 0..1).
    """
    with styled_figure() as figure:
        axes = figure.subplots()
        longest = max(max(distances) for distances, _ in measured.values())
        for i, (fog, (distances, values)) in enumerate(measured.items()):
            colour = PALETTE[i % len(PALETTE)]
            line = np.linspace(0.0, longest, 300)
            axes.plot(line, [visibility(fog, d) for d in line], color=colour, linewidth=1.0)
            marker = MARKERS[i % len(MARKERS)]
            axes.plot(distances, values, marker, color=colour, label=f"{fog:g} m⁻¹", zorder=3)
        axes.set(xlabel="distance [m]", xlim=(0, longest * 1.02))
        _finish(
            figure,
            [(fog, d, v) for fog, points in measured.items() for d, v in zip(*points, strict=True)],
        )
        figure.legend(loc="outside right upper", title="fog density", title_fontsize=7.5)
    return figure


def visibility_over_fog(
    measured: Points, *, distance: float, marked: float, at: str = ""
) -> Figure:
    """Draw measured visibility over fog density at one distance, on the law.

    Args:
        measured: (fog densities [1/m], visibilities 0..1).
        distance: Of the plates [m].
        marked: Fog density that gets a vertical line [1/m].
        at: What the line is, for its label.
    """
    fogs, values = measured
    with styled_figure() as figure:
        axes = figure.subplots()
        line = np.linspace(0.0, max(fogs), 300)
        law = [visibility(fog, distance) for fog in line]
        axes.plot(line, law, color=PALETTE[0], linewidth=1.0, label="1 − exp(−(f d)²)")
        points = f"measured, d = {distance:g} m"
        axes.plot(fogs, values, "o", color=PALETTE[0], label=points, zorder=3)
        axes.axvline(marked, color=PALETTE[1], linewidth=1.0)
        here = visibility(marked, distance)
        axes.annotate(
            f"{at} fog {marked:g} m⁻¹:\nvisibility {here:.3f}".strip(),
            (marked, here),
            xytext=(5, -40),
            textcoords="offset points",
            ha="left",
            color=PALETTE[1],
            fontsize=7.5,
        )
        axes.set(xlabel="fog density [1/m]", xlim=(0, max(fogs) * 1.02))
        axes.legend(loc="upper left")
        _finish(figure, [(fog, distance, v) for fog, v in zip(fogs, values, strict=True)])
    return figure


def largest_deviation(points: Sequence[tuple[float, float, float]]) -> float:
    """Return the largest distance of (fog, distance, visibility) points from the law."""
    return max(abs(v - visibility(fog, d)) for fog, d, v in points)


def _finish(figure: Figure, points: Sequence[tuple[float, float, float]]) -> None:
    figure.axes[0].set(ylabel="visibility 1 − exp(−(f d)²)", ylim=(-0.03, 1.03))
    text = (
        "points: measured from images of a black and a white plate; lines: the formula; "
        f"largest difference {largest_deviation(points):.4f}"
    )
    figure.text(0.995, 0.004, text, ha="right", va="bottom", fontsize=5.5, color=FAINT)
