-- Toppling columns on a stepped base: limit equilibrium from block to block (Goodman and Bray 1976, ASCE Specialty Conference on Rock
-- Engineering, Boulder).
local goodman_bray = {}

-- Columns of a `width` on steps, across a base that dips by `dip` degrees: the height of `below` columns increases by `rise` each, that of
-- `above` more decreases by `fall` each.
function goodman_bray.slope(of)
    local slope = { width = of.width, dip = of.dip, step = of.step, heights = {} }
    for n = 1, of.below + of.above do slope.heights[n] = of.rise * math.min(n, of.below) - of.fall * math.max(0, n - of.below) end
    return slope
end

-- Force over the unit weight that must be applied below the first block, from the uppermost block down: the larger of the forces against
-- toppling and sliding.
local function needed(slope, tangent)
    local width, heights, alpha, push = slope.width, slope.heights, math.rad(slope.dip), 0.0
    local function top(n) return heights[n] and n * slope.step + heights[n] or math.huge end
    for n = #heights, 1, -1 do
        local y, base = heights[n], n * slope.step
        -- Heights of contact with the block above and the block below.
        local above, below = math.min(top(n), top(n + 1)) - base, math.min(top(n), top(n - 1)) - base
        local moment = push * (above - tangent * width) + y * width / 2 * (y * math.sin(alpha) - width * math.cos(alpha))
        local slide = push - y * width * (tangent * math.cos(alpha) - math.sin(alpha)) / (1 - tangent ^ 2)
        if n == 1 then return moment > 0 and math.huge or slide end
        push = math.max(below > 0 and moment / below or -math.huge, slide, 0)
    end
end

-- tan phi at which the lowest block needs no force.
function goodman_bray.limit(slope)
    local low, high = math.tan(math.rad(slope.dip)), 0.999
    while high - low > 1e-9 do
        local middle = 0.5 * (low + high)
        if needed(slope, middle) > 0 then low = middle else high = middle end
    end
    return low
end

-- Columns are vertical here, and gravity is inclined; they topple towards x, or away from it with the side -1. Returns the columns that are
-- not fixed.
function goodman_bray.build(slope, side)
    local width, deep = slope.width, 2 * slope.width
    command "delete\nreset time"
    local function brick(from, to, low, high)
        local a, b = -side * width * from, -side * width * to
        command(("poly brick %.17g %.17g 0 %.17g %.17g %.17g"):format(math.min(a, b), math.max(a, b), width, low, high))
    end
    brick(-6, 0, -deep, slope.step)
    for n = 1, #slope.heights do brick(n - 1, n, -deep, n * slope.step) end
    command "fix"
    for n, height in ipairs(slope.heights) do brick(n - 1, n, n * slope.step, n * slope.step + height) end
    local moving = {}
    for block in blocks() do if block.fixed == 0 then moving[#moving + 1] = block end end
    local alpha = math.rad(slope.dip)
    model.gravity = vector(side * 9.81 * math.sin(alpha), 0, -9.81 * math.cos(alpha))
    return moving
end

return goodman_bray
