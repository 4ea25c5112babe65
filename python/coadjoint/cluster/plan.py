"""Which rows belong to which shard."""

from __future__ import annotations

from dataclasses import dataclass

from .._arrays import count
from .errors import InputError

#: Numbers that a worker holds of one group of rows: 4 MiB of doubles.
_NUMBERS = 1 << 19
#: Steps of all rows of a shard together, where its rows are not given: seconds, not minutes.
_STEPS = 200_000_000
#: Their names have five digits, and folders with more files are slow.
_MOST = 100_000


@dataclass(frozen=True)
class Plan:
    """Consecutive shards of equal size, the last one shorter. It depends on nothing but the run itself."""

    rows: int
    rows_per_shard: int

    @property
    def shards(self) -> int:
        """How many shards there are; without rows there is one, which is empty."""
        return max(1, -(-self.rows // self.rows_per_shard))

    def rows_of(self, shard: int) -> tuple[int, int]:
        """The first row of a shard and the row behind its last, counted from 0."""
        start = shard * self.rows_per_shard
        return start, min(start + self.rows_per_shard, self.rows)

    def share(self, *share: int) -> range:
        """The shards of the share ``index`` of ``count``, from 1: consecutive, and together everything."""
        index, count = share if len(share) == 2 and all(isinstance(part, int) for part in share) else (0, 0)
        if not 1 <= index <= count:
            said = " of ".join(map(repr, share))
            raise InputError(f"there is no share {said}: shares are counted from 1, as in (1, 8)")
        return range(self.shards * (index - 1) // count, self.shards * index // count)


def plan(rows: int, steps: int, rows_per_shard: int | None = None) -> Plan:
    """The plan of a run. Without ``rows_per_shard`` a power of two between 256 and 2^20 by the number of steps, and as
    many as it takes for 100 000 shards."""
    least = -(-rows // _MOST)
    if rows_per_shard is None:
        rows_per_shard = 1 << min(max((_STEPS // max(steps, 1)).bit_length() - 1, 8), 20)
        while rows_per_shard < least:
            rows_per_shard *= 2
    rows_per_shard = count(rows_per_shard, "rows_per_shard", 1)
    if rows_per_shard < least:
        raise InputError(
            f"rows_per_shard = {rows_per_shard}: {rows} rows would be more than {_MOST} shards; give {least} at least"
        )
    return Plan(rows, rows_per_shard)


def group_rows(width: int) -> int:
    """Rows that are advanced and written together, by the number of columns alone."""
    return min(max(_NUMBERS // max(width, 1), 256), 1 << 17)
