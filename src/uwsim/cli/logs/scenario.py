"""``uwsim scenario``: a scene, a benchmark and a recording from the log of a mission."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, cast

import typer

from ...base.terminal import warn
from ...errors import BadSetting, ErrorCollector
from ..options.help_texts import INPUT, OUTPUT, RUN, option
from ..options.options import DataPathOption
from ..options.virtual import GAP_POLICIES, GapsOption, MappingOption, MaxGapOption

if TYPE_CHECKING:
    from ...devices.motion.pose_track import GapPolicy

LogArgument = Annotated[
    Path,
    typer.Argument(metavar="LOG", help="The log of a mission: a recording, CSV, .bin or .tlog."),
]


@dataclass(frozen=True, kw_only=True)
class MissionOptions:
    """The options of the mission: its log, its surroundings and its part."""

    scene: Annotated[
        str | None,
        option(
            INPUT,
            "--scene",
            metavar="BASE",
            help="The scene of the surroundings, with the vehicle and its camera [bluerov2-scene].",
        ),
    ] = None
    water: Annotated[
        Path | None,
        option(
            INPUT,
            "--water",
            metavar="FILE.json|.xml",
            help="The water: a file of uwsim calibrate, or a scene with it [that of the scene].",
        ),
    ] = None
    images: Annotated[
        str | None,
        option(
            INPUT,
            "--images",
            metavar="TOPIC",
            help="The recorded images that algorithms receive, with added fog; without it the "
            "scene renders views along the trajectory.",
        ),
    ] = None
    camera: Annotated[
        str | None,
        option(
            INPUT,
            "--camera",
            metavar="NAME",
            help="The camera of the scene at the place of the real one [the only one].",
        ),
    ] = None
    target: Annotated[
        str | None,
        option(
            INPUT,
            "--target",
            metavar="OBJECT",
            help="The object of the scene that trackers follow; without it estimates of the "
            "vehicle's position are scored.",
        ),
    ] = None
    vehicle: Annotated[
        str | None,
        option(
            INPUT,
            "--vehicle",
            metavar="NAME",
            help="The vehicle of the scene [that of the log's name, or the first].",
        ),
    ] = None
    mapping: MappingOption = None


@dataclass(frozen=True, kw_only=True)
class PartOptions:
    """The options of the part of the log, of gaps and of levels."""

    start: Annotated[
        float,
        option(INPUT, "--from", metavar="SECONDS", help="Time in the log of the begin.", min=0.0),
    ] = 0.0
    end: Annotated[
        float | None,
        option(
            INPUT, "--to", metavar="SECONDS", help="Time in the log of the end [the last pose]."
        ),
    ] = None
    gaps: GapsOption = "hold"
    max_gap: MaxGapOption = 1.0
    levels: Annotated[
        str | None,
        option(
            INPUT,
            "--levels",
            metavar="START:END:STEP",
            help="Added fog [1/m] of the levels; the factor on the water of rendered views in "
            "physical water [0:0.5:0.1; 1:4:1].",
        ),
    ] = None


def scenario(
    log: LogArgument,
    mission: MissionOptions,
    part: PartOptions,
    out: Annotated[
        Path, option(OUTPUT, "--out", "-o", metavar="DIR", help="The new folder.")
    ] = Path("scenario"),
    seed: Annotated[
        int,
        option(RUN, "--seed", metavar="N", min=0, help="Seed of the scene's variations (u:vary)."),
    ] = 0,
    data_path: DataPathOption = None,
) -> None:
    """Make a benchmark from the log of a mission, on which other algorithms are scored.

    The vehicle of BASE repeats the trajectory of the log. With --images the recorded images are
    replayed with added fog by the range of each pixel; benchmark-rendered.xml renders the same
    views instead. The folder has all that the benchmark reads, with hashes in provenance.json.
    """
    from ...scenarios import DEFAULT_SCENE, Levels, ScenarioRequest, make_scenario

    errors = ErrorCollector()
    levels = None
    with errors.collect():
        if part.levels is not None:
            levels = Levels.parse(part.levels)
    with errors.collect():
        if part.gaps not in GAP_POLICIES:
            raise BadSetting(f"--gaps {part.gaps}: expected one of {', '.join(GAP_POLICIES)}.")
    errors.raise_errors()
    result = make_scenario(
        ScenarioRequest(
            log=log,
            out=out,
            scene=mission.scene or DEFAULT_SCENE,
            water=mission.water,
            images=mission.images or "",
            camera=mission.camera,
            target=mission.target,
            vehicle=mission.vehicle,
            mapping=mission.mapping,
            start=part.start,
            end=part.end,
            levels=levels,
            gaps=cast("GapPolicy", part.gaps),
            max_gap=part.max_gap,
            seed=seed,
            folders=tuple(data_path or ()),
        )
    )
    for remark in result.remarks:
        warn(f"{log.name}: {remark}")
    images = f"{result.n_images} images" if result.n_images else "rendered views"
    print(f"{result.duration:.6g} s, {result.n_poses} poses, {images}; written: {result.folder}")
    print(f"Next: uwsim bench {result.benchmarks[0]}")
