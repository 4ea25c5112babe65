"""Input of users is taken at its word: names of columns, units, rotations, symbols."""

from __future__ import annotations

import copy
import pickle
import warnings

import astropy.units
import numpy as np
import pandas
import pint
import pyarrow
import pytest
import sympy
from scipy.spatial.transform import Rotation

import coadjoint as ca
from coadjoint import CoadjointWarning, InputError

NAMES = ["mu_1", "mu_2", "mu_3"]
MOMENTA = np.array([[2, 0.5, 1], [1, -0.5, 2]])
ONCE = {"time": 1, "step": 0.1}


@pytest.fixture
def frame() -> pandas.DataFrame:
    """Momenta and attitudes, in an order that is not that of rows."""
    turned = Rotation.from_rotvec([[0.1, 0.2, 0.3], [1, 0, -1]]).as_quat()
    return pandas.DataFrame(np.hstack([turned, MOMENTA]), columns=["q_x", "q_y", "q_z", "q_w", *NAMES])


def test_tables_go_by_the_names_of_their_columns(body: ca.System, frame: pandas.DataFrame) -> None:
    wxyz = frame[["q_w", "q_x", "q_y", "q_z"]].to_numpy()
    expected = body.ensemble(np.hstack([MOMENTA, wxyz]), **ONCE)
    own = frame.rename(columns=dict(zip(NAMES, "xyz", strict=True)))
    record = np.rec.fromarrays(frame.to_numpy().T, names=list(frame.columns))
    for table in [frame, frame[frame.columns[::-1]], own, frame.to_dict("list"), record, pyarrow.table(frame)]:
        np.testing.assert_array_equal(body.ensemble(table, **ONCE), expected)
    assert body.verify(expected, frame)
    np.testing.assert_array_equal(body.ensemble(frame[NAMES[::-1]], **ONCE), body.ensemble(MOMENTA, **ONCE))
    np.testing.assert_array_equal(body.ensemble(pandas.DataFrame(MOMENTA), **ONCE), body.ensemble(MOMENTA, **ONCE))


def test_single_states_go_by_their_names(body: ca.System, frame: pandas.DataFrame) -> None:
    expected = body.simulate(MOMENTA[0], group_element=Rotation.from_rotvec([0.1, 0.2, 0.3]), **ONCE)
    for state in [frame.iloc[0], frame.iloc[0].to_dict(), frame.iloc[0][::-1]]:
        run = body.simulate(state, **ONCE)
        np.testing.assert_allclose(run.group_element, expected.group_element, rtol=0, atol=1e-15)
        np.testing.assert_array_equal(body.step(state, step=0.1)[0], body.step(MOMENTA[0], step=0.1)[0])
    end = body.simulate(pandas.Series(MOMENTA[0][::-1], index=["z", "y", "x"]), **ONCE).final_momentum
    np.testing.assert_array_equal(end, expected.final_momentum)
    with pytest.raises(InputError, match="columns of the attitude, and group_element"):
        body.simulate(frame.iloc[0], group_element=np.eye(3), **ONCE)
    with pytest.raises(InputError, match="column mu_1 is missing"):
        body.simulate({"a": 1, "b": 2, "c": 3}, **ONCE)


def test_columns_that_nobody_uses_are_told(body: ca.System) -> None:
    table = pandas.DataFrame(MOMENTA, columns=NAMES).assign(a=1, b=0, c=0, name="first")
    with pytest.warns(CoadjointWarning, match="states: nothing is done with the columns a, b, c, name"):
        assert body.ensemble(table, **ONCE).columns == NAMES
    with pytest.warns(CoadjointWarning, match="the columns a, b, c, name"):
        body.simulate(table.iloc[0], **ONCE)
    with pytest.raises(InputError, match="besides the 3 of the momentum need names"):
        body.ensemble(pandas.DataFrame(np.hstack([MOMENTA, [[1, 0, 0, 0]] * 2])), **ONCE)
    with pytest.raises(InputError, match="column mu_1 is there twice"):
        body.ensemble(table[["mu_1", *NAMES]], **ONCE)


def test_columns_named_after_parameters_vary_them(body: ca.System) -> None:
    frame = pandas.DataFrame(MOMENTA, columns=NAMES)
    ends = body.ensemble(frame.assign(I1=[1.5, 1.75]), **ONCE)
    assert ends.columns == NAMES
    np.testing.assert_allclose(ends[0], body.ensemble(MOMENTA, **ONCE)[0], rtol=0, atol=1e-13)
    assert np.abs(ends[1] - body.ensemble(MOMENTA, **ONCE)[1]).max() > 1e-3
    with pytest.warns(CoadjointWarning, match="1 of 2 rows have no end state and are NaN; the first is row 1, with I1 = 0"):
        assert np.isnan(body.ensemble(frame.assign(I1=[1.5, 0]), **ONCE)[1]).all()
    with pytest.warns(CoadjointWarning, match="the first is row 0, I1 is NaN"):
        body.ensemble(frame.assign(I1=[np.nan, 1]), **ONCE)
    with pytest.raises(InputError, match="column i1 is no parameter of the system: did you mean I1"):
        body.ensemble(frame.assign(i1=[1, 2]), **ONCE)
    with pytest.raises(InputError, match="column I1 is a parameter of the system"):
        body.simulate(frame.assign(I1=[1, 2]).iloc[0], **ONCE)


