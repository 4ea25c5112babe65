"""The first example, a free rigid body followed for a thousand steps: `python -m coadjoint`."""

import coadjoint as ca

body = ca.System(
    "SO3",
    "x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)",
    coordinates="x y z",
    parameters={"I1": 1.5, "I2": 2, "I3": 2.5},
    name="rigid body",
)
run = body.simulate(momentum=[2, 0.5, 1], time=100, step=0.1)
print(run)
print("momentum at the end:", run.final_momentum)
