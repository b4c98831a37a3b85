"""Reading a polar from a CSV file, with refusals that name file and line.

The format: comma-separated, lines that start with ``#`` and empty lines are skipped, the first
other line is the header. Columns ``incidence_deg, cl, cm, cd`` (upper or lower case, in any
order) are read, others are ignored. Angles in degrees, ascending; moment about mid-chord, nose
up. A symmetric section is given for incidence >= 0 only, from 0 on.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from equisection.aerodynamics.polar import SectionPolar
from equisection.io.polar_rows import read_rows


def read_polar(path: Path | str, symmetric: bool = True) -> SectionPolar:
    """Polar of the file at ``path``, with the file's name (without suffix) as its label.

    With ``symmetric`` the file holds the half polar alpha >= 0 of a symmetric section, which is
    mirrored; without, the whole polar as it is. The coefficients of a finite beam are read the
    same way (C_L, C_M, C_D in the place of c_l, c_m, c_d).
    """
    path = Path(path)
    rows = read_rows(path, symmetric)
    incidence_deg, lift, moment, drag = np.array([row.values for row in rows]).T
    polar = SectionPolar(np.radians(incidence_deg), drag, lift, moment, path.stem)
    return polar.mirrored() if symmetric else polar
