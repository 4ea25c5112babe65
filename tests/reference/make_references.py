#!/usr/bin/env python3
"""End states to 25 digits, by a method the crates do not share: Taylor's method of heyoka, in 256-bit arithmetic.

    python -m venv venv && venv/bin/pip install heyoka sympy
    venv/bin/python tests/reference/make_references.py [systems] [smooth] [satellite] [bench]

writes systems.json, smooth.json and satellite.json beside this file, and bench/reference/end_states.json; all of them
where none is named. Nothing here knows generating functions. Systems solve mu' = ad*_{dH/dmu} mu,
(ad*_x mu)_j = sum_{i,l} x_i c_ij^l mu_l, and g' = g X with X = sum_i (dH/dmu_i) e_i. The Hamiltonian and the numbers are
read from the system file, the matrix bases of the named groups are written down below (they are those of the reference
bases), an algebra without a matrix basis acts by its adjoint matrices. The others have their equations of motion written
down by hand. Each run is repeated with another tolerance, and must agree to 28 digits.
"""
import json
import pathlib
import re
import sys
import tomllib
from decimal import Decimal
from fractions import Fraction

import heyoka as hy
import numpy
import sympy

BITS = 256
ROOT = pathlib.Path(__file__).resolve().parents[2]


def real(x):
    """A number, exactly or to all bits: a text, a fraction, or SymPy's."""
    if isinstance(x, sympy.Expr) and not isinstance(x, sympy.Rational):
        return hy.real(str(sympy.N(x, 90)), BITS)
    if isinstance(x, sympy.Rational):
        x = Fraction(int(x.p), int(x.q))
    x = Fraction(x)
    return hy.real(x.numerator, BITS) / hy.real(x.denominator, BITS)


def digits(x, n=25):
    if abs(x) < real("1e-60"):
        return "0.0"
    mantissa, e, exponent = f"{Decimal(str(x)):.{n}g}".partition("e")
    mantissa = mantissa.rstrip("0") if "." in mantissa else mantissa
    return mantissa + ("0" if mantissa.endswith(".") else "") + e + exponent


def ends(name, equations, start, time):
    """The state at the time, and the gap to a run with another tolerance."""
    found = []
    for tolerance in ("1e-50", "1e-45"):
        integrator = hy.taylor_adaptive(
            equations, numpy.array(start), fp_type=hy.real, prec=BITS, tol=hy.real(tolerance, BITS), compact_mode=True
        )
        integrator.propagate_until(time)
        found.append(integrator.state.copy())
    gap = max(abs(a - b) for a, b in zip(*found)) / max(abs(a) for a in found[0])
    print(f"{name}: two runs differ by {float(str(gap)):.1e}", file=sys.stderr)
    assert gap < real("1e-28"), name
    return list(found[0]), gap


def dot(a, b):
    return sum((x * y for x, y in zip(a, b)), hy.expression(0.0))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


# ---------------------------------------------------------------- systems of the examples

SYSTEMS = """clebsch_case free_body_full_inertia goryachev_chaplygin_top gyrostat heavy_top_bruels heisenberg_spin_ring
    kirchhoff_body kovalevskaya_top lagrange_top manakov_so4 su3_quadratic three_wave toda_lattice zeitlin_3 zeitlin_5
    ../tests/systems/extended_pose ../tests/systems/beam_moments"""


def unit(n, i, j, c=1):
    matrix = numpy.full((n, n), Fraction(0))
    matrix[i, j] = Fraction(c)
    return matrix


def turn(n, a, b):
    return unit(n, b, a) - unit(n, a, b)


def special_unitary(n):
    """E_ab - E_ba, i(E_ab + E_ba) for a < b, then i(E_aa - E_bb), b = a + 1, as real 2n x 2n matrices."""

    def imaginary(a, b, c=1):
        return unit(2 * n, a + n, b, c) - unit(2 * n, a, b + n, c)

    def pair(a, b):
        return [turn(2 * n, b, a) + turn(2 * n, b + n, a + n), imaginary(a, b) + imaginary(b, a)]

    pairs = [matrix for a in range(n) for b in range(a + 1, n) for matrix in pair(a, b)]
    return pairs + [imaginary(a, a) - imaginary(a + 1, a + 1) for a in range(n - 1)]


