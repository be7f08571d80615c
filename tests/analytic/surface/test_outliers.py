"""Spikes are told from roughness, whatever its kind."""

import numpy as np
import pytest

from analytic.profile import Profile
from analytic.surface.outliers import spikes
from analytic.surface.synthetic import ground_texture, self_affine
from analytic.surface.turned import turned

X = 0.5e-6 * np.arange(4000)
SURFACES = {
    "self-affine, Hurst 0.3": self_affine(
        hurst=0.3, samples=4096, length=2e-3, rms_height=1e-6, seed=1
    ),
    "self-affine, Hurst 0.8": self_affine(
        hurst=0.8, samples=4096, length=2e-3, rms_height=1e-6, seed=2
    ),
    "ground": ground_texture(
        rms_height=0.4e-6, samples=4000, length=2e-3, shortest_wavelength=4e-6,
        roll_off_wavelength=60e-6, longest_wavelength=4e-4, seed=4,
    ),
    "turned": turned(feed=1e-4, nose_radius=4e-4, length=2e-3),
    "noise": Profile(X, 1e-7 * np.random.default_rng(3).standard_normal(4000)),
    "sine": Profile(X, 1e-6 * np.sin(X / 10e-6)),
    "steps": Profile(X, 1e-6 * (np.arange(4000) // 50 % 2)),
    "flat": Profile(X, np.zeros(4000)),
}  # fmt: skip


@pytest.mark.parametrize("profile", SURFACES.values(), ids=SURFACES)
def test_a_surface_has_no_spikes(profile):
    assert spikes(profile) is None


@pytest.mark.parametrize("name", [name for name in SURFACES if name not in ("noise", "steps")])
def test_spikes_are_counted_and_the_largest_is_named(name):
    profile = SURFACES[name]
    height = profile.height.copy()
    size = 10.0 * (np.ptp(height) or 1e-6)
    height[700:702] += 0.5 * size
    height[2500] -= size
    # a slope under it all is no matter
    spiked = spikes(Profile(profile.x, height + 0.01 * profile.x))
    assert spiked.count == 2
    assert spiked.place == profile.x[2500]
    assert spiked.height == pytest.approx(-size, rel=0.1)
