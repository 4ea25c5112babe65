"""``python -m coadjoint.cluster``: checks and joins what runs have left."""

from __future__ import annotations

import argparse
import json
import sys

from . import ClusterError, check, join, join_shards


def main(arguments: list[str] | None = None) -> int:
    """Returns the exit code: 0, or 1 with a message where something is missing or not as it was written."""
    parser = argparse.ArgumentParser(prog="python -m coadjoint.cluster", description=__doc__)
    actions = parser.add_subparsers(dest="action", required=True)
    one = actions.add_parser("check", help="compare a folder of coadjoint.cluster.run with its records")
    one.add_argument("folder")
    two = actions.add_parser("join", help="check such a folder and write its parts into one Parquet file")
    two.add_argument("folder")
    two.add_argument("file")
    three = actions.add_parser("join-shards", help="check and join the files of coadjoint ensemble --shard --keep")
    three.add_argument("file")
    three.add_argument("shards", nargs="+")
    given = parser.parse_args(arguments)
    try:
        if given.action == "check":
            print(json.dumps(check(given.folder)))
        elif given.action == "join":
            print(f"{given.file}: {join(given.folder, given.file)} rows")
        else:
            joined = join_shards(given.shards, given.file)
            print(f"{given.file}: {joined['rows']} rows, {joined['rejected']} of them rejected")
    except (ClusterError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
