"""Running-in: exact on a cylinder, convergent on waves, scaling, and one published surface."""

from itertools import pairwise

import hats
import numpy as np
import pytest
from exact_stresses import flowed_volume, largest_overlap
from scenes import PROFILES
from scipy.ndimage import gaussian_filter1d
from text_profiles import GROUND, mirrored, read_profile

from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactError
from analytic.exact.flattened_cylinder import flattened_cylinder
from analytic.exact.hertz import HertzContact, hertz_from_load
from analytic.grid import HatGrid, roller_gap
from analytic.profile import Profile
from analytic.running_in import SMALLEST_SWEEP, RunIn, run_in
from analytic.surface.form import trapezoid_widths
from analytic.surface.synthetic import ground_texture, sinusoid, smooth

LOAD, RADIUS, MODULUS = 1e6, 8e-3, 115e9
HERTZ = hertz_from_load(LOAD, RADIUS, MODULUS)
A, P0 = HERTZ.half_width, HERTZ.peak_pressure
CAPPED = Constraints(load=LOAD, hardness=1.25 * P0)
WAVY = sinusoid(wavelength=0.2 * A, amplitude=0.15e-6, length=6.0 * A)
PLACES = A * np.array([-0.53, 0.0, 0.41, 0.9])


def ran_in(profile: Profile = WAVY, positions=PLACES, constraints=CAPPED, **how) -> RunIn:
    """Run in on hats as far apart as the samples, so that these stay where they are."""
    how = {"pitch": profile.spacing, **how}
    return run_in(profile, RADIUS, MODULUS, constraints, positions, **how)


def pressed(profile: Profile, position: float, pitch: float, pair: HertzContact = HERTZ):
    """Elastic contact over the whole profile: grid from the roller's centre."""
    placed = profile.shifted(position)
    grid = HatGrid.within(placed.x[0], placed.x[-1], pitch)
    gap, load = roller_gap(pair.radius, placed.spline()), pair.load_per_length
    return grid, hats.pressed(grid, pair.combined_modulus, gap, placed.x, load=load)


@pytest.fixture(scope="module")
def wavy() -> RunIn:
    return ran_in()


class TestCylinder:
    @pytest.mark.parametrize("share", [0.9, 0.75])
    def test_volume_and_depth_are_exact_to_second_order(self, share):
        """Root mean square over places of the roller between samples."""
        exact = flattened_cylinder(LOAD, RADIUS, MODULUS, share * P0)
        counts, errors = np.array([20, 40, 80, 160]), []
        for count in counts:
            profile = smooth(length=4.0 * exact.contact, samples=4 * count + 1)
            limits = Constraints(load=LOAD, hardness=exact.hardness)
            places = profile.spacing * np.arange(0.03, 1.0, 0.12)
            settled = [ran_in(profile, [place], limits) for place in places]
            assert all(one.status == "settled" for one in settled)
            ratios = [
                [one.volume / flowed_volume(exact), one.largest_lowering / largest_overlap(exact)]
                for one in settled
            ]
            errors.append(np.sqrt(np.mean(np.square(np.array(ratios) - 1.0), axis=0)))
        orders = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
        assert orders == pytest.approx(2.0, abs=0.4)
        assert np.all(errors[-1] < 5e-4)

    def test_the_flattened_ground_carries_the_load_elastically(self):
        exact = flattened_cylinder(LOAD, RADIUS, MODULUS, 0.8 * P0)
        counts, errors = np.array([40, 80, 160, 320]), []
        for count in counts:
            profile = smooth(length=4.0 * exact.contact, samples=4 * count + 1)
            settled = ran_in(profile, [0.0], Constraints(load=LOAD, hardness=exact.hardness))
            grid, solution = pressed(settled.profile, 0.0, profile.spacing / 1.7)
            wanted = exact.pressure(grid.x)
            errors.append(np.linalg.norm(solution.pressure - wanted) / np.linalg.norm(wanted))
        order = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
        assert order == pytest.approx(1.0, abs=0.35)
        assert errors[-1] < 2e-3

    def test_below_the_hardness_nothing_moves(self):
        profile = smooth(length=6.0 * A, samples=301)
        settled = ran_in(profile, [-A, A], Constraints(load=LOAD, hardness=1.01 * P0))
        assert settled.status == "settled" and settled.sweeps == 1
        assert settled.volume == 0.0 and settled.largest_lowering == 0.0
        assert np.array_equal(settled.profile.height, profile.height)


