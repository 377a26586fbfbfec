-- The slope of case S6: 260 m, 55 degrees, in plane strain, without joints or with joint sets. It faces -x, its toe is at the origin.
local jointed_slope = {}

local height, face, thick = 260, 55, 10

-- Sets are { dip, dip direction, spacing, a point on a joint }; rock extends `front` before the toe, `back` behind the crest and `deep`
-- below the toe, `edge` is that of zones; without it blocks are rigid, and those around the edge of the model are fixed. The weight is
-- applied, and strengths are those of the case.
function jointed_slope.build(front, back, deep, edge, sets)
    local crest = height / math.tan(math.rad(face))
    local line = "poly prism"
    for side, y in pairs { a = 0, b = thick } do
        line = line .. " " .. side
        for _, p in ipairs { { -front, -deep }, { -front, 0 }, { 0, 0 }, { crest, height }, { crest + back, height }, { crest + back, -deep } } do
            line = line .. (" %.17g %g %g"):format(p[1], y, p[2])
        end
    end
    command("delete\nreset time\n" .. line)
    for _, set in ipairs(sets) do command(("jset dip %g dd %g spacing %g number 100 origin %s tolerance 1"):format(table.unpack(set))) end
    command "prop mat 1 density 2660\ngravity 0 0 -9.81\nset small on\ndamp local\nmscale on"
    if edge then
        command(("gen edge %g\nprop mat 1 k 6.3e9 g 3.6e9 bcoh 1e9 bfric 43 bten 1e9\nchange cons 2"):format(edge))
        command(("bound xvel 0 range x %g\nbound xvel 0 range x %.17g\nbound xvel 0 yvel 0 zvel 0 range z %g\nbound yvel 0"):format(-front, crest + back, -deep))
    else
        command(("fix range x %g %g\nfix range x %g %g\nfix range z %g %g"):format(-front, 30 - front, crest + back - 40, crest + back, -deep, 40 - deep))
    end
    command "jmodel model mohr\njmodel jkn 1e10 jks 1e10 jfric 80 jcoh 1e9 jrcoh 1e9 jten 1e9 jrten 1e9"
    command "solve ratio 1e-5\njmodel jfric 40 jcoh 1e5 jrcoh 1e5 jten 0 jrten 0"
    if edge then command "prop mat 1 bcoh 675e3 bten 0" end
end

-- Factor of safety within a bracket, to a `resolution` of 0.02 or as given, and the mode of failure, as printed by `solve fos`.
function jointed_slope.factor(name, from, to, resolution)
    local file = name .. ".log"
    command(("set log on logfile '%s'\nsolve ratio 1e-5 cycles 20000\nsolve fos resolution %g bracket %g %g\nset log off"):format(file, resolution or 0.02, from, to))
    local text = io.open(file):read "a"
    return model.factor_of_safety, text:match "mode of failure: ([^;]*)"
end

return jointed_slope
