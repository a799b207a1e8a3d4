// Keeps the view over a reload of the page.

const key = `billet-report:${location.pathname}`;

export function keep(state) {
  try {
    sessionStorage.setItem(key, JSON.stringify(state));
  } catch {
    // A browser that keeps nothing shows the page from its start.
  }
}

export function kept() {
  try {
    return JSON.parse(sessionStorage.getItem(key) ?? 'null');
  } catch {
    return null;
  }
}

/** Loads the page again after the time that it names, unless the mouse is busy with it. */
export function reloadAfter(before) {
  const seconds = Number(document.querySelector('meta[name="reload-after"]')?.content);
  if (!seconds) return;
  let busy = false;
  addEventListener('pointerdown', () => (busy = true), true);
  addEventListener('pointerup', () => (busy = false), true);
  const reload = () => {
    if (busy || document.querySelector('details.menu[open]')) return void setTimeout(reload, 1000);
    before();
    location.reload();
  };
  setTimeout(reload, 1000 * seconds);
}
