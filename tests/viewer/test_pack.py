from __future__ import annotations

import numpy as np
import pytest

from tests.support.packs import decode_text, read_array, unpack
from uwsim.viewer.pack import Blob, as_text, make_pack


def test_what_was_packed_comes_back() -> None:
    blob = Blob()
    arrays = [
        np.arange(6, dtype="<f4").reshape(2, 3),
        np.array([-3, 4], "<i2"),
        np.arange(5, dtype="u1"),
        np.array([2**32 - 1], "<u4"),
    ]
    refs = [blob.add(array) for array in arrays]
    head, data = unpack(make_pack({"refs": refs, "name": "é"}, blob))
    assert head["name"] == "é"
    for array, ref in zip(arrays, head["refs"], strict=True):
        assert ref[0] % 4 == 0
        assert read_array(ref, data).tolist() == array.ravel().tolist()


def test_the_same_content_gives_the_same_bytes() -> None:
    def once() -> bytes:
        blob = Blob()
        blob.add_bytes(b"abc")
        return make_pack({"a": [1, 2.5]}, blob)

    assert once() == once()


def test_the_numbers_begin_at_a_multiple_of_eight() -> None:
    import gzip

    for text in ("", "x", "xx", "xxx"):
        content = gzip.decompress(make_pack({"a": text}, Blob()))
        assert len(content) % 8 == 0


def test_a_number_that_is_none_is_refused() -> None:
    with pytest.raises(ValueError, match="JSON"):
        make_pack({"a": float("nan")}, Blob())


@pytest.mark.parametrize("n", range(6))
def test_text_of_a_pack_is_free_of_markup_and_gives_its_bytes_again(n: int) -> None:
    data = bytes(range(256)) * 64 + b"\xff\x00\xfe\x01\x80"[:n]
    text = as_text(data)
    assert len(text) == len(data) + -(-len(data) // 4)
    assert not set(text) & set("<>&\"'\\ \n")
    assert decode_text(text) == data
