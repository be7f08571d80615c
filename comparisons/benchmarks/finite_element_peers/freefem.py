"""FreeFEM under comparison: quadratic triangles and a primal-dual active set on their nodes.

The method of its example VI-adap.edp: nodes in contact are held by a large number on the diagonal,
the matrix is factored anew, the residual is the contact's force. CHOLMOD is the fastest of the
solvers that come along (UMFPACK and MUMPS take a quarter more). Its interior-point optimiser IPOPT,
by which its module on Signorini's problem goes, takes twice the time to the same pressures.

Times are FreeFEM's own clock(), processor time from the mesh in memory to the pressures, which are
nodal forces over the nodes' shares of the surface.
"""

from pathlib import Path

import numpy as np

from comparisons.benchmarks.finite_element_peers.process import FailedError, Run, spent
from comparisons.benchmarks.finite_element_peers.task import Answer, Task

HELD, GROUND, OTHER = 1, 2, 3  # labels of the mesh's outer edges
MOST_STEPS = 100
SCRIPT = """
mesh Th = readmesh("mesh.msh");
real young = {young:.17g}, nu = {nu:.17g}, R = {radius:.17g}, d = {approach:.17g};
real[int] amplitude = [{amplitudes}], wave = [{lengths}], phase = [{phases}];
func real gap() {{
    real g = x^2 / (2.0 * R);
    for (int k = 0; k < wave.n; k++)
        g += amplitude[k] * (1.0 - cos(2.0 * pi * x / wave[k] + phase[k]));
    return g;
}}
real lambda = young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), mu = young / (2.0 * (1.0 + nu));
real tgv = 1e30;
macro strain(u, w) [dx(u), dy(w), (dy(u) + dx(w)) / sqrt(2.0)] //
macro volume(u, w) (dx(u) + dy(w)) //
ofstream out("answer.txt");
out.precision(17);
for (int run = 0; run <= {repeats}; run++) {{
    real start = clock();
    fespace Vh(Th, [P2, P2]);
    Vh [u, w];
    varf stiffness([u, w], [v, s]) = int2d(Th, qft=qf2pT)(
        lambda * volume(u, w) * volume(v, s) + 2.0 * mu * (strain(u, w)' * strain(v, s)))
        + on({held}, u=0, w=0);
    varf shares([u, w], [v, s]) = int1d(Th, {ground})(s);
    varf grounds([u, w], [v, s]) = on({ground}, w=1);
    varf leasts([u, w], [v, s]) = on({ground}, w=d - gap());
    varf places([u, w], [v, s]) = on({ground}, w=x);
    real[int] share = shares(0, Vh), ground = grounds(0, Vh, tgv=1);
    real[int] least = leasts(0, Vh, tgv=1), place = places(0, Vh, tgv=1);
    int count = 0, step, changed = 1;
    for (int i = 0; i < Vh.ndof; i++) count += ground[i] > 0.5;
    int[int] contact(count);
    count = 0;
    for (int i = 0; i < Vh.ndof; i++) if (ground[i] > 0.5) contact[count++] = i;
    matrix K = stiffness(Vh, Vh, tgv=tgv, sym=1), K0 = K;
    real[int] diagonal = K.diag, fixed(Vh.ndof), b(Vh.ndof), force(Vh.ndof), active(count);
    for (int k = 0; k < count; k++) active[k] = least[contact[k]] > 0.0;
    for (step = 1; step <= {most}; step++) {{
        fixed = diagonal;
        b = 0.0;
        for (int k = 0; k < count; k++) if (active[k] > 0.5) {{
            int i = contact[k];
            fixed[i] = tgv;
            b[i] = tgv * least[i];
        }}
        K.diag = fixed;
        set(K, solver="CHOLMOD");
        u[] = K^-1 * b;
        force = K0 * u[];
        changed = 0;
        for (int k = 0; k < count; k++) {{
            int i = contact[k];
            if (active[k] < 0.5) force[i] = 0.0;
            real touching = force[i] + young * (least[i] - u[][i]) > 0.0;
            changed += touching != active[k];
            active[k] = touching;
        }}
        if (changed == 0) break;
    }}
    real seconds = clock() - start;
    out << "run " << seconds << " " << step << " " << Vh.ndof << " " << changed << endl;
    if (run == {repeats})
        for (int k = 0; k < count; k++)
            out << place[contact[k]] << " " << force[contact[k]] / share[contact[k]] << endl;
}}
"""


def solve(command: str, task: Task, folder: Path, limit: float) -> Run:
    """The task by FreeFEM, started as `command`; raises FailedError."""
    (folder / "mesh.msh").write_text(mesh_text(task))
    (folder / "contact.edp").write_text(script(task))
    total = spent([command, "-v", "0", "-nw", "contact.edp"], folder, limit)
    answer = parse((folder / "answer.txt").read_text())
    return Run(answer, total - float(answer.seconds[1:].sum()))


def script(task: Task) -> str:
    """The program of one task."""
    waves = task.waves if len(task.waves) else np.array([[0.0, 1.0, 0.0]])
    amplitudes, lengths, phases = (", ".join(f"{v:.17g}" for v in row) for row in waves.T)
    return SCRIPT.format(
        young=task.youngs_modulus,
        nu=task.poissons_ratio,
        radius=task.radius,
        approach=task.approach,
        amplitudes=amplitudes,
        lengths=lengths,
        phases=phases,
        repeats=task.repeats,
        held=HELD,
        ground=GROUND,
        most=MOST_STEPS,
    )


def mesh_text(task: Task) -> str:
    """Vertices, triangles and labelled outer edges in FreeFEM's own format."""
    vertices, corners = task.vertices, task.triangles[:, :3]
    edges = np.sort(corners[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges, uses = np.unique(edges, axis=0, return_counts=True)
    outer = edges[uses == 1]
    middle = vertices[outer].mean(axis=1).T
    label = np.where(task.held(*middle), HELD, np.where(task.touchable(*middle), GROUND, OTHER))
    lines = [f"{len(vertices)} {len(corners)} {len(outer)}"]
    lines += [f"{x:.17g} {z:.17g} 0" for x, z in vertices]
    lines += [f"{a} {b} {c} 0" for a, b, c in corners + 1]
    lines += [f"{a} {b} {c}" for (a, b), c in zip(outer + 1, label, strict=True)]
    return "\n".join(lines) + "\n"


def parse(text: str) -> Answer:
    """The answer in what the program wrote; raises FailedError if the set has not settled."""
    words = [line.split() for line in text.splitlines()]
    heads = [row[1:] for row in words if row[0] == "run"]
    rows = np.array([row for row in words if row[0] != "run"], dtype=float)
    if not heads or not len(rows):
        raise FailedError("FreeFEM wrote no pressures")
    if any(int(changed) for *_, changed in heads):
        raise FailedError(f"the active set has not settled after {MOST_STEPS} steps")
    rows = rows[np.argsort(rows[:, 0])]
    seconds = np.array([float(head[0]) for head in heads])
    return Answer(rows[:, 0], rows[:, 1], seconds, int(heads[-1][2]), int(heads[-1][1]))
