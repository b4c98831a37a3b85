"""Polars that are wrong in one place, in seven formats."""

import re
from collections.abc import Callable, Iterator

from tests.malformed.given import ARABIC, WIDE, WORDS, Malformed, no_files

Rows = list[list[str]]

#: Configuration that names the polar.
CONFIG = """
structure: {{method: beam}}
embedded: {{polars: {{coarse: "{file}"}}, symmetric: false}}
steady: {{incidence_deg: [0, 1, 2, 4]}}
flow: {{incidence_deg: 2}}
sweep: {{models: [2d]}}
"""

#: Incidence (deg), lift, drag and moment of a section at low Reynolds number.
GOOD: Rows = [
    ["-6", "-0.46", "0.07", "-0.11"],
    ["-4", "-0.31", "0.028", "-0.088"],
    ["-2", "-0.1", "0.016", "-0.037"],
    ["0", "0.071", "0.018", "-0.01"],
    ["2", "0.31", "0.022", "0.05"],
    ["4", "0.6", "0.027", "0.083"],
    ["6", "0.81", "0.026", "0.17"],
]


def comma(rows: Rows) -> str:
    """Return a CSV file."""
    return "\n".join(["alpha,cl,cd,cm", *map(",".join, rows)]) + "\n"


def semicolon(rows: Rows) -> str:
    """Return a CSV file with decimal commas."""
    lines = [";".join(cell.replace(".", ",", 1) for cell in row) for row in rows]
    return "\n".join(["Alpha [°];CL [-];CD [-];CM [-]", *lines]) + "\n"


def xfoil(rows: Rows) -> str:
    """Return a polar of XFOIL, whose moments are about the quarter chord."""
    head = """
       XFOIL         Version 6.99

 Calculated polar for: mine

 1 1 Reynolds number fixed          Mach number fixed

 xtrf =   1.000 (top)        1.000 (bottom)
 Mach =   0.000     Re =     0.100 e 6     Ncrit =   9.000

   alpha    CL        CD       CDp       CM     Top_Xtr  Bot_Xtr
  ------ -------- --------- --------- -------- -------- --------
"""
    lines = ["  ".join([*row[:3], "0.001", *row[3:], "1", "1"]) for row in rows]
    return head + "".join(f"  {line}\n" for line in lines)


def aerodyn(rows: Rows) -> str:
    """Return an airfoil table of AeroDyn, whose moments are about the quarter chord."""
    head = f"""! ------------ AirfoilInfo Input File ----------------------------------
"DEFAULT"     InterpOrd         ! Interpolation order
          1   NonDimArea        ! area
          0   NumCoords         ! no coordinates
          1   NumTabs           ! Number of tables
       0.10   Re                ! millions
False         InclUAdata        !
         {len(rows)}   NumAlf            ! Number of data lines
!    Alpha      Cl      Cd        Cm
!    (deg)      (-)     (-)       (-)
"""
    return head + "".join(f"   {'   '.join(row)}\n" for row in rows)


def xflr5(rows: Rows) -> str:
    """Return a polar of XFLR5 with commas, about the quarter chord."""
    lines = [",".join([*row[:3], "0.001", *row[3:], "1", "1"]) for row in rows]
    top = "xflr5 v6.47\n\n Mach =   0.000     Re =     0.100 e 6     Ncrit =   9.000\n\n"
    return "\n".join([f"{top}alpha,CL,CD,CDp,Cm,Top Xtr,Bot Xtr", *lines]) + "\n"


def qblade(rows: Rows) -> str:
    """Return a polar file of QBlade, about the quarter chord."""
    top = "------ QBlade CE ------\nMINE POLARNAME - name\n0 ISDECOMPOSED\n100000 REYNOLDS\n\n"
    return "\n".join([f"{top}AOA CL CD CM", *map(" ".join, rows)]) + "\n"


