-- @NAME@: springs in both directions and Coulomb's friction. Change it into what you need.
-- docs/joint-models-in-lua.md is the manual; signs are those of kaya/jmodel.h: compression and opening are positive.

-- One step of one sub-contact: s is the sub-contact, p its properties, h its history.
local function run(s, p, h)
    -- No tension is carried.
    s.normal_force = math.max(0, s.normal_force - p.stiffness_normal * s.area * s.normal_disp_inc)
    -- Shear forces oppose shear displacement.
    local k = p.stiffness_shear * s.area
    local x = s.shear_force_x - k * s.shear_disp_inc_x
    local y = s.shear_force_y - k * s.shear_disp_inc_y
    local z = s.shear_force_z - k * s.shear_disp_inc_z
    local trial = math.sqrt(x * x + y * y + z * z)
    local limit = math.min(trial, s.normal_force * math.tan(math.rad(p.friction)))
    local scale = trial > 0 and limit / trial or 0
    local slipped = s.area > 0 and (trial - limit) / k or 0
    -- Slip takes up the mean of the forces before and after it; this closes the account of energy.
    local before = s.shear_force_x * x + s.shear_force_y * y + s.shear_force_z * z
    local along = trial > 0 and before / trial or 0
    s.frictional_work = s.frictional_work + 0.5 * (along + limit) * slipped
    s.shear_force_x, s.shear_force_y, s.shear_force_z = x * scale, y * scale, z * scale
    h.slip = h.slip + slipped
    -- Bit 0 is the first state, bit 1 the second.
    s.state = (s.state ~= 0 and 2 or 0) | (trial > limit and 1 or 0)
end

return {
    name = "@NAME@",
    title = "Springs and Coulomb's friction",
    version = "0.1",
    properties = {
        {"stiffness-normal", "jkn kn", unit = "stress/length", minimum = 0, help = "normal stress per closure"},
        {"stiffness-shear", "jks ks", unit = "stress/length", minimum = 0, help = "shear stress per shear displacement"},
        {"friction", "jfriction fric", unit = "angle", initial = 0, minimum = 0, maximum = 89, help = "angle of friction"},
    },
    history = {{"slip", unit = "length", help = "shear displacement beyond the limit, added up"}},
    states = {"slip-now", "slip-past"},
    run = run,
    -- A sentence when the values cannot work together.
    check = function(p)
        if not (p.jkn > 0) then return "stiffness-normal (jkn) is 0: give the joint a normal stiffness" end
        if not (p.jks > 0) then return "stiffness-shear (jks) is 0: give the joint a shear stiffness" end
    end,
    stiffness = function(p) return p.stiffness_normal, p.stiffness_shear end,
}
