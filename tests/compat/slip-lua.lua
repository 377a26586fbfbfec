-- The twin of tests/compat/v9/jmodelslip9.cpp and slip-native.cpp.
local slip_now, tension_now, slip_past, tension_past = 1, 2, 4, 8

local function tangent(degrees) return math.tan(degrees * (3.14159265358979323846 / 180)) end

local function run(s, p)
    if s.state & slip_now ~= 0 then s.state = s.state | slip_past end
    if s.state & tension_now ~= 0 then s.state = s.state | tension_past end
    s.state = s.state & ~(slip_now | tension_now)
    local failed = s.state & (slip_past | tension_past) ~= 0

    s.normal_force = s.normal_force + -p.stiffness_normal * s.area * s.normal_disp_inc
    local lowest = failed and 0.0 or -p.tension * s.area
    if s.normal_force <= lowest then
        s.normal_force, s.shear_force_x, s.shear_force_y, s.shear_force_z = 0.0, 0.0, 0.0, 0.0
        s.state = s.state | tension_now
        return
    end
    local k = -p.stiffness_shear * s.area
    s.shear_force_x = s.shear_force_x + s.shear_disp_inc_x * k
    s.shear_force_y = s.shear_force_y + s.shear_disp_inc_y * k
    s.shear_force_z = s.shear_force_z + s.shear_disp_inc_z * k
    local friction = tangent(failed and p.friction_residual or p.friction)
    local bond = failed and 0.0 or p.cohesion * s.area
    local most = math.max(0.0, bond + s.normal_force * friction)
    local shear = math.sqrt(s.shear_force_x ^ 2 + s.shear_force_y ^ 2 + s.shear_force_z ^ 2)
    if shear > most then
        local slip = (shear - most) / (p.stiffness_shear * s.area)
        local scale = most / shear
        s.shear_force_x, s.shear_force_y, s.shear_force_z = s.shear_force_x * scale, s.shear_force_y * scale, s.shear_force_z * scale
        s.normal_force = s.normal_force + p.stiffness_normal * s.area * tangent(p.dilation) * slip
        s.state = s.state | slip_now
        s.frictional_work = s.frictional_work + most * slip
    end
end

return {
    name = "slip-lua",
    title = "Coulomb slip, Lua",
    version = "1.0",
    properties = {
        {"stiffness-normal", "kn", unit = "stress/length", minimum = 0, help = "normal stress per closure"},
        {"stiffness-shear", "ks", unit = "stress/length", minimum = 0, help = "shear stress per shear displacement"},
        {"friction", "", unit = "angle", initial = 0, minimum = 0, maximum = 90},
        {"friction-residual", "", unit = "angle", initial = 0, minimum = 0, maximum = 90},
        {"cohesion", initial = 0},
        {"tension", initial = 0},
        {"dilation", initial = 0},
    },
    states = {"slip-n", "tension-n", "slip-p", "tension-p"},
    run = run,
    check = function(p) if p.stiffness_shear <= 0 then return "stiffness-shear is 0" end end,
    stiffness = function(p) return p.stiffness_normal, p.stiffness_shear end,
}
