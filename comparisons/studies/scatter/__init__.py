"""Changes of the figures by uncertain inputs, and by which of them (u_input of ASME V&V 20)."""

from comparisons.studies.scatter.study import STUDY as STUDY
