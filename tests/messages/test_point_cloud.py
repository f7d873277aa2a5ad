"""Point clouds in every layout that a driver may choose."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.errors import BadSetting
from uwsim.messages import PointCloud2, PointField, header, point_cloud, points

XYZ = np.array([[1.0, -2.0, 3.5], [0.25, 4.0, -8.0], [np.nan, 1.0, 2.0], [7.0, 0.0, 0.5]])


def cloud(
    places: np.ndarray,
    *,
    kinds: str = "fff",
    offsets: tuple[int, ...] = (0, 4, 8),
    step: int = 12,
    height: int = 1,
    row_padding: int = 0,
    is_bigendian: bool = False,
    names: str = "xyz",
) -> PointCloud2:
    """A cloud written byte by byte, with 0xAA wherever no coordinate lies."""
    width = len(places) // height
    row = width * step + row_padding
    data = np.full(height * row, 0xAA, dtype=np.uint8)
    order = ">" if is_bigendian else "<"
    for i, place in enumerate(places):
        for value, kind, offset in zip(place, kinds, offsets, strict=True):
            item = np.array([value]).astype(order + ("f4" if kind == "f" else "f8")).tobytes()
            at = i // width * row + i % width * step + offset
            data[at : at + len(item)] = list(item)
    fields = [
        PointField(name=name, offset=offset, datatype=7 if kind == "f" else 8, count=1)
        for name, kind, offset in zip(names, kinds, offsets, strict=True)
    ]
    fields.insert(1, PointField(name="rgb", offset=0, datatype=6, count=1))
    return PointCloud2(
        header=header(0.0),
        height=height,
        width=width,
        fields=fields,
        is_bigendian=is_bigendian,
        point_step=step,
        row_step=row,
        data=data,
        is_dense=False,
    )


@pytest.mark.parametrize(
    "layout",
    [
        {},
        {"is_bigendian": True},
        {"kinds": "ddd", "offsets": (0, 8, 16), "step": 24},
        {"kinds": "fdf", "offsets": (3, 9, 17), "step": 23, "is_bigendian": True},
        {"offsets": (20, 4, 12), "step": 32, "height": 2, "row_padding": 5},
        {"names": "zyx", "offsets": (8, 4, 0)},
    ],
)
def test_a_cloud_is_read_whatever_its_layout(layout: dict[str, object]) -> None:
    places = XYZ[:, ::-1] if layout.get("names") == "zyx" else XYZ
    actual = points(cloud(places, **layout))  # type: ignore[arg-type]
    assert actual.dtype == np.float64
    assert np.array_equal(actual, XYZ, equal_nan=True)


def test_doubles_keep_all_their_digits() -> None:
    one_third = np.full((1, 3), 1.0 / 3.0)
    assert points(cloud(one_third, kinds="ddd", offsets=(0, 8, 16), step=24))[0, 0] == 1.0 / 3.0


def test_a_cloud_that_was_built_is_read_back() -> None:
    new_cloud = point_cloud(XYZ, time=1.5, frame_id="laser")
    assert (new_cloud.width, new_cloud.is_dense, new_cloud.header.frame_id) == (4, False, "laser")
    assert np.array_equal(points(new_cloud), XYZ, equal_nan=True)
    assert points(point_cloud(np.empty((0, 3)))).shape == (0, 3)


def test_the_padding_of_the_last_row_may_be_missing() -> None:
    padded_cloud = cloud(XYZ, height=2, row_padding=5)
    padded_cloud.data = padded_cloud.data[:-5]
    assert np.array_equal(points(padded_cloud), XYZ, equal_nan=True)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"fields": []}, "no field 'x'; its fields: none"),
        ({"fields": cloud(XYZ).fields[:2]}, "no field 'y'; its fields: 'x', 'rgb'"),
        ({"data": np.zeros(40, dtype=np.uint8)}, "it has 40 bytes, 1 x 4 points need 48"),
        ({"point_step": 10}, "field 'z' at byte 8 lies outside a point of 10"),
        ({"height": 2, "row_step": 12}, "row_step is 12, too short for 4 points of 12 bytes"),
        ({"data": "points"}, "cannot be read"),
        ({"width": None}, "cannot be read"),
    ],
)
def test_a_cloud_that_makes_no_sense_is_a_clean_refusal(
    change: dict[str, object], text: str
) -> None:
    broken_cloud = cloud(XYZ)
    for name, value in change.items():
        setattr(broken_cloud, name, value)
    with pytest.raises(BadSetting, match=text):
        points(broken_cloud)


@pytest.mark.parametrize(("datatype", "type_name"), [(5, "int32"), (99, "of type 99")])
def test_coordinates_that_are_no_floats_are_refused(datatype: int, type_name: str) -> None:
    broken_cloud = cloud(XYZ)
    broken_cloud.fields[0].datatype = datatype
    with pytest.raises(BadSetting, match=f"field 'x' is {type_name}; expected float32 or float64"):
        points(broken_cloud)
