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
# # Train a policy, score it, watch it
#
# A BlueROV2 Heavy has to stay at its place in a current. You write a policy by hand, train a better
# one, and score both in the benchmark that scores every other algorithm. No GPU is needed.
# The notebook takes about three minutes on two cores.
#
# In a checkout, after `make install`:
#
# ```console
# $ scripts/setup envs
# $ pip install jupyterlab jupytext
# $ jupytext --to ipynb examples/notebooks/train_a_policy.py
# $ jupyter lab examples/notebooks/train_a_policy.ipynb
# ```
#
# The training is in `examples/learning`, beside this folder.

# %%
import json
import sys
import tempfile
from pathlib import Path

import gymnasium
import matplotlib.pyplot as plt
import numpy as np
from IPython.display import display
from PIL import Image

import uwsim
import uwsim.envs
from uwsim.datasets import DatasetRequest, Range, make_dataset

sys.path.append("../learning")
import ppo
from policy import Policy

STEPS, SEEDS, N_IMAGES = 500_000, range(6), 50
FOLDER = Path(tempfile.mkdtemp())  # choose a folder of your own to keep what you make
TASK = "uwsim/StationKeeping-v0"

# %% [markdown]
# ## The environment
#
# It is an environment of Gymnasium. `layout` names the parts of an observation. All vectors are in
# the axes of the vehicle: x ahead, y to starboard, z down. An action is a command from -1 to 1 for
# each of eight thrusters, every 0.05 s. An episode lasts 30 s. `camera` may also be a camera of the
# vehicle; `render_mode="human"` opens a page in the browser.

# %%
env = gymnasium.make(TASK, render_mode="rgb_array", camera="chase", frame_size=(480, 360))
observation, info = env.reset(seed=1, options={"level": {"current": 0.2}})
print(env.action_space, *env.unwrapped.layout, info["level"], sep="\n")
display(Image.fromarray(env.render()))

# %% [markdown]
# The reward is `exp(-3*offset)`, where `offset` is the distance from the place [m], less a little
# for effort and turning. The best return is close to 600, the number of steps. At the end, `info`
# has the measures of the benchmark.


# %%
def play(policy, current=0.2):
    """Return the distance from the place at each step, and the last ``info``."""
    observation, info = env.reset(seed=1, options={"level": {"current": current}})
    distances, is_over = [], False
    while not is_over:
        distances.append(np.linalg.norm(observation[:3]))
        observation, _, terminated, truncated, info = env.step(policy(observation))
        is_over = terminated or truncated
    return distances, info


env.action_space.seed(1)
_, info = play(lambda observation: env.action_space.sample())
print(info["measures"], "success:", info["is_success"])

# %% [markdown]
# ## A policy by hand
#
# What does a thruster do? Command one at a time, and look at the velocities after 0.25 s. The
# inverse of this matrix turns desired accelerations into commands.


# %%
def response(thruster):
    """Return the acceleration by one thruster at full command, (6,) [m/s2, rad/s2]."""
    first_observation, _ = env.reset(seed=1, options={"level": {"current": 0.0}})
    for _ in range(5):
        observation, *_ = env.step(0.5 * np.eye(8)[thruster])
    return (observation[8:14] - first_observation[8:14]) / 0.25 / 0.5


allocation = np.linalg.pinv(np.stack([response(thruster) for thruster in range(8)], axis=1))
print(np.round(allocation, 3))


# %%
class LinearPolicy:
    """A policy, which is a class with ``__call__``: distance and damping, by hand."""

    def __call__(self, observation):
        """Return the commands of the thrusters for an observation."""
        error, velocity, turn_rate = observation[:3], observation[8:11], observation[11:14]
        acceleration = np.concatenate([2.0 * error - 2.0 * velocity, -turn_rate])
        return np.tanh(allocation @ acceleration)


distances_by_hand, info = play(LinearPolicy())
print(info["measures"], "success:", info["is_success"])

# %% [markdown]
# The current pushes this policy away from its place. Nothing in it knows the current.
#
# ## Training
#
# `ppo.py` is proximal policy optimisation in one file of NumPy. It trains on 256 vehicles at once:
# `gymnasium.make_vec(TASK, num_envs=256, stepper="rows")` steps them in compiled code.

# %%
lines = ppo.train(
    TASK,
    steps=STEPS,
    rows=256,
    length=16,
    seed=1,
    rate=3e-3,
    current=0.2,
    out=FOLDER / "policy.npz",
)

# %%
steps, _, errors = np.array([line.split(",") for line in lines[1:]], float).T
figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(steps, errors, marker=".")
axes.set(xlabel="steps", ylabel="rms distance [m]", ylim=(0, None))
display(figure)
plt.close(figure)


# %% [markdown]
# The distance is that of 16 episodes in a current of 0.2 m/s. It includes the way to the place.


# %%
class TrainedPolicy(Policy):
    """The policy that was trained."""

    def __init__(self):
        super().__init__(FOLDER / "policy.npz")


