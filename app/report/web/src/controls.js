// The controls around the view. Each of them changes one entry of the settings and says so.

import { gradient } from './colours.js';

function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes))
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else if (value !== undefined && value !== false) node.setAttribute(name, value === true ? '' : value);
  node.append(...children);
  return node;
}

function check(label, settings, key, changed) {
  const box = element('input', { type: 'checkbox', name: key });
  box.checked = settings[key];
  box.addEventListener('change', () => {
    settings[key] = box.checked;
    changed(key);
  });
  return element('label', {}, box, label);
}

function choice(name, entries, settings, changed) {
  const select = element('select', { name });
  for (const [value, label] of entries) select.append(element('option', { value }, label));
  select.value = settings[name];
  select.addEventListener('change', () => {
    settings[name] = select.value;
    changed(name);
  });
  return select;
}

function figure(name, settings, changed, title) {
  const box = element('input', { type: 'number', step: 'any', name, title });
  box.value = settings[name];
  box.addEventListener('change', () => {
    if (!Number.isFinite(box.valueAsNumber)) return;
    settings[name] = box.valueAsNumber;
    changed(name);
  });
  return box;
}

const group = (title, ...children) => element('span', { class: 'group' }, element('b', {}, title), ...children);

function fieldControls(quantities, settings, changed) {
  const entries = quantities.map(({ key, label, unit }) => [key, unit ? `${label} [${unit}]` : label]);
  const limits = element('span', { class: 'group' },
    figure('low', settings, changed, 'colours from'), 'to', figure('high', settings, changed, 'colours to'));
  const range = choice('range', [
    ['frame', 'frame, 2nd to 98th percentile'],
    ['whole', 'frame, all values'],
    ['run', 'all frames'],
    ['fixed', 'fixed'],
  ], settings, (key) => {
    limits.hidden = settings.range !== 'fixed';
    changed(key);
  });
  limits.hidden = settings.range !== 'fixed';
  return [
    group('Field', choice('field', [['', 'none'], ...entries], settings, changed)),
    group('Colours', range, limits),
  ];
}

function sectionControls(settings, changed) {
  const position = element('input', { type: 'range', min: 0, max: 100, step: 0.5, name: 'position' });
  position.value = settings.position;
  position.addEventListener('input', () => {
    settings.position = Number(position.value);
    changed('position');
  });
  const where = element('output', { name: 'section-at' });
  const normal = element('span', { class: 'group' },
    figure('nx', settings, changed, 'normal, x'), figure('ny', settings, changed, 'normal, y'),
    figure('nz', settings, changed, 'normal, z'));
  const direction = choice('normal', [['x', 'across x'], ['y', 'across y'], ['z', 'across z'], ['free', 'normal:']],
    settings, (key) => {
      normal.hidden = settings.normal !== 'free';
      changed(key);
    });
  normal.hidden = settings.normal !== 'free';
  return group('Section', check('on', settings, 'section', changed), direction, normal, position, where,
    check('other half', settings, 'flip', changed), check('tools too', settings, 'cutTools', changed));
}

/**
 * @param about    {quantities, tools, planes, frames, solid, axisymmetric}
 * @param changed  called with the name of the entry of `settings` that has changed
 * @param look     called with the name of a standard view
 */
export function makeControls(container, about, settings, { changed, look, save }) {
  const views = about.solid || about.axisymmetric ? ['iso', 'iso, y up', 'x', 'y', 'z'] : ['z', 'iso'];
  const top = element('div', { class: 'bar-of-controls' },
    ...fieldControls(about.quantities, settings, changed),
    group('View',
      ...views.map((name) => element('button', { type: 'button', 'data-look': name, onclick: () => look(name) }, name)),
      element('button', { type: 'button', 'data-look': 'reset', onclick: () => look('reset') }, 'reset'),
      element('button', { type: 'button', title: 'save the view as a PNG', onclick: save }, 'picture')),
  );
  const show = [check('edges', settings, 'edges', changed)];
  if (about.axisymmetric) show.push(check('revolved', settings, 'revolve', changed));
  if (about.planes.length) show.push(check('mirrored', settings, 'mirror', changed));
  const parts = element('div', { class: 'bar-of-controls' }, group('Show', ...show));
  if (about.tools.length)
    parts.append(group('Tools',
      ...about.tools.map((tool) => check(tool, settings.tools, tool, () => changed('tools'))),
      check('see-through', settings, 'ghost', changed)));
  parts.append(sectionControls(settings, changed));

  const canvas = element('div', { class: 'canvas' });
  const probe = element('div', { class: 'probe' });
  const legend = element('div', { class: 'legend' });
  const stage = element('div', { class: 'stage' }, canvas, legend, probe);

  const slider = element('input', { type: 'range', min: 0, max: about.frames - 1, step: 1, name: 'frame' });
  slider.value = settings.frame;
  slider.addEventListener('input', () => {
    settings.frame = Number(slider.value);
    changed('frame');
  });
  const time = element('output', { name: 'time' });
  const play = element('button', { type: 'button', name: 'play', title: 'play the frames' }, '▶');
  const below = element('div', { class: 'bar-of-controls below' },
    element('span', { class: 'time' }, play, slider, time));
  container.replaceChildren(top, parts, stage, below);
  return { canvas, probe, legend, slider, time, play, where: parts.querySelector('[name=section-at]') };
}

const digits = (value) => String(+value.toPrecision(4));

export function showLegend(legend, quantity, { low, high, least, largest }) {
  legend.hidden = !quantity;
  if (!quantity) return;
  const unit = quantity.unit ? ` [${quantity.unit}]` : '';
  const ticks = [0, 1, 2, 3, 4].map((i) => element('span', {}, digits(high - (i / 4) * (high - low))));
  const colours = element('div', { class: 'colours', style: `background:${gradient}` });
  legend.replaceChildren(
    element('div', {},
      element('div', { class: 'name' }, quantity.label + unit),
      element('div', { style: 'display:flex;gap:8px' }, colours, element('div', { class: 'ticks' }, ...ticks)),
      element('div', { class: 'all' }, `smallest ${digits(least)}`),
      element('div', { class: 'all', style: 'margin:0' }, `largest ${digits(largest)}`)));
}

/** Moves a slider on from frame to frame until it is pressed again. */
export function makePlay(button, slider) {
  let timer;
  const stop = () => {
    clearInterval(timer);
    timer = undefined;
    button.textContent = '▶';
  };
  button.addEventListener('click', () => {
    if (timer) return stop();
    if (slider.value === slider.max) slider.value = -1;
    button.textContent = '❚❚';
    timer = setInterval(() => {
      if (slider.value === slider.max) return stop();
      slider.value = Number(slider.value) + 1;
      slider.dispatchEvent(new Event('input'));
    }, 220);
  });
}
