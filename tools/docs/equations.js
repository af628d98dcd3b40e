// SPDX-License-Identifier: BSD-3-Clause
// Reads [[TeX, displayed], ...] and writes their HTML and MathML, or what is wrong with each, as JSON.
const katex = require("/usr/share/javascript/katex/katex.min.js");
const answers = JSON.parse(require("fs").readFileSync(0, "utf8")).map(([tex, displayMode]) => {
  try {
    return { html: katex.renderToString(tex, { displayMode, throwOnError: true, strict: "error" }) };
  } catch (wrong) {
    return { wrong: wrong.message };
  }
});
console.log(JSON.stringify(answers));
