// solid.js SOURCE: surfaces in tetrahedra have the areas and values of geometry: cuts of a rigid cube, and of a cube of six zones.
'use strict';
const assert = require('assert'), fs = require('fs'), path = require('path');
const Solid = eval(`${fs.readFileSync(path.join(process.argv[2], 'src/report/page/solid.js'), 'utf8')}; Solid`);

const corners = Array.from({ length: 8 }, (_, i) => [i & 1, i >> 1 & 1, i >> 2 & 1]);
const faces = [0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5];
const scene = { numbers: [1], corners: [8], triangles: [12], places: new Float32Array(corners.flat()), displacements: new Float32Array(24), triangleCorners: new Uint32Array(faces) };
const none = new Float32Array(0), rigid = { corners: [0], zones: [0], zoneCorners: new Uint32Array(0), places: none, displacements: none, fields: [] };
// Walks from corner 0 to corner 7 along the axes, in each of their six orders.
const walks = [[1, 2, 4], [1, 4, 2], [2, 1, 4], [2, 4, 1], [4, 1, 2], [4, 2, 1]].flatMap(([a, b]) => [0, a, a + b, 7]);
const zoned = { ...rigid, zones: [6], zoneCorners: new Uint32Array(walks) };
// A gridpoint inside: four zones around the middle of one tetrahedron.
const tetrahedron = { ...scene, corners: [4], triangles: [4], places: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]), displacements: new Float32Array(12), triangleCorners: new Uint32Array([0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3]) };
const within = {
    corners: [1], zones: [4], zoneCorners: new Uint32Array([4, 0, 1, 2, 4, 0, 1, 3, 4, 0, 2, 3, 4, 1, 2, 3]), places: new Float32Array([0.25, 0.25, 0.25]),
    displacements: new Float32Array(3), fields: [{ name: 'x', values: new Float32Array([0.25]) }],
};

function area({ places: p }) {
    let sum = 0;
    for (let i = 0; i < p.length; i += 9) {
        const [u, v] = [3, 6].map(n => [0, 1, 2].map(k => p[i + n + k] - p[i + k]));
        sum += Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
    }
    return sum;
}
const near = (value, wanted, what) => assert.ok(Math.abs(value - wanted) < 1e-5, `${what}: ${value} for ${wanted}`);
const x = s => ({ of: 'corner', name: 'x', values: Float32Array.from({ length: s.places.length / 3 }, (_, c) => s.places[3 * c]) });

for (const [name, inside] of Object.entries({ rigid, zoned })) {
    const solid = new Solid(scene, inside), values = solid.values(x(scene));
    for (const away of [0.1, 0.25, 0.5, 0.9]) {
        const cut = solid.zero(solid.beyond([1, 0, 0, away], 0), values);
        near(area(cut), 1, `${name} cut at ${away}`);
        for (const value of cut.values) near(value, away, `${name} value on the cut`);
        near(area(solid.zero(values.map(v => v - away), values)), 1, `${name} surface of ${away}`);
    }
    const n = 1 / Math.sqrt(3);
    near(area(solid.zero(solid.beyond([n, n, n, 1.5 * n], 0), values)), 3 * Math.sqrt(3) / 4, `${name} hexagon`);
    assert.strictEqual(solid.zero(solid.beyond([1, 0, 0, 2], 0), values).owners.length, 0, `${name} beyond its end`);
}
const solid = new Solid(tetrahedron, within);
for (const value of solid.zero(solid.beyond([1, 0, 0, 0.1], 0), solid.values(x(tetrahedron))).values) near(value, 0.1, 'value inside a tetrahedron');
near(area(solid.zero(solid.beyond([1, 0, 0, 0.5], 0), solid.values(x(tetrahedron)))), 0.125, 'cut of a tetrahedron');
// Enlarged displacements move the blocks through the plane.
const moved = new Solid({ ...scene, displacements: Float32Array.from({ length: 24 }, (_, k) => k % 3 === 0 ? 0.01 : 0) }, rigid);
assert.strictEqual(moved.zero(moved.beyond([1, 0, 0, 1.5], 0), moved.values(x(scene))).owners.length, 0);
near(area(moved.zero(moved.beyond([1, 0, 0, 1.5], 100), moved.values(x(scene)))), 1, 'cut of a moved cube');
