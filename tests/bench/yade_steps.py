# SPDX-License-Identifier: BSD-3-Clause
"""For `yade -n -x -j1`: the particles and bonds that `breccia_bench --serve --write FILE` wrote, with Yade's bonded model JCFpm
(no moments, as elastic_brittle), between the same two platens. A line of standard input asks for ten steps; the answer is
`SECONDS` and the processor's time that they took. BENCH_SPECIMEN names the file, BENCH_STEPS the steps.
"""
import json
import os
import sys
import time

with open(os.environ["BENCH_SPECIMEN"]) as file:
    specimen = json.load(file)
steps = specimen["steps"]
rock = O.materials.append(JCFpmMat(type=1, young=10e9, poisson=1 / 3.7, density=2650, tensileStrength=40e6, cohesion=40e6,
                                   frictionAngle=math.atan(0.5)))
steel = O.materials.append(JCFpmMat(type=0, young=10e9, poisson=1 / 3.7, density=2650, frictionAngle=0))
for x, y, z, r in specimen["particles"]:
    O.bodies.append(sphere((x, y, z), r, material=rock))
for height, velocity, sense in ((specimen["bottom"], 0.2, 1), (specimen["top"], -0.2, -1)):
    platen = wall(height, axis=2, sense=sense, material=steel)
    O.bodies.append(platen)
    platen.state.vel = (0, 0, velocity)
stamps = []
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=specimen["skin"]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_JCFpmMat_JCFpmMat_JCFpmPhys()],
                    [Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM()]),
    NewtonIntegrator(damping=0.7),
    PyRunner(command="stamps.append(time.thread_time())", iterPeriod=1),
]
O.dt = specimen["time_step"]
for i, j in specimen["bonds"]:
    createInteraction(i, j)
O.run(2, True)  # the collider sorts, memory is touched
cohesive = sum(1 for i in O.interactions if i.isReal and getattr(i.phys, "isCohesive", False))
print("READY", json.dumps({"yade": yade.config.version, "bonds": cohesive, "particles": len(specimen["particles"])}), flush=True)
for line in sys.stdin:
    stamps.clear()
    O.run(steps + 1, True)
    print("SECONDS", stamps[-1] - stamps[0], flush=True)
