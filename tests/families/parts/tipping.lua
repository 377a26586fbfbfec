-- A block b x h on a slope of angle a that tips about its lower edge, by the equations of a rigid body that rotates about a fixed line.
-- Axes: x down the slope, z its normal; t the angle of rotation, R from the edge to the centroid:
--     I t'' = m g (h/2 sin(a + t) - b/2 cos(a + t)) ,   I = m (b^2 + h^2)/3
--     N = m (g cos a + z''_c) ,   S = m (g sin a - x''_c)
local tipping = {}

-- State at the angle t with the spin w: angular acceleration, forces on the edge.
function tipping.at(p, t, w)
    local g, m, b, h, a = 9.81, p.mass, p.b, p.h, p.slope
    local growth = 3 * g * (h * math.sin(a + t) - b * math.cos(a + t)) / (2 * (b * b + h * h))
    local x = -b / 2 * math.cos(t) + h / 2 * math.sin(t)
    local z = h / 2 * math.cos(t) + b / 2 * math.sin(t)
    return growth, m * (g * math.cos(a) - growth * x - w * w * z), m * (g * math.sin(a) - growth * z + w * w * x)
end

-- Spin at the angle t after a release from rest at the angle `from`: by energy.
function tipping.spin(p, t, from)
    local function height(angle) return p.h / 2 * math.cos(p.slope + angle) + p.b / 2 * math.sin(p.slope + angle) end
    return math.sqrt(2 * p.mass * 9.81 * (height(from or 0) - height(t)) / (p.mass * (p.b ^ 2 + p.h ^ 2) / 3))
end

-- Angle and spin at a time after a release from rest, by Runge and Kutta's fourth order.
function tipping.after(p, time, from)
    local n, t, w = 2000, from or 0, 0.0
    local dt = time / n
    local function growth(angle) return (tipping.at(p, angle, 0)) end
    for _ = 1, n do
        local k1, k2 = growth(t), growth(t + 0.5 * dt * w)
        local k3 = growth(t + 0.5 * dt * w + 0.25 * dt * dt * k1)
        local k4 = growth(t + dt * w + 0.5 * dt * dt * k2)
        t, w = t + dt * w + dt * dt / 6 * (k1 + k2 + k3), w + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    end
    return t, w
end

function tipping.time_to(p, angle, from)
    local low, high = 0.0, 1.0
    while tipping.after(p, high, from) < angle do high = 2 * high end
    for _ = 1, 50 do
        local middle = 0.5 * (low + high)
        if tipping.after(p, middle, from) < angle then low = middle else high = middle end
    end
    return high
end

-- Largest friction that the edge needs up to an angle.
function tipping.needed(p, angle, from)
    local most = 0
    for i = 0, 200 do
        local t = (from or 0) + (angle - (from or 0)) * i / 200
        local _, n, s = tipping.at(p, t, tipping.spin(p, t, from))
        most = math.max(most, s / n)
    end
    return most
end

-- The block on its base, 1 m wide, rotated by the angle `from` about the lower edge at (b, 0); gravity is inclined instead of the base.
-- Returns the block, a gridpoint of the edge, and a function for the angle.
function tipping.build(p, kn, friction, from)
    local scene, shapes, place = require "parts.scene", require "parts.shapes", require "parts.place"
    local b, h = p.b, p.h
    scene.clear "none"
    p.mass = scene.density * b * h
    scene.hold(scene.brick(-b, 4 * b, 0, 1, -b, 0))
    local turn = place.new(place.about(vector(0, 1, 0), math.deg(from or 0)), vector(b, 0, 0))
    local body = shapes.build(shapes.moved(shapes.prism({ { -b, 0 }, { 0, 0 }, { 0, h }, { -b, h } }, 0, 1), turn))
    scene.joints(kn, kn, math.deg(math.atan(friction)))
    model.gravity = vector(9.81 * math.sin(p.slope), 0, -9.81 * math.cos(p.slope))
    local heel, toe = body.corners[1], body.corners[2]
    return body.block, toe, function() return math.atan(heel.z - toe.z, toe.x - heel.x) end
end

-- The minimum area of a contact: 1/100 of the mean face of the block, which is the smaller one.
function tipping.least_area(p) return 0.01 * (2 * p.b * p.h + 2 * p.h + 2 * p.b) / 6 end

-- Initial forces on the sub-contacts at the two corners of the edge.
function tipping.set_forces(p)
    local _, n, s = tipping.at(p, 0, 0)
    local points = {}
    for point in sub_contacts() do
        if point.x > p.b * (1 - 1e-6) and (point.y < 1e-6 or point.y > 1 - 1e-6) then points[#points + 1] = point end
    end
    if #points ~= 2 then error(("%d sub-contacts stand at the corners of the edge instead of 2"):format(#points)) end
    for _, point in ipairs(points) do point.normal_force, point.x_shear_force = n / 2, s / 2 end
end

-- Places the block on its edge, guided, with the force N at its release, for any depth of the edge; then releases it with the shear force S
-- on the closed sub-contacts.
function tipping.set_down(p, block, from)
    local _, n, s = tipping.at(p, from, 0)
    local slope = model.gravity
    model.gravity = vector(0, 0, -n / p.mass)
    command(("fix xvel yvel rotation range id %d\ndamp local 0.8\nsolve ratio 1e-12 cycles 200000"):format(block.id))
    if math.abs(sum("sub_contact", "normal_force") / n - 1) > 1e-3 then error(("the edge carries %g of its force"):format(sum("sub_contact", "normal_force") / n), 0) end
    command(("free range id %d\ndamp none\nreset vel disp time"):format(block.id))
    model.gravity = slope
    local total = sum("sub_contact", "normal_force")
    for point in sub_contacts() do point.x_shear_force = s * point.normal_force / total end
end

return tipping
