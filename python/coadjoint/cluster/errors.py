"""The exceptions of runs over many shards; options that make no sense are ``coadjoint.InputError``."""

from __future__ import annotations

from ..errors import InputError, RunError


class ClusterError(RunError):
    """A run over many shards cannot go on; the message says what to do."""


class ManifestError(ClusterError):
    """The folder holds another run than the one that is asked for."""


class ShardError(ClusterError):
    """A shard cannot be made, whatever worker tries."""


class WorkerDied(ClusterError):
    """A worker ended before its shard did; another one may succeed."""


__all__ = ["ClusterError", "InputError", "ManifestError", "ShardError", "WorkerDied"]
