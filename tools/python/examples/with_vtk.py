"""From a VTK surface to a VTK mesh, without files: smooths a vessel, meshes its wall, clips it.

    PYTHONPATH=build/python python3 tools/python/examples/with_vtk.py SURFACE.vtp OUT.vtu [SIZE]
"""

import sys

import hexwall
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON,
    vtkCellArray,
    vtkPlane,
    vtkUnstructuredGrid,
)
from vtkmodules.vtkFiltersCore import vtkTriangleFilter, vtkWindowedSincPolyDataFilter
from vtkmodules.vtkFiltersExtraction import vtkExtractGeometry
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridWriter


def surface_of(polydata):
    """Points and triangles of a vtkPolyData of triangles, as hexwall takes them."""
    triangles = vtk_to_numpy(polydata.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return vtk_to_numpy(polydata.GetPoints().GetData()), triangles


def grid_of(result):
    """The hexes with all their arrays as a vtkUnstructuredGrid."""
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(result.points, deep=True))
    grid.SetPoints(points)
    ids = np.ascontiguousarray(result.hexes, dtype=np.int64).ravel()
    offsets = np.arange(0, ids.size + 1, 8, dtype=np.int64)
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtk(offsets, deep=True, array_type=vtkIdTypeArray().GetDataType()),
        numpy_to_vtk(ids, deep=True, array_type=vtkIdTypeArray().GetDataType()),
    )
    grid.SetCells(VTK_HEXAHEDRON, cells)
    for data, arrays in (
        (grid.GetCellData(), result.cell_data),
        (grid.GetPointData(), result.point_data),
    ):
        for name, values in arrays.items():
            array = numpy_to_vtk(values, deep=True)
            array.SetName(name)
            data.AddArray(array)
    return grid


def main():
    source, target = sys.argv[1:3]
    size = float(sys.argv[3]) if len(sys.argv) > 3 else None
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(source)
    triangulate = vtkTriangleFilter()
    triangulate.SetInputConnection(reader.GetOutputPort())
    smooth = vtkWindowedSincPolyDataFilter()
    smooth.SetInputConnection(triangulate.GetOutputPort())
    smooth.Update()

    result = hexwall.mesh(surface_of(smooth.GetOutput()), size=size, layers=2)
    print(result)

    half = vtkExtractGeometry()
    half.SetInputData(grid_of(result))
    plane = vtkPlane()
    plane.SetOrigin(result.points.mean(axis=0))
    half.SetImplicitFunction(plane)
    half.Update()
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(target)
    writer.SetInputData(half.GetOutput())
    writer.Write()
    print(f"{target}: {half.GetOutput().GetNumberOfCells()} of {len(result.hexes)} hexes")


if __name__ == "__main__":
    main()
