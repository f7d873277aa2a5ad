"""Images, fans of beams and sonars have a largest size, to which a scene file is held."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.errors import SceneError
from uwsim.scene.reader import read_scene


def diagnostics(cameras: str, folder: Path) -> list[str]:
    path = folder / "scene.xml"
    path.write_text(
        "<UWSimScene xmlns:u='urn:uwsim:1'>\n<vehicle><name>v</name><file>g500ARM5.urdf</file>"
        f"{cameras}</vehicle></UWSimScene>"
    )
    try:
        read_scene(path)
    except SceneError as error:
        return [diagnostic.message for diagnostic in error.diagnostics]
    return []


def camera(wide: int, high: int, kind: str = "virtualCamera") -> str:
    return (
        f"<{kind}><name>c</name><relativeTo>part0</relativeTo><resw>{wide}</resw>"
        f"<resh>{high}</resh></{kind}>"
    )


def sonar(step: str, kind: str) -> str:
    return (
        f"<{kind}><name>s</name><relativeTo>part0</relativeTo><initAngle>-60</initAngle>"
        f"<finalAngle>60</finalAngle><angleIncr>{step}</angleIncr><range>9</range>"
        f"{'<fov>3</fov>' if kind == 'ProfilingSonar' else ''}</{kind}>"
    )


@pytest.mark.parametrize("kind", ["virtualCamera", "virtualRangeImage"])
def test_an_image_may_have_8k_and_no_more(kind: str, tmp_path: Path) -> None:
    assert diagnostics(camera(7680, 4320, kind), tmp_path) == []
    assert diagnostics(camera(16384, 16384, kind), tmp_path) == [
        "an image of 16384 x 16384 pixels; expected at most 33 million"
    ]


def test_the_margin_of_blur_counts_in_the_size_of_an_image(tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"
    text = (
        "<UWSimScene xmlns:u='urn:uwsim:1'><oceanState><u:water law='physical'>"
        "<u:type>tank</u:type><u:blurMargin>0.5</u:blurMargin></u:water></oceanState>"
        "<vehicle><name>v</name><file>g500ARM5.urdf</file>{}</vehicle></UWSimScene>"
    )
    path.write_text(text.format(camera(3840, 2160)))
    read_scene(path)
    path.write_text(text.format(camera(3840, 2162)))
    with pytest.raises(SceneError, match=r"33\.2 million with <u:blurMargin>; expected"):
        read_scene(path)


def test_the_window_is_made_as_large_as_8k(tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"
    size = "<resw>99999</resw><resh>99999</resh>"
    path.write_text(f"<UWSimScene><simParams>{size}</simParams></UWSimScene>")
    params = read_scene(path).sim_params
    assert (params.resw, params.resh) == (7680, 4320)


@pytest.mark.parametrize("kind", ["virtualCamera", "virtualRangeImage"])
def test_a_camera_whose_planes_are_swapped_is_an_error(kind: str, tmp_path: Path) -> None:
    planes = "<fx>1</fx><fy>1</fy><x0>0</x0><y0>0</y0><f>{}</f><n>{}</n><k>0</k>"
    given = camera(4, 4, kind).replace(f"</{kind}>", f"<parameters>{planes}</parameters></{kind}>")
    assert diagnostics(given.format("10", "0.1"), tmp_path) == []
    assert diagnostics(given.format("0.1", "10"), tmp_path) == [
        "the far plane <f> is 0.1 m and the near plane <n> 10 m; expected the far one beyond the "
        "near one"
    ]


def test_all_images_together_have_a_largest_size(tmp_path: Path) -> None:
    assert diagnostics(camera(7680, 4320) * 3, tmp_path) == []
    assert diagnostics(camera(7680, 4320) * 5, tmp_path) == [
        "with this one, the images of the scene have 166 million pixels; expected at most 133"
    ]


@pytest.mark.parametrize("kind", ["multibeamSensor", "ProfilingSonar"])
def test_a_fan_of_beams_has_a_largest_number(kind: str, tmp_path: Path) -> None:
    assert diagnostics(sonar("0.1", kind), tmp_path) == []
    for step in ("1e-9", "5e-324"):
        (said,) = diagnostics(sonar(step, kind), tmp_path)
        assert said.endswith("are too many beams; expected at most 100000")


def imaging(kind: str, **fields: object) -> str:
    inside = "".join(f"<{name}>{value}</{name}>" for name, value in fields.items())
    return f"<u:{kind}><name>s</name><relativeTo>part0</relativeTo>{inside}</u:{kind}>"


def test_the_first_bin_of_a_sonar_begins_before_the_last_ends(tmp_path: Path) -> None:
    assert diagnostics(imaging("imagingSonar", range=5, minRange=6), tmp_path) == [
        "<minRange> is 6; expected less than <range>, 5 m"
    ]


@pytest.mark.parametrize(
    ("kind", "fields", "said"),
    [
        ("imagingSonar", {"bins": 9000, "beams": 4096}, "9000 bins of 4096 beams or pings"),
        ("scanningSonar", {"bins": 9000, "angleIncr": 0.05}, "9000 bins of 7200 beams or pings"),
        ("sideScanSonar", {"bins": 9000, "lines": 9000}, "9000 bins of 18000 beams or pings"),
        ("imagingSonar", {"bins": 9, "beams": 4096, "rows": 999}, "4096 columns of 999 rays"),
        (
            "imagingSonar",
            {"bins": 9, "beams": 999, "horizontalAperture": 300, "beamWidth": 0.01, "rows": 999},
            "8991 columns of 999 rays",
        ),
    ],
)
def test_sonars_have_a_largest_size(
    kind: str, fields: dict[str, object], said: str, tmp_path: Path
) -> None:
    (found,) = diagnostics(imaging(kind, **fields), tmp_path)
    assert found.startswith(f"{said}; expected at most")
