-- Commands that engineers give between cycles, drawn at random: on rock, joints, conditions, zones and structures. `at` is the lowest corner of
-- the rock, a cube of 10 m. Each function gives lines of a deck, whose numbers with a dimension are written as `units.text` reads them.
local random, rock, units = require "parts.random", require "parts.rock", require "parts.units"

local session = {}

local function between(draw, from, to) return from + (to - from) * draw() end
local function whole(draw, from, to) return math.floor(from + (to + 0.999999 - from) * draw()) end
local function one(draw, list) return list[whole(draw, 1, #list)] end

local point = "{length %.6g} {length %.6g} {length %.6g}"

local function sphere(draw, at, radius)
    local x, y, z = at.x + 10 * draw(), at.y + 10 * draw(), at.z + 10 * draw()
    return (" range sphere center " .. point .. " radius {length %g}"):format(x, y, z, radius)
end

local function layer(at, from, to) return (" range z {length %.17g} {length %.17g}"):format(at.z + from, at.z + to) end

-- Properties of all kinds, up to two cables, and at times a beam on the top and a liner on a side.
local function structures(draw, at)
    local function place()
        local function along() return between(draw, -1, 11) end
        return point:format(at.x + along(), at.y + along(), at.z + along())
    end
    -- Links of beams have their values per length, those of liners per area.
    local links, bonded = draw(), draw() < 0.5
    local function links_of(stiffness, strength)
        if links < 0.4 then return "" end
        local springs = (" kn {%s 1e9} ks {%s 1e8}"):format(stiffness, stiffness)
        return bonded and springs .. (" tension {%s 3e4} cohesion {%s 3e4} friction 30"):format(strength, strength) or springs
    end
    local strong, grout = 10 ^ between(draw, 4, 6), 10 ^ between(draw, 4, 6)
    local lines = {
        ("structure property 1 area {area 1e-3} young {stress 2e11} yield {force %.5g} kbond {stress 5e7} sbond {tension %.5g}"):format(strong, grout),
        "structure property 2 area {area 1e-2} young {stress 2e11} poisson 0.3 density {density 7800} moi-y {fourth 1e-5} moi-z {fourth 2e-5}" ..
            links_of("stress", "tension") .. one(draw, { "", " plastic-moment {energy 5e3}" }),
        "structure property 3 thickness {length 0.1} young {stress 2e10} poisson 0.2 density {density 2400}" .. links_of("stiffness", "stress"),
    }
    for _ = 1, whole(draw, 0, 2) do
        local more = one(draw, { "", " tension {force 3e4}" }) .. one(draw, { "", " anchor both", " anchor last" })
        lines[#lines + 1] = ("structure cable %s %s segments %d%s"):format(place(), place(), whole(draw, 2, 12), more)
    end
    if draw() < 0.6 then
        local x, y, z = at.x, at.y + 10 * draw(), at.z + 10
        local ends = (point .. " " .. point):format(x - whole(draw, 0, 1), y, z, x + 10, y, z)
        local more = one(draw, { "", " anchor both", " anchor all" })
        lines[#lines + 1] = ("structure beam %s segments %d property 2 tolerance {length 0.1}%s"):format(ends, whole(draw, 3, 9), more)
    end
    if draw() < 0.6 then
        local side = ("range y {length %.6g} {length %.6g}"):format(at.y - 0.01, at.y + 0.01)
        lines[#lines + 1] = ("structure liner property 3 edge {length %.3g}%s %s"):format(between(draw, 1, 3), one(draw, { "", " anchor" }), side)
    end
    return table.concat(lines, "\n")
end

local function disc(draw, at)
    local line = "fracture create position " .. point .. " dip %.4g dip-direction %.4g size {length %.3g} dfn a\ncut dfn a limited"
    return line:format(at.x + 5, at.y + 5, at.z + 6, 90 * draw(), 360 * draw(), between(draw, 3, 9))
end

local function joint(draw, at)
    local line = "jset dip %.4g dd %.4g origin " .. point
    return line:format(90 * draw(), 360 * draw(), at.x + 5, at.y + 5, at.z + 6)
end

local dampings = {
    "local", "none", "combined", "auto", "global", "local contact 0.05", "contact 0.1", "0.05 {frequency 3} mass", "0.1 {frequency 5}",
    "rayleigh 0.05 {frequency 20}",
}
local softening = "zone model strain-softening\nprop mat 1 bcoh {stress 1e5} bten {stress 1e4} bfric 30 bdil 0"
local yielding = "zone model mohr-coulomb\nprop mat 1 bcoh {stress %.5g} bten {stress 1e4} bfric 25 bdil 5"

-- Each is a text, or gives one.
local commands = {
    function(draw, at, powers) return rock.law(draw, one(draw, { "", layer(at, 3, 11) }), powers) end,
    function(draw) return ("jmodel jkn={stiffness %.5g} jks={stiffness %.5g}"):format(10 ^ between(draw, 8, 10), 10 ^ between(draw, 8, 10)) end,
    function(_, at) return "change jmat 2 jcons 1" .. layer(at, 5, 11) .. "\nprop jmat 2 jkn {stiffness 1e9} jks {stiffness 5e8} jfric 20" end,
    function(draw)
        local line = "gravity {acceleration %.4g} {acceleration %.4g} {acceleration %.4g}"
        return line:format(between(draw, -2, 2), between(draw, -2, 2), -10 * draw())
    end,
    function(draw) return "damp " .. one(draw, dampings) end,
    function(draw, at) return ("bound xload {force %.5g} zload {force %.5g}"):format(1e4 * draw(), -1e4 * draw()) .. layer(at, 7, 11) end,
    function(draw, at)
        local line = "bound stress {stress %.4g} 0 {stress %.4g} 0 0 0%s"
        return line:format(-1e5 * draw(), -1e5 * draw(), one(draw, { "", " hist sine {frequency 30}" })) .. layer(at, 10, 10)
    end,
    function(draw, at)
        return ("bound xvel {velocity %.4g}%s"):format(0.02 * draw(), one(draw, { "", " hist sine {frequency 20}" })) .. layer(at, -1, 2)
    end,
    function(_, at) return "bound xreaction" .. layer(at, -1, 2) end,
    function(_, at) return "fix direction 1 0 1" .. layer(at, 2, 5) end,
    function(draw, at) return one(draw, { "bound xvisc", "bound nvisc svisc" }) .. (" range x {length %.17g}"):format(at.x) end,
    function(draw, at) return ("ini xvel {velocity %.3g}"):format(between(draw, -0.1, 0.1)) .. layer(at, 4, 11) end,
    function(draw) return ("insitu stress {stress %.4g} {stress %.4g} {stress %.4g} 0 0 0"):format(-1e5 * draw(), -1e5 * draw(), -1e5 * draw()) end,
    "ini pp {stress 1e4}",
    function(draw, at) return ("water table " .. point .. " density {density 1000}"):format(at.x, at.y, at.z + 15 * draw()) end,
    "water off",
    function(draw, at) return one(draw, { "fix", "free" }) .. sphere(draw, at, 2) end,
    function(draw, at) return one(draw, { "delete", "excavate" }) .. sphere(draw, at, 2.5) end,
    function(draw, at) return "join" .. sphere(draw, at, 3) end,
    joint,
    disc,
    function(draw) return ("gen edge {length %.3g}"):format(between(draw, 2, 4)) end, -- of all: joined blocks have zones together
    function(draw) return "zone nmd " .. one(draw, { "on", "off" }) end,
    function(draw) return count("zone") == 0 and "" or one(draw, { "zone model elastic", softening, yielding:format(10 ^ between(draw, 4, 6)) }) end,
    function(draw) return "set small " .. one(draw, { "on", "off" }) end,
    function(draw) return "set dyn " .. one(draw, { "on", "off" }) end,
    function(draw) return "mscale " .. one(draw, { "on", "off", "part {time 1e-4}" }) end,
    function(draw) return ("fraction %.3g"):format(between(draw, 0.05, 0.4)) end,
    structures,
    "structure delete 1",
    "structure property 1 area {area 2e-3}",
    "reset disp jdisp",
    "list contacts",
    function(draw) return ("solve %sratio 1e-3 cycles 100"):format(one(draw, { "", "elastic " })) end,
}

-- A session: a rock, and three to six stops with one or two commands each; commands that have nothing to act on are refused and left out.
-- `how.stop` is called at each stop, `how.unit` is one of `units.of`, `how.powers` lets joint models in whose bits depend on the units.
function session.play(number, how)
    command "new"
    local draw, unit = random(number), how.unit or units.own
    local function try(lines)
        for line in units.text(lines, unit):gmatch "[^\n]+" do pcall(command, line) end
    end
    local at = vector(rock.cut(draw, unit))
    try "prop mat 1 density {density 2500} bulk {stress 5e9} g {stress 3e9}\nprop jmat 1 jkn {stiffness 1e9} jks {stiffness 1e9}"
    if draw() < 0.5 then
        try(("gen edge {length %.3g} range x {length %.17g} {length %.17g}"):format(2 + 2 * draw(), at.x, at.x + 3 + 8 * draw()))
    end
    try(rock.law(draw, "", how.powers))
    try("gravity 0 0 {acceleration -9.81}\ndamp " .. one(draw, { "local", "none" }))
    if draw() < 0.5 then try(structures(draw, at)) end
    for _ = 1, whole(draw, 3, 6) do
        command(("cycle %d"):format(whole(draw, 5, 40)))
        if how.stop then how.stop() end
        for _ = 1, whole(draw, 1, 2) do
            local given = one(draw, commands)
            try(type(given) == "string" and given or given(draw, at, how.powers))
        end
    end
    command "cycle 20"
end

local energies = { "kinetic_energy", "gravity_work", "boundary_work", "joint_work", "zone_work", "damped_energy", "structure_work" }
-- Objects, and their vectors with the dimensions.
local moving = {
    { blocks, { { "position", "length" }, { "velocity", "velocity" }, { "rotational_velocity", "frequency" } } },
    { gridpoints, { { "position", "length" }, { "velocity", "velocity" } } },
    { structure_nodes, { { "position", "length" }, { "velocity", "velocity" } } },
    { sub_contacts, { { "shear_force_vector", "force" } } },
}

-- All that motion has changed, to the last bit, in the units of the texts.
function session.digest(unit)
    unit = unit or units.own
    local bits = {}
    local function add(number, dimension) bits[#bits + 1] = ("%a"):format(number / unit[dimension]) end
    add(model.time, "time")
    for _, name in ipairs(energies) do add(model[name], "energy") end
    for _, kind in ipairs(moving) do
        for object in kind[1]() do
            for _, field in ipairs(kind[2]) do
                local v = object[field[1]]
                for _, axis in ipairs { "x", "y", "z" } do add(v[axis], field[2]) end
            end
        end
    end
    for s in sub_contacts() do add(s.normal_force, "force") end
    return table.concat(bits, " ")
end

return session
