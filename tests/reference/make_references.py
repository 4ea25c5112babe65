#!/usr/bin/env python3
"""End states of the systems in examples/*.toml to 25 digits, by a method the crates do not share.

    python -m venv venv && venv/bin/pip install gmpy2 sympy
    venv/bin/python tests/reference/make_references.py [NAME ...] > tests/reference/systems.json

Solves mu' = ad*_{dH/dmu} mu, (ad*_x mu)_j = sum_{i,l} x_i c_ij^l mu_l, and g' = g X with
X = sum_i (dH/dmu_i) e_i by Taylor series of order 44 with 190 bits, the step chosen so that the
series converges to 1e-45; nothing here knows generating functions. The Hamiltonian and the numbers
are read from the system file, the matrix bases of the named groups are written down below (they
are those of the reference bases), an algebra without a matrix basis acts by its adjoint matrices.
`energy_defect` is H(end) - H(start). Each run is repeated with order 36 and half the steps' length,
and must agree to 30 digits.
"""
import json
import pathlib
import re
import sys
import tomllib
from fractions import Fraction

import gmpy2
import sympy
from gmpy2 import mpfr, mpq

BITS = 190
gmpy2.get_context().precision = BITS
ROOT = pathlib.Path(__file__).resolve().parents[2]


# ---------------------------------------------------------------- bases of the named groups

def unit(n, i, j, c=1):
    return {(i, j): Fraction(c)}


def add(*parts):
    total = {}
    for part in parts:
        for key, value in part.items():
            total[key] = total.get(key, 0) + value
    return {k: v for k, v in total.items() if v}


def so3(size):
    return [add(unit(size, b, a), unit(size, a, b, -1)) for a, b in [(1, 2), (2, 0), (0, 1)]]


def special_unitary(n):
    """E_ab - E_ba, i(E_ab + E_ba) for a < b, then i(E_aa - E_bb), b = a + 1, as real 2n x 2n matrices."""
    def real(entries):
        return add(*[add(unit(2 * n, a, b, re), unit(2 * n, a + n, b + n, re),
                         unit(2 * n, a, b + n, -im), unit(2 * n, a + n, b, im))
                     for a, b, re, im in entries])
    basis = []
    for a in range(n):
        for b in range(a + 1, n):
            basis.append(real([(a, b, 1, 0), (b, a, -1, 0)]))
            basis.append(real([(a, b, 0, 1), (b, a, 0, 1)]))
    for a in range(n - 1):
        basis.append(real([(a, a, 0, 1), (a + 1, a + 1, 0, -1)]))
    return 2 * n, basis


def named_basis(name):
    """(matrix size, sparse matrices)"""
    power = re.fullmatch(r"(\w+)\^(\d+)", name)
    if power:
        size, basis = named_basis(power[1])
        count = int(power[2])
        blocks = [{(i + size * k, j + size * k): v for (i, j), v in m.items()}
                  for k in range(count) for m in basis]
        return size * count, blocks
    if name == "SO3":
        return 3, so3(3)
    if name == "SE3":
        return 4, so3(4) + [unit(4, i, 3) for i in range(3)]
    if name == "SO4":
        pairs = [(a, b) for a in range(4) for b in range(a + 1, 4)]
        return 4, [add(unit(4, b, a), unit(4, a, b, -1)) for a, b in pairs]
    if name in ("SU3", "SU5"):
        return special_unitary(int(name[2]))
    raise SystemExit(f"no basis for {name}")


def product(a, b):
    total = {}
    for (i, k), x in a.items():
        for (l, j), y in b.items():
            if k == l:
                total[i, j] = total.get((i, j), 0) + x * y
    return total


def structure_of_basis(size, basis):
    keys = sorted({k for m in basis for k in m})
    columns = sympy.Matrix([[sympy.Rational(m.get(k, 0)) for m in basis] for k in keys])
    inverse = (columns.T * columns).inv() * columns.T
    structure = []
    for i, a in enumerate(basis):
        for j, b in enumerate(basis):
            bracket = add(product(a, b), {k: -v for k, v in product(b, a).items()})
            assert set(bracket) <= set(keys)
            v = sympy.Matrix([sympy.Rational(bracket.get(k, 0)) for k in keys])
            x = inverse * v
            assert columns * x == v, "the basis does not close"
            structure += [(i, j, k, Fraction(int(c.p), int(c.q))) for k, c in enumerate(x) if c]
    return structure


