"""Matrices of a building of walls and slabs as shells, meshed with Gmsh: `pip install gmsh scipy`.

Five storeys of 12 m by 9 m on a raft and a grid of 10 by 10 bearings; about 110 000 equations.
Writes shells_k.npz, shells_m.npz, shells_rows.csv and shells.ron into the folder where it is run.
"""
import gmsh
import numpy as np
import scipy.sparse as sparse

SIZE, LENGTH, WIDTH, STOREY, STOREYS = 0.275, 12.0, 9.0, 3.0, 5
YOUNG, POISSON, DENSITY = 30e9, 0.2, 2500.0
RAFT, SLAB, WALL = 0.6, 0.25, 0.25

# Rectangles: origin, two edges, thickness. Slabs, then walls from floor to floor, of which the outer ones have openings.
plates = [((0, 0, k * STOREY), (LENGTH, 0, 0), (0, WIDTH, 0), RAFT if k == 0 else SLAB) for k in range(STOREYS + 1)]
up = (0, 0, STOREYS * STOREY)
plates += [((x, y, 0), (3, 0, 0), up, WALL) for x in (0.0, 9.0) for y in (0.0, WIDTH)]
plates += [((x, y, 0), (0, 3, 0), up, WALL) for x in (0.0, LENGTH) for y in (0.0, 6.0)]
plates += [((4.5, 3, 0), (3, 0, 0), up, WALL), ((4.5, 6, 0), (3, 0, 0), up, WALL), ((4.5, 3, 0), (0, 3, 0), up, WALL)]

# The mesh: plates that meet share their nodes, and each is cut into quadrilaterals.
gmsh.initialize()
gmsh.option.setNumber("General.Verbosity", 1)
occ = gmsh.model.occ
surfaces = []
for origin, a, b, _ in plates:
    o, a, b = np.array(origin, float), np.array(a, float), np.array(b, float)
    corners = [occ.addPoint(*p) for p in (o, o + a, o + a + b, o + b)]
    loop = occ.addCurveLoop([occ.addLine(corners[i], corners[(i + 1) % 4]) for i in range(4)])
    surfaces.append((2, occ.addPlaneSurface([loop])))
# Lines of the bearings cut the raft, so that a node is under each crossing.
xs, ys = np.linspace(0, LENGTH, 10), np.linspace(0, WIDTH, 10)
def line(p, q):
    return (1, occ.addLine(occ.addPoint(*p), occ.addPoint(*q)))
cuts = [line((x, 0, 0), (x, WIDTH, 0)) for x in xs[1:-1]] + [line((0, y, 0), (LENGTH, y, 0)) for y in ys[1:-1]]
_, pieces = occ.fragment(surfaces, cuts)
occ.removeAllDuplicates()
occ.synchronize()
for name, value in {
    "MeshSizeMin": SIZE, "MeshSizeMax": SIZE, "Algorithm": 8, "RecombineAll": 1, "RecombinationAlgorithm": 2,
}.items():
    gmsh.option.setNumber(f"Mesh.{name}", value)
gmsh.model.mesh.generate(2)
tags, points, _ = gmsh.model.mesh.getNodes()
points = points.reshape(-1, 3)
number = {tag: i for i, tag in enumerate(tags)}
quads, thickness = [], []
for (_, _, _, t), own in zip(plates, pieces):
    for _, surface in own:
        kinds, _, nodes = gmsh.model.mesh.getElements(2, surface)
        assert list(kinds) == [3], "quadrilaterals alone"
        quads.append(np.array([number[n] for n in nodes[0]]).reshape(-1, 4))
        thickness.append(np.full(len(quads[-1]), t))
quads, thickness = np.vstack(quads), np.concatenate(thickness)
used = np.unique(quads)
place = np.full(len(points), -1)
place[used] = np.arange(len(used))
points, quads = points[used], place[quads]

