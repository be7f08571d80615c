"""The cheapest model that is good enough: every model of a scene against the whole."""

from comparisons.judging.ladder.study import STUDY as STUDY
