// SPDX-License-Identifier: BSD-3-Clause
// Values put into workflows that are valid: schema and `breccia validate` say the same of each. The last column says
// what that is, so that both being wrong together is found, too. `open`: the schema admits what `validate` refuses, and
// cannot know better.
'use strict';
const fs = require('fs');
const os = require('os');
const path = require('path');
const { spawnSync } = require('child_process');
const YAML = require('yaml');
const { validator, fail } = require('./validator.js');

const breccia = process.argv[2];
const refused = validator([breccia, 'schema', 'workflow']);

const brittle = `
packing: {type: regular, lattice: fcc, container: {shape: box, size: [10 mm, 10 mm, 12 mm]}, radius: 1 mm}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.01}
contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 4 MPa,
  shear_strength: 4 MPa, friction: 0.5}
protocol: {type: uniaxial_compression, platen_velocity: 1 m/s, max_strain: 0.6 %}
`;

const law = ['contact_law', 'bond_modulus'], velocity = ['protocol', 'platen_velocity'],
  strain = ['protocol', 'max_strain'], damping = ['damping', 'translational'], density = ['material', 'density'];
const cases = [
  [law, '10 GPa', 'fine'], [law, '10GPa', 'fine'], [law, '1.5e10 Pa', 'fine'], [law, '10 kN/mm2', 'fine'],
  [law, '10 kN mm-2', 'fine'], [law, '10 GN/m^2', 'fine'], [law, '1500 ksi', 'fine'], [law, '10 gigapascals', 'fine'],
  [law, '10 kN/(mm mm)', 'fine'], [law, '10 kg/um/s2', 'fine'], [law, '+10 GPa', 'fine'], [law, '.5 GPa', 'fine'],
  [law, 10, 'refused'], [law, '10', 'refused'], [law, '10 mm', 'refused'], [law, '10 N', 'refused'],
  [law, '10 GPa/m', 'refused'], [law, '10 kN/mm', 'refused'], [law, '10 Gpa', 'refused'], [law, '10 MPas', 'refused'],
  [law, '1,5 GPa', 'refused'], [law, '1 000 MPa', 'refused'], [law, '010 GPa', 'refused'], [law, '10 mPa', 'refused'],
  [law, '-10 GPa', 'refused'], [law, '0 GPa', 'refused'], [law, '0.0 GPa', 'refused'], [law, 'stiff', 'refused'],
  [law, true, 'refused'], [law, null, 'refused'], [law, ['10 GPa'], 'refused'], [law, '10 meters', 'open'],
  [velocity, '100 mm/s', 'fine'], [velocity, '1 m s-1', 'fine'], [velocity, '6 m/min', 'fine'],
  [velocity, '1 m', 'refused'], [velocity, '1 1/s', 'refused'], [velocity, '1 s/m', 'refused'], [velocity, '1 Mm/s', 'refused'],
  [density, '2.65 g/cm3', 'fine'], [density, '165 lb/ft3', 'fine'], [density, '2650 kg', 'refused'],
  [density, '2650 kg/m2', 'refused'],
  [strain, '0.6 %', 'fine'], [strain, 0.006, 'fine'], [strain, '6e-3', 'fine'], [strain, '6 mm/m', 'fine'],
  [strain, '0.6 mm', 'refused'], [strain, '30 deg', 'refused'], [strain, -0.006, 'refused'], [strain, '-1 %', 'refused'],
  [damping, 0.7, 'fine'], [damping, '70 %', 'fine'], [damping, '99.9 %', 'fine'], [damping, 0, 'fine'],
  [damping, 1, 'refused'], [damping, '100 %', 'refused'], [damping, '120 %', 'refused'], [damping, 1.2, 'refused'],
  [damping, -0.1, 'refused'], [damping, '0.7 m', 'refused'],
  [['packing', 'lattice'], 'fc', 'refused'], [['packing', 'radus'], '1 mm', 'refused'], [['packing', 'type'], 'regulr', 'refused'],
  [['packing', 'name'], 'upper', 'refused'], [['seed'], -1, 'refused'], [['seed'], 1.5, 'refused'], [['seed'], 7, 'fine'],
  [['dimension'], 4, 'refused'], [['bonding', 'gap'], '1 um', 'refused'], [['materials'], { a: { density: '1 t/m3' } }, 'refused'],
  [['contact_law', 'tensile_strength'], { mean: '4 MPa', distribution: 'weibull', modulus: 6 }, 'fine'],
  [['contact_law', 'tensile_strength'], { mean: '4 mm', distribution: 'weibull', modulus: 6 }, 'refused'],
  [['contact_law', 'tensile_strength'], { mean: '4 MPa', distribution: 'weibull' }, 'refused'],
  [['contact_law', 'tensile_strength'], { mean: '4 MPa', distribution: 'gauss', modulus: 6 }, 'refused'],
  [['postprocessors'], [{ type: 'gauge' }], 'refused'], [['postprocessors'], [{ type: 'stress' }], 'fine'],
  [['postprocessors'], [{ type: 'stress', name: 'up per' }], 'refused'], [['outputs'], { type: 'vtk' }, 'refused'],
  [['outputs'], [{ type: 'extxyz', interval: '1 ms', gzip: true }], 'fine'],
  [['outputs'], [{ type: 'extxyz', interval: '1 mm' }], 'refused'], [['curves'], { hdf5: true }, 'fine'],
  [['curves'], { hdf5: 'please' }, 'refused'], [['plugins'], 'mine.so', 'refused'], [['periodic'], ['w'], 'open'],
  [['variants'], { soft: { contact_law: { bond_modulus: '1 GPa' } } }, 'fine'],
  [['variants'], { soft: { contact_law: { type: 'elastic_brittle', bond_modulus: '1 GPa' } } }, 'fine'],
  [['variants'], { soft: 'softer' }, 'refused'], [['variants'], { soft: { base: 'other.yaml' } }, 'refused'],
];
// What `validate` sees only when it is asked for the variant.
const in_variant = [
  [{ seed: 3 }, 'fine'], [{ seed: 'x' }, 'refused'], [{ contact_law: { bond_modulus: '1 mm' } }, 'refused'],
  [{ contact_law: { stiffness: '1 N/m' } }, 'refused'], [{ packing: { radius: '2 mm' } }, 'fine'],
  [{ packing: { radius_min: '2 mm' } }, 'refused'], [{ packing: { particles: 100 } }, 'refused'],
  [{ protocol: { max_strain: '1 %' }, damping: { rotational: 0.5 } }, 'fine'], [{ postprocessors: [{ every: 3 }] }, 'refused'],
  [{ material: { density: '2 m' } }, 'refused'], [{ outputs: [] }, 'fine'],
];

