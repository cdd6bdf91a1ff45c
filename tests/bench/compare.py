#!/usr/bin/env python3
"""compare.py SURFACE FOLDER SIZE THICKNESS: runs the meshers and measures their meshes; see compare.sh."""

import json
import os
import shutil
import subprocess
import sys
import time

import meshio
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

HEXWALL = "build/hexwall"
RUNS = 3
LAYERS = 3


def timed(command, folder, output):
    """The least of some runs: seconds, CPU seconds, peak memory in MB, and whether all went well."""
    best = None
    for _ in range(RUNS):
        path = os.path.join(folder, output)  # not there before
        if os.path.isdir(path):
            shutil.rmtree(path)
        elif os.path.exists(path):
            os.remove(path)
        start = time.monotonic()
        process = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        run = {"seconds": time.monotonic() - start,
               "cpu_seconds": usage.ru_utime + usage.ru_stime,
               "peak_mb": usage.ru_maxrss / 1024, "ok": status == 0}
        if best is None or run["seconds"] < best["seconds"]:
            best = run
    return best


def surface_polydata(path):
    reader = {".stl": vtk.vtkSTLReader, ".vtp": vtk.vtkXMLPolyDataReader,
              ".vtk": vtk.vtkPolyDataReader}[os.path.splitext(path)[1]]()
    reader.SetFileName(path)
    clean = vtk.vtkCleanPolyData()
    clean.SetInputConnection(reader.GetOutputPort())
    clean.Update()
    return clean.GetOutput()


def loops_of(surface):
    """Boundary edges of a surface and the number of loops that they form."""
    edges = vtk.vtkFeatureEdges()
    edges.SetInputData(surface)
    edges.BoundaryEdgesOn()
    edges.FeatureEdgesOff()
    edges.NonManifoldEdgesOff()
    edges.ManifoldEdgesOff()
    connected = vtk.vtkPolyDataConnectivityFilter()
    connected.SetInputConnection(edges.GetOutputPort())
    connected.SetExtractionModeToAllRegions()
    connected.Update()
    return edges.GetOutput(), connected.GetNumberOfExtractedRegions()


def distances(points, target):
    """Of points to the nearest cells of a polydata."""
    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(target)
    locator.BuildLocator()
    at, cell, part, squared = [0.0] * 3, vtk.reference(0), vtk.reference(0), vtk.reference(0.0)
    result = []
    for p in points:
        locator.FindClosestPoint(p, at, cell, part, squared)
        result.append(float(squared) ** 0.5)
    return numpy.array(result)


def faces_of(path):
    """Points, quads and triangles of a surface mesh."""
    if path.endswith(".vtp"):
        data = surface_polydata(path)
        points = vtk_to_numpy(data.GetPoints().GetData())
        cells = [[data.GetCell(i).GetPointId(k) for k in range(data.GetCell(i).GetNumberOfPoints())]
                 for i in range(data.GetNumberOfCells())]
    else:
        mesh = meshio.read(path)
        points = mesh.points
        cells = [list(c) for block in mesh.cells if block.type in ("quad", "triangle")
                 for c in block.data]
    quads = numpy.array([c for c in cells if len(c) == 4], dtype=int).reshape(-1, 4)
    triangles = numpy.array([c for c in cells if len(c) == 3], dtype=int).reshape(-1, 3)
    return numpy.asarray(points, dtype=float), quads, triangles


def as_polydata(points, *kinds):
    data = vtk.vtkPolyData()
    vtk_points = vtk.vtkPoints()
    vtk_points.SetDataTypeToDouble()
    for p in points:
        vtk_points.InsertNextPoint(p)
    cells = vtk.vtkCellArray()
    for cell in (c for faces in kinds for c in faces):
        cells.InsertNextCell(len(cell))
        for v in cell:
            cells.InsertCellPoint(int(v))
    data.SetPoints(vtk_points)
    data.SetPolys(cells)
    return data


def measure_quads(path, surface):
    points, quads, triangles = faces_of(path)
    used = numpy.unique(numpy.concatenate([quads.ravel(), triangles.ravel()]))
    p = points[quads]
    along = numpy.roll(p, -1, axis=1) - p
    length = numpy.linalg.norm(along, axis=2)
    back = -numpy.roll(along, 1, axis=1)
    cosine = (along * back).sum(axis=2) / (length * numpy.roll(length, 1, axis=1))
    angle = numpy.degrees(numpy.arccos(numpy.clip(cosine, -1, 1)))
    mesh = as_polydata(points, quads, triangles)
    rims, loops = loops_of(mesh)
    rim_points = (vtk_to_numpy(rims.GetPoints().GetData()) if rims.GetNumberOfPoints()
                  else numpy.zeros((0, 3)))
    on_rim = {tuple(numpy.round(q, 9)) for q in rim_points}
    valence = numpy.bincount(quads.ravel(), minlength=len(points))
    valence += numpy.bincount(triangles.ravel(), minlength=len(points))
    inner = [v for v in used if tuple(numpy.round(points[v], 9)) not in on_rim]
    box = surface.GetBounds()
    diagonal = sum((box[2 * i + 1] - box[2 * i]) ** 2 for i in range(3)) ** 0.5
    input_rims, input_loops = loops_of(surface)
    quantiles = numpy.quantile(length, [0.05, 0.95])
    return {
        "quads": len(quads), "non_quads": len(triangles),
        "irregular": int(sum(valence[v] != 4 for v in inner)),
        "angle_stddev_deg": float(angle.std()),
        "edge_spread": float(quantiles[1] / quantiles[0]),
        "deviation_percent": float(100 * distances(points[used], surface).max() / diagonal),
        "loops": f"{loops}/{input_loops}",
        "loop_deviation_percent": float(100 * distances(rim_points, input_rims).max() / diagonal)
        if len(rim_points) else None,
    }


