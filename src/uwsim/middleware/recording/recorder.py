"""Recording of all topics of a bus into a file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Literal, Self, get_args

from ...bus import OBSERVER, Bus
from ...errors import BadSetting, RunFailed, did_you_mean
from ...messages import CompressedImage, Image, PointCloud2
from ...messages.build import NANOSECONDS
from ...messages.compressed import as_png
from ..types import WireType, wire_type
from .bag_file import BagFile
from .mcap_file import McapFile

FILES: dict[str, type[McapFile] | type[BagFile]] = {".mcap": McapFile, ".bag": BagFile}
"""Ending of a recording's name -> what writes it: ROS 2 in MCAP, a bag of ROS 1."""
ImageStorage = Literal["raw", "png", "none"]
"""How images are kept: as they are, as ``TOPIC/compressed`` without loss, or not at all."""
DRAWN = (Image, PointCloud2)
"""Messages that are drawn only where somebody reads them."""
PNG_ENCODINGS = ("rgb8", "mono8")
"""Encodings of images that PNG holds as they are; others are kept raw."""


def image_storage(text: str) -> ImageStorage:
    """Return how images are kept, as ``--images`` names it; raises BadSetting."""
    known: tuple[ImageStorage, ...] = get_args(ImageStorage)
    for each in known:
        if text == each:
            return each
    near = did_you_mean(text, known)
    raise BadSetting(f"--images {text!r}: expected one of {', '.join(known)}.{near}")


def check_path(path: Path, *, overwrite: bool) -> None:
    """Refuse a path to which nothing can be recorded; raises BadSetting."""
    if path.suffix.lower() not in FILES:
        raise BadSetting(f"--record {path}: only {' and '.join(FILES)} files are written.")
    if path.is_dir():
        raise BadSetting(f"--record {path}: is a folder.")
    if not path.parent.is_dir():
        raise BadSetting(f"--record {path}: there is no folder {path.parent}.")
    if path.exists() and not overwrite:
        raise BadSetting(f"--record {path}: exists; --overwrite replaces it.")


class Recorder:
    """Writes every message that a bus delivers, from `start` on.

    Args:
        bus: what is recorded, topics that come later included.
        path: the ``.mcap`` or ``.bag`` file.
        images: how images are kept.

    Raises:
        BadSetting: it cannot be written there.
    """

    def __init__(self, bus: Bus, path: Path, *, images: ImageStorage = "raw") -> None:
        self._bus = bus
        self._images = images
        self._stops: list[Callable[[], None]] = []
        self._path, self._failure = path, ""
        try:
            self._file = FILES[path.suffix.lower()](path)
        except OSError as error:
            raise BadSetting(f"--record {path}: cannot be written: {error.strerror}.") from None
        self.n_messages = 0
        """Messages recorded so far."""
        self.left_out: dict[str, str] = {}
        """Topic -> name of its type, of topics whose type has no definition."""

    def start(self, clock: Callable[[], float], *, is_unnoticed: bool = False) -> None:
        """Subscribe to every topic.

        Args:
            clock: returns the simulation time [s].
            is_unnoticed: whether nothing else may differ for it: images and point clouds are
                recorded where others read them, and what programs publish on topics of their own
                is none the more checked. Begin before programs are attached.
        """
        self._clock = clock
        is_before = True

        def appeared(topic: str, type: type) -> None:
            if not self.reads(type):
                return
            kind = wire_type(type)
            if kind is None or not self._file.has(kind):
                self.left_out[topic] = getattr(type, "__name__", str(type))
                return

            def receive(message: object) -> None:
                self._keep(f"/{topic}", kind, round(clock() * NANOSECONDS), message)

            counts = not is_unnoticed or (is_before and type not in DRAWN)
            stop = self._bus.subscribe(topic, type, receive, owner=OBSERVER, counts=counts)
            self._stops.append(stop)

        self._stops.append(self._bus.observe(appeared))
        is_before = False

    def reads(self, type: type) -> bool:
        """Whether topics of that message type are recorded, if it has a definition."""
        return type is not Image or self._images != "none"

    def _keep(self, topic: str, kind: WireType, time: int, message: object) -> None:
        if (
            self._images == "png"
            and isinstance(message, Image)
            and message.encoding in PNG_ENCODINGS
        ):
            topic, message = f"{topic}/compressed", as_png(message)
            packed = wire_type(CompressedImage)
            assert packed is not None
            kind = packed
        if self._failure:
            return
        try:
            self._file.write(topic, kind, time, message)
        except OSError as error:  # not here: an algorithm may be publishing
            self._failure = f"{error.strerror}: {self._path}"
            self._file.discard()
            return
        self.n_messages += 1

    def check(self) -> None:
        """Raise RunFailed if the file cannot be written any more; nothing is left of it then."""
        if self._failure:
            raise RunFailed(f"{self._failure} (the recording; nothing of it is kept)")

    def keep(self, topic: str, message: object) -> None:
        """Record a message that is not on the bus; after `start`."""
        own: type = type(message)
        kind = wire_type(own)
        if kind is not None and self._file.has(kind):
            self._keep(topic, kind, round(self._clock() * NANOSECONDS), message)

    def close(self) -> None:
        """Stop, and finish the file.

        Raises:
            RunFailed: it could not be written.
        """
        for stop in self._stops:
            stop()
        self._stops.clear()
        if not self._failure:
            try:
                self._file.close()
            except OSError as error:
                self._failure = f"{error.strerror}: {self._path}"
                self._file.discard()
        self.check()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        try:
            self.close()
        except RunFailed:
            if error is None:
                raise
