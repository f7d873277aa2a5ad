"""A request for a run: the user's options, before any file is read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ...bus import Algorithm
    from ...middleware.lockstep.spec import ClientSpec
    from ..tracks.track import Track


@dataclass(frozen=True, kw_only=True)
class PlanRequest:
    """The options of a run, as for ``uwsim bench``."""

    benchmark: str
    """A benchmark file, or a bundled name."""
    scene: str | None = None
    """A scene file or a bundled name; None for the scene that the benchmark names."""
    algorithm: str | None = None
    """A name, ``module:Class`` or file; None for the algorithm that the benchmark names."""
    algorithm_class: type[Algorithm] | None = None
    """The class that ``algorithm`` names, if the caller has it; None to find the class by name."""
    seed: int = 0
    """The seed of the first repeat."""
    repeat: int = 1
    """The number of repeats."""
    mode: str | None = None
    """``sequential`` or ``independent``; None for the mode in the benchmark file."""
    levels: Sequence[tuple[str, float]] = ()
    """Names and values of swept parameters: only these levels run; empty for all levels."""
    settings: Sequence[str] = ()
    """The text ``PATH=VALUE`` of each ``--set``."""
    compat: Sequence[str] = ()
    """Names of compatibility quirks: behaviour of the original UWSim to reproduce."""
    data_path: Sequence[Path] = ()
    """Folders in which files are searched."""
    plugins: Sequence[Path] = ()
    """The plugin files of ``--plugin``."""
    no_code: bool = False
    """True if code that the files name is refused."""
    client: ClientSpec | None = None
    """The external program that is the algorithm; None if the algorithm is a class."""
    udp_address: str | None = None
    """The address of this computer at which an autopilot connects; None: there is no autopilot."""
    has_px4: bool = False
    """True if the autopilot is PX4; otherwise it is ArduPilot."""
    in_process: bool = False
    """True if a third-party algorithm shares the simulation's process."""
    is_isolated: bool = False
    """True if only its own process imports the class of a third-party algorithm."""
    folder: Path | None = None
    """The folder of the files of an isolated algorithm; None for the current one."""
    track: Track | None = None
    """The rule for the topics that the algorithm may receive; None: all that are not hidden."""
    algorithm_is_from: str = ""
    """The file that names ``algorithm``; empty if the user named it."""
