"""Histories and polars of another program or a wind tunnel, behind the solver protocol."""
