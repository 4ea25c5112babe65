"""``python -m coadjoint.cluster``: checks and joins what runs have left."""

from __future__ import annotations

import argparse
import json
import sys

from . import ClusterError, check, join


def main(arguments: list[str] | None = None) -> int:
    """Returns the exit code: 0, or 1 with a message where something is missing or not as it was written."""
    parser = argparse.ArgumentParser(prog="python -m coadjoint.cluster", description=__doc__)
    actions = parser.add_subparsers(dest="action", required=True)
    one = actions.add_parser("check", help="compare a folder of coadjoint.cluster.run with its records")
    one.add_argument("folder")
    two = actions.add_parser("join", help="check such a folder and write its parts into one Parquet file")
    two.add_argument("folder")
    two.add_argument("file")
    given = parser.parse_args(arguments)
    try:
        if given.action == "check":
            print(json.dumps(check(given.folder)))
        else:
            print(f"{given.file}: {join(given.folder, given.file)} rows")
    except (ClusterError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