def named_basis(name):
    if power := re.fullmatch(r"(\w+)\^(\d+)", name):
        basis, count = named_basis(power[1]), int(power[2])
        return [numpy.kron(unit(count, k, k), m) for k in range(count) for m in basis]
    rotations = [(1, 2), (2, 0), (0, 1)]
    if name == "SO3":
        return [turn(3, *axes) for axes in rotations]
    if name == "SE3":
        return [turn(4, *axes) for axes in rotations] + [unit(4, i, 3) for i in range(3)]
    if name == "SE23":
        return [turn(5, *axes) for axes in rotations] + [unit(5, i, column) for column in (3, 4) for i in range(3)]
    if name == "Sp4":
        squares = [unit(4, a, b) - unit(4, b + 2, a + 2) for a in range(2) for b in range(2)]
        both = [(a, b) for a in range(2) for b in range(a, 2)]
        corner = lambda i, j, a, b: unit(4, i + a, j + b) + (a != b) * unit(4, i + b, j + a)
        return squares + [corner(i, j, a, b) for i, j in ((0, 2), (2, 0)) for a, b in both]
    if name == "SO4":
        return [turn(4, a, b) for a in range(4) for b in range(a + 1, 4)]
    return special_unitary(int(name.removeprefix("SU")))


def structure_of(basis):
    """The constants c_ij^k of matrices that close under brackets."""
    flat = numpy.array([m.ravel() for m in basis])
    inverse = sympy.Matrix(flat @ flat.T).inv()
    found = []
    for i, a in enumerate(basis):
        for j, b in enumerate(basis):
            bracket = a @ b - b @ a
            values = inverse * sympy.Matrix(flat @ bracket.ravel())
            closed = sum(m * Fraction(str(c)) for m, c in zip(basis, values))
            assert (closed == bracket).all(), "the basis does not close"
            found += [(i, j, k, Fraction(str(c))) for k, c in enumerate(values) if c]
    return found


def algebra_of(table):
    """The adjoint matrices and the structure of an algebra by its brackets."""
    names = table["generators"]
    symbols = {name: sympy.Symbol(name) for name in names}
    structure = []
    for line in table["brackets"]:
        left, right = line.split("=")
        a, b = (names.index(name.strip()) for name in left.strip()[1:-1].split(","))
        value = sympy.expand(sympy.sympify(right, locals=symbols, rational=True))
        for k, name in enumerate(names):
            if c := value.coeff(symbols[name]):
                structure += [(a, b, k, Fraction(str(c))), (b, a, k, -Fraction(str(c)))]
    adjoint = [numpy.full((len(names),) * 2, Fraction(0)) for _ in names]
    for i, j, k, c in structure:
        adjoint[i][k, j] = c
    return adjoint, structure


def hamiltonian(data):
    known = {name: sympy.Symbol(name) for name in data["coordinates"]}
    symbols = list(known.values())
    known |= {name: sympy.Rational(Fraction(str(value))) for name, value in data.get("parameters", {}).items()}
    text = " ".join(data["hamiltonian"].split()).replace("^", "**")
    text = re.sub(r"(?<![\w.])(\d+\.?\d*|\.\d+)", lambda m: f"Rational('{m[0]}')", text)
    value = eval(text, {"__builtins__": {}, "Rational": sympy.Rational, "sqrt": sympy.sqrt}, known)
    return sympy.Poly(sympy.expand(value), *symbols)


