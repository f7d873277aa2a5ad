"""Reading of a log of any format."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from ..errors import BadSetting, Diagnostic, choices
from .csv_log import LogError, read_csv_log
from .limits import MAX_COMMAND
from .mapping import LogMapping
from .mapping_reader import read_mapping
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
    log_mapping = read_mapping(Path(mapping)) if isinstance(mapping, str | Path) else mapping
    log = _read_format(Path(path), log_mapping, vehicle or "")
    place = ""
    if log_mapping is not None and log_mapping.vehicle and log_mapping.vehicle == log.vehicle:
        place = f"{log_mapping.path}:{log_mapping.vehicle_line}"
    return replace(log, remarks=(*log.remarks, *_describe_commands(log)), vehicle_place=place)


def _read_format(file: Path, log_mapping: LogMapping | None, name: str) -> VehicleLog:
    if not file.exists():
        raise LogError([Diagnostic(file=str(file), line=None, message="does not exist")])
    suffix = file.suffix.lower()
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


def _describe_commands(log: VehicleLog) -> list[str]:
    """Return a remark for thruster commands beyond the range -1 to 1."""
    remarks = []
    for part in log.commands:
        n_beyond = int((np.abs(part.values) > MAX_COMMAND).any(axis=1).sum())
        if part.kind == "thrusters" and n_beyond:
            remarks.append(
                f"commands.thrusters: {n_beyond} of {len(part.times)} samples are beyond -1 to 1, "
                f"up to {float(np.nanmax(np.abs(part.values))):.4g}; is the unit right?"
            )
    return remarks
