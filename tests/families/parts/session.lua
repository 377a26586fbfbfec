-- Commands that engineers give between cycles, drawn at random: on rock, joints, conditions, zones and structures. `at` is the lowest corner of
-- the rock, a cube of 10 m. Each function gives lines of a deck.
local rock = require "parts.rock"

local session = {}

local function between(draw, from, to) return from + (to - from) * draw() end
local function whole(draw, from, to) return math.floor(from + (to + 0.999999 - from) * draw()) end
local function one(draw, list) return list[whole(draw, 1, #list)] end

local function sphere(draw, at, radius)
    local x, y, z = at.x + 10 * draw(), at.y + 10 * draw(), at.z + 10 * draw()
    return (" range sphere center %.6g %.6g %.6g radius %.3g"):format(x, y, z, radius)
end

local function layer(at, from, to) return (" range z %.17g %.17g"):format(at.z + from, at.z + to) end

-- Properties of all kinds, up to two cables, and at times a beam on the top and a liner on a side.
function session.structures(draw, at)
    local function place() return ("%.6g %.6g %.6g"):format(at.x + between(draw, -1, 11), at.y + between(draw, -1, 11), at.z + between(draw, -1, 11)) end
    local links = one(draw, { "", " kn 1e9 ks 1e8", " kn 1e9 ks 1e8 tension 3e4 cohesion 3e4 friction 30" })
    local lines = {
        ("structure property 1 area 1e-3 young 2e11 yield %.5g kbond 5e7 sbond %.5g"):format(10 ^ between(draw, 4, 6), 10 ^ between(draw, 4, 6)),
        "structure property 2 area 1e-2 young 2e11 poisson 0.3 density 7800 moi-y 1e-5 moi-z 2e-5" .. links .. one(draw, { "", " plastic-moment 5e3" }),
        "structure property 3 thickness 0.1 young 2e10 poisson 0.2 density 2400" .. links,
    }
    for _ = 1, whole(draw, 0, 2) do
        local more = one(draw, { "", " tension 3e4" }) .. one(draw, { "", " anchor both", " anchor last" })
        lines[#lines + 1] = ("structure cable %s %s segments %d%s"):format(place(), place(), whole(draw, 2, 12), more)
    end
    if draw() < 0.6 then
        local x, y, z = at.x, at.y + 10 * draw(), at.z + 10
        local ends = ("%.17g %.17g %.17g %.17g %.17g %.17g"):format(x - whole(draw, 0, 1), y, z, x + 10, y, z)
        lines[#lines + 1] = ("structure beam %s segments %d property 2 tolerance 0.1%s"):format(ends, whole(draw, 3, 9), one(draw, { "", " anchor both", " anchor all" }))
    end
    if draw() < 0.6 then
        lines[#lines + 1] = ("structure liner property 3 edge %.3g%s range y %.17g %.17g"):format(between(draw, 1, 3), one(draw, { "", " anchor" }), at.y - 0.01, at.y + 0.01)
    end
    return table.concat(lines, "\n")
end

local commands = {
    function(draw, at) return rock.law(draw, one(draw, { "", layer(at, 3, 11) })) end,
    function(draw) return ("jmodel jkn=%.5g jks=%.5g"):format(10 ^ between(draw, 8, 10), 10 ^ between(draw, 8, 10)) end,
    function(_, at) return "change jmat 2 jcons 1" .. layer(at, 5, 11) .. "\nprop jmat 2 jkn 1e9 jks 5e8 jfric 20" end,
    function(draw) return ("gravity %.4g %.4g %.4g"):format(between(draw, -2, 2), between(draw, -2, 2), -10 * draw()) end,
    function(draw)
        return "damp " .. one(draw, { "local", "none", "combined", "auto", "local contact 0.05", "0.05 3 mass", "0.1 5", "global", "rayleigh 0.05 20" })
    end,
    function(draw, at) return ("bound xload %.5g zload %.5g"):format(1e4 * draw(), -1e4 * draw()) .. layer(at, 7, 11) end,
    function(draw, at)
        return ("bound stress %.4g 0 %.4g 0 0 0%s"):format(-1e5 * draw(), -1e5 * draw(), one(draw, { "", " hist sine 30" })) .. layer(at, 10, 10)
    end,
    function(draw, at) return ("bound xvel %.4g%s"):format(0.02 * draw(), one(draw, { "", " hist sine 20" })) .. layer(at, -1, 2) end,
    function(draw, at) return one(draw, { "bound xvisc", "bound nvisc svisc" }) .. (" range x %.17g"):format(at.x) end,
    function(draw, at) return ("ini xvel %.3g"):format(between(draw, -0.1, 0.1)) .. layer(at, 4, 11) end,
    function(draw) return ("insitu stress %.4g %.4g %.4g 0 0 0"):format(-1e5 * draw(), -1e5 * draw(), -1e5 * draw()) end,
    function() return "ini pp 1e4" end,
    function(draw, at) return ("water table %.17g %.17g %.17g density 1000"):format(at.x, at.y, at.z + 15 * draw()) end,
    function() return "water off" end,
    function(draw, at) return one(draw, { "fix", "free" }) .. sphere(draw, at, 2) end,
    function(draw, at) return one(draw, { "delete", "excavate" }) .. sphere(draw, at, 2.5) end,
    function(draw, at) return "join" .. sphere(draw, at, 3) end,
    function(draw, at) return ("jset dip %.4g dd %.4g origin %.17g %.17g %.17g"):format(90 * draw(), 360 * draw(), at.x + 5, at.y + 5, at.z + 6) end,
    function(draw) return ("gen edge %.3g"):format(between(draw, 2, 4)) end, -- of all: joined blocks have zones together
    function(draw) return "zone nmd " .. one(draw, { "on", "off" }) end,
    function(draw) return "set small " .. one(draw, { "on", "off" }) end,
    function(draw) return "set dyn " .. one(draw, { "on", "off" }) end,
    function(draw) return "mscale " .. one(draw, { "on", "off", "part 1e-4" }) end,
    function(draw) return ("fraction %.3g"):format(between(draw, 0.05, 0.4)) end,
    session.structures,
    function() return "structure delete 1" end,
    function() return "structure property 1 area 2e-3" end,
    function() return "reset disp jdisp" end,
    function() return "list contacts" end,
    function(draw) return ("solve %sratio 1e-3 cycles 100"):format(one(draw, { "", "elastic " })) end,
    function(draw, at)
        local disc = "fracture create position %.6g %.6g %.6g dip %.4g dip-direction %.4g size %.3g dfn a"
        return disc:format(at.x + 5, at.y + 5, at.z + 6, 90 * draw(), 360 * draw(), between(draw, 3, 9)) .. "\ncut dfn a limited"
    end,
}

-- One or two of them.
function session.commands(draw, at)
    local lines = {}
    for _ = 1, whole(draw, 1, 2) do lines[#lines + 1] = one(draw, commands)(draw, at) end
    return table.concat(lines, "\n")
end

-- All that motion has changed, to the last bit.
function session.digest()
    local numbers = { model.time, model.kinetic_energy, model.gravity_work, model.boundary_work, model.joint_work, model.zone_work, model.damped_energy, model.structure_work }
    local function add(v) numbers[#numbers + 1], numbers[#numbers + 2], numbers[#numbers + 3] = v.x, v.y, v.z end
    for b in blocks() do add(b.position) add(b.velocity) add(b.rotational_velocity) end
    for g in gridpoints() do add(g.position) add(g.velocity) end
    for n in structure_nodes() do add(n.position) add(n.velocity) end
    for s in sub_contacts() do
        numbers[#numbers + 1] = s.normal_force
        add(s.shear_force_vector)
    end
    for i, number in ipairs(numbers) do numbers[i] = ("%a"):format(number) end
    return table.concat(numbers, " ")
end

return session
