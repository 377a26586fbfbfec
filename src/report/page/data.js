// Columns that kaya packed: base64 of deflate.
const littleEndian = new Uint8Array(new Uint16Array([1]).buffer)[0] === 1;

async function unpack(text, Type) {
    const small = Uint8Array.from(atob(text), c => c.charCodeAt(0));
    const stream = new Blob([small]).stream().pipeThrough(new DecompressionStream('deflate'));
    const bytes = await new Response(stream).arrayBuffer();
    if (!littleEndian) new Uint8Array(bytes).reverse();
    const numbers = new Type(bytes);
    return littleEndian ? numbers : numbers.reverse();
}

function readJson(id) {
    return JSON.parse(document.getElementById(id).textContent);
}

// A number as people write it.
function short(value) {
    if (!isFinite(value)) return 'none';
    return String(Number(value.toPrecision(5)));
}
