"""The inputs and outputs of a simulation for the program that owns it.

`topics` publishes and reads messages; `arguments` checks arguments; `boxes` computes the 3-D
bounding boxes of links and objects; `placing` places vehicles and objects; `image_views` takes
images for observers.
"""

from __future__ import annotations
