"""What all sections of the configuration share."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


class KeyGroup(BaseModel):
    """Base of all sections: no unknown keys, nothing changed after validation."""

    model_config = ConfigDict(extra="forbid", frozen=True)
