"""The paper's surfaces: the scenes that stand for them, its figures of them, and their names."""

SMOOTH, UNRUN, RUN_IN, POLISHED = "smooth", "ground-unrun", "ground-run-in", "ground-polished"
SCENES = (SMOOTH, UNRUN, RUN_IN, POLISHED)
FIGURES = {SMOOTH: "6", UNRUN: "8", RUN_IN: "9", POLISHED: "10"}
SURFACES = {
    SMOOTH: "smooth surface",
    UNRUN: "unrun ground surface",
    RUN_IN: "run-in ground surface",
    POLISHED: "polished ground surface",
}
