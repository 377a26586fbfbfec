// What the graphics processor does: places, colours, and blocks as numbers for picking.
const vertexShader = `#version 300 es
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 displacement;
layout(location = 2) in float value;
layout(location = 3) in float block;
uniform mat4 camera;
uniform float factor;
uniform float towards; // edges lie in front of their faces
out vec3 where;
out float amount;
flat out float number;
void main() {
    where = place + factor * displacement;
    amount = value;
    number = block;
    gl_Position = camera * vec4(where, 1.0);
    gl_Position.z -= towards;
    gl_Position.z += 2e-6 * mod(block, 8.0) * gl_Position.w; // of two faces in one place always the same is seen
}`;

const faceShader = `#version 300 es
precision highp float;
in vec3 where;
in float amount;
flat in float number;
uniform vec4 cut;
uniform vec2 ends;
uniform int names;
uniform float band; // 0: colours change without steps
uniform bool picking, lines;
uniform float picked;
uniform vec3 light;
uniform vec3 colours[9];
out vec4 colour;
vec3 sequential(float part) {
    float at = clamp(part, 0.0, 1.0) * 8.0;
    int low = min(int(at), 7);
    return mix(colours[low], colours[low + 1], at - float(low));
}
void main() {
    if (dot(cut.xyz, where) > cut.w) discard;
    if (picking) {
        int n = int(number) + 1;
        colour = vec4(float(n & 255), float(n >> 8 & 255), float(n >> 16 & 255), 255.0) / 255.0;
        return;
    }
    vec3 normal = normalize(cross(dFdx(where), dFdy(where)));
    float bright = 0.7 + 0.3 * abs(dot(normal, light));
    vec3 base = vec3(0.8);
    float shown = band > 0.0 ? (floor(amount / band) + 0.5) * band : amount;
    if (amount == amount) base = names > 0 ? colours[int(mod(amount + 0.5, 8.0)) + 1] : sequential((shown - ends.x) / max(ends.y - ends.x, 1e-30));
    if (lines) { colour = vec4(vec3(dot(base, vec3(0.3, 0.6, 0.1)) < 0.2 ? 0.5 : 0.12), 1.0); return; } // seen on dark faces too
    if (band > 0.0) { // a line where one band ends
        float level = amount / band;
        base *= mix(0.4, 1.0, clamp((0.5 - abs(fract(level) - 0.5)) / max(fwidth(level), 1e-6), 0.0, 1.0));
    }
    if (number == picked) base = vec3(0.95, 0.45, 0.1);
    colour = vec4(bright * base, 1.0);
}`;

// Viridis, and the colours of Okabe and Ito: eyes that do not tell red from green read both.
const viridis = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];
const named = [[0, 0, 0], [230, 159, 0], [86, 180, 233], [0, 158, 115], [240, 228, 66], [0, 114, 178], [213, 94, 0], [204, 121, 167], [153, 153, 153]];
