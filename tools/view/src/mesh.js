// The mesh of the view: unpacked from the page, and which of its faces are seen where it is cut.

const FACES = {
  hexahedron: [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]],
  quad: [[0, 1, 2, 3]],
};

const TYPES = { f32: Float32Array, u32: Uint32Array, u8: Uint8Array };

async function inflate(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

// Numbers of corners are written as differences to the cell before.
function undoDifferences(corners, width) {
  for (let i = width; i < corners.length; ++i) corners[i] += corners[i - width];
}

// The face on the other side of each face: its number, or -1 at the boundary. A face and its
// opposite share their lowest vertex and the one across from it.
function pairFaces(mesh) {
  const { corners, faces, width, cells } = mesh;
  const n = faces.length;
  const other = new Int32Array(cells * n).fill(-1);
  const points = mesh.points.length / 3;
  const seen = new Map();
  for (let c = 0; c < cells; ++c) {
    for (let f = 0; f < n; ++f) {
      const v = faces[f].map((k) => corners[c * width + k]);
      const low = v.indexOf(Math.min(...v));
      const key = v[low] * points + v[(low + 2) % 4];
      const id = c * n + f;
      const twin = seen.get(key);
      if (twin === undefined) {
        seen.set(key, id);
      } else {
        other[id] = twin;
        other[twin] = id;
        seen.delete(key);
      }
    }
  }
  return other;
}

function centers(mesh) {
  const { corners, points, width, cells } = mesh;
  const result = new Float32Array(3 * cells);
  for (let c = 0; c < cells; ++c) {
    for (let k = 0; k < width; ++k) {
      for (let d = 0; d < 3; ++d) {
        result[3 * c + d] += points[3 * corners[c * width + k] + d] / width;
      }
    }
  }
  return result;
}

export async function unpack(meta, base64) {
  const buffer = await inflate(base64);
  const blocks = {};
  let offset = 0;
  for (const { name, type, count } of meta.blocks) {
    blocks[name] = new TYPES[type](buffer, offset, count);
    offset += 4 * Math.ceil((count * TYPES[type].BYTES_PER_ELEMENT) / 4);
  }
  const faces = FACES[meta.shape];
  const width = Math.max(...faces.flat()) + 1;
  undoDifferences(blocks.corners, width);
  const mesh = { points: blocks.points, corners: blocks.corners, faces, width };
  mesh.cells = mesh.corners.length / width;
  mesh.other = faces.length > 1 ? pairFaces(mesh) : new Int32Array(mesh.cells).fill(-1);
  mesh.centers = centers(mesh);
  mesh.arrays = meta.arrays.map((a) => ({ ...a, values: blocks[a.name] }));
  return mesh;
}

// Faces of the cells that are kept, towards those that are not or out of the mesh: as vtk.js wants
// them, and the cell of each. `keep(x, y, z)` is asked for centres of cells.
export function visibleFaces(mesh, keep) {
  const { corners, faces, width, cells, other, centers: at } = mesh;
  const n = faces.length;
  const kept = new Uint8Array(cells);
  for (let c = 0; c < cells; ++c) kept[c] = keep(at[3 * c], at[3 * c + 1], at[3 * c + 2]) ? 1 : 0;
  const isSeen = (id) => other[id] < 0 || !kept[Math.floor(other[id] / n)];
  let count = 0;
  for (let id = 0; id < cells * n; ++id) {
    if (kept[Math.floor(id / n)] && isSeen(id)) ++count;
  }
  const polys = new Uint32Array(5 * count);
  const cellOf = new Uint32Array(count);
  let i = 0;
  for (let c = 0; c < cells; ++c) {
    if (!kept[c]) continue;
    for (let f = 0; f < n; ++f) {
      if (!isSeen(c * n + f)) continue;
      polys[5 * i] = 4;
      for (let k = 0; k < 4; ++k) polys[5 * i + k + 1] = corners[c * width + faces[f][k]];
      cellOf[i++] = c;
    }
  }
  return { polys, cellOf };
}
