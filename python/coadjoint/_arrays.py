"""Arrays as users bring them: checked, and copied where that is needed."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import InputError

Floats = NDArray[np.float64]


def floats(value: Any, what: str, *, finite: bool = True) -> Floats:
    """The numbers as one block of 64-bit floats; complex numbers, text and objects are refused."""
    if hasattr(value, "to_numpy") and not isinstance(value, np.ndarray):
        value = value.to_numpy()
    if np.ma.isMaskedArray(value) and np.ma.is_masked(value):
        raise InputError(f"{what}: some numbers are masked; fill or leave them out")
    try:
        array = np.asarray(value)
    except ValueError as error:
        raise InputError(f"{what}: rows of different lengths ({error})") from None
    if array.dtype == object:
        # Fractions and SymPy numbers become floats; anything else does not.
        try:
            array = array.astype(np.float64)
        except (TypeError, ValueError) as error:
            raise InputError(f"{what}: not all are numbers ({error})") from None
    if array.dtype.kind not in "fiu":
        raise InputError(f"{what}: numbers of type {array.dtype}; real numbers are needed")
    with np.errstate(over="ignore"):
        array = np.asarray(array, dtype=np.float64, order="C")
    if finite and not np.isfinite(array).all():
        place = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        where = f"[{', '.join(map(str, place))}]" if place else ""
        raise InputError(f"{what}{where} is {array[place]}: no finite number")
    return array


def vector(value: Any, what: str, length: int | None = None) -> Floats:
    """A list of finite numbers, of this length."""
    array = floats(value, what)
    if array.ndim != 1:
        raise InputError(f"{what} must be a list of numbers; it has the shape {array.shape}")
    if length is not None and array.shape[0] != length:
        raise InputError(f"{what} has {array.shape[0]} numbers; {length} are needed")
    return array


def matrix(value: Any, what: str, size: int) -> Floats:
    """A square matrix of this size."""
    array = floats(value, what)
    if array.shape != (size, size):
        raise InputError(
            f"{what} must be a matrix of {size} rows and columns; it has the shape {array.shape}"
        )
    return array