def airfoiltools(rows: Rows) -> str:
    """Return a polar of airfoiltools.com, about the quarter chord."""
    lines = [",".join([*row[:3], "0.001", *row[3:], "1", "1"]) for row in rows]
    top = "Xfoil polar.\nPolar key,xf-mine-il-100000\nReynolds number,100000\nNcrit,9\n\n"
    return "\n".join([f"{top}Alpha,Cl,Cd,Cdp,Cm,Top_Xtr,Bot_Xtr", *lines]) + "\n"


FORMATS: dict[str, tuple[str, Callable[[Rows], str]]] = {
    "comma": ("mine.csv", comma),
    "semicolon": ("mine.csv", semicolon),
    "xfoil": ("mine.pol", xfoil),
    "aerodyn": ("mine.dat", aerodyn),
    "xflr5": ("mine.txt", xflr5),
    "qblade": ("mine.plr", qblade),
    "airfoiltools": ("mine.csv", airfoiltools),
}
#: A quarter of the lift is the moment about mid-chord more than that about the quarter chord.
QUARTER = {"xfoil", "aerodyn", "xflr5", "qblade", "airfoiltools"}


def good(form: str) -> Rows:
    """Return the sound rows in the convention of a format."""
    if form not in QUARTER:
        return [list(row) for row in GOOD]
    return [[*row[:3], f"{float(row[3]) - float(row[1]) / 4:.4f}"] for row in GOOD]


def _with(rows: Rows, line: int, column: int, value: str) -> Rows:
    changed = [list(row) for row in rows]
    changed[line][column] = value
    return changed


def _damaged(rows: Rows) -> Iterator[tuple[str, Rows]]:
    """Give what is wrong, and the rows."""
    right = rows[3][1]
    values = (
        *(right.translate(ARABIC), right.translate(WIDE), f"{right[:-1]}_{right[-1]}"),
        *("high", "nan", "inf", "1e999", "0x1p3", "−0.1", "1.2.3", "--1", "1e"),
        *("½", "25", "-30", "0.1\x1b[2J", "0.1\x00"),
        *WORDS,
    )
    for value in values:
        yield f"lift {value!a}", _with(rows, 3, 1, value)
    yield "drag below zero", _with(rows, 2, 2, "-0.1")
    yield "moment 21", _with(rows, 5, 3, "21")
    yield "angle 400 deg", _with(rows, 6, 0, "400")
    yield "an angle twice", _with(rows, 4, 0, "0")
    yield "a loop", [*rows, ["3", "0.4", "0.03", "0.08"]]
    yield "steps of 1e-8 deg", _with(rows, 4, 0, "0.00000001")
    yield "three points", rows[:3]
    yield "a value less", [*rows[:4], rows[4][:3], *rows[5:]]
    yield "radians", [[f"{float(row[0]) / 57.29578:.6f}", *row[1:]] for row in rows]
    yield "all zero", [[row[0], "0", "0", "0"] for row in rows]
    yield "no incidence of the run", [[f"{float(row[0]) + 20}", *row[1:]] for row in rows]


def polars() -> list[Malformed]:
    """Return the malformed polars."""
    found = []
    for form, (name, write) in FORMATS.items():
        found += [
            Malformed(f"{form}: {what}", name, write(rows).encode(), name)
            for what, rows in _damaged(good(form))
        ]
    sound = comma(good("comma"))
    for what, content in (
        ("empty", b""),
        ("comments alone", b"# nothing\n\n"),
        ("names alone", b"alpha,cl,cd,cm\n"),
        ("a picture", b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 10),
        ("UTF-16 without its mark", sound.encode("utf-16-le")),
        ("a line of 20,000 characters", sound.encode() + b"# " + b"x" * 20_000),
        ("200,000 lines", sound.encode() + b"#\n" * 200_000),
        ("a column twice", sound.replace("alpha,cl,cd,cm", "alpha,cl,C_L,cm").encode()),
        ("no drag", re.sub(r",cd,", ",what,", sound).encode()),
        ("a web page", b"<!doctype html>\n<html><body>404</body></html>\n"),
    ):
        found.append(Malformed(what, "mine.csv", content, "mine.csv"))
    return [*found, *no_files("mine.csv"), Malformed("not there", "none.csv", None, "none.csv")]
