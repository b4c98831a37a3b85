"""The solver protocol, and the adapters that fulfil it.

An adapter runs cases; nothing else of the workflow knows a solver's name. To add one, write a
class that fulfils :class:`equisection.solvers.protocol.Solver` and register it in
:mod:`equisection.solvers.registry`.
"""
