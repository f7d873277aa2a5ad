"""A mode of OpenCV in which its results are the same on every processor."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def deterministic_opencv() -> Iterator[None]:
    """Make OpenCV use its generic code in one thread during this block.

    OpenCV has several implementations of most functions, and Intel's library for some functions,
    and chooses by the processor; their sums differ in the last bit. The mode applies to the whole
    process and is restored after the block.
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
