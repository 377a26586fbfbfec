// Arrows and crosses as small solids: a shaft of three sides, and for an arrow a head of six.
async function readMarks() {
    const all = readJson('mark-data');
    for (const marks of all) for (const name of ['places', 'vectors', 'values']) marks[name] = await unpack(marks[name], Float32Array);
    return all;
}

// Of one vector its length; of principal stresses their signed values.
function markValues(marks) {
    if (marks.axes === 3) return marks.values;
    return Float32Array.from({ length: marks.vectors.length / 3 }, (_, i) => Math.hypot(...marks.vectors.subarray(3 * i, 3 * i + 3)));
}

// Corners, triangles and the vector of each corner. The longest mark is a part of the model's size that falls with their number.
function markSolids(marks, size) {
    const values = markValues(marks), count = values.length, places = [], faces = [], owner = [];
    const longest = values.reduce((most, v) => Math.max(most, Math.abs(v)), 0), scale = size * Math.min(0.12, 0.9 / Math.cbrt(marks.places.length / 3)) / longest;
    const ring = (centre, across, up, radius, sides, mark) => {
        const first = owner.length;
        for (let k = 0; k < sides; ++k) {
            const c = radius * Math.cos(2 * Math.PI * k / sides), s = radius * Math.sin(2 * Math.PI * k / sides);
            places.push(...centre.map((x, axis) => x + c * across[axis] + s * up[axis]));
            owner.push(mark);
        }
        return first;
    };
    const tube = (from, to, sides) => {
        for (let k = 0; k < sides; ++k) { const n = (k + 1) % sides; faces.push(from + k, from + n, to + n, from + k, to + n, to + k); }
    };
    for (let mark = 0; mark < count; ++mark) {
        const length = Math.abs(values[mark]);
        if (!(length > 1e-3 * longest)) continue;
        const along = [...marks.vectors.subarray(3 * mark, 3 * mark + 3)].map(x => x / length), place = Math.floor(mark / marks.axes);
        const base = [...marks.places.subarray(3 * place, 3 * place + 3)], total = scale * length, thick = 0.02 * scale * longest;
        const least = along.reduce((best, x, k) => Math.abs(x) < Math.abs(along[best]) ? k : best, 0), unit = [0, 1, 2].map(k => k === least ? 1 : 0);
        const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        const raw = cross(along, unit), norm = Math.hypot(...raw), across = raw.map(x => x / norm), up = cross(along, across);
        const at = part => base.map((x, k) => x + part * total * along[k]);
        if (marks.axes === 3) { // through its place, to both sides
            tube(ring(at(-0.5), across, up, thick, 3, mark), ring(at(0.5), across, up, thick, 3, mark), 3);
            continue;
        }
        const neck = ring(at(0.7), across, up, thick, 3, mark), wide = ring(at(0.7), across, up, Math.min(3 * thick, 0.2 * total), 6, mark), tip = ring(at(1), across, up, 0, 6, mark);
        tube(ring(at(0), across, up, thick, 3, mark), neck, 3);
        tube(wide, tip, 6);
    }
    return { places: new Float32Array(places), faces: new Uint32Array(faces), values: Float32Array.from(owner, mark => values[mark]) };
}

// Steps of colour bands: 1, 2, 2.5 or 5 times a power of ten, at most ten between the ends.
function bandStep(ends) {
    const raw = (ends[1] - ends[0]) / 10, power = 10 ** Math.floor(Math.log10(raw));
    return raw > 0 ? power * [1, 2, 2.5, 5, 10].find(times => times * power >= raw * 0.999) : 0;
}

// The normal of a plane that dips by so many degrees towards a direction from north.
function normalOf(dip, direction) {
    const d = dip * Math.PI / 180, a = direction * Math.PI / 180;
    return [Math.sin(d) * Math.sin(a), Math.sin(d) * Math.cos(a), Math.cos(d)];
}
