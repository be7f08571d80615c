"""Scalars made of the in-plane stresses, against the eigenvalues of the stress tensor."""

import numpy as np
import pytest

from analytic.stress_state import StressState


def tensors(stress: StressState, poissons_ratio: float) -> np.ndarray:
    tensor = np.zeros((stress.sx.size, 3, 3))
    tensor[:, 0, 0], tensor[:, 1, 1], tensor[:, 2, 2] = stress.sx, stress.sz, stress.sy(0.0)
    tensor[:, 0, 1] = tensor[:, 1, 0] = stress.txz
    tensor[:, 2, 2] = poissons_ratio * (stress.sx + stress.sz)
    return tensor


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.4999])
def test_scalars_of_random_tensors(nu):
    rng = np.random.default_rng(11)
    stress = StressState(*rng.standard_normal((3, 50)) * 1e9)
    tensor = tensors(stress, nu)
    in_plane = np.linalg.eigvalsh(tensor[:, :2, :2])
    largest = 0.5 * (in_plane[:, 1] - in_plane[:, 0])
    np.testing.assert_allclose(stress.tau1, largest, rtol=0, atol=1e-5)
    np.testing.assert_allclose(stress.sy(nu), tensor[:, 2, 2], rtol=1e-14)
    deviator = tensor - np.trace(tensor, axis1=1, axis2=2)[:, None, None] / 3.0 * np.eye(3)
    expected = np.sqrt(1.5 * np.sum(deviator**2, axis=(1, 2)))
    np.testing.assert_allclose(stress.von_mises(nu), expected, rtol=1e-13)


def test_shapes_must_agree():
    with pytest.raises(ValueError, match="equal shape"):
        StressState(np.zeros(3), np.zeros(3), np.zeros(2))
