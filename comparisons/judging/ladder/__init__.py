"""The cheapest model that is good enough: every one of a scene against the whole model."""

from comparisons.judging.ladder.study import STUDY as STUDY
