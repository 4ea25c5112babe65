"""The text of a system file, from what Python has."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Any

import numpy as np

from . import _arrays
from .errors import InputError

# Functions of numbers and parameters that the text may have, by their names in SymPy.
_FUNCTIONS = {
    "sin": "sin",
    "cos": "cos",
    "tan": "tan",
    "asin": "asin",
    "acos": "acos",
    "atan": "atan",
    "atan2": "atan2",
    "sinh": "sinh",
    "cosh": "cosh",
    "tanh": "tanh",
    "exp": "exp",
    "log": "ln",
    "Abs": "abs",
    "sign": "sign",
}

# Functions of SymPy that are 1 over these.
_INVERSES = {"sec": "cos", "csc": "sin", "cot": "tan", "sech": "cosh", "csch": "sinh", "coth": "tanh"}


def quoted(text: str) -> str:
    """A string of TOML."""
    # Strings of JSON are strings of TOML, but for one character.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def number(value: Any, what: str) -> str:
    """A number as TOML has it, without loss: a fraction as text in quotes."""
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, (bool, np.bool_)):
        raise InputError(f"{what}: {value} is no number")
    if isinstance(value, (int, np.integer)):
        digits = str(int(value))
        return digits if len(digits) < 18 else quoted(digits)
    if isinstance(value, Fraction):
        return quoted(f"{value.numerator}/{value.denominator}")
    if isinstance(value, (float, np.floating)):
        if not math.isfinite(value):
            raise InputError(f"{what}: {value} is no finite number")
        return repr(float(value))
    if _is_sympy(value):
        if value.free_symbols:
            raise InputError(f"{what}: {value} is no number")
        return quoted(expression(value, what))
    raise InputError(f"{what}: {_arrays.shown(value)} is no number (a {type(value).__name__})")


def numbers(value: Any, what: str) -> str:
    """A number, a list of numbers, or a matrix."""
    if hasattr(value, "to_numpy") and _arrays.names(value) is None:
        value = value.to_numpy()
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(numbers(item, what) for item in value) + "]"
    if _is_sympy(value) and hasattr(value, "tolist"):
        return numbers(value.tolist(), what)
    return number(value, what)


def _is_sympy(value: Any) -> bool:
    return hasattr(value, "free_symbols")


def expression(value: Any, what: str) -> str:
    """An expression as our parser reads it: text as it stands, SymPy translated."""
    if isinstance(value, str):
        return value
    if not _is_sympy(value):
        raise InputError(
            f"{what} must be text or a SymPy expression, not {type(value).__name__}: "
            f'write {what}="x^2/2 + …"'
        )
    return _sympy(value, what)


def _sympy(value: Any, what: str) -> str:
    import sympy

    def refuse(part: Any, why: str) -> InputError:
        return InputError(f"{what}: {part} {why}")

    def atom(part: Any) -> str:
        text = walk(part)
        simple = part.is_Symbol or (part.is_Integer and part >= 0) or part.is_Function
        return text if simple else f"({text})"

    def walk(part: Any) -> str:
        if part.is_Symbol or isinstance(part, sympy.Indexed):
            name = str(part)
            if not all(c.isalnum() or c in "_'[]" for c in name.replace(", ", "][")):
                raise refuse(repr(name), "is no name here: use letters, digits and _")
            return name.replace(", ", "][")
        if part.is_Integer:
            return str(int(part))
        if part.is_Rational:
            return f"{part.p}/{part.q}"
        if part.is_Float:
            # The decimals that SymPy shows are the number that was meant.
            return repr(float(part)) if part._prec == 53 else str(part)
        if part is sympy.pi:
            return "pi"
        if part.is_Add:
            return " + ".join(
                f"({walk(term)})" if term.could_extract_minus_sign() else walk(term)
                for term in part.as_ordered_terms()
            )
        if part.is_Mul:
            return "*".join(atom(factor) for factor in part.as_ordered_factors())
        if part.is_Pow:
            base, exponent = part.as_base_exp()
            if exponent == sympy.Rational(1, 2):
                return f"sqrt({walk(base)})"
            if exponent == sympy.Rational(-1, 2):
                return f"1/sqrt({walk(base)})"
            if exponent.is_Integer and exponent < 0:
                return f"1/{atom(base)}^{-int(exponent)}"
            return f"{atom(base)}^{atom(exponent)}"
        if isinstance(part, sympy.exp):
            return f"exp({walk(part.args[0])})"
        if isinstance(part, (sympy.Min, sympy.Max)):
            name, (first, *others) = type(part).__name__.lower(), map(walk, part.args)
            for other in others:
                first = f"{name}({first}, {other})"
            return first
        if isinstance(part, sympy.Heaviside):
            return f"((1 + sign({walk(part.args[0])}))/2)"
        if inverse := _INVERSES.get(type(part).__name__):
            return f"(1/{inverse}({walk(part.args[0])}))"
        if part.is_Function:
            function = _FUNCTIONS.get(type(part).__name__)
            if function is None:
                why = f"has a function that is not known here; there are {', '.join(['sqrt', *_FUNCTIONS])}"
                if {str(symbol) for symbol in part.free_symbols} == {"t"}:
                    why += "; a function of the time alone may be an input: write u in its place, and give inputs=dict(u=…)"
                raise refuse(part, why)
            return f"{function}({', '.join(walk(argument) for argument in part.args)})"
        raise refuse(part, f"is a {type(part).__name__}, which is not known here; expand it first")

    return walk(sympy.sympify(value))


def symbols(*values: Any) -> dict[str, Any]:
    """SymPy's symbols in these expressions, by their names."""
    found: dict[str, Any] = {}
    for value in values:
        for symbol in getattr(value, "free_symbols", ()):
            if found.setdefault(str(symbol), symbol) != symbol:
                raise InputError(f"two symbols are called {symbol}: give both the same assumptions")
    return found


