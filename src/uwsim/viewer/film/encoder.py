"""Encoders of films: ffmpeg, which runs as a separate process, or animated WebP.

Equal images give equal bytes: ffmpeg uses one thread and writes no variable metadata.
"""

from __future__ import annotations

import importlib.util
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO, Protocol

import cv2
from PIL import Image

from ...errors import BadSetting, MissingExtra, RunFailed, did_you_mean, name_file_in_errors
from ...results.atomic_file import atomic_write
from .overlay import Pixels

CODECS = {
    ".mp4": ("-c:v", "libx264", "-preset", "veryfast", "-crf", "26", "-movflags", "+faststart"),
    ".webm": (
        *("-c:v", "libvpx-vp9", "-crf", "34", "-b:v", "0"),
        *("-deadline", "realtime", "-cpu-used", "8", "-row-mt", "0"),
    ),
}
"""The options of ffmpeg by suffix of the film's file."""
WEBP = ".webp"
SUFFIXES = (*CODECS, WEBP)
MAX_WEBP_FRAMES = 1200
"""The greatest number of images of a WebP film, which are all held in memory."""
WEBP_QUALITY = 60
"""The quality of WebP images, 0..100."""


@dataclass(frozen=True, kw_only=True)
class Chapter:
    """A chapter of a film."""

    title: str
    """The title that video players show."""
    start: float
    """The time of its start in the film [s]."""
    end: float
    """The time of its end in the film [s]."""


class Encoder(Protocol):
    """An encoder of the images of a film, one after the other."""

    def add(self, frame: bytes) -> None:
        """Append an image, as the bytes to which `conversion_for` the film's path converts it."""

    def close(self, *, keeps_file: bool) -> None:
        """Write the file with the images so far, or discard it."""


def check_film_path(path: Path, *, overwrite: bool, other_suffixes: Sequence[str] = ()) -> None:
    """Reject a path that cannot be written; raise BadSetting or MissingExtra.

    Args:
        path: the path of the film.
        overwrite: True if an earlier file is replaced.
        other_suffixes: the valid suffixes of other files.
    """
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        near = did_you_mean(suffix, (*SUFFIXES, *other_suffixes))
        suffixes = ", ".join((*SUFFIXES, *other_suffixes))
        raise BadSetting(f"-o {path}: expected one of {suffixes}.{near}")
    if path.is_dir():
        raise BadSetting(f"-o {path}: the path is a folder; expected a file.")
    if path.exists() and not overwrite:
        raise BadSetting(f"-o {path}: the file exists; --overwrite replaces it.")
    if suffix in CODECS and importlib.util.find_spec("imageio_ffmpeg") is None:
        raise MissingExtra(
            f"-o {path}: {suffix} needs ffmpeg, which is not installed. Install it with: "
            "pip install 'uwsim[film]'; .webp does not need it."
        )


ImageConversion = Callable[[Pixels], bytes]
"""A function that converts an image, (h, w, 3), to the bytes that an encoder expects."""


def conversion_for(path: Path) -> ImageConversion:
    """Return the function that converts images for the encoder of a path, by the path's suffix."""
    return as_rgb if path.suffix.lower() == WEBP else as_yuv


def as_rgb(frame: Pixels) -> bytes:
    """Return the bytes of an image, (h, w, 3), without change."""
    return frame.tobytes()


def as_yuv(frame: Pixels) -> bytes:
    """Return an image, (h, w, 3) with even h and w, as planes of Y, U and V (BT.601, 4:2:0)."""
    return cv2.cvtColor(frame, cv2.COLOR_RGB2YUV_I420).tobytes()


def encoder_of(
    path: Path, size: tuple[int, int], rate: float, chapters: Sequence[Chapter]
) -> Encoder:
    """Return the encoder for the path of a film, by the path's suffix."""
    if path.suffix.lower() == WEBP:
        return WebpEncoder(path, size, rate)
    return FfmpegEncoder(path, size, rate, chapters)


