-- Outlines of blocks as seen along a direction, for section pictures.
--
--     local section = require "section"
--     local before = section.outlines(vector(1, 0, 0), vector(0, 0, 1))     -- seen along y: x to the right, z up
--     ...
--     f:outlines("before", before, "grey")
--     f:outlines("after", section.outlines(vector(1, 0, 0), vector(0, 0, 1)), "black")
local section = {}

-- Convex hull, anticlockwise (Andrew 1979: monotone chain).
local function hull(points)
    table.sort(points, function(a, b) return a[1] < b[1] or (a[1] == b[1] and a[2] < b[2]) end)
    local chain = {}
    local function extend(first, last, step)
        local base = #chain
        for i = first, last, step do
            local p = points[i]
            while #chain >= base + 2 do
                local a, b = chain[#chain - 1], chain[#chain]
                if (b[1] - a[1]) * (p[2] - a[2]) - (b[2] - a[2]) * (p[1] - a[1]) > 0 then break end
                chain[#chain] = nil
            end
            chain[#chain + 1] = p
        end
        chain[#chain] = nil
    end
    extend(1, #points, 1)
    extend(#points, 1, -1)
    return chain
end

-- The outline of each block on a plane whose axes are the unit vectors `across` and `up`: a list of polygons, each a list of {x, y}. A
-- block is convex, so its outline is the hull of its corners. `wanted(block)` selects blocks; without it all are drawn.
function section.outlines(across, up, wanted)
    local polygons = {}
    for block in blocks() do
        if not wanted or wanted(block) then
            local points = {}
            for corner in block:gridpoints() do
                points[#points + 1] = { corner.position:dot(across), corner.position:dot(up) }
            end
            polygons[#polygons + 1] = hull(points)
        end
    end
    return polygons
end

return section
