"""ContactMechanics under comparison: its closed line, by its own solver and by NuMPI's.

Both are Polonsky and Keer's conjugate gradients under a given load. NuMPI comes with
ContactMechanics, and its implementation is often the faster one; that without restarts is slower
and may not end.
"""

import contextlib
import io
from functools import cache

import numpy as np

from comparisons.benchmarks.half_plane_peers.cases import Case
from comparisons.benchmarks.half_plane_peers.code import AbsentError, Answer, Code, decades

SETTLED = 1e-6  # relative change of load and height at the end, as ContactMechanics has it


def codes() -> list[Code]:
    """Raises AbsentError where ContactMechanics is not installed."""
    try:
        import ContactMechanics
        from ContactMechanics.Optimization import constrained_conjugate_gradients
        from NuMPI.Optimization import constrained_conjugate_gradients_with_restart
        from SurfaceTopography import UniformLineScan
    except ImportError as missing:
        raise AbsentError(
            "ContactMechanics is not installed: pip install ContactMechanics"
        ) from missing

    @cache
    def made(count: int, length: float):
        return ContactMechanics.PeriodicFFTElasticHalfSpace((count,), 1.0, (length,))

    def substrate(case: Case):
        return made(case.count, case.pitch * case.count)

    def own(case: Case, tolerance: float, most: int) -> Answer:
        line = UniformLineScan(case.heights, case.pitch * case.count)
        found = constrained_conjugate_gradients(
            substrate(case),
            line,
            external_force=case.load,
            pentol=tolerance * np.ptp(case.heights),
            forcetol=tolerance * case.load,
            thermotol=SETTLED,
            maxiter=most,
        )
        return Answer(found.jac / case.pitch, found.nit)

    def by_numpi(case: Case, tolerance: float, most: int) -> Answer:
        body = substrate(case)
        mean = case.load / case.count
        with contextlib.redirect_stdout(io.StringIO()):  # it prints warnings
            found = constrained_conjugate_gradients_with_restart(
                lambda force: body.evaluate_disp(-force) - case.heights,
                lambda force: body.evaluate_disp(-force),
                np.full(case.count, mean),
                jac=False,
                mean_val=mean,
                gtol=tolerance * np.ptp(case.heights),
                maxiter=most,
            )
        return Answer(found.x / case.pitch, found.nit)

    name = f"ContactMechanics {ContactMechanics.__version__}"
    return [
        Code(name, "point", own, decades(-6, -13)),
        Code(f"{name}, NuMPI", "point", by_numpi, decades(-6, -13)),
    ]
