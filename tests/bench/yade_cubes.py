# A thousand packed cubes in Yade (Debian 2023.02a), polyhedra with a penalty on the volume of overlap: the scene of
# packed-cubes-10.3dd. Run by bench_ratios: RESULT=file yade -n -x -j1 yade_cubes.py; writes seconds of
# processor time per step, and how many pairs of boxes meet.
import math
import os
import time

from yade import polyhedra_utils

along, overlap, steps = 10, 1e-4, 3
material = PolyhedraMat(density=2600, young=1e9, poisson=0.5, frictionAngle=math.radians(30))
O.materials.append(material)


def box(low, high, fixed):
    half = [0.5 * (h - l) + 0.5 * overlap for l, h in zip(low, high)]
    corners = [(a * half[0], b * half[1], c * half[2]) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
    body = polyhedra_utils.polyhedra(material, v=corners, fixed=fixed)
    body.state.pos = Vector3(*[0.5 * (l + h) for l, h in zip(low, high)])
    O.bodies.append(body)


n = along
for low, high in [((-1, -1, -1), (n + 1, n + 1, 0)), ((-1, -1, 0), (0, n + 1, n + 2)), ((n, -1, 0), (n + 1, n + 1, n + 2)),
                  ((0, -1, 0), (n, 0, n + 2)), ((0, n, 0), (n, n + 1, n + 2))]:
    box(low, high, True)
for k in range(n):
    for j in range(n):
        for i in range(n):
            box((i, j, k), (i + 1, j + 1, k + 1), False)

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Polyhedra_Aabb()], verletDist=0.005),
    InteractionLoop([Ig2_Polyhedra_Polyhedra_PolyhedraGeom()], [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                    [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]),
    NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81)),
]
O.dt = 1e-4
O.run(3, True)
start = time.process_time()
O.run(steps, True)
with open(os.environ['RESULT'], 'w') as result:
    result.write('%.9g %d\n' % ((time.process_time() - start) / steps, len(list(O.interactions.all()))))
