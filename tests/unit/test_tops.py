"""Tops of a history: by hand, and those that scipy finds."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.signal
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from equisection.verdict.tops import find_tops


@pytest.mark.parametrize(
    ("signal", "prominence", "tops"),
    [
        ([], 0.0, []),
        ([1.0, 2.0], 0.0, []),
        ([0.0, 1.0, 2.0], 0.0, []),  # the end is no top
        ([0.0, 1.0, 0.0], 1.0, [1]),
        ([0.0, 1.0, 0.0], 1.1, []),
        ([0.0, 1.0, 1.0, 1.0, 0.0], 0.5, [2]),  # the middle of a flat one
        ([0.0, 3.0, 1.0, 2.0, 0.0], 1.0, [1, 3]),  # the second stands out by 1 over its valley
        ([0.0, 3.0, 1.0, 2.0, 0.0], 1.5, [1]),
        ([2.0, 1.0, 2.0, 1.0, 2.0], 1.0, [2]),
    ],
)
def test_tops_by_hand(signal, prominence, tops):
    assert find_tops(np.array(signal), prominence).tolist() == tops


# few values, so that there are flat stretches and tops of one height
LEVELS = st.one_of(st.floats(-1e3, 1e3), st.integers(0, 4).map(float))


@given(arrays.arrays(float, st.integers(0, 60), elements=LEVELS), st.floats(0.0, 5.0))
def test_tops_are_those_of_scipy(signal, prominence):
    expected, _ = scipy.signal.find_peaks(signal, prominence=prominence)
    assert find_tops(signal, prominence).tolist() == expected.tolist()
