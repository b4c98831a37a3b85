"""A run as a person sees it: status, cost, verification, command line."""
