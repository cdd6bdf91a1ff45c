// Colours of values and their legend.

import vtkColorTransferFunction from '@kitware/vtk.js/Rendering/Core/ColorTransferFunction';

// Dark blue to yellow, evenly rising in lightness (samples of the viridis map).
const RAMP = [
  [0.267, 0.005, 0.329], [0.254, 0.265, 0.53], [0.164, 0.471, 0.558], [0.135, 0.659, 0.518],
  [0.478, 0.821, 0.318], [0.993, 0.906, 0.144],
];

// For numbers that are only names.
const CATEGORIES = [
  [0.4, 0.65, 0.85], [0.99, 0.75, 0.44], [0.6, 0.82, 0.53], [0.94, 0.52, 0.52],
  [0.75, 0.66, 0.87], [0.77, 0.62, 0.52], [0.97, 0.71, 0.82], [0.72, 0.72, 0.72],
];

const css = (c) => `rgb(${c.map((x) => Math.round(255 * x)).join(',')})`;
const category = (i) => CATEGORIES[i % CATEGORIES.length];

export function rangeOf(array) {
  if (array.labels) return [-0.5, array.labels.length - 0.5];
  if (array.range) return array.range;
  let low = Infinity;
  let high = -Infinity;
  for (const x of array.values) {
    low = Math.min(low, x);
    high = Math.max(high, x);
  }
  return high > low ? [low, high] : [low, low + 1];
}

export function tableOf(array) {
  const table = vtkColorTransferFunction.newInstance();
  if (array.labels) {
    array.labels.forEach((_, i) => {
      const [r, g, b] = category(i);
      table.addRGBPoint(i - 0.49, r, g, b);
      table.addRGBPoint(i + 0.49, r, g, b);
    });
  } else {
    const [low, high] = rangeOf(array);
    RAMP.forEach(([r, g, b], i) => {
      table.addRGBPoint(low + ((high - low) * i) / (RAMP.length - 1), r, g, b);
    });
  }
  return table;
}

const span = (text, style) => {
  const element = document.createElement('span');
  element.textContent = text;
  if (style) element.style.cssText = style;
  return element;
};

export function showLegend(element, array) {
  element.replaceChildren();
  if (array.labels) {
    array.labels.forEach((label, i) => {
      element.append(span('', `background:${css(category(i))}`), span(label));
      element.children[2 * i].className = 'swatch';
    });
    return;
  }
  const [low, high] = rangeOf(array);
  const bar = span('', `background:linear-gradient(90deg,${RAMP.map(css).join(',')})`);
  bar.className = 'ramp';
  const text = (x) => Number(x.toPrecision(4)).toString();
  element.append(span(text(low)), bar, span(`${text(high)} ${array.unit ?? ''}`));
}
