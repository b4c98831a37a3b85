"""The configuration: pydantic models are its only source.

Defaults, descriptions, the JSON schema (``workflow/schemas/config.schema.yaml``) and the
reference of all keys (``config/README.md``) come from the models of
:mod:`equisection.config.groups`; ``python -m equisection.config`` writes both files.
"""

from equisection.config.input_files import check_files
from equisection.config.load import load_config, resolve_config
from equisection.config.model import Config
from equisection.keys.repeated_keys import check_repeated_keys

__all__ = ["Config", "check_files", "check_repeated_keys", "load_config", "resolve_config"]
