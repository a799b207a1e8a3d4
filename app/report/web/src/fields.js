// What the workpiece can be coloured by: fields, their components, figures made of them.

const axes = ['x', 'y', 'z'];
const pairs = ['xx', 'yy', 'zz', 'xy', 'yz', 'xz'];

function magnitude(parts) {
  return parts[0].map((_, i) => Math.hypot(...parts.map((part) => part[i])));
}

/** Largest principal value of symmetric tensors, in closed form. */
function largestPrincipal([xx, yy, zz, xy, yz, xz]) {
  return xx.map((_, i) => {
    const mean = (xx[i] + yy[i] + zz[i]) / 3;
    const [a, b, c] = [xx[i] - mean, yy[i] - mean, zz[i] - mean];
    const [d, e, f] = [xy[i], yz[i], xz[i]];
    const j2 = (a * a + b * b + c * c) / 2 + d * d + e * e + f * f;
    if (!(j2 > 0)) return mean;
    const j3 = a * (b * c - e * e) - d * (d * c - e * f) + f * (d * e - b * f);
    const cosine = Math.max(-1, Math.min(1, (3 * Math.sqrt(3) * j3) / (2 * j2 ** 1.5)));
    return mean + 2 * Math.sqrt(j2 / 3) * Math.cos(Math.acos(cosine) / 3);
  });
}

function meanOf([xx, yy, zz]) {
  return xx.map((_, i) => (xx[i] + yy[i] + zz[i]) / 3);
}

const words = (name) => name.replace(/_/g, ' ').replace('von mises', 'von Mises stress');

/** Every quantity of a scene: {key, name, label, unit, on, of(parts)}; parts are the components. */
export function quantities(fields) {
  const all = [];
  for (const [name, { unit, components, on }] of Object.entries(fields)) {
    const add = (suffix, of) =>
      all.push({
        key: suffix ? `${name}:${suffix}` : name,
        name,
        label: suffix ? `${words(name)}, ${suffix}` : words(name),
        unit: unit === '1' ? '-' : unit,
        on,
        of,
      });
    if (components === 1) {
      add('', (parts) => parts[0]);
    } else if (components === 3) {
      add('length', magnitude);
      axes.forEach((axis, c) => add(axis, (parts) => parts[c]));
    } else {
      add('mean', meanOf);
      add('largest principal', largestPrincipal);
      pairs.forEach((pair, c) => add(pair, (parts) => parts[c]));
    }
  }
  return all;
}

/** Least, largest, and the range between two shares of the values; zeros count for none of these. */
export function spread(values, share = 0.02) {
  const finite = Array.from(values).filter(Number.isFinite);
  if (!finite.length) return { least: 0, largest: 0, low: 0, high: 1 };
  const sorted = Float64Array.from(finite).sort();
  const some = sorted.filter((value) => value !== 0);
  const [least, largest] = [sorted[0], sorted[sorted.length - 1]];
  if (!some.length) return { least, largest, low: 0, high: 1 };
  let low = some[Math.floor(share * (some.length - 1))];
  let high = some[Math.ceil((1 - share) * (some.length - 1))];
  if (some.length < sorted.length) [low, high] = [Math.min(low, 0), Math.max(high, 0)];
  if (low === high) [low, high] = [low - Math.abs(low || 1) * 1e-3, high + Math.abs(high || 1) * 1e-3];
  return { least, largest, low, high };
}
