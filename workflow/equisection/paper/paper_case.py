"""The paper's case: its beam in its flow, which the defaults of the configuration are."""

from __future__ import annotations

from equisection.config import Config
from equisection.config.groups import Beam, Flow


def is_paper_case(config: Config) -> bool:
    """Tell whether beam and flow are those of the paper, so that its numbers can be compared."""
    return config.beam == Beam() and config.flow == Flow()
