"""Lattices: the motion of ordinary systems, tables, and refusals."""

import numpy as np
import pytest

import coadjoint as ca


def test_a_ring_moves_as_a_product_of_groups() -> None:
    start = np.array([[np.cos(i), np.sin(2 * i), 0.5] for i in range(4)])
    weights = [0.3, -0.2, 0.5, 0.1]
    coupling = np.array([[1, 0.2, 0], [0, 1, 0.3], [0.1, 0, 0.8]])
    ring = ca.System.lattice([4], bonds={(1,): coupling}, site="D[0]*z^2 - 0.1*x", parameters=dict(D=weights))
    run = ring.simulate(start, time=1, step=0.02, truncation=7)
    x = [f"{name}[{{}}]" for name in "xyz"]
    pairs = [
        f"{float(coupling[a, b])!r}*{x[a].format(i)}*{x[b].format((i + 1) % 4)}"
        for i in range(4)
        for a in range(3)
        for b in range(3)
    ]
    sites = [f"0.3*z[{i}]^2 - 0.1*x[{i}]" for i in range(4)]
    whole = ca.System("SO3^4", " + ".join(pairs + sites), coordinates="x y z", method="collocation", truncation=9)
    expected = whole.simulate(start.ravel(), time=1, step=0.02).momentum[-1]
    assert np.abs(run.spins.ravel() - expected).max() < 1e-10
    assert run.magnetisation.shape == (51, 3) and np.allclose(run.magnetisation[0], start.mean(axis=0))


def test_tables_are_given_as_arrays() -> None:
    weights = np.linspace(-1, 1, 60)
    cube = ca.System.lattice([3, 4, 5], bonds={(1, 0, 0): "-dot(a, b)"}, site="D*z^2", parameters=dict(D=weights))
    start = np.random.default_rng(1).standard_normal((60, 3))
    run = cube.simulate(start, time=0.5, step=0.1, splitting="bonds")
    on = start.reshape(3, 4, 5, 3)
    energy = (weights * start[:, 2] ** 2).sum() - (on * np.roll(on, -1, axis=0)).sum()
    assert run.energy[0] == pytest.approx(energy, rel=1e-14)
    kagome = ca.System.lattice([3, 3], kind="kagome", bonds={((0, 0), 0, 1): "dot(a, b)^2"})
    assert kagome.simulate("random", time=0.2, step=0.1).method == "collocation, order 6"
    graph = ca.System.lattice(edges=[(0, 1), (1, 2), (0, 2)], bonds={None: np.eye(3)})
    assert graph.simulate(np.eye(3), tolerance=1e-8, time=1).estimated_error < 1e-8


def test_damping_and_velocity_are_those_of_ordinary_systems() -> None:
    start = np.array([[np.cos(i), np.sin(2 * i), 0.5] for i in range(3)])
    ring = ca.System.lattice(
        [3], bonds={(1,): np.eye(3)}, damping=[0.1, 0.2, 0.3], velocity=["c*y", "0.1*omega[2] - c*x", "cos(t)"], parameters=dict(c=0.2)
    )
    run = ring.simulate(start, time=1, step=0.05, truncation=7)
    pairs = " + ".join(f"{x}[{i}]*{x}[{(i + 1) % 3}]" for i in range(3) for x in "xyz")
    velocity = [text for i in range(3) for text in (f"0.2*y[{i}]", f"0.1*omega[{3 * i + 2}] - 0.2*x[{i}]", "cos(t)")]
    whole = ca.System("SO3^3", pairs, coordinates="x y z", damping=[0.1, 0.2, 0.3], velocity=velocity, truncation=7)
    expected = whole.simulate(start.ravel(), time=1, step=0.05).momentum[-1]
    assert run.method == "collocation, order 8"
    assert np.abs(run.spins.ravel() - expected).max() < 1e-9
    with pytest.raises(ca.InputError, match="damping or a velocity acts beside it"):
        ring.simulate(start, time=1, step=0.05, splitting="bonds")


def test_mistakes_are_refused_in_words() -> None:
    ring = ca.System.lattice([4], bonds={(1,): "dot(a, b)"})
    with pytest.raises(ca.InputError, match="the lattice 4 sites"):
        ring.simulate(np.zeros((3, 3)), time=1, step=0.1)
    with pytest.raises(ca.InputError, match="unknown variable `c"):
        ca.System.lattice([4], bonds={(1,): "c.x"}).simulate("random", time=1, step=0.1)
    with pytest.raises(ca.InputError, match="neither an offset nor"):
        ca.System.lattice([4], bonds={((1,), 0): "a.x*b.x"})
