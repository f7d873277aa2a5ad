"""The inputs and outputs of a simulation for the program that owns it.

`topics` publishes and reads messages; `arguments` checks what is passed; `boxes` has the boxes in
3-D of links and objects; `placing` places vehicles and objects.
"""

from __future__ import annotations
