"""Outlines of a section that are wrong in one place, as polygon and as airfoil of two formats."""

import math
from collections.abc import Iterator

from tests.malformed.given import ARABIC, WIDE, WORDS, Malformed, no_files

Points = list[tuple[str, str]]

#: Configuration that names the outline.
CONFIG = """
solver: openfoam
structure: {{method: beam}}
beam:
  chord: 0.25
  length: 1.5
  outline: {{file: "{file}"}}
  cross_section:
    bending_rigidity: 60
    torsional_rigidity: 25
    mass_per_length: 1.2
    inertia_per_length: 0.006
flow: {{speed: 20, density: 1.225, dynamic_viscosity: 1.81e-5, incidence_deg: 1}}
steady: {{resolution: coarse, incidence_deg: [0, 1, 2, 4]}}
sweep: {{models: [2d], k_star: [0.5, 0.7]}}
unsteady: {{time_step: 0.04, output_interval: 0.04}}
"""

DECK: Points = [("0", "0"), ("0.2", "-0.05"), ("0.8", "-0.05"), ("1", "0"), ("0.5", "0.04")]


def airfoil_points() -> Points:
    """Return a symmetric airfoil from trailing edge to trailing edge."""
    found = []
    for step in range(81):
        x = 0.5 + 0.5 * math.cos(2 * math.pi * step / 80)
        y = 0.6 * (0.2969 * x**0.5 - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
        found.append((f"{x:.6f}", f"{y if step <= 40 else -y:.6f}"))
    return found


def polygon(points: Points) -> str:
    """Return a polygon's file."""
    return "x,y\n" + "".join(f"{x},{y}\n" for x, y in points)


def airfoil(points: Points) -> str:
    """Return an airfoil's file in Selig's format."""
    return "MINE\n" + "".join(f" {x}  {y}\n" for x, y in points)


def lednicer(points: Points) -> str:
    """Return an airfoil's file in Lednicer's format: each side from the leading edge."""
    half = len(points) // 2
    counts = f"MINE\n {half + 1}. {len(points) - half}.\n\n"
    return counts + "".join(f" {x} {y}\n" for x, y in [*points[half::-1], *points[half:]])


def _damaged(points: Points) -> Iterator[tuple[str, Points]]:
    (x, y), middle = points[1], len(points) // 2
    spellings = (y.translate(ARABIC), y.translate(WIDE), f"{y[:-1]}_{y[-1]}", f"−{y.strip('-')}")
    words = ("high", "nan", "inf", "1e999", "0x1", "1.2.3", "0,1,2", "")
    for value in (*spellings, *words, *WORDS):
        yield f"y {value!a}", [points[0], (x, value), *points[2:]]
    yield "an escape", [*points[:2], ("0.5\x1b[2J", "0"), *points[2:]]
    yield "no point", []
    yield "two points", points[:2]
    yield "one point many times", [points[0]] * 10
    yield "no height", [(x, "0") for x, _ in points]
    yield "turns of its own over", [points[0], points[middle], points[1], *points[middle:]]
    yield "1e30 long", [(x + "e30", y) for x, y in points]


def outlines() -> list[Malformed]:
    """Return the malformed outlines."""
    found = []
    for name, write, points in (
        ("mine.csv", polygon, DECK),
        ("mine.dat", airfoil, airfoil_points()),
        ("mine.dat", lednicer, airfoil_points()),
    ):
        found += [
            Malformed(f"{write.__name__}: {what}", name, write(rows).encode(), name)
            for what, rows in _damaged(points)
        ]
    sound = polygon(DECK)
    for what, name, content in (
        ("a picture", "mine.csv", b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 10),
        ("a picture", "mine.dat", b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 10),
        ("another suffix", "mine.txt", sound.encode()),
        ("larger than 2 MB", "mine.csv", sound.encode() + b"#\n" * 10**6 + b"\n"),
        ("counts of another number", "mine.dat", b"MINE\n 9. 9.\n\n 0 0\n 1 0\n\n 0 0\n 1 0\n"),
    ):
        found.append(Malformed(what, name, content, name))
    found += [*no_files("mine.csv"), *no_files("mine.dat")]
    return [*found, Malformed("not there", "none.csv", None, "none.csv")]
