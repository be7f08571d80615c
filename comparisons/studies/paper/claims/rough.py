"""The paper's claims of rough surfaces: figures 8 to 10.

Where the paper gives words and no number ("many", "near the surface", "agree") the bounds are this
project's, and each claim states them.
"""

from math import inf

from comparisons.studies.paper.claims import readings as r
from comparisons.studies.paper.claims.claims import Claim
from comparisons.studies.paper.surfaces import FIGURES, POLISHED, RUN_IN, SURFACES, UNRUN

YIELD = 1.7  # p0: where the paper puts the indentation hardness
AT_SURFACE = 0.05  # a: "at or very near the surface"
SLIDING_SURFACE = 0.333  # smooth maxima: tau1 of the smooth sliding surface, mu p0
MANY, FEW = 0.25, 0.05  # of the asperities


def rough_claims() -> tuple[Claim, ...]:
    """Figures 8, 9 and 10."""
    return (
        *_unrun(),
        *_with_depth(UNRUN),
        *_run_in(),
        *_with_depth(RUN_IN),
        *_polished(),
        *_with_depth(POLISHED),
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
            vague="“many” is no number",
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
            vague="“many” is no number, and so few asperities leave it open",
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


def _with_depth(scene: str) -> tuple[Claim, ...]:
    """What is claimed of every rough surface."""
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
            f"depth below which τ₁ under the {surface} is nowhere more than {r.ALIKE * 100:g} % of "
            "the smooth maximum from the smooth field",
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
            vague="a smooth contact that slides is open up to a third of the maximum, and which "
            "shear counts as high the paper does not say",
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
            r.joined(r.SLIDING),
            (0.9, 1.0),
            allows=(0.5, 1.0),
            vague="part of the asperities' zones is joined with the Hertz zone, part is not",
            besides=(("without friction", r.joined(0.0)),),
        ),
    )