class TestAccount:
    def test_it_settles(self, wavy):
        assert wavy.status == "settled" and wavy.converged
        assert 2 <= wavy.sweeps <= 6
        assert [one.position for one in wavy.passes] == [*PLACES] * wavy.sweeps
        last = sum(one.volume for one in wavy.passes[-len(PLACES) :])
        assert 0.0 < last <= SMALLEST_SWEEP * wavy.volume
        before = sum(one.volume for one in wavy.passes[-2 * len(PLACES) : -len(PLACES)])
        assert before > SMALLEST_SWEEP * (wavy.volume - last)

    def test_no_asperity_stands_above_the_hardness_afterwards(self, wavy):
        for place in PLACES:
            _, raw = pressed(WAVY, place, wavy.pitch)
            _, after = pressed(wavy.profile, place, wavy.pitch)
            assert raw.pressure.max() > 1.1 * CAPPED.hardness
            assert after.pressure.max() < 1.02 * CAPPED.hardness

    def test_volume_is_what_the_profile_lost(self, wavy):
        assert wavy.profile.x == pytest.approx(WAVY.x, abs=1e-18)
        lost = WAVY.height - wavy.profile.height
        assert lost == pytest.approx(wavy.lowering, abs=1e-18)
        assert trapezoid_widths(WAVY.x) @ lost == pytest.approx(wavy.volume, rel=1e-9)
        one, other = (p.spline().integrate(*WAVY.x[[0, -1]]) for p in (WAVY, wavy.profile))
        assert one - other == pytest.approx(wavy.volume, rel=1e-3)
        lowered = sum(one.lowering for one in wavy.passes)
        assert wavy.largest_lowering == wavy.lowering.max() <= lowered
        assert wavy.volume == sum(one.volume for one in wavy.passes) > 0.0

    def test_ground_is_only_lowered_and_only_on_crests(self, wavy):
        assert np.all(wavy.lowering >= 0.0)
        assert np.all(WAVY.height[wavy.lowering > 0.0] > 0.0)
        untouched = np.abs(WAVY.x) > 2.5 * A
        assert np.all(wavy.lowering[untouched] == 0.0)

    def test_too_few_sweeps_are_reported(self, wavy):
        settled = ran_in(sweeps=1)
        assert settled.status == "passes spent" and settled.sweeps == 1
        assert settled.passes == wavy.passes[: len(PLACES)]

    def test_running_in_again_moves_next_to_nothing(self, wavy):
        again = ran_in(wavy.profile, sweeps=1)
        assert again.volume < SMALLEST_SWEEP * wavy.volume


