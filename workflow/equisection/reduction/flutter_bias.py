r"""Bias of a section against its beam: what the reduction does to the flutter speed.

The section has the coupled frequencies, the dampings and the divergence of the beam's first pair of
modes, one of bending and one of torsion. It can't have its flutter: in amplitudes that make both
inertias those of the section, every cross term of the pair is the section's times

    cos phi = A_theta,w / sqrt(A_theta,theta A_w,w),

in inertia, where S_2D takes care of it, and in the air, where nothing can. So the air couples a
section too strongly, and it flutters early. By linear theory
(:mod:`equisection.motion.beam_flutter`) this is a number,

    bias = V_section / V_pair - 1,

which depends on the mass of the fluid and on the distance of the frequencies as much as on cos phi.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from equisection.beam.beam import Beam
from equisection.beam.section import Section
from equisection.motion.beam_flutter import FlutterOnset, beam_flutter, section_flutter
from equisection.reduction.integrals import span_integrals
from equisection.structure.modal_matrices import ModalMatrices, modal_matrices
from equisection.structure.mode_set import ModeSet

#: Bias above which a section is reported as a poor stand-in, and from which there is none.
WARNED, REFUSED = 0.05, 0.15
#: cos phi of the pair below which there is no section.
LEAST_LIKENESS = 0.8
#: Damping of the pair, with what dashpots of supports add by their projection on the modes, above
#: which it is warned about, and above which there is no section: a damper so strong holds its place
#: and changes the shapes (of a cantilever with one at its tip a projected 0.50 is 0.559, and 0.20
#: is 0.2027).
DAMPING_WARNED, DAMPING_REFUSED = 0.2, 0.5
#: Pairs that are looked at. The n-th frequency of a pinned beam goes with n^2 in bending and with n
#: in torsion, so that the first pair need not be the critical one.
_PAIRS = 3


@dataclass(frozen=True)
class FlutterBias:
    """Flutter of a section and of its beam by linear theory.

    Attributes
    ----------
    section
        Onset of the section.
    pair
        Onset of the beam's first bending and first torsion mode alone.
    beam
        Onset of the beam with all of its modes.
    critical_pair
        Number n of the n-th bending and torsion mode that flutter first, each pair alone; 0 where
        none does. The first is the section's pair.
    bending_mode
        Number of the bending mode that the section has, the one most like the first torsion mode.
    likeness
        cos phi of the section's pair (-).
    damping_ratio
        The larger damping ratio of the section's pair (-), dashpots projected.
    """

    section: FlutterOnset
    pair: FlutterOnset
    beam: FlutterOnset
    critical_pair: int
    bending_mode: int = 1
    likeness: float = 1.0
    damping_ratio: float = 0.0

    @property
    def bias(self) -> float:
        """V_section / V_pair - 1 (-); NaN where one of them does not flutter."""
        return self.section.speed / self.pair.speed - 1.0

    def warnings(self, reduction: str) -> tuple[str, ...]:
        """Warnings of a poor stand-in, of a section made by a reduction; empty where it is good."""
        found = []
        if self.bending_mode > 1:
            found.append(
                f"the section has bending mode {self.bending_mode}, the one most like the first "
                f"torsion mode (cos(phi) = {self.likeness:.3f})"
            )
        if self.damping_ratio > DAMPING_WARNED:
            found.append(
                f"dashpots of beam.supports give the section's modes a damping ratio of "
                f"{self.damping_ratio:.3f}, above {DAMPING_WARNED:g}: so strong a damper changes "
                "the shapes, which the modes do not have"
            )
        found += [
            f"no section stands for this beam: {reason}"
            for reason in [unlike(self.likeness, self.damping_ratio)]
            if reason
        ]
        of_section = f"the section of the {reduction} reduction"
        of_pair = f"its beam's first pair of modes flutters at {self.pair.speed:.4g} m/s"
        if abs(self.bias) > WARNED:
            found.append(
                f"by linear theory {of_section} flutters at {self.section.speed:.4g} m/s, where "
                f"{of_pair} ({100 * self.bias:+.1f} %)"
            )
        if math.isnan(self.section.speed) and not math.isnan(self.pair.speed):
            found.append(f"by linear theory {of_section} has no flutter, where {of_pair}")
        if self.beam.speed < (1.0 - WARNED) * self.pair.speed:
            others = f", by pair {self.critical_pair}" if self.critical_pair > 1 else ""
            found.append(
                f"by linear theory the beam flutters at {self.beam.speed:.4g} m/s{others}, before "
                f"the {self.pair.speed:.4g} m/s of its first pair of modes, which a section stands "
                "for: run the beam"
            )
        return tuple(found)


def flutter_bias(section: Section, beam: Beam, modes: ModeSet, density: float) -> FlutterBias:
    """Flutter of a section (SI) and of its beam in a fluid of a density (kg/m^3).

    Parameters
    ----------
    section
        Section of the beam.
    beam
        The beam.
    modes
        Its modes, one of each kind at least.
    density
        Density of the fluid rho (kg/m^3).

    Raises
    ------
    ModesError
        A mode is missing.
    """
    numbers = [max(modes.kind.count(kind), 1) for kind in ("bending", "torsion")]
    matrices = modal_matrices(beam, modes, *numbers)

    def onset(of: ModalMatrices) -> FlutterOnset:
        return beam_flutter(of, beam.chord, beam.elastic_axis, density)

    chosen, bending_mode = modes.section_pair()
    first = matrices.pair(1, bending_mode)
    others = [matrices.pair(n) for n in range(2, min(*numbers, _PAIRS) + 1)]
    pairs = [onset(each) for each in (first, *others)]
    speeds = {n: each.speed for n, each in enumerate(pairs, start=1) if not math.isnan(each.speed)}
    return FlutterBias(
        section=section_flutter(section, density),
        pair=pairs[0],
        beam=onset(matrices),
        critical_pair=min(speeds, key=lambda n: speeds[n], default=0),
        bending_mode=bending_mode,
        likeness=span_integrals(beam, chosen, count=1).cos_phi,
        damping_ratio=float(first.damping_ratios.max()),
    )


def unlike(likeness: float, damping_ratio: float) -> str:
    """Return why a pair of that cos phi and damping has no section; empty where it has."""
    if likeness < LEAST_LIKENESS:
        return (
            f"the first torsion mode and the bending mode most like it have cos(phi) = "
            f"{likeness:.3f} (allowed is {LEAST_LIKENESS:g} or more): their shapes are too unlike "
            "for a section; run the beam (sweep.models: [3d])"
        )
    if damping_ratio > DAMPING_REFUSED:
        return (
            f"dashpots of beam.supports give its modes a damping ratio of {damping_ratio:.3f} "
            f"(allowed is {DAMPING_REFUSED:g} or less): so strong a damper holds its place, and "
            "the shapes are others; give a weaker one, or fix the support"
        )
    return ""


def refusal(bias: float, reduction: str) -> str:
    """Return why a section of that bias (-) cannot stand for its beam; empty where it can."""
    if not abs(bias) >= REFUSED:
        return ""
    return (
        f"by linear theory the section of the {reduction} reduction flutters at {1 + bias:.2f} "
        f"times the speed of its beam's first pair of modes (allowed is {1 - REFUSED:g} to "
        f"{1 + REFUSED:g}): their shapes are too unlike for a section; run the beam "
        "(sweep.models: [3d])"
    )
