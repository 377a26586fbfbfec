-- Rows of what friction may take and what joint models may receive as slip, in a model that moves by its weight.
local rows = require "parts.rows"

return function(name, knows_slip)
    local work, most, least, slip, moved = model.gravity_work, 0, 0, 0, 0
    for s in sub_contacts() do
        most, least = math.max(most, s.frictional_work), math.min(least, s.frictional_work)
        if knows_slip then slip = math.max(slip, property(s, "slip")) end
        moved = math.max(moved, s.shear_displacement)
    end
    local lost = model.frictional_energy
    rows.at_most(name, "greatest loss of a sub-contact over the work of gravity", most / work, 1)
    rows.at_least(name, "smallest loss of a sub-contact over the work of gravity", least / work, -1e-6)
    rows.at_most(name, "loss of friction over the work of gravity", lost / work, 1)
    rows.at_least(name, "energy stored in joints over the work of gravity", (model.joint_work - lost) / work, -1e-9)
    if slip > 0 then rows.at_most(name, "greatest slip over the greatest shear displacement", slip / moved, 2) end
end
