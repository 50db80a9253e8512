#!/usr/bin/env python3
# material_body.py N FILE.msh: a bracket of oblique arms as a mesh of straight tetrahedra (Gmsh 2.2), N cells across an arm. Cells of all N fill
# the same body, so that meshes differ in nothing but their cells.
import sys

n, name = int(sys.argv[1]), sys.argv[2]
W, T = 0.05, 0.02  # m: arms 5 cm wide, 2 cm thick; the long one 4, the short one 2 widths beyond the corner
cells = [(i, j, k) for i in range(5 * n) for j in range(3 * n) for k in range(max(1, n // 2)) if j < n or i < n]
kz = max(1, n // 2)
number, points, tets = {}, [], []


def node(i, j, k):
    if (i, j, k) not in number:
        x, y, z = i * W / n, j * W / n, k * T / kz
        number[i, j, k] = len(points) + 1
        points.append((x + 0.23 * y, y + 0.11 * x, z + 0.17 * x - 0.08 * y))  # sheared: no symmetry is left
    return number[i, j, k]


ORDERS = [(0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)]
for i, j, k in cells:
    for number_of, order in enumerate(ORDERS):  # six tetrahedra about the cell's diagonal
        at, corner = [i, j, k], [node(i, j, k)]
        for axis in order:
            at[axis] += 1
            corner.append(node(*at))
        if number_of in (1, 2, 5):
            corner[0], corner[1] = corner[1], corner[0]
        tets.append(corner)
with open(name, "w") as f:
    f.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n" % len(points))
    for i, p in enumerate(points):
        f.write("%d %.17g %.17g %.17g\n" % (i + 1, *p))
    f.write("$EndNodes\n$Elements\n%d\n" % len(tets))
    for i, t in enumerate(tets):
        f.write("%d 4 2 1 1 %d %d %d %d\n" % (i + 1, *t))
    f.write("$EndElements\n")
