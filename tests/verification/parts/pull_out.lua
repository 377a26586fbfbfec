-- A bar bonded in rock whose end is pulled: the shear-lag equation EA u'' = k u (Farmer 1975), with grout that slips at the force S per length.
-- Returns the force in a bonded length L whose end has moved by u.
return function(EA, k, S, L, u)
    local function tanh(x) local e = math.exp(2 * x) return (e - 1) / (e + 1) end
    local elastic, uy, lambda = math.sqrt(EA * k), S / k, math.sqrt(k / EA)
    if u <= uy then return elastic * u * tanh(lambda * L) end
    local low, high = 0, L -- length that slips
    for _ = 1, 100 do
        local l = 0.5 * (low + high)
        if uy + elastic * uy * tanh(lambda * (L - l)) * l / EA + S * l * l / (2 * EA) < u then low = l else high = l end
    end
    return S * low + elastic * uy * tanh(lambda * (L - low))
end
