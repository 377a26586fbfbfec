-- The support of a rigid wedge that slides above two planes through the origin of a cube of 10 m: it depends on moments, which the closed
-- form omits.
local wedge = require "parts.wedge"
local seat = {}

local half, step = 5, 0.5 -- of the cube, and of the squares and cubes for numerical integration

local function above(place, normals)
    for _, n in ipairs(normals) do if n:dot(place) < 0 then return false end end
    return math.max(math.abs(place.x), math.abs(place.y), math.abs(place.z)) <= half
end

local function centroid(na, nb)
    local sum, count = vector(0, 0, 0), 0
    for x = step / 2 - half, half, step do for y = step / 2 - half, half, step do for z = step / 2 - half, half, step do
        local place = vector(x, y, z)
        if above(place, { na, nb }) then sum, count = sum + place, count + 1 end
    end end end
    return sum / count
end

local function six(force, place)
    local moment = place:cross(force) / half
    return { force.x, force.y, force.z, moment.x, moment.y, moment.z }
end

-- Points of both joints: the normal displacement by a unit of the wedge's motion, and the force of a unit of pressure with its friction.
local function places(na, nb, line, tangent)
    local centre, found = centroid(na, nb), {}
    for _, pair in ipairs { { na, nb }, { nb, na } } do
        local n, other = pair[1], pair[2]
        local along = math.abs(n.z) < 0.9 and n:cross(vector(0, 0, 1)):unit() or n:cross(vector(1, 0, 0)):unit()
        local across = n:cross(along)
        for i = -20, 20 do for j = -20, 20 do
            local place = along * ((i + 0.5) * step) + across * ((j + 0.5) * step)
            if above(place, { other }) then found[#found + 1] = { six(n, place - centre), six(n - line * tangent, place - centre) } end
        end end
    end
    return found
end

-- Gauss elimination with pivots; nil without a unique solution. The right side is the last column.
local function solve(rows)
    local n = #rows
    for c = 1, n do
        local pivot = c
        for r = c + 1, n do if math.abs(rows[r][c]) > math.abs(rows[pivot][c]) then pivot = r end end
        rows[c], rows[pivot] = rows[pivot], rows[c]
        if math.abs(rows[c][c]) < 1e-9 then return nil end
        for r = 1, n do
            local factor = r ~= c and rows[r][c] / rows[c][c] or 0
            if factor ~= 0 then for k = c, n + 1 do rows[r][k] = rows[r][k] - factor * rows[c][k] end end
        end
    end
    local x = {}
    for r = 1, n do x[r] = rows[r][n + 1] / rows[r][r] end
    return x
end

-- The fraction of the joints' area that is closed while the wedge slides along its line at the limit, with the normal pressure of
-- no-tension springs; nil if no such state is found. Its weight is 1; x is its small motion and the residual force along the line.
function seat.closed_part(a, b)
    local exact = wedge.closed_form(a, b)
    local na, nb, line, tangent = wedge.normal(a), wedge.normal(b), exact.line, math.tan(math.rad(exact.friction))
    local all, along = places(na, nb, line, tangent), { line.x, line.y, line.z, 0, 0, 0 }
    local closed, count = {}, #all
    for i = 1, #all do closed[i] = true end
    for _ = 1, 60 do
        local rows = {}
        for r = 1, 6 do
            rows[r] = { 0, 0, 0, 0, 0, 0, along[r], r == 3 and -1 or 0 }
        end
        rows[7] = { line.x, line.y, line.z, 0, 0, 0, 0, 0 }
        for i, place in ipairs(all) do
            if closed[i] then
                for r = 1, 6 do for k = 1, 6 do rows[r][k] = rows[r][k] + place[2][r] * place[1][k] end end
            end
        end
        local x = solve(rows)
        if not x then return nil end
        local same, now = true, 0
        for i, place in ipairs(all) do
            local displacement = 0
            for k = 1, 6 do displacement = displacement + place[1][k] * x[k] end
            local presses = displacement < 0
            same = same and presses == closed[i]
            closed[i] = presses
            now = now + (presses and 1 or 0)
        end
        if same then return now / count end
    end
end

return seat
