"""Phase functions against closed forms, published numbers and numerical integration."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import j0

from uwsim.errors import BadSetting, SeveralErrors
from uwsim.optics import FournierForand, HenyeyGreenstein, PhaseFunction, PhaseTable

MODELS = [
    HenyeyGreenstein(0.9),
    HenyeyGreenstein(0.95),
    HenyeyGreenstein(0.0),
    FournierForand(),
    FournierForand(1.15, 4.0),
    FournierForand(1.05, 3.3),
]
DEGREE = math.pi / 180.0


def table_of(phase: PhaseFunction, first: float = 0.1, n_rows: int = 200) -> PhaseTable:
    angles = np.geomspace(first, 180.0, n_rows) * DEGREE
    return PhaseTable(tuple(angles.tolist()), tuple(phase.compute_density(angles).tolist()))


@pytest.mark.parametrize("phase", MODELS, ids=str)
def test_the_density_is_the_derivative_of_the_cumulative_share(phase: PhaseFunction) -> None:
    angles = np.geomspace(1e-5, math.pi, 20_000)
    rings = 2.0 * math.pi * phase.compute_density(angles) * np.sin(angles)
    steps = np.diff(phase.compute_cumulative(angles))
    middle = 0.5 * (rings[1:] + rings[:-1]) * np.diff(angles)
    np.testing.assert_allclose(steps[:-1], middle[:-1], rtol=1e-5, atol=1e-12)


@pytest.mark.parametrize("phase", [*MODELS, table_of(FournierForand())], ids=str)
def test_all_light_goes_somewhere(phase: PhaseFunction) -> None:
    assert phase.compute_cumulative(0.0) == 0.0
    assert float(phase.compute_cumulative(math.pi)) == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize(
    ("phase", "shares"),
    [
        (HenyeyGreenstein(0.9), [0.0001, 0.014, 0.24, 0.51]),
        (FournierForand(), [0.068, 0.254, 0.559, 0.712]),
    ],
    ids=str,
)
def test_the_shares_of_small_angles_are_those_published(
    phase: PhaseFunction, shares: list[float]
) -> None:
    angles = np.array([0.1, 1.0, 5.0, 10.0]) * DEGREE
    np.testing.assert_allclose(phase.compute_cumulative(angles), shares, atol=0.003)


@pytest.mark.parametrize(
    ("phase", "ratio", "cosine", "backward_density"),
    [
        (HenyeyGreenstein(0.9), 0.0229, 0.900, 2.20e-3),
        (HenyeyGreenstein(0.924), 0.01699, 0.924, 1.634e-3),
        (FournierForand(), 0.01832, 0.930, 2.86e-3),
    ],
    ids=str,
)
def test_backscatter_and_mean_cosine_are_those_published(
    phase: PhaseFunction, ratio: float, cosine: float, backward_density: float
) -> None:
    assert phase.backscatter_ratio == pytest.approx(ratio, abs=5e-5)
    assert phase.mean_cosine == pytest.approx(cosine, abs=5e-4)
    assert float(phase.compute_density(math.pi)) == pytest.approx(backward_density, rel=2e-3)


@pytest.mark.parametrize("phase", MODELS, ids=str)
def test_the_mean_cosine_is_that_of_the_density(phase: PhaseFunction) -> None:
    angles = np.geomspace(1e-7, math.pi, 100_000)
    weights = 2.0 * math.pi * phase.compute_density(angles) * np.sin(angles) * np.cos(angles)
    start = float(phase.compute_cumulative(1e-7))
    assert phase.mean_cosine == pytest.approx(start + np.trapezoid(weights, angles), abs=2e-5)


@pytest.mark.parametrize(
    ("phase", "energies"),
    [
        (FournierForand(), [0.229, 0.319, 0.432, 0.562, 0.738, 0.849, 0.957]),
        (HenyeyGreenstein(0.9), [0.043, 0.084, 0.160, 0.292, 0.557, 0.757, 0.939]),
    ],
    ids=str,
)
def test_the_encircled_energy_is_that_published(
    phase: PhaseFunction, energies: list[float]
) -> None:
    angles = np.array([0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0]) * DEGREE
    np.testing.assert_allclose(phase.compute_encircled_energy(angles), energies, atol=8e-4)


def test_the_encircled_energy_of_henyey_and_greenstein_has_its_small_angle_form() -> None:
    phase = HenyeyGreenstein(0.999)
    angles = np.geomspace(1e-5, 0.5 * DEGREE, 30)
    u = angles * math.sqrt(0.999) / 0.001
    expected = 1.0 + u - np.sqrt(1.0 + u * u)
    np.testing.assert_allclose(phase.compute_encircled_energy(angles), expected, atol=1e-3)


@pytest.mark.parametrize("angle", [0.003, 0.1, 1.0])
def test_the_encircled_energy_is_the_mean_of_the_cumulative_share(angle: float) -> None:
    phase = FournierForand()
    expected = quad(
        lambda s: float(phase.compute_cumulative(min(angle / s, math.pi))), 0.0, 1.0, limit=200
    )[0]
    assert float(phase.compute_encircled_energy(angle)) == pytest.approx(expected, abs=2e-5)


def test_the_transform_of_henyey_and_greenstein_is_wells_form_at_small_angles() -> None:
    frequencies = np.array([30.0, 100.0, 300.0, 1000.0])
    x = 2.0 * math.pi * frequencies * 0.001 / math.sqrt(0.999)
    expected = (1.0 - np.exp(-x)) / x
    np.testing.assert_allclose(
        HenyeyGreenstein(0.999).compute_transform(frequencies), expected, atol=1e-3
    )


@pytest.mark.parametrize("frequency", [0.3, 3.0])
def test_the_transform_is_the_integral_of_the_bessel_function(frequency: float) -> None:
    phase = HenyeyGreenstein(0.9)

    def mean_of(s: float) -> float:
        angles = (np.arange(2000) + 0.5) / 2000 * math.pi / 2
        rings = 2.0 * math.pi * phase.compute_density(angles) * np.sin(angles)
        bessel = j0(2.0 * math.pi * frequency * s * np.tan(angles))
        return float(np.mean(rings * bessel)) * math.pi / 2

    expected = float(np.mean([mean_of((k + 0.5) / 400) for k in range(400)]))
    assert float(phase.compute_transform(frequency)) == pytest.approx(expected, abs=3e-4)


@pytest.mark.parametrize("phase", MODELS, ids=str)
def test_the_transform_begins_at_the_share_of_forward_light(phase: PhaseFunction) -> None:
    forward = 1.0 - phase.backscatter_ratio
    assert float(phase.compute_transform(0.0)) == pytest.approx(forward, abs=1e-9)


@pytest.mark.parametrize("phase", [HenyeyGreenstein(0.9), FournierForand()], ids=str)
def test_a_table_of_a_phase_function_acts_like_it(phase: PhaseFunction) -> None:
    table = table_of(phase)
    angles = np.geomspace(0.01, 180.0, 50) * DEGREE
    np.testing.assert_allclose(
        table.compute_cumulative(angles), phase.compute_cumulative(angles), atol=1e-3
    )
    np.testing.assert_allclose(
        table.compute_density(angles[15:]), phase.compute_density(angles[15:]), rtol=5e-3
    )
    assert table.mean_cosine == pytest.approx(phase.mean_cosine, abs=3e-4)
    frequencies = np.array([0.3, 3.0, 30.0])
    np.testing.assert_allclose(
        table.compute_transform(frequencies), phase.compute_transform(frequencies), atol=1e-3
    )


def test_a_table_may_begin_at_zero() -> None:
    angles = np.append(0.0, np.geomspace(0.05, 180.0, 300)) * DEGREE
    phase = HenyeyGreenstein(0.9)
    table = PhaseTable(tuple(angles.tolist()), tuple(phase.compute_density(angles).tolist()))
    assert table.backscatter_ratio == pytest.approx(phase.backscatter_ratio, rel=1e-3)


def test_a_scattering_function_gives_its_scattering() -> None:
    table = table_of(HenyeyGreenstein(0.9))
    values = tuple(0.37 * value for value in table.values)
    phase, scattering = PhaseTable.from_scattering_function(table.angles, values)
    assert scattering == pytest.approx(0.37, rel=1e-3)
    assert phase.backscatter_ratio == pytest.approx(table.backscatter_ratio, rel=1e-9)


@pytest.mark.parametrize(
    ("angles", "values", "message"),
    [
        ((0.0, 1.0, 2.0, 3.0), (1.0,) * 4, "4 rows; expected 5 to 10000"),
        ((0.0, 1.0, 2.0, 3.0, 3.1), (1.0,) * 4, "5 angles and 4 values"),
        ((0.0, 1.0, 1.0, 3.0, 3.1), (0.08,) * 5, "Angle 3"),
        ((0.3, 1.0, 2.0, 3.0, 3.1), (0.08,) * 5, "begins at 0.3 rad"),
        ((0.0, 1.0, 1.2, 1.4, 1.5), (0.08,) * 5, "ends at 1.5 rad"),
        ((0.0, 1.0, 2.0, 3.0, 3.1), (0.08, 0.0, 0.08, 0.08, 0.08), "the value 0"),
        ((0.0, 1.0, 2.0, 3.0, 3.1), (1e-320,) * 5, "the value .*e-321; expected 1e-12 to"),
        ((0.0, 1.0, 2.0, 3.0, 3.1), (1e300,) * 5, "the value 1e.300; expected 1e-12 to"),
        ((0.1, math.nextafter(0.1, 1.0), 2.0, 3.0, 3.1), (1e-9,) * 5, "integral of a phase"),
        ((5e-324, 1e-323, 2.0, 3.0, 3.1), (1e-9,) * 5, "integral of a phase function"),
        ((0.0, 1.0, 2.0, 3.0, 3.1), (0.08, math.nan, 0.08, 0.08, 0.08), "not finite"),
        ((0.0, 1.0, 2.0, 3.0, 3.1), (0.2,) * 5, "integral of a phase function"),
        ((0.0,) * 10_001, (1.0,) * 10_001, "10001 rows"),
    ],
)
@pytest.mark.filterwarnings("error")
def test_an_invalid_table_is_rejected(
    angles: tuple[float, ...], values: tuple[float, ...], message: str
) -> None:
    with pytest.raises((BadSetting, SeveralErrors), match=message):
        PhaseTable(angles, values)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("value", [1e-12, 1e-3])
def test_a_table_that_rises_steeply_from_its_first_angle_has_no_warnings(value: float) -> None:
    table = PhaseTable((0.1, 0.1001, 1.0, 2.0, 3.1), (value, 0.08, 0.08, 0.08, 0.08))
    assert np.isfinite(table.compute_density(np.array([0.0, 1e-8, 0.05, 1.0]))).all()
    assert float(table.compute_cumulative(math.pi)) == 1.0


def test_all_errors_of_parameters_are_reported() -> None:
    with pytest.raises(SeveralErrors) as error:
        FournierForand(1.0, math.nan)
    assert "refractive index" in str(error.value)
    assert "slope" in str(error.value)
    with pytest.raises(BadSetting, match=r"expected 0 to 0\.999"):
        HenyeyGreenstein(1.0)
