"""Whatever users give (numbers, lists, arrays, quantities, frames, rotations) as arrays: here, and nowhere else."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, Protocol, SupportsFloat, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import CoadjointWarning, InputError

Floats = NDArray[np.float64]
Backend = Literal["auto", "jit", "c", "interpreter"]


class Quantity(Protocol):
    """Numbers with a unit, of astropy, pint or unyt."""

    def to(self, *args: Any, **kwargs: Any) -> Any:
        """The same in another unit."""


class Rotation(Protocol):
    """A rotation of SciPy."""

    def as_matrix(self) -> Any:
        """Its matrix."""


#: A number: Python's, NumPy's, a fraction, or a quantity.
Real: TypeAlias = SupportsFloat
#: Numbers: lists, arrays, frames, quantities, or a dictionary of these by the names of columns.
Numbers: TypeAlias = ArrayLike | Quantity | Mapping[str, Any]
#: A unit, or one for each coordinate of the momentum.
Units: TypeAlias = str | None | Sequence[str | None]
#: From the names of columns to the places of a state's numbers among them and the columns that nobody uses.
Find: TypeAlias = Callable[[list[str]], tuple[list[int | None], list[str]]]


def floats(value: Any, what: str, *, finite: bool = True, unit: Units = None) -> Floats:
    """The numbers as one block of 64-bit floats; complex numbers, text and objects are refused."""
    value = bare(value, what, unit)
    if hasattr(value, "to_numpy") and not isinstance(value, np.ndarray):
        value = value.to_numpy()
    if np.ma.isMaskedArray(value) and np.ma.is_masked(value):
        raise InputError(f"{what}: some numbers are masked; fill or leave them out")
    try:
        array = np.asarray(value)
        if array.dtype == object:
            # Fractions and SymPy numbers become floats; anything else does not.
            entries = [float(bare(entry, what, unit)) for entry in array.flat]
            array = np.array(entries, dtype=np.float64).reshape(array.shape)
    except InputError:
        raise
    except Exception as error:
        # Other packages' objects become arrays by code of their own.
        raise InputError(f"{what}: not all are numbers, or rows have different lengths ({error})") from None
    if array.dtype.kind not in "fiu":
        raise InputError(f"{what}: numbers of type {array.dtype}; real numbers are needed")
    with np.errstate(over="ignore"):
        array = np.asarray(array, dtype=np.float64, order="C")
    return _finite(array, what) if finite else array


def _finite(array: Floats, what: str) -> Floats:
    if not np.isfinite(array).all():
        place = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        where = f"[{', '.join(map(str, place))}]" if place else ""
        raise InputError(f"{what}{where} is {array[place]}: no finite number")
    return array


def _unit(value: Any) -> Any:
    """The unit of a quantity; None for what has none."""
    # Of the class: frames have their columns as attributes.
    names = (name for name in ("unit", "units") if hasattr(type(value), name))
    return next((unit for name in names if (unit := getattr(value, name)) is not None), None)


def bare(value: Any, what: str, unit: Units) -> Any:
    """The value without its unit: in ``unit``, or refused where it cannot be converted."""
    if not isinstance(unit, (str, type(None))) and len(set(unit)) == 1:
        unit = unit[0]
    own = _unit(value)
    if own is None:
        if isinstance(value, (list, tuple)) and any(type(entry) not in (int, float) for entry in value):
            each = unit if isinstance(unit, list) and len(unit) == len(value) else [unit] * len(value)
            pairs = zip(value, each, strict=True)
            return [bare(entry, what, unit if isinstance(entry, (list, tuple)) else u) for entry, u in pairs]
        return value
    if not isinstance(unit, (str, type(None))):
        raise InputError(f"{what} is in {own}, but the coordinates have units of their own: give a list, each in its own")
    try:
        if hasattr(value, "quantity"):
            value = value.quantity
        if hasattr(value, "to_value"):
            return value.to_value(unit or "")
        # A factor may be part of the unit, as in 1e-4 kg m².
        return (value / type(value)(f"1 {unit or ''}")).to("").magnitude
    except Exception as error:
        said = f"cannot be converted to {unit!r}, the system's unit ({error})"
        if unit is None:
            said = "but nothing says in which unit the system has it: give a plain number, or the system units=dict(…)"
        raise InputError(f"{what} is in {own}, {said}") from None


def shown(value: Any) -> str:
    """A value as Python has it, with plain numbers in place of NumPy's."""
    if isinstance(value, np.generic):
        return repr(value.item())
    if type(value) in (list, tuple):
        ends = "[]" if type(value) is list else "()"
        inside = ", ".join(map(shown, value)) + ("," if type(value) is tuple and len(value) == 1 else "")
        return ends[0] + inside + ends[1]
    if type(value) is dict:
        return "{" + ", ".join(f"{key!r}: {shown(entry)}" for key, entry in value.items()) + "}"
    return repr(value)


