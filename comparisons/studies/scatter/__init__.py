"""How far uncertain inputs move the figures, and which of them does (u_input of ASME V&V 20)."""

from comparisons.studies.scatter.study import STUDY as STUDY
