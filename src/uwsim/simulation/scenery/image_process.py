"""Camera images that a separate process renders, so that a run in real time does not wait for them.

When an image of a camera is due, the state on which images depend (`STATE_FIELDS`) is sent to the
render process through shared memory. That process restores the state in a simulation of the same
scene and renders there, with the camera's own random numbers: the pixels are equal, to the last
bit, to those that the simulation would render.
The image is published when it is received, some steps later, stamped with the time at which it was
due. The delay depends on the wall clock, so this is for runs in real time only.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Callable, Mapping
from multiprocessing.connection import Connection
from multiprocessing.shared_memory import SharedMemory
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base.record import assign_fields, copy_fields
from ...messages import image
from ...model.scene_model import SceneModel
from ...topics.virtual_camera_to_ros_image import ImagePublisher
from ..state.saved_bytes import pack, unpack

if TYPE_CHECKING:
    from ..simulation import Simulation

STATE_FIELDS = ("engine", "scenery", "devices", "sensors", "vehicles", "water")
"""The fields of `State` on which images depend."""
SPARE_BYTES = 2**20
"""The spare memory for a state that grows [bytes]."""
NICENESS = 5
"""The increment of the render process's nice value, which gives the simulation priority."""
READY_MESSAGE = "ready"
"""The message with which the render process reports that it can receive requests."""


class ImageProcess:
    """A process that renders the images of a simulation; it starts with the first request.

    The simulation renders an image itself until the process is ready and after its end, and if
    image or state have grown beyond the shared memory. Images that are due while earlier requests
    are being rendered are left out.

    Args:
        simulation: the simulation whose images are rendered.
        report: a function that prints a line for the user.
    """

    def __init__(self, simulation: Simulation, report: Callable[[str], object]) -> None:
        self._simulation, self._report = simulation, report
        self._process: multiprocessing.process.BaseProcess | None = None
        self._pipe: Connection | None = None
        self._memory: SharedMemory | None = None
        self._slots: dict[str, tuple[int, int]] = {}  # topic -> offset, bytes
        self._capacity = 0  # the greatest size of a state in the shared memory [bytes]
        self._is_ready = self._is_busy = False
        self._requests: list[tuple[str, float]] = []
        self._state_size = 0  # the size of the state in the shared memory [bytes]
        self.pid: int | None = None
        """The id of the render process; None before it is started."""
        self.n_left_out = 0
        """The number of images left out so far."""
        for publisher in simulation.world.images.values():
            publisher.request_image = self._request
        simulation.watch(self.step)

    @property
    def is_ready(self) -> bool:
        """True if the render process can receive requests."""
        return self._is_ready

    @property
    def is_idle(self) -> bool:
        """True if the render process has no request, and none is pending."""
        return not self._is_busy and not self._requests

    def step(self) -> None:
        """Publish the finished images and send the pending requests; called after each step."""
        pipe = self._pipe
        if pipe is None:
            return
        try:
            while pipe.poll():
                self._receive(pipe.recv())
            if self._requests and not self._is_busy:
                pipe.send((self._state_size, self._requests))
                self._is_busy, self._requests = True, []
        except (EOFError, OSError):
            self._report("the process that draws images has ended; they are drawn in this one")
            self.close()

    def close(self) -> None:
        """End the render process; the simulation renders further images itself."""
        for publisher in self._simulation.world.images.values():
            publisher.request_image = None
        self._is_ready = False
        if self._pipe is not None:
            self._pipe.close()
            self._pipe = None
        if self._process is not None:
            self._process.terminate()
            self._process.join()
            self._process = None
        if self._memory is not None:
            self._memory.close()
            self._memory.unlink()
            self._memory = None

    def _start_process(self) -> None:
        self._capacity = len(self._pack_state()) + SPARE_BYTES
        size = self._capacity
        for topic, publisher in self._simulation.world.images.items():
            n_bytes = _count_bytes(publisher)
            self._slots[topic] = size, n_bytes
            size += n_bytes
        self._memory = SharedMemory(create=True, size=size)
        context = multiprocessing.get_context("spawn")
        self._pipe, child_pipe = context.Pipe()
        memory_layout = self._memory.name, self._slots
        self._process = context.Process(
            target=draw_images,
            args=(child_pipe, memory_layout, self._simulation.world.model),
            daemon=True,
        )
        self._process.start()
        self.pid = self._process.pid
        child_pipe.close()

    def _pack_state(self) -> bytes:
        return pack(copy_fields(self._simulation.state, STATE_FIELDS))

    def _request(self, publisher: ImagePublisher, time: float) -> bool:
        """Request an image; return False if the simulation has to render the image itself."""
        if self._process is None:
            self._start_process()
        slot = self._slots[publisher.image_topic]
        if not self._is_ready or _count_bytes(publisher) > slot[1]:
            return False
        if self._is_busy:
            self.n_left_out += 1
            return True
        if not self._requests:
            state = self._pack_state()
            if len(state) > self._capacity:
                return False
            assert self._memory is not None
            assert self._memory.buf is not None
            self._memory.buf[: len(state)] = state
            self._state_size = len(state)
        self._requests.append((publisher.image_topic, time))
        return True

    def _receive(self, answer: Any) -> None:
        if answer == READY_MESSAGE:
            self._is_ready = True
            return
        assert self._memory is not None
        for topic, time, shape in answer:
            if time > self._simulation.time:  # the simulation was reset
                continue
            publisher = self._simulation.world.images[topic]
            offset = self._slots[topic][0]
            pixels = np.ndarray(shape, publisher.camera.pixel_type, self._memory.buf, offset)
            frame = publisher.camera.frame_id
            publisher.deliver(image(pixels.copy(), time=time, frame_id=frame))
        self._is_busy = False


def _count_bytes(publisher: ImagePublisher) -> int:
    """Return the size of the images of a publisher [bytes]."""
    pinhole = publisher.camera.intrinsics
    return 3 * pinhole.width * pinhole.height * np.dtype(publisher.camera.pixel_type).itemsize


def draw_images(
    pipe: Connection,
    memory_layout: tuple[str, Mapping[str, tuple[int, int]]],
    model: SceneModel,
) -> None:
    """Render requested images until the pipe closes; the main function of the render process."""
    from ..simulation import Simulation

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.nice(NICENESS)
    name, slots = memory_layout
    memory = SharedMemory(name)
    assert memory.buf is not None
    try:
        with Simulation(model) as simulation:
            _ = simulation.world.scenery.renderer_name  # makes the graphics context
            pipe.send(READY_MESSAGE)
            while True:
                state_size, requests = pipe.recv()
                assign_fields(simulation.state, unpack(bytes(memory.buf[:state_size]), dict))
                simulation.world.scenery.redraw()
                simulation.state.bus.step = round(requests[0][1] / simulation.timestep)
                images = []
                for topic, time in requests:
                    pixels = simulation.world.images[topic].camera.capture()
                    offset = slots[topic][0]
                    np.ndarray(pixels.shape, pixels.dtype, memory.buf, offset)[...] = pixels
                    images.append((topic, time, pixels.shape))
                pipe.send(images)
    except (EOFError, OSError):
        pass
    finally:
        memory.close()
