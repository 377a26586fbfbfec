-- Reads a simple deck and writes it for another position, other units, another order of its blocks and other first corners of their faces.
-- It accepts poly brick, prism and face, jset of one joint, gravity, fix and free of whole blocks, prop, jmodel, apply of loads, initialize
-- of velocities, damp, facetri, fraction, solve and cycle; any other line is an error.
local place, shapes = require "parts.place", require "parts.shapes"
local simple_deck = {}

local function fail(line, why) error(("%s: %s"):format(why, line), 0) end

-- Statements of the text: lists of words, and the line itself.
function simple_deck.read(text)
    local statements = {}
    for line in text:gsub("&[^\n]*\n", " "):gmatch "[^\n]+" do
        local bare = line:gsub(";.*", "")
        local words = {}
        for word in bare:gmatch "[^%s,()=]+" do words[#words + 1] = tonumber(word) or word:lower() end
        if #words > 0 then
            words.line = bare
            statements[#statements + 1] = words
        end
    end
    return statements
end

-- Powers of the units of length, stress and time in a quantity.
local units = {
    length = { 1, 0, 0 }, stress = { 0, 1, 0 }, time = { 0, 0, 1 }, density = { -2, 1, 2 }, acceleration = { 1, 0, -2 },
    velocity = { 1, 0, -1 }, spin = { 0, 0, -1 }, force = { 2, 1, 0 }, moment = { 3, 1, 0 }, stiffness = { -1, 1, 0 },
    frequency = { 0, 0, -1 }, number = { 0, 0, 0 },
}

function simple_deck.factor(twin, quantity)
    local p = units[quantity]
    return (twin.length or 1) ^ p[1] * (twin.stress or 1) ^ p[2] * (twin.time or 1) ^ p[3]
end

local function text_of(words)
    local texts = {}
    for i, word in ipairs(words) do texts[i] = math.type(word) == "float" and ("%.17g"):format(word) or tostring(word) end
    return table.concat(texts, " ")
end

-- Words followed by a number; its unit.
local scalars = {
    property = {
        prop = "number", property = "number", mat = "number", density = "density", dens = "density", k = "stress", bulk = "stress",
        g = "stress", shear = "stress", range = "number", region = "number",
    },
    jmodel = {
        jkn = "stiffness", jks = "stiffness", jfric = "number", jdil = "number", jcoh = "stress", jten = "stress", cohesion = "stress",
        tension = "stress",
    },
    damp = { ["local"] = "number", contact = "number", global = "number", combined = "number" },
    facetri = { edge = "length" },
    fraction = { fraction = "number" },
    solve = { ratio = "number", cycles = "number", cycle = "number", time = "time" },
    cycle = { time = "time" },
}
local heads = {
    prop = "property", property = "property", jmodel = "jmodel", facetri = "facetri", fraction = "fraction", solve = "solve",
    cycle = "cycle",
}

local function scaled(words, twin)
    local table_of = scalars[heads[words[1]]]
    local result = {}
    for i, word in ipairs(words) do
        if type(word) == "number" and table_of[words[i - 1]] then
            result[i] = word * simple_deck.factor(twin, table_of[words[i - 1]])
            if table_of[words[i - 1]] == "number" then result[i] = word end
        elseif type(word) == "number" and not (words[1] == "cycle" and i == 2) then
            fail(words.line, ("nobody knows the unit of %s"):format(word))
        else
            result[i] = word
        end
    end
    return { text_of(result) }
end

local function damping(words, twin)
    if type(words[2]) ~= "number" then
        local result = {}
        for i, word in ipairs(words) do result[i] = word end
        return { text_of(result) }
    end
    -- A fraction, a frequency, and optionally one of the two terms.
    local frequency = words[3] * simple_deck.factor(twin, "frequency")
    return { text_of { "damp", words[2], frequency, table.unpack(words, 4) } }
end

-- The text after `range`, as one range for each output line. A box is evaluated by centroids.
local function ranges(words, twin, built)
    local at
    for i, word in ipairs(words) do if word == "range" then at = i end end
    if not at then return { "" }, #words end
    if words[at + 1] == "region" and #words == at + 2 then return { (" range region %d"):format(words[at + 2]) }, at - 1 end
    local box = {}
    for i = at + 1, #words, 3 do box[words[i]] = { words[i + 1], words[i + 2] } end
    local lines = {}
    for _, block in ipairs(built()) do
        local inside = true
        for axis, limits in pairs(box) do
            if not ({ x = 1, y = 1, z = 1 })[axis] or not limits[2] then fail(words.line, "a range is a region or limits of x, y and z") end
            local value = block.at[axis]
            if value < limits[1] - 1e-6 or value > limits[2] + 1e-6 then inside = false end
        end
        if inside then lines[#lines + 1] = (" range id %d"):format(block.id) end
    end
    if #lines == 0 then fail(words.line, "nothing is in the range") end
    return lines, at - 1
end

-- Vectors given by components.
local components = {
    xload = { "force", "x", "load" }, yload = { "force", "y", "load" }, zload = { "force", "z", "load" },
    xmoment = { "moment", "x", "moment", true }, ymoment = { "moment", "y", "moment", true }, zmoment = { "moment", "z", "moment", true },
    xvel = { "velocity", "x", "vel" }, yvel = { "velocity", "y", "vel" }, zvel = { "velocity", "z", "vel" },
    rxvel = { "spin", "x", "rvel", true }, ryvel = { "spin", "y", "rvel", true }, rzvel = { "spin", "z", "rvel", true },
}

local function vectors(words, twin, built)
    local lines, last = ranges(words, twin, built)
    local sums = {}
    for i = 2, last, 2 do
        local what = components[words[i]]
        if not what or type(words[i + 1]) ~= "number" then fail(words.line, "only components of vectors may stand here") end
        if words[1] == "apply" and what[1]:match "^[vs]" then fail(words.line, "a velocity that is held has no turned twin") end
        local sum = sums[what[3]] or { what = what, x = 0, y = 0, z = 0 }
        sum[what[2]] = words[i + 1]
        sums[what[3]] = sum
    end
    local text = words[1]
    for name, sum in pairs(sums) do
        local v = twin.place:direction(vector(sum.x, sum.y, sum.z)) * simple_deck.factor(twin, sum.what[1])
        if sum.what[4] then v = v * twin.place.hand end
        local turning = name == "rvel" and "r%svel" or "%s" .. name
        for _, axis in ipairs { "x", "y", "z" } do text = text .. (" %s %.17g"):format(turning:format(axis), v[axis]) end
    end
    for i, range in ipairs(lines) do lines[i] = text .. range end
    return lines
end

local function held(words, twin, built)
    local lines, last = ranges(words, twin, built)
    if last == #words then fail(words.line, "which blocks? the order of blocks changes: give a range") end
    if last > 2 or (last == 2 and words[2] ~= "rotation") then fail(words.line, "components have no turned twin") end
    for i, range in ipairs(lines) do lines[i] = text_of { table.unpack(words, 1, last) } .. range end
    return lines
end

local function gravity(words, twin)
    local v = twin.place:direction(vector(words[2], words[3], words[4])) * simple_deck.factor(twin, "acceleration")
    return { ("gravity %.17g %.17g %.17g"):format(v.x, v.y, v.z) }
end

local function joint_set(words, twin)
    local dip, dd, origin, rest = 0, 0, vector(0, 0, 0), ""
    local i = 2
    while i <= #words do
        if words[i] == "dip" then dip = words[i + 1]
        elseif words[i] == "dd" then dd = words[i + 1]
        elseif words[i] == "id" then rest = rest .. (" id %d"):format(words[i + 1])
        elseif words[i] == "origin" or words[i] == "org" then
            origin = vector(words[i + 1], words[i + 2], words[i + 3])
            i = i + 2
        else
            fail(words.line, "a joint set is one joint: dip, dd, origin and id")
        end
        i = i + 2
    end
    local a, b = math.rad(dip), math.rad(dd)
    local n = twin.place:direction(vector(math.sin(a) * math.sin(b), math.sin(a) * math.cos(b), math.cos(a)))
    if n.z < 0 then n = n * -1 end
    local p = twin.place:point(origin)
    local across = math.sqrt(n.x ^ 2 + n.y ^ 2)
    return { ("jset dip %.17g dd %.17g origin %.17g %.17g %.17g%s"):format(math.deg(math.atan(across, n.z)),
        math.deg(math.atan(n.x, n.y)) % 360, p.x, p.y, p.z, rest) }
end

-- A block as corners and faces, and the keywords of its numbers.
local function polyhedron(words)
    local options, kind, loops = "", nil, {}
    local i = 2
    while i <= #words do
        local word = words[i]
        if word == "region" or word == "mat" or word == "material" or word == "cons" then
            options = options .. (" %s %d"):format(word, words[i + 1])
            i = i + 1
        elseif word == "brick" or word == "prism" then kind = word
        elseif word == "face" then
            kind = "face"
            loops[#loops + 1] = {}
        elseif word == "a" or word == "b" then loops[#loops + 1] = {}
        elseif type(word) == "number" then
            if #loops == 0 then loops[1] = {} end
            table.insert(loops[#loops], word)
        else
            fail(words.line, "only brick, prism and face have twins")
        end
        i = i + 1
    end
    if kind == "brick" then
        local n = loops[1]
        local z0, z1 = n[5], n[6]
        loops = { { n[1], n[3], z0, n[2], n[3], z0, n[2], n[4], z0, n[1], n[4], z0 }, { n[1], n[3], z1, n[2], n[3], z1, n[2], n[4], z1, n[1],
            n[4], z1 } }
    end
    for k, loop in ipairs(loops) do
        local points = {}
        for j = 1, #loop, 3 do points[#points + 1] = vector(loop[j], loop[j + 1], loop[j + 2]) end
        loops[k] = points
    end
    return kind == "face" and "face" or "prism", loops, options
end

local function loops_of_prism(loops)
    local a, b, faces = loops[1], loops[2], { loops[1], loops[2] }
    for i = 1, #a do
        local k = i % #a + 1
        faces[#faces + 1] = { a[i], a[k], b[k], b[i] }
    end
    return faces
end

local function block(words, twin)
    if twin.plain then return { words.line } end
    local kind, loops, options = polyhedron(words)
    if twin.other_corners then
        if kind == "prism" then loops = loops_of_prism(loops) end
        kind = "face"
        local turned = {}
        for f = #loops, 1, -1 do
            local loop = {}
            for i = 1, #loops[f] do loop[i] = loops[f][(i + f) % #loops[f] + 1] end
            turned[#turned + 1] = loop
        end
        loops = turned
    end
    -- Faces are clockwise seen from outside.
    local middle, n = vector(0, 0, 0), 0
    for _, loop in ipairs(loops) do for _, p in ipairs(loop) do middle, n = middle + p, n + 1 end end
    middle = middle / n
    local text = "poly" .. options
    if kind == "prism" then text = text .. " prism" end
    for f, loop in ipairs(loops) do
        text = text .. (kind == "face" and " face" or f == 1 and " a" or " b")
        local normal = vector(0, 0, 0)
        for i = 2, #loop - 1 do normal = normal + (loop[i] - loop[1]):cross(loop[i + 1] - loop[1]) end
        local backward = (normal:dot(loop[1] - middle) > 0) == (twin.place.hand > 0)
        for i = 1, #loop do
            local p = twin.place:point(loop[kind == "face" and backward and #loop + 1 - i or i])
            text = text .. (" %.17g %.17g %.17g"):format(p.x, p.y, p.z)
        end
    end
    return { text }
end

local writers = {
    poly = block, jset = joint_set, gravity = gravity, grav = gravity, fix = held, free = held, apply = vectors,
    initialize = vectors, ini = vectors, damp = damping, prop = scaled, property = scaled, jmodel = scaled, facetri = scaled,
    fraction = scaled, solve = scaled, cycle = scaled,
}

-- Calls `run` with each line of the twin. `before_cycles` is called before the first line that moves the model; `built()` returns the
-- present blocks, with id and centroid in the coordinates of the deck.
function simple_deck.play(statements, twin, run, built, before_cycles)
    local order = {}
    for i = 1, #statements do order[i] = i end
    if twin.permuted then
        local random, i = require("parts.random")(5), 1
        while i <= #order do
            local last = i
            while statements[i][1] == "poly" and statements[last + 1] and statements[last + 1][1] == "poly" do last = last + 1 end
            for k = last, i + 1, -1 do
                local other = i + math.floor((k - i + 1) * random())
                order[k], order[other] = order[other], order[k]
            end
            i = last + 1
        end
    end
    local moved = false
    for _, i in ipairs(order) do
        local words = statements[i]
        local write = writers[words[1]]
        if not write then fail(words.line, "a line without a twin") end
        if not moved and (words[1] == "cycle" or words[1] == "solve") then
            moved = true
            before_cycles()
        end
        for _, line in ipairs(write(words, twin, built)) do run(line) end
    end
    if not moved then error("the deck never cycles", 0) end
end

return simple_deck
