-- A scene of rigid blocks: created, observed and deleted again, so that one deck runs many of them.
local scene = { density = 2000, gravity = 9.81 }

local watches = {}

-- Removes hooks of the previous scene. `damping` is the text after `damp`.
function scene.forget()
    for _, watch in ipairs(watches) do hook.remove(watch) end
    watches = {}
end

function scene.clear(damping)
    scene.forget()
    if count("block") > 0 then command "delete" end
    command "set small off\nwater off\nreset time energy disp jdisp\ndamp none\ndamp contact 0\ngravity 0 0 -9.81"
    command("damp " .. (damping or "none"))
    -- -D fraction=0.05 shows the influence of the step on an error.
    if fraction then command(("fraction %.17g"):format(fraction)) end
    command(("prop mat 1 density %.17g"):format(scene.density))
end

-- Joint models that keep a closure in their history, the friction twice at the end.
local with_closure = {
    "continuously-yielding jr=1e-3 fric=%g jif=%g", "nonlinear fric=%g fric=%g", "nonlinear exponent-normal=0.5 exponent-shear=0.5 kn-maximum=1e13 fric=%g fric=%g",
    "power constant-1=1e-9 exponent-1=3 fric=%g fric=%g", "barton-bandis jrco=8 jcso=100e6 sigmac=150e6 nj=0.8 lo=0.1 ln=0.2 mpa=1e6 resfriction=%g resfriction=%g",
    "continuously-yielding exponent-normal=0.5 exponent-shear=0.5 kn-maximum=1e13 jr=1e-3 fric=%g jif=%g",
}