def system(stem):
    data = tomllib.loads((ROOT / f"examples/{stem}.toml").read_text(), parse_float=str)
    polynomial = hamiltonian(data)
    if "algebra" in data:
        basis, structure = algebra_of(data["algebra"])
    else:
        basis = named_basis(data["group"])
        structure = structure_of(basis)
    n, size = len(basis), len(basis[0])
    mu = hy.make_vars(*(f"m{i}" for i in range(n)))
    g = numpy.array(hy.make_vars(*(f"g{i}" for i in range(size * size)))).reshape(size, size)
    zero = hy.expression(0.0)

    def power(x, e):
        return hy.expression(1.0) if e == 0 else numpy.prod([x] * e)

    energy = sum((real(c) * numpy.prod([power(x, e) for x, e in zip(mu, es)]) for es, c in polynomial.terms()), zero)
    velocity = [hy.diff(energy, x) for x in mu]
    force = [zero] * n
    for i, j, k, c in structure:
        force[j] += real(c) * velocity[i] * mu[k]
    matrix = numpy.array([[zero] * size] * size)
    for x, m in zip(velocity, basis):
        for i, j in zip(*numpy.nonzero(m)):
            matrix[i, j] += real(m[i, j]) * x
    turned = g @ matrix
    equations = list(zip(mu, force)) + list(zip(g.ravel(), turned.ravel()))
    start = [real(str(x)) for x in data["initial"]["momentum"]]
    identity = [real(int(i == j)) for i in range(size) for j in range(size)]
    end, _ = ends(data["name"], equations, start + identity, real(str(data["run"]["time"])))
    value = hy.cfunc([energy], mu, fp_type=hy.real, prec=BITS, compact_mode=True)
    before, after = (value(numpy.array(state))[0] for state in (start, end[:n]))
    entry = {"system": data["name"], "file": f"examples/{stem}.toml".removeprefix("examples/../"), "group": data.get("group", "algebra")}
    if "algebra" in data:
        entry["structure"] = [[i, j, k, str(c)] for i, j, k, c in structure]
    return entry | {
        "H": [{"exponents": list(x), "coefficient": str(c)} for x, c in polynomial.terms()],
        "momentum0": [str(x) for x in data["initial"]["momentum"]],
        "T": str(data["run"]["time"]),
        "energy": digits(before),
        "energy_defect": digits(after - before, 3),
        "momentum": [digits(x) for x in end[:n]],
        "group_element": [[digits(x) for x in end[n + size * i : n + size * (i + 1)]] for i in range(size)],
    }


# ---------------------------------------------------------------- Hamiltonians that are no polynomials

def exponential_spin():
    m = hy.make_vars("x", "y", "z")
    w = real("0.3")
    slope = -2.0 * m[2] * hy.exp((m[2] * m[2] - 1.0) / w) / w
    return m, cross(m, [hy.expression(-real("0.25")), hy.expression(0.0), slope])


def screened_top():
    state = hy.make_vars("a", "b", "c", "x", "y", "z")
    pi, gamma = state[:3], state[3:]
    k, d, l, s = map(real, ("3", "1.5", "0.6", "4"))
    omega = [p / real(i) for p, i in zip(pi, ("1", "1.4", "0.7"))]
    r = hy.sqrt(d * d + l * l + real(2) * d * l * gamma[2])
    force = k * hy.exp(-r / s) * (1.0 / (s * r) + 1.0 / (r * r)) * (d * l) / r
    moment = cross(gamma, [hy.expression(0.0), hy.expression(0.0), force])
    return state, [a + b for a, b in zip(cross(pi, omega), moment)] + cross(gamma, omega)


def smooth(name, make, start, time):
    state, rates = make()
    end, _ = ends(name, list(zip(state, rates)), [real(x) for x in start.split()], real(time))
    return {"time": time, "momentum": [digits(x, 20) for x in end]}


# ---------------------------------------------------------------- the satellite of examples/satellite.toml at T = 20

def satellite():
    """Pi' = Pi x W + 3 r x I r, W = I^-1 Pi, R' = R W^, r = R^T (cos t, sin t, 0), l' = -3 (I r).(R^T (-sin t, cos t, 0)),
    with the time in them: no group, no splitting, no potential."""
    inertia = [real(x) for x in ("1", "1.25", "1.5")]
    *pi, momentum = hy.make_vars("x", "y", "z", "l")
    rows = [hy.make_vars(*(f"{a}{i}" for i in range(3))) for a in "abc"]
    omega = [p / i for p, i in zip(pi, inertia)]
    co, si = hy.cos(hy.time), hy.sin(hy.time)
    radius = [co * a + si * b for a, b in zip(*rows[:2])]
    along = [co * b - si * a for a, b in zip(*rows[:2])]
    moment = [i * r for i, r in zip(inertia, radius)]
    force = [a + 3.0 * b for a, b in zip(cross(pi, omega), cross(radius, moment))]
    equations = list(zip(pi, force)) + [pair for row in rows for pair in zip(row, cross(row, omega))]
    equations.append((momentum, -3.0 * dot(moment, along)))
    start = [real(x) for x in ("0.1", "-0.2", "1.6")]
    start += [real(Fraction(n, 21)) for n in (16, -4, 13, 8, 19, -4, -11, 8, 16)] + [real(0)]
    end, _ = ends("satellite", equations, start, real(20))
    orbit = [real(sympy.cos(20)), real(sympy.sin(20))]
    text = [f"{Decimal(str(x)):.25f}" for x in end + orbit]
    return {
        "system": "satellite", "T": "20",
        "momentum": text[:3] + [text[12]],
        "attitude": [text[3 + 3 * i : 6 + 3 * i] for i in range(3)],
        "orbit": text[13:],
    }