class TestRefinement:
    def test_volume_profile_and_pressure_converge_as_the_pitch_halves(self):
        """The passes of one sweep; distances between neighbouring pitches fall at second order."""
        place, x = PLACES[-1], np.linspace(-1.5, 1.5, 4001) * A
        volumes, profiles, peaks = [], [], []
        for halvings in range(4):
            worn = ran_in(pitch=WAVY.spacing * 2.0 ** (1 - halvings), sweeps=1)
            volumes.append(worn.volume)
            profiles.append(worn.profile.spline()(x))
            _, solution = pressed(worn.profile, place, WAVY.spacing / 8.0)
            peaks.append(solution.pressure.max() / CAPPED.hardness - 1.0)
        steps = np.abs(np.diff(volumes)) / volumes[-1]
        assert np.log2(steps[0] / steps[-1]) / 2.0 == pytest.approx(2.0, abs=0.6)
        assert steps[-1] < 3e-3
        distances = [np.sqrt(np.mean((p - q) ** 2)) for p, q in pairwise(profiles)]
        assert np.log2(distances[0] / distances[-1]) / 2.0 == pytest.approx(2.0, abs=0.6)
        assert distances[-1] < 1e-3 * WAVY.height.max()
        assert np.abs(peaks[-1]) < 0.02 and np.abs(peaks[-1]) < 0.5 * np.abs(peaks[0])

    def test_curve_between_samples_rises_by_little_and_less_on_narrower_hats(self, wavy):
        """Samples only go down; the spline through them swings beside a flattened crest."""
        x = np.linspace(-2.0, 2.0, 40_001) * A
        lifts = []
        for narrower in (1.0, 2.0, 4.0):
            worn = wavy if narrower == 1.0 else ran_in(pitch=WAVY.spacing / narrower)
            assert np.all(worn.lowering >= 0.0)
            rise = worn.profile.spline()(x) - WAVY.spline()(x)
            lifts.append(rise.max() / worn.largest_lowering)
        assert lifts == pytest.approx([0.0035, 0.0013, 0.0004], rel=0.2)

    def test_curve_of_a_rough_surface_of_few_samples_a_wave_rises_by_more(self):
        rough = ground_texture(
            rms_height=0.1e-6,
            samples=1025,
            length=6.0 * A,
            seed=3,
            roll_off_wavelength=0.5 * A,
            shortest_wavelength=0.02 * A,
            longest_wavelength=2.0 * A,
        )
        x = np.linspace(*rough.x[[0, -1]], 100_001)
        lifts = []
        for pitch in (rough.spacing, None):
            worn = ran_in(rough, pitch=pitch, sweeps=2)
            rise = worn.profile.spline()(x) - rough.spline()(x)
            lifts.append(rise.max() / worn.largest_lowering)
        assert lifts == pytest.approx([0.032, 0.010], rel=0.3)

    def test_narrower_hats_add_samples_where_the_roller_was(self):
        """Two hats a sample, which is the default."""
        worn = ran_in(pitch=None, positions=[0.0], sweeps=1)
        assert worn.pitch == pytest.approx(0.5 * WAVY.spacing, rel=1e-12)
        kept = np.isclose(worn.profile.x[:, None], WAVY.x, rtol=0.0, atol=1e-15).any(axis=0)
        assert np.all(kept)
        steps = np.diff(worn.profile.x) / WAVY.spacing
        middle = np.abs(worn.profile.x[1:]) < 1.5 * A
        assert steps[middle] == pytest.approx(0.5, rel=1e-6)
        assert steps[[0, -1]] == pytest.approx(1.0, rel=1e-6)
        assert worn.profile.height[worn.lowering == 0.0] == pytest.approx(
            WAVY.spline()(worn.profile.x[worn.lowering == 0.0]), abs=1e-20
        )

    def test_hats_wider_than_the_samples_leave_no_kinks(self):
        """Straight between the middles of hats, ground would press 10 % above the hardness."""
        worn = ran_in(pitch=2.0 * WAVY.spacing)
        _, solution = pressed(worn.profile, PLACES[1], WAVY.spacing / 4.0)
        assert solution.pressure.max() < 1.04 * CAPPED.hardness
        assert np.all(worn.lowering >= 0.0)

    def test_samples_need_not_be_even(self):
        """Samples anywhere, hats from the same x: the same surface runs in the same way."""
        generator = np.random.default_rng(3)
        fine = sinusoid(
            wavelength=0.2 * A, amplitude=0.15e-6, length=6.0 * A, samples_per_wavelength=256
        )
        inner = np.sort(generator.choice(np.arange(1, len(fine.x) - 1), 2600, replace=False))
        chosen = np.concatenate(([0], inner, [len(fine.x) - 1]))
        uneven = Profile(fine.x[chosen], fine.height[chosen])
        one = ran_in(uneven, pitch=WAVY.spacing, sweeps=1)
        other = ran_in(fine, pitch=WAVY.spacing, sweeps=1)
        assert one.volume == pytest.approx(other.volume, rel=2e-3)
        x = np.linspace(-1.0, 1.0, 999) * A
        apart = one.profile.spline()(x) - other.profile.spline()(x)
        assert np.abs(apart).max() < 0.02 * other.largest_lowering


class TestSymmetry:
    def test_units_do_not_matter(self, wavy):
        """Lengths by s, moduli and pressures by m: volume by s^2; factors of two leave rounding."""
        s, m = 2.0**-20, 2.0**13
        worn = run_in(
            Profile(s * WAVY.x, s * WAVY.height),
            s * RADIUS,
            m * MODULUS,
            Constraints(load=s * m * LOAD, hardness=m * CAPPED.hardness),
            s * PLACES,
            pitch=s * WAVY.spacing,
        )
        assert worn.volume / s**2 == pytest.approx(wavy.volume, rel=1e-10)
        assert worn.lowering / s == pytest.approx(wavy.lowering, abs=1e-7 * wavy.largest_lowering)
        assert (worn.status, worn.sweeps) == (wavy.status, wavy.sweeps)

    def test_mirrored_profile_runs_into_the_mirrored_one(self, wavy):
        worn = ran_in(mirrored(WAVY), -PLACES)
        apart = mirrored(worn.profile).height - wavy.profile.height
        assert np.abs(apart).max() <= 1e-8 * wavy.largest_lowering

    def test_place_on_the_trace_does_not_matter(self, wavy):
        worn = ran_in(WAVY.shifted(-0.02), PLACES + 0.02)
        assert worn.lowering == pytest.approx(wavy.lowering, abs=1e-6 * wavy.largest_lowering)
        assert worn.passes[0].position == pytest.approx(wavy.passes[0].position + 0.02)

    def test_far_ground_does_not_matter(self):
        """Each pass looks at the ground within reach alone."""
        longer = sinusoid(wavelength=0.2 * A, amplitude=0.15e-6, length=60.0 * A)
        worn, short = ran_in(longer), ran_in()
        x = np.linspace(-2.0, 2.0, 999) * A
        apart = worn.profile.spline()(x) - short.profile.spline()(x)
        assert np.abs(apart).max() < 1e-6 * short.largest_lowering
        assert worn.volume == pytest.approx(short.volume, rel=1e-6)


