"""Check of the polars that a configuration names, before any job starts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from equisection.config import Config
from equisection.config.groups import FLAT_PLATE
from equisection.errors import ConfigError, PolarFileError
from equisection.io.formats import read_rows, reynolds_number
from equisection.io.polar_rows import MID_CHORD, REYNOLDS, read_validity
from equisection.keys.checks import Problem
from equisection.keys.shown import shown

#: Relative difference up to which a polar of the rigid beam is that of another one too.
_SAME_BEAM = 0.01
#: Keys of ``steady`` with polars of the rigid beam: what is allowed, and what a file is of.
_OF_BEAM = {
    "beam_polar": ('the polar of this beam, or "", with which the solver runs it', "a beam"),
    "beam_polar_section": ("the polar of this beam's section", "a section"),
}
#: How many times the h/c of a polar's section another may have that it serves for.
_LIKE_THICKNESS = 1.25
#: The same of Reynolds numbers, either way, that nothing is said.
_LIKE_REYNOLDS = 2.0


@dataclass(frozen=True)
class _Polars:
    """Section polars of a solver: their key, files by resolution, and what they are like."""

    key: str
    files: dict[str, str]
    symmetric: bool
    moment_axis: float | None
    columns: Mapping[str, str] | None = None


def check_polars(config: Config, directory: Path | None = None) -> None:
    """Refuse polars that are unreadable, of another beam or flow, or without the run's incidence.

    Any other incidence beyond them is a case that fails with a reason; the others go on. Paths are
    seen from ``directory`` (by default the working one).

    Raises
    ------
    ConfigError
        With one line for each such file.
    """
    directory = directory or Path.cwd()
    problems: list[Problem] = []
    for polars in _polars_of(config):
        problems += _of_section(config, polars, directory)
    for name, words in _OF_BEAM.items():
        if polar := getattr(config.steady, name):
            problems += _of_beam(config, f"steady.{name}", polar, directory, words)
    if problems:
        raise ConfigError("\n".join(problem.line for problem in problems))


def polar_notices(config: Config, directory: Path | None = None) -> Iterator[str]:
    """Yield a line for the polar that a run rests on, if it is of another Reynolds number.

    Only solvers that are given polars read one, and only some files say theirs.
    """
    for polars in _polars_of(config):
        path = polars.files.get(config.steady.resolution, FLAT_PLATE)
        if path == FLAT_PLATE:
            continue
        try:
            of_file = reynolds_number((directory or Path.cwd()) / path)
        except PolarFileError:
            continue  # `check_polars` refuses it
        here = config.reynolds_number
        if max(of_file / here, here / of_file) > _LIKE_REYNOLDS:
            yield (
                f"warning: {polars.key}.{config.steady.resolution}: {shown(path)} is of Reynolds "
                f"number {_short(of_file)}, and this flow has {_short(here)}; stall and drag may "
                "differ"
            )


def _polars_of(config: Config) -> Iterator[_Polars]:
    """Yield the section polars of the configured solver, if it is given any."""
    embedded, given = config.embedded, config.given
    if config.solver == "embedded":
        yield _Polars(
            "embedded.polars",
            embedded.polars,
            embedded.symmetric,
            embedded.moment_axis,
            embedded.columns.given,
        )
    if config.solver == "given":
        yield _Polars("given.polars", given.polars, given.symmetric, given.polar_moment_axis)


def _of_section(config: Config, polars: _Polars, directory: Path) -> Iterator[Problem]:
    for name, path in polars.files.items():
        if path == FLAT_PLATE:
            continue
        try:
            points = read_rows(directory / path, polars.symmetric, polars.columns)
            points.axis_of(directory / path, polars.moment_axis)
            valid = read_validity(directory / path)
        except PolarFileError as error:
            yield _unreadable(f"{polars.key}.{name}", path, error)
            continue
        if name == config.steady.resolution:
            yield from _of_another_section(config, f"{polars.key}.{name}", path, valid, directory)
        rows = points.rows
        last = max(row.incidence_deg for row in rows)
        first = -last if polars.symmetric else min(row.incidence_deg for row in rows)
        incidence = config.flow.incidence_deg
        if name == config.steady.resolution and not first <= incidence <= last:
            yield Problem(
                "flow.incidence_deg",
                incidence,
                f"allowed is {first:g} to {last:g} deg, what {path} covers (is it in degrees?)",
            )


def _of_another_section(
    config: Config,
    key: str,
    path: str,
    valid: dict[str, float | bool],
    directory: Path,
) -> Iterator[Problem]:
    """Refuse the polar of a section that is much thinner."""
    outline = config.beam.outline_in_flow(directory)
    own = config.beam.thickness / config.beam.chord if outline is None else outline.thickness
    ratio, of_polar = own, valid.get("h/c", math.inf)
    if ratio > _LIKE_THICKNESS * of_polar:
        or_thin = ", or flat-plate, of a thin one" if key.startswith("embedded") else ""
        yield Problem(
            key,
            path,
            f"allowed is the polar of this section, of h/c {_short(ratio)}{or_thin}; this file is "
            f"of a section of h/c {_short(of_polar)}",
        )


def _of_beam(
    config: Config, key: str, polar: str, directory: Path, words: tuple[str, str]
) -> Iterator[Problem]:
    """Refuse a polar about another axis, or of another rigid beam or flow than that of the run.

    What bends the beam is free: material and ends. ``words`` are those of :data:`_OF_BEAM`.
    """
    try:
        points = read_rows(directory / polar, symmetric=False)
        points.axis_of(directory / polar, MID_CHORD)
        valid = read_validity(directory / polar)
    except PolarFileError as error:
        yield _unreadable(key, polar, error)
        return
    axis = valid.get("moment_axis", math.nan)
    if axis != MID_CHORD and (points.about_quarter_chord or not math.isnan(axis)):
        yield Problem(
            key,
            polar,
            "allowed are moments about mid-chord: "
            + (points.about_quarter_chord if math.isnan(axis) else f"it says {_short(axis)}")
            + "; write them about mid-chord, and say so in the file: # Valid for: moment_axis 0.5",
        )
        return
    here, (wanted, of_what) = _decides_rigid_polar(config), words
    for name, value in valid.items():
        if not math.isclose(here.get(name, value), value, rel_tol=_SAME_BEAM):
            yield Problem(
                key,
                polar,
                f"allowed is {wanted}; this "
                f"one is of {of_what} of {name} {_short(value)} and not {_short(here[name])}",
            )
            return


def _decides_rigid_polar(config: Config) -> dict[str, float | bool]:
    """Return what the polar of the rigid beam depends on, by name (-); free air is infinite."""
    beam, flow, channel = config.beam, config.flow, config.flow.channel
    return {
        "L/c": beam.length / beam.chord,
        "h/c": beam.thickness / beam.chord,
        REYNOLDS: config.reynolds_number,
        "flow.root_on_wall": flow.root_on_wall,
        "flow.channel.height_chords": channel.height_chords if channel else math.inf,
        "flow.channel.tip_gap_chords": channel.tip_gap_chords if channel else math.inf,
    }


def _short(value: float) -> str:
    return shown(value if isinstance(value, bool) else float(f"{value:.4g}"))


def _unreadable(key: str, path: str, error: PolarFileError) -> Problem:
    """Return the reader's words, which begin with the path, behind the key."""
    where, colon, reason = str(error).partition(": ")
    line = where.rpartition(", ")[2] if ", line " in where else ""
    return Problem(key, path, f"{line}{colon if line else ''}{reason}")
