"""Systems and results as objects: they pickle, compare, print, and show pictures; work can be interrupted."""

from __future__ import annotations

import base64
import contextlib
import copy
import io
import os
import pickle
import re
import signal
import sys
import threading
import time

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest

import coadjoint as ca
from coadjoint import plots


def test_systems_pickle_by_their_text(body: ca.System) -> None:
    body.step([1, 0, 0.5], step=0.1)
    data = pickle.dumps(body)
    assert len(data) < 1000
    for again in [pickle.loads(data), copy.deepcopy(body)]:
        assert again == body and hash(again) == hash(body) and repr(again) == repr(body)
        assert again.identity == body.identity
        np.testing.assert_array_equal(
            again.simulate([1, 0, 0.5], time=1, step=0.1).momentum,
            body.simulate([1, 0, 0.5], time=1, step=0.1).momentum,
        )
    named = ca.System.from_text(body.text, "named")
    assert pickle.loads(pickle.dumps(named)) == body


def test_other_systems_are_not_equal(body: ca.System) -> None:
    other = ca.System("SO3", "x^2", coordinates="x y z")
    assert other != body and other.identity != body.identity and body != 3


def test_reprs_make_the_object_again(body: ca.System) -> None:
    assert eval(repr(body), {"System": ca.System}) == body


def test_runs_pickle_and_compare(body: ca.System) -> None:
    run = body.simulate([2, 0.5, 1], time=1, step=0.1)
    again = pickle.loads(pickle.dumps(run))
    assert again == run and again.largest_drift == run.largest_drift
    assert run != body.simulate([2, 0.5, 1.1], time=1, step=0.1)
    assert "10 steps of 0.1 to time 1, 11 records" in repr(run) and len(run) == 11


def picture(html: str) -> np.ndarray:
    """The pixels of the only picture."""
    (data,) = re.findall(r'<img src="data:image/png;base64,([^"]+)">', html)
    return plt.imread(io.BytesIO(base64.b64decode(data)))


def test_notebooks_show_tables_and_pictures(body: ca.System) -> None:
    shown = picture(body.simulate([2, 0.5, 1], time=100, step=0.1)._repr_html_())
    # Three curves, each of its colour, and no figure left to pyplot.
    for colour in plots._COLOURS[:3]:
        assert (np.abs(shown[..., :3] - matplotlib.colors.to_rgb(colour)).max(axis=-1) < 0.02).sum() > 50
    assert plt.get_fignums() == []
    assert "1/3*x^2" in body._repr_html_() and "SO3" in body._repr_html_()


def test_notebooks_show_the_sphere_of_a_system(body: ca.System) -> None:
    assert picture(body._repr_html_()).shape[:2] == (306, 306)
    # No sphere: no picture; one level only: none either.
    assert "<img" not in ca.System("SE3", "m1^2", coordinates="m1 m2 m3 p1 p2 p3")._repr_html_()
    assert "<img" not in ca.System("SO3", "x^2 + y^2 + z^2", coordinates="x y z")._repr_html_()


def test_frames_have_the_columns_that_calls_read(body: ca.System) -> None:
    frame = body.simulate([2, 0.5, 1], time=1, step=0.1).to_frame()
    assert list(frame.columns[:5]) == ["time", "mu_1", "mu_2", "mu_3", "g_11"] and len(frame) == 11
    assert list(frame.columns[-3:]) == ["spatial_momentum_drift", "casimir_drift", "energy_drift"]


def test_progress_is_told(body: ca.System) -> None:
    told: list[tuple[int, int]] = []
    run = body.simulate([2, 0.5, 1], time=1000, step=0.1, every=1000, progress=lambda *p: told.append(p))
    assert told[-1] == (run.steps, run.steps)
    told.clear()
    body.ensemble(np.ones((10, 3)), time=10, step=0.1, progress=lambda *p: told.append(p))
    assert told[-1] == (1000, 1000)


def test_an_exception_of_the_listener_ends_the_run(body: ca.System) -> None:
    def listener(done: int, total: int) -> None:
        raise OSError("enough")

    with pytest.raises(OSError, match="enough"):
        body.simulate([2, 0.5, 1], time=1e9, step=0.1, every=10**9, progress=listener)


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
@pytest.mark.parametrize("what", ["simulate", "ensemble", "verify"])
def test_control_c_ends_what_takes_long(body: ca.System, what: str) -> None:
    long = body.simulate([2, 0.5, 1], time=10_000, step=0.1)
    work = {
        "simulate": lambda: body.simulate([2, 0.5, 1], time=1e9, step=0.1, every=10**9),
        "ensemble": lambda: body.ensemble(np.ones((2000, 3)), time=1e9, step=0.1),
        "verify": lambda: body.verify(long),
    }[what]
    sent = []

    def interrupt() -> None:
        time.sleep(0.5)
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        work()
        thread.join()
        time.sleep(1)
        pytest.fail("it ended before")
    thread.join()


@pytest.mark.skipif(not os.path.isdir("/proc/self/task"), reason="threads are listed otherwise there")
@pytest.mark.parametrize("model", ["network", "gp"])
def test_nothing_computes_on_after_control_c(body: ca.System, model: str) -> None:
    def computing() -> bool:
        """Whether a thread of the package, or one that it has started, is running or wants to."""
        found = []
        for task in os.listdir("/proc/self/task"):
            with contextlib.suppress(OSError), open(f"/proc/self/task/{task}/stat") as stat:
                found.append(stat.read())
        return any("(coadjoint) R" in line for line in found)

    rows = np.random.default_rng(1).uniform(-1, 1, (4000, 3))
    states = np.hstack([rows, np.tile([1.0, 0, 0, 0], (len(rows), 1))])
    ends = np.asarray(body.ensemble(states, time=0.1, step=0.1))
    thread = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        while True:
            attitudes = (states[:, 3:], ends[:, 3:])
            ca.learn(rows, ends[:, :3], attitudes=attitudes, step=0.1, model=model)
    thread.join()
    # A network takes many minutes.
    quiet = 0
    for _ in range(6000):
        time.sleep(0.01)
        quiet = 0 if computing() else quiet + 1
        if quiet == 30:
            return
    pytest.fail("it computes on")


def test_reading_a_system_lets_other_threads_run() -> None:
    """The longest pause of another thread is no part of the time that reading takes."""
    terms = "+".join(f"mu[{i}]*mu[{j}]/{i + j + 2}" for i in range(150) for j in range(i, 150))
    beats = []
    done = threading.Event()

    def beat() -> None:
        while not done.is_set():
            beats.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=beat)
    thread.start()
    start = len(beats)
    ca.System("SO3^50", terms)
    made = len(beats) - start
    done.set()
    thread.join()
    assert made > 20


def test_threads_run_side_by_side(body: ca.System) -> None:
    """The interpreter is free while steps are made: a thread goes on counting."""
    count = 0
    done = threading.Event()

    def counting() -> None:
        nonlocal count
        while not done.is_set():
            count += 1

    thread = threading.Thread(target=counting)
    thread.start()
    before = count
    body.simulate([2, 0.5, 1], time=200_000, step=0.1, every=10**7)
    after = count
    done.set()
    thread.join()
    assert after - before > 1000
