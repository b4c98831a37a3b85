"""Histories of motion turned into verdicts: what a run shows, and whether it may end."""

from equisection.verdict.judgement import assess, heave_grows, swings_grow
from equisection.verdict.verdict import Criteria, Regime, Verdict

__all__ = ["Criteria", "Regime", "Verdict", "assess", "heave_grows", "swings_grow"]
