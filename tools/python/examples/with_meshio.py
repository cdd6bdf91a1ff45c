"""Reads a surface and writes the hexes of its wall in any format of meshio: XDMF, Exodus, MED, ...

    PYTHONPATH=build/python python3 tools/python/examples/with_meshio.py SURFACE OUT.xdmf [SIZE]
"""

import sys

import hexwall
import meshio


def meshio_of(result):
    """The hexes with their arrays, and a cell set for each zone."""
    zone = result.cell_data["zone"]
    sets = {name: [(zone == i).nonzero()[0]] for i, name in enumerate(result.zone_names)}
    return meshio.Mesh(
        result.points,
        [("hexahedron", result.hexes)],
        point_data=result.point_data,
        cell_data={name: [values] for name, values in result.cell_data.items()},
        cell_sets=sets,
    )


def main():
    source, target = sys.argv[1:3]
    size = float(sys.argv[3]) if len(sys.argv) > 3 else None
    surface = meshio.read(source)
    result = hexwall.mesh((surface.points, surface.cells_dict["triangle"]), size=size, layers=2)
    meshio_of(result).write(target)
    print(f"{target}: {len(result.hexes)} hexes")


if __name__ == "__main__":
    main()
