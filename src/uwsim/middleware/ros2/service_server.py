"""Services over DDS in the wire format of rmw_cyclonedds: a header of 16 bytes before each sample.

The header of a request or reply has the number of the client and the number of its request. Other
vendors of DDS send these in the inline QoS, which cyclonedds for Python does not expose. Requests
of nodes on Fast DDS therefore do not identify the client, and are ignored; such clients are
reported when they connect.
"""

from __future__ import annotations

import struct
from concurrent.futures import Future
from functools import partial
from typing import Any

from cyclonedds.idl import types

from ...errors import BadMessage, UwsimError
from ..encodings import from_cdr, to_cdr
from ..log import Log
from ..stamps import to_ros_time, to_sim_time
from ..types import WireService, ros2_store
from .names import reply_name, request_name, type_hash_data
from .node import Call
from .participant import WRITERS_CHANGED, Participant
from .quality import Quality
from .raw_types import CDR_HEADER, RawSample, raw_type
from .senders import Senders

CALL_HEADER = struct.Struct("<Qq")
"""The encoding of the header: the number of the client, and the number of its request."""
CALL_FIELDS = {"client": types.uint64, "sequence": types.int64}
"""The fields of the header, by name."""
CYCLONE_VENDOR = b"\x01\x10"
"""The first two bytes of the identity of every endpoint of Cyclone DDS."""
VENDORS = {b"\x01\x0f": "Fast DDS", b"\x01\x01": "Connext", b"\x01\x03": "OpenDDS"}
"""The names of other vendors, by the first two bytes of the identity of their endpoints."""


class ServiceServer:
    """The server of one service.

    Args:
        participant: the participant that offers the service.
        name: the name of the service, without a leading slash.
        service_type: the type of the service.
        pass_request: a function that passes a request to the simulation and returns the future of
            the response.
        log: the log for calls that cannot be answered.
    """

    def __init__(
        self,
        participant: Participant,
        name: str,
        service_type: WireService,
        pass_request: Call,
        log: Log,
    ) -> None:
        self._participant, self._name, self._type = participant, name, service_type
        self._pass_request, self._log, self._senders = pass_request, log, Senders()
        hash_data = type_hash_data(service_type.type_hash)
        store, quality = ros2_store(), Quality()
        self.writer = participant.writer(
            reply_name(name),
            raw_type(store, service_type.response.ros2_name, prefix=CALL_FIELDS),
            quality,
            user_data=hash_data,
        )
        self.reader = participant.reader(
            request_name(name),
            raw_type(store, service_type.request.ros2_name, prefix=CALL_FIELDS),
            quality,
            self._receive,
            user_data=hash_data,
            events={WRITERS_CHANGED: self._check_clients},
        )

    def close(self) -> None:
        """Withdraw the service."""
        self._participant.forget(self.reader)
        self._participant.forget(self.writer.entity)

    def _check_clients(self, reader: Any) -> None:
        """Report clients that cannot be answered."""
        for handle in reader.get_matched_publications():
            publication = reader.get_matched_publication_data(handle)
            vendor = CYCLONE_VENDOR if publication is None else bytes(publication.key.bytes[:2])
            if vendor != CYCLONE_VENDOR:
                name = VENDORS.get(vendor, "another DDS")
                self._log.report(
                    f"service /{self._name} cannot answer a client that uses {name}; its node "
                    "needs RMW_IMPLEMENTATION=rmw_cyclonedds_cpp",
                    kind=f"vendor {self._name}",
                )

    def _receive(self, sample: RawSample) -> None:
        if not self._is_of_cyclone(sample):
            return
        try:
            header, body = split_header(sample.data)
            request: object = to_sim_time(from_cdr(self._type.service.request, body))
        except (BadMessage, struct.error) as error:
            self._log.report(f"service /{self._name}: a call was refused: {error}", kind=self._name)
            return
        sender = self._senders.sender_of(self.reader, sample)
        self._pass_request(request, sender).add_done_callback(partial(self._reply, header))

    def _is_of_cyclone(self, sample: RawSample) -> bool:
        handle = sample.sample_info.publication_handle
        publication = self.reader.get_matched_publication_data(handle)
        return publication is not None and bytes(publication.key.bytes[:2]) == CYCLONE_VENDOR

    def _reply(self, header: bytes, response: Future[object]) -> None:
        try:
            data = bytes(to_cdr(to_ros_time(response.result())))
        except UwsimError as error:
            self._log.report(f"service /{self._name}: no answer: {error}", kind=self._name)
            return
        self.writer.write(data[:CDR_HEADER] + header + data[CDR_HEADER:])


def split_header(data: bytes) -> tuple[bytes, bytes]:
    """Return the 16 bytes of the header of a request, little-endian, and the request as CDR."""
    start = CDR_HEADER + CALL_HEADER.size
    header = data[CDR_HEADER:start]
    is_little = bool(data[1] & 1)
    if not is_little:
        header = CALL_HEADER.pack(*struct.unpack(">Qq", header))
    if len(header) < CALL_HEADER.size:
        raise BadMessage(f"{len(data)} bytes are not a call.")
    return header, data[:CDR_HEADER] + data[start:]