def quality(path):
    """The least scaled Jacobian, and the number of cells that have none."""
    done = subprocess.run([HEXWALL, "quality", path, "--json"], capture_output=True, text=True)
    if done.returncode != 0:
        return {"min_scaled_jacobian": None}
    figures = json.loads(done.stdout)["figures"]
    return {"min_scaled_jacobian": figures["min_scaled_jacobian"], "cells": figures["cells"]}


def gmsh_script(surface, size, wall):
    """Remeshing with recombined quads and, if `wall`, their extrusion along the normals."""
    return (f'Merge "{surface}";\nClassifySurfaces{{Pi, 1, 1, Pi}};\nCreateGeometry;\n'
            "Geometry.ExtrudeReturnLateralEntities = 0;\n"
            + (f"Extrude {{ Surface{{:}}; Layers{{{LAYERS}, {wall}}}; Using Index[0]; Recombine; }}\n"
               if wall else "")
            + "Mesh.RecombineAll = 1;\nMesh.MeshSizeExtendFromBoundary = 0;\n"
            + f"Mesh.MeshSizeMin = {size};\nMesh.MeshSizeMax = {size};\n")


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def closed_copy(surface, path):
    """The surface with flat caps, for TetGen."""
    holes = vtk.vtkFillHolesFilter()
    holes.SetInputData(surface)
    holes.SetHoleSize(1e9)
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputConnection(holes.GetOutputPort())
    writer = vtk.vtkSTLWriter()
    writer.SetInputConnection(triangles.GetOutputPort())
    writer.SetFileName(path)
    writer.SetFileTypeToASCII()
    writer.Write()


def compare(path, folder, size, thickness):
    surface = surface_polydata(path)
    full = os.path.abspath(path)
    program = os.path.abspath(HEXWALL)
    rows = {}

    options = ["--size", str(size), "--thickness", str(thickness), "--layers", str(LAYERS), "-q"]
    rows["hexwall, wall"] = timed(
        [program, "mesh", full, "-o", "hexwall", "--no-report", *options], folder,
                                   "hexwall")
    rows["hexwall, wall"] |= measure_quads(f"{folder}/hexwall/quads.vtp", surface)
    rows["hexwall, wall"] |= quality(f"{folder}/hexwall/wall.vtu")
    count = rows["hexwall, wall"]["quads"]

    for name, wall in (("quads", None), ("wall", thickness)):
        write(f"{folder}/gmsh_{name}.geo", gmsh_script(full, size, wall))
        key = f"gmsh, {name}"
        rows[key] = timed(["gmsh", "-3" if wall else "-2", f"gmsh_{name}.geo", "-o",
                           f"gmsh_{name}.msh", "-v", "0"], folder, f"gmsh_{name}.msh")
        if rows[key]["ok"]:
            rows[key] |= quality(f"{folder}/gmsh_{name}.msh")
    if rows["gmsh, quads"]["ok"]:
        rows["gmsh, quads"] |= measure_quads(f"{folder}/gmsh_quads.msh", surface)

    closed_copy(surface, f"{folder}/closed.stl")
    rows["tetgen, lumen"] = timed(
        ["tetgen", f"-pq1.414a{size ** 3 * 0.118}", "closed.stl"], folder, "closed.1.ele")

    others = {
        "quadriflow": ["-boundary", "-i", "input.obj", "-o", "quadriflow.obj", "-f", str(count)],
        "instant-meshes": ["input.obj", "-o", "instant-meshes.obj", "-f", str(count), "-b"],
        "quadwild": ["input.obj", "2"],
    }
    meshio.write(f"{folder}/input.obj", meshio.Mesh(
        vtk_to_numpy(surface.GetPoints().GetData()),
        [("triangle", vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3))]))
    for name, arguments in others.items():
        if shutil.which(name) is None:
            continue
        rows[name] = timed([name, *arguments], folder, f"{name}.obj")
        result = f"{folder}/{name}.obj"
        if rows[name]["ok"] and os.path.exists(result):
            rows[name] |= measure_quads(result, surface) | quality(result)
    return rows


COLUMNS = [("seconds", "s", ".2f"), ("cpu_seconds", "CPU s", ".2f"), ("peak_mb", "MB", ".0f"),
           ("cells", "cells", ".0f"), ("quads", "quads", "d"), ("non_quads", "non-quads", "d"),
           ("irregular", "irregular", "d"), ("angle_stddev_deg", "angle σ", ".1f"),
           ("edge_spread", "edges 95/5 %", ".2f"), ("min_scaled_jacobian", "min SJ", ".3f"),
           ("deviation_percent", "off surface %", ".3f"), ("loops", "loops", "s"),
           ("loop_deviation_percent", "off loops %", ".3f")]


def main():
    path, folder, size, thickness = sys.argv[1], sys.argv[2], float(sys.argv[3]), float(sys.argv[4])
    rows = compare(path, folder, size, thickness)
    print("| mesher | " + " | ".join(title for _, title, _ in COLUMNS) + " |")
    print("|---" * (len(COLUMNS) + 1) + "|")
    for name, row in rows.items():
        cells = [format(row[key], form) if row.get(key) is not None else "–"
                 for key, _, form in COLUMNS]
        print(f"| {name}{'' if row['ok'] else ' (failed)'} | " + " | ".join(cells) + " |")
    ours, theirs = rows["hexwall, wall"]["seconds"], rows["gmsh, wall"]["seconds"]
    print(f"\nthe wall takes gmsh {theirs / ours:.1f} times as long as hexwall")
    with open(os.path.join(folder, "compare.json"), "w", encoding="utf-8") as file:
        json.dump(rows, file, indent=1)


main()
