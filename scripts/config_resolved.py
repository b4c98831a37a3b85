"""Write the configuration with every default filled in."""

from pathlib import Path
from typing import Any

import yaml

from equisection.files import write_text
from equisection.script import logged


def main(config: dict[str, Any], output: Path) -> None:
    """Write the resolved configuration as YAML."""
    write_text(output, yaml.safe_dump(config, sort_keys=False))


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        main(dict(snakemake.params.config), Path(snakemake.output[0]))
