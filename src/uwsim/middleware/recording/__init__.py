"""Recording and playback of the messages on a bus, and measurement of the rates of its topics.

.. code-block:: python

    with uwsim.load("cirs") as simulation, Recorder(simulation.bus, Path("run.mcap")) as recorder:
        recorder.start(lambda: simulation.time)
        simulation.advance(10.0)
"""

from __future__ import annotations

from .bag_reader import BagReader
from .player import Player
from .recorder import ImageStorage, Recorder, check_path, image_storage
from .topic_rates import TopicRate, TopicRates

__all__ = [
    "BagReader",
    "ImageStorage",
    "Player",
    "Recorder",
    "TopicRate",
    "TopicRates",
    "check_path",
    "image_storage",
]