distances, info = play(TrainedPolicy())
print(info["measures"], "success:", info["is_success"])
figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(0.05 * np.arange(len(distances)), distances, label="trained")
axes.plot(0.05 * np.arange(len(distances_by_hand)), distances_by_hand, label="by hand")
axes.set(xlabel="time [s]", ylabel="distance [m]", ylim=(0, None))
axes.legend()
display(figure)
plt.close(figure)
env.close()

# %% [markdown]
# ## Scores
#
# A policy is an algorithm of the benchmark `station-keeping`. `position-p` is a proportional
# controller that comes with uwsim; `uwsim list algorithms` has all of them. Every algorithm gets
# the same seeds: the same starts, and the same swings of the current.

# %%
for name, algorithm in (("hand", LinearPolicy), ("trained", TrainedPolicy), ("p", "position-p")):
    result = uwsim.bench(
        "station-keeping",
        algorithm=algorithm,
        levels={"current": [0.2]},
        seeds=SEEDS,
        out=FOLDER / f"{name}.result",
    )
    print(f"{name:8} {np.mean(result.values('offset')):.3f} m")

# %% [markdown]
# Is the trained policy better, or lucky? `compare` pairs the seeds, and states an interval.

# %%
print(uwsim.compare(FOLDER / "trained.result", FOLDER / "p.result"))

# %% [markdown]
# The same on the command line:
#
# ```console
# $ cd examples/learning
# $ python ppo.py uwsim/StationKeeping-v0    # writes policy.npz, which policy.py:Policy reads
# $ uwsim bench station-keeping --algorithm policy.py:Policy --repeat 10 --out trained.result
# $ uwsim bench station-keeping --algorithm position-p --repeat 10 --out p.result
# $ uwsim compare trained.result p.result
# ```
#
# ## Watch it
#
# A result contains the motion. Drag to turn the view, and press play.

# %%
uwsim.Replay(FOLDER / "trained.result")

# %% [markdown]
# ```console
# $ uwsim replay trained.result --trial 0 --until 10 -o policy.webp    # a film
# $ uwsim bench station-keeping --algorithm policy.py:Policy --view --speed 1
# ```
#
# The second one prints an address: open it, and the policy runs in real time.
#
# ## Your own environment
#
# A task is a benchmark: a scene, measures, conditions. Take one, move its place, and choose other
# observations and actions. These actions are velocities, which the vehicle's autopilot keeps.

# %%
benchmark = uwsim.read_benchmark("station-keeping")
benchmark["offset"].position = (1.5, -0.5, 1.2)  # [m], z down
own_env = uwsim.make_env(
    benchmark,
    observation=["positionError", "/bluerov2/odom:twist.twist"],
    action=["/bluerov2/twist:vx=0.5,vy=0.5,vz=0.3,wz=0.5"],
    reward="exp(-offset) - 0.1*change",
    success="offset < 0.6",
)
observation, info = own_env.reset(seed=1, options={"level": {"current": 0.1}})
total, is_over = 0.0, False
while not is_over:
    action = np.clip([*observation[:3], 0.0], -1.0, 1.0)
    observation, reward, terminated, truncated, info = own_env.step(action)
    total, is_over = total + reward, terminated or truncated
print(f"return {total:.1f}", info["measures"], "success:", info["is_success"])
own_env.close()

# %% [markdown]
# ## Images with labels
#
# A detector learns from labelled images. Here the camera is around a flight recorder, and the fog
# is drawn for each image. `uwsim dataset visibility-scene -n 10000 -o boxes` is the command.

# %%
request = DatasetRequest(
    scene="visibility-scene",
    out=FOLDER / "boxes",
    n_images=N_IMAGES,
    size=(160, 120),
    targets=("blackbox",),
    fog=Range(0.0, 0.4),
    formats=("plain", "coco", "yolo"),
)
make_dataset(request)
display(Image.open(request.out / "contact-sheet.png").reduce(2))

# %% [markdown]
# From the top: images, boxes, instances, depth. Each line of `labels.jsonl` has the
# labels of an image. A box is left, top, right, bottom [px]; its visibility is the part of it that
# nothing else hides.

# %%
record = json.loads((request.out / "labels.jsonl").read_text().splitlines()[0])
print("files:", *record["files"].values())
print("fog:", record["water"]["fog"], "1/m")
for instance in record["instances"]:
    print(instance["name"], instance["box"], f"visible: {instance['visibility']:.2f}")

# %% [markdown]
# ## What next
#
# - The page *Learning environments* has all tasks, observations and options, and the scores of
#   controllers, PPO, CEM and MPC.
# - The page *Data sets* has the labels and formats, and an example that trains a detector.
# - *Several vehicles and other libraries* is about PettingZoo, PyTorch and Stable-Baselines3.
# - *Scenes and benchmarks from Python* is about your own vehicle, scene and task.
