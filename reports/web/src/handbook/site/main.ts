// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Writes the handbook: main ROOT OUTPUT PROGRAM. Ends with exit code 1 where a quote, a scene, a link or a
// translation is missing.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { brokenLinks, externalRequests, translationErrors } from './checks.ts';
import { languages } from './contents.ts';
import { galleryPage } from './gallery.ts';
import { Recorder } from './record.ts';
import { referencePages } from './reference.ts';
import { makeSite } from './site.ts';

function build(root: string, output: string, program: string): string[] {
  const recorder = new Recorder(root, program, join(output, 'data'));
  const pictures = join(output, 'pictures');
  const generated = [
    ...referencePages(root, program),
    ...languages.map((language) => galleryPage(root, program, pictures, language)),
  ];
  const site = makeSite(root, recorder, generated);
  for (const [path, text] of site.files) {
    const file = join(output, path);
    mkdirSync(dirname(file), { recursive: true });
    if (!existsSync(file) || readFileSync(file, 'utf8') !== text) writeFileSync(file, text);
  }
  const styles = new Map([['assets/handbook.css', readFileSync(join(output, 'assets/handbook.css'), 'utf8')]]);
  console.log(`${site.files.size} pages, ${recorder.made} runs recorded`);
  return [
    ...brokenLinks(site.files, (path) => existsSync(join(output, path))),
    ...externalRequests(new Map([...site.files, ...styles])),
    ...translationErrors(site),
  ];
}

const [root, output, program] = process.argv.slice(2);
if (!root || !output || !program) {
  console.error('main ROOT OUTPUT PROGRAM');
  process.exit(2);
}
let errors: string[];
try {
  errors = build(root, output, program);
} catch (error) {
  errors = [error instanceof Error ? error.message : String(error)];
}
for (const error of errors) console.error(`handbook: ${error}`);
process.exit(errors.length > 0 ? 1 : 0);
