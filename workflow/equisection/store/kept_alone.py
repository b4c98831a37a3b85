"""Answer cases from kept results alone, with the reason where there is none."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from equisection.cases import Case, are_alike, canonical, kind_of, point_of
from equisection.cases.kinds import ends_of
from equisection.files import second_name
from equisection.store.kept import Kept, kept_results, with_history_of
from equisection.store.result_store import ResultStore, task_of

#: Parts of a case that a reason does not take apart: they follow from others.
_WHOLE = ("beam", "section", "criteria")


@dataclass(frozen=True)
class Answers:
    """Kept results of the cases of a job.

    Attributes
    ----------
    found
        Attributes of each result by the name of its case.
    missing
        Reason for a missing result, by the name of its case.
    """

    found: dict[str, dict[str, Any]] = field(default_factory=dict)
    missing: dict[str, str] = field(default_factory=dict)


def answer_from_kept(cases: Mapping[str, Case], folder: Path, store: Path, reuse: Path) -> Answers:
    """Publish the kept results of the cases, and say which cases have none.

    A history that is shorter than its case may take, and undecided, is judged as far as it goes.

    Parameters
    ----------
    cases
        Cases by name.
    folder
        Folder for the results ``<name>.nc``; the file of a case without a result is removed.
    store
        Folder for the results by hash; results that it holds from before are not trusted.
    reuse
        Folder with the kept results.
    """
    kept, results, answers = kept_results(reuse), ResultStore(store), Answers()
    for name, case in cases.items():
        output = folder / f"{name}.nc"
        for asked in (case, *_shorter(case, kept)):
            task = task_of(asked)
            found = results.take(task, kept)
            found = found or results.judge_again(task, kept, kept_alone=True)
            if found is not None:
                answers.found[name] = point_of(case) | found
                second_name(results.result(task), output)
                break
        else:
            output.unlink(missing_ok=True)
            answers.missing[name] = _why(case, kept, reuse)
    return answers


def _shorter(case: Case, kept: Sequence[Kept]) -> list[Case]:
    """Return the case as it would be if it could take no longer than its longest history."""
    if "duration" not in kind_of(case).ends or case.not_run:
        return []
    lengths = [one.end_time for one in with_history_of(kept, case)]
    return [case.model_copy(update={"duration": max(lengths)})] if lengths else []


def _why(case: Case, kept: Sequence[Kept], reuse: Path) -> str:
    """Return why nothing that is kept answers a case: in what the nearest of them differs."""
    wanted = json.loads(canonical(case))
    same = ("kind", "dimension", *kind_of(case).point)
    near = [
        one
        for one in kept
        if one.case and all(are_alike(one.case.get(key), wanted.get(key)) for key in same)
    ]
    if not near:
        return f"nothing of it is kept in {reuse}"
    differences = min((_differences(one.case, wanted) for one in near), key=len)
    return f"what is kept in {reuse} has " + ", ".join(differences[:4])


def _differences(kept: Any, wanted: Any, key: str = "") -> list[str]:
    """Return where a case that is kept differs from the one wanted, in words."""
    name = key.rpartition(".")[2]
    if isinstance(kept, dict) and isinstance(wanted, dict) and name not in _WHOLE:
        return [
            line
            for part in sorted(kept.keys() | wanted.keys())
            if key or part not in ends_of(wanted)
            for line in _differences(kept.get(part), wanted.get(part), f"{key}.{part}".strip("."))
        ]
    if are_alike(kept, wanted):
        return []
    if isinstance(wanted, dict | list) or isinstance(kept, dict | list):
        return [f"another {name}"]
    return [f"{key} {kept} (wanted {wanted})"]
