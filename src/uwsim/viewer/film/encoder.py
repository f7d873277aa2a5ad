"""Encoders of films: ffmpeg, which runs as a process of its own, or animated WebP.

Equal images give equal bytes: ffmpeg uses one thread and leaves out what varies.
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
"""Suffix of a film -> options of ffmpeg."""
WEBP = ".webp"
SUFFIXES = (*CODECS, WEBP)
MAX_WEBP_FRAMES = 1200
"""Frames of a WebP, which are all held in memory."""
QUALITY = 60
"""Of WebP, 0..100."""


@dataclass(frozen=True, kw_only=True)
class Chapter:
    """A chapter of a film."""

    title: str
    """Shown by players."""
    start: float
    """Where it begins in the film [s]."""
    end: float
    """Where it ends [s]."""


class Encoder(Protocol):
    """Takes the images of a film one after the other."""

    def add(self, packed: bytes) -> None:
        """Append an image, packed by `packing_of` its path."""

    def close(self, *, is_to_keep: bool) -> None:
        """Write the file with the images so far; or leave none."""


def check_film_path(path: Path, *, overwrite: bool, others: Sequence[str] = ()) -> None:
    """Refuse a path that cannot be written; raises BadSetting or MissingExtra.

    Args:
        path: of the film.
        overwrite: whether an earlier file is replaced.
        others: suffixes of what is no film, but would have been right, too.
    """
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        near = did_you_mean(suffix, (*SUFFIXES, *others))
        right = ", ".join((*SUFFIXES, *others))
        raise BadSetting(f"-o {path}: expected one of {right}.{near}")
    if path.is_dir():
        raise BadSetting(f"-o {path}: is a folder.")
    if path.exists() and not overwrite:
        raise BadSetting(f"-o {path}: exists; --overwrite replaces it.")
    if suffix in CODECS and importlib.util.find_spec("imageio_ffmpeg") is None:
        raise MissingExtra(
            f"-o {path}: {suffix} is written by ffmpeg, which is not installed. Install it with: "
            "pip install 'uwsim[film]'; .webp needs nothing."
        )


Packing = Callable[[Pixels], bytes]
"""Makes of an image (h, w, 3) what an encoder takes."""


def packing_of(path: Path) -> Packing:
    """Return how images are packed for the encoder of a path, as its suffix says."""
    return as_rgb if path.suffix.lower() == WEBP else as_yuv


def as_rgb(frame: Pixels) -> bytes:
    """Pack an image (h, w, 3) as it is."""
    return frame.tobytes()


def as_yuv(frame: Pixels) -> bytes:
    """Pack an image (h, w, 3), both even, as planes of Y, U and V (BT.601, 4:2:0)."""
    return cv2.cvtColor(frame, cv2.COLOR_RGB2YUV_I420).tobytes()


def encoder_of(
    path: Path, size: tuple[int, int], rate: float, chapters: Sequence[Chapter]
) -> Encoder:
    """Return the encoder for a path, as its suffix says."""
    if path.suffix.lower() == WEBP:
        return WebpEncoder(path, size, rate)
    return FfmpegEncoder(path, size, rate, chapters)


class FfmpegEncoder:
    """A film by ffmpeg; MP4 (H.264) or WebM (VP9), with chapters.

    Args:
        path: of the film; it is there after `close`.
        size: width and height, both even [px].
        rate: images a second [Hz].
        chapters: in order.
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
        self._said: IO[bytes] = tempfile.TemporaryFile()  # noqa: SIM115 - the film's disk may be full
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
            stdout=self._said,
            stderr=self._said,
            start_new_session=True,  # Ctrl-C in a terminal does not reach it
        )

    def add(self, packed: bytes) -> None:
        """Append an image, packed by `as_yuv`.

        Raises:
            RunFailed: ffmpeg has failed.
        """
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(packed)
        except OSError:
            raise self._failure() from None
        self._n_frames += 1

    def close(self, *, is_to_keep: bool) -> None:
        """Write the film with the images so far; or stop, and leave nothing."""
        assert self._process.stdin is not None
        try:
            if not is_to_keep or self._n_frames == 0:
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
            self._said.close()
            self._folder.cleanup()

    def _cut_chapters(self) -> None:
        """Write the film again, without encoding, with the chapters that it reaches."""
        end = self._n_frames / self._rate
        reached = [replace(one, end=min(one.end, end)) for one in self._chapters if one.start < end]
        chapters = self._draft.with_name("reached")
        chapters.write_text(_metadata(reached), encoding="utf-8")
        whole = self._draft.with_name(f"whole{self._draft.suffix}")
        self._draft.replace(whole)
        command = [
            *(self._ffmpeg, "-y", "-nostdin", "-loglevel", "error", "-i", str(whole)),
            *("-i", str(chapters), "-map", "0:v", "-map_metadata", "1", "-map_chapters", "1"),
            *("-c", "copy", "-fflags", "+bitexact", str(self._draft)),
        ]
        if subprocess.run(command, stdout=self._said, stderr=self._said).returncode != 0:
            raise self._failure()

    def _failure(self) -> RunFailed:
        self._process.wait()
        self._said.seek(0)
        lines = self._said.read().decode(errors="replace").strip().splitlines()
        why = lines[-1].rpartition("] ")[2] if lines else "it said nothing"  # without its part
        return RunFailed(f"{self._path}: ffmpeg has failed: {why}")


class WebpEncoder:
    """An animated WebP that plays for ever.

    Args:
        path: of the file; it is there after `close`.
        size: width and height [px].
        rate: images a second [Hz].
    """

    def __init__(self, path: Path, size: tuple[int, int], rate: float) -> None:
        self._path, self._size, self._rate = path, size, rate
        self._frames: list[Image.Image] = []

    def add(self, packed: bytes) -> None:
        """Append an image, packed by `as_rgb`.

        Raises:
            RunFailed: there are too many.
        """
        if len(self._frames) >= MAX_WEBP_FRAMES:
            raise RunFailed(
                f"A .webp holds {MAX_WEBP_FRAMES} images at most; choose fewer with --fps, --speed "
                "or --until, or another suffix."
            )
        self._frames.append(Image.frombytes("RGB", self._size, packed))

    def close(self, *, is_to_keep: bool) -> None:
        """Write the file with the images so far; or leave none."""
        if not is_to_keep or not self._frames:
            return
        self._path.parent.mkdir(parents=True, exist_ok=True)
        first, *others = self._frames
        with atomic_write(self._path) as draft:
            first.save(
                draft,
                format="WEBP",
                save_all=True,
                append_images=others,
                duration=round(1000.0 / self._rate),
                loop=0,
                quality=QUALITY,
                method=4,
            )


def _metadata(chapters: Sequence[Chapter]) -> str:
    """Return the chapters as ffmpeg reads them."""
    lines = [";FFMETADATA1"]
    for chapter in chapters:
        lines += ["[CHAPTER]", "TIMEBASE=1/1000", f"START={round(1000 * chapter.start)}"]
        lines += [f"END={round(1000 * chapter.end)}", f"title={_escaped(chapter.title)}"]
    return "\n".join([*lines, ""])


def _escaped(text: str) -> str:
    for letter in "\\=;#":
        text = text.replace(letter, f"\\{letter}")
    return text.replace("\n", " ")
