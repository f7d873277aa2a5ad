"""``uwsim bathymetry``: charts of the sea floor: make, describe, convert, draw."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...base.terminal import clean_text
from ...errors import BadSetting
from ..options.help_texts import INPUT, OUTPUT, RELIEF, option
from ..options.options import JsonOption, OverwriteOption

if TYPE_CHECKING:
    from ...base.geodesy import Geodetic
    from ...bathymetry.chart import Chart
    from ...bathymetry.height_grid import HeightGrid
    from ...bathymetry.synthetic import SyntheticFloor

ChartArgument = Annotated[
    str, typer.Argument(metavar="CHART", help="A chart to describe, instead of a new one.")
]


@dataclass(frozen=True, kw_only=True)
class FloorOptions:
    """The floor that is made."""

    size: Annotated[
        str, option(INPUT, "--size", metavar="WxH", help="Size, east by north [m].")
    ] = "1000x1000"
    spacing: Annotated[
        float,
        option(INPUT, "--spacing", metavar="M", help="Distance between nodes [m].", min=0.001),
    ] = 2.0
    depth: Annotated[float, option(INPUT, "--depth", metavar="M", help="Mean depth [m].")] = 30.0
    slope: Annotated[
        float,
        option(
            INPUT,
            "--slope",
            metavar="DEG",
            help="Slope, deeper to the east [deg].",
            min=-60,
            max=60,
        ),
    ] = 0.0
    seed: Annotated[int, option(INPUT, "--seed", metavar="N", help="Seed of the floor.", min=0)] = 0


@dataclass(frozen=True, kw_only=True)
class ReliefOptions:
    """The relief of the floor that is made."""

    roughness: Annotated[
        float,
        option(RELIEF, "--roughness", metavar="M", help="Rms of the random heights [m].", min=0),
    ] = 1.0
    exponent: Annotated[
        float,
        option(
            RELIEF, "--exponent", metavar="N", min=0, max=8,
            help="Exponent of the 2-D spectrum: 2 is rough, 4 is smooth.",
        ),
    ] = 3.25  # fmt: skip
    corner: Annotated[
        float,
        option(RELIEF, "--corner", metavar="M", help="Longest waves of the relief [m].", min=0.001),
    ] = 200.0
    channels: Annotated[
        int, option(RELIEF, "--channels", metavar="N", help="Number of channels.", min=0, max=100)
    ] = 0
    channel: Annotated[
        str, option(RELIEF, "--channel", metavar="WxD", help="Their width and depth [m].")
    ] = "40x5"
    rocks: Annotated[
        float, option(RELIEF, "--rocks", metavar="N", help="Number of rocks in a hectare.", min=0)
    ] = 0.0
    rock_size: Annotated[
        float,
        option(RELIEF, "--rock-size", metavar="M", help="Mean diameter of rocks [m].", min=0.001),
    ] = 2.0


@dataclass(frozen=True, kw_only=True)
class ChartOutput:
    """The files that are written."""

    out: Annotated[
        Path | None,
        option(OUTPUT, "-o", "--out", metavar="FILE", help="Chart: .tif, .nc, .asc or .xyz."),
    ] = None
    lat: Annotated[
        float | None,
        option(
            OUTPUT, "--lat", metavar="DEG", help="Latitude of its middle [deg].", min=-90, max=90
        ),
    ] = None
    lon: Annotated[
        float | None,
        option(
            OUTPUT, "--lon", metavar="DEG", help="Longitude of its middle [deg].", min=-360, max=360
        ),
    ] = None
    picture: Annotated[
        Path | None,
        option(OUTPUT, "--picture", metavar="FILE.png", help="Shaded relief with contours."),
    ] = None
    overwrite: OverwriteOption = False


def bathymetry(
    floor: FloorOptions,
    relief: ReliefOptions,
    output: ChartOutput,
    chart: ChartArgument = "",
    as_json: JsonOption = False,
) -> None:
    """Make a synthetic sea floor, or describe a chart.

    Without CHART, a random floor of the stated spectrum is made: waves up to --corner, with the
    power k^-exponent below it, channels and rocks. With CHART, its statistics are printed; -o
    converts it to another format. --lat and --lon give a new floor a place on Earth.

    A scene uses the file as the file of an object with the element u:bathymetry:
    docs/bathymetry.md describes the element, formats and coordinates.
    """
    from ...bathymetry.chart_files import read_chart, write_chart
    from ...bathymetry.chart_statistics import compute_statistics

    _check_output(output)
    origin = _origin(output)
    if chart:
        source = read_chart(Path(chart))
        title = Path(chart).name
    else:
        from ...bathymetry.coordinates import LOCAL_SYSTEM, orthographic
        from ...bathymetry.synthetic import make_floor

        system = LOCAL_SYSTEM if origin is None else orthographic(origin)
        source = make_floor(_make_parameters(floor, relief), system)
        title = f"synthetic floor, seed {floor.seed}"
    grid = _local_grid(source, chart or "the floor")
    statistics = compute_statistics(grid)
    if output.out is not None:
        write_chart(output.out, source)
    if output.picture is not None:
        from ...analysis.plots.save import save_plot
        from ...bathymetry.picture import draw_chart

        save_plot(draw_chart(grid, title), output.picture)
    rows = {
        "nodes": f"{source.shape[1]} x {source.shape[0]}, {grid.spacing:g} m apart",
        "coordinates": source.system.description,
        "height": f"{statistics.least_height:.2f} to {statistics.greatest_height:.2f} m, "
        f"mean {statistics.mean_height:.2f} m",
        "rms height": f"{statistics.rms_height:.3g} m about the mean plane, "
        f"which slopes by {statistics.mean_slope:.3g} deg",
        "rms slope": f"{statistics.rms_slope:.3g} deg",
        "spectrum": "no fit: the chart is too small or flat"
        if statistics.exponent is None
        else f"exponent {statistics.exponent:.2f} (2-D)",
        "holes": f"{source.n_holes} nodes without a height",
    }
    written_files = [str(path) for path in (output.out, output.picture) if path is not None]
    if as_json:
        print(json.dumps(asdict(statistics) | {"written": written_files}, indent=2))
        return
    for name, text in rows.items():
        print(clean_text(f"{name:<12} {text}"))
    if written_files:
        print(clean_text(f"written: {', '.join(written_files)}"))


def _make_parameters(floor: FloorOptions, relief: ReliefOptions) -> SyntheticFloor:
    from ...bathymetry.synthetic import SyntheticFloor

    width, height = _two_numbers("--size", floor.size)
    channel_width, channel_depth = _two_numbers("--channel", relief.channel)
    return SyntheticFloor(
        width=width,
        height=height,
        spacing=floor.spacing,
        depth=floor.depth,
        slope=floor.slope,
        roughness=relief.roughness,
        exponent=relief.exponent,
        corner=relief.corner,
        channels=relief.channels,
        channel_depth=channel_depth,
        channel_width=channel_width,
        rocks=relief.rocks,
        rock_size=relief.rock_size,
        seed=floor.seed,
    )


def _two_numbers(name: str, text: str) -> tuple[float, float]:
    try:
        first, second = (float(part) for part in text.lower().split("x"))
    except ValueError:
        first = second = math.nan
    if not (0.0 < first < 1e7 and 0.0 < second < 1e7):
        raise BadSetting(f"{name} is {text!r}; expected two lengths above 0, such as 1000x500 [m].")
    return first, second


def _origin(output: ChartOutput) -> Geodetic | None:
    from ...base.geodesy import Geodetic

    if output.lat is None and output.lon is None:
        return None
    if output.lat is None or output.lon is None:
        raise BadSetting("One of --lat and --lon is missing; expected both or neither.")
    return Geodetic(latitude=math.radians(output.lat), longitude=math.radians(output.lon))


def _check_output(output: ChartOutput) -> None:
    """Raise BadSetting if a file exists, or has another suffix."""
    from ...bathymetry.chart_files import WRITERS

    if output.out is not None and output.out.suffix.lower() not in WRITERS:
        raise BadSetting(f"--out is {output.out}; expected a suffix of {', '.join(WRITERS)}.")
    if output.picture is not None and output.picture.suffix.lower() != ".png":
        raise BadSetting(f"--picture is {output.picture}; expected the suffix .png.")
    for path in (output.out, output.picture):
        if path is not None and path.exists() and not output.overwrite:
            raise BadSetting(f"{path} exists. Use --overwrite to replace it.")


def _local_grid(chart: Chart, source: str) -> HeightGrid:
    """Return a chart in metres, with holes filled, about its middle if it is on Earth."""
    from ...bathymetry.bathymetry import BathymetrySpec
    from ...bathymetry.resampling import middle_of

    return BathymetrySpec(holes="fill").fit(chart, source, middle_of(chart, source))
