"""Reading of a log of any format."""

from __future__ import annotations

from pathlib import Path

from ..errors import BadSetting, Diagnostic, choices
from .csv_log import LogError, read_csv_log
from .mapping import LogMapping, read_mapping
from .vehicle_log import VehicleLog

SUFFIXES = (".csv", ".mcap", ".bag", ".db3", ".bin", ".tlog")
"""The suffixes of logs."""


def read_log(
    path: str | Path,
    *,
    mapping: str | Path | LogMapping | None = None,
    vehicle: str | None = None,
) -> VehicleLog:
    """Read the log of a vehicle: CSV, MCAP, bag, rosbag2, DataFlash ``.bin`` or ``.tlog``.

    Args:
        path: the file, or the folder of a rosbag2.
        mapping: a mapping file (`mapping`), or its content; None: the defaults of the format.
        vehicle: the name of the vehicle, of a log of several; None: that of the mapping, or the
            only one.

    Raises:
        UwsimError: the log or the mapping file is invalid; the error has all mistakes of the file.
    """
    file = Path(path)
    log_mapping = read_mapping(Path(mapping)) if isinstance(mapping, str | Path) else mapping
    if not file.exists():
        raise LogError([Diagnostic(file=str(file), line=None, message="does not exist")])
    suffix = file.suffix.lower()
    name = vehicle or ""
    if suffix == ".csv":
        return read_csv_log(file, log_mapping, name)
    if file.is_dir() or suffix in (".mcap", ".bag", ".db3"):
        from .recording_log import read_recording_log

        return read_recording_log(file, log_mapping, name)
    if suffix == ".bin":
        from .dataflash_log import read_dataflash_log

        return read_dataflash_log(file, log_mapping, name)
    if suffix == ".tlog":
        from .telemetry_log import read_telemetry_log

        return read_telemetry_log(file, log_mapping, name)
    raise BadSetting(
        f"{file}: {suffix or 'no suffix'} is not a format of logs.{choices(suffix, SUFFIXES)}"
    )
