-- The closed forms (numbers as in docs/joint-models/barton-bandis.md). MPa, m; closures in m.
local formulas = { kni = 1e5, length_lab = 0.1, length_field = 0.2 }
local size = formulas.length_field / formulas.length_lab

function formulas.maximum_closure(v) -- (2.25), (2.26), from laboratory values
    local aperture = v.jrco / 5 * (0.2 * v.sigmac / v.jcso - 0.1)
    return 1e-3 * (-0.2960 - 0.0056 * v.jrco + 2.2410 * (v.jcso / aperture) ^ -0.2450)
end

function formulas.closure(v, stress) -- (2.22)
    local most = formulas.maximum_closure(v)
    return stress * most / (formulas.kni * most + stress)
end

function formulas.maximum_of_closure(closure, stress) -- (2.22), solved for V_m
    return stress * closure / (stress - formulas.kni * closure)
end

function formulas.stress_of_closure(v, closure)
    return formulas.kni * closure / (1 - closure / formulas.maximum_closure(v))
end

function formulas.normal_stiffness(v, closure) -- (2.23)
    return formulas.kni / (1 - closure / formulas.maximum_closure(v)) ^ 2
end

function formulas.roughness(v) return v.jrco * size ^ (-0.02 * v.jrco) end -- (2.14)
function formulas.wall_strength(v) return v.jcso * size ^ (-0.03 * v.jrco) end -- (2.13)

function formulas.peak(v, stress) -- (2.5)
    stress = stress or v.stress
    local ruff = formulas.roughness(v) * math.log(formulas.wall_strength(v) / stress, 10)
    return stress * math.tan(math.rad(v.resfriction + ruff))
end

function formulas.peak_displacement(v) -- (2.15)
    return formulas.length_field / 500 * (formulas.roughness(v) / formulas.length_field) ^ 0.33
end

function formulas.residual(v) return v.stress * math.tan(math.rad(v.resfriction)) end

return formulas
