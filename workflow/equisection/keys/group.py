"""The base of all sections of the configuration."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict, ValidationInfo

from equisection.keys.checks import disagreements_within

#: Context of a validation that checks the whole configuration, this section with it.
WHOLE = {"whole": True}


class KeyGroup(BaseModel):
    """Base of all sections: no unknown keys, nothing changed after validation."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    def require_agreement(self, name: str, info: ValidationInfo) -> None:
        """Refuse keys that do not agree among themselves, unless the whole configuration does.

        Parameters
        ----------
        name
            Name of the section.
        info
            Context of the validation, from pydantic.

        Raises
        ------
        ValueError
            With one line for each problem.
        """
        problems = [] if (info.context or {}).get("whole") else disagreements_within(name, self)
        if problems:
            raise ValueError("\n".join(problem.text for problem in problems))
