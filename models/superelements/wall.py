import numpy as np
import scipy.io
import scipy.sparse

WIDTH, HEIGHT, THICKNESS = 3.0, 6.0, 0.3
YOUNG, POISSON, DENSITY = 30e9, 0.2, 2500.0
NX, NZ = 6, 12

# Stiffness of a rectangle in plane stress, four nodes, 2 × 2 points.
a, b = WIDTH / NX, HEIGHT / NZ
law = YOUNG / (1 - POISSON**2) * np.array([[1, POISSON, 0], [POISSON, 1, 0], [0, 0, (1 - POISSON) / 2]])
sx, sz = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
k = np.zeros((8, 8))
for x in (-(3**-0.5), 3**-0.5):
    for z in (-(3**-0.5), 3**-0.5):
        strain = np.zeros((3, 8))
        strain[0, 0::2] = strain[2, 1::2] = sx * (1 + sz * z) / (2 * a)
        strain[1, 1::2] = strain[2, 0::2] = sz * (1 + sx * x) / (2 * b)
        k += strain.T @ law @ strain * THICKNESS * a * b / 4

# All rectangles; rows Ux and Uz of node after node.
node = lambda i, j: i * (NZ + 1) + j
count = 2 * (NX + 1) * (NZ + 1)
stiffness, mass = scipy.sparse.lil_matrix((count, count)), np.zeros(count)
for i in range(NX):
    for j in range(NZ):
        corners = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]
        rows = [2 * n + d for n in corners for d in (0, 1)]
        stiffness[np.ix_(rows, rows)] += k
        mass[rows] += DENSITY * THICKNESS * a * b / 4

# What Trilith reads: two matrices, and what their rows are.
scipy.io.mmwrite("wall_k.mtx", scipy.sparse.coo_matrix(stiffness), symmetry="symmetric", precision=11)
scipy.io.mmwrite("wall_m.mtx", scipy.sparse.coo_matrix(np.diag(mass)), symmetry="symmetric", precision=11)
with open("wall_rows.csv", "w") as table:
    print("row,node,dof", file=table)
    for n in range(count // 2):
        for d, dof in enumerate(("Ux", "Uz")):
            print(f"{2 * n + d + 1},{n + 1},{dof}", file=table)
