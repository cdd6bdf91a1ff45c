"""Values at points within tets."""

from math import floor

from wall_mesh import EDGES


def volume(a, b, c, d):
    """Six times the signed volume."""
    ux, uy, uz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    vx, vy, vz = c[0] - a[0], c[1] - a[1], c[2] - a[2]
    wx, wy, wz = d[0] - a[0], d[1] - a[1], d[2] - a[2]
    return ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx)


def barycentric(p, corners):
    a, b, c, d = corners
    whole = volume(a, b, c, d)
    parts = volume(p, b, c, d), volume(a, p, c, d), volume(a, b, p, d), volume(a, b, c, p)
    return [part / whole for part in parts]


class TetLocator:
    def __init__(self, tets, cell):
        """`cell` is the width of the grid, about that of a tet."""
        self.tets, self.cell, self.grid = tets, cell, {}
        for element, nodes in tets.elements.items():
            points = [tets.nodes[n] for n in nodes[:4]]
            (x0, x1), (y0, y1), (z0, z1) = (self.range_of(axis) for axis in zip(*points))
            for x in range(x0, x1 + 1):
                for y in range(y0, y1 + 1):
                    for z in range(z0, z1 + 1):
                        self.grid.setdefault((x, y, z), []).append(element)

    def range_of(self, coordinates):
        return floor(min(coordinates) / self.cell), floor(max(coordinates) / self.cell)

    def find(self, p):
        """The tet, and barycentric coordinates in it."""
        best = (-1.0, None, None)
        for element in self.grid.get(tuple(floor(x / self.cell) for x in p), ()):
            corners = [self.tets.nodes[n] for n in self.tets.elements[element][:4]]
            weights = barycentric(p, corners)
            best = max(best, (min(weights), element, weights))
            if best[0] >= 0:
                break
        return best[1:]


def shape_functions(weights, nodes):
    """Of 4 nodes: linear; of 10: quadratic."""
    if nodes == 4:
        return weights
    middle = [4 * weights[a] * weights[b] for a, b in EDGES[4]]
    return [w * (2 * w - 1) for w in weights] + middle
