"""Masks as run lengths, in COCO's uncompressed and compressed form.

Run lengths count the pixels of a mask column by column, those outside first. The compressed form is
a text of 5 bits a character: each number after the second is stored as its difference to the number
before the last, as in the mask code of COCO (Lin et al., 2014).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt


def run_lengths(mask: npt.NDArray[np.bool_]) -> list[int]:
    """Return the lengths of alternating runs outside and inside of a mask (h, w), by columns."""
    pixels = np.asarray(mask, dtype=bool).T.reshape(-1)
    changes = np.flatnonzero(pixels[1:] != pixels[:-1]) + 1
    bounds = np.concatenate([[0], changes, [len(pixels)]])
    lengths: list[int] = np.diff(bounds).tolist()
    return [0, *lengths] if len(pixels) and pixels[0] else lengths


def compress(lengths: list[int]) -> str:
    """Return run lengths as COCO's compressed text."""
    letters = []
    for index, length in enumerate(lengths):
        number = length - lengths[index - 2] if index > 2 else length
        has_more = True
        while has_more:
            bits = number & 0x1F
            number >>= 5
            has_more = number != (-1 if bits & 0x10 else 0)
            letters.append(chr((bits | 0x20 if has_more else bits) + 48))
    return "".join(letters)


def decompress(text: str) -> list[int]:
    """Return the run lengths of COCO's compressed text."""
    lengths: list[int] = []
    position = 0
    while position < len(text):
        number, shift, has_more = 0, 0, True
        while has_more:
            bits = ord(text[position]) - 48
            number |= (bits & 0x1F) << shift
            has_more = bool(bits & 0x20)
            position, shift = position + 1, shift + 5
            if not has_more and bits & 0x10:
                number |= -1 << shift
        lengths.append(number + lengths[-2] if len(lengths) > 2 else number)
    return lengths


def read_mask(lengths: list[int], height: int, width: int) -> npt.NDArray[np.bool_]:
    """Return the mask (h, w) of run lengths."""
    values = np.arange(len(lengths)) % 2 == 1
    return np.repeat(values, lengths).reshape(width, height).T
