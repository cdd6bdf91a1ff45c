// Opens a report in a headless Chromium and uses its 3-D view as people do.
//
//   node drive_view.mjs REPORT NODE_MODULES CHROMIUM [SCREENSHOT_PREFIX]
//
// Prints one JSON object: console messages and errors, requests beyond the file itself, and what share
// of the view's pixels changes with each thing that is done.

import { createRequire } from 'node:module';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [report, modules, browserPath, prefix] = process.argv.slice(2);
const require = createRequire(join(resolve(modules), 'here.js'));
const { chromium } = require('playwright-core');

const profile = mkdtempSync(join(tmpdir(), 'hexwall-view-'));
const context = await chromium.launchPersistentContext(profile, {
  executablePath: browserPath,
  headless: true,
  viewport: { width: 1200, height: 1000 },
  args: [
    '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-sync',
    '--disable-background-networking', '--disable-component-update', '--use-gl=angle',
    '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist',
  ],
});

const result = { messages: [], requests: [], changed: {} };
try {
  const page = await context.newPage();
  page.on('console', (m) => {
    if (m.type() === 'error') result.messages.push(m.text());
  });
  page.on('pageerror', (error) => result.messages.push(`exception: ${error.message}`));
  page.on('request', (request) => {
    if (!/^(file|data|blob):/.test(request.url())) result.requests.push(request.url());
  });
  await page.goto(pathToFileURL(resolve(report)).href);
  const view = page.locator('#view');
  await page.waitForFunction(() => document.getElementById('view')?.dataset.state !== undefined, null,
    { timeout: 60000 });
  result.state = await view.evaluate((element) => element.dataset.state);
  await view.scrollIntoViewIfNeeded();

  // How many pixels of the view differ from the last look at it; from white, the first time. By way
  // of a picture of the page: what people see.
  const look = async () => {
    await page.waitForTimeout(200);
    const png = (await view.screenshot()).toString('base64');
    return page.evaluate(async (data) => {
      const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
      const canvas = new OffscreenCanvas(image.width, image.height);
      const drawing = canvas.getContext('2d');
      drawing.drawImage(image, 0, 0);
      const now = drawing.getImageData(0, 0, image.width, image.height).data;
      const before = window.lastLook ?? new Uint8ClampedArray(now.length).fill(255);
      window.lastLook = now;
      let count = 0;
      for (let i = 0; i < now.length; i += 4) {
        const difference = Math.abs(now[i] - before[i]) + Math.abs(now[i + 1] - before[i + 1]) +
          Math.abs(now[i + 2] - before[i + 2]);
        if (difference > 30) ++count;
      }
      return count / (now.length / 4);
    }, png);
  };
  result.drawn = await look();
  const after = async (name, action) => {
    await action();
    result.changed[name] = await look();
    if (prefix) await page.screenshot({ path: `${prefix}${name}.png` });
  };
  const box = await view.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  if (prefix) await page.screenshot({ path: `${prefix}page.png`, fullPage: true });
  await after('nothing', async () => {});
  await after('drag', async () => {
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 150, y + 60, { steps: 5 });
    await page.mouse.up();
  });
  await after('wheel', async () => {
    await page.mouse.wheel(0, -400);
  });
  await after('colour', () => page.selectOption('#view-colour', 'scaled_jacobian'));
  await after('edges', () => page.uncheck('#view-edges'));
  await after('cut', () => page.selectOption('#view-cut', 'eye'));
  await after('place', () => page.locator('#view-place').fill('0.3'));
  await after('flip', () => page.check('#view-flip'));
  result.legend = await page.locator('#view-legend').innerText();
  await after('thickness', () => page.selectOption('#view-colour', 'thickness_ratio'));
} finally {
  await context.close();
  rmSync(profile, { recursive: true, force: true });
}
console.log(JSON.stringify(result));
