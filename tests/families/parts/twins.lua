-- Runs a simple deck and its eight twins, and compares displacements and forces in the coordinates and units of the deck.
local place, rows, simple_deck = require "parts.place", require "parts.rows", require "parts.simple_deck"
local twins = {}

local function list()
    local mirror = { { -1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }
    return {
        { name = "again", plain = true },
        { name = "mirrored", place = place.new(mirror) },
        { name = "turned", place = place.new(place.about(vector(0.3, -0.5, 0.81), 37)) },
        { name = "1e3 m away", place = place.new(nil, vector(1e3, -1e3, 1e3)) },
        { name = "1e6 m away", place = place.new(nil, vector(-1e6, 1e6, 1e6)) },
        { name = "other order", permuted = true },
        { name = "in mm", length = 1e3 },
        { name = "in MPa", stress = 1e-6 },
        { name = "other first corners", other_corners = true },
    }
end

local function complete(twin)
    twin.place = twin.place or place.new(nil, nil, twin.length)
    return twin
end

-- Runs a twin. Result: blocks with initial centroid and corners, displacements of corners, forces of pairs of blocks, in the coordinates
-- and units of the deck.
local function run(statements, twin)
    require("parts.scene").forget()
    if count("block") > 0 then command "delete" end
    command "reset time energy disp jdisp damp\ndamp contact 0\ndamp local 0.8\ngravity 0 0 0\nfraction 0.25"
    if fraction then command(("fraction %.17g"):format(fraction)) end
    -- Aligns the cycle count, so that tasks of every eighth or hundredth cycle run in the same cycles of each run.
    command(("poly brick 0 1 0 1 0 1\nprop mat 1 density 1\nfix\ncycle %d\ndelete\nreset time energy disp jdisp damp"):format(
        14400 - model.cycle % 14400))
    local result, number = { blocks = {} }, {}
    local where = twin.place
    local function built()
        local found = {}
        for b in blocks() do found[#found + 1] = { id = b.id, at = where:point_back(b.position) } end
        return found
    end
    simple_deck.play(statements, twin, command, built, function()
        for b in blocks() do
            local corners = {}
            for g in b:gridpoints() do corners[#corners + 1] = { at = where:point_back(g.position), gridpoint = g } end
            result.blocks[#result.blocks + 1] = { at = where:point_back(b.position), corners = corners, id = b.id, fixed = b.fixed == 1 }
            number[b.id] = #result.blocks
        end
    end)
    local length, force = simple_deck.factor(twin, "length"), simple_deck.factor(twin, "force")
    for _, b in ipairs(result.blocks) do
        for _, c in ipairs(b.corners) do
            c.way = where:direction_back(c.gridpoint.displacement) / length
            c.gridpoint = nil
        end
    end
    result.forces, result.area, result.time = {}, 0, model.time
    for c in contacts() do
        local f = where:direction_back(c.normal * c.normal_force + c.shear_force) / force
        -- On the second block.
        result.forces[#result.forces + 1] = { number[c.block1.id], number[c.block2.id], f }
        result.area = math.max(result.area, c.area / length ^ 2)
    end
    result.stiffness = maximum("sub_contact", "normal_stiffness") / simple_deck.factor(twin, "stiffness")
    return result
end

local function nearest_of(items, at)
    local best, least = nil, math.huge
    for i, item in ipairs(items) do
        local way = (item.at - at):length()
        if way < least then best, least = i, way end
    end
    return best, least
end

-- Largest difference of displacements and of forces, and the largest of each in the deck.
local function differences(own, other)
    local same, way, most_way = {}, 0, 0
    if #own.blocks ~= #other.blocks then error(("%d blocks instead of %d"):format(#other.blocks, #own.blocks), 0) end
    for i, b in ipairs(own.blocks) do
        local k, off = nearest_of(other.blocks, b.at)
        if off > 1e-6 or same[k] then error("blocks of the twin stand elsewhere", 0) end
        same[k] = i
        for _, c in ipairs(b.corners) do
            local twin_corner = other.blocks[k].corners[nearest_of(other.blocks[k].corners, c.at)]
            way = math.max(way, (c.way - twin_corner.way):length())
            most_way = math.max(most_way, c.way:length())
        end
    end
    local forces, force, most_force = {}, 0, 0
    local function add(one, two, f, sign)
        if one > two then one, two, f = two, one, f * -1 end
        local key = one * 100000 + two
        forces[key] = (forces[key] or vector(0, 0, 0)) + f * sign
    end
    for _, f in ipairs(own.forces) do
        add(f[1], f[2], f[3], 1)
        most_force = math.max(most_force, f[3]:length())
    end
    for _, f in ipairs(other.forces) do add(same[f[1]], same[f[2]], f[3], -1) end
    for _, f in pairs(forces) do force = math.max(force, f:length()) end
    return way, most_way, force, most_force
end

-- `tolerance` is relative to the largest displacement and force. A position x has the precision 2^-52 x, and so have closures, with errors
-- that a lever amplifies: 16 of them are allowed in addition. `check`, if given, receives the results of the deck and of each twin.
function twins.compare(name, text, tolerance, check)
    local statements = simple_deck.read(text)
    local own = run(statements, complete { name = "itself", plain = true })
    if check then check(name .. ", itself", own) end
    for _, twin in ipairs(list()) do
        rows.case(name .. ", " .. twin.name, function()
            local other = run(statements, complete(twin))
            local way, most_way, force, most_force = differences(own, other)
            local rounding = 16 * 2.0 ^ -52 * twin.place.shift:length()
            local case = name .. ", " .. twin.name
            if twin.name == "again" then
                rows.at_most(case, "largest difference of displacements, m", way, 0)
                return
            end
            rows.at_most(case, ("largest difference of displacements over the largest, %.4g m"):format(most_way), way / most_way,
                tolerance + rounding / most_way)
            rows.at_most(case, ("largest difference of forces over the largest, %.4g N"):format(most_force), force / most_force,
                tolerance + rounding * own.stiffness * own.area / most_force)
            if check then check(case, other) end
        end)
    end
end

return twins
