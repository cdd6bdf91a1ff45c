"""Prints hexwall/__init__.pyi: the signatures of the Python package with the program's options.

    PYTHONPATH=build/python python3 tools/python/stubs/stubs.py > tools/python/hexwall/__init__.pyi
"""

from hexwall import _hexwall

# What the command line calls TEXT, where it is neither a name nor one of several choices.
TYPES = {
    "output": "Path",
    "poles": 'Literal["auto", "off"] | int | Path | ArrayLike',
    "remesh": 'Literal["auto", "off"] | float',
    "open_at": "Path",
    "names": "Path | Mapping[str, ArrayLike]",
    "thickness_file": "Path",
}
LEFT_OUT = {"quiet", "verbose", "json"}

HEADER = '''\
# Made by tools/python/stubs/stubs.py from the options of the program: change those.
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import Cancelled as Cancelled
from .errors import Error as Error
from .errors import GeometryError as GeometryError
from .errors import MeshingError as MeshingError
from .errors import ReadError as ReadError
from .errors import TopologyError as TopologyError
from .errors import UsageError as UsageError
from .errors import WriteError as WriteError

__version__: str

Path: TypeAlias = str | os.PathLike[str]
Surface: TypeAlias = Path | tuple[ArrayLike, ArrayLike]

class MeshResult:
    """A mesh. Arrays cannot be written to; exporters/README.md says what is in them."""

    @property
    def points(self) -> NDArray[np.float64]:
        """Points of the hexes (n, 3), in the unit of the input."""
    @property
    def hexes(self) -> NDArray[np.int32]:
        """Points of each hex (m, 8) in the order of VTK_HEXAHEDRON."""
    @property
    def cell_data(self) -> dict[str, NDArray[Any]]:
        """Arrays on the hexes: layer, zone, region, quad, patch_of_face, scaled_jacobian, ..."""
    @property
    def point_data(self) -> dict[str, NDArray[Any]]:
        """Arrays on the points: radius, thickness, thickness_asked, ..."""
    @property
    def patches(self) -> dict[str, NDArray[np.int32]]:
        """Points of the faces (k, 4) of each boundary patch, seen from outside."""
    @property
    def patch_names(self) -> list[str]: ...
    @property
    def zone_names(self) -> list[str]: ...
    @property
    def region_names(self) -> list[str]: ...
    @property
    def quad_points(self) -> NDArray[np.float64]:
        """Points of the quads (n, 3)."""
    @property
    def quads(self) -> NDArray[np.int32]:
        """Points of each quad (m, 4), seen from outside."""
    @property
    def quad_cell_data(self) -> dict[str, NDArray[Any]]: ...
    @property
    def quad_point_data(self) -> dict[str, NDArray[Any]]: ...
    @property
    def surface_points(self) -> NDArray[np.float64]:
        """Points of the surface as it was meshed: repaired and opened."""
    @property
    def surface_triangles(self) -> NDArray[np.int32]: ...
    @property
    def report(self) -> dict[str, Any]:
        """report.json."""
    @property
    def warnings(self) -> list[str]: ...
    @property
    def formats(self) -> list[str]: ...
    @property
    def basis(self) -> bool: ...
    def write(
        self,
        folder: Path,
        formats: str | Sequence[str] | None = None,
        *,
        write_basis: bool | None = None,
    ) -> None:
        """Writes the files of `hexwall mesh -o folder`."""
'''


def type_of(option):
    if option["keyword"] in TYPES:
        return TYPES[option["keyword"]]
    if option["type"] == "list":
        return "str | Sequence[str]"
    if option["choices"]:
        return f"Literal[{', '.join(repr(c) for c in option['choices'])}]".replace("'", '"')
    return {"": "bool", "number": "float", "integer": "int", "text": "str"}[option["type"]]


def signature(name, own, options, left_out, result):
    lines = [f"def {name}(", *(f"    {parameter}," for parameter in own)]
    for option in options:
        if not option["is_argument"] and option["keyword"] not in left_out:
            lines.append(f"    {option['keyword']}: {type_of(option)} | None = None,")
    return "\n".join([*lines, f") -> {result}: ..."])


def stubs():
    arrays = "Mapping[str, ArrayLike] | None = None"
    cell_arrays = f"cell_arrays: {arrays}"
    cancelled = "cancelled: Callable[[], bool] | None = None"
    progress = "progress: Callable[[str, int, int], object] | None = None"
    own = ["surface: Surface", "*", f"point_arrays: {arrays}", cell_arrays, progress, cancelled]
    mesh = signature("mesh", own, _hexwall.mesh_options(), LEFT_OUT, "MeshResult")
    own = ["surface: Surface", "*", cell_arrays, cancelled]
    check = signature(
        "check", own, _hexwall.check_options(), LEFT_OUT | {"output"}, "dict[str, Any]"
    )
    generate = (
        "def generate(\n    shape: str, *, edge: float | None = None\n"
        ") -> tuple[NDArray[np.float64], NDArray[np.int32]]: ..."
    )
    return "\n".join([HEADER + mesh, check, generate, ""])


if __name__ == "__main__":
    print(stubs(), end="")
