// The curves of the page by uPlot, in place of the pictures that stand there.

import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';

const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const sync = uPlot.sync('time');

const increases = (x) => x.every((value, i) => i === 0 || value >= x[i - 1]);

/** Abscissae that occur once, as uPlot wants them: of equal ones the last counts. */
function unique({ x, y }) {
  const [xs, ys] = [[], []];
  x.forEach((value, i) => {
    if (xs.length && xs[xs.length - 1] === value) ys[ys.length - 1] = y[i];
    else (xs.push(value), ys.push(y[i]));
  });
  return [xs, ys];
}

function format(value) {
  if (value === null || value === undefined) return '–';
  const size = Math.abs(value);
  return size !== 0 && (size < 1e-3 || size >= 1e6) ? value.toExponential(2) : String(+value.toPrecision(5));
}

function options(chart, width, marks) {
  const axis = (label) => ({
    label,
    stroke: style('--soft'),
    grid: { stroke: style('--rule'), width: 1 },
    ticks: { stroke: style('--rule') },
    values: (_, ticks) => ticks.map((tick) => (tick === null ? '' : format(tick))),
    size: label === chart.y ? 72 : 44,
    labelSize: 20,
    font: '12px system-ui, sans-serif',
    labelFont: '12px system-ui, sans-serif',
  });
  return {
    width,
    height: 300,
    scales: { x: { time: false }, y: { distr: chart.logarithmic ? 3 : 1 } },
    axes: [axis(chart.x), axis(chart.y)],
    cursor: chart.over_time ? { sync: { key: sync.key } } : {},
    series: [
      { label: chart.x, value: (_, value) => format(value) },
      ...chart.curves.map((curve, i) => ({
        label: curve.label,
        stroke: style(`--c${(i % 6) + 1}`),
        width: 1.8,
        spanGaps: true,
        points: { show: curve.x.length < 2 },
        value: (_, value) => format(value),
      })),
    ],
    hooks: { draw: [(plot) => chart.over_time && drawMark(plot, marks.time)] },
  };
}

/** The time that the view shows. */
function drawMark(plot, time) {
  if (time === undefined) return;
  const x = plot.valToPos(time, 'x', true);
  const { left, top, width, height } = plot.bbox;
  if (x < left || x > left + width) return;
  plot.ctx.save();
  plot.ctx.strokeStyle = style('--accent');
  plot.ctx.setLineDash([4, 4]);
  plot.ctx.beginPath();
  plot.ctx.moveTo(x, top);
  plot.ctx.lineTo(x, top + height);
  plot.ctx.stroke();
  plot.ctx.restore();
}

function show(chart, marks) {
  const figure = document.getElementById(`chart-${chart.id}`);
  if (!figure || !chart.curves.every((curve) => increases(curve.x))) return undefined;
  const picture = figure.querySelector('svg');
  const place = document.createElement('div');
  place.className = 'plot';
  picture.before(place);
  const inside = () => Math.max(place.clientWidth, 200);
  const data = uPlot.join(chart.curves.map(unique));
  let plot = new uPlot(options(chart, inside(), marks), data, place);
  new ResizeObserver(() => {
    if (Math.abs(plot.width - inside()) > 1) plot.setSize({ width: inside(), height: 300 });
  }).observe(place);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    plot.destroy();
    plot = new uPlot(options(chart, inside(), marks), data, place);
  });
  figure.classList.add('live');
  return { redraw: () => plot.redraw(false) };
}

export function showCharts(charts) {
  const marks = {};
  const shown = charts.map((chart) => show(chart, marks)).filter(Boolean);
  return {
    mark(time) {
      marks.time = time;
      shown.forEach((plot) => plot.redraw());
    },
  };
}
