"""``uwsim kubernetes``: print the jobs that run a benchmark or suite on a Kubernetes cluster."""

from __future__ import annotations

from typing import Annotated

from ...campaigns.kubernetes import KubernetesJob, read_mount
from ..options.help_texts import RUN, option
from .cluster_options import ClusterOptions


def kubernetes(
    options: ClusterOptions,
    image: Annotated[
        str,
        option(RUN, "--image", metavar="NAME", help="The image, of `uwsim container oci`."),
    ],
    volume_claim: Annotated[
        str,
        option(
            RUN,
            "--volume-claim",
            metavar="NAME",
            help="The claim of the volume for --out, which many nodes can write.",
        ),
    ],
    mount: Annotated[
        str,
        option(
            RUN,
            "--mount",
            metavar="DIR",
            help="Where the volume is mounted; tasks run in this folder, and --out is below it.",
        ),
    ] = "/campaign",
) -> None:
    """Print jobs that run a benchmark or suite on Kubernetes.

    The YAML for `kubectl apply -f` has an indexed job, with an index for each shard
    (`--shard`), and a suspended job that merges them. Its first lines tell how to start the merge.
    """
    job = KubernetesJob(
        run=options.cluster_run(read_mount(mount)), image=image, volume_claim=volume_claim
    )
    print(job.manifest(), end="")
