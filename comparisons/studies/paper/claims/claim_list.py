"""The paper's claims that numbers can judge, in the order of its figures.

Bounds are narrow where the answer is known exactly. Where the paper gives words and no number
("many", "near the surface", "agree") the bounds are this project's, and each claim states them.
"""

from math import inf

import numpy as np

from comparisons.studies.paper.claims import readings as r
from comparisons.studies.paper.claims.judgement import Claim

# The scenes that stand for the paper's surfaces, its figures of them, and their names.
SMOOTH, UNRUN, RUN_IN, POLISHED = "smooth", "ground-unrun", "ground-run-in", "ground-polished"
SCENES = (SMOOTH, UNRUN, RUN_IN, POLISHED)
FIGURES = {SMOOTH: "6", UNRUN: "8", RUN_IN: "9", POLISHED: "10"}
SURFACES = {
    SMOOTH: "smooth surface",
    UNRUN: "unrun ground surface",
    RUN_IN: "run-in ground surface",
    POLISHED: "polished ground surface",
}

# Within 1 % of the smooth contact's exact values: 0.3003 p0, 0.7862 a, 0.25 p0.
SMOOTH_MAXIMUM, SMOOTH_DEPTH, SMOOTH_TXZ = (0.2973, 0.3033), (0.778, 0.794), (0.2475, 0.2525)
VISIBLE = 0.01  # p0: what shows in a diagram
YIELD = 1.7  # p0: where the paper puts the indentation hardness
AT_SURFACE = 0.05  # a: "at or very near the surface"
SLIDING_SURFACE = 0.333  # smooth maxima: tau1 of the smooth sliding surface, mu p0
MANY, FEW = 0.25, 0.05  # of the asperities


def claims() -> tuple[Claim, ...]:
    """All of them."""
    return (
        *_method(),
        *_smooth(),
        *_unrun(),
        *_any_rough(UNRUN),
        *_run_in(),
        *_any_rough(RUN_IN),
        *_polished(),
        *_any_rough(POLISHED),
        *_sections(),
    )


