// Puts the page together. A view can be linked to: report.html#colour=group&factor=10&axis=plane&dip=60&dd=90&cut=500&side=front&state=3&show=joints&marks=velocity&bands=1&equal=500&pick=300,200
async function unpackScene(scene) {
    for (const [name, Type] of [['numbers', Uint32Array], ['corners', Uint32Array], ['triangles', Uint32Array], ['lines', Uint32Array], ['places', Float32Array],
        ['displacements', Float32Array], ['triangleCorners', Uint32Array], ['lineCorners', Uint32Array]]) scene[name] = await unpack(scene[name], Type);
    for (const field of scene.fields) field.values = await unpack(field.values, Float32Array);
}

// Places, displacements, zones and fields inside the blocks of the last state; null in the page of a very large model.
async function readInside() {
    const inside = readJson('inside-data');
    if (!inside) return null;
    for (const [name, Type] of [['corners', Uint32Array], ['zones', Uint32Array], ['zoneCorners', Uint32Array], ['places', Float32Array], ['displacements', Float32Array]])
        inside[name] = await unpack(inside[name], Type);
    for (const field of inside.fields) field.values = await unpack(field.values, Float32Array);
    return inside;
}

// The states that the model went through; the last one is that of the tables.
async function readStates() {
    const states = readJson('scene-data');
    for (const state of states) await unpackScene(state.scene);
    return states;
}

// The same colour is the same value in all states.
function endsOf(states, field) {
    const ends = [Infinity, -Infinity];
    for (const state of states)
        for (const same of state.scene.fields)
            if (same.name === field.name && same.values.length > 0) {
                const [low, high] = range(same.values);
                ends[0] = Math.min(ends[0], low);
                ends[1] = Math.max(ends[1], high);
            }
    return ends;
}

// The colours of bands from low to high, each from one place of the bar to another.
function bandedColours(ends) {
    const step = bandStep(ends), length = ends[1] - ends[0] || 1, stops = [];
    const colour = part => {
        const at = Math.max(0, Math.min(1, part)) * 8, low = Math.min(Math.floor(at), 7);
        return `rgb(${viridis[low].map((c, k) => Math.round(c + (at - low) * (viridis[low + 1][k] - c))).join(',')})`;
    };
    for (let n = Math.floor(ends[0] / step); step > 0 && n * step < ends[1]; ++n)
        for (const level of [n, n + 1]) stops.push(`${colour(((n + 0.5) * step - ends[0]) / length)} ${100 * Math.max(0, Math.min(1, (level * step - ends[0]) / length))}%`);
    return stops.length > 0 ? stops : [colour(0.5), colour(0.5)];
}

function showLegend(field, ends, bands) {
    const legend = document.getElementById('legend'), css = c => `rgb(${c.join(',')})`;
    legend.replaceChildren();
    const title = document.createElement('div');
    title.textContent = field.unit === '-' ? field.name : `${field.name} [${field.unit}]`;
    legend.append(title);
    if (field.names.length > 0) {
        field.names.slice(0, 20).forEach((name, i) => {
            const line = document.createElement('div'), swatch = document.createElement('span');
            swatch.className = 'swatch';
            swatch.style.background = css(named[i % 8 + 1]);
            line.append(swatch, name);
            legend.append(line);
        });
        return;
    }
    const bar = document.createElement('span'), numbers = document.createElement('span');
    bar.className = 'bar';
    bar.style.background = `linear-gradient(to top, ${bands ? bandedColours(ends).join(',') : viridis.map(css).join(',')})`;
    numbers.className = 'ends';
    for (const value of [ends[1], (ends[0] + ends[1]) / 2, ends[0]]) {
        const line = document.createElement('span');
        line.textContent = short(value);
        numbers.append(line);
    }
    legend.append(bar, numbers);
}

function showPicked(scene, block, what) {
    const box = document.getElementById('picked');
    box.style.display = block < 0 ? 'none' : 'block';
    if (block < 0) { box.textContent = ''; return; }
    const lines = [`${what} ${scene.numbers[block]}`];
    const first = scene.corners.subarray(0, block).reduce((sum, n) => sum + n, 0), end = first + scene.corners[block];
    for (const field of scene.fields) {
        if (field.name === 'id') continue;
        const unit = field.unit === '-' ? '' : ` ${field.unit}`;
        if (field.of === 'block') lines.push(`${field.name}: ${field.names.length > 0 ? field.names[field.values[block]] : short(field.values[block]) + unit}`);
        else { // from the least to the greatest of its corners
            const values = field.values.subarray(first, end).filter(v => isFinite(v));
            if (values.length === 0) continue;
            const low = short(Math.min(...values)), high = short(Math.max(...values));
            lines.push(`${field.name}: ${low === high ? low : `${low} to ${high}`}${unit}`);
        }
    }
    box.textContent = lines.join('\n');
}

