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
from .reserved_file import NoSpaceError

FILES: dict[str, type[McapFile] | type[BagFile]] = {".mcap": McapFile, ".bag": BagFile}
"""The writers by suffix: an MCAP file of ROS 2, a bag of ROS 1."""
ImageStorage = Literal["raw", "png", "none"]
"""The storage of images: uncompressed, on ``TOPIC/compressed`` without loss, or not at all."""
RENDERED_TYPES = (Image, PointCloud2)
"""The message types that are rendered only for subscribers."""
PNG_ENCODINGS = ("rgb8", "mono8")
"""The encodings of images that can be stored as PNG; images with others are stored raw."""


def image_storage(text: str) -> ImageStorage:
    """Read ``--images``; raise BadSetting if it is invalid."""
    names: tuple[ImageStorage, ...] = get_args(ImageStorage)
    for name in names:
        if text == name:
            return name
    near = did_you_mean(text, names)
    raise BadSetting(f"--images {text!r}: expected one of {', '.join(names)}.{near}")


def check_path(path: Path, *, overwrite: bool) -> None:
    """Raise BadSetting if nothing can be recorded to a path."""
    if path.suffix.lower() not in FILES:
        raise BadSetting(f"--record {path}: only {' and '.join(FILES)} files are written.")
    if path.is_dir():
        raise BadSetting(f"--record {path}: the path is a folder; expected a file.")
    if not path.parent.is_dir():
        raise BadSetting(f"--record {path}: there is no folder {path.parent}.")
    if path.exists() and not overwrite:
        raise BadSetting(f"--record {path}: the file exists; --overwrite replaces it.")


class Recorder:
    """A recording of every message that a bus delivers, from `start` on.

    Args:
        bus: the bus to record, including topics that are created later.
        path: the ``.mcap`` or ``.bag`` file.
        images: the storage of images.

    Raises:
        BadSetting: the file cannot be written.
    """

    def __init__(self, bus: Bus, path: Path, *, images: ImageStorage = "raw") -> None:
        self._bus = bus
        self._images = images
        self._stops: list[Callable[[], None]] = []
        self._path, self._failure, self._is_finished = path, "", False
        try:
            self._file = FILES[path.suffix.lower()](path)
        except OSError as error:
            raise BadSetting(f"--record {path}: cannot be written: {error.strerror}.") from None
        self.n_messages = 0
        """The number of messages recorded so far."""
        self.left_out: dict[str, str] = {}
        """The name of the type of each topic whose type has no ROS definition."""

    def start(self, clock: Callable[[], float], *, is_passive: bool = False) -> None:
        """Subscribe to every topic.

        Args:
            clock: a function that returns the simulation time [s].
            is_passive: True if the recording must not affect the run. Images and point clouds are
                then recorded only if they have other subscribers, and topics that programs create
                do not count the recording as a subscriber. Call `start` before programs are
                attached.
        """
        self._clock = clock
        is_before = True

        def on_topic(topic: str, type: type) -> None:
            if not self.is_recorded(type):
                return
            kind = wire_type(type)
            if kind is None or not self._file.has_type(kind):
                self.left_out[topic] = getattr(type, "__name__", str(type))
                return

            def receive(message: object) -> None:
                self._write(f"/{topic}", kind, round(clock() * NANOSECONDS), message)

            is_counted = not is_passive or (is_before and type not in RENDERED_TYPES)
            self._stops.append(
                self._bus.subscribe(topic, type, receive, owner=OBSERVER, is_counted=is_counted)
            )

        self._stops.append(self._bus.observe(on_topic))
        is_before = False

    def is_recorded(self, type: type) -> bool:
        """Return whether to record topics of a message type, if it has a definition."""
        return type is not Image or self._images != "none"

    def _write(self, topic: str, kind: WireType, time: int, message: object) -> None:
        if (
            self._images == "png"
            and isinstance(message, Image)
            and message.encoding in PNG_ENCODINGS
        ):
            topic, message = f"{topic}/compressed", as_png(message)
            png_type = wire_type(CompressedImage)
            assert png_type is not None
            kind = png_type
        if self._failure:
            return
        try:
            self._file.write(topic, kind, time, message)
        except NoSpaceError as error:  # not raised here, as an algorithm may be publishing
            self._finish()
            if not self._failure:
                end = f"the recording is complete up to {time / NANOSECONDS:g} s"
                self._failure = f"{error.strerror}: {self._path} ({end})"
            return
        except OSError as error:
            self._discard(error)
            return
        self.n_messages += 1

    def _finish(self) -> None:
        self._is_finished = True
        try:
            self._file.close()
        except OSError as error:
            self._discard(error)

    def _discard(self, error: OSError) -> None:
        self._is_finished = True
        self._failure = f"{error.strerror}: {self._path} (the recording is discarded)"
        self._file.discard()

    def check(self) -> None:
        """Raise RunFailed if the disk is full, or the file cannot be written.

        On a full disk the file has all messages before that time; otherwise it is deleted.
        """
        if self._failure:
            raise RunFailed(self._failure)

    def keep(self, topic: str, message: object) -> None:
        """Record a message that is not published on the bus; call it after `start`."""
        message_type: type = type(message)
        kind = wire_type(message_type)
        if kind is not None and self._file.has_type(kind):
            self._write(topic, kind, round(self._clock() * NANOSECONDS), message)

    def close(self) -> None:
        """Stop recording, and finish the file.

        Raises:
            RunFailed: the file could not be written.
        """
        for stop in self._stops:
            stop()
        self._stops.clear()
        if not self._is_finished:
            self._finish()
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
