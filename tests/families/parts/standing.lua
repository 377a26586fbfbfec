-- A block that stands on a held base, placed by one of four frames.
local scene, shapes, place = require "parts.scene", require "parts.shapes", require "parts.place"
local standing = {}

standing.frames = {
    level = place.new(),
    turned = place.new(place.about(vector(0, 0, 1), 33)),
    lying = place.new(place.about(vector(1, 2, 3), 70), vector(1e4, -500, 900)),
    mirrored = place.new({ { -1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }),
}
standing.names = { "level", "turned", "lying", "mirrored" }

-- The base, and the body of a block b x h, `deep` deep, whose base has its middle at the origin of the frame.
function standing.build(at, b, deep, h)
    local function build(s, z) return shapes.build(shapes.moved(shapes.moved(s, place.new(nil, vector(0, 0, z))), at)) end
    local base = build(shapes.box(8 * b, 4 * b, b), -b / 2).block
    scene.hold(base)
    return base, build(shapes.box(b, deep, h), h / 2)
end

-- The angle by which the body has turned about the frame's y.
function standing.tilt(at, body)
    local side = body.corners[2].position - body.corners[1].position -- along x as built
    return math.atan(-side:dot(at:direction(vector(0, 0, 1))), side:dot(at:direction(vector(1, 0, 0))))
end

return standing
