-- Cubes of rock of 10 m that random joint sets cut, and joint models for them.
local units = require "parts.units"

local rock = {}

-- Somewhere in space, by one to four joint sets, some of whose joints end in the rock; the lower quarter is held. Gives its lowest corner.
function rock.cut(draw, unit)
    local function run(line) command(units.text(line, unit or units.own)) end
    local far = 10 ^ (3 * draw()) - 1
    local x, y, z = far * draw(), -far * draw(), far * draw()
    local corners = "{length %.17g} {length %.17g} {length %.17g} {length %.17g} {length %.17g} {length %.17g}"
    run("poly brick " .. corners:format(x, x + 10, y, y + 10, z, z + 10))
    for set = 1, 1 + math.floor(4 * draw()) do
        local persistence = draw() < 0.3 and (" persistence %.2g"):format(0.3 + 0.6 * draw()) or ""
        local line = "jset dip %.6g dd %.6g spacing {length %.6g} num 8 origin {length %.6g} {length %.6g} {length %.6g} id %d%s"
        run(line:format(90 * draw(), 360 * draw(), 1.5 + 3 * draw(), x + 5 * draw(), y + 5, z + 5 * draw(), set, persistence))
    end
    run(("fix range z {length %.17g} {length %.17g}"):format(z, z + 2.5))
    return x, y, z
end

-- `more` is completed by the angle of friction. `powers`: with powers of numbers that have a dimension, whose last bits depend on the units.
local laws = {
    { name = "softening-mohr", more = "fric=%g friction-residual=5 dc={length 1e-3} healing-time={time 0.1}" },
    { name = "continuously-yielding", more = "fric=%g jif=50 jr={length 3e-3}" },
    { name = "bilinear-mohr", more = "fric=%g coh={stress 2e4} f2=10 c2={stress 1e5}" },
    { name = "fracture-energy", more = "jten={stress 2.5e4} g1={tension 18} jcoh={stress 3.5e4} g2={tension 125} jfric=%g" },
    { name = "power", more = "fric=%g constant-1=1e-9 exponent-1=3", powers = true },
    { name = "nonlinear", more = "exponent-normal=0.5 exponent-shear=0.5 kn-maximum=1e13 fric=%g", powers = true },
    { name = "velocity-weakening", more = "friction-static=%g friction-dynamic=8 reference-velocity={velocity 0.1}" },
    { name = "barton-bandis", more = "resfriction=%g jrco=8 jcso=100e6 sigmac=150e6 nj=0.8 lo=0.1 ln=0.2 mpa=1e6", powers = true },
}

-- The two lines that give a joint model and its values.
local function lines(law, kn, ks, angle, range)
    local values = ("jkn={stiffness %.17g} jks={stiffness %.17g} "):format(kn, ks) .. law.more:format(angle)
    return ("jmodel model %s%s\njmodel %s%s"):format(law.name, range, values, range)
end

-- Lines that give a random joint model, that of Coulomb in two of five, to all joints or to those of a range. `powers`: of all models.
function rock.law(draw, range, powers)
    local law = draw() < 0.4 and { name = "mohr", more = "fric=%g" } or laws[1 + math.floor(#laws * 0.999999 * draw())]
    if law.powers and not powers then law = laws[1] end
    local kn = 10 ^ (8 + 3 * draw())
    return lines(law, kn, kn * (0.2 + 0.8 * draw()), 10 + 40 * draw(), range)
end

-- Coulomb joints in rocks of odd numbers, the other joint models that ship in the others.
function rock.joints(number, draw)
    local kn = 10 ^ (8 + 3 * draw())
    local ks, angle = kn * (0.2 + 0.8 * draw()), 10 + 40 * draw()
    require("parts.scene").joints(kn, ks, angle)
    if number % 2 == 1 then return end
    local law = laws[number // 2 % #laws + 1]
    command(units.text(lines(law, kn, ks, angle, ""), units.own))
end

return rock
