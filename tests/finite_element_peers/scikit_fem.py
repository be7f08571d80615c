"""scikit-fem under comparison: quadratic triangles and a primal-dual active set on their nodes.

On the active nodes u_z = d - g0 is condensed out, the residual force there is the contact's, and
nodes change sides by force + E (overlap) > 0 (Hintermueller, Ito and Kunisch 2002, SIAM J. Optim.
13, 865-888), the semismooth Newton method of scikit-fem's own contact examples, until none does.

Linear systems by scipy's SuperLU, ordered for a symmetric pattern and without pivoting: what
scikit-fem takes by itself, `scipy.sparse.linalg.spsolve`, orders for unsymmetric ones and is
slower. Pressures are nodal forces over the nodes' shares of the surface.
"""

from importlib import import_module

import numpy as np

from tests.finite_element_peers import task as benchmark
from tests.harness import AbsentError

MOST_STEPS = 100


def check_installed() -> None:
    """Raises AbsentError."""
    try:
        import_module("skfem")
    except ImportError as missing:
        raise AbsentError("scikit-fem is not installed: pip install scikit-fem") from missing


def solve(task: benchmark.BlockTask) -> benchmark.BlockAnswer:
    """Raises FailedError if the active set does not settle."""
    from scipy.sparse.linalg import splu
    from skfem import Basis, ElementTriP2, ElementVector, FacetBasis, LinearForm, MeshTri
    from skfem.models.elasticity import lame_parameters, linear_elasticity

    element = ElementVector(ElementTriP2())
    corners = task.mesh.triangles[:, :3]
    vertices = task.mesh.points[: 1 + corners.max()]
    mesh = MeshTri(np.ascontiguousarray(vertices.T), corners.T.copy())
    basis = Basis(mesh, element, intorder=2)
    lame = lame_parameters(benchmark.MATERIAL.youngs_modulus, benchmark.MATERIAL.poissons_ratio)
    stiffness = linear_elasticity(*lame).assemble(basis)
    place = basis.doflocs
    vertical = np.zeros(basis.N, dtype=bool)
    vertical[basis.nodal_dofs[1]] = vertical[basis.facet_dofs[1]] = True
    free = ~task.fixed(*place)
    contact = np.flatnonzero(vertical & task.touchable(*place))
    facets = mesh.facets_satisfying(lambda x: task.touchable(*x))
    top = FacetBasis(mesh, element, facets=facets, intorder=2)
    share = LinearForm(lambda v, _: v[1]).assemble(top)[contact]
    least = task.approach - benchmark.gap(place[0, contact])

    active = least > 0.0
    for _ in range(MOST_STEPS):
        u = np.zeros(basis.N)
        u[contact[active]] = least[active]
        inner = free.copy()
        inner[contact[active]] = False
        inner = np.flatnonzero(inner)
        rows = stiffness[inner]
        factor = splu(
            rows[:, inner].tocsc(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
        u[inner] = factor.solve(-(rows @ u))
        force = np.where(active, stiffness[contact] @ u, 0.0)
        touching = force + benchmark.MATERIAL.youngs_modulus * (least - u[contact]) > 0.0
        if np.array_equal(touching, active):
            return benchmark.BlockAnswer(float((force / share).max()), basis.N)
        active = touching
    raise benchmark.FailedError(f"the active set has not settled after {MOST_STEPS} steps")
