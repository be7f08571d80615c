"""The paper's claims that numbers can judge, figure by figure: here 1, 5, 6 and 11.

Bounds are narrow where the answer is known exactly; else this project's, and each claim states
them.
"""

from math import inf

import numpy as np

from comparisons.studies.paper.claims import exactness as e
from comparisons.studies.paper.claims import readings as r
from comparisons.studies.paper.claims.claims import Claim
from comparisons.studies.paper.claims.rough import rough_claims
from comparisons.studies.paper.surfaces import POLISHED, SMOOTH, UNRUN

# Within 1 % of the smooth contact's exact values: 0.3003 p0, 0.7862 a, 0.25 p0.
SMOOTH_MAXIMUM, SMOOTH_DEPTH, SMOOTH_TXZ = (0.2973, 0.3033), (0.778, 0.794), (0.2475, 0.2525)
VISIBLE = 0.01  # p0: what shows in a diagram


def claims() -> tuple[Claim, ...]:
    """All of them, in the order of the paper's figures."""
    return (*_pressed(), *_method(), *_smooth(), *rough_claims(), *_sections())


def _pressed() -> tuple[Claim, ...]:
    return (
        Claim(
            "load",
            "1",
            "pressures carry the load, unrun",
            "The approach is changed until the pressures add up to the load that is printed.",
            "integral of the pressures over the load",
            UNRUN,
            r.carried,
            (0.999, 1.001),
            exact=True,
        ),
    )


def _method() -> tuple[Claim, ...]:
    return (
        Claim(
            "axis",
            "5(a)",
            "smooth stresses on the axis",
            "On the axis of a smooth contact the computed normal stresses follow the closed form.",
            f"largest error of σx and σz on the axis; {VISIBLE} p₀ would show in the diagram",
            SMOOTH,
            e.axis_error,
            (0.0, VISIBLE),
            "p₀",
            exact=True,
        ),
        Claim(
            "below-sampling-axis",
            "5(b)",
            "right below the sampling interval",
            "The stresses are right even at depths less than the sampling interval.",
            "largest error of σx and σz on the axis at depths less than one pressure element, the "
            "half-plane's by the paper's sum over uniform strips",
            SMOOTH,
            e.error_below_sampling,
            (0.0, VISIBLE),
            "p₀",
            exact=True,
        ),
        Claim(
            "below-sampling-rough",
            "5(b)",
            "the same, unrun and sliding",
            "Carried over to a rough surface that slides: any pressure and any friction may be "
            "given, and the stresses are right at depths less than the sampling interval.",
            f"largest error of σx and σz under |x| ≤ {e.EDGE} a at friction {r.SLIDING} and depths "
            "less than a sampling interval of the trace, of strips as wide as that, against the "
            "finest pressures joined linearly",
            UNRUN,
            e.error_on_rough_ground("strip", np.max),
            (0.0, VISIBLE),
            "p₀",
            models=("half_plane",),
            exact=True,
            besides=(
                ("root mean square of it", e.error_on_rough_ground("strip")),
                ("largest, the samples joined linearly", e.error_on_rough_ground("hat", np.max)),
            ),
        ),
    )


def _smooth() -> tuple[Claim, ...]:
    return (
        Claim(
            "smooth-txz",
            "6(b)",
            "largest orthogonal shear, smooth",
            "Under the smooth contact the largest orthogonal shear is that of theory, p₀/4.",
            "largest |τxz| without friction; confirmed within 1 %",
            SMOOTH,
            r.largest("txz"),
            SMOOTH_TXZ,
            "p₀",
        ),
        Claim(
            "smooth-tau1",
            "6(e)",
            "largest principal shear, smooth",
            "Under the smooth contact the largest principal shear is that of theory, 0.30 p₀.",
            "largest τ₁ without friction; confirmed within 1 %",
            SMOOTH,
            r.largest("tau1"),
            SMOOTH_MAXIMUM,
            "p₀",
            besides=(("with friction 0.1", r.largest("tau1", r.SLIDING)),),
        ),
        Claim(
            "smooth-depth",
            "6(e)",
            "depth of the largest shear, smooth",
            "It stands below the middle of the contact, 0.79 a deep.",
            "depth of the largest τ₁; confirmed within 1 %",
            SMOOTH,
            r.depth_of_largest,
            SMOOTH_DEPTH,
            "a",
        ),
    )


def _sections() -> tuple[Claim, ...]:
    return (
        Claim(
            "quiescent-unrun",
            "11(a)",
            "layer of low shear below asperity, unrun",
            "Between the asperities' stresses and those of the smooth contact lies a quiet layer.",
            "least τ₁ between the two maxima on the vertical through the peak asperity of the "
            "unrun surface, over the smaller of them; “quiet” taken as below a half",
            UNRUN,
            r.low_layer,
            (0.0, 0.5),
        ),
        Claim(
            "section-unrun",
            "11(a)",
            "section meets the smooth one, unrun",
            "On that vertical the shear falls onto the smooth section within half a half-width.",
            f"depth below which they are nowhere more than {r.ALIKE * 100:g} % of the smooth "
            "maximum apart",
            UNRUN,
            r.section_agreement,
            (0.0, 0.5),
            "a",
        ),
        Claim(
            "section-polished",
            "11(a)",
            "section meets the smooth one, polished",
            "So it does below the peak asperity of the polished surface.",
            f"depth below which they are nowhere more than {r.ALIKE * 100:g} % of the smooth "
            "maximum apart",
            POLISHED,
            r.section_agreement,
            (0.0, 0.5),
            "a",
        ),
        Claim(
            "edge-friction",
            "11(b)",
            "friction shears the edge more, smooth",
            "Friction of 0.1 raises the shear below the edge x = +a of the smooth contact.",
            "mean of τ₁ over the depth there, with friction over without",
            SMOOTH,
            r.edge_ratio,
            (1.0, inf),
        ),
    )
