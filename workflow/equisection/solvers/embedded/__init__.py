"""The embedded solver: section polars, lifting line, lagged separation."""
