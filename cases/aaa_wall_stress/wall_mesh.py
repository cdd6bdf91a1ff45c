"""Meshes in the format of Abaqus and CalculiX: read, written, made quadratic; faces of elements."""

# Corners of the faces S1 … of an element, by its number of corners; their normals point inwards.
FACES = {
    8: (
        (0, 1, 2, 3),
        (4, 7, 6, 5),
        (0, 4, 5, 1),
        (1, 5, 6, 2),
        (2, 6, 7, 3),
        (3, 7, 4, 0),
    ),
    4: ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)),
}
# The edges on which the nodes of a quadratic element lie, in the order of CalculiX.
EDGES = {
    8: (
        *((0, 1), (1, 2), (2, 3), (3, 0)),
        *((4, 5), (5, 6), (6, 7), (7, 4)),
        *((0, 4), (1, 5), (2, 6), (3, 7)),
    ),
    4: ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
}
CORNERS = {"C3D8": 8, "C3D8I": 8, "C3D20R": 8, "C3D4": 4, "C3D10": 4}
NUMBERS_PER_LINE = 12


class Mesh:
    """Nodes and elements have numbers as in the file; `sets` are lists of elements, `patches` of
    (element, face)."""

    def __init__(self, kind):
        self.kind = kind  # CalculiX' name of the element
        self.nodes = {}
        self.elements = {}
        self.sets = {}
        self.patches = {}

    @property
    def corners(self):
        return CORNERS[self.kind]

    def face(self, element, face):
        """Corner nodes, counter-clockwise from inside the wall."""
        nodes = self.elements[element]
        return tuple(nodes[i] for i in FACES[self.corners][face])

    def nodes_of_face(self, element, face):
        """All nodes, those on the edges included."""
        nodes, on_face = self.elements[element], FACES[self.corners][face]
        if len(nodes) == self.corners:
            return [nodes[i] for i in on_face]
        between = enumerate(EDGES[self.corners], self.corners)
        return [nodes[i] for i in on_face] + [
            nodes[k] for k, edge in between if edge[0] in on_face and edge[1] in on_face
        ]

    def nodes_of_patch(self, name):
        return sorted({n for face in self.patches[name] for n in self.nodes_of_face(*face)})

    def boundary_faces(self):
        return [(name, face) for name, faces in self.patches.items() for face in faces]


def keyword_of(line):
    name, *parameters = line.strip("* \n").split(",")
    pairs = [parameter.partition("=") for parameter in parameters]
    return name.strip().upper(), {key.strip().upper(): value.strip() for key, _, value in pairs}


def read_element(mesh, line, name):
    number, *nodes = map(int, line.split(","))
    mesh.elements[number] = tuple(nodes)
    mesh.sets.setdefault(name, []).append(number)


def read_inp(path):
    """The mesh that hexwall, or `write_inp` in linear elements, has written."""
    mesh, name, parameters = Mesh(None), "", {}
    for line in open(path):
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            name, parameters = keyword_of(line)
            if name == "ELEMENT":
                mesh.kind = parameters["TYPE"]
        elif name == "NODE":
            number, *point = line.split(",")
            mesh.nodes[int(number)] = tuple(map(float, point))
        elif name == "ELEMENT":
            read_element(mesh, line, parameters["ELSET"])
        elif name == "SURFACE":
            element, face = line.split(",")
            patch = mesh.patches.setdefault(parameters["NAME"], [])
            patch.append((int(element), int(face.strip(" S\n")) - 1))
    return mesh


def in_lines(numbers):
    rows = (numbers[i : i + NUMBERS_PER_LINE] for i in range(0, len(numbers), NUMBERS_PER_LINE))
    return ",\n".join(", ".join(map(str, row)) for row in rows) + "\n"


def write_inp(mesh, path):
    """Sets of nodes and surfaces have the names of the patches."""
    with open(path, "w") as file:
        file.write("*NODE\n")
        for n, (x, y, z) in mesh.nodes.items():
            file.write(f"{n}, {x:.12g}, {y:.12g}, {z:.12g}\n")
        for name, elements in mesh.sets.items():
            file.write(f"*ELEMENT, TYPE={mesh.kind}, ELSET={name}\n")
            file.writelines(in_lines([e, *mesh.elements[e]]) for e in elements)
        for name, faces in mesh.patches.items():
            file.write(f"*NSET, NSET={name}\n" + in_lines(mesh.nodes_of_patch(name)))
            file.write(f"*SURFACE, NAME={name}, TYPE=ELEMENT\n")
            file.writelines(f"{e}, S{face + 1}\n" for e, face in faces)


def quadratic(mesh, kind):
    """The same elements with a node in the middle of each edge; edges stay straight."""
    fine, middle, last = Mesh(kind), {}, max(mesh.nodes)
    fine.nodes, fine.sets, fine.patches = dict(mesh.nodes), mesh.sets, mesh.patches
    for element, nodes in mesh.elements.items():
        ends = [tuple(sorted((nodes[a], nodes[b]))) for a, b in EDGES[mesh.corners]]
        extra = tuple(middle.setdefault(pair, last + 1 + len(middle)) for pair in ends)
        fine.elements[element] = nodes + extra
    for (a, b), n in middle.items():
        fine.nodes[n] = tuple((x + y) / 2 for x, y in zip(mesh.nodes[a], mesh.nodes[b]))
    return fine
