-- A semicircular arch of n voussoirs of stone, 1 m wide, mid radius 10 m, with radial joints, between two fixed
-- springers.
local arch = {}
arch.radius = 10

-- Thickness over mid radius. Returns the moving blocks in order from the right springer and the two springers.
function arch.build(n, ratio, stiffness, friction)
    local inner, outer = arch.radius * (1 - ratio / 2), arch.radius * (1 + ratio / 2)
    command "delete\nreset time"
    local function place(radius, angle, y) return (" %.17g %d %.17g"):format(radius * math.cos(angle), y, radius * math.sin(angle)) end
    local function voussoir(from, to)
        local line = "poly prism"
        for side, y in pairs { a = 0, b = 1 } do
            line = line .. " " .. side .. place(inner, from, y) .. place(outer, from, y) .. place(outer, to, y) .. place(inner, to, y)
        end
        command(line)
    end
    command(("poly brick %.17g %.17g 0 1 -1 0"):format(inner, outer))
    command(("poly brick %.17g %.17g 0 1 -1 0"):format(-outer, -inner))
    command "fix"
    for i = 1, n do voussoir(math.pi * (i - 1) / n, math.pi * i / n) end
    local voussoirs, springers = {}, {}
    for block in blocks() do
        local list = block.fixed == 1 and springers or voussoirs
        list[#list + 1] = block
    end
    command(("jmodel model mohr\njmodel jkn %g jks %g jfric %g"):format(stiffness, stiffness, friction))
    return voussoirs, springers
end

-- Gravity is applied within a second, with local damping.
function arch.load()
    command "damp local\ngravity 0 0 0"
    local start = model.time
    local hooked = hook.before_cycle(function()
        model.gravity = vector(0, 0, -9.81 * math.min(1, model.time - start))
    end, 10)
    command "cycle time 1.05"
    hook.remove(hooked)
end

return arch
