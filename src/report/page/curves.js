// A curve over time or over cycles: zoom by dragging, values under the pointer, the numbers as a file.
const svgName = 'http://www.w3.org/2000/svg';

function svgElement(name, attributes, text) {
    const element = document.createElementNS(svgName, name);
    for (const key in attributes) element.setAttribute(key, attributes[key]);
    if (text !== undefined) element.textContent = text;
    return element;
}

// Multiples of 1, 2 or 5 times a power of ten.
function ticks(low, high) {
    const rough = (high - low) / 5, power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map(m => m * power).find(s => s >= rough * 0.999);
    const all = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) all.push(k * step);
    return all;
}

function range(values) {
    let low = Infinity, high = -Infinity;
    for (const v of values) if (isFinite(v)) { low = Math.min(low, v); high = Math.max(high, v); }
    if (!(low <= high)) return [0, 1];
    return low < high ? [low, high] : [low - (Math.abs(low) || 1), high + (Math.abs(high) || 1)];
}

class CurveView {
    constructor(parent, title, times, values, along) {
        this.title = title; this.along = along; this.times = times; this.values = values;
        this.box = document.createElement('div');
        this.box.className = 'curve';
        const head = document.createElement('h3');
        head.textContent = title;
        this.svg = svgElement('svg', { viewBox: '0 0 760 280', role: 'img', 'aria-label': `${title} over ${along}` });
        this.read = document.createElement('div');
        this.read.className = 'read';
        const button = document.createElement('button');
        button.textContent = 'CSV';
        button.onclick = () => this.download();
        this.box.append(head, this.svg, this.read, button);
        parent.append(this.box);
        this.svg.addEventListener('pointermove', e => this.move(e));
        this.svg.addEventListener('pointerdown', e => { this.from = this.timeAt(e); });
        this.svg.addEventListener('pointerup', e => this.zoom(e));
        this.svg.addEventListener('dblclick', () => this.draw(range(times)));
        this.draw(range(times));
    }
    across(t) { return 80 + 660 * (t - this.span[0]) / (this.span[1] - this.span[0]); }
    up(v) { return 240 - 220 * (v - this.low) / (this.high - this.low); }
    timeAt(event) {
        const box = this.svg.getBoundingClientRect();
        const x = (event.clientX - box.left) * 760 / box.width;
        return this.span[0] + (Math.min(740, Math.max(80, x)) - 80) / 660 * (this.span[1] - this.span[0]);
    }
    draw(span) {
        this.span = span;
        const inside = [];
        this.times.forEach((t, i) => { if (t >= span[0] && t <= span[1]) inside.push(i); });
        [this.low, this.high] = range(inside.map(i => this.values[i]));
        const edge = 0.04 * (this.high - this.low);
        this.low -= edge; this.high += edge;
        this.svg.replaceChildren();
        for (const t of ticks(span[0], span[1])) {
            this.svg.append(svgElement('path', { d: `M${this.across(t)} 20V240`, stroke: '#ddd' }));
            this.svg.append(svgElement('text', { x: this.across(t), y: 258, 'text-anchor': 'middle', 'font-size': 12 }, short(t)));
        }
        for (const v of ticks(this.low, this.high)) {
            this.svg.append(svgElement('path', { d: `M80 ${this.up(v)}H740`, stroke: '#ddd' }));
            this.svg.append(svgElement('text', { x: 74, y: this.up(v) + 4, 'text-anchor': 'end', 'font-size': 12 }, short(v)));
        }
        this.svg.append(svgElement('text', { x: 740, y: 275, 'text-anchor': 'end', 'font-size': 12 }, this.along));
        this.svg.append(svgElement('path', { d: this.path(inside), fill: 'none', stroke: '#0072b2', 'stroke-width': 1.6 }));
        this.mark = svgElement('circle', { r: 4, fill: '#d55e00', visibility: 'hidden' });
        this.svg.append(this.mark);
    }
    // Of many samples the least and greatest of each pixel.
    path(inside) {
        const every = Math.max(1, Math.floor(inside.length / 1500));
        let path = '', pen = 'M';
        for (let first = 0; first < inside.length; first += every) {
            const part = inside.slice(first, first + every).filter(i => isFinite(this.values[i]));
            if (part.length === 0) { pen = 'M'; continue; }
            let low = part[0], high = part[0];
            for (const i of part) { if (this.values[i] < this.values[low]) low = i; if (this.values[i] > this.values[high]) high = i; }
            for (const i of low === high ? [low] : [Math.min(low, high), Math.max(low, high)]) {
                path += `${pen}${this.across(this.times[i]).toFixed(1)} ${this.up(this.values[i]).toFixed(1)}`;
                pen = 'L';
            }
        }
        return path;
    }
    nearest(time) {
        let best = 0;
        this.times.forEach((t, i) => { if (Math.abs(t - time) < Math.abs(this.times[best] - time)) best = i; });
        return best;
    }
    move(event) {
        if (this.times.length === 0) return;
        const i = this.nearest(this.timeAt(event));
        this.read.textContent = `${this.along} ${short(this.times[i])}: ${short(this.values[i])}`;
        this.mark.setAttribute('cx', this.across(this.times[i]));
        this.mark.setAttribute('cy', this.up(this.values[i]));
        this.mark.setAttribute('visibility', isFinite(this.values[i]) ? 'visible' : 'hidden');
    }
    zoom(event) {
        const to = this.timeAt(event), from = this.from;
        this.from = undefined;
        if (from !== undefined && Math.abs(to - from) > 0.01 * (this.span[1] - this.span[0])) this.draw([Math.min(from, to), Math.max(from, to)]);
    }
    download() {
        // An apostrophe keeps a spreadsheet from taking the title for a formula.
        const title = this.title.replace(/^[=+\-@\t\r\n\uFF1D\uFF0B\uFF0D\uFF20]/, "'$&");
        let text = `${this.along},"${title.replace(/"/g, '""')}"\n`;
        this.times.forEach((t, i) => { text += `${t},${isFinite(this.values[i]) ? this.values[i] : ''}\n`; });
        const link = document.createElement('a');
        link.href = URL.createObjectURL(new Blob([text], { type: 'text/csv' }));
        link.download = 'history.csv';
        link.click();
        URL.revokeObjectURL(link.href);
    }
}