class TestEndsOfTheTrace:
    def test_contact_at_an_end_is_reported_and_the_end_goes_down(self):
        worn = ran_in(positions=[WAVY.x[0] + 0.4 * A, 0.0], sweeps=1)
        assert [one.at_end for one in worn.passes] == [True, False]
        assert worn.lowering[1] == pytest.approx(worn.lowering[0], rel=1e-12)
        assert worn.lowering[0] > 0.0

    def test_a_trace_that_cannot_carry_the_load(self):
        with pytest.raises(ContactError, match="exceeds what the surface can carry"):
            ran_in(constraints=Constraints(load=LOAD, hardness=0.1 * P0))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"positions": []}, "at least one position"),
        ({"positions": [0.0, 4.0 * A]}, "off the trace"),
        ({"constraints": Constraints(load=LOAD)}, "finite hardness"),
        ({"constraints": Constraints(approach=1e-6, hardness=1e9)}, "needs a load"),
        ({"sweeps": 0}, "at least one sweep"),
        ({"pitch": 3.0 * A}, "fewer than three"),
    ],
)
def test_what_makes_no_sense_is_refused(change, message):
    with pytest.raises(ValueError, match=message):
        ran_in(**change)


class TestGroundSurface:
    """The recipe that the shipped run-in surface was made by, with other elements."""

    PLACES = (500, 600, 700, 800, 900, 1000, 1300, 1400, 1500, 1600, 1736, 1200, 1060, 1118)
    PAIR = hertz_from_load(3.55e6, 7.570598e-3, 115.385e9)
    HARDNESS = 1.66 * PAIR.peak_pressure

    @pytest.fixture(scope="class")
    @classmethod
    def truncated(cls) -> Profile:
        """The recipe's first step, which running-in starts from."""
        height = 1e6 * ground_texture(**GROUND).height

        def blurred(values, sigma):
            return gaussian_filter1d(values, sigma, mode="nearest")

        reference = blurred(height, 120.0)
        above = height - reference
        cut = reference + above - 0.08 * np.log1p(np.exp((above + 0.06) / 0.08))
        weight = blurred((above > -0.22).astype(float), 4.0)
        mixed = cut + weight * (blurred(cut, 4.0) - cut)
        return Profile(np.arange(2237) * 1e-6, 1e-6 * mixed)

    @pytest.fixture(scope="class")
    @classmethod
    def one_sweep(cls, truncated) -> RunIn:
        return cls.run_in(truncated, sweeps=1)

    @classmethod
    def run_in(cls, profile: Profile, **how) -> RunIn:
        pair = cls.PAIR
        constraints = Constraints(load=pair.load_per_length, hardness=cls.HARDNESS)
        places = 1e-6 * np.array(cls.PLACES)
        return run_in(
            profile, pair.radius, pair.combined_modulus, constraints, places, pitch=1e-6, **how
        )

    def contact(self, profile: Profile, pitch: float) -> tuple[float, float]:
        """Contact ratio by touching nodes, and peak pressure over p0, at the last position."""
        pair = self.PAIR
        grid, solution = pressed(profile, 1118e-6, pitch, pair)
        patches = contact_patches(grid.x, solution.pressure, solution.gap)
        ratio = np.ptp(patches, axis=1).sum() / (2.0 * pair.half_width)
        return ratio, solution.pressure.max() / pair.peak_pressure

    def test_one_sweep_gives_the_surface_that_comes_along(self, one_sweep):
        """Heights to 0.4 nm (rms) but for the ends, where the two kinds of elements end apart."""
        read = read_profile(PROFILES / "ground_run_in.csv", x_scale=1e-6, height_scale=1e-6)
        height = one_sweep.profile.height
        apart = (height - height.mean()) - (read.profile.height - read.profile.height.mean())
        inner = slice(5, -5)
        assert apart[inner].std() < 0.45e-9
        assert np.abs(apart[inner]).max() < 10e-9
        assert apart.std() < 2.5e-9 < 0.01 * one_sweep.profile.height.std()
        assert one_sweep.status == "passes spent" and one_sweep.converged
        ended = [round(1e6 * one.position) for one in one_sweep.passes if one.at_end]
        assert ended == [500, 1736]

    def test_contact_ratio_and_peak_pressure_are_the_published_ones(self, one_sweep):
        ratio, peak = self.contact(one_sweep.profile, 0.25e-6)
        assert ratio == pytest.approx(0.87, abs=0.003)
        assert peak == pytest.approx(1.66, abs=0.02)

    def test_further_sweeps_settle_it(self, truncated, one_sweep):
        worn = self.run_in(truncated)
        assert worn.status == "settled" and worn.converged and worn.sweeps <= 6
        assert one_sweep.volume < worn.volume < 1.1 * one_sweep.volume
        assert worn.passes[:14] == one_sweep.passes
