// SPDX-License-Identifier: BSD-3-Clause
// Every workflow, study and calibration that is shipped is valid, and the schemas of the texts are those of the program.
'use strict';
const fs = require('fs');
const path = require('path');
const YAML = require('yaml');
const { validator, fail } = require('./validator.js');

const breccia = process.argv[2];
const kinds = ['workflow', 'sweep', 'calibration'];
const schema_of = Object.fromEntries(kinds.map((kind) => [kind, validator([breccia, 'schema', kind])]));

function yaml_files(folder) {
  return fs.readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const file = path.join(folder, entry.name);
    if (entry.isDirectory()) return yaml_files(file);
    return entry.name.endsWith('.yaml') ? [file] : [];
  });
}

const files = [...yaml_files('workflows'), ...yaml_files('docs/examples'), ...yaml_files('tests/bench')]
  .map((file) => ({ file, text: fs.readFileSync(file, 'utf8') }))
  .map(({ file, text }) => ({ file, text, content: YAML.parse(text) }));
const bases = new Set(files.filter(({ content }) => content.base)
  .map(({ file, content }) => path.join(path.dirname(file), content.base)));
const count = { workflow: 0, sweep: 0, calibration: 0 };
for (const { file, text, content } of files) {
  const kind = content.targets ? 'calibration' : content.workflow || content.workflows ? 'sweep' : 'workflow';
  ++count[kind];
  // A file to build on need not be complete, as one that builds on another need not be.
  const whole = content.base || !bases.has(file) ? text : `${text}\nbase: another.yaml\n`;
  const reason = schema_of[kind](whole);
  if (reason) fail(`${file}: refused by the schema of a ${kind}: ${reason}`);
}
const found = `${count.workflow} workflows, ${count.sweep} studies and ${count.calibration} calibrations`;
if (count.workflow < 50 || count.sweep < 5 || count.calibration < 2) fail(`only ${found} were found`);
console.log(found);
