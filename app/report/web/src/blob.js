// Reads the blobs of a page (app/report/blob.h): base64, deflated, arrays one after another.

async function inflated(text) {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

const known = new Map();

/** The bytes of a blob; a promise, the same each time. */
export function blob(number) {
  if (!known.has(number))
    known.set(number, inflated(document.getElementById(`blob-${number}`).textContent));
  return known.get(number);
}

export function integers(bytes, { at, n }) {
  const values = new Int32Array(n);
  let value = 0;
  for (let i = 0; i < n; ++i) {
    const step =
      (bytes[at + i] << 24) | (bytes[at + n + i] << 16) | (bytes[at + 2 * n + i] << 8) | bytes[at + 3 * n + i];
    value = (value + step) | 0;
    values[i] = value;
  }
  return values;
}

export function numbers(bytes, { at, n, low, high, levels }) {
  const values = new Float32Array(n);
  if (at < 0) return values.fill(low);
  const scale = (high - low) / levels;
  let step = 0;
  for (let i = 0; i < n; ++i) {
    step = (step + ((bytes[at + i] << 8) | bytes[at + n + i])) & 0xffff;
    values[i] = step === 65535 ? NaN : low + step * scale;
  }
  return values;
}

/** Components that are stored apart, one after another for each point. */
export function vectors(bytes, components) {
  const parts = components.map((about) => numbers(bytes, about));
  const width = parts.length;
  const values = new Float32Array(width * parts[0].length);
  parts.forEach((part, c) => part.forEach((value, i) => (values[width * i + c] = value)));
  return values;
}
