// Columns that kaya packed: base64 of deflate of the first bytes of all numbers, their second bytes and so on.
const littleEndian = new Uint8Array(new Uint16Array([1]).buffer)[0] === 1;

async function unpack(text, Type) {
    const small = Uint8Array.from(atob(text), c => c.charCodeAt(0));
    const stream = new Blob([small]).stream().pipeThrough(new DecompressionStream('deflate'));
    const planes = new Uint8Array(await new Response(stream).arrayBuffer()), size = Type.BYTES_PER_ELEMENT, count = planes.length / size;
    const bytes = new Uint8Array(planes.length);
    for (let k = 0; k < size; ++k) {
        const place = littleEndian ? k : size - 1 - k;
        for (let i = 0; i < count; ++i) bytes[i * size + place] = planes[k * count + i];
    }
    return new Type(bytes.buffer);
}

function readJson(id) {
    return JSON.parse(document.getElementById(id).textContent);
}

// A number as people write it.
function short(value) {
    if (!isFinite(value)) return 'none';
    return String(Number(value.toPrecision(5)));
}
