"""The transfer curve of sRGB against published values."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.base.numerics.srgb import decode_array, decode_number, encode_array, encode_number


def test_known_values_of_the_curve() -> None:
    assert decode_number(0.5) == pytest.approx(0.2140411, abs=1e-7)
    assert encode_number(0.18) == pytest.approx(0.4613561, abs=1e-7)  # a grey card
    assert (encode_number(0.0), decode_number(0.0)) == (0.0, 0.0)
    assert encode_number(1.0) == pytest.approx(1.0, abs=1e-12)


def test_both_directions_are_inverse_and_meet_at_the_line() -> None:
    for value in np.linspace(0.0, 1.0, 1001).tolist():
        assert encode_number(decode_number(value)) == pytest.approx(value, abs=1e-6)
    assert encode_number(0.0031308) == pytest.approx(encode_number(0.00313081), abs=1e-6)


def test_arrays_have_the_bits_of_numbers() -> None:
    values = np.linspace(0.0, 1.0, 257)
    assert encode_array(values).tolist() == [encode_number(x) for x in values.tolist()]
    assert decode_array(values).tolist() == [decode_number(x) for x in values.tolist()]
