r"""A water in a file: what ``uwsim calibrate`` writes, and a scene names.

.. code-block:: json

    {
      "uwsim_water": 1,
      "name": "tank-2-drops",
      "absorption": [0.31, 0.08, 0.05],
      "scattering": [0.62, 0.70, 0.74],
      "phase_function": {"type": "FournierForand", "refractive_index": 1.1, "slope": 3.5835},
      "source": "uwsim calibrate, setup.xml",
      "uncertainties": {"absorption": [0.02, 0.02, 0.02], "scattering": [0.02, 0.02, 0.02]}
    }

Coefficients are in 1/m, for red, green and blue. With ``wavelengths``, a list of rising wavelengths
[nm], they are spectra, which are reduced to these channels (`spectral.spectral_water`). The phase
functions are ``FournierForand``, ``HenyeyGreenstein`` (``asymmetry``), ``PhaseTable`` (``angles``
in rad, ``values`` in 1/sr) and ``PhaseMixture`` (``parts``, ``weights``). ``molecular_scattering``
(`Medium.molecular_scattering`), ``source`` and ``uncertainties`` (standard deviations, by the name
of the number) may be absent. All errors are reported at once, each with the line of its key.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeGuard, TypeVar

from ..base.files.input_files import read_document
from ..base.files.json_text import read_json
from ..errors import Diagnostic, FileError, SeveralErrors, UwsimError, choices
from .fournier_forand import FournierForand
from .henyey_greenstein import HenyeyGreenstein
from .medium import PETZOLD_AVERAGE, Medium
from .phase_function import PhaseFunction
from .phase_mixture import MAX_PARTS, PhaseMixture
from .phase_table import PhaseTable
from .spectral.spectral_water import SpectralWater

T = TypeVar("T")

FORMAT = 1
"""The version of the format, the value of ``uwsim_water``."""
MAX_BYTES = 1 << 20
"""The greatest size of a water file [bytes]."""
MAX_TEXT = 1000
"""The greatest number of characters of a name or a source."""
KEYS = (
    *("uwsim_water", "name", "absorption", "scattering", "phase_function"),
    *("molecular_scattering", "source", "uncertainties", "wavelengths"),
)
PARAMETERS: dict[str, tuple[str, ...]] = {
    "FournierForand": ("refractive_index", "slope"),
    "HenyeyGreenstein": ("asymmetry",),
    "PhaseTable": ("angles", "values"),
    "PhaseMixture": ("parts", "weights"),
}
"""The keys of each type of phase function."""


@dataclass(frozen=True, kw_only=True)
class WaterFile:
    """The content of a water file."""

    name: str
    """The name of the water."""
    medium: Medium
    """The coefficients and the phase function."""
    source: str = ""
    """The source of the numbers."""
    uncertainties: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    """The standard deviations of numbers by name, per channel."""


def read_water(path: Path | str) -> WaterFile:
    """Read a water file.

    Raises:
        FileError: the file is invalid; the error has every mistake, with its line.
    """
    path = Path(path)
    data = read_document(path, at_most=MAX_BYTES)
    reader = _Reader(str(path), data.decode("utf-8", errors="replace"))
    return reader.read()


def write_water(water: WaterFile) -> str:
    """Return the text of a water file."""
    document: dict[str, Any] = {
        "uwsim_water": FORMAT,
        "name": water.name,
        "absorption": list(water.medium.absorption),
        "scattering": list(water.medium.scattering),
        "phase_function": _describe_phase(water.medium.phase_function),
        "molecular_scattering": list(water.medium.molecular_scattering),
        "source": water.source,
        "uncertainties": {name: list(values) for name, values in water.uncertainties.items()},
    }
    return json.dumps(document, indent=2, ensure_ascii=False) + "\n"


def _describe_phase(phase: PhaseFunction) -> dict[str, Any]:
    name = type(phase).__name__
    parameters = {key: getattr(phase, key) for key in PARAMETERS[name]}
    if isinstance(phase, PhaseMixture):
        parameters["parts"] = [_describe_phase(part) for part in phase.parts]
    return {"type": name, **parameters}


class _Reader:
    """A reader of one file, which collects its errors."""

    def __init__(self, file: str, text: str) -> None:
        self._file = file
        self._text = text
        self._diagnostics: list[Diagnostic] = []

    def read(self) -> WaterFile:
        """Return the water, or raise FileError with all errors."""
        document = self._parse()
        self._check_keys(document, KEYS, "a water file")
        version = document.get("uwsim_water")
        if version != FORMAT or isinstance(version, bool):
            self._report("uwsim_water", f"uwsim_water is {version!r:.40}; expected {FORMAT}")
        absorption = self._read_numbers(document, "absorption")
        scattering = self._read_numbers(document, "scattering")
        phase = self._read_phase(document.get("phase_function"), 0)
        molecules: tuple[float, ...] | None = ()
        if "molecular_scattering" in document:
            molecules = self._read_numbers(document, "molecular_scattering")
        name, source = self._read_text(document, "name"), self._read_text(document, "source")
        uncertainties = self._read_uncertainties(document)
        medium = None
        if "wavelengths" in document:
            medium = self._read_spectrum(document, absorption, scattering, phase)
        elif None not in (absorption, scattering, phase, molecules):
            medium = self._build(
                "absorption",
                lambda: Medium(
                    absorption=absorption or (),
                    scattering=scattering or (),
                    phase_function=phase or PETZOLD_AVERAGE,
                    molecular_scattering=molecules or (),
                ),
            )
        self._raise_errors()
        assert medium is not None
        return WaterFile(name=name, medium=medium, source=source, uncertainties=uncertainties)

    def _read_spectrum(
        self,
        document: dict[str, Any],
        absorption: tuple[float, ...] | None,
        scattering: tuple[float, ...] | None,
        phase: PhaseFunction | None,
    ) -> Medium | None:
        if "molecular_scattering" in document:
            message = "molecular_scattering is that of pure water in a spectrum; expected none"
            self._report("molecular_scattering", message)
        wavelengths = self._read_numbers(document, "wavelengths")
        if wavelengths is None or absorption is None or scattering is None or phase is None:
            return None
        return self._build(
            "wavelengths",
            lambda: SpectralWater(
                wavelengths=wavelengths,
                absorption=absorption,
                scattering=scattering,
                phase_function=phase,
            ).reduce(),
        )

    def _parse(self) -> dict[str, Any]:
        try:
            document = read_json(self._text)
        except json.JSONDecodeError as error:
            self._diagnostics.append(
                Diagnostic(file=self._file, line=error.lineno, message=f"not JSON: {error.msg}")
            )
            document = {}
        if not isinstance(document, dict):
            self._report("", 'the file is not a JSON object; expected {"uwsim_water": 1, ...}')
        self._raise_errors()
        assert isinstance(document, dict)
        return document

    def _check_keys(self, document: dict[str, Any], keys: tuple[str, ...], owner: str) -> None:
        for key in document:
            if key not in keys:
                self._report(key, f"{key!r:.60} is not a key of {owner}.{choices(key, keys)}")

    def _read_text(self, document: dict[str, Any], key: str) -> str:
        text = document.get(key, "")
        if not isinstance(text, str) or len(text) > MAX_TEXT:
            self._report(key, f"{key} is not a text of at most {MAX_TEXT} characters")
            return ""
        return text

    def _read_numbers(self, document: dict[str, Any], key: str) -> tuple[float, ...] | None:
        numbers = document.get(key)
        if not isinstance(numbers, list):
            content = "missing" if key not in document else f"{numbers!r:.40}"
            self._report(key, f"{key} is {content}; expected a list of numbers")
            return None
        if not all(_is_number(number) for number in numbers):
            self._report(key, f"{key} has an entry that is no finite number; expected numbers")
            return None
        return tuple(float(number) for number in numbers)

    def _read_number(self, document: dict[str, Any], key: str) -> float | None:
        number = document.get(key)
        if not _is_number(number):
            self._report(key, f"{key} is {number!r:.40}; expected a number")
            return None
        return float(number)

    def _read_phase(self, document: object, depth: int) -> PhaseFunction | None:
        if not isinstance(document, dict):
            self._report(
                "phase_function",
                "phase_function is missing or no object; expected "
                '{"type": "FournierForand", "refractive_index": 1.1, "slope": 3.5835}',
            )
            return None
        name = document.get("type")
        if not isinstance(name, str) or name not in PARAMETERS:
            self._report(
                "type",
                f"no phase function is called {name!r:.60}.{choices(str(name), PARAMETERS)}",
            )
            return None
        self._check_keys(document, ("type", *PARAMETERS[name]), name)
        if name == "FournierForand":
            index, slope = (self._read_number(document, key) for key in PARAMETERS[name])
            if index is None or slope is None:
                return None
            return self._build("refractive_index", lambda: FournierForand(index, slope))
        if name == "HenyeyGreenstein":
            asymmetry = self._read_number(document, "asymmetry")
            if asymmetry is None:
                return None
            return self._build("asymmetry", lambda: HenyeyGreenstein(asymmetry))
        if name == "PhaseTable":
            angles, values = (self._read_numbers(document, key) for key in PARAMETERS[name])
            if angles is None or values is None:
                return None
            return self._build("angles", lambda: PhaseTable(angles, values))
        return self._read_mixture(document, depth)

    def _read_mixture(self, document: dict[str, Any], depth: int) -> PhaseFunction | None:
        described_parts = document.get("parts")
        weights = self._read_numbers(document, "weights")
        if depth > 0 or not isinstance(described_parts, list) or len(described_parts) > MAX_PARTS:
            self._report(
                "parts",
                f"parts is not a list of at most {MAX_PARTS} phase functions, none a mixture",
            )
            return None
        parts = [self._read_phase(part, depth + 1) for part in described_parts]
        known_parts = tuple(part for part in parts if part is not None)
        if weights is None or len(known_parts) < len(parts):
            return None
        return self._build("weights", lambda: PhaseMixture(known_parts, weights))

    def _read_uncertainties(self, document: dict[str, Any]) -> dict[str, tuple[float, ...]]:
        table = document.get("uncertainties", {})
        if not isinstance(table, dict):
            self._report("uncertainties", "uncertainties is no object; expected lists by name")
            return {}
        read_numbers = {key: self._read_numbers(table, key) for key in table}
        return {key: numbers for key, numbers in read_numbers.items() if numbers is not None}

    def _build(self, key: str, make: Callable[[], T]) -> T | None:
        """Return what ``make`` makes; None after an error, which is reported at a key."""
        try:
            return make()
        except SeveralErrors as error:
            for part in error.errors:
                self._report(key, str(part))
        except UwsimError as error:
            self._report(key, str(error))
        return None

    def _report(self, key: str, message: str) -> None:
        """Add an error at the first line that has the key."""
        position = self._text.find(f'"{key}"') if key else -1
        line = self._text.count("\n", 0, position) + 1 if position >= 0 else None
        self._diagnostics.append(Diagnostic(file=self._file, line=line, message=message))

    def _raise_errors(self) -> None:
        if self._diagnostics:
            raise FileError(sorted(self._diagnostics, key=lambda entry: entry.line or 0))


def _is_number(value: object) -> TypeGuard[float]:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:  # an integer above the greatest float
        return False
