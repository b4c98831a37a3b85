"""Checks before anything else: the package is there, and the configuration can be read."""

import sys
from pathlib import Path

RULES = Path(str(workflow.current_basedir))

try:
    from equisection.config import check_config_files
    from equisection.errors import ConfigError
    from equisection.run import alive, start
except ModuleNotFoundError as error:
    if error.name != "equisection":
        raise
    print(
        f"equisection is not installed in {sys.prefix}: 'pip install -c envs/constraints.txt -e .' "
        f"in {RULES.parents[1]}, or 'make run' there",
        file=sys.stderr,
    )
    sys.exit(1)
except ImportError as error:
    print(error, file=sys.stderr)
    sys.exit(1)

try:
    # Polars, the style of figures and more come with the clone, even if the rules are fetched.
    PROJECT = start.project_of(RULES)
    # The working directory's, or that which comes with the project.
    CONFIG_FILE = str(start.here_or_in_project(start.CONFIG_FILE, PROJECT))
    if workflow.is_main_process:
        check_config_files(start.config_files(Path(CONFIG_FILE), workflow.configfiles))
except ConfigError as error:
    print(error, file=sys.stderr)
    sys.exit(1)

if workflow.is_main_process:
    # Another run that is alive here keeps its lock.
    refusal = alive.refusal_to_unlock(sys.argv[1:])
    if refusal:
        print(refusal, file=sys.stderr)
        sys.exit(1)
    start.say(alive.elsewhere(sys.argv[1:]))
    alive.announce(sys.argv[1:])
