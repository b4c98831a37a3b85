"""Named errors, each with a message for the person who has to act on it.

Every message names the key or file, the value found, what is allowed and what to do next.
Constructing one has no side effect. The scripts print them without a traceback.
"""


class EquisectionError(Exception):
    """Base of every error that a user can cause and mend."""


class ConfigError(EquisectionError):
    """The configuration is not valid; one line for each problem."""


class ArgumentError(EquisectionError, ValueError):
    """An argument of a function of the package is not one that it can use."""


class DerivativesFileError(EquisectionError):
    """A table of flutter derivatives cannot be used; the message names file and line."""


class HistoryFileError(EquisectionError):
    """A recorded history cannot be used; the message names file and line."""


class PolarFileError(EquisectionError):
    """A polar file cannot be used; the message names file and line."""


class OutlineError(EquisectionError):
    """An outline cannot be used; the message has file or key, and the place on it."""


class IncidenceOutOfRangeError(EquisectionError):
    """A case left the range of incidence that its polar covers."""


class ReductionError(EquisectionError):
    """The beam has no equivalent section (for instance no rotational restraint)."""


class DivergenceError(ReductionError):
    """The moment outgrows the stiffness: the section has no static equilibrium."""


class ModesError(EquisectionError):
    """The mode computation failed or did not find the modes that are needed."""


class CaseFileError(EquisectionError):
    """A case file is malformed or of another schema version."""


class ResultFileError(EquisectionError):
    """A result file is truncated, foreign (its hash does not fit the case) or not finite."""


class SolverError(EquisectionError):
    """A solver could not run a case (a fault of the machine or of the set-up, not a result)."""
