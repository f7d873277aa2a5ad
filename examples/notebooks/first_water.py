# ---
# jupyter:
#   jupytext:
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # From first water to a scored run
#
# This notebook renders a scene, makes its water foggy, drives a vehicle, and scores a tracker.

# %%
import tempfile
from pathlib import Path

from IPython.display import display
from PIL import Image

import uwsim

# %% [markdown]
# ## First water
#
# A scene is a file or a bundled name. `image` renders the image of a camera, without noise.

# %%
simulation = uwsim.load("currents-scene", seed=1)
display(Image.fromarray(simulation.image("bowtech1").colour))

# %% [markdown]
# Fog reduces contrast with distance: after $d$ metres in fog of density $f$, the share
# $e^{-(f d)^2}$ of the light remains.

# %%
simulation.set_fog(0.3)
display(Image.fromarray(simulation.image("bowtech1").colour))
simulation.set_fog(0.0)

# %% [markdown]
# ## A command
#
# The vehicle receives twists on a topic; its autopilot holds depth and heading.

# %%
print(simulation.topics)
twist = uwsim.messages.TwistStamped()
twist.twist.linear = uwsim.messages.Vector3(x=0.2, y=0.0, z=0.0)
state = simulation.save()
for _ in range(20):
    simulation.publish("/dataNavigator", twist)
    simulation.advance(0.1)
print(simulation.time, simulation.pose("girona500").position, simulation.velocity("girona500")[:3])

# %% [markdown]
# A saved state is exact: the vehicle is at its earlier position.

# %%
simulation.restore(state)
print(simulation.time, simulation.pose("girona500").position)
simulation.close()

# %% [markdown]
# ## A scored run
#
# Two levels of fog of the benchmark `visibility`, tracked by ESM. The score is an error in pixels.

# %%
folder = Path(tempfile.mkdtemp()) / "visibility.result"
result = uwsim.bench(
    "visibility", algorithm="esm", levels={"fog": [0.0, 1.0]}, seeds=(1,), out=folder
)
for fog, total, status in zip(
    result.values("fog"), result.values("total"), result.values("status"), strict=True
):
    print(f"fog {fog} 1/m: {total:.2f} px, {status}")

# %% [markdown]
# The replay of the run: views, levels, and the curves of all measures.

# %%
uwsim.Replay(folder)