class FfmpegEncoder:
    """An encoder by ffmpeg, for MP4 (H.264) or WebM (VP9) with chapters.

    Args:
        path: the path of the film, which `close` writes.
        size: the width and height, both even [px].
        rate: the rate of images in the film [Hz].
        chapters: the chapters in order.
    """

    def __init__(
        self, path: Path, size: tuple[int, int], rate: float, chapters: Sequence[Chapter]
    ) -> None:
        import imageio_ffmpeg

        self._path, self._rate, self._chapters = path, rate, chapters
        self._n_frames = 0
        self._ffmpeg = imageio_ffmpeg.get_ffmpeg_exe()
        path.parent.mkdir(parents=True, exist_ok=True)
        self._folder = tempfile.TemporaryDirectory(prefix=f".{path.stem}-", dir=path.parent)
        folder = Path(self._folder.name)
        self._draft = folder / f"film{path.suffix.lower()}"
        self._log: IO[bytes] = tempfile.TemporaryFile()  # noqa: SIM115 - the film's disk may be full
        with name_file_in_errors(path):
            (folder / "chapters").write_text(_metadata(chapters), encoding="utf-8")
        command = [
            *(self._ffmpeg, "-y", "-nostdin", "-loglevel", "error"),
            *("-f", "rawvideo", "-pix_fmt", "yuv420p", "-s", f"{size[0]}x{size[1]}"),
            *("-r", f"{rate:g}", "-threads", "1", "-i", "pipe:0"),
            *("-i", str(folder / "chapters"), "-map_metadata", "1", "-map_chapters", "1"),
            *("-map", "0:v", *CODECS[path.suffix.lower()], "-pix_fmt", "yuv420p", "-threads", "1"),
            *("-fflags", "+bitexact", "-flags:v", "+bitexact", str(self._draft)),
        ]
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=self._log,
            stderr=self._log,
            start_new_session=True,  # so that Ctrl-C in a terminal does not end ffmpeg
        )

    def add(self, frame: bytes) -> None:
        """Append an image, converted by `as_yuv`.

        Raises:
            RunFailed: ffmpeg failed.
        """
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(frame)
        except OSError:
            raise self._failure() from None
        self._n_frames += 1

    def close(self, *, keeps_file: bool) -> None:
        """Write the film with the images so far, or discard it."""
        assert self._process.stdin is not None
        try:
            if not keeps_file or self._n_frames == 0:
                self._process.kill()
                self._process.wait()
                with suppress(OSError):
                    self._process.stdin.close()
                return
            self._process.stdin.close()
            if self._process.wait() != 0:
                raise self._failure()
            if self._chapters and self._chapters[-1].end > (self._n_frames + 1) / self._rate:
                self._cut_chapters()
            self._draft.replace(self._path)
        finally:
            self._log.close()
            self._folder.cleanup()

    def _cut_chapters(self) -> None:
        """Copy the encoded film to a file with only the chapters up to its end."""
        end = self._n_frames / self._rate
        chapters = [replace(c, end=min(c.end, end)) for c in self._chapters if c.start < end]
        metadata = self._draft.with_name("reached")
        metadata.write_text(_metadata(chapters), encoding="utf-8")
        film = self._draft.with_name(f"whole{self._draft.suffix}")
        self._draft.replace(film)
        command = [
            *(self._ffmpeg, "-y", "-nostdin", "-loglevel", "error", "-i", str(film)),
            *("-i", str(metadata), "-map", "0:v", "-map_metadata", "1", "-map_chapters", "1"),
            *("-c", "copy", "-fflags", "+bitexact", str(self._draft)),
        ]
        if subprocess.run(command, stdout=self._log, stderr=self._log).returncode != 0:
            raise self._failure()

    def _failure(self) -> RunFailed:
        self._process.wait()
        self._log.seek(0)
        lines = self._log.read().decode(errors="replace").strip().splitlines()
        reason = lines[-1].rpartition("] ")[2] if lines else "it wrote no message"
        return RunFailed(f"{self._path}: ffmpeg failed: {reason}")


class WebpEncoder:
    """An encoder of an animated WebP that repeats.

    Args:
        path: the path of the file, which `close` writes.
        size: the width and height [px].
        rate: the rate of images in the film [Hz].
    """

    def __init__(self, path: Path, size: tuple[int, int], rate: float) -> None:
        self._path, self._size, self._rate = path, size, rate
        self._frames: list[Image.Image] = []

    def add(self, frame: bytes) -> None:
        """Append an image, converted by `as_rgb`.

        Raises:
            RunFailed: the film has too many images.
        """
        if len(self._frames) >= MAX_WEBP_FRAMES:
            raise RunFailed(
                f"A .webp has at most {MAX_WEBP_FRAMES} images; reduce them by --fps, --speed "
                "or --until, or choose another suffix."
            )
        self._frames.append(Image.frombytes("RGB", self._size, frame))

    def close(self, *, keeps_file: bool) -> None:
        """Write the file with the images so far, or discard it."""
        if not keeps_file or not self._frames:
            return
        self._path.parent.mkdir(parents=True, exist_ok=True)
        first_frame, *frames = self._frames
        with atomic_write(self._path) as draft:
            first_frame.save(
                draft,
                format="WEBP",
                save_all=True,
                append_images=frames,
                duration=round(1000.0 / self._rate),
                loop=0,
                quality=WEBP_QUALITY,
                method=4,
            )


def _metadata(chapters: Sequence[Chapter]) -> str:
    """Return a metadata file of ffmpeg with the chapters."""
    lines = [";FFMETADATA1"]
    for chapter in chapters:
        lines += ["[CHAPTER]", "TIMEBASE=1/1000", f"START={round(1000 * chapter.start)}"]
        lines += [f"END={round(1000 * chapter.end)}", f"title={_escape(chapter.title)}"]
    return "\n".join([*lines, ""])


def _escape(text: str) -> str:
    for letter in "\\=;#":
        text = text.replace(letter, f"\\{letter}")
    return text.replace("\n", " ")
