"""Inputs that no person means: configurations, polars, outlines and histories, in tables.

Each is malformed by its construction, so each has to be refused.
"""
