-- A strip footing on weightless ground: half of it, one cell wide. `footing(name, cells, friction, dilation, mesh, steps, low, high)` loads
-- it and compares N_c (with `surcharge`, a pressure beside the footing on ground without cohesion, N_q), which must be at most `low` below Davis's estimate, itself below the exact value for associated flow, and at most
-- `high` above the exact value, and must be constant. With `far` the far side is inclined ("cells"), or
-- has two parts, so that the ground is filled with unstructured tetrahedra ("tetrahedra"); it is loaded faster then.
local verify = require "verify"
local half, width, height, cohesion = 3, 15, 7.5, 1e5
return function(name, n, phi, psi, mesh, steps, low, high, far, surcharge)
    if count("block") > 0 then command "delete\nreset time" end
    local size = half / n
    if far then
        local function at(y)
            local points = { 0, y, 0, width + 1, y, 0, width, y, height, 0, y, height }
            if far == "tetrahedra" then table.move({ width + 1, y, 3, table.unpack(points, 7) }, 1, 9, 7, points) end
            return ("%.17g "):rep(#points):format(table.unpack(points))
        end
        command("poly prism a " .. at(0) .. " b " .. at(size))
        command(mesh:format(size))
    else
        command(("poly brick 0 %g 0 %g 0 %g"):format(width, size, height))
        command(mesh:format(math.floor(width / size + 0.5), math.floor(height / size + 0.5)))
    end
    command "set small on\nchange cons 2\ndamp local"
    local unit, symbol = surcharge or cohesion, surcharge and "N_q" or "N_c"
    command(("prop mat 1 dens 2000 k 2e8 g 1e8 bcoh %g bfric %g bdil %g bten 1e10"):format(surcharge and 0 or cohesion, phi, psi))
    if surcharge then
        command(("insitu stress %g %g %g 0 0 0 nodis"):format(-surcharge, -surcharge, -surcharge))
        command(("bound stress 0 0 %g 0 0 0 range z %g x %g %g"):format(-surcharge, height, half - 0.01 * size, width + 2))
    end
    command(("bound xvel 0 range x 0\nbound xvel 0 range x %g %g\nbound yvel 0\nbound zvel 0 xvel 0 range z 0"):format(width - 1e-6, width + 2))
    local top = ("range z %g x 0 %g"):format(height, half + 0.01 * size)
    command("bound xvel 0 zvel 0 " .. top)
    local pressed, last, next = {}, 0, width
    for g in gridpoints() do
        local p = g.position
        if math.abs(p.z - height) < 1e-6 * size then
            if p.x < half + 0.01 * size then
                pressed[#pressed + 1] = g
                last = math.max(last, p.x)
            else
                next = math.min(next, p.x)
            end
        end
    end
    local function pressure()
        local force = 0
        for _, g in ipairs(pressed) do force = force - g.z_reaction end
        local beside = (surcharge or 0) * size * 0.5 * (next - last) -- what the surcharge puts on the last gridpoint
        return (force + beside) / (size * 0.5 * (last + next)) / unit
    end
    local speed = (far and 8 or 1) * 1e-2 * size
    command(("bound zvel %g %s"):format(-speed, top))
    command(("cycle %d"):format(steps))
    command(("bound zvel %g %s"):format(-speed / 5, top)) -- at a low speed inertia is negligible
    command(("cycle %d"):format(steps / 4))
    local before = pressure()
    command(("cycle %d"):format(steps / 4))
    local after = pressure()
    local function prandtl(t) -- of the tangent of friction
        local with_surcharge = math.exp(math.pi * t) * math.tan(math.pi / 4 + math.atan(t) / 2) ^ 2
        if surcharge then return with_surcharge end
        if t == 0 then return 2 + math.pi end
        return (with_surcharge - 1) / t
    end
    -- Davis (1968): ground with another dilation carries at least as much as with the strength along its velocity characteristics.
    local f, d = math.rad(phi), math.rad(psi)
    local part = math.cos(d) / (1 - math.sin(d) * math.sin(f))
    local exact, davis = prandtl(math.tan(f)), (surcharge and 1 or part * math.cos(f)) * prandtl(part * math.sin(f))
    verify.relative("D6, " .. name, symbol .. ", against that of associated flow", after, exact, math.max(high, 1 - (1 - low) * davis / exact))
    verify.absolute("D6, " .. name, symbol .. " short of Davis's estimate, parts", math.min(0, after / davis - 1), 0, low)
    verify.absolute("D6, " .. name, "growth of " .. symbol .. " in the last quarter, parts", after / before - 1, 0, 0.01)
end
