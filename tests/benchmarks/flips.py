"""Flipped bits: how many of a thousand are used, raise something else, or take long."""

import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from equisection.errors import ResultFileError
from equisection.results.netcdf import read_attributes, read_dataset
from equisection.store.mend import unsound_files
from tests.benchmarks.measure import Row
from tests.workflow.project import ROOT, Project, small

FLIPS = 1000
LONG = 5.0  # seconds


def rows() -> Iterator[Row]:
    """Flip a bit of a file of a run, of its store or of kept results, a thousand times."""
    with TemporaryDirectory() as folder:
        project = Project.fresh(Path(folder) / "project", small())
        project.run()
        kept = Path(folder) / "kept"
        for path in (ROOT / "results" / "reference").rglob("*.nc"):
            copy = kept / path.relative_to(ROOT / "results" / "reference")
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(path.read_bytes())
        yield from _outcomes(
            project.results, [project.results, project.results.parent / ".store", kept]
        )
        for what, look in (
            ("look at the start of a run", lambda: unsound_files(project.results)),
            (
                "digests of all kept results",
                lambda: [read_attributes(p) for p in kept.rglob("*.nc")],
            ),
        ):
            start = time.process_time()
            look()
            yield Row(what, f"{1e3 * (time.process_time() - start):.0f} ms of processor time")


def _outcomes(run: Path, folders: list[Path]) -> Iterator[Row]:
    files = [[path for path in folder.rglob("*") if _counts(path, run)] for folder in folders]
    found: Counter[str] = Counter()
    random = np.random.default_rng(0)
    for trial in range(FLIPS):
        group = files[trial % len(files)]
        path = group[random.integers(len(group))]
        content = path.read_bytes()
        bit = int(random.integers(8 * len(content)))
        flipped = bytearray(content)
        flipped[bit // 8] ^= 1 << (bit % 8)
        path.write_bytes(flipped)
        found[_outcome(path, run)] += 1
        path.write_bytes(content)
    yield Row(
        "flipped bits, refused with the file's name",
        str(found["named"]),
        str(FLIPS),
        found["named"] == FLIPS,
    )
    for outcome, words in (
        ("used", "used silently"),
        ("uncaught", "another exception"),
        ("long", f"longer than {LONG:g} s"),
    ):
        yield Row(words, str(found[outcome]), "0", not found[outcome])


def _counts(path: Path, run: Path) -> bool:
    """Tell whether something is made from a file: a result, a table, an index or a case file."""
    if path.suffix == ".nc":
        return True
    recorded = {"comparison", "tables", "steady", "unsteady", "cases"}
    return (
        path.suffix in {".csv", ".json"}
        and path.is_relative_to(run)
        and (path.relative_to(run).parts[0] in recorded)
    )


def _outcome(path: Path, run: Path) -> str:
    start = time.perf_counter()
    try:
        if path.suffix == ".nc":
            read_dataset(path)
            outcome = "used"
        else:
            outcome = "named" if any(file.path == path for file in unsound_files(run)) else "used"
    except ResultFileError as error:
        outcome = "named" if str(path) in str(error) else "uncaught"
    except Exception:
        outcome = "uncaught"
    return "long" if time.perf_counter() - start > LONG else outcome
