// Opens a page of `billet report` in a browser, as a user would, and looks at what it shows.
//
// usage: browser_test.mjs PACKAGES PAGE.html [--pictures FOLDER] [--field NAME]
//          [--reference PICTURE.png [--store]] [--failure]
//
// --reference compares the field in the middle frame with a stored picture, or stores it with --store. --failure:
// the report is of a run that could not solve its first increment.
//
// PACKAGES holds node_modules with playwright-core. The browser is Debian's chromium, or what
// BILLET_BROWSER names; WebGL is drawn in software. Fails on a request for anything but the page,
// on an error in the console, and where the picture does not follow the controls.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import os from 'node:os';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const words = process.argv.slice(2);
const option = (name) => {
  const at = words.indexOf(name);
  return at < 0 ? undefined : words.splice(at, 2)[1];
};
const pictures = option('--pictures');
const field = option('--field') ?? 'plastic_strain';
const reference = option('--reference');
const flag = (name) => {
  const at = words.indexOf(name);
  return at >= 0 && words.splice(at, 1).length > 0;
};
const stores = flag('--store');
assert.ok(reference || !stores, '--store needs --reference');
const is_failure = flag('--failure');
const [packages, page] = words;
const { chromium } = createRequire(path.join(path.resolve(packages), 'package.json'))('playwright-core');

const profile = fs.mkdtempSync(path.join(os.tmpdir(), 'billet-browser-'));
const context = await chromium.launchPersistentContext(profile, {
  executablePath: process.env.BILLET_BROWSER ?? '/usr/bin/chromium',
  headless: true,
  viewport: { width: 1200, height: 1000 },
  args: [
    '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-sandbox',
    '--disable-background-networking', '--disable-quic', '--no-first-run',
  ],
});
const failures = [];
const slow = 300_000; // a machine without a graphics card, and others on it [ms]

/** The picture of the view as it is: bytes, and how many colours it has. */
async function picture(tab, name) {
  const canvas = tab.locator('#view canvas').first();
  const bytes = await canvas.screenshot({ timeout: slow });
  if (pictures) fs.writeFileSync(path.join(pictures, `${name}.png`), bytes);
  const colours = await tab.evaluate(async (text) => {
    const image = new Image();
    image.src = `data:image/png;base64,${text}`;
    await image.decode();
    const drawn = new OffscreenCanvas(image.width, image.height).getContext('2d');
    drawn.drawImage(image, 0, 0);
    const { data } = drawn.getImageData(0, 0, image.width, image.height);
    const counts = new Map();
    for (let i = 0; i < data.length; i += 4) {
      const key = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
      counts.set(key, (counts.get(key) ?? 0) + 1);
    }
    const vivid = [...counts].filter(([key]) => {
      const rgb = [key >> 16, (key >> 8) & 255, key & 255];
      return Math.max(...rgb) - Math.min(...rgb) > 60;
    });
    return { all: counts.size, vivid: vivid.reduce((sum, [, n]) => sum + n, 0) / (image.width * image.height) };
  }, bytes.toString('base64'));
  return { bytes, ...colours };
}

/**
 * Compares a picture with a stored one, as the eye does: by the mean colours of squares of 8 pixels.
 * Other versions of the browser draw other edges and letters; a part that is missing, elsewhere or
 * of other colours differs in many squares.
 */
async function compare(tab, bytes, file) {
  if (stores) return fs.writeFileSync(file, bytes);
  const wanted = fs.readFileSync(file);
  const found = await tab.evaluate(async (texts) => {
    const [a, b] = await Promise.all(texts.map(async (text) => {
      const image = new Image();
      image.src = `data:image/png;base64,${text}`;
      await image.decode();
      const small = new OffscreenCanvas(Math.ceil(image.width / 8), Math.ceil(image.height / 8));
      const context = small.getContext('2d');
      context.imageSmoothingQuality = 'high';
      context.drawImage(image, 0, 0, small.width, small.height);
      return context.getImageData(0, 0, small.width, small.height);
    }));
    if (a.width !== b.width || a.height !== b.height) return { size: [a.width, a.height, b.width, b.height] };
    let others = 0;
    for (let i = 0; i < a.data.length; i += 4) {
      const largest = Math.max(...[0, 1, 2].map((c) => Math.abs(a.data[i + c] - b.data[i + c])));
      if (largest > 24) others += 1;
    }
    return { share: others / (a.data.length / 4) };
  }, [bytes, wanted].map((one) => one.toString('base64')));
  assert.equal(found.size, undefined, `${file} has another size: ${found.size}`);
  console.log(`${(100 * found.share).toFixed(2)} % of the view differ from ${path.basename(file)}`);
  assert.ok(found.share < 0.01, `the view is not that of ${file}`);
}

