"""The options of virtual sensors, and of the composition of real images with virtual objects."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ...errors import BadSetting, ErrorCollector
from .completion import complete_names
from .help_texts import COMPOSITION, LOG_POSES, option

if TYPE_CHECKING:
    from ...simulation import Simulation
    from ...virtual_sensors import ComposedCamera, ImageComposition

GAP_POLICIES = ("hold", "interpolate", "refuse")
GapsOption = Annotated[
    str,
    option(
        LOG_POSES,
        "--gaps",
        metavar="hold|interpolate|refuse",
        help="Between poses more than --max-gap apart: hold the last one, move on uniformly, "
        "or refuse the log.",
        autocompletion=complete_names(GAP_POLICIES),
    ),
]
"""The treatment of gaps in the poses of a log."""
MaxGapOption = Annotated[
    float,
    option(
        LOG_POSES,
        "--max-gap",
        metavar="SECONDS",
        help="The longest time between two poses that is no gap.",
        min=0.001,
        max=1e6,
    ),
]
"""The longest time between two poses that is no gap [s]."""


MappingOption = Annotated[
    Path | None,
    option(
        LOG_POSES,
        "--mapping",
        metavar="FILE.toml",
        help="Mapping file of the log: columns, topics, units and frames.",
    ),
]
"""The mapping file of a log."""


@dataclass(frozen=True, kw_only=True)
class FollowLogOptions:
    """The options of a vehicle that follows a log."""

    virtual_sensors: Annotated[
        bool,
        option(
            LOG_POSES,
            "--virtual-sensors",
            help="A vehicle of the scene follows the poses of the log at every step; the scene "
            "publishes on /virtual/TOPIC. The log may be a recording, CSV, .bin or .tlog.",
        ),
    ] = False
    vehicle: Annotated[
        str | None,
        option(
            LOG_POSES,
            "--vehicle",
            metavar="NAME",
            help="The vehicle that follows the log [that of the log's name, or the first].",
        ),
    ] = None
    mapping: MappingOption = None
    gaps: GapsOption = "hold"
    max_gap: MaxGapOption = 1.0

    def check(self, scene: str | None, errors: ErrorCollector) -> None:
        """Collect the errors of the options."""
        with errors.collect():
            if self.virtual_sensors and scene is None:
                raise BadSetting("--virtual-sensors needs a SCENE, whose sensors observe.")
        with errors.collect():
            if not self.virtual_sensors and (self.vehicle or self.mapping):
                raise BadSetting("--vehicle and --mapping need --virtual-sensors.")
        with errors.collect():
            if self.gaps not in GAP_POLICIES:
                raise BadSetting(f"--gaps {self.gaps}: expected one of {', '.join(GAP_POLICIES)}.")


@dataclass(frozen=True, kw_only=True)
class CompositionOptions:
    """The options of the composition of real images with virtual objects."""

    compose: Annotated[
        str | None,
        option(
            COMPOSITION,
            "--compose",
            metavar="CAMERA=TOPIC",
            help="Draw virtual objects into the real images of TOPIC, as a camera of the scene "
            "sees them; published on /virtual/composed/TOPIC.",
        ),
    ] = None
    real_objects: Annotated[
        list[str] | None,
        option(
            COMPOSITION,
            "--real",
            metavar="OBJECT",
            help="An object of the scene that is in the real images, besides the terrain and the "
            "vehicle: it hides virtual objects and is not drawn; may be repeated.",
        ),
    ] = None
    depth_topic: Annotated[
        str | None,
        option(
            COMPOSITION,
            "--depth-topic",
            metavar="TOPIC",
            help="Depth images of the real camera (32FC1 in m, 16UC1 in mm), which hide virtual "
            "objects.",
        ),
    ] = None
    add_fog: Annotated[
        float,
        option(
            COMPOSITION,
            "--add-fog",
            metavar="DENSITY",
            help="Fog added over real and virtual pixels [1/m].",
            min=0.0,
            max=1000.0,
        ),
    ] = 0.0
    add_water: Annotated[
        bool,
        option(
            COMPOSITION,
            "--add-water",
            help="Add the physical water of the scene over real images, taken in clear water.",
        ),
    ] = False
    add_particles: Annotated[
        bool,
        option(
            COMPOSITION,
            "--add-particles",
            help="Add the particles of the scene's physical water, such as marine snow.",
        ),
    ] = False
    assume_range: Annotated[
        float | None,
        option(
            COMPOSITION,
            "--assume-range",
            metavar="METRES",
            help="The range of real surfaces that neither the scene nor depth images show "
            "[infinite].",
            min=0.01,
            max=1e4,
        ),
    ] = None
    shadows: Annotated[
        bool,
        option(
            COMPOSITION, "--shadows", help="Virtual objects cast shadows of the sun on real ones."
        ),
    ] = False
    frames: Annotated[
        Path | None,
        option(
            COMPOSITION,
            "--frames",
            metavar="DIR",
            help="Also write the composed images into a new folder, as PNG files.",
        ),
    ] = None

    def check(self, errors: ErrorCollector) -> None:
        """Collect the errors of the options."""
        with errors.collect():
            if self.compose is not None and not all(self.compose.partition("=")[::2]):
                raise BadSetting(f"--compose {self.compose!r}: expected CAMERA=TOPIC.")
        dependent_options = {
            "--real": self.real_objects,
            "--depth-topic": self.depth_topic,
            "--add-fog": self.add_fog,
            "--add-water": self.add_water,
            "--add-particles": self.add_particles,
            "--assume-range": self.assume_range,
            "--shadows": self.shadows,
            "--frames": self.frames,
        }
        for name, value in dependent_options.items():
            with errors.collect():
                if value and self.compose is None:
                    raise BadSetting(f"{name} needs --compose CAMERA=TOPIC.")
        with errors.collect():
            if self.frames is not None and self.frames.exists() and any(self.frames.iterdir()):
                raise BadSetting(f"--frames {self.frames}: the folder is not empty.")

    def composition(self) -> ImageComposition | None:
        """Return the composition; None if none is requested."""
        from ...virtual_sensors import ImageComposition

        if self.compose is None:
            return None
        camera, _, topic = self.compose.partition("=")
        return ImageComposition(
            camera=camera,
            topic=topic,
            depth_topic=self.depth_topic or "",
            real_objects=tuple(self.real_objects or ()),
            fog=self.add_fog,
            unknown_range=self.assume_range,
            adds_water=self.add_water,
            has_particles=self.add_particles,
            has_shadows=self.shadows,
        )

    def open_camera(self, simulation: Simulation, vehicle: str) -> ComposedCamera | None:
        """Begin to compose images; None if none are requested."""
        from ...virtual_sensors import ComposedCamera

        composition = self.composition()
        if composition is None:
            return None
        if self.frames is not None:
            self.frames.mkdir(parents=True, exist_ok=True)
        return ComposedCamera(simulation, composition, vehicle, self.frames)

    @contextmanager
    def open_composition(self, simulation: Simulation, vehicle: str) -> Iterator[None]:
        """Compose images within the block, and print their number at its end."""
        camera = self.open_camera(simulation, vehicle)
        try:
            yield
        finally:
            if camera is not None:
                print(f"{camera.n_images} images composed, {camera.n_refused} left out")
