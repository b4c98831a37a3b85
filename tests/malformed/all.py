"""All malformed inputs by their kind, and how each kind is looked at."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from tests.malformed import commands, configurations, derivatives, histories, outlines, polars
from tests.malformed.given import Malformed, answered

Look = Callable[[Malformed, Path], tuple[str, str]]

KINDS: dict[str, tuple[list[Malformed], Look]] = {
    "configurations": (configurations.configurations(), answered),
    "polars": (polars.polars(), partial(answered, config=polars.CONFIG)),
    "outlines": (outlines.outlines(), partial(answered, config=outlines.CONFIG)),
    "tables of derivatives": (
        derivatives.tables(),
        partial(answered, config=derivatives.CONFIG),
    ),
    "histories": (histories.histories(), histories.read),
    "command lines": (commands.calls(), commands.ran),
}


def sound() -> dict[str, tuple[Malformed, Look]]:
    """Return the inputs that the malformed ones are made of, which are accepted."""
    found = {
        f"polar, {form}": (write(polars.good(form)), name, "polars")
        for form, (name, write) in polars.FORMATS.items()
    }
    found["polygon"] = (outlines.polygon(outlines.DECK), "mine.csv", "outlines")
    found["airfoil"] = (outlines.airfoil(outlines.airfoil_points()), "mine.dat", "outlines")
    found["derivatives"] = (derivatives.text(), "mine.csv", "tables of derivatives")
    found["history"] = (histories.text(histories.GOOD, ","), "mine.txt", "histories")
    inputs = {
        what: (Malformed("nothing", name, text.encode(), name), KINDS[kind][1])
        for what, (text, name, kind) in found.items()
    }
    return inputs | {one.what: (one, commands.ran) for one in commands.sound()}
