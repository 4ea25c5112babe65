"""Writes the arrays that tests/data.rs reads (NumPy 2)."""
import numpy as np

rows = 200
i = np.arange(rows, dtype=float)
arrays = {
    "mu": np.column_stack([i, 0.25 + 0.75 * i, -i]),
    "mu_next": np.asfortranarray(np.column_stack([i + 1, i * 2, -1.25 * i])),
    "g": np.add.outer(9 * i, np.arange(9.0)).reshape(rows, 3, 3),
    "q": np.full((rows, 4), 0.5, dtype=np.float32),
    "weight": i,
}
np.savez("stored.npz", **arrays)
np.savez_compressed("deflated.npz", **arrays)
with open("fortran_v2.npy", "wb") as file:
    matrix = np.asfortranarray(np.arange(24.0).reshape(4, 6))
    np.lib.format.write_array(file, matrix, version=(2, 0))
