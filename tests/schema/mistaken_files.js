// SPDX-License-Identifier: BSD-3-Clause
// Of the mistakes in tests/errors, which `validate` refuses, the schema refuses all but those in not_said.txt. The list
// fails both ways: what it names must be admitted, what it does not name must be refused.
'use strict';
const fs = require('fs');
const path = require('path');
const { validator, fail } = require('./validator.js');

const refused = validator([process.argv[3]]);
const not_said = new Map(fs.readFileSync(path.join(__dirname, 'not_said.txt'), 'utf8').split('\n')
  .filter((line) => line && !line.startsWith('#'))
  .map((line) => [line.split(':')[0], line]));

const folder = 'tests/errors';
let count = 0;
for (const file of fs.readdirSync(folder).filter((name) => name.endsWith('.yaml'))) {
  const name = path.basename(file, '.yaml');
  const listed = not_said.delete(name);
  // What stands on the command line is no part of the file.
  if (fs.existsSync(path.join(folder, `${name}.set`))) {
    if (listed) fail(`${name}: its mistake is one of --set; not_said.txt need not name it`);
    continue;
  }
  ++count;
  const reason = refused(fs.readFileSync(path.join(folder, file), 'utf8'));
  if (!reason && !listed) fail(`${name}: the schema admits it: make it say so, or name it in not_said.txt and say why it cannot`);
  if (reason && listed) fail(`${name}: the schema refuses it (${reason}): take it out of not_said.txt`);
}
for (const name of not_said.keys()) fail(`${name}: named in not_said.txt, and there is no such file in tests/errors`);
if (count < 60) fail(`only ${count} files were found`);
console.log(`${count} mistakes`);
