"""The jobs that run a campaign on Kubernetes: an indexed job, and one that merges.

The merge is suspended, because a Job cannot wait for another: `START_MERGE` starts it. The fields
are those of the Job API batch/v1 of Kubernetes 1.29 (``backoffLimitPerIndex`` is on by default).
"""

from __future__ import annotations

import io
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML

from ..errors import BadSetting
from .cluster_run import THREAD_VARIABLES, ClusterRun

MAX_TASKS = 100_000
"""The greatest number of indices of a job with limits for each index and free parallelism."""
RETRIES = 6
"""The number of times that a task is repeated after a failure."""
INDEX = "$((JOB_COMPLETION_INDEX + 1))"
"""The shell expression for the number of a shard."""
START_MERGE = (
    "kubectl wait --for=condition=complete --timeout=-1s job/{name} && "
    'kubectl patch job/{name}-merge --patch \'{{"spec": {{"suspend": false}}}}\''
)
"""The command that waits for the tasks, and starts the merge."""


@dataclass(frozen=True, kw_only=True)
class KubernetesJob:
    """A campaign on Kubernetes."""

    run: ClusterRun
    """The campaign, whose folder is where the volume is mounted."""
    image: str
    """The name of the image with uwsim."""
    volume_claim: str
    """The claim of the volume with the result directory, which many nodes can write."""

    def __post_init__(self) -> None:
        """Check the names and the number of tasks; raise BadSetting."""
        if self.run.n_tasks > MAX_TASKS:
            raise BadSetting(
                f"--tasks {self.run.n_tasks}: expected at most {MAX_TASKS} indices of a job."
            )
        if not self.run.out.is_relative_to(self.run.folder) or self.run.out == self.run.folder:
            raise BadSetting(
                f"--out {self.run.out}: expected a path below {self.run.folder}, where the volume "
                "is mounted (--mount)."
            )
        if not re.fullmatch(r"[a-z0-9]([a-z0-9.-]{0,251}[a-z0-9])?", self.volume_claim):
            raise BadSetting(
                f"--volume-claim {self.volume_claim}: expected lower case letters, digits, - and ."
            )
        if not re.fullmatch(r"\S+", self.image):
            raise BadSetting(f"--image {self.image!r}: expected a name without spaces.")

    def manifest(self) -> str:
        """Return the YAML of both jobs."""
        run = self.run
        tasks = {
            "completionMode": "Indexed",
            "completions": run.n_tasks,
            "parallelism": run.n_parallel or run.n_tasks,
            "backoffLimitPerIndex": RETRIES,
            "podFailurePolicy": {
                "rules": [
                    {"action": "Ignore", "onPodConditions": [{"type": "DisruptionTarget"}]},
                    {"action": "FailJob", "onExitCodes": {"operator": "In", "values": [2]}},
                    {"action": "FailIndex", "onExitCodes": {"operator": "In", "values": [3]}},
                ]
            },
        }
        merge = {"suspend": True, "backoffLimit": RETRIES}
        documents = [
            self._job(run.name, tasks, f"exec {run.shard_command(INDEX)}"),
            self._job(f"{run.name}-merge", merge, f"exec {run.merge_command()}"),
        ]
        stream = io.StringIO()
        yaml = YAML()
        yaml.width = 4096
        yaml.dump_all(documents, stream)
        return "\n".join(
            [
                f"# {run.description}",
                f"# in {run.n_tasks} tasks of Kubernetes. Submit with: kubectl apply -f FILE",
                f"# Then merge: {START_MERGE.format(name=run.name)}",
                stream.getvalue(),
            ]
        )

    def _job(self, name: str, spec: dict[str, Any], command: str) -> dict[str, Any]:
        """Return a Job with one container that runs a shell command."""
        run = self.run
        resources = {"cpu": str(run.n_processors), "memory": f"{run.memory}i"}
        container = {
            "name": "uwsim",
            "image": self.image,
            "command": ["/bin/sh", "-c", command.replace("$", "$$")],  # $$ is a $ of the shell
            "workingDir": str(run.folder),
            "env": [{"name": name, "value": str(value)} for name, value in THREAD_VARIABLES],
            "resources": {"requests": dict(resources), "limits": dict(resources)},
            "volumeMounts": [{"name": "shared", "mountPath": str(run.folder)}],
        }
        pod = {
            "restartPolicy": "Never",
            "containers": [container],
            "volumes": [
                {"name": "shared", "persistentVolumeClaim": {"claimName": self.volume_claim}}
            ],
        }
        return {
            "apiVersion": "batch/v1",
            "kind": "Job",
            "metadata": {"name": name},
            "spec": {**spec, "template": {"spec": pod}},
        }


def read_mount(text: str) -> Path:
    """Return the folder in which a volume is mounted; raise BadSetting unless it is absolute."""
    path = Path(text)
    if not path.is_absolute() or ":" in text or path == Path("/"):
        raise BadSetting(f"--mount {text}: expected an absolute path without a colon.")
    return path
