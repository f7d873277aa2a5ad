"""A policy in an ONNX file as an algorithm: ``uwsim bench`` scores it, on the CPU.

    pip install onnxruntime
    uwsim bench station-keeping --algorithm examples/learning/onnx_policy.py:Policy

`Policy` reads the file ``policy.onnx`` of the current folder: a network with one input, the
observations (n, o) in single precision, and the actions (n, a) as its first output. With torch,
``torch.onnx.export(network, observations, "policy.onnx", dynamo=False)`` writes such a file.
Without torch,
``python examples/learning/onnx_policy.py policy.npz`` writes that of a policy of `ppo.py`, with
the package onnx.
"""

import sys

import numpy as np


class Policy:
    """The action for an observation, by onnxruntime with one thread."""

    def __init__(self, path="policy.onnx"):
        import onnxruntime

        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = options.inter_op_num_threads = 1  # the same bytes each time
        self.session = onnxruntime.InferenceSession(
            path, options, providers=["CPUExecutionProvider"]
        )
        self.input = self.session.get_inputs()[0].name

    def __call__(self, observation):
        """Return the action for an observation."""
        batch = np.asarray(observation, dtype=np.float32)[None]
        action = self.session.run(None, {self.input: batch})[0][0]
        return np.clip(action, -1.0, 1.0)


def convert(source, target):
    """Write the policy of an ``.npz`` file of `ppo.py` as an ONNX file."""
    from onnx import TensorProto, checker, helper, numpy_helper, save_model

    with np.load(source) as file:
        arrays = {name: file[name].astype(np.float32) for name in file.files}
    n_layers = len([name for name in arrays if name.startswith("weight")])
    n, n_actions = len(arrays["mean"]), len(arrays[f"bias{n_layers - 1}"])
    arrays |= {"low": np.float32(-10.0), "high": np.float32(10.0)}
    nodes = [
        helper.make_node("Sub", ["observation", "mean"], ["offset"]),
        helper.make_node("Div", ["offset", "deviation"], ["scaled"]),
        helper.make_node("Clip", ["scaled", "low", "high"], ["x0"]),
    ]
    for i in range(n_layers):
        output = "action" if i == n_layers - 1 else f"y{i}"
        nodes.append(helper.make_node("Gemm", [f"x{i}", f"weight{i}", f"bias{i}"], [output]))
        if i < n_layers - 1:
            nodes.append(helper.make_node("Tanh", [output], [f"x{i + 1}"]))
    graph = helper.make_graph(
        nodes,
        "policy",
        [helper.make_tensor_value_info("observation", TensorProto.FLOAT, ["n", n])],
        [helper.make_tensor_value_info("action", TensorProto.FLOAT, ["n", n_actions])],
        [numpy_helper.from_array(array, name) for name, array in arrays.items()],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=8)
    checker.check_model(model)
    save_model(model, target)


if __name__ == "__main__":
    convert(sys.argv[1], "policy.onnx")