// Of a study, by the schema alone: which plugins its workflow has is in another file.
const study = validator([breccia, 'schema', 'sweep']);
const in_study = [
  ['grid', 'contact_law.friction', [0.2, '40 %'], ''], ['grid', 'contact_law.friction', 0.2, 'refused'],
  ['grid', 'contact_law.friction', ['1 mm'], 'refused'], ['grid', 'contact_law.frictoin', [0.2], 'refused'],
  ['grid', 'contact_law.bond_modulus', ['10 GPa', '20 GPa'], ''], ['grid', 'contact_law.bond_modulus', ['10 mm'], 'refused'],
  ['grid', 'contact_law[0].bond_modulus', ['10 GPa'], ''], ['grid', 'contact_law.tensile_strength.mean', ['10 MPa'], ''],
  ['grid', 'contact_law.type', ['elastic_brittle', 'soft_bond'], ''], ['grid', 'contact_law.type', ['elastic'], 'refused'],
  ['grid', 'packing.container.diameter', ['10 mm'], ''], ['grid', 'packing.container.diameter', ['10 MPa'], 'refused'],
  ['grid', 'packing.container.size[0]', ['10 mm'], ''], ['grid', 'postprocessors[1].every', ['1 m'], 'refused'],
  ['grid', 'materials.quartz.density', ['2650 kg/m3'], ''], ['grid', 'seed', [1, 2], ''], ['grid', 'seed', [-1], 'refused'],
  ['grid', 'variants', ['small', 'large'], ''], ['list', 'damping.translational', [0.1, 1.1], 'refused'], ['grid', 'seed', [], 'refused'],
  ['fixed', 'outputs', [], ''], ['fixed', 'protocol.max_strain', '1 %', ''], ['fixed', 'protocol.max_strain', '1 MPa', 'refused'],
  ['fixed', 'engine', { skin: 0.2 }, ''], ['fixed', 'engine', 0.2, 'refused'], ['fixed', 'engine.skim', 0.2, 'refused'], ['fixed', 'reference.strength_Pa', 3e6, ''],
];
for (const [section, parameter, value, expected] of in_study) {
  const text = YAML.stringify({ workflow: 'w.yaml', grid: { seed: [1, 2] }, [section]: { [parameter]: value } });
  if (Boolean(study(text)) !== Boolean(expected))
    fail(`${section} ${parameter}: ${JSON.stringify(value)}: the schema: ${study(text) || 'is fine'}; expected: ${expected || 'fine'}`);
}

