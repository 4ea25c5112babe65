"""Exact polynomials as SymPy has them."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import sympy


def polynomial(text: str, symbols: Mapping[str, Any], *, exact: bool = True) -> sympy.Expr:
    """A polynomial in the notation of system files, in these symbols by their names there; its decimals as fractions, or
    as floating-point numbers."""
    import sympy

    # Names such as mu[0] and x' are no names of Python.
    known = {f"coordinate_{i}_": symbol for i, symbol in enumerate(symbols.values())}
    places = {name: f"coordinate_{i}_" for i, name in enumerate(symbols)}
    names = sorted(map(re.escape, symbols), key=len, reverse=True)
    if names:
        pattern = rf"(?<![\w'\]])({'|'.join(names)})(?![\w'\[])"
        text = re.sub(pattern, lambda m: places[m[1]], text)
    text = text.replace("^", "**").replace("ln(", "log(").replace("abs(", "Abs(")
    return sympy.sympify(text, locals=known, rational=exact)


def series(text: str, symbols: Mapping[str, Any]) -> dict[int, sympy.Expr]:
    """S₁, S₃, … of the JSON of a series."""
    import sympy

    found: dict[int, sympy.Expr] = {}
    # Even terms vanish.
    for order in json.loads(text)["S"][::2]:
        terms = [_coefficient(t["coefficient"]) * _power(list(symbols.values()), t["exponents"]) for t in order["terms"]]
        found[order["k"]] = sympy.Add(*terms)
    return found


def _coefficient(text: str) -> Any:
    import sympy

    if re.fullmatch(r"-?\d+(/\d+)?", text):
        return sympy.Rational(text)
    return polynomial(text, {})


def _power(symbols: list[Any], exponents: list[int]) -> Any:
    import sympy

    return sympy.Mul(*(symbol**power for symbol, power in zip(symbols, exponents, strict=True) if power))
