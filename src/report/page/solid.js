// The blocks of the last state as tetrahedra, and the surfaces in them where a number has one value: filled cuts, and surfaces of equal value.
class Solid {
    // Blocks with zones have theirs in `inside`; the others are divided from their middle to their triangles.
    constructor(scene, inside) {
        const blocks = Array.from(scene.numbers, (_, b) => b), total = scene.places.length / 3 + blocks.reduce((sum, b) => sum + (inside.zones[b] > 0 ? inside.corners[b] : 1), 0);
        this.places = new Float32Array(3 * total);
        this.displacements = new Float32Array(3 * total);
        this.owner = new Uint32Array(total);
        this.source = new Int32Array(total); // a corner of the scene; -1: the middle of a block; from -2 downward one of `inside`
        this.tets = new Uint32Array(4 * blocks.reduce((sum, b) => sum + (inside.zones[b] || scene.triangles[b]), 0));
        let corner = 0, written = 0, surface = 0, within = 0, triangle = 0, tet = 0;
        const put = (block, source, from, index) => {
            for (let k = 0; k < 3; ++k) {
                this.places[3 * corner + k] = from.places[3 * index + k];
                this.displacements[3 * corner + k] = from.displacements[3 * index + k];
            }
            this.source[corner] = source;
            this.owner[corner++] = block;
        };
        for (const b of blocks) {
            const first = corner;
            for (let k = 0; k < scene.corners[b]; ++k, ++surface) put(b, surface, scene, surface);
            if (inside.zones[b] > 0) {
                for (let k = 0; k < inside.corners[b]; ++k, ++within) put(b, -2 - within, inside, within);
                for (let k = 0; k < 4 * inside.zones[b]; ++k) this.tets[written++] = first + inside.zoneCorners[tet++];
                triangle += 3 * scene.triangles[b];
                continue;
            }
            const middle = { places: this.mean(this.places, first, corner), displacements: this.mean(this.displacements, first, corner) };
            put(b, -1, middle, 0);
            for (let t = 0; t < scene.triangles[b]; ++t) {
                this.tets[written++] = corner - 1;
                for (let k = 0; k < 3; ++k) this.tets[written++] = first + scene.triangleCorners[triangle++];
            }
        }
        this.inside = inside;
    }
    mean(column, first, end) {
        return [0, 1, 2].map(k => {
            let sum = 0;
            for (let c = first; c < end; ++c) sum += column[3 * c + k];
            return sum / (end - first);
        });
    }
    // The values of a field at all corners; the middle of a block has the mean of its corners.
    values(field) {
        const result = new Float32Array(this.owner.length);
        if (field.of !== 'corner') return result.map((_, c) => field.values[this.owner[c]]);
        const within = this.inside.fields.find(f => f.name === field.name);
        let sum = 0, count = 0;
        for (let c = 0; c < result.length; ++c) {
            if (c > 0 && this.owner[c] !== this.owner[c - 1]) sum = count = 0;
            const source = this.source[c];
            result[c] = source >= 0 ? field.values[source] : source === -1 ? sum / count : within ? within.values[-2 - source] : NaN;
            sum += result[c];
            ++count;
        }
        return result;
    }
    // How far each corner is beyond a plane, where displacements are enlarged.
    beyond([x, y, z, away], factor) {
        const at = (c, k) => this.places[3 * c + k] + factor * this.displacements[3 * c + k];
        return Float32Array.from(this.owner, (_, c) => x * at(c, 0) + y * at(c, 1) + z * at(c, 2) - away);
    }
    // Triangles where numbers at the corners are zero: three corners each, with place, displacement, value and block.
    zero(numbers, values) {
        const places = [], displacements = [], shown = [], owners = [];
        const cross = (a, b) => { // of the line between two corners
            const part = numbers[a] / (numbers[a] - numbers[b]), between = column => k => column[3 * a + k] + part * (column[3 * b + k] - column[3 * a + k]);
            places.push(...[0, 1, 2].map(between(this.places)));
            displacements.push(...[0, 1, 2].map(between(this.displacements)));
            shown.push(values[a] + part * (values[b] - values[a]));
            owners.push(this.owner[a]);
        };
        for (let t = 0; t < this.tets.length; t += 4) {
            const first = numbers[this.tets[t]] > 0;
            if (numbers[this.tets[t + 1]] > 0 === first && numbers[this.tets[t + 2]] > 0 === first && numbers[this.tets[t + 3]] > 0 === first) continue;
            const corners = this.tets.subarray(t, t + 4), above = [], below = [];
            for (const c of corners) (numbers[c] > 0 ? above : below).push(c);
            if (corners.some(c => !isFinite(numbers[c]))) continue;
            if (above.length === 2) {
                const [a, b] = above, [c, d] = below;
                for (const [from, to] of [[a, c], [a, d], [b, d], [a, c], [b, d], [b, c]]) cross(from, to);
            } else {
                const [one, others] = above.length === 1 ? [above[0], below] : [below[0], above];
                for (const other of others) cross(one, other);
            }
        }
        return { places: new Float32Array(places), displacements: new Float32Array(displacements), values: new Float32Array(shown), owners: new Float32Array(owners) };
    }
}
