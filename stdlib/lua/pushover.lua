-- Push-over past the peak: a share of gravity acts along a direction, and it is scaled in every cycle such that the centre of mass of
-- all free blocks moves at a given speed. The load is what that takes: it falls when joints soften, when blocks rock, and is nothing
-- when the wall would fall by itself.
--
--     local pushover = require "pushover"
--     local curve = pushover.run { along = vector(1, 0, 0), speed = 0.01, to = 0.1, file = "push.csv" }
--     print(curve.peak.load, curve.peak.displacement)
--
-- The equation: with M the mass of the free blocks and v the velocity of their centre along the direction, M dv/dt = F + M a, where F is
-- the force of the supports. F changes little in a step, so a = (wanted - v)/dt - (dv/dt - a) of the step before gives the wanted v.
-- docs/push-over.md has the rest.
local pushover = {}

-- What a call may say: its value if it is not given; nil: it must be given.
local known = { along = true, speed = true, to = true, every = true, below = true, file = true, row = true }

local function number(given, name, default)
    local value = given[name]
    if value == nil then value = default end
    if type(value) ~= "number" or value ~= value then error(("pushover.run: %s must be a number"):format(name), 3) end
    return value
end

local function checked(given)
    if type(given) ~= "table" then error("pushover.run needs a table: pushover.run { along = vector(1, 0, 0), speed = 0.01, to = 0.1 }", 3) end
    for name in pairs(given) do
        if not known[name] then error(("pushover.run does not know '%s': along, speed, to, every, below, file, row"):format(tostring(name)), 3) end
    end
    local along = given.along
    if not pcall(function() assert(along:length() > 0) end) then error("pushover.run: along must be a vector, such as vector(1, 0, 0)", 3) end
    local run = { along = along:unit(), speed = number(given, "speed"), to = number(given, "to"), every = number(given, "every", 50),
        below = number(given, "below", 0), file = given.file, row = given.row }
    if not (run.speed > 0) then error("pushover.run: speed must be above 0", 3) end
    if not (run.to > 0) then error("pushover.run: to, the displacement at the end, must be above 0", 3) end
    if run.every < 1 or run.every ~= math.floor(run.every) then error("pushover.run: every must be a whole number of cycles", 3) end
    if run.below < 0 or run.below >= 1 then error("pushover.run: below is a share of the peak, from 0 to less than 1", 3) end
    if not (model.gravity:length() > 0) then error("pushover.run: there is no gravity, and the load is a share of it", 3) end
    if math.abs(model.gravity:dot(run.along)) > 1e-9 * model.gravity:length() then
        error("pushover.run: along must be normal to gravity", 3)
    end
    return run
end

-- The free bodies: { object, mass }, blocks or, of blocks with zones, gridpoints.
local function free_bodies()
    local bodies, mass = {}, 0.0
    local function add(object)
        if math.abs(object.density_scaling - 1) > 1e-9 then error("pushover.run: masses are scaled; 'mscale off' first", 4) end
        bodies[#bodies + 1] = { object, object.mass }
        mass = mass + object.mass
    end
    for block in blocks() do
        if block.deformable == 1 then
            for point in block:gridpoints() do add(point) end
        elseif block.fixed == 0 then
            add(block)
        end
    end
    if not (mass > 0) then error("pushover.run: no block is free", 3) end
    return bodies, mass
end

local function mean_of(bodies, mass, field, along)
    local sum = vector()
    for _, body in ipairs(bodies) do sum = sum + body[1][field] * body[2] end
    return sum:dot(along) / mass
end

-- Runs until `to`, or until the load is below the share `below` of its peak, and to the end of that hundredth of the way. Returns a list of rows, one for `every` cycles, with
-- displacement, load (over gravity, the mean of these cycles), time, lost (energy of slip and failure) and damped (energy); its `peak` is
-- the row with the greatest load, `why` says how it ended, `damped_share` is the part of the load's work that damping took: an error of the load. Each row is given to the function `row`, if there is one, and to the CSV file.
function pushover.run(given)
    local run = checked(given)
    command "cycle 0"
    local bodies, mass = free_bodies()
    local gravity, along = model.gravity, run.along
    local size = gravity:length()
    local start = mean_of(bodies, mass, "displacement", along)
    local out = run.file and assert(io.open(run.file, "w"))
    if out then out:write("displacement,load,time,lost,damped\n") end
    local curve = {}
    local peak, work, damped, last = { load = -math.huge }, 0.0, model.damped_energy, 0.0
    local function add_row(load)
        local row = { displacement = mean_of(bodies, mass, "displacement", along) - start, load = load, time = model.time,
            lost = model.frictional_energy, damped = model.damped_energy }
        curve[#curve + 1] = row
        work = work + mass * size * load * (row.displacement - last)
        last = row.displacement
        if load > peak.load then peak = row end
        if out then out:write(("%.9g,%.9g,%.9g,%.9g,%.9g\n"):format(row.displacement, load, row.time, row.lost, row.damped)) end
        if run.row then run.row(row) end
        if last >= run.to then curve.why = "the displacement is reached" end
        if peak.load > 0 and load <= run.below * peak.load then curve.why = run.below > 0 and "the load has fallen" or "it falls by itself" end
    end

    local acting, way, before, sum, cycles = 0.0, 0.0, mean_of(bodies, mass, "velocity", along), 0.0, 0
    local control = hook.after_cycle(function()
        local dt = model.time_step
        local speed = mean_of(bodies, mass, "velocity", along)
        local others = (speed - before) / dt - acting
        sum, cycles = sum + acting, cycles + 1
        if cycles % run.every == 0 and not curve.why then
            add_row(sum / run.every / size)
            sum = 0.0
        end
        before = speed
        way = way + speed * dt
        -- It begins slowly: a jump of the speed would be an impact.
        local wanted = run.speed * math.min(1, 0.01 + way / (0.02 * run.to))
        acting = (wanted - speed) / dt - others
        model.gravity = gravity + along * acting
    end)
    -- A hundredth of the way at a time, and whole rows.
    local rows = math.max(1, math.ceil(0.01 * run.to / run.speed / model.time_step / run.every))
    repeat capture(("cycle %d"):format(rows * run.every)) until curve.why
    hook.remove(control)
    if out then out:close() end
    curve.peak, curve.damped_share = peak, (model.damped_energy - damped) / work
    if curve.damped_share > 0.05 then
        print(("pushover: damping has taken %.0f %% of the work of the load: go slower, and use 'damp local'"):format(100 * curve.damped_share))
    end
    return curve
end

return pushover