def real(value: Any, what: str, unit: Units = None) -> float:
    """One number."""
    array = floats(value, what, finite=False, unit=unit)
    if array.ndim != 0:
        raise InputError(f"{what} must be one number; it has the shape {array.shape}")
    return float(array)


def count(value: Any, what: str, least: int = 0) -> int:
    """A whole number."""
    try:
        whole = int(value)
        same = bool(whole == value) and not isinstance(value, (bool, str))
    except (TypeError, ValueError, OverflowError):
        same = False
    if not same or not least <= whole < 2**63:
        raise InputError(f"{what}={shown(value)}: a whole number, at least {least}, is needed")
    return whole


def text(value: Any, what: str, known: Sequence[str] = ()) -> str:
    """A text, one of those that are known."""
    if not isinstance(value, str) or (known and value not in known):
        need = f"there are {', '.join(map(repr, known))}" if known else "a text is needed"
        raise InputError(f"{what}={shown(value)}: {need}")
    return value


def flag(value: Any, what: str) -> bool:
    """True or False."""
    if not isinstance(value, (bool, np.bool_)):
        raise InputError(f"{what}={shown(value)}: True or False is needed")
    return bool(value)


def listed(values: Any, what: str) -> list[Any]:
    """The entries of a list or of whatever else has some; the characters of a text are none."""
    try:
        if not isinstance(values, (str, bytes)):
            return list(values)
    except TypeError:
        pass
    raise InputError(f"{what}={shown(values)}: a list is needed")


def vector(value: Any, what: str, length: int | None = None, unit: Units = None) -> Floats:
    """A list of finite numbers, of this length."""
    array = floats(value, what, unit=unit)
    if array.ndim != 1:
        raise InputError(f"{what} must be a list of numbers; it has the shape {array.shape}")
    if length is not None and array.shape[0] != length:
        raise InputError(f"{what} has {array.shape[0]} numbers; {length} are needed")
    return array


def names(value: Any) -> list[str] | None:
    """The names of columns, or of the entries of a Series or a dictionary; None where there are none but numbers."""
    if isinstance(value, np.ndarray):
        found = value.dtype.names
    elif isinstance(value, Mapping):
        found = list(value)
    else:
        kinds = ("colnames", "column_names", "columns", "index")
        found = next((labels for kind in kinds if hasattr(labels := getattr(value, kind, None), "__len__")), None)
    if found is None or (not isinstance(value, Mapping) and all(isinstance(x, (int, np.integer)) for x in found)):
        return None
    return [str(name) for name in found]


def unused(what: str, columns: Sequence[str]) -> None:
    """Tells of columns that nobody uses."""
    if columns:
        text = f"{what}: nothing is done with the columns {', '.join(columns)}"
        warnings.warn(text, CoadjointWarning, stacklevel=5)


