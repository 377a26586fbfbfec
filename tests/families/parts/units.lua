-- Decks in other units. A text has its numbers with a dimension as `{length 3.5}`; `units.text` writes them in units that are powers of two of those of the
-- text, so that each number, sum, product and even root has the same digits, and a run the same bits.
local units = {}

-- Powers of two: how many of the new units are one metre, kilogram and second. Mass needs an even power, since frequencies are roots.
function units.of(length, mass, time)
    local l, m, t = 2.0 ^ length, 2.0 ^ mass, 2.0 ^ time
    local force = m * l / t ^ 2
    return {
        length = l, area = l ^ 2, fourth = l ^ 4, time = t, frequency = 1 / t, velocity = l / t, acceleration = l / t ^ 2,
        density = m / l ^ 3, force = force, energy = force * l, tension = force / l, stress = force / l ^ 2, stiffness = force / l ^ 3,
    }
end

units.own = units.of(0, 0, 0)

function units.text(text, unit)
    return (text:gsub("{(%a+) ([^}]*)}", function(dimension, number)
        local factor = unit[dimension] or error("no dimension " .. dimension)
        return factor == 1 and number or ("%.17g"):format(tonumber(number) * factor)
    end))
end

return units
