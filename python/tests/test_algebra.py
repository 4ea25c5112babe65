"""Series, Casimirs, laws, code, and expressions of SymPy."""

from __future__ import annotations

import shutil
import subprocess
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import sympy

import coadjoint as ca
from coadjoint import InputError

x, y, z = sympy.symbols("x y z")


def test_sympy_and_text_are_the_same_system() -> None:
    a, b = sympy.symbols("a b")
    energy = x**2 / (2 * a) + b * y**2 / 3 - sympy.sqrt(2) * z * y + (x - y) ** 2 / 7 - sympy.Rational(3, 4) * x**4
    made = ca.System("SO3", energy, coordinates=[x, y, z], parameters={a: 2, b: Fraction(1, 3)})
    text = "x^2/(2*a) + b*y^2/3 - sqrt(2)*z*y + (x - y)^2/7 - 3/4*x^4"
    written = ca.System("SO3", text, coordinates="x y z", parameters={"a": 2, "b": "1/3"})
    difference = sympy.simplify(made.hamiltonian - written.hamiltonian)
    assert difference == 0
    expected = energy.subs({a: 2, b: sympy.Rational(1, 3)})
    assert sympy.simplify(made.hamiltonian - expected) == 0
    start = [0.3, 0.2, 0.4]
    runs = [s.simulate(start, time=2, step=0.1).final_momentum for s in (made, written)]
    np.testing.assert_allclose(*runs, rtol=0, atol=1e-14)


@pytest.mark.parametrize(
    "energy",
    [
        x / 2 - (y - z) ** 2 * (x + 1),
        -(x**2) / 3,
        x**2 * sympy.cos(1),
        sympy.exp(-2) * x * y,
        0.1 * x**2 - 2e-7 * y,
        sympy.pi * x**2 / 3,
    ],
)
def test_expressions_come_back(energy: sympy.Expr) -> None:
    found = ca.System("SO3", energy, coordinates="x y z").hamiltonian
    values = {x: 0.7, y: -1.3, z: 2.1}
    assert abs(float((found - energy).subs(values))) < 1e-14


@pytest.mark.parametrize(
    ("energy", "message"),
    [
        (sympy.Function("f")(x), "f"),
        (sympy.besselj(0, 2) * x, "besselj"),
        (sympy.I * x, "I"),
        (sympy.Integral(x, x), "Integral"),
        (sympy.Symbol("a b") * x, "a b"),
        (sympy.Symbol("q") * x, "q"),
    ],
)
def test_what_is_not_known_is_refused(energy: sympy.Expr, message: str) -> None:
    with pytest.raises(InputError, match=message):
        ca.System("SO3", energy, coordinates="x y z")


def test_the_series_is_exact(body: ca.System) -> None:
    series = body.series(truncation=5)
    assert sorted(series) == [1, 3, 5] and body.series(2) == 0
    assert sympy.expand(series[1] - body.hamiltonian) == 0
    assert body.series(3) == series[3] and body.series(5) == series[5]
    assert all(c.is_Rational for c in sympy.Poly(series[5], x, y, z).coeffs())
    # Hamilton and Jacobi to third order, on SO(3) by hand: S₃ = ⟨∇H, D²H-terms⟩ vanishes on the sphere's symmetric body.
    ball = ca.System("SO3", "x^2 + y^2 + z^2", coordinates="x y z")
    assert ball.series(3) == 0
    assert r"\begin{align}" in body.latex() and "S_{3}" in body.latex(truncation=3)
    with pytest.raises(InputError, match="odd"):
        body.series(truncation=4)


def test_irrational_coefficients_stay_exact() -> None:
    system = ca.System("SO3", "sqrt(2)*x^2 + y^2/3", coordinates="x y z")
    assert system.series(1).coeff(x, 2) == sympy.sqrt(2)
    found = system.series(3).subs({x: 1, y: 2, z: 3})
    decimal = ca.System("SO3", "1.4142135623730951*x^2 + y^2/3", coordinates="x y z").series(3)
    assert abs(float(found - decimal.subs({x: 1, y: 2, z: 3}))) < 1e-14


def test_casimirs() -> None:
    top = ca.System("SE3", "x^2/2 + y^2/2 + z^2 + u", coordinates="x y z u v w")
    u, v, w = sympy.symbols("u v w")
    squares, product = top.casimirs(2)
    found = {sympy.expand(c) for c in (squares, product)}
    assert sympy.expand(u**2 + v**2 + w**2) in found and sympy.expand(u * x + v * y + w * z) in found
    indexed = ca.System("SO3^2", "sum(i, 0..2, x[i]^2)", coordinates="x y z").casimirs(2)
    assert len(indexed) == 2


def test_the_laws_hold(body: ca.System) -> None:
    laws = body.check()
    assert laws and len(laws) == 7 and laws["order"].value > 7.5
    assert "holds" in repr(laws) and "symplectic" in repr(laws)
    with pytest.raises(KeyError):
        laws["gravity"]


def test_runs_and_ensembles_are_verified(body: ca.System) -> None:
    run = body.simulate([2, 0.5, 1], time=3, step=0.1, every=2)
    verdict = body.verify(run)
    assert verdict and verdict.rows == 15 and verdict.steps == 30
    run.momentum[7, 1] += 1e-11
    verdict = body.verify(run)
    assert not verdict and "row 8" in (verdict.wrong or "") and "wrong" in repr(verdict)
    start = np.random.default_rng(3).uniform(-1, 1, (4, 3))
    final = body.ensemble(start, time=1, step=0.1)
    assert body.verify(final, start)
    final[2, 0] += 1e-10
    assert not body.verify(final, start)


@pytest.mark.parametrize("language", ["rust", "c", "cpp", "opencl", "cuda"])
def test_code_is_emitted(body: ca.System, language: str) -> None:
    more = {"step": 0.1} if language in ("opencl", "cuda") else {}
    code = body.emit(language, **more)
    assert len(code) > 1000
    with pytest.raises(InputError):
        body.emit(language, **({"prefix": "a"} if more else {"step": 0.1}))


def test_the_header_of_c_compiles(body: ca.System, tmp_path: Path) -> None:
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler")
    (tmp_path / "body.h").write_text(body.emit("c", prefix="body"))
    (tmp_path / "main.c").write_text('#include "body.h"\nint main(void) { return 0; }\n')
    subprocess.run([compiler, "-std=c99", "-Wall", "-Werror", "main.c", "-lm"], cwd=tmp_path, check=True)


def test_languages_that_are_not_there(body: ca.System) -> None:
    with pytest.raises(InputError, match="fortran"):
        body.emit("fortran")
    with pytest.raises(InputError, match="step"):
        body.emit("cuda")
