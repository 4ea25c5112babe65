"""What can go wrong in a run over many machines."""


class ClusterError(RuntimeError):
    """A run over many shards cannot go on; the message says what to do."""


class ManifestError(ClusterError):
    """The folder holds another run than the one that is asked for."""


class InputError(ClusterError, ValueError):
    """The states cannot be read, or an option makes no sense."""


class ShardError(ClusterError):
    """A shard cannot be made, whatever worker tries."""


class WorkerDied(ClusterError):
    """A worker ended before its shard did; another one may succeed."""
