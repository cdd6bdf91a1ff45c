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
def mesh(
    surface: Surface,
    *,
    point_arrays: Mapping[str, ArrayLike] | None = None,
    cell_arrays: Mapping[str, ArrayLike] | None = None,
    progress: Callable[[str, int, int], object] | None = None,
    cancelled: Callable[[], bool] | None = None,
    units: Literal["mm", "cm", "m", "um"] | None = None,
    output: Path | None = None,
    size: float | None = None,
    stretch: float | None = None,
    relax: float | None = None,
    poles: Literal["auto", "off"] | int | Path | ArrayLike | None = None,
    size_by: Literal["constant", "radius"] | None = None,
    size_field: str | None = None,
    threads: int | None = None,
    write: str | Sequence[str] | None = None,
    write_basis: bool | None = None,
    no_report: bool | None = None,
    pictures: bool | None = None,
    repair: str | Sequence[str] | None = None,
    no_repair: bool | None = None,
    tolerance: float | None = None,
    pinholes: float | None = None,
    remesh: Literal["auto", "off"] | float | None = None,
    open: Literal["auto", "off"] | None = None,
    cap_array: str | None = None,
    open_at: Path | None = None,
    names: Path | Mapping[str, ArrayLike] | None = None,
    extend: float | None = None,
    side: Literal["out", "in", "both"] | None = None,
    thickness: float | None = None,
    thickness_ratio: float | None = None,
    thickness_array: str | None = None,
    thickness_file: Path | None = None,
    thickness_min: float | None = None,
    thickness_max: float | None = None,
    thickness_strict: bool | None = None,
    layers: int | None = None,
    growth: float | None = None,
    layer_spec: str | None = None,
    inner_thickness: float | None = None,
    inner_thickness_ratio: float | None = None,
    inner_layers: int | None = None,
    inner_growth: float | None = None,
) -> MeshResult: ...
def check(
    surface: Surface,
    *,
    cell_arrays: Mapping[str, ArrayLike] | None = None,
    cancelled: Callable[[], bool] | None = None,
    units: Literal["mm", "cm", "m", "um"] | None = None,
    repair: str | Sequence[str] | None = None,
    no_repair: bool | None = None,
    tolerance: float | None = None,
    pinholes: float | None = None,
    remesh: Literal["auto", "off"] | float | None = None,
    open: Literal["auto", "off"] | None = None,
    cap_array: str | None = None,
    open_at: Path | None = None,
    names: Path | Mapping[str, ArrayLike] | None = None,
    extend: float | None = None,
) -> dict[str, Any]: ...
def generate(
    shape: str, *, edge: float | None = None
) -> tuple[NDArray[np.float64], NDArray[np.int32]]: ...
