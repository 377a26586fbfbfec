-- What a model without yield has, to be compared with another.
local measures = {}

local kinds = {
    displacement = function(out)
        for g in gridpoints() do out[#out + 1] = g.displacement end
        for b in blocks() do out[#out + 1] = b.displacement end
    end,
    force = function(out)
        for s in sub_contacts() do out[#out + 1] = s.shear_force_vector + s.normal * s.normal_force end
        for g in gridpoints() do out[#out + 1] = g.reaction end
    end,
    stress = function(out)
        for z in zones() do
            out[#out + 1] = vector(z.xx_stress, z.yy_stress, z.zz_stress)
            out[#out + 1] = vector(z.xy_stress, z.yz_stress, z.xz_stress)
        end
    end,
}

-- Displacements, forces and stresses of the model, or those that are named.
function measures.state(...)
    local all = {}
    for _, kind in ipairs(... and { ... } or { "displacement", "force", "stress" }) do
        all[kind] = {}
        kinds[kind](all[kind])
    end
    return all
end

-- The largest difference of `other` from `factor` times `own`, over the largest of its kind.
function measures.misfit(own, other, factor)
    local most = 0
    for kind, list in pairs(own) do
        local top, off = 0, 0
        for i, v in ipairs(list) do
            top = math.max(top, (factor * v):length())
            off = math.max(off, (other[kind][i] - factor * v):length())
        end
        if top > 0 then most = math.max(most, off / top) end
    end
    return most
end

return measures
