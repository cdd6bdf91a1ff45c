"""hexwall: hexahedral wall meshes of blood vessels.

    import hexwall
    result = hexwall.mesh("aneurysm.stl", size=0.8, thickness=0.5, layers=3)
    result.points, result.hexes, result.cell_data["layer"]
    result.report["wall"]["min_scaled_jacobian"]
    result.write("out", formats=["openfoam", "abaqus"])

The keywords are the options of the program, `hexwall mesh --help`, with underscores.
"""

import inspect
import os

from . import _hexwall
from ._hexwall import MeshResult, __version__
from .errors import (
    Cancelled,
    Error,
    GeometryError,
    MeshingError,
    ReadError,
    TopologyError,
    UsageError,
    WriteError,
)

__all__ = [
    "Cancelled",
    "Error",
    "GeometryError",
    "MeshResult",
    "MeshingError",
    "ReadError",
    "TopologyError",
    "UsageError",
    "WriteError",
    "check",
    "generate",
    "mesh",
]

# Options that have no meaning where nothing is printed.
_NOT_KEYWORDS = {"quiet", "verbose", "json"}


def mesh(surface, *, point_arrays=None, cell_arrays=None, progress=None, cancelled=None, **options):
    """Meshes the wall of a vessel, or the near-wall layers in its lumen, with hexahedra.

    surface: path of a file, or a pair (points, triangles) of arrays: (n, 3) lengths, (m, 3) numbers
        of points. Quads, (m, 4), are split.
    point_arrays, cell_arrays: dicts of arrays on the points and triangles, for thickness_array,
        size_field and cap_array.
    progress: called as progress(stage, number, count) when a stage begins.
    cancelled: called every 20 ms; once it returns True, Cancelled is raised. Ctrl-C needs no help.
    output: folder; if given, the files of the program are written there.
    names: a file, or a dict {"inlet": (x, y, z)}.
    poles: "auto", "off", a number, a file, or an array of points (n, 3).

    Other threads of Python run meanwhile. Raises a subclass of Error.
    """
    _refuse_unknown("mesh", options, _hexwall.mesh_options())
    return _hexwall.mesh(surface, point_arrays, cell_arrays, progress, cancelled, options)


def check(surface, *, cell_arrays=None, cancelled=None, **options):
    """Says what is wrong with a surface and what mesh() would do about it, as in check.json.

    Takes a surface and its keywords as mesh() does. A surface that would be refused raises nothing:
    "meshable" is False then, and "reason" says why.
    """
    _refuse_unknown("check", options, _hexwall.check_options())
    return _hexwall.check(surface, cell_arrays, cancelled, options)


def generate(shape, *, edge=None):
    """Makes a surface to try hexwall on: annulus, eccentric-annulus, cylinder, bifurcation or aaa.

    edge: length of the triangles' edges. Returns (points, triangles).
    """
    return _hexwall.generate(shape, edge)


def _write(self, folder, formats=None, *, write_basis=None):
    """Writes the files of `hexwall mesh -o folder`; formats: those of `write` if left out."""
    names = self.formats if formats is None else [formats] if isinstance(formats, str) else formats
    basis = self.basis if write_basis is None else write_basis
    self._write(os.fspath(folder), list(names), basis)


def _keywords(options, left_out):
    return [o for o in options if not o["is_argument"] and o["keyword"] not in left_out]


def _refuse_unknown(function, given, options):
    known = [o["keyword"] for o in _keywords(options, _NOT_KEYWORDS)]
    for keyword in given:
        if keyword not in known:
            raise TypeError(f"{function}() got an unexpected keyword argument '{keyword}'")


def _describe(function, options):
    """Gives a function the signature and the documentation of its keywords."""
    keywords = _keywords(options, _NOT_KEYWORDS)
    own = list(inspect.signature(function).parameters.values())[:-1]
    function.__signature__ = inspect.Signature(
        own
        + [
            inspect.Parameter(o["keyword"], inspect.Parameter.KEYWORD_ONLY, default=None)
            for o in keywords
        ]
    )
    lines = []
    for option in keywords:
        default = f" [{option['default']}]" if option["default"] else ""
        lines.append(f"    {option['keyword']}: {option['meaning']}{default}")
    function.__doc__ += "\n    Options of the command line:\n\n" + "\n".join(lines) + "\n"


MeshResult.write = _write
MeshResult.__module__ = __name__
_describe(mesh, _hexwall.mesh_options())
_describe(check, _keywords(_hexwall.check_options(), {"output"}))
