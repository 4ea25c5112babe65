"""Ensembles on many processes or machines, from files of states to files of states.

    import coadjoint as ca

    body = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z")
    result = ca.cluster.run(body, states="states.parquet", out="final/", time=100, step=0.1, client=client)

``client`` is a Dask client, the module ``ray``, or nothing for this process and its threads. The rows are cut into
shards; one function makes a shard, whatever runs it; finished shards are kept and the bytes are always the same.
"""

import importlib.util

for _needed in ("fsspec", "pyarrow"):
    if importlib.util.find_spec(_needed) is None:
        raise ImportError(f'coadjoint.cluster needs {_needed}: pip install "coadjoint[cluster]"', name=_needed)

from .errors import ClusterError, InputError, ManifestError, ShardError, WorkerDied
from .launch import run
from .result import Result, bad_rows, check

__all__ = [
    "ClusterError",
    "InputError",
    "ManifestError",
    "Result",
    "ShardError",
    "WorkerDied",
    "bad_rows",
    "check",
    "run",
]
