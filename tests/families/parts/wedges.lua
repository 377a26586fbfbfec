-- An edge on a face or on a parallel edge, on Winkler's foundation: the work to sink by d over a length l is k_n l u d^3, where u is the
-- integral of the depth over the common section of both bodies for d = 1. The force is its derivative.
-- The depth is that below the nearest face of the larger body if it is more than twice as large, otherwise the mean of both
-- (docs/theory/contacts.md, equation 8). The integral is taken over a grid of the section.
local shapes = require "parts.shapes"
local wedges = {}

-- The outward normals of the faces of a shape in which the line through `at` along `axis` lies, and the part of the line inside the others.
local function along_line(s, at, axis)
    local normals, low, high = {}, -math.huge, math.huge
    for i, n in ipairs(shapes.normals(s.points, s.faces)) do
        local room, slope = n:dot(s.points[s.faces[i][1]] - at), n:dot(axis)
        if math.abs(room) < 1e-9 and math.abs(slope) < 1e-9 then normals[#normals + 1] = n
        elseif slope > 1e-9 then high = math.min(high, room / slope)
        elseif slope < -1e-9 then low = math.max(low, room / slope) end
    end
    return normals, low, high
end

local function depth_below(normals, x)
    local least = math.huge
    for _, n in ipairs(normals) do least = math.min(least, -n:dot(x)) end
    return least
end

-- Half the width of a wedge at the distance 1 from its edge; none of a face.
local function half_width(normals, across)
    local width = 0
    for _, n in ipairs(normals) do width = math.max(width, math.abs(n.z / n:dot(across))) end
    return width
end

-- The factor k_n l u for a horizontal edge of the upper body; the line of contact passes through the origin in the lower body as built,
-- and through `above` in the upper one.
function wedges.stiffness(kn, lower, upper, axis, above)
    local of_lower, low1, high1 = along_line(lower.shape, vector(0, 0, 0), axis)
    local of_upper, low2, high2 = along_line(upper.shape, above, axis)
    local sizes = lower.block.volume / upper.block.volume
    local part = sizes > 2 and 1 or sizes < 0.5 and 0 or 0.5 -- of the lower body
    local across = axis:cross(vector(0, 0, 1))
    local reach = math.min(half_width(of_lower, across), half_width(of_upper, across))
    local n, u = 200, 0.0
    local cell = 2 * reach / n / n
    for i = 1, n do
        for k = 1, n do
            local x = across * (reach * (2 * (i - 0.5) / n - 1)) - vector(0, 0, (k - 0.5) / n)
            local one, two = depth_below(of_lower, x), depth_below(of_upper, x + vector(0, 0, 1))
            if one > 0 and two > 0 then u = u + cell * (part * one + (1 - part) * two) end
        end
    end
    return kn * (math.min(high1, high2) - math.max(low1, low2)) * u
end

-- Depth under a weight at rest.
function wedges.rest(c, W) return math.sqrt(W / (3 * c)) end

-- Greatest depth of a weight that has fallen by `fall`: c d^3 = W (d + fall), by Newton's method from above.
function wedges.deepest(c, W, fall)
    local d = math.sqrt(W / c) + (W * fall / c) ^ (1 / 3)
    for _ = 1, 30 do d = d - (c * d ^ 3 - W * (d + fall)) / (3 * c * d * d - W) end
    return d
end

return wedges
