// The blocks, to be turned, coloured, cut and picked.
const opening = 0.7; // angle of the view from bottom to top
const sides = { // heading and pitch
    front: [Math.PI, 0], back: [0, 0], left: [-Math.PI / 2, 0], right: [Math.PI / 2, 0], top: [Math.PI, Math.PI / 2], isometric: [0.75 * Math.PI, 0.6155],
};
class BlockView {
    constructor(canvas, scene) {
        this.canvas = canvas; this.scene = scene;
        this.gl = canvas.getContext('webgl2', { antialias: true, preserveDrawingBuffer: true });
        if (!this.gl) throw new Error('this browser has no WebGL 2');
        this.program = this.link();
        this.colours = null;
        this.state = { factor: 0, cut: [0, 0, 0, 1], edges: true, picked: -1, bands: false, level: null };
        this.marks = null;
        this.solid = null; // of the state that is shown, where the page has it
        this.reset();
        this.show(scene);
        this.listen();
        this.frame = this.time();
    }
    // Milliseconds of one picture; reading a pixel waits for its end.
    time() {
        this.render(false);
        const gl = this.gl, pixel = new Uint8Array(4), began = performance.now();
        this.render(false);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        return performance.now() - began;
    }
    link() {
        const gl = this.gl, program = gl.createProgram();
        for (const [kind, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, faceShader]]) {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, text);
            gl.compileShader(shader);
            if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
            gl.attachShader(program, shader);
        }
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
        return program;
    }
    buffer(target, data) {
        const gl = this.gl, made = gl.createBuffer();
        gl.bindBuffer(target, made);
        gl.bufferData(target, data, gl.STATIC_DRAW);
        this.buffers.push(made);
        return made;
    }
    // Another state of the model.
    show(scene) {
        const gl = this.gl;
        if (this.array) gl.deleteVertexArray(this.array);
        for (const old of this.buffers || []) gl.deleteBuffer(old);
        this.buffers = [];
        this.scene = scene;
        this.fill();
    }
    // Indices count within a block in the file; here over all of them.
    fill() {
        const gl = this.gl, s = this.scene;
        const owner = new Float32Array(s.places.length / 3), faces = new Uint32Array(s.triangleCorners.length), lines = new Uint32Array(s.lineCorners.length);
        let corner = 0, triangle = 0, line = 0;
        for (let b = 0; b < s.numbers.length; ++b) {
            owner.fill(b, corner, corner + s.corners[b]);
            for (let k = 0; k < 3 * s.triangles[b]; ++k, ++triangle) faces[triangle] = corner + s.triangleCorners[triangle];
            for (let k = 0; k < 2 * s.lines[b]; ++k, ++line) lines[line] = corner + s.lineCorners[line];
            corner += s.corners[b];
        }
        this.owner = owner;
        this.counts = { faces: faces.length, lines: lines.length };
        this.array = gl.createVertexArray();
        gl.bindVertexArray(this.array);
        const attribute = (index, size, data) => {
            const made = this.buffer(gl.ARRAY_BUFFER, data);
            gl.enableVertexAttribArray(index);
            gl.vertexAttribPointer(index, size, gl.FLOAT, false, 0, 0);
            return made;
        };
        attribute(0, 3, s.places);
        attribute(1, 3, s.displacements);
        this.values = attribute(2, 1, new Float32Array(owner.length));
        attribute(3, 1, owner);
        this.faceBuffer = this.buffer(gl.ELEMENT_ARRAY_BUFFER, faces);
        this.lineBuffer = this.buffer(gl.ELEMENT_ARRAY_BUFFER, lines);
    }
    // `ends` belong to all states.
    colour(field, ends) {
        const gl = this.gl, values = field.of === 'corner' ? field.values : Float32Array.from(this.owner, b => field.values[b]);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.values);
        gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
        this.field = field;
        this.ends = ends;
        this.draw();
    }
    // The surfaces inside: of one value, or of the limits of all bands; otherwise the cut.
    levels() {
        if (this.state.level === null || !this.field || this.field.of !== 'corner') return [];
        const step = this.state.bands ? bandStep(this.ends) : 0, levels = [];
        for (let n = Math.ceil(this.ends[0] / step); step > 0 && n * step < this.ends[1]; ++n) levels.push(n * step);
        return step > 0 ? levels : [this.ends[0] + this.state.level * (this.ends[1] - this.ends[0])];
    }
    section() {
        const { factor, cut } = this.state, levels = this.levels(), isCut = cut[3] < 1e30 && cut.some((n, k) => k < 3 && n !== 0);
        const asked = [this.solid, this.field, factor, levels.join(), ...(levels.length > 0 ? [] : cut)];
        if (this.drawn && this.drawn.every((part, k) => part === asked[k])) return;
        this.drawn = asked;
        this.inner = this.release(this.inner);
        if (!this.solid || !this.field || levels.length === 0 && !isCut) return;
        const values = this.solid.values(this.field);
        const parts = levels.length > 0 ? levels.map(level => this.solid.zero(values.map(v => v - level), values)) : [this.solid.zero(this.solid.beyond(cut, factor), values)];
        const whole = name => {
            const all = new Float32Array(parts.reduce((sum, part) => sum + part[name].length, 0));
            let at = 0;
            for (const part of parts) { all.set(part[name], at); at += part[name].length; }
            return all;
        };
        this.inner = this.solids([[0, 3, whole('places')], [1, 3, whole('displacements')], [2, 1, whole('values')], [3, 1, whole('owners')]]);
        this.inner.count = parts.reduce((sum, part) => sum + part.owners.length, 0);
    }
    // Arrays of corners: number of the attribute, numbers for each corner, all of them.
    solids(columns, faces) {
        const gl = this.gl, array = gl.createVertexArray(), buffers = [];
        gl.bindVertexArray(array);
        const made = (target, data) => {
            buffers.push(gl.createBuffer());
            gl.bindBuffer(target, buffers.at(-1));
            gl.bufferData(target, data, gl.STATIC_DRAW);
        };
        for (const [index, size, data] of columns) {
            made(gl.ARRAY_BUFFER, data);
            gl.enableVertexAttribArray(index);
            gl.vertexAttribPointer(index, size, gl.FLOAT, false, 0, 0);
        }
        if (faces) made(gl.ELEMENT_ARRAY_BUFFER, faces);
        return { array, buffers };
    }
    release(solids) {
        if (solids) {
            this.gl.deleteVertexArray(solids.array);
            for (const old of solids.buffers) this.gl.deleteBuffer(old);
        }
        return null;
    }
    // Marks are drawn between the edges of the blocks; null: none.
    mark(marks) {
        this.marks = this.release(this.marks);
        if (marks) {
            const made = markSolids(marks, this.scene.size);
            this.marks = { ...this.solids([[0, 3, made.places], [2, 1, made.values]], made.faces), count: made.faces.length, ends: range(markValues(marks)) };
        }
        this.draw();
    }
    reset() {
        this.fit(Math.PI - 0.5, 0.4); // x to the right, y away
    }
    from(side) {
        this.fit(...sides[side]);
        this.draw();
    }
    // The model fills the frame, with room for the legend. Perspective moves its middle: three rounds centre it.
    fit(heading, pitch) {
        Object.assign(this, { heading, pitch, target: [0, 0, 0], distance: 2 * (this.scene.size || 1) });
        const box = this.canvas.getBoundingClientRect(), p = this.scene.places, { right, up, back } = lookAt(this.target, 1, heading, pitch);
        const legend = box.width > 600 ? 340 : 0; // pixels, on both sides; a phone shows it below
        const upward = 0.92 * Math.tan(opening / 2), across = upward * Math.max(box.width - legend, 0.5 * box.width) / Math.max(1, box.height);
        const along = (axis, i) => axis.reduce((sum, a, k) => sum + a * (p[i + k] - this.target[k]), 0);
        for (let round = 0; round < 3 && p.length > 0; ++round) {
            let [left, rightmost, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
            for (let i = 0; i < p.length; i += 3) {
                const away = this.distance - along(back, i), x = along(right, i) / away, y = along(up, i) / away;
                left = Math.min(left, x); rightmost = Math.max(rightmost, x); low = Math.min(low, y); high = Math.max(high, y);
            }
            this.target = this.target.map((t, k) => t + this.distance / 2 * (right[k] * (left + rightmost) + up[k] * (low + high)));
            this.distance = 0;
            for (let i = 0; i < p.length; i += 3)
                this.distance = Math.max(this.distance, along(back, i) + Math.max(Math.abs(along(up, i)) / upward, Math.abs(along(right, i)) / across));
        }
        this.distance = this.distance || 1;
    }
    turn(heading, pitch) {
        this.heading += heading;
        this.pitch = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.pitch + pitch));
        this.draw();
    }
    nearer(times) {
        this.distance /= times;
        this.draw();
    }
    camera() {
        const size = this.scene.size || 1;
        const far = this.distance + 2 * size, view = lookAt(this.target, this.distance, this.heading, this.pitch);
        this.axes = view;
        const near = Math.max(this.distance - 2 * size, 0.005 * this.distance);
        this.towards = 0.002 * 2 * far * near / (far - near); // in depth: a five-hundredth of the distance
        return multiply(perspective(opening, this.canvas.width / this.canvas.height, near, far), view.matrix);
    }
    draw() {
        if (this.waiting) return;
        this.waiting = true;
        requestAnimationFrame(() => { this.waiting = false; this.render(false); });
    }
    render(picking) {
        // A slow machine gets coarser pictures while they turn: 33 ms are 30 in a second.
        const coarse = this.turning && this.frame > 33;
        const gl = this.gl, box = this.canvas.getBoundingClientRect(), dense = (window.devicePixelRatio || 1) * (coarse ? 0.5 : 1);
        const width = Math.max(1, Math.round(box.width * dense)), height = Math.max(1, Math.round(box.height * dense));
        if (this.canvas.width !== width || this.canvas.height !== height) { this.canvas.width = width; this.canvas.height = height; }
        gl.viewport(0, 0, width, height);
        gl.clearColor(0, 0, 0, 0);
        gl.enable(gl.DEPTH_TEST);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        this.section();
        gl.useProgram(this.program);
        gl.bindVertexArray(this.array);
        const at = name => gl.getUniformLocation(this.program, name);
        gl.uniformMatrix4fv(at('camera'), false, this.camera());
        gl.uniform1f(at('factor'), this.state.factor);
        gl.uniform4fv(at('cut'), this.state.cut);
        gl.uniform2fv(at('ends'), this.ends || [0, 1]);
        const names = this.field ? this.field.names.length : 0;
        gl.uniform1i(at('names'), names);
        gl.uniform1f(at('band'), this.state.bands && names === 0 ? bandStep(this.ends || [0, 1]) : 0);
        gl.uniform1f(at('picked'), this.state.picked);
        gl.uniform3fv(at('light'), [0.4, 0.5, 0.77]);
        gl.uniform3fv(at('colours'), (this.field && this.field.names.length > 0 ? named : viridis).flat().map(c => c / 255));
        gl.uniform1i(at('picking'), picking);
        gl.uniform1i(at('lines'), false);
        gl.uniform1f(at('towards'), 0);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.faceBuffer);
        const open = this.marks || this.inner && this.levels().length > 0;
        if (picking || !open) gl.drawElements(gl.TRIANGLES, this.counts.faces, gl.UNSIGNED_INT, 0);
        if (!picking && this.onrender) this.onrender(this.axes, coarse);
        if (this.inner && !this.marks) this.renderInner(at);
        if (!picking && this.marks) this.renderMarks(at);
        if (picking || !(this.state.edges || open) || coarse) return;
        gl.uniform1i(at('lines'), true);
        gl.uniform1f(at('towards'), this.towards);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.lineBuffer);
        gl.drawElements(gl.LINES, this.counts.lines, gl.UNSIGNED_INT, 0);
    }
    // A cut is not itself cut; surfaces of equal value are.
    renderInner(at) {
        const gl = this.gl;
        gl.bindVertexArray(this.inner.array);
        if (this.levels().length === 0) gl.uniform4fv(at('cut'), [0, 0, 0, 1]);
        else gl.uniform1f(at('band'), 0); // all of it is at the limit of a band
        gl.drawArrays(gl.TRIANGLES, 0, this.inner.count);
        gl.uniform4fv(at('cut'), this.state.cut);
        gl.bindVertexArray(this.array);
    }
    renderMarks(at) {
        const gl = this.gl;
        gl.bindVertexArray(this.marks.array);
        gl.vertexAttrib3f(1, 0, 0, 0); // they do not move with the blocks
        gl.vertexAttrib1f(3, -2);
        gl.uniform1i(at('names'), 0);
        gl.uniform1f(at('band'), 0);
        gl.uniform2fv(at('ends'), this.marks.ends);
        gl.uniform3fv(at('colours'), viridis.flat().map(c => c / 255));
        gl.drawElements(gl.TRIANGLES, this.marks.count, gl.UNSIGNED_INT, 0);
        gl.bindVertexArray(this.array);
    }
    // The block at a place of the canvas, from 0 on; -1: none.
    pick(x, y) {
        const gl = this.gl, box = this.canvas.getBoundingClientRect(), pixel = new Uint8Array(4);
        this.render(true);
        gl.readPixels(Math.round(x * this.canvas.width / box.width), this.canvas.height - 1 - Math.round(y * this.canvas.height / box.height), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        this.state.picked = pixel[3] === 0 ? -1 : pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1;
        this.render(false);
        return this.state.picked;
    }
    listen() {
        let last = null, moved = 0;
        const fingers = new Map(); // on the screen, by their number
        const apart = () => { const [a, b] = [...fingers.values()]; return Math.hypot(a[0] - b[0], a[1] - b[1]); };
        const still = e => { fingers.delete(e.pointerId); last = null; if (this.turning) { this.turning = false; this.draw(); } };
        this.canvas.addEventListener('contextmenu', e => e.preventDefault());
        this.canvas.addEventListener('pointerdown', e => { last = [e.clientX, e.clientY]; moved = 0; fingers.set(e.pointerId, last); this.canvas.setPointerCapture(e.pointerId); });
        this.canvas.addEventListener('pointermove', e => {
            if (!last) return;
            if (fingers.size === 2) {
                const before = apart();
                fingers.set(e.pointerId, [e.clientX, e.clientY]);
                moved = 4; // no click
                if (before > 0 && apart() > 0) this.nearer(apart() / before);
                return;
            }
            const dx = e.clientX - last[0], dy = e.clientY - last[1];
            moved += Math.abs(dx) + Math.abs(dy);
            last = [e.clientX, e.clientY];
            this.turning = moved >= 4;
            if (e.buttons & 2 || e.shiftKey) {
                const step = this.distance / 700;
                this.target = this.target.map((t, k) => t - step * (dx * this.axes.right[k] - dy * this.axes.up[k]));
                this.draw();
            } else this.turn(dx / 200, dy / 200);
        });
        this.canvas.addEventListener('pointerup', e => {
            const box = this.canvas.getBoundingClientRect();
            if (last && moved < 4 && this.onpick) this.onpick(this.pick(e.clientX - box.left, e.clientY - box.top));
            still(e);
        });
        this.canvas.addEventListener('pointercancel', still);
        this.canvas.addEventListener('wheel', e => { e.preventDefault(); this.nearer(Math.exp(-e.deltaY / 800)); }, { passive: false });
        const keys = {
            ArrowLeft: () => this.turn(-0.1, 0), ArrowRight: () => this.turn(0.1, 0), ArrowUp: () => this.turn(0, -0.1), ArrowDown: () => this.turn(0, 0.1),
            '+': () => this.nearer(1.2), '-': () => this.nearer(1 / 1.2), 0: () => { this.reset(); this.draw(); },
        };
        this.canvas.addEventListener('keydown', e => { if (keys[e.key]) { e.preventDefault(); keys[e.key](); } });
        new ResizeObserver(() => this.draw()).observe(this.canvas);
    }
}
