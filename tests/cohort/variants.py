#!/usr/bin/env python3
"""Makes a cohort to try the workflow on: copies of surfaces, scaled, sheared and dented at random.

    variants.py FOLDER COUNT SURFACE...

Every copy is a vessel of its own: its axes scaled by 0.8 to 1.25, sheared by up to 0.15, its wall
pushed to and fro by smooth waves of up to 2 % of its size. The same arguments make the same bytes.
cohort.tsv lists them with a target size that gives some 800 quads.
"""

import sys
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkMassProperties, vtkTriangleFilter
from vtkmodules.vtkIOGeometry import vtkSTLReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

QUADS = 800


def read(path):
    reader = vtkSTLReader() if path.suffix == ".stl" else vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    clean = vtkCleanPolyData()
    clean.SetInputConnection(reader.GetOutputPort())
    clean.PointMergingOn()
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(clean.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()


def varied(surface, random):
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    center = points.mean(axis=0)
    size = np.ptp(points, axis=0).max()
    matrix = np.diag(random.uniform(0.8, 1.25, 3)) + random.uniform(-0.15, 0.15, (3, 3))
    moved = (points - center) @ matrix.T
    for _ in range(3):
        wave = random.normal(size=3) * 2.0 / size
        push = random.normal(size=3)
        push *= 0.02 / 3.0 * size / np.linalg.norm(push)
        moved += np.sin(moved @ wave + random.uniform(0.0, 6.3))[:, None] * push
    result = vtkPolyData()
    locations = vtkPoints()
    locations.SetDataTypeToDouble()
    locations.SetData(numpy_to_vtk(moved + center, deep=True))
    result.SetPoints(locations)
    result.SetPolys(surface.GetPolys())
    return result


def area(surface):
    properties = vtkMassProperties()
    properties.SetInputData(surface)
    properties.Update()
    return properties.GetSurfaceArea()


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    sources = [Path(name) for name in sys.argv[3:]]
    surfaces = [read(path) for path in sources]
    rows = ["case\tsurface\toptions\tsource"]
    for i in range(int(sys.argv[2])):
        source = i % len(sources)
        surface = varied(surfaces[source], np.random.default_rng(i))
        name = f"{i:03d}_{sources[source].stem}"
        writer = vtkXMLPolyDataWriter()
        writer.SetFileName(str(folder / f"{name}.vtp"))
        writer.SetInputData(surface)
        writer.Write()
        options = f"--size {np.sqrt(area(surface) / QUADS):.4g} --write vtu"
        rows.append(f"{name}\t{name}.vtp\t{options}\t{sources[source].name}")
    (folder / "cohort.tsv").write_text("\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
