"""For mypy and pyright, not to be run: what they must accept, and what they must find."""

from fractions import Fraction

import numpy as np

import coadjoint as ca
from coadjoint import cluster, plots

body = ca.System("SO3", "x^2/3 + y^2/4 + z^2/5", coordinates=["x", "y", "z"], parameters={"a": 1.0})
run = body.simulate([2.0, 0.5, 1.0], time=10.0, step=0.1)
drift: float = float(run.largest_drift.energy)
end = run.momentum[-1]
final = body.ensemble(np.ones((10, 3)), time=1.0, step=0.1)
for failure in final.failed:
    reason: str = failure.reason
mu, g = body.step([1, 2, 3], step=0.1)
model = ca.learn(np.ones((10, 3)), np.ones((10, 3)), step=0.1)
error = model.summary["train"]["max_error"]
for law in body.check():
    name: str = law.name
print(body.series(3), body.verify(run).text, body.verify(final, {"mu_1": [1.0]}))
run.plot("drift").savefig("x.png")
plots.orbit(run, body)
rows: int = cluster.run(body, states="a.parquet", out="b", time=1, step=0.1).rows
ca.cluster.check("a")
body.simulate([1, 2, 3], time=np.float64(1), step=np.float32(0.1), group_element=run.quaternion()[0])
body.simulate({"x": 2, "y": 0.5, "z": 1}, time=Fraction(1, 2), step=np.array(0.1), backend="jit")
body.simulate([1, 2, 3], time="100", step=0.1)  # error
body.simulate([1, 2, 3], t=100, step=0.1)  # error
body.simulate({1: 2}, time=100, step=0.1)  # error
body.simulate([1, 2, 3], time=1, backend="gpu")  # error
ca.cluster.join("a", "b")  # error
cluster.run(body, states="a.npy", out="b", backend="gpu")  # error
