"""Verdicts on histories of motion: the regime of a run, and the decision that it may end."""

from equisection.verdict.judgement import assess, heave_grows, swings_grow
from equisection.verdict.verdict import Criteria, Regime, Verdict

__all__ = ["Criteria", "Regime", "Verdict", "assess", "heave_grows", "swings_grow"]