-- To be called after the blocks are created. With the global value `closures` the joint model is one of those, by the stiffness.
function scene.joints(kn, ks, friction, law)
    scene.kn, scene.ks = kn, ks
    if closures then
        local text = with_closure[1 + math.floor(kn + ks) % #with_closure]:format(friction, friction)
        local name, values = text:match "^(%S+) (.*)$"
        command(("jmodel model %s\njmodel jkn %.17g jks %.17g %s"):format(name, kn, ks, values))
        return
    end
    command(("jmodel model %s\njmodel jkn %.17g jks %.17g"):format(law or "mohr", kn, ks))
    if law ~= "elastic" then command(("jmodel jfric %.17g"):format(friction)) end
end

function scene.watch(f, every) watches[#watches + 1] = hook.after_cycle(f, every or 1) end

function scene.newest()
    local newest
    for b in blocks() do
        if not newest or b.id > newest.id then newest = b end
    end
    return newest
end

function scene.brick(x0, x1, y0, y1, z0, z1)
    command(("poly brick %.17g %.17g %.17g %.17g %.17g %.17g"):format(x0, x1, y0, y1, z0, z1))
    return scene.newest()
end

function scene.hold(block) command(("fix range id %d"):format(block.id)) end

function scene.run(time) command(("cycle time %.17g"):format(time)) end

-- Twice the kinetic energy of rotation of a rigid block, from its fields.
local function spin_square(b)
    local w, i = b.rotational_velocity, b.inertia
    return i.x * w.x ^ 2 + i.y * w.y ^ 2 + i.z * w.z ^ 2 -
        2 * (b.xy_inertia * w.x * w.y + b.xz_inertia * w.x * w.z + b.yz_inertia * w.y * w.z)
end

function scene.kinetic(b)
    local v = b.velocity
    return 0.5 * scene.density * b.volume * v:dot(v) + 0.5 * spin_square(b)
end

-- Total contact force on a block.
function scene.contact_force(block)
    local force = vector(0, 0, 0)
    for c in contacts() do
        local sign = c.block2 == block and 1 or c.block1 == block and -1 or 0
        if sign ~= 0 then force = force + (c.normal * c.normal_force + c.shear_force) * sign end
    end
    return force
end

local function velocity(block, point) return block.velocity + block.rotational_velocity:cross(point - block.position) end

-- The step of the last motion; model.time_step may already have changed.
local clock = { cycle = -1 }
function scene.last_step()
    if model.cycle ~= clock.cycle then
        clock.step = clock.cycle == model.cycle - 1 and model.time - clock.time or model.time_step
        clock.cycle, clock.time = model.cycle, model.time
    end
    return clock.step
end

-- Work of the springs of all contacts on their blocks in a step.
local function contact_work()
    local power = 0.0
    for s in sub_contacts() do
        local normal_force, shear = s.normal_force, s.shear_force_vector
        if normal_force ~= 0 or shear:length() > 0 then
            local x = s.position
            power = power + (s.normal * normal_force + shear):dot(velocity(s.block2, x) - velocity(s.block1, x))
        end
    end
    return power * scene.last_step()
end

local function account()
    return {
        contacts = contact_work(), error = model.energy_error, kinetic = model.kinetic_energy, gravity = model.gravity_work, boundary = model.boundary_work,
        damped = model.damped_energy,
    }
end

-- The error of the account without the phase difference of its terms: kinetic energy is half a step before the work of contacts, and the
-- difference is half of the work of contacts in a step. That is the power of their springs or, with dashpots, the gain of kinetic energy in
-- the next step that gravity, loads and damping do not explain. An account taken at one instant does not need this correction.
local function least_error(now, after)
    local gained = after.kinetic - now.kinetic - (after.gravity - now.gravity) - (after.boundary - now.boundary)
    local least = now.error
    for _, work in ipairs { now.contacts, gained, gained + after.damped - now.damped } do
        for _, other in ipairs { now.error - 0.5 * work, now.error + 0.5 * work } do
            if math.abs(other) < math.abs(least) then least = other end
        end
    end
    return least
end

-- Energy of the blocks `moving` in every cycle, from the call on. The program's account is tested too, but the main criterion is kinetic
-- energy and height, which need no account:
--     kinetic + potential <= initial energy, of springs too, + work of prescribed motion,
-- because the energy stored in contacts is never negative. Velocities are half a step before positions; with positions half a step earlier,
-- kinetic + potential of a free flight is constant to rounding. `driven` are blocks with prescribed motion; their work is minus the contact
-- force on them times the displacement.
function scene.energy(moving, driven, every)
    local result = { excess = -math.huge, error = 0, stored = math.huge, largest = 0, put_in = 0, fastest = 0 }
    -- Heights are relative to the initial position of each block, so that numbers are small relative to the differences.
    local from, weight, first, start = {}, {}, {}, 0
    local g = model.gravity
    for i, b in ipairs(moving) do
        from[i], weight[i], first[i] = b.position, g * (scene.density * b.volume), b.velocity
        start = start + scene.kinetic(b)
    end
    -- Springs with an initial force may return their energy.
    result.preload = 0
    for s in sub_contacts() do
        if s.area > 0 then
            result.preload = result.preload + 0.5 * (s.normal_force ^ 2 / scene.kn + s.shear_force ^ 2 / scene.ks) / s.area
        end
    end
    result.start = start
    command "cycle 0\nreset energy"
    clock.cycle, clock.time = model.cycle, model.time
    local pushed = {}
    for i, b in ipairs(driven or {}) do pushed[i] = scene.contact_force(b) end
    result.deepest_potential = 0
    local earlier -- potential half a step before the start, where the first velocities belong
    scene.watch(function()
        local dt = scene.last_step()
        if not earlier then
            earlier = 0
            for i, v in ipairs(first) do earlier = earlier + weight[i]:dot(v) * (0.5 * dt) end
        end
        local potential, drivers = 0.0, 0.0
        for i, b in ipairs(moving) do
            local v = b.velocity
            potential = potential - weight[i]:dot(b.position - v * (0.5 * dt) - from[i])
            local speed = v:length()
            if speed > result.fastest then result.fastest = speed end
        end
        for i, b in ipairs(driven or {}) do
            local v, now = b.velocity, scene.contact_force(b)
            drivers = drivers + 0.5 * scene.density * b.volume * v:dot(v)
            result.put_in = result.put_in - 0.5 * (pushed[i] + now):dot(v) * dt
            pushed[i] = now
        end
        local kinetic = model.kinetic_energy - drivers
        if potential < result.deepest_potential then result.deepest_potential = potential end
        local excess = kinetic + potential - start - earlier - result.preload - result.put_in
        if not (excess <= result.excess) then result.excess = excess end
        if kinetic > result.largest then result.largest = kinetic end
        local stored = result.preload + model.joint_work - model.frictional_energy - model.touch_energy
        if not (stored >= result.stored) then result.stored = stored end
        if stored > result.largest then result.largest = stored end
    end, (driven and 1) or every)
    local looked, cycles = nil, 0
    scene.watch(function()
        if looked then
            local missing = least_error(looked, account())
            if not (math.abs(missing) <= math.abs(result.error)) then result.error = missing end
        end
        cycles = cycles + 1
        looked = cycles % (every or 1) == 0 and account() or nil
    end)
    -- The scale of errors: the largest energy of the scene so far, kinetic, stored, potential or supplied.
    function result.scale()
        return math.max(result.largest, start, math.abs(result.put_in), -result.deepest_potential)
    end
    return result
end

-- The three energy rows of a case, each within 0.1 % of the largest energy.
function scene.energy_rows(case, energy)
    local rows = require "parts.rows"
    local scale = energy.scale()
    rows.at_most(case, "kinetic and potential energy above what was there and put in, over the largest energy",
        energy.excess / scale, 1e-3)
    rows.at_least(case, "least energy stored in joints over the largest energy", energy.stored / scale, -1e-3)
    rows.absolute(case, "residual energy over the largest energy", energy.error / scale, 0, 1e-3)
end

return scene
