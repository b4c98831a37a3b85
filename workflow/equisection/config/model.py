"""The whole configuration, and what its sections must agree on."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from equisection.config.sections import (
    FREE_TIP,
    Beam,
    Embedded,
    Flow,
    Name,
    Section,
    Steady,
    Structure,
    Sweep,
    Unsteady,
)


class Config(Section):
    """Configuration of one run; the defaults are the paper's plate on the embedded solver."""

    run: Name = Field(
        "paper-plate", description="Name of the run; everything goes to `results/<run>/`."
    )
    solver: Literal["embedded"] = Field(
        "embedded", description="Solver of the steady and unsteady cases."
    )
    reduction: Literal["consistent", "paper"] = Field(
        "consistent",
        description="Equivalent section of the models `2d` and `2d-corrected`: `consistent` "
        "keeps the natural frequencies, `paper` is Eq. 17 as printed.",
    )
    beam: Beam = Field(default_factory=Beam, description="The beam.")
    flow: Flow = Field(default_factory=Flow, description="The flow.")
    structure: Structure = Field(default_factory=Structure, description="Mode computation.")
    steady: Steady = Field(default_factory=Steady, description="Steady polars.")
    sweep: Sweep = Field(default_factory=Sweep, description="The sweep over k*.")
    unsteady: Unsteady = Field(default_factory=Unsteady, description="Unsteady runs.")
    embedded: Embedded = Field(default_factory=Embedded, description="The embedded solver.")

    @model_validator(mode="after")
    def _tip_needs_room(self) -> Config:
        channel = self.flow.channel
        if channel and channel.tip_gap_chords == 0 and self.beam.boundary in FREE_TIP:
            raise ValueError(
                "flow.channel.tip_gap_chords: 0 leaves no room for the free tip of boundary "
                f"'{self.beam.boundary}'; above 0 is allowed"
            )
        return self

    @model_validator(mode="after")
    def _resolutions_exist(self) -> Config:
        if self.solver != "embedded":
            return self
        for key, names in (
            ("resolution", (self.steady.resolution,)),
            ("study", self.steady.study),
        ):
            for name in names:
                if name not in self.embedded.polars:
                    raise ValueError(
                        f"steady.{key}: '{name}' has no polar; the names in embedded.polars are "
                        f"allowed: {', '.join(sorted(self.embedded.polars))}"
                    )
        return self

    @model_validator(mode="after")
    def _incidence_in_sweep_of_angles(self) -> Config:
        low, high = self.steady.incidence_deg[0], self.steady.incidence_deg[-1]
        if not low <= self.flow.incidence_deg <= high:
            raise ValueError(
                f"flow.incidence_deg: {self.flow.incidence_deg:g} is outside the steady "
                f"incidences; {low:g} to {high:g} (steady.incidence_deg) is allowed"
            )
        return self

    @property
    def is_paper_case(self) -> bool:
        """Whether beam and flow are those of the paper, so that its numbers can stand beside."""
        return self.beam == Beam() and self.flow == Flow()
