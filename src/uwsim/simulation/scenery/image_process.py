"""Images of cameras drawn in a process of their own, so that a paced run does not wait for them.

At a sample of a camera what is seen of the state (`SEEN`) goes to the process through shared
memory; it puts that into a simulation of the same scene and draws there, with the camera's own
random numbers: the pixels are those that this process would have drawn, to the last bit. The image
is published when it is there, some steps later, stamped with the time of its sample. That depends
on the wall clock: for runs in real time only.
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

SEEN = ("engine", "scenery", "devices", "sensors", "vehicles")
"""What of a world's state images depend on."""
SPARE = 2**20
"""Room for a state that grows [bytes]."""
NICENESS = 5
"""How far the process stands back behind the simulation."""
READY = "ready"


class ImageProcess:
    """Draws the images of a simulation elsewhere; the process starts with the first image asked.

    Until it is ready, and if it ends, images are drawn in this process. A sample that is due while
    the last one is still being drawn is left out.

    Args:
        simulation: whose images they are.
        report: called with a line for the user.
    """

    def __init__(self, simulation: Simulation, report: Callable[[str], object]) -> None:
        self._simulation, self._report = simulation, report
        self._process: multiprocessing.process.BaseProcess | None = None
        self._pipe: Connection | None = None
        self._memory: SharedMemory | None = None
        self._slots: dict[str, tuple[int, int]] = {}  # topic -> offset, bytes
        self._room = 0
        self._is_ready = self._is_busy = False
        self._asked: list[tuple[str, float]] = []
        self._n_state = 0
        self.pid: int | None = None
        """Number of the process, once it is started."""
        self.n_left_out = 0
        """Samples left out so far."""
        for publisher in simulation.world.images.values():
            publisher.request_image = self._take
        simulation.watch(self.step)

    @property
    def is_ready(self) -> bool:
        """Whether images are drawn there now."""
        return self._is_ready

    @property
    def is_idle(self) -> bool:
        """Whether nothing is being drawn there or waits to be."""
        return not self._is_busy and not self._asked

    def step(self) -> None:
        """Publish what has been drawn, and send what is asked; at the end of a step."""
        pipe = self._pipe
        if pipe is None:
            return
        try:
            while pipe.poll():
                self._receive(pipe.recv())
            if self._asked and not self._is_busy:
                pipe.send((self._n_state, self._asked))
                self._is_busy, self._asked = True, []
        except (EOFError, OSError):
            self._report("the process that draws images has ended; they are drawn in this one")
            self.close()

    def close(self) -> None:
        """End the process; images are drawn in this one."""
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

    def _begin(self) -> None:
        self._room = len(self._seen()) + SPARE
        size = self._room
        for topic, publisher in self._simulation.world.images.items():
            pinhole = publisher.camera.intrinsics
            n_bytes = pinhole.width * pinhole.height * 3
            self._slots[topic] = size, n_bytes
            size += n_bytes
        self._memory = SharedMemory(create=True, size=size)
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        where = self._memory.name, self._slots
        self._process = context.Process(
            target=draw_images, args=(theirs, where, self._simulation.world.model), daemon=True
        )
        self._process.start()
        self.pid = self._process.pid
        theirs.close()

    def _seen(self) -> bytes:
        """What of the state is seen, as bytes."""
        return pack(copy_fields(self._simulation.state, SEEN))

    def _take(self, publisher: ImagePublisher, time: float) -> bool:
        """Have an image drawn; False: it has to be drawn here."""
        if self._process is None:
            self._begin()
        pinhole, slot = publisher.camera.intrinsics, self._slots[publisher.image_topic]
        if not self._is_ready or pinhole.width * pinhole.height * 3 > slot[1]:
            return False
        if self._is_busy:
            self.n_left_out += 1
            return True
        if not self._asked:
            state = self._seen()
            if len(state) > self._room:
                return False
            assert self._memory is not None
            assert self._memory.buf is not None
            self._memory.buf[: len(state)] = state
            self._n_state = len(state)
        self._asked.append((publisher.image_topic, time))
        return True

    def _receive(self, answer: Any) -> None:
        if answer == READY:
            self._is_ready = True
            return
        assert self._memory is not None
        for topic, time, shape in answer:
            if time > self._simulation.time:  # the simulation has begun again
                continue
            publisher = self._simulation.world.images[topic]
            offset = self._slots[topic][0]
            seen = np.ndarray(shape, np.uint8, self._memory.buf, offset)
            frame = publisher.camera.frame_id
            publisher.deliver(image(seen.copy(), time=time, frame_id=frame))
        self._is_busy = False


def draw_images(
    pipe: Connection,
    where: tuple[str, Mapping[str, tuple[int, int]]],
    model: SceneModel,
) -> None:
    """Draw what is asked for until the pipe is closed; what the process does."""
    from ..simulation import Simulation

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.nice(NICENESS)
    name, slots = where
    memory = SharedMemory(name)
    assert memory.buf is not None
    try:
        with Simulation(model) as simulation:
            _ = simulation.world.scenery.renderer_name  # its graphics context
            pipe.send(READY)
            while True:
                n_state, asked = pipe.recv()
                assign_fields(simulation.state, unpack(bytes(memory.buf[:n_state]), dict))
                simulation.world.scenery.redraw()
                done = []
                for topic, time in asked:
                    pixels = simulation.world.images[topic].camera.capture()
                    offset = slots[topic][0]
                    np.ndarray(pixels.shape, np.uint8, memory.buf, offset)[...] = pixels
                    done.append((topic, time, pixels.shape))
                pipe.send(done)
    except (EOFError, OSError):
        pass
    finally:
        memory.close()
