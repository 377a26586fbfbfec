// Matrices of four by four, by columns.
function multiply(a, b) {
    const c = new Float32Array(16);
    for (let j = 0; j < 4; ++j) for (let i = 0; i < 4; ++i) for (let k = 0; k < 4; ++k) c[4 * j + i] += a[4 * k + i] * b[4 * j + k];
    return c;
}

function perspective(angle, aspect, near, far) {
    const f = 1 / Math.tan(angle / 2);
    return new Float32Array([f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0]);
}

// From a point that the eye looks at, with the z axis of the model upward.
function lookAt(target, distance, heading, pitch) {
    const forward = [-Math.cos(pitch) * Math.sin(heading), -Math.cos(pitch) * Math.cos(heading), -Math.sin(pitch)];
    const right = [-Math.cos(heading), Math.sin(heading), 0];
    const up = [right[1] * forward[2] - right[2] * forward[1], right[2] * forward[0] - right[0] * forward[2], right[0] * forward[1] - right[1] * forward[0]];
    const eye = target.map((t, k) => t - distance * forward[k]);
    const dot = v => -(v[0] * eye[0] + v[1] * eye[1] + v[2] * eye[2]);
    return {
        matrix: new Float32Array([right[0], up[0], -forward[0], 0, right[1], up[1], -forward[1], 0, right[2], up[2], -forward[2], 0, dot(right), dot(up), -dot(forward), 1]),
        right, up, back: forward.map(v => -v),
    };
}