def mapping(value: Any, what: str) -> dict[str, Any]:
    """A dictionary with texts, or SymPy's symbols, as keys; none is an empty one."""
    if not isinstance(value, Mapping | None):
        raise InputError(f"{what}={_arrays.shown(value)}: a dictionary is needed")
    return {str(key): entry for key, entry in (value or {}).items()}


def names(value: str | Iterable[Any], what: str) -> list[str]:
    """Names in a text with blanks or commas between them, or a sequence of names or symbols."""
    if isinstance(value, str):
        return value.replace(",", " ").split()
    found = [str(name) for name in _arrays.listed(value, what)]
    if not all(found):
        raise InputError(f"{what}: a name is empty")
    return found


def algebra(group: Any) -> dict[str, str | None]:
    """The table of an algebra by basis or brackets."""
    if not isinstance(group, Mapping):
        raise InputError(
            'group must be a name such as "SO3", or a dictionary with a basis, or with generators and brackets'
        )
    unknown = {str(key) for key in group} - {"name", "basis", "generators", "brackets"}
    if unknown:
        raise InputError(
            f"group: unknown {', '.join(sorted(unknown))}; there are name, basis, generators and brackets"
        )
    found: dict[str, str | None] = {}
    if "name" in group:
        found["name"] = quoted(str(group["name"]))
    if "generators" in group:
        found["generators"] = strings(names(group["generators"], "generators"))
    if "basis" in group:
        matrices = [numbers(matrix, "basis") for matrix in _arrays.listed(group["basis"], "basis")]
        found["basis"] = "[\n    " + ",\n    ".join(matrices) + ",\n]"
    if "brackets" in group:
        found["brackets"] = strings(str(bracket) for bracket in _arrays.listed(group["brackets"], "brackets"))
    return found


def strings(values: Iterable[str]) -> str:
    """A list of strings."""
    return "[" + ", ".join(quoted(value) for value in values) + "]"


def table(name: str | None, entries: Mapping[str, str | None]) -> list[str]:
    """A table with the entries that are there."""
    lines = [f"{_key(key)} = {value}" for key, value in entries.items() if value is not None]
    return [f"\n[{name}]", *lines] if lines and name else lines


def _key(name: str) -> str:
    """A key of TOML."""
    bare = name and all(c.isascii() and (c.isalnum() or c in "_-") for c in name)
    return name if bare else quoted(name)