def _method() -> tuple[Claim, ...]:
    """Figures 1 and 5."""
    return (
        Claim(
            "load",
            "1",
            "pressures carry the load, unrun",
            "The approach is changed until the pressures add up to the load that is printed.",
            "integral of the pressures over the load",
            UNRUN,
            r.carried_load,
            (0.999, 1.001),
            exact=True,
        ),
        Claim(
            "axis",
            "5(a)",
            "smooth stresses on the axis",
            "On the axis of a smooth contact the computed normal stresses follow the closed form.",
            f"largest error of σx and σz on the axis; {VISIBLE} p₀ would show in the diagram",
            SMOOTH,
            r.axis_error,
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
            r.error_below_sampling,
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
            f"largest error of σx and σz under |x| ≤ {r.EDGE} a at friction {r.SLIDING} and depths "
            "less than a sampling interval of the trace, of strips as wide as that, against the "
            "finest pressures joined linearly",
            UNRUN,
            r.error_on_rough_surface("strip", np.max),
            (0.0, VISIBLE),
            "p₀",
            models=("half_plane",),
            exact=True,
            besides=(
                ("root mean square of it", r.error_on_rough_surface("strip")),
                ("largest, the samples joined linearly", r.error_on_rough_surface("hat", np.max)),
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


def _unrun() -> tuple[Claim, ...]:
    return (
        Claim(
            "ratio-unrun",
            "8(a)",
            "contact ratio 0.69, unrun",
            "Of the apparent contact of the unrun surface a share of 0.69 touches.",
            "length of all contact patches over the Hertz width 2a; confirmed within 0.01",
            UNRUN,
            r.contact_ratio,
            (0.68, 0.70),
            tuned="this ratio",
        ),
        Claim(
            "pressed-unrun",
            "8(a)",
            "many asperities above 1.7 p₀, unrun",
            "Many asperities of the unrun surface are pressed beyond the hardness, 1.7 p₀.",
            "share of the contact patches whose highest pressure exceeds 1.7 p₀; “many” taken as "
            "a quarter",
            UNRUN,
            r.pressed_beyond(YIELD),
            (MANY, 1.0),
            allows=(FEW, 1.0),
            ambiguity="“many” is no number",
            tuned="such pressures",
            besides=(("highest pressure over p₀", r.peak_pressure),),
        ),
        Claim(
            "twice-unrun",
            "8(e)",
            "shear twice the smooth maximum, unrun",
            "Shear stresses under asperities of the unrun surface reach twice the smooth maximum.",
            "largest τ₁ without friction over that of the smooth contact",
            UNRUN,
            r.largest_over_smooth,
            (2.0, inf),
        ),
        Claim(
            "many-twice-unrun",
            "8(e)",
            "the same under many asperities, unrun",
            "Many asperities have shear stresses of twice the smooth maximum below them.",
            "share of the contact patches below which τ₁ exceeds twice the smooth maximum; “many” "
            "taken as a quarter, “few” as one in twenty",
            UNRUN,
            r.sheared_beyond(2.0),
            (MANY, 1.0),
            allows=(FEW, 1.0),
            ambiguity="“many” is no number, and so few asperities leave it open",
            besides=(("beyond once the smooth maximum", r.sheared_beyond(1.0)),),
        ),
        Claim(
            "surface-unrun",
            "8(e)",
            "largest shear at the surface, unrun",
            "The largest shear lies at the surface or very near to it, even without friction.",
            f"depth of the largest τ₁; “very near” taken as {AT_SURFACE} a",
            UNRUN,
            r.depth_of_largest,
            (0.0, AT_SURFACE),
            "a",
        ),
    )


def _run_in() -> tuple[Claim, ...]:
    return (
        Claim(
            "ratio-run-in",
            "9(a)",
            "contact ratio 0.87, run in",
            "Of the apparent contact of the run-in surface a share of 0.87 touches.",
            "length of all contact patches over the Hertz width 2a; confirmed within 0.01",
            RUN_IN,
            r.contact_ratio,
            (0.86, 0.88),
            tuned="this ratio",
        ),
        Claim(
            "peak-run-in",
            "9(a)",
            "peak pressure just below 1.7 p₀, run in",
            "After running-in the highest pressure lies slightly below the hardness, 1.7 p₀.",
            "highest pressure; “slightly below” taken as 1.6 p₀ to 1.7 p₀",
            RUN_IN,
            r.peak_pressure,
            (1.6, YIELD),
            "p₀",
            tuned="such a pressure",
        ),
        Claim(
            "surface-run-in",
            "9(e)",
            "largest shear still at the surface, run in",
            "Even after running-in the largest shear lies at the surface or near to it.",
            f"depth of the largest τ₁; “near” taken as {AT_SURFACE} a",
            RUN_IN,
            r.depth_of_largest,
            (0.0, AT_SURFACE),
            "a",
            besides=(("largest τ₁ over the smooth maximum", r.largest_over_smooth),),
        ),
    )


def _polished() -> tuple[Claim, ...]:
    return (
        Claim(
            "asperities-polished",
            "10(e)",
            "asperity shear below smooth maximum, polished",
            "Under the asperities of the polished surface the shear stays below the smooth "
            "maximum.",
            f"largest τ₁ down to {r.NEAR} a over the smooth maximum",
            POLISHED,
            r.largest_near,
            (0.0, 1.0),
            tuned="such stresses",
        ),
        Claim(
            "shallow-polished",
            "10(e)",
            "asperity shear much shallower, polished",
            "Those asperity stresses lie much shallower than the maximum.",
            f"depth of the largest τ₁ down to {r.NEAR} a; “much” taken as {AT_SURFACE} a",
            POLISHED,
            r.depth_of_largest_near,
            (0.0, AT_SURFACE),
            "a",
        ),
        Claim(
            "value-polished",
            "10(e)",
            "largest shear as of smooth bodies, polished",
            "The largest shear below the polished surface is that of smooth bodies.",
            "largest τ₁ over the smooth maximum; confirmed within 2 %",
            POLISHED,
            r.largest_over_smooth,
            (0.98, 1.02),
        ),
        Claim(
            "place-polished",
            "10(e)",
            "and at the same depth, polished",
            "It stands where smooth theory puts it.",
            "depth of the largest τ₁; confirmed within 5 %",
            POLISHED,
            r.depth_of_largest,
            (0.747, 0.826),
            "a",
        ),
    )


def _any_rough(scene: str) -> tuple[Claim, ...]:
    """What the paper claims of every rough surface."""
    figure, surface = FIGURES[scene], SURFACES[scene]
    short = scene.removeprefix("ground-")
    words = short.replace("-", " ")
    return (
        Claim(
            f"deep-{short}",
            f"{figure}(f)",
            f"as smooth below 0.5 a, {words}",
            "Below half a half-width the roughness no longer matters: the stresses are those of "
            "smooth bodies.",
            f"depth below which τ₁ under the {surface} is nowhere more than "
            f"{r.AGREEMENT * 100:g} % of the smooth maximum from the smooth field",
            scene,
            r.depth_of_agreement,
            (0.0, 0.5),
            "a",
        ),
        Claim(
            f"drawn-{short}",
            f"{figure}(f)",
            f"Hertz zone drawn to the surface, {words}",
            "Without friction the asperities' stresses distort the zone of the smooth contact "
            "towards the surface.",
            "how much nearer to the surface the zone above half the smooth maximum reaches than "
            "that of the smooth contact",
            scene,
            r.reach_against_smooth(r.HALF),
            (0.0, inf),
            "a",
            besides=(("its core, above 0.8 of the maximum", r.reach_against_smooth(r.CORE)),),
        ),
        Claim(
            f"open-{short}",
            f"{figure}(g)",
            f"open to the surface with friction, {words}",
            "Friction of 0.1 opens the highly sheared zone to the surface.",
            "highest level, in smooth maxima, at which the Hertz zone is joined with the surface "
            "itself; highly sheared taken as half the smooth maximum",
            scene,
            r.open_to_surface(r.SLIDING),
            (r.HALF, inf),
            allows=(SLIDING_SURFACE, inf),
            ambiguity="a smooth contact that slides is open up to a third of the maximum, and the "
            "paper does not say which shear counts as high",
            besides=(("without friction", r.open_to_surface(0.0)),),
        ),
        Claim(
            f"one-{short}",
            f"{figure}(g)",
            f"one zone with friction, {words}",
            "Friction of 0.1 merges the asperities' zone and the Hertz zone into one.",
            f"of what lies above half the smooth maximum within {r.NEAR} a of the surface, the "
            "share joined with the Hertz zone; “one” taken as nine tenths, denied below a half",
            scene,
            r.joined_share(r.SLIDING),
            (0.9, 1.0),
            allows=(0.5, 1.0),
            ambiguity="part of the asperities' zones is joined with the Hertz zone, part is not",
            besides=(("without friction", r.joined_share(0.0)),),
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
            f"depth below which they are nowhere more than {r.AGREEMENT * 100:g} % of the smooth "
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
            f"depth below which they are nowhere more than {r.AGREEMENT * 100:g} % of the smooth "
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
