// Bundles the view of the report: node build.mjs PACKAGES OUTPUT
//
// PACKAGES is a folder in which `npm ci` has unpacked what package-lock.json names. OUTPUT gets
// report.js, report.css and report-licences.txt, which `billet report` puts into its pages.

import { createRequire } from 'node:module';
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url));
const packages = path.resolve(process.argv[2] ?? here);
const output = path.resolve(process.argv[3] ?? path.join(here, 'dist'));
const modules = path.join(packages, 'node_modules');
const esbuild = createRequire(path.join(packages, 'package.json'))('esbuild');

/** The package that a bundled file belongs to: "uplot", "@kitware/vtk.js"; none: a file of ours. */
function packageOf(file) {
  const parts = file.split('node_modules/').pop().split('/');
  if (!file.includes('node_modules/')) return undefined;
  return parts[0].startsWith('@') ? `${parts[0]}/${parts[1]}` : parts[0];
}

function licenceOf(name) {
  const folder = path.join(modules, name);
  const about = JSON.parse(fs.readFileSync(path.join(folder, 'package.json'), 'utf8'));
  const file = fs.readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  const text = file ? fs.readFileSync(path.join(folder, file), 'utf8') : '';
  return `${name} ${about.version}, licence ${about.license}\n\n${text.trim()}\n`;
}

const result = await esbuild.build({
  entryPoints: [path.join(here, 'src', 'main.js')],
  outfile: path.join(output, 'report.js'),
  bundle: true,
  minify: true,
  format: 'iife',
  target: ['es2020'],
  charset: 'utf8',
  legalComments: 'none',
  nodePaths: [modules],
  metafile: true,
  absWorkingDir: here,
  logLevel: 'warning',
});
const used = [...new Set(Object.keys(result.metafile.inputs).map(packageOf))].filter(Boolean).sort();
fs.writeFileSync(
  path.join(output, 'report-licences.txt'),
  used.map(licenceOf).join(`\n${'-'.repeat(72)}\n\n`),
);
