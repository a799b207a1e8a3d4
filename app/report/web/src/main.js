// What the page does once it is open: curves that answer to the mouse, the view of the frames, and,
// of a run that goes on, asking for itself again.

import './report.css';
import { showCharts } from './charts.js';
import { keep, kept, reloadAfter } from './keep.js';
import { showFrames } from './viewer.js';

async function main() {
  const data = JSON.parse(document.getElementById('billet-data').textContent);
  const saved = kept();
  const charts = showCharts(data.charts);
  const container = document.getElementById('view');
  let viewer;
  const report = document.documentElement.dataset;
  report.report = 'loading';
  try {
    if (container && data.view) {
      if (typeof DecompressionStream === 'undefined')
        throw new Error('this browser is too old for it: it has no DecompressionStream');
      viewer = await showFrames(container, data.view, saved?.view, (time) => charts.mark(time));
    }
    report.report = 'ready';
  } catch (error) {
    report.report = 'failed';
    container.innerHTML = '<p class="missing"></p>';
    container.firstChild.textContent = `The view of the frames cannot be shown: ${error.message}`;
    console.error(error);
  }
  if (saved?.scroll) window.scrollTo(0, saved.scroll);
  reloadAfter(() => keep({ scroll: window.scrollY, view: viewer?.state() }));
}

main();