@pytest.mark.parametrize(("group", "count"), [("SO3", 3), ("SE3", 6), ("SO3^2", 6), ("SO3*SO2", 4)])
def test_frames_of_runs_are_read_by_all_calls(group: str, count: int) -> None:
    squares = " + ".join(f"mu[{i}]^2/{i + 3}" for i in range(count))
    system = ca.System(group, squares)
    start = np.linspace(0.3, 0.9, count)
    frame = system.simulate(start, time=2, step=0.1).to_frame()
    half = system.simulate(start, time=1, step=0.1)
    with pytest.warns(CoadjointWarning, match="time, energy, spatial_momentum_drift"):
        rest = system.simulate(frame.iloc[10], **ONCE)
    assert np.abs(rest.momentum[-1] - frame[[f"mu_{i + 1}" for i in range(count)]].iloc[-1]).max() < 1e-13
    assert np.abs(rest.group_element[0] - half.final_group_element).max() < 1e-15
    with pytest.warns(CoadjointWarning, match="time, energy"):
        ends = system.ensemble(frame, **ONCE)
    np.testing.assert_allclose(ends[10, :count], rest.final_momentum, rtol=0, atol=1e-13)
    if group == "SO3":
        with pytest.warns(CoadjointWarning, match="data: nothing is done with the columns time"):
            model = ca.learn(frame.iloc[:-1], frame.iloc[1:], step=0.1, degree=2, tolerance=1e-9)
        assert model.attitude
        np.testing.assert_array_equal(
            model.simulate(pandas.Series(start[::-1], index=NAMES[::-1]), time=1).momentum,
            model.simulate(start, time=1).momentum,
        )


@pytest.mark.parametrize("quantity", [astropy.units.Quantity, pint.UnitRegistry().Quantity], ids=["astropy", "pint"])
def test_quantities_are_converted_or_refused(quantity) -> None:
    energy = dict(group="SO3", hamiltonian="x^2/3 + y^2/4 + z^2/5", coordinates="x y z")
    body = ca.System(**energy, units={"time": "s", "momentum": "1e-3 N m s"})
    minute, second = quantity(1, "min"), quantity(100, "ms")
    given = quantity(MOMENTA[0] / 1000, "kg m^2 / s")
    expected = body.simulate(MOMENTA[0], time=60, step=0.1)
    for start in [given, list(given), {name: given[i] for i, name in enumerate("xyz")}]:
        np.testing.assert_allclose(body.simulate(start, time=minute, step=second).momentum, expected.momentum)
    np.testing.assert_allclose(body.step(given, step=second)[0], expected.momentum[1])
    np.testing.assert_allclose(body.simulate(given, time=minute, step=second, at=quantity([0.5, 1], "min")).time, [30, 60])
    many = quantity(MOMENTA / 1000, "kg m^2 / s")
    np.testing.assert_allclose(
        body.ensemble(many, time=quantity(1, "s"), step=second), body.ensemble(MOMENTA, **ONCE)
    )
    made = ca.System(**energy, units={"time": "s", "momentum": "1e-3 N m s"}, momentum=given, time=minute, step=second)
    np.testing.assert_allclose(made.simulate().momentum, expected.momentum)
    bare = ca.System(**energy)
    for call in [
        lambda: body.simulate(given, time=quantity(1, "m"), step=0.1),
        lambda: body.simulate(quantity([1, 2, 3], "N"), time=1, step=0.1),
        lambda: body.ensemble(quantity(np.ones((1, 7)), "N m s"), time=1, step=0.1),
        lambda: body.simulate(MOMENTA[0], time=1, step=0.1, group_element=quantity(np.eye(3), "m")),
        lambda: bare.simulate(MOMENTA[0], time=minute, step=0.1),
        lambda: bare.simulate(given, time=1, step=0.1),
        lambda: ca.System(**energy, parameters={"a": quantity(1, "kg")}),
        lambda: ca.learn(many, MOMENTA, step=0.1),
    ]:
        with pytest.raises(InputError, match="is in |need names"):
            call()


def test_coordinates_may_have_units_of_their_own() -> None:
    quantity = pint.UnitRegistry().Quantity
    units = {"momentum": "kg m^2/s", "u": "m", "v": "m", "w": "m"}
    body = ca.System("SE3", "x^2 + y^2/2 + u^2", coordinates="x y z u v w", units=units)
    start = [quantity(1000, "g m^2/s"), 2, 3, quantity(100, "cm"), 1, 2]
    np.testing.assert_allclose(body.simulate(start, **ONCE).momentum[0], [1, 2, 3, 1, 1, 2])
    with pytest.raises(InputError, match="units of their own"):
        body.simulate(quantity(np.ones(6), "m"), **ONCE)