# Flat shells of four nodes, all at once: membrane in plane stress; plate with shear by the assumed strains of MITC4 (Dvorkin
# and Bathe 1984); rotations about the normal tied to those of the membrane (Hughes and Brezzi 1989), at the centre.
corner = points[quads]
e1 = corner[:, 1] - corner[:, 0]
e1 /= np.linalg.norm(e1, axis=1)[:, None]
e3 = np.cross(corner[:, 2] - corner[:, 0], corner[:, 3] - corner[:, 1])
e3 /= np.linalg.norm(e3, axis=1)[:, None]
frame = np.stack([e1, np.cross(e3, e1), e3], axis=1)
xy = np.einsum("eij,enj->eni", frame, corner - corner[:, :1])[:, :, :2]
R, S = np.array([-1, 1, 1, -1.0]), np.array([-1, -1, 1, 1.0])

def shapes(r, s):
    """Shape functions, their slopes in x and y, the Jacobian and its determinant."""
    n = (1 + R * r) * (1 + S * s) / 4
    slopes = np.array([R * (1 + S * s), S * (1 + R * r)]) / 4
    jacobian = np.einsum("in,enj->eij", slopes, xy)
    return n, np.einsum("eij,jn->ein", np.linalg.inv(jacobian), slopes), jacobian, np.linalg.det(jacobian)

def covariant(r, s, along):
    """Shear strain between the normal and a line of the mesh, at one point: rows of w, rx, ry."""
    n, _, jacobian, _ = shapes(r, s)
    slope = (R * (1 + S * s) if along == 0 else S * (1 + R * r)) / 4
    row = np.zeros((len(xy), 4, 6))
    row[:, :, 2] = slope
    row[:, :, 4] = n * jacobian[:, along, 0, None]
    row[:, :, 3] = -n * jacobian[:, along, 1, None]
    return row

plane = YOUNG / (1 - POISSON**2) * np.array([[1, POISSON, 0], [POISSON, 1, 0], [0, 0, (1 - POISSON) / 2]])
shear = YOUNG / (2 * (1 + POISSON))
k, m = np.zeros((len(quads), 24, 24)), np.zeros((len(quads), 24, 24))
for r in (-(3**-0.5), 3**-0.5):
    for s in (-(3**-0.5), 3**-0.5):
        n, d, jacobian, det = shapes(r, s)
        strain = np.zeros((len(quads), 8, 4, 6))
        strain[:, 0, :, 0] = strain[:, 2, :, 1] = strain[:, 3, :, 4] = d[:, 0]
        strain[:, 1, :, 1] = strain[:, 2, :, 0] = d[:, 1]
        strain[:, 4, :, 3], strain[:, 5, :, 3] = -d[:, 1], -d[:, 0]
        strain[:, 5, :, 4] = d[:, 1]
        edges = np.stack([
            (1 - s) / 2 * covariant(0, -1, 0) + (1 + s) / 2 * covariant(0, 1, 0),
            (1 - r) / 2 * covariant(-1, 0, 1) + (1 + r) / 2 * covariant(1, 0, 1),
        ], axis=1)
        strain[:, 6:] = np.einsum("eij,ejnd->eind", np.linalg.inv(jacobian), edges)
        law = np.zeros((len(quads), 8, 8))
        law[:, :3, :3] = plane * thickness[:, None, None]
        law[:, 3:6, 3:6] = plane * (thickness**3 / 12)[:, None, None]
        law[:, 6, 6] = law[:, 7, 7] = 5 / 6 * shear * thickness
        b = strain.reshape(-1, 8, 24)
        k += np.einsum("epi,epq,eqj,e->eij", b, law, b, det, optimize=True)
        motion = np.zeros((6, 4, 6))
        for direction in range(6):
            motion[direction, :, direction] = n
        motion = motion.reshape(6, 24)
        weight = DENSITY * np.stack([thickness] * 3 + [thickness**3 / 12] * 3, axis=1)
        m += np.einsum("pi,ep,pj,e->eij", motion, weight, motion, det, optimize=True)
n, d, _, det = shapes(0, 0)
turn = np.zeros((len(quads), 4, 6))
turn[:, :, 5], turn[:, :, 0], turn[:, :, 1] = n, d[:, 1] / 2, -d[:, 0] / 2
turn = turn.reshape(-1, 24)
k += np.einsum("ei,ej,e->eij", turn, turn, 4 * det * shear * thickness, optimize=True)
# Turning about the normal that all corners do against the membrane costs nothing at the centre; here it does.
turn = np.zeros(24)
turn[5::6] = [1, -1, 1, -1]
k += np.einsum("i,j,e->eij", turn, turn, det * shear * thickness / 4)

