"""Figures: camera images and the law of visibility, laid out as in a paper."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

from uwsim.analysis.plots import GREY, MARKERS, PALETTE, styled_figure

Pixels = npt.NDArray[np.uint8]
Points = tuple[Sequence[float], Sequence[float]]


def visibility_loss(fog: float, distance: float) -> float:
    """Compute the loss of contrast by fog, ``1 - exp(-(fog * distance)^2)``: 0 clear, 1 lost."""
    return 1.0 - math.exp(-((fog * distance) ** 2))


def draw_image_grid(
    images: Sequence[Pixels], captions: Sequence[str], *, columns: int, width: float = 6.6
) -> Figure:
    """Lay images of one size out in rows, with captions (a), (b), ... below.

    Args:
        images: the images, (h, w, 3) each.
        captions: a caption for each image.
        columns: the number of images in a row.
        width: the width of the figure [inch].
    """
    rows = math.ceil(len(images) / columns)
    height, image_width = images[0].shape[:2]
    column_width = width / columns
    with styled_figure((width, rows * (column_width * height / image_width + 0.28))) as figure:
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


def draw_image_with_inset(
    scene: Pixels, inset: Pixels, *, share: float = 0.36, width: float = 6.6
) -> Figure:
    """Show a scene with a camera's image in its lower right corner, framed in white.

    Args:
        scene: the image of the scene, (h, w, 3).
        inset: the image of the camera, (h, w, 3), of any size.
        share: the width of the inset relative to the width of the scene [1].
        width: the width of the figure [inch].
    """
    height, scene_width = scene.shape[:2]
    inset_height = share * scene_width * inset.shape[0] / inset.shape[1] / height
    with styled_figure((width, width * height / scene_width)) as figure:
        figure.set_layout_engine("none")
        axes = figure.add_axes((0, 0, 1, 1))
        axes.imshow(scene, interpolation="nearest", aspect="auto")
        axes.axis("off")
        margin = 0.02
        inset_axes = figure.add_axes(
            (1 - share - margin, margin * scene_width / height, share, inset_height)
        )
        inset_axes.imshow(inset, interpolation="nearest", aspect="auto")
        inset_axes.set_xticks([])
        inset_axes.set_yticks([])
        inset_axes.grid(False)
        for spine in inset_axes.spines.values():
            spine.set(visible=True, color="white", linewidth=2.0)
    return figure


def draw_visibility_over_distance(curves: Mapping[float, Points]) -> Figure:
    """Draw measured visibility over distance for several fogs, with the curves of the law.

    Args:
        curves: the distances [m] and visibilities 0..1, by fog density [1/m].
    """
    with styled_figure() as figure:
        axes = figure.subplots()
        max_distance = max(max(distances) for distances, _ in curves.values())
        for i, (fog, (distances, values)) in enumerate(curves.items()):
            colour = PALETTE[i % len(PALETTE)]
            line = np.linspace(0.0, max_distance, 300)
            axes.plot(line, [visibility_loss(fog, d) for d in line], color=colour, linewidth=1.0)
            marker = MARKERS[i % len(MARKERS)]
            axes.plot(distances, values, marker, color=colour, label=f"{fog:g} m⁻¹", zorder=3)
        axes.set(xlabel="distance [m]", xlim=(0, max_distance * 1.02))
        _label_axes(
            figure,
            [(fog, d, v) for fog, points in curves.items() for d, v in zip(*points, strict=True)],
        )
        figure.legend(loc="outside right upper", title="fog density", title_fontsize=7.5)
    return figure


def draw_visibility_over_fog(
    samples: Points, *, distance: float, marked_fog: float, marker_label: str = ""
) -> Figure:
    """Draw measured visibility over fog density at one distance, with the curve of the law.

    Args:
        samples: the fog densities [1/m], and the visibilities 0..1.
        distance: the distance of the plates [m].
        marked_fog: the fog density that a vertical line marks [1/m].
        marker_label: the text before the fog density in the label of the line.
    """
    fogs, values = samples
    with styled_figure() as figure:
        axes = figure.subplots()
        line = np.linspace(0.0, max(fogs), 300)
        law = [visibility_loss(fog, distance) for fog in line]
        axes.plot(line, law, color=PALETTE[0], linewidth=1.0, label="1 − exp(−(f d)²)")
        points = f"measured, d = {distance:g} m"
        axes.plot(fogs, values, "o", color=PALETTE[0], label=points, zorder=3)
        axes.axvline(marked_fog, color=PALETTE[1], linewidth=1.0)
        marked_visibility = visibility_loss(marked_fog, distance)
        axes.annotate(
            f"{marker_label} fog {marked_fog:g} m⁻¹:\nvisibility {marked_visibility:.3f}".strip(),
            (marked_fog, marked_visibility),
            xytext=(5, -40),
            textcoords="offset points",
            ha="left",
            color=PALETTE[1],
            fontsize=7.5,
        )
        axes.set(xlabel="fog density [1/m]", xlim=(0, max(fogs) * 1.02))
        axes.legend(loc="upper left")
        _label_axes(figure, [(fog, distance, v) for fog, v in zip(fogs, values, strict=True)])
    return figure


def largest_deviation(points: Sequence[tuple[float, float, float]]) -> float:
    """Return the largest distance of (fog, distance, visibility) points from the law."""
    return max(abs(v - visibility_loss(fog, d)) for fog, d, v in points)


def _label_axes(figure: Figure, points: Sequence[tuple[float, float, float]]) -> None:
    figure.axes[0].set(ylabel="visibility 1 − exp(−(f d)²)", ylim=(-0.03, 1.03))
    text = (
        "points: measured from images of a black and a white plate; lines: the formula; "
        f"largest difference {largest_deviation(points):.4f}"
    )
    figure.text(0.995, 0.004, text, ha="right", va="bottom", fontsize=5.5, color=GREY)
