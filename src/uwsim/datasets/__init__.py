"""Data sets of labelled images of a scene, and their formats.

.. code-block:: python

    from uwsim.datasets import DatasetRequest, make_dataset

    make_dataset(DatasetRequest(scene="shipwreck-scene", n_images=1000, out=Path("wreck")))

An image is one view of one scene. *Scene draws* are scenes in which the variations (``<u:vary>``)
have the values of a seed of their own; several images share one, because compiling a scene takes
longer than rendering it. Everything about image i depends on the seed of the data set and on i
alone, so that workers, interruptions and a greater number of images change no bytes.
"""

from __future__ import annotations

from .make_dataset import Dataset, make_dataset
from .request import DatasetRequest, Range

__all__ = ["Dataset", "DatasetRequest", "Range", "make_dataset"]