/** Sets a control and waits until the view has followed. */
async function set(tab, name, value) {
  await tab.evaluate(([control, wanted]) => {
    const input = document.querySelector(`#view [name="${control}"]`);
    if (input.type === 'checkbox') input.checked = wanted;
    else input.value = wanted;
    input.dispatchEvent(new Event(input.type === 'range' ? 'input' : 'change'));
  }, [name, value]);
}

/** A report of a run that could not begin: it says why, and shows the part as it was. */
async function look_at_failure(tab) {
  const text = await tab.locator('body').innerText();
  for (const wanted of [/could not be reached/, /What may help/, /frame 1 of 1/]) assert.match(text, wanted);
  await picture(tab, 'first');
  console.log('passed: a run without increments');
}

/** A report with frames: the view follows its controls. */
async function look_at_view(tab) {
  const view = (key) => tab.evaluate((name) => document.getElementById('view').dataset[name], key);
  const last = Number(await tab.evaluate(() => document.querySelector('#view [name=frame]').max));
  assert.equal(Number(await view('frame')), last, 'the last frame is shown first');
  const final = await picture(tab, 'last');
  assert.ok(final.all > 50, `only ${final.all} colours`);
  assert.ok(final.vivid > 0.01, 'the part has no colours');

  const canvas = await tab.locator('#view canvas').first().boundingBox();
  await tab.mouse.click(canvas.x + 0.4 * canvas.width, canvas.y + 0.8 * canvas.height);
  await tab.waitForTimeout(300);
  const probed = await tab.locator('#view .probe').innerText();
  assert.match(probed, /^\(.*\) mm/, 'a click on the part shows no node');
  console.log(`probed: ${probed.replace('\n', ', ')}`);

  const middle = Math.floor(last / 2);
  await set(tab, 'frame', String(middle));
  await tab.waitForFunction((n) => document.getElementById('view').dataset.frame === String(n), middle, { timeout: slow });
  const before = await picture(tab, 'middle');
  if (last > 0) assert.notDeepEqual(before.bytes, final.bytes, 'the slider changes nothing');

  await set(tab, 'field', field);
  await tab.waitForFunction((key) => document.getElementById('view').dataset.field === key, field, { timeout: slow });
  const other = await picture(tab, 'field');
  assert.notDeepEqual(other.bytes, before.bytes, 'the field changes nothing');
  assert.match(await tab.locator('#view .legend').innerText(), new RegExp(field.replace(/_/g, ' ')));
  if (reference) await compare(tab, other.bytes, reference);

  const settled = () => tab.waitForTimeout(500);
  for (const [name, value] of [['section', true], ['revolve', true], ['mirror', true]]) {
    if (!(await tab.locator(`#view [name=${name}]`).count())) continue;
    if (name === 'mirror') await set(tab, 'revolve', false).catch(() => {});
    if (name === 'revolve') await set(tab, 'section', false);
    await set(tab, name, value);
    await settled();
    const shown = await picture(tab, name);
    assert.ok(shown.vivid > 0.005, `${name}: the part has no colours`);
    assert.notDeepEqual(shown.bytes, other.bytes, `${name} changes nothing`);
  }
  for (const look of ['x', 'iso', 'reset']) {
    const button = tab.locator(`#view [data-look="${look}"]`);
    if (await button.count()) await button.click({ timeout: slow });
    await settled();
    if (pictures) await picture(tab, `look-${look}`);
  }
  assert.ok((await tab.locator('figure.chart.live .u-over').count()) > 2, 'curves answer to the mouse');
  console.log(`passed: ${last + 1} frames`);
}

try {
  const tab = await context.newPage();
  tab.on('request', (request) => {
    if (!/^(file|data|blob):/.test(request.url())) failures.push(`asks for ${request.url()}`);
  });
  tab.on('pageerror', (error) => failures.push(`error: ${error.message}`));
  tab.on('console', (message) => {
    if (message.type() === 'error') failures.push(`console: ${message.text()}`);
  });
  const begin = Date.now();
  await tab.goto(pathToFileURL(path.resolve(page)).href, { timeout: slow });
  await tab.waitForFunction(() => ['ready', 'failed'].includes(document.documentElement.dataset.report), null, {
    timeout: slow,
  });
  assert.equal(await tab.evaluate(() => document.documentElement.dataset.report), 'ready', failures.join('\n'));
  console.log(`open after ${((Date.now() - begin) / 1000).toFixed(1)} s`);

  await (is_failure ? look_at_failure(tab) : look_at_view(tab));
  if (pictures) await tab.screenshot({ path: path.join(pictures, 'page.png'), fullPage: true, timeout: slow });
  assert.deepEqual(failures, []);
} finally {
  await context.close();
  fs.rmSync(profile, { recursive: true, force: true });
}