# To global axes, and together.
axes = np.zeros((len(quads), 24, 24))
for block in range(8):
    axes[:, 3 * block:3 * block + 3, 3 * block:3 * block + 3] = frame
rows = (6 * quads[:, :, None] + np.arange(6)).reshape(-1, 24)
size = 6 * len(points)
def assembled(matrix):
    turned = np.einsum("eki,ekl,elj->eij", axes, matrix, axes, optimize=True)
    turned = (turned + turned.transpose(0, 2, 1)) / 2
    at = (np.repeat(rows, 24, axis=1).ravel(), np.tile(rows, 24).ravel())
    return sparse.csr_matrix((turned.ravel(), at), (size, size))
stiffness, mass = assembled(k), assembled(m)
stiffness, mass = (stiffness + stiffness.T) / 2, (mass + mass.T) / 2

# What Trilith reads. Nodes above bearings have names of their own: "b 3 4" is at the grid lines 3 and 4.
names = [str(i + 1) for i in range(len(points))]
nearest = lambda p: int(np.argmin(((points - p) ** 2).sum(axis=1)))
for i, x in enumerate(xs):
    for j, y in enumerate(ys):
        names[nearest((x, y, 0))] = f"b {i} {j}"
for level in range(STOREYS + 1):
    names[nearest((4.5, 6, level * STOREY))] = f"core {level}"
sparse.save_npz("shells_k.npz", stiffness)
sparse.save_npz("shells_m.npz", mass)
ux_mass = float(mass[::6][:, ::6].sum())
with open("shells_rows.csv", "w") as table:
    print("row,node,dof", file=table)
    for i, name in enumerate(names):
        for j, dof in enumerate(("Ux", "Uy", "Uz", "Rx", "Ry", "Rz")):
            print(f"{6 * i + j + 1},{name},{dof}", file=table)
with open("shells.ron", "w") as model:
    model.write(f"""// A building of walls and slabs as shells, {size} equations, on a hundred yielding bearings. Written by shells.py.
(
    title: "Building of walls and slabs on a hundred bearings",
    parameters: {{ "duration": "8 s", "weight": "{ux_mass / 100 * 9.81} N", "k2": "weight/9.81 m/s^2*(2*pi/2.5 s)^2", "uy": "1 cm", "k1": "k2 + 0.05*weight/uy" }},
    nodes: {{
        "b {{i}} {{j}}": For(i: "0 to 9", j: "0 to 9", of: ("i*{LENGTH} m/9", "j*{WIDTH} m/9", 0)),
        "core {{k}}": For(k: "0 to {STOREYS}", of: (4.5, 6, "k*{STOREY} m")),
    }},
    elements: {{
        "building": Superelement(nodes: [For(i: "0 to 9", j: "0 to 9", of: "b {{i}} {{j}}"), For(k: "0 to {STOREYS}", of: "core {{k}}")],
            stiffness: "shells_k.npz", mass: "shells_m.npz", rows: "shells_rows.csv"),
        // On the ground: local 1 is +Z, local 2 is +X, local 3 is +Y.
        "bearing {{i}} {{j}}": For(i: "0 to 9", j: "0 to 9",
            of: RubberIsolator(node: "b {{i}} {{j}}", kv: "0.3 GN/m", k2: "k1", fy2: "k1*uy", ratio2: "k2/k1")),
    }},
    groups: {{ "bearings": ["bearing *"] }},
    damping: Rayleigh(mass: 0.1, stiffness: "0.5 ms"),
    functions: {{ "ground": Sine(amplitude: "2 m/s^2", frequency: "0.8 Hz") }},
    cases: {{ "earthquake": Dynamic(duration: "duration", dt: "5 ms", base: [(direction: X, function: "ground")]) }},
    outputs: {{
        "base": Displacement(node: "b 0 0", dof: Ux),
        "drift": Displacement(terms: ((node: "core {STOREYS}", dof: Ux), (node: "core 0", dof: Ux, factor: -1))),
        "roof": Acceleration(node: "core {STOREYS}", dof: Ux, absolute: true),
        "shear": LinkForce(link: "bearings", axis: U2),
        "bearing": LinkForce(link: "bearing 9 9", axis: U1),
    }},
)
""")
