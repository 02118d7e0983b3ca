"""A turning drum of discs in Yade: spheres kept in a plane, with a disc's mass and inertia; SI, per meter of depth.

Run by yade, which reads `case.json` in the folder it is started in, and `state.txt` beside it: x, y, vx, vy, spin. The
rim is a polygon, the baffles are segments; each is one long triangle whose cut with the plane is the segment.
"""

import json
import math
import os
import time

with open("case.json") as file:
    case = json.load(file)
with open("state.txt") as file:
    state = [tuple(map(float, line.split())) for line in file]

RADIUS, BUNDLE = case["radius"], case["diameter"] / 2.0
MASS = case["density"] * math.pi * BUNDLE**2
# Corners lie as far outside of the circle as the middles of the sides lie inside.
SIDES = case["sides"]
CORNER = RADIUS / math.sqrt(math.cos(math.pi / SIDES))


def drum_value(pair, wall):
    """Return the drum's number: Yade puts two materials in series, a b / (a + b), and a bundle has twice the pair's."""
    return 2.0 * pair * wall / (2.0 * pair - wall)


angle = math.atan(case["friction"])
pair, wall = case["pair"], case["wall"]
O.materials.append(
    ViscElMat(
        kn=2.0 * pair["stiffness"],
        ks=2.0 * pair["stiffness"],
        cn=2.0 * pair["damping"],
        cs=0.0,
        frictionAngle=angle,
        density=case["density"],
        label="bundle",
    )
)
stiffness = drum_value(pair["stiffness"], wall["stiffness"])
O.materials.append(
    ViscElMat(
        kn=stiffness,
        ks=stiffness,
        cn=drum_value(pair["damping"], wall["damping"]),
        cs=0.0,
        frictionAngle=angle,
        density=case["density"],
        label="drum",
    )
)


def segment(a, b):
    """Return a triangle that cuts the plane in the segment from a to b."""
    depth = 0.3 * RADIUS
    return facet([(*a, 0.0), (*b, depth), (*b, -depth)], material="drum", fixed=True)


corners = [
    (CORNER * math.cos(t), CORNER * math.sin(t))
    for t in (2.0 * math.pi * k / SIDES for k in range(SIDES + 1))
]
walls = [segment(a, b) for a, b in zip(corners, corners[1:])]
walls += [segment(a, b) for line in case["baffles"] for a, b in zip(line, line[1:])]
walls = O.bodies.append(walls)

bundles = []
for x, y, u, v, spin in state:
    body = sphere((x, y, 0.0), BUNDLE, material="bundle")
    body.state.mass = MASS
    body.state.inertia = (0.5 * MASS * BUNDLE**2,) * 3
    body.state.blockedDOFs = "zXY"
    body.state.vel, body.state.angVel = (u, v, 0.0), (0.0, 0.0, spin)
    bundles.append(O.bodies.append(body))

O.engines = [
    ForceResetter(),
    InsertionSortCollider(
        [Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()], verletDist=0.35 * BUNDLE, avoidSelfInteractionMask=0
    ),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()],
        [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
        [Law2_ScGeom_ViscElPhys_Basic()],
    ),
    RotationEngine(
        ids=walls,
        rotateAroundZero=True,
        zeroPoint=(0, 0, 0),
        rotationAxis=(0, 0, 1),
        angularVelocity=case["omega"],
    ),
    NewtonIntegrator(damping=0, gravity=(0, -9.81, 0)),
]
O.dt = case["time_step"]


def row():
    """Return the step, the center of mass and the angular momentum per mass."""
    x = y = momentum = 0.0
    for k in bundles:
        state = O.bodies[k].state
        x, y = x + state.pos[0], y + state.pos[1]
        orbital = state.pos[0] * state.vel[1] - state.pos[1] * state.vel[0]
        momentum += orbital + 0.5 * BUNDLE**2 * state.angVel[2]
    return O.iter, x / len(bundles), y / len(bundles), momentum / len(bundles)


if case["trace"]:
    with open("rows.txt", "w") as rows:
        for _ in range(case["timed"] // case["sample"] + 1):
            rows.write(" ".join(f"{value:.10g}" for value in row()) + "\n")
            O.run(case["sample"], True)
else:
    O.run(case["settle"], True)
    print(f"BEGAN:{time.time():.6f}")
    O.run(case["timed"], True)
    print(f"ENDED:{time.time():.6f}", flush=True)
# The interpreter's own end crashes now and then.
os._exit(0)