def table(value: Any, what: str, find: Find, units: Sequence[str | None]) -> Floats:
    """States, a row each, or a single one: by the names of columns where there are names, else as they stand."""
    found = names(value)
    if found is None:
        array = floats(value, what, finite=False, unit=units)
        more = array.shape[-1:] != (len(units),)
        if more and (_unit(value) is not None or hasattr(value, "columns")):
            raise InputError(f"{what}: columns besides the {len(units)} of the momentum need names, as in mu_1 … q_w …")
        return array
    places, others = find(found)
    each = [*units, *[None] * (len(places) - len(units))]
    columns = [
        None if place is None else floats(value[found[place]], f"{what}, {found[place]}", finite=False, unit=unit)
        for place, unit in zip(places, each, strict=True)
    ]
    shape = next((column.shape for column in columns if column is not None), ())
    try:
        array = np.stack([np.zeros(shape) if column is None else column for column in columns], axis=-1)
    except ValueError:
        raise InputError(f"{what}: its columns differ in length") from None
    unused(what, others)
    return np.ascontiguousarray(array)


def state(
    momentum: Any, group_element: Any, find: Find, units: Sequence[str | None], size: int
) -> tuple[Floats, Floats | None]:
    """A momentum and the matrix of a group element, which may stand beside the momentum by its names."""
    row = table(momentum, "momentum", find, units)
    dimension = len(units)
    if row.ndim == 1 and names(momentum) is not None and len(row) > dimension:
        if group_element is not None:
            raise InputError("momentum has columns of the attitude, and group_element is given too: keep one")
        group_element, row = row[dimension:], row[:dimension]
        group_element = group_element if len(group_element) == 4 else group_element.reshape(size, size)
    mu = vector(_finite(row, "momentum"), "momentum", dimension)
    return mu, None if group_element is None else element(group_element, size)


def element(value: Any, size: int) -> Floats:
    """The matrix of a group element: given as such, or as :func:`rotated` takes it."""
    matrix = rotated(value)
    array = floats(matrix, "group_element")
    if array.shape != (size, size):
        if matrix is not value:
            said = "a rotation or a quaternion is an element of SO3 alone"
            raise InputError(f"group_element: {said}; give the matrix of {size} rows and columns")
        said = f"must be a matrix of {size} rows and columns; it has the shape {array.shape}"
        raise InputError(f"group_element {said}")
    return array


def rotated(value: Any) -> Any:
    """The matrix of a SciPy Rotation or of a quaternion w, x, y, z, in a list or by its names; else the value itself."""
    if hasattr(value, "as_matrix"):
        return value.as_matrix()
    if not hasattr(value, "columns") and (letters := names(value)) is not None:
        if sorted(letters) != ["q_w", "q_x", "q_y", "q_z"]:
            raise InputError(f"group_element: a quaternion is q_w, q_x, q_y and q_z; there are {', '.join(letters)}")
        value = [value[f"q_{x}"] for x in "wxyz"]
    try:
        single = np.shape(value) == (4,)
    except ValueError:
        single = False
    if not single:
        return value
    w, x, y, z = array = floats(value, "group_element")
    length = float(np.linalg.norm(array))
    if abs(length - 1) > 1e-6:
        raise InputError(f"group_element: a quaternion w, x, y, z has the length 1, not {length:.9g}")
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + 2 * (w * cross + cross @ cross) / length**2


def quaternions(matrices: Floats) -> Floats:
    """Unit quaternions w, x, y, z of rotations (N, 3, 3): the first with w ≥ 0, each near the one before it."""
    m = np.moveaxis(matrices, 0, -1)
    trace = m[0, 0] + m[1, 1] + m[2, 2]
    products = np.empty((len(matrices), 4, 4))
    # 4 q qᵀ; its longest row is q but for a factor.
    products[:, 0, 0] = 1 + trace
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        products[:, 0, i + 1] = products[:, i + 1, 0] = m[k, j] - m[j, k]
        products[:, i + 1, i + 1] = 1 + 2 * m[i, i] - trace
        products[:, i + 1, j + 1] = products[:, j + 1, i + 1] = m[i, j] + m[j, i]
    rows = np.arange(len(matrices))
    found = products[rows, np.einsum("nii->ni", products).argmax(axis=1)]
    found /= np.linalg.norm(found, axis=1, keepdims=True)
    signs = np.where(np.concatenate([found[:1, 0], np.einsum("ni,ni->n", found[1:], found[:-1])]) < 0, -1.0, 1.0)
    return np.asarray(found * np.cumprod(signs)[:, np.newaxis])
