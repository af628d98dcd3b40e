// SPDX-License-Identifier: BSD-3-Clause
// Every workflow and study that is shipped is valid, and the schemas of the texts are those of the program.
'use strict';
const fs = require('fs');
const path = require('path');
const YAML = require('yaml');
const { validator, fail } = require('./validator.js');

const breccia = process.argv[2];
const schema_of = { workflow: validator([breccia, 'schema', 'workflow']), sweep: validator([breccia, 'schema', 'sweep']) };

function yaml_files(folder) {
  return fs.readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const file = path.join(folder, entry.name);
    if (entry.isDirectory()) return yaml_files(file);
    return entry.name.endsWith('.yaml') ? [file] : [];
  });
}

const count = { workflow: 0, sweep: 0 };
for (const file of [...yaml_files('workflows'), ...yaml_files('docs/examples'), ...yaml_files('tests/bench')]) {
  const text = fs.readFileSync(file, 'utf8'), keys = Object.keys(YAML.parse(text) ?? {});
  const kind = keys.includes('workflow') || keys.includes('workflows') ? 'sweep' : 'workflow';
  ++count[kind];
  const reason = schema_of[kind](text);
  if (reason) fail(`${file}: refused by the schema of a ${kind}: ${reason}`);
}
if (count.workflow < 50 || count.sweep < 5) fail(`only ${count.workflow} workflows and ${count.sweep} studies were found`);
console.log(`${count.workflow} workflows and ${count.sweep} studies`);
