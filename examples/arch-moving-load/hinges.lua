-- The heaviest wheel on an arch of rigid stones that do not slide: the arch falls when four hinges, in turn at outer and inner edges of joints, make it
-- a mechanism, and until then a line of thrust fits into the ring (Heyman 1982, The Masonry Arch).
local hinges = {}

-- Solves a x = b with as many equations as unknowns, by elimination; nothing if they depend on each other.
local function solve(a, b)
    local n = #b
    for k = 1, n do
        local pivot = k
        for i = k + 1, n do if math.abs(a[i][k]) > math.abs(a[pivot][k]) then pivot = i end end
        if math.abs(a[pivot][k]) < 1e-9 then return nil end
        a[k], a[pivot], b[k], b[pivot] = a[pivot], a[k], b[pivot], b[k]
        for i = k + 1, n do
            local part = a[i][k] / a[k][k]
            for j = k, n do a[i][j] = a[i][j] - part * a[k][j] end
            b[i] = b[i] - part * b[k]
        end
    end
    for i = n, 1, -1 do
        for j = i + 1, n do b[i] = b[i] - a[i][j] * b[j] end
        b[i] = b[i] / a[i][i]
    end
    return b
end

-- `edges[i]` holds the inner and the outer edge of joint i as {x, z}; stone i, between the joints i and i + 1, has stones[i].weight at stones[i].x.
-- The wheel stands on stone `loaded` at `x_wheel`.
function hinges.capacity(edges, stones, loaded, x_wheel)
    local weight, moment = { 0 }, { 0 } -- of the stones before joint i, and about the origin
    for i, stone in ipairs(stones) do
        weight[i + 1], moment[i + 1] = weight[i] + stone.weight, moment[i] + stone.weight * stone.x
    end
    -- The moment, about an edge of joint i, of all forces on the stones before it: factors of the unknowns, which are force x, force z and moment
    -- at the first joint and the wheel; and the rest.
    local function moments(i, edge)
        local x, z = edge[1], edge[2]
        return { z, -x, 1, i > loaded and x - x_wheel or 0 }, weight[i] * x - moment[i]
    end
    local function about(i, edge, unknown)
        local factors, sum = moments(i, edge)
        for k, factor in ipairs(factors) do sum = sum + factor * unknown[k] end
        return sum
    end
    -- In each joint the thrust passes between the edges.
    local function fits(unknown)
        local rounding = 1e-6 * weight[#weight]
        for i, edge in ipairs(edges) do
            if about(i, edge[1], unknown) < -rounding or about(i, edge[2], unknown) > rounding then return false end
        end
        return true
    end
    local most = 0
    local function try(joints, first)
        local factors, rest = {}, {}
        for k, joint in ipairs(joints) do
            local constant
            factors[k], constant = moments(joint, edges[joint][(first + k) % 2 + 1])
            rest[k] = -constant
        end
        local unknown = solve(factors, rest)
        if unknown and unknown[4] > most and fits(unknown) then most = unknown[4] end
    end
    local last = #edges
    for a = 1, last - 3 do for b = a + 1, last - 2 do for c = b + 1, last - 1 do for d = c + 1, last do
        try({ a, b, c, d }, 0)
        try({ a, b, c, d }, 1)
    end end end end
    return most
end

return hinges
