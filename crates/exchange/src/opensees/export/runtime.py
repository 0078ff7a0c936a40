LOAD = {"step": 1.0}  # of static cases


def solver(static):
    """How equations are solved: settings of OpenSees for both kinds of analysis."""
    ops.wipeAnalysis()
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system(SYSTEM)
    ops.test("NormDispIncr", TOLERANCE, 50)
    ops.algorithm("Newton")
    if static:
        ops.integrator("LoadControl", 1.0)
        LOAD["step"] = 1.0
        ops.analysis("Static")
    else:
        if ALPHA == 1.0:
            ops.integrator("Newmark", 0.5, 0.25)
        else:
            ops.integrator("HHT", ALPHA)
        ops.analysis("Transient")


def advance(h, static=False, depth=0):
    """One step of h; one that does not converge is made in halves."""
    for algorithm in ("Newton", "NewtonLineSearch", "KrylovNewton"):
        ops.algorithm(algorithm)
        if static and LOAD["step"] != h:
            ops.integrator("LoadControl", h)
            LOAD["step"] = h
        if (ops.analyze(1) if static else ops.analyze(1, h)) == 0:
            return
    if depth == 14:
        raise SystemExit(f"no equilibrium behind t = {ops.getTime():.6g}")
    advance(h / 2, static, depth + 1)
    advance(h / 2, static, depth + 1)


def static_case(steps):
    """Puts the loads of the last pattern on in equal steps, and keeps them."""
    solver(True)
    for _ in range(steps):
        advance(1.0 / steps, True)
    ops.loadConst("-time", 0.0)


def series(tag, f):
    """A function of time as a series of samples at the steps."""
    h = DT / SUBSTEPS
    ops.timeSeries("Path", tag, "-dt", h, "-values", *[f(i * h) for i in range(STEPS * SUBSTEPS + 2)], "-useLast")


def eigenvalues(count):
    """The lowest squares of circular frequencies; with all matrices full where the model is small."""
    ops.wipeAnalysis()
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system(SYSTEM)
    count = min(count, EQUATIONS)
    if count < 1:
        return []
    return ops.eigen("-fullGenLapack", count) if EQUATIONS <= 600 else ops.eigen(min(count, EQUATIONS - 2))


def disp(node, dof):
    return ops.nodeDisp(node, dof)


def vel(node, dof):
    return ops.nodeVel(node, dof)


def accel(node, dof):
    return ops.nodeAccel(node, dof)


REACTIONS = {}


def take_reactions(nodes):
    """Forces of supports: those of the elements, and where stiffness damps those of Rayleigh's rule."""
    ops.reactions()
    for node in nodes:
        REACTIONS[node] = [ops.nodeReaction(node, dof) for dof in range(1, 7)]
    if RAYLEIGH:
        ops.reactions("-rayleigh")
        for node in nodes:
            REACTIONS[node] = [r + ops.nodeReaction(node, k + 1) for k, r in enumerate(REACTIONS[node])]


def reaction(node, dof):
    return REACTIONS[node][dof - 1]


def stress(element, material):
    return ops.eleResponse(element, "material", str(material), "stress")[0]


def basic(element, i):
    return ops.eleResponse(element, "basicForce")[i]


def end(element, i):
    return (ops.eleResponse(element, "globalForce") or ops.eleResponse(element, "force"))[i]


def local(element, i):
    return ops.eleResponse(element, "localForce")[i]


class Peaks:
    """Extremes over all steps, also those between outputs."""

    def __init__(self):
        self.rows = []

    def see(self, t, values):
        if not self.rows:
            self.rows = [[x, t, x, t, x] for x in values]
        for row, x in zip(self.rows, values):
            if x > row[0]:
                row[0], row[1] = x, t
            if x < row[2]:
                row[2], row[3] = x, t
            row[4] = x


def write(name, head, rows):
    with open(name, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(head)
        writer.writerows(rows)
