// SPDX-License-Identifier: BSD-3-Clause
// A schema of `breccia schema` as a function: text of a YAML file to the first reason why it is refused, or ''.
'use strict';
const { execFileSync } = require('child_process');
const Ajv = require('ajv');
const YAML = require('yaml');

// Editors show it; it has no part in what is valid.
const editors_only = ['patternErrorMessage'];

function validator(command) {
  const schema = JSON.parse(execFileSync(command[0], command.slice(1), { maxBuffer: 1 << 28 }));
  const ajv = new Ajv({ strictKeywords: true, schemaId: 'auto' });  // a keyword that means nothing is an error
  for (const keyword of editors_only) ajv.addKeyword(keyword, { metaSchema: { type: 'string' } });
  const check = ajv.compile(schema);
  return (text) => {
    const documents = YAML.parseAllDocuments(text, { logLevel: 'error' });
    if (documents.length !== 1) return `is ${documents.length} documents`;
    const [document] = documents;
    for (const note of [...document.errors, ...document.warnings]) return `no YAML: ${note.code}`;
    let value;
    try {
      value = document.toJS();
    } catch (error) {
      return `no YAML: ${error.message}`;
    }
    if (check(value)) return '';
    const error = check.errors[check.errors.length - 1];
    return `${error.dataPath || 'the file'} ${error.message}`;
  };
}

let wrong = 0;
function fail(text) {
  console.error(text);
  ++wrong;
}
process.on('exit', (code) => {
  if (code === 0 && wrong > 0) process.exitCode = 1;
});

module.exports = { validator, fail };