def algebra_of(table):
    names = table["generators"]
    index = {n: i for i, n in enumerate(names)}
    symbols = {n: sympy.Symbol(n) for n in names}
    structure = []
    for line in table["brackets"]:
        left, right = line.split("=")
        a, b = (index[s.strip()] for s in left.strip()[1:-1].split(","))
        value = sympy.expand(sympy.sympify(right, locals=symbols, rational=True))
        for n in names:
            c = value.coeff(symbols[n])
            if c:
                c = Fraction(int(c.p), int(c.q))
                structure += [(a, b, index[n], c), (b, a, index[n], -c)]
    n = len(names)
    adjoint = [{} for _ in names]
    for i, j, k, c in structure:
        adjoint[i][k, j] = c
    return n, adjoint, structure


# ---------------------------------------------------------------- the system file

def exact(value):
    return sympy.Rational(Fraction(str(value)))


def hamiltonian(data):
    symbols = [sympy.Symbol(c) for c in data["coordinates"]]
    known = {str(s): s for s in symbols}
    known |= {n: exact(v) for n, v in data.get("parameters", {}).items()}
    text = " ".join(data["hamiltonian"].split()).replace("^", "**")
    text = re.sub(r"(?<![\w.])(\d+\.?\d*|\.\d+)", lambda m: f"Rational('{m[0]}')", text)
    value = eval(text, {"__builtins__": {}, "Rational": sympy.Rational, "sqrt": sympy.sqrt}, known)
    return sympy.Poly(sympy.expand(value), *symbols)


# ---------------------------------------------------------------- Taylor series

class Series:
    """Taylor coefficients of a set of functions closed under products, order by order."""

    def __init__(self):
        self.coefficients = []
        self.products = []
        self.cache = {}

    def variable(self):
        self.coefficients.append([])
        return len(self.coefficients) - 1

    def product(self, a, b):
        key = (min(a, b), max(a, b))
        if key not in self.cache:
            self.cache[key] = self.variable()
            self.products.append((self.cache[key], *key))
        return self.cache[key]

    def monomial(self, factors):
        result = factors[0]
        for f in factors[1:]:
            result = self.product(result, f)
        return result

    def extend(self, order):
        c = self.coefficients
        for node, a, b in self.products:
            u, v = c[a], c[b]
            total = mpfr(0)
            for i in range(order + 1):
                total += u[i] * v[order - i]
            c[node].append(total)


def to_mpq(c):
    return mpq(int(c.p), int(c.q)) if isinstance(c, sympy.Rational) else mpq(c.numerator, c.denominator)


def value_of(c):
    """A number of Q(sqrt ...) or Q as mpfr."""
    if isinstance(c, (sympy.Rational, Fraction)):
        return mpfr(to_mpq(c))
    return mpfr(str(sympy.N(c, 60)))


