"""The cheapest model that is good enough: every model of a scene against the whole."""

from comparisons.studies.ladder.study import STUDY as STUDY