// The axes of the model as the eye sees them.
function showAxes(axes, coarse) {
    const box = document.getElementById('axes');
    box.replaceChildren();
    ['x', 'y', 'z'].forEach((name, k) => {
        const across = 40 + 28 * axes.right[k], up = 40 - 28 * axes.up[k];
        box.append(svgElement('path', { d: `M40 40L${across} ${up}`, stroke: ['#d55e00', '#009e73', '#0072b2'][k], 'stroke-width': 2 }));
        box.append(svgElement('text', { x: across + 3, y: up + 3, 'font-size': 12 }, name));
    });
    document.getElementById('coarse').textContent = coarse ? 'coarser and without edges while it turns' : '';
}

let jointScene = null;

async function connect(states, view) {
    let scene = states.at(-1).scene;
    view.onrender = showAxes;
    const get = id => document.getElementById(id);
    const inside = await readInside(), solid = inside && new Solid(scene, inside), equal = get('equal'), level = get('level');
    const allMarks = await readMarks(), marks = get('marks'), bands = get('bands');
    const axis = get('axis'), cut = get('cut'), dip = get('dip'), direction = get('dd'), factor = get('factor'), field = get('field'), state = get('state');
    let joints = null, fields = scene.fields;
    const listFields = () => { field.replaceChildren(...fields.map((f, i) => new Option(f.name, i))); };
    listFields();
    field.oninput = () => {
        const wanted = fields[Number(field.value)], none = { ...wanted, of: 'block', values: new Float32Array(scene.numbers.length).fill(NaN) };
        let f = scene.fields.find(f => f.name === wanted.name) || none;
        // Names are counted as in the last state: the same colour is the same name.
        if (f.names.length > 0) f = { ...f, names: wanted.names, values: f.values.map(v => wanted.names.indexOf(f.names[v])) };
        view.colour(f, endsOf(joints ? [joints] : states, wanted));
        const chosen = allMarks[marks.selectedIndex - 1];
        setLevel();
        if (chosen) showLegend({ ...chosen, names: [] }, view.marks.ends, false);
        else showLegend(f, view.ends, bands.checked && f.names.length === 0);
    };
    // To the hundredfold in equal steps of the eye.
    factor.oninput = () => {
        const times = factor.value === '0' ? 0 : 10 ** (factor.value / 25 - 1);
        view.state.factor = times;
        get('factor-value').textContent = short(Number(times.toPrecision(2)));
        view.draw();
    };
    // The part in front of a plane is left out: across an axis, or with a dip and its direction.
    const setCut = () => {
        const normal = axis.value === 'plane' ? normalOf(Number(dip.value), Number(direction.value)) : ['x', 'y', 'z'].map(name => name === axis.value ? 1 : 0);
        let low = Infinity, high = -Infinity;
        for (let i = 0; i < scene.places.length; i += 3) {
            const away = normal[0] * scene.places[i] + normal[1] * scene.places[i + 1] + normal[2] * scene.places[i + 2];
            low = Math.min(low, away); high = Math.max(high, away);
        }
        get('tilt').hidden = axis.value !== 'plane';
        view.state.cut = [...normal, cut.value === cut.max ? 1e30 : low + (high - low) * cut.value / cut.max];
        view.draw();
    };
    for (const input of [dip, direction]) input.oninput = setCut;
    bands.onchange = () => { view.state.bands = bands.checked; field.oninput(); };
    // A surface of one value, or with bands those of all their limits.
    const setLevel = () => {
        view.state.level = equal.checked ? level.value / level.max : null;
        const levels = view.levels();
        level.hidden = levels.length !== 1 || bands.checked;
        get('level-value').textContent = equal.checked && levels.length === 0 ? 'this colour has one value in a block' : levels.length === 1 ? short(levels[0]) : '';
        view.draw();
    };
    level.oninput = setLevel;
    equal.onchange = () => { keepLast(); setState(); };
    if (!inside) get('equals').style.display = 'none';
    axis.oninput = setCut;
    cut.oninput = setCut;
    // A block that was picked stays picked.
    const setState = () => {
        const picked = view.state.picked < 0 ? -1 : scene.numbers[view.state.picked], now = states[state.value];
        scene = joints ? joints.scene : now.scene;
        view.show(scene);
        view.solid = !joints && now === states.at(-1) ? solid : null;
        view.state.picked = picked < 0 ? -1 : scene.numbers.indexOf(picked);
        get('state-value').textContent = `cycle ${now.cycle}, time ${short(now.time)}`;
        showPicked(scene, view.state.picked, joints ? 'joint' : 'block');
        setCut();
        field.oninput();
    };
    // Joints, marks and the inside are those of the last state.
    const what = get('what');
    const keepLast = () => {
        state.disabled = what.selectedIndex === 1 || marks.selectedIndex > 0 || equal.checked;
        if (state.disabled) state.value = states.length - 1;
    };
    marks.replaceChildren(new Option('none'), ...allMarks.map(set => new Option(set.name)));
    if (allMarks.length === 0) get('markings').style.display = 'none';
    marks.oninput = () => {
        keepLast();
        view.mark(allMarks[marks.selectedIndex - 1] || null);
        setState();
    };
    what.oninput = async () => {
        const asked = what.selectedIndex === 1;
        get('equals').hidden = asked;
        if (asked) {
            if (!jointScene) await unpackScene(jointScene = readJson('joint-data'));
            joints = { scene: jointScene };
        } else joints = null;
        keepLast();
        fields = asked ? jointScene.fields : states.at(-1).scene.fields;
        listFields();
        view.state.picked = -1;
        setState();
    };
    if (!readJson('joint-data')) get('whats').style.display = 'none';
    state.max = states.length - 1;
    state.value = states.length - 1;
    if (states.length < 2) get('states').style.display = 'none';
    state.oninput = setState;
    get('edges').onchange = e => { view.state.edges = e.target.checked; view.draw(); };
    get('reset').onclick = () => { view.reset(); view.draw(); };
    for (const side of Object.keys(sides)) {
        const button = document.createElement('button');
        button.type = 'button';
        button.textContent = side;
        button.onclick = () => view.from(side);
        get('sides').append(button);
    }
    view.onpick = block => showPicked(scene, block, joints ? 'joint' : 'block');
    const asked = new URLSearchParams(location.hash.slice(1));
    const choose = () => {
        const index = fields.findIndex(f => f.name === asked.get('colour'));
        field.value = index >= 0 ? index : 0;
    };
    choose();
    if (asked.get('side') in sides) view.from(asked.get('side'));
    if (asked.has('factor')) factor.value = asked.get('factor');
    for (const [name, input] of Object.entries({ axis, dip, dd: direction, cut })) if (asked.has(name)) input.value = asked.get(name);
    bands.checked = view.state.bands = asked.has('bands');
    equal.checked = asked.has('equal');
    if (equal.checked) level.value = asked.get('equal');
    if (asked.has('state')) state.value = asked.get('state');
    keepLast();
    factor.oninput();
    setState();
    if (allMarks.some(set => set.name === asked.get('marks'))) {
        marks.value = asked.get('marks');
        marks.oninput();
    }
    if (asked.get('show') === 'joints') {
        what.selectedIndex = 1;
        await what.oninput();
        choose();
        field.oninput();
    }
    if (asked.has('pick')) {
        const [x, y] = asked.get('pick').split(',').map(Number);
        showPicked(scene, view.pick(x, y), joints ? 'joint' : 'block');
    }
}

async function showCurves(data, place, along) {
    for (const curve of readJson(data))
        new CurveView(document.getElementById(place), curve.title, await unpack(curve.times, Float64Array), await unpack(curve.values, Float64Array), along);
}

// What is wider than the window is scrolled by keyboard too.
function reachScrolled() {
    for (const box of document.querySelectorAll('section, pre')) {
        if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
        else box.removeAttribute('tabindex');
    }
}

async function start() {
    new ResizeObserver(reachScrolled).observe(document.body);
    await showCurves('history-data', 'curves', 'time');
    await showCurves('course-data', 'course-curves', 'cycle');
    const states = await readStates(), scene = states.at(-1).scene;
    if (scene.numbers.length === 0) { document.getElementById('view').remove(); document.getElementById('controls').remove(); return; }
    try {
        const view = new BlockView(document.getElementById('blocks'), scene);
        await connect(states, view);
        view.render(false);
    } catch (problem) {
        document.getElementById('picked').style.display = 'block';
        document.getElementById('picked').textContent = `no view: ${problem.message}`;
        throw problem;
    }
}
start().then(() => { document.documentElement.dataset.state = 'drawn'; },
    problem => { document.documentElement.dataset.state = `failed: ${problem.message}`; });
