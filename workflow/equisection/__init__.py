"""equisection: a flexible beam in a flow, and its equivalent two-dimensional section.

The package holds everything that the workflow's scripts call. Imports point one way:

    structure, aerodynamics, reduction, motion, signals   (numerics)
        <- cases, results                                  (data that crosses a boundary)
            <- solvers                                     (adapters that run a case)
                <- comparison, figures                     (what is made of the results)
                    <- scripts <- rules

``config`` and ``errors`` are below all of them; signs, symbols and non-dimensional numbers
are stated once, in :mod:`equisection.conventions`.
"""

from equisection.needs import require

require()

__version__ = "0.1.0"
