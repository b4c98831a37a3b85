"""Write the configuration with every default filled in."""

from pathlib import Path
from typing import Any

from equisection.files import write_text
from equisection.provenance import config_hash, config_text
from equisection.run.script import logged


def main(config: dict[str, Any], output: Path) -> None:
    """Write the resolved configuration as YAML, and keep it under its hash.

    By the hash a file names its configuration, also when the run has a later one.
    """
    write_text(output, config_text(config))
    write_text(output.parent / "configs" / f"{config_hash(config)}.yaml", config_text(config))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(dict(snakemake.params.config), Path(snakemake.output[0]))
