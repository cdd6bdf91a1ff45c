"""Linear hexes and tets with their results, for ParaView and hexwall-picture."""

from results import max_principal, von_mises

VTK_TETRA, VTK_HEXAHEDRON = 10, 12


def array(name, kind, components, rows):
    return (
        f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}"'
        ' format="ascii">\n' + "\n".join(rows) + "\n</DataArray>\n"
    )


def reals(name, components, rows):
    return array(name, "Float64", components, [" ".join(f"{x:.9g}" for x in row) for row in rows])


def integers(name, kind, rows):
    return array(name, kind, 1, [" ".join(map(str, row)) for row in rows])


def cells_of(mesh, index):
    corners = mesh.corners
    kind = VTK_HEXAHEDRON if corners == 8 else VTK_TETRA
    ends = ([corners * i] for i in range(1, len(mesh.elements) + 1))
    return (
        integers("connectivity", "Int64", [[index[n] for n in e] for e in mesh.elements.values()])
        + integers("offsets", "Int64", ends)
        + integers("types", "UInt8", [[kind]] * len(mesh.elements))
    )


def piece(mesh, solution, shift):
    nodes = list(mesh.nodes)
    index = {n: i for i, n in enumerate(nodes)}
    stress = [solution.nodal[n] for n in nodes]
    points = [[x + s for x, s in zip(point, shift)] for point in mesh.nodes.values()]
    return (
        f'<Piece NumberOfPoints="{len(nodes)}" NumberOfCells="{len(mesh.elements)}">\n'
        + "<Points>\n" + reals("points", 3, points) + "</Points>\n"
        + "<Cells>\n" + cells_of(mesh, index) + "</Cells>\n<PointData>\n"
        + reals("u [mm]", 3, [solution.u[n] for n in nodes])
        + reals("sigma_1 [MPa]", 1, [[max_principal(s)] for s in stress])
        + reals("von Mises [MPa]", 1, [[von_mises(s)] for s in stress])
        + "</PointData>\n</Piece>\n"
    )  # fmt: skip


def write_vtu(path, parts):
    """Meshes of linear elements, each with its solution, and shifted by a vector."""
    with open(path, "w") as file:
        file.write('<VTKFile type="UnstructuredGrid" version="0.1"><UnstructuredGrid>\n')
        file.writelines(piece(*part) for part in parts)
        file.write("</UnstructuredGrid></VTKFile>\n")
