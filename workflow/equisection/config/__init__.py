"""The configuration: pydantic models are its only source.

Defaults, descriptions, the JSON schema (``workflow/schemas/config.schema.yaml``) and the
reference of all keys (``config/README.md``) come from the models of
:mod:`equisection.config.groups`; ``python -m equisection.config`` writes both files.
"""

from equisection.config.input_files import check_files, find_files, named_files
from equisection.config.load import load_config, resolve_config
from equisection.config.model import Config
from equisection.keys.config_file import check_config_files, read_config_file

__all__ = [
    "Config",
    "check_config_files",
    "check_files",
    "find_files",
    "load_config",
    "named_files",
    "read_config_file",
    "resolve_config",
]
