"""OpenCV set up so that its results have the same bytes on every processor."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def deterministic_opencv() -> Iterator[None]:
    """Have OpenCV use its generic code in one thread.

    It has several codes for most functions, and Intel's library for some, and chooses by the
    processor; their sums differ in the last bit. That is a switch of the whole process, so it is
    put back where it was.
    """
    import cv2

    was_optimized, n_threads = cv2.useOptimized(), cv2.getNumThreads()
    cv2.setUseOptimized(False)
    cv2.setNumThreads(1)
    try:
        yield
    finally:
        cv2.setUseOptimized(was_optimized)
        cv2.setNumThreads(n_threads)