// The same of a calibration.
const calibration = validator([breccia, 'schema', 'calibration']);
const sought = (more) => ({ workflows: { ucs: { file: 'w.yaml' } }, budget: { runs: 20 },
  targets: { ucs: { key: 'peak_stress_Pa', value: '100 MPa', scatter: '5 %' } },
  parameters: { strength: { path: 'contact_law.tensile_strength', from: '1 MPa', to: '90 MPa', scale: 'log' } }, ...more });
const strength = (path) => ({ parameters: { strength: { ...path, from: '1 MPa', to: '90 MPa' } } });
const in_workflow = (set) => ({ workflows: { ucs: { file: 'w.yaml', set } } });
const in_calibration = [
  [{}, ''], [{ budget: { runs: 0 } }, 'refused'], [{ budget: {} }, 'refused'], [{ targets: {} }, 'refused'],
  [strength({ path: 'contact_law[1].cohesion' }), ''], [strength({ path: 'contact_law.cohesoin' }), 'refused'],
  [strength({ paths: ['contact_law.0.contact_modulus', 'contact_law.1.bond_modulus'] }), ''],
  [strength({ paths: ['contact_law.0.contact_modulos'] }), 'refused'], [strength({}), 'refused'],
  [in_workflow({ outputs: [] }), ''], [in_workflow({ 'protocol.max_strain': '1 %' }), ''],
  [in_workflow({ 'protocol.max_strain': '1 MPa' }), 'refused'], [in_workflow({ 'protocol.max_strein': '1 %' }), 'refused'],
  [{ budget: { runs: 20, stages: [{ name: 'all', share: '100 %', set: { 'packing.particles': 300 } }] } }, ''],
  [{ budget: { runs: 20, stages: [{ name: 'all', share: 1, set: { 'packing.particels': 300 } }] } }, 'refused'],
  [{ budget: { runs: 20, stages: [{ name: 'all', share: '120 %' }] } }, 'refused'],
  [{ search: { type: 'krigin' } }, 'refused'], [{ sed: 1 }, 'refused'],
];
for (const [more, expected] of in_calibration) {
  const reason = calibration(YAML.stringify(sought(more)));
  if (Boolean(reason) !== Boolean(expected))
    fail(`${JSON.stringify(more)}: the schema: ${reason || 'is fine'}; expected: ${expected || 'fine'}`);
}

const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'breccia-schema-'));
process.on('exit', () => fs.rmSync(folder, { recursive: true }));

function compare(what, workflow, options, expected) {
  const text = YAML.stringify(workflow), file = path.join(folder, 'w.yaml');
  fs.writeFileSync(file, text);
  const told = spawnSync(breccia, ['validate', file, ...options], { encoding: 'utf8' });
  if (told.status !== 0 && told.status !== 2) fail(`${what}: breccia validate ends with ${told.status}: ${told.stderr}`);
  const by_schema = refused(text), by_program = told.status === 2;
  if (by_program !== (expected !== 'fine')) fail(`${what}: breccia validate: ${told.stderr.trim() || 'is fine'}; expected: ${expected}`);
  if (Boolean(by_schema) !== (expected === 'refused')) fail(`${what}: the schema: ${by_schema || 'is fine'}; expected: ${expected}`);
}

for (const [place, value, expected] of cases) {
  const workflow = YAML.parse(brittle);
  let at = workflow;
  for (const key of place.slice(0, -1)) at = at[key] = at[key] ?? {};
  at[place[place.length - 1]] = value;
  compare(`${place.join('.')}: ${JSON.stringify(value)}`, workflow, [], expected);
}
for (const [change, expected] of in_variant)
  compare(`variant ${JSON.stringify(change)}`, { ...YAML.parse(brittle), variants: { other: change } }, ['--variant', 'other'], expected);
console.log(`${cases.length + in_variant.length + in_study.length + in_calibration.length} values`);
