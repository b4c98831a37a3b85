"""The configuration: the pydantic models are its only source."""