# ---------------------------------------------------------------- the problems of the benchmark

KIRCHHOFF = dict(inverse_inertia=("1", "1/2", "1/3"), inverse_mass=("1", "1/2", "1/4"),
                 momentum=("1", "1/2", "1/5"), force=("3/10", "2/5", "1/2"))
KOVALEVSKAYA = dict(inverse_inertia=("1/2", "1/2", "1"), linear=("1", "0", "0"), momentum=("2", "3", "4"), force=("1", "0", "0"))
FREE = dict(inverse_inertia=("2/3", "1/2", "2/5"), end="1000")
PROBLEMS = [
    dict(FREE, name="free-body-a", momentum=("2", "1/2", "1")),
    dict(FREE, name="free-body-b", momentum=("6/5", "5/2", "3/5")),
    dict(name="heavy-top", inverse_inertia=("64/975", "32/15", "64/975"), linear=("0", "2943/20", "0"),
         momentum=("0", "703125/10000", "-703124296875/10000000000"), force=("0", "0", "1"), end="10", check="1"),
    dict(KIRCHHOFF, name="kirchhoff", end="100", check="10"),
    dict(KOVALEVSKAYA, name="kovalevskaya", end="100", check="10"),
    dict(KIRCHHOFF, name="kirchhoff-long", end="1000"),
    dict(KOVALEVSKAYA, name="kovalevskaya-long", end="1000"),
]


def problem(given):
    """momentum' = momentum x w + force x v, force' = force x w, q' = q (0, w)/2, x' = q v q*, with w = diag(a) momentum and
    v = diag(b) force + c."""
    nothing = ("0", "0", "0")
    a, b, c = ([real(x) for x in given.get(key, nothing)] for key in ("inverse_inertia", "inverse_mass", "linear"))
    momentum, force, q, x = (hy.make_vars(*(f"{name}{i}" for i in range(n))) for name, n in (("m", 3), ("f", 3), ("q", 4), ("x", 3)))
    w = [k * m for k, m in zip(a, momentum)]
    v = [k * f + l for k, f, l in zip(b, force, c)]
    axis = q[1:]
    t = [2.0 * s for s in cross(axis, v)]
    moved = [i + q[0] * j + k for i, j, k in zip(v, t, cross(axis, t))]
    turned = [-dot(axis, w)] + [q[0] * i + j for i, j in zip(w, cross(axis, w))]
    rates = [i + j for i, j in zip(cross(momentum, w), cross(force, v))] + cross(force, w) + [0.5 * s for s in turned] + moved
    equations = list(zip(momentum + force + q + x, rates))
    start = [real(s) for key in ("momentum", "force") for s in given.get(key, nothing)]
    start += [real(s) for s in (1, 0, 0, 0, 0, 0, 0)]

    def state(end):
        found, gap = ends(given["name"], equations, start, real(end))
        sign = -1 if min(found[6:10]) < -max(found[6:10]) else 1
        text = [digits(sign * s if 6 <= i < 10 else s) for i, s in enumerate(found)]
        return dict(momentum=text[:3], force=text[3:6], quaternion=text[6:10], position=text[10:]), gap

    end, gap = state(given["end"])
    entry = {key: given[key] for key in ("name", "inverse_inertia", "inverse_mass", "linear", "momentum", "force", "end") if key in given}
    entry |= {"gap": digits(gap, 2), "end_state": end}
    if "check" in given:
        entry["check"] = dict(end=given["check"], state=state(given["check"])[0])
    return entry


def main():
    here = pathlib.Path(__file__).resolve().parent
    makers = {
        "systems": (here, lambda: "[\n" + ",\n".join(json.dumps(system(stem)) for stem in SYSTEMS.split()) + "\n]"),
        "smooth": (here, lambda: json.dumps({
            "exponential_spin": smooth("exponential_spin", exponential_spin, "0.6 0 0.8", 10),
            "screened_top": smooth("screened_top", screened_top, "0.5 -0.4 1.1 0.6 0 0.8", 10),
        }, indent=1)),
        "satellite": (here, lambda: json.dumps(satellite(), indent=1)),
        "bench": (ROOT / "bench/reference", lambda: json.dumps([problem(given) for given in PROBLEMS], indent=1)),
    }
    for name in sys.argv[1:] or makers:
        folder, make = makers[name]
        (folder / f"{'end_states' if name == 'bench' else name}.json").write_text(make() + "\n")


main()
