"""What hexwall raises. Each class stands for an exit code of the program."""


class Error(Exception):
    """A failure. The message says what is wrong, where, and what to do."""

    exit_code = 1


class UsageError(Error):
    """An option is wrong, or options do not go together."""

    exit_code = 2


class ReadError(Error):
    """The input is missing, truncated, or of an unknown format."""

    exit_code = 3


class TopologyError(Error):
    """The surface is no sphere with two or more holes, or not manifold."""

    exit_code = 4


class GeometryError(Error):
    """The surface is not finite, has no area, or intersects itself."""

    exit_code = 5


class MeshingError(Error):
    """The surface is valid, but no valid mesh was found."""

    exit_code = 6


class WriteError(Error):
    """The output cannot be written."""

    exit_code = 7


class Cancelled(Exception):
    """`cancelled` said that the result is no longer wanted."""
