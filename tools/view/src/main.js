// The 3-D view of report.html: turn, zoom, cut, colour. The page has the mesh in #view-data, what it
// consists of in #view-meta, and the controls.

import '@kitware/vtk.js/Rendering/Profiles/Geometry';

import vtkActor from '@kitware/vtk.js/Rendering/Core/Actor';
import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray';
import vtkGenericRenderWindow from '@kitware/vtk.js/Rendering/Misc/GenericRenderWindow';
import vtkMapper from '@kitware/vtk.js/Rendering/Core/Mapper';
import vtkPolyData from '@kitware/vtk.js/Common/DataModel/PolyData';

import { rangeOf, showLegend, tableOf } from './colours.js';
import { unpack, visibleFaces } from './mesh.js';

const byId = (id) => document.getElementById(id);

class View {
  constructor(mesh, container) {
    this.mesh = mesh;
    this.window = vtkGenericRenderWindow.newInstance({ background: [1, 1, 1], listenWindowResize: true });
    this.window.setContainer(container);
    this.window.resize();
    this.data = vtkPolyData.newInstance();
    this.data.getPoints().setData(mesh.points, 3);
    this.mapper = vtkMapper.newInstance({ interpolateScalarsBeforeMapping: true });
    this.mapper.setInputData(this.data);
    this.actor = vtkActor.newInstance();
    this.actor.setMapper(this.mapper);
    const look = this.actor.getProperty();
    look.setEdgeColor(0.15, 0.15, 0.2);
    look.setAmbient(0.25);
    look.setDiffuse(0.8);
    look.setInterpolationToFlat();
    this.window.getRenderer().addActor(this.actor);
    this.cut = null;
    this.update();
    this.reset();
  }

  // Anew after a change of the cut or the colours.
  update() {
    const { cut } = this;
    const keep = cut
      ? (x, y, z) => x * cut.normal[0] + y * cut.normal[1] + z * cut.normal[2] <= cut.offset
      : () => true;
    const { polys, cellOf } = visibleFaces(this.mesh, keep);
    this.data.getPolys().setData(polys);
    this.cellOf = cellOf;
    this.colour();
  }

  colourBy(array) {
    this.array = array;
    this.colour();
  }

  colour() {
    if (!this.array) return;
    const { array, cellOf, mesh } = this;
    const onCells = array.on === 'cells';
    const n = array.values.length;
    const values = onCells
      ? Float32Array.from(cellOf, (c) => array.values[c % n])
      : Float32Array.from({ length: mesh.points.length / 3 }, (_, i) => array.values[i % n]);
    const scalars = vtkDataArray.newInstance({ name: 'colour', values, numberOfComponents: 1 });
    this.data.getCellData().setScalars(onCells ? scalars : null);
    this.data.getPointData().setScalars(onCells ? null : scalars);
    if (onCells) this.mapper.setScalarModeToUseCellData();
    else this.mapper.setScalarModeToUsePointData();
    this.mapper.setLookupTable(tableOf(array));
    this.mapper.setScalarRange(...rangeOf(array));
    this.data.modified();
    this.render();
  }

  showEdges(shown) {
    this.actor.getProperty().setEdgeVisibility(shown);
    this.render();
  }

  // From where the page's pictures are taken, as near as the mesh fits in.
  reset() {
    const { eye, up } = this.mesh.camera;
    const right = [up[1] * eye[2] - up[2] * eye[1], up[2] * eye[0] - up[0] * eye[2],
      up[0] * eye[1] - up[1] * eye[0]];
    const middle = [0, 0, 0];
    const [width, height, depth] = [right, up, eye].map((direction) => {
      const [low, high] = this.extent(direction);
      for (let d = 0; d < 3; ++d) middle[d] += ((low + high) / 2) * direction[d];
      return high - low;
    });
    const renderer = this.window.getRenderer();
    const camera = renderer.getActiveCamera();
    const [pixelsAcross, pixelsUp] = this.window.getApiSpecificRenderWindow().getSize();
    const half = 0.53 * Math.max(height, (width * pixelsUp) / pixelsAcross);
    const distance = half / Math.tan((camera.getViewAngle() * Math.PI) / 360) + depth / 2;
    camera.setFocalPoint(...middle);
    camera.setPosition(...middle.map((x, d) => x + distance * eye[d]));
    camera.setViewUp(...up);
    renderer.resetCameraClippingRange();
    this.render();
  }

  eyeDirection() {
    return this.window.getRenderer().getActiveCamera().getDirectionOfProjection().map((x) => -x);
  }

  // Least and greatest place of the points along a direction.
  extent(normal) {
    const { points } = this.mesh;
    let low = Infinity;
    let high = -Infinity;
    for (let i = 0; i < points.length; i += 3) {
      const x = points[i] * normal[0] + points[i + 1] * normal[1] + points[i + 2] * normal[2];
      low = Math.min(low, x);
      high = Math.max(high, x);
    }
    return [low, high];
  }

  render() {
    this.window.getRenderWindow().render();
  }
}

const AXES = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

function connectCut(view) {
  const [across, place, flip] = ['view-cut', 'view-place', 'view-flip'].map(byId);
  let normal = null;
  const apply = () => {
    if (normal) {
      const [low, high] = view.extent(normal);
      const sign = flip.checked ? -1 : 1;
      const offset = low + (high - low) * place.valueAsNumber;
      view.cut = { normal: normal.map((x) => sign * x), offset: sign * offset };
    } else {
      view.cut = null;
    }
    place.disabled = flip.disabled = !normal;
    view.update();
  };
  across.addEventListener('change', () => {
    normal = across.value === 'eye' ? view.eyeDirection() : AXES[across.value] ?? null;
    apply();
  });
  place.addEventListener('input', apply);
  flip.addEventListener('change', apply);
}

function connectColours(view) {
  const select = byId('view-colour');
  for (const array of view.mesh.arrays) select.append(new Option(array.title, array.name));
  const apply = () => {
    const array = view.mesh.arrays.find((a) => a.name === select.value);
    view.colourBy(array);
    showLegend(byId('view-legend'), array);
  };
  select.addEventListener('change', apply);
  apply();
}

async function start() {
  const meta = JSON.parse(byId('view-meta').textContent);
  const mesh = await unpack(meta, byId('view-data').textContent);
  mesh.camera = meta.camera;
  const view = new View(mesh, byId('view'));
  connectColours(view);
  connectCut(view);
  const edges = byId('view-edges');
  edges.addEventListener('change', () => view.showEdges(edges.checked));
  view.showEdges(edges.checked);
  byId('view-reset').addEventListener('click', () => view.reset());
  byId('view').dataset.state = 'ready';
}

start().catch((error) => {
  byId('view').dataset.state = 'failed';
  byId('view').textContent = `The 3-D view needs a browser with WebGL 2 and DecompressionStream (${error.message}).`;
});