def test_symbols_come_back_with_their_assumptions() -> None:
    x, y, z = sympy.symbols("x y z", real=True)
    energy = x**2 / 3 + y**2 / 4 + z**2 / 5
    for system in [
        ca.System("SO3", energy, coordinates=[x, y, z]),
        ca.System("SO3", energy, coordinates="x y z"),
        pickle.loads(pickle.dumps(ca.System("SO3", energy, coordinates=iter([x, y, z])))),
    ]:
        assert sympy.diff(system.hamiltonian, x) == 2 * x / 3 and system.hamiltonian == energy
        assert system.series(3).subs({x: 1, y: 1, z: 1}).is_Rational
        assert system.casimirs()[0] == x**2 + y**2 + z**2
    with pytest.raises(InputError, match="two symbols are called x"):
        ca.System("SO3", energy, coordinates=sympy.symbols("x y z"))


def test_rotations_go_in_and_come_out(body: ca.System) -> None:
    turned = Rotation.from_rotvec([0.3, -1, 2])
    wxyz = turned.as_quat()[[3, 0, 1, 2]]
    expected = body.simulate(MOMENTA[0], group_element=turned.as_matrix(), **ONCE)
    names = pandas.Series(turned.as_quat(), index=["q_x", "q_y", "q_z", "q_w"])
    for element in [turned, wxyz, list(-wxyz), names]:
        run = body.simulate(MOMENTA[0], group_element=element, **ONCE)
        np.testing.assert_allclose(run.group_element, expected.group_element, rtol=0, atol=1e-14)
        np.testing.assert_allclose(body.step(MOMENTA[0], element, step=0.1)[1], expected.group_element[1], atol=1e-14)
    own = ca.System.from_text(body.text)
    own = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates="x y z", group_element=turned, momentum=MOMENTA[0])
    np.testing.assert_allclose(own.simulate(**ONCE).group_element[0], turned.as_matrix(), atol=1e-14)
    for element, said in [(2 * wxyz, "has the length 1"), (wxyz[:3], "3 rows"), ({"q_w": 1}, "q_w, q_x, q_y and q_z")]:
        with pytest.raises(InputError, match=said):
            body.simulate(MOMENTA[0], group_element=element, **ONCE)
    long = body.simulate(MOMENTA[0], group_element=turned, time=30, step=0.1)
    found = long.quaternion()
    np.testing.assert_allclose(np.roll(found, -1, axis=1), long.quaternion(scalar_first=False))
    matrices = Rotation.from_quat(long.quaternion(scalar_first=False)).as_matrix()
    np.testing.assert_allclose(matrices, long.group_element, rtol=0, atol=1e-13)
    assert (np.einsum("ni,ni->n", found[1:], found[:-1]) > 0.9).all() and found[0, 0] >= 0
    pair = ca.System("SO3^2", "sum(i, 0..2, x[i]^2)", coordinates="x y z").simulate(np.ones(6), **ONCE)
    assert pair.quaternion().shape == (11, 2, 4)
    with pytest.raises(InputError, match="no element of the group"):
        ca.System("SL2", "mu[0]^2").simulate([0.1, 0, 0], **ONCE).quaternion()


def test_the_angular_velocity_is_that_of_the_attitude(body: ca.System) -> None:
    run = body.simulate(MOMENTA[0], time=0.02, step=0.01, truncation=9)
    np.testing.assert_allclose(run.angular_velocity, run.momentum / [1.5, 2, 2.5], rtol=1e-14)
    turn = Rotation.from_matrix(run.group_element[0].T @ run.group_element[2]).as_rotvec() / 0.02
    np.testing.assert_allclose(turn, run.angular_velocity[1], atol=1e-3)
    assert pickle.loads(pickle.dumps(run)).angular_velocity.shape == (3, 3)


def test_copies_of_states_know_what_parts_do_not(body: ca.System) -> None:
    final = body.ensemble(MOMENTA, **ONCE)
    for same in [final.copy(), copy.copy(final), copy.deepcopy(final), pickle.loads(pickle.dumps(final))]:
        assert (same.failed, same.steps, same.columns) == ([], 10, NAMES) and body.verify(same, MOMENTA)
    for part in [final[:1], final[::-1], final[0], final.T]:
        with pytest.raises(AttributeError, match="belongs to the whole ensemble"):
            part.failed
    with pytest.raises(InputError, match="verify the whole one"):
        body.verify(final[:1], MOMENTA[:1])
    assert final[:1].ok.all() and not hasattr(final, "nonsense")


def test_arrays_of_other_packages_warn_of_nothing(body: ca.System, frame: pandas.DataFrame) -> None:
    with warnings.catch_warnings(action="error"):
        body.ensemble(frame, **ONCE)
        body.simulate(frame[NAMES].iloc[0], **ONCE)
