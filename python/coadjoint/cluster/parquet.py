"""Parts as Parquet, in the one way whose bytes depend on the rows and on pyarrow's version alone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from .._arrays import Floats


def table(columns: Sequence[str], numbers: Floats, kept: pa.Table | None) -> pa.Table:
    """Rows of numbers, and the columns that go through beside them."""
    fields = [pa.field(name, pa.float64(), nullable=False) for name in columns]
    arrays = [pa.array(np.ascontiguousarray(numbers[:, place])) for place in range(len(columns))]
    if kept is not None:
        fields += [field.remove_metadata() for field in kept.schema]
        arrays += [column.combine_chunks() for column in kept.columns]
    return pa.Table.from_arrays(arrays, schema=pa.schema(fields))


def no_rows(keep: Sequence[str]) -> pa.Table | None:
    """The columns that go through where there is not a row to know their types by."""
    return pa.table({name: pa.array([], pa.null()) for name in keep}) if keep else None


def writer(file: Any, schema: pa.Schema) -> pq.ParquetWriter:
    """Writes plain numbers: nothing depends on what was written before, and end states hardly compress."""
    return pq.ParquetWriter(
        file, schema, version="2.6", compression="none", use_dictionary=False, store_schema=False
    )
