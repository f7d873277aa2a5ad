"""Services on DDS, as ROS 2 with Cyclone DDS calls them: 16 bytes before request and reply.

They hold the client's number and that of its request. Other vendors send them outside the sample,
where cyclonedds for Python does not show them: calls by nodes of Fast DDS arrive, and cannot be
answered. Such a call is reported, once for each service.
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
from ..stamps import to_ros_clock, to_simulation_time
from ..types import WireService, ros2_store
from .names import reply_name, request_name, type_hash_data
from .node import Call
from .participant import WRITERS_CHANGED, Participant
from .quality import Quality
from .raw_types import CDR_HEADER, RawSample, raw_type
from .senders import Senders

CALL = struct.Struct("<Qq")
"""Number of the client, number of its request."""
CALL_FIELDS = {"client": types.uint64, "sequence": types.int64}
CYCLONE = b"\x01\x10"
"""First two bytes of the identity of every endpoint of Cyclone DDS."""
VENDORS = {b"\x01\x0f": "Fast DDS", b"\x01\x01": "Connext", b"\x01\x03": "OpenDDS"}


class ServiceServer:
    """Answers the calls of one service.

    Args:
        participant: where it is offered.
        name: of the service, without a leading slash.
        kind: its type.
        call: hands a request to the simulation and returns the response to come.
        log: where calls that cannot be answered are reported.
    """

    def __init__(
        self, participant: Participant, name: str, kind: WireService, call: Call, log: Log
    ) -> None:
        self._participant, self._name, self._kind = participant, name, kind
        self._call, self._log, self._senders = call, log, Senders()
        hash_data = type_hash_data(kind.type_hash)
        store, reliable = ros2_store(), Quality()
        self.writer = participant.writer(
            reply_name(name),
            raw_type(store, kind.response.ros2_name, before=CALL_FIELDS),
            reliable,
            user_data=hash_data,
        )
        self.reader = participant.reader(
            request_name(name),
            raw_type(store, kind.request.ros2_name, before=CALL_FIELDS),
            reliable,
            self._receive,
            user_data=hash_data,
            events={WRITERS_CHANGED: self._look_at_clients},
        )

    def close(self) -> None:
        """Offer it no more."""
        self._participant.forget(self.reader)
        self._participant.forget(self.writer.entity)

    def _look_at_clients(self, reader: Any) -> None:
        """Report clients that cannot be answered."""
        for handle in reader.get_matched_publications():
            found = reader.get_matched_publication_data(handle)
            vendor = CYCLONE if found is None else bytes(found.key.bytes[:2])
            if vendor != CYCLONE:
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
            call, body = split_call(sample.data)
            request: object = to_simulation_time(from_cdr(self._kind.service.request, body))
        except (BadMessage, struct.error) as error:
            self._log.report(f"service /{self._name}: a call was refused: {error}", kind=self._name)
            return
        sender = self._senders.sender_of(self.reader, sample)
        self._call(request, sender).add_done_callback(partial(self._reply, call))

    def _is_of_cyclone(self, sample: RawSample) -> bool:
        handle = sample.sample_info.publication_handle
        found = self.reader.get_matched_publication_data(handle)
        return found is not None and bytes(found.key.bytes[:2]) == CYCLONE

    def _reply(self, call: bytes, response: Future[object]) -> None:
        try:
            data = bytes(to_cdr(to_ros_clock(response.result())))
        except UwsimError as error:
            self._log.report(f"service /{self._name}: no answer: {error}", kind=self._name)
            return
        self.writer.write(data[:CDR_HEADER] + call + data[CDR_HEADER:])


def split_call(data: bytes) -> tuple[bytes, bytes]:
    """Return the 16 bytes of the call, little-endian, and the request as CDR."""
    start = CDR_HEADER + CALL.size
    call = data[CDR_HEADER:start]
    is_little = bool(data[1] & 1)
    if not is_little:
        call = CALL.pack(*struct.unpack(">Qq", call))
    if len(call) < CALL.size:
        raise BadMessage(f"{len(data)} bytes are no call.")
    return call, data[:CDR_HEADER] + data[start:]