class Flow:
    def __init__(self, poly, structure, size, basis):
        n = len(poly.gens)
        s = self.series = Series()
        self.mu = [s.variable() for _ in range(n)]
        self.g = {(i, j): s.variable() for i in range(size) for j in range(size)}
        self.size = size

        def linear(p):
            """A polynomial as [(coefficient, node or None for the constant)]."""
            out = []
            for exponents, c in p.terms():
                factors = [self.mu[i] for i, e in enumerate(exponents) for _ in range(e)]
                if c != 0:
                    out.append((value_of(c), s.monomial(factors) if factors else None))
            return out

        gens = poly.gens
        gradient = [poly.diff(x) for x in gens]
        right = [sympy.Poly(0, *gens) for _ in gens]
        for i, j, l, c in structure:
            right[j] += gradient[i] * sympy.Poly(sympy.Rational(c) * gens[l], *gens)
        self.right = [linear(p) for p in right]
        # X = sum_i (dH/dmu_i) e_i, entry by entry
        entries = {}
        for i, m in enumerate(basis):
            for key, c in m.items():
                entries[key] = entries.get(key, sympy.Poly(0, *gens)) + gradient[i] * sympy.Rational(c)
        self.x = {}
        self.x_series = []
        for key, p in entries.items():
            if not p.is_zero:
                node = s.variable()
                self.x[key] = node
                self.x_series.append((node, linear(p)))
        self.g_right = {}
        self.g_products = []
        for i in range(size):
            for j in range(size):
                parts = []
                for k in range(size):
                    if (k, j) in self.x:
                        node = s.variable()
                        self.g_products.append((node, self.g[i, k], self.x[k, j]))
                        parts.append(node)
                self.g_right[i, j] = parts

    def step(self, mu, g, order, tolerance, remaining, shrink):
        c = self.series.coefficients
        for node in range(len(c)):
            c[node] = []
        for node, value in zip(self.mu, mu):
            c[node].append(value)
        for key, node in self.g.items():
            c[node].append(g[key])
        for k in range(order):
            self.series.extend(k)
            for node, terms in self.x_series:
                c[node].append(self.sum(terms, k))
            for node, a, b in self.g_products:
                u, v = c[a], c[b]
                total = mpfr(0)
                for i in range(k + 1):
                    total += u[i] * v[k - i]
                c[node].append(total)
            for node, terms in zip(self.mu, self.right):
                c[node].append(self.sum(terms, k) / (k + 1))
            for key, node in self.g.items():
                c[node].append(sum((c[p][k] for p in self.g_right[key]), mpfr(0)) / (k + 1))
        nodes = self.mu + list(self.g.values())
        last = max(max(abs(c[n][order]) for n in nodes), mpfr("1e-300"))
        before = max(max(abs(c[n][order - 1]) for n in nodes), mpfr("1e-300"))
        h = min((tolerance / last) ** (mpfr(1) / order), (tolerance / before) ** (mpfr(1) / (order - 1)))
        h = min(h / shrink, remaining)

        def at(node):
            total = mpfr(0)
            for value in reversed(c[node]):
                total = total * h + value
            return total
        return h, [at(n) for n in self.mu], {key: at(n) for key, n in self.g.items()}

    def sum(self, terms, k):
        c = self.series.coefficients
        total = mpfr(0)
        for factor, node in terms:
            if node is None:
                total += factor if k == 0 else 0
            else:
                total += factor * c[node][k]
        return total

    def run(self, mu, time, order, tolerance, shrink=1):
        g = {key: mpfr(1 if key[0] == key[1] else 0) for key in self.g}
        remaining = time
        while remaining > 0:
            h, mu, g = self.step(mu, g, order, tolerance, remaining, shrink)
            remaining -= h
        return mu, g


def energy(poly, mu):
    total = mpfr(0)
    for exponents, c in poly.terms():
        term = value_of(c)
        for x, e in zip(mu, exponents):
            term *= x ** e
        total += term
    return total


def digits(x, n=25):
    return "0.0" if x == 0 else ("{0:." + str(n) + "g}").format(x)


def reference(path):
    data = tomllib.loads(path.read_text(), parse_float=str)
    poly = hamiltonian(data)
    if "algebra" in data:
        size, basis, structure = algebra_of(data["algebra"])
    else:
        size, basis = named_basis(data["group"])
        structure = structure_of_basis(size, basis)
    flow = Flow(poly, structure, size, basis)
    start = [mpfr(to_mpq(Fraction(str(x)))) for x in data["initial"]["momentum"]]
    time = mpfr(to_mpq(Fraction(str(data["run"]["time"]))))
    mu, g = flow.run(start, time, 44, mpfr("1e-45"))
    again, h = flow.run(start, time, 36, mpfr("1e-45"), 2)
    scale = max(abs(x) for x in mu + list(g.values()))
    gap = max([abs(a - b) for a, b in zip(mu, again)] + [abs(g[k] - h[k]) for k in g]) / scale
    assert gap < 1e-30, f"{path.name}: two runs differ by {gap}"
    e = energy(poly, start)
    entry = {"system": data["name"], "file": f"examples/{path.name}", "group": data.get("group", "algebra")}
    if "algebra" in data:
        entry["structure"] = [[i, j, k, str(c)] for i, j, k, c in structure]
    entry |= {
        "H": [{"exponents": list(x), "coefficient": str(c)} for x, c in poly.terms()],
        "momentum0": [str(x) for x in data["initial"]["momentum"]],
        "T": str(data["run"]["time"]),
        "energy": digits(e),
        "energy_defect": digits(energy(poly, mu) - e, 3),
        "momentum": [digits(x) for x in mu],
        "group_element": [[digits(g[i, j]) for j in range(size)] for i in range(size)],
    }
    print(f"{data['name']}: two runs differ by {float(gap):.1e}", file=sys.stderr)
    return entry


def main():
    chosen = sys.argv[1:]
    entries = []
    for path in sorted((ROOT / "examples").glob("*.toml")):
        data = tomllib.loads(path.read_text(), parse_float=str)
        if (not chosen or data["name"] in chosen) and "potential" not in data:
            entries.append(json.dumps(reference(path)))
    print("[\n" + ",\n".join(entries) + "\n]")


main()
