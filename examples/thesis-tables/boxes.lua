-- Shear boxes side by side: many tests in one model. Box k has its own joint and pressure; the boxes are not in contact.
local formulas = require "formulas"
local boxes = { apart = 0.5 }

-- `tests`: a list of {values = ...}. The area is 0.2 m x 0.2 m and constant while the upper block slides by `room`.
-- `edge`: length of the edges of zones; nil: rigid blocks. `room`: permitted displacement of the upper block.
function boxes.build(tests, room, edge)
    for k, test in ipairs(tests) do
        local y = k * boxes.apart
        test.low, test.high = y - 0.12, y + 0.12
        command(("poly brick -0.15,%g %g,%g -0.10,0.00"):format(0.10 + room, y - 0.1, y + 0.1))
        command(("poly brick -0.10,0.10 %g,%g 0.00,0.10"):format(y - 0.1, y + 0.1))
    end
    if edge then command(("gen edge %g"):format(edge)) end
    command [[
        prop mat 1 density 0.0026 k 4e3 g 3e3
        jmodel model barton-bandis
        jmodel jkn 1e5 jks 1e4 nj 0.8 lo 0.1 ln 0.2
    ]]
    for _, test in ipairs(tests) do
        local v = test.values
        command(("jmodel resfriction %.17g jrco %.17g jcso %.17g sigmac %.17g range y %g %g"):format(v.resfriction, v.jrco,
            v.jcso, v.sigmac, test.low, test.high))
    end
    command "hide range z 0 0.1"
    if edge then command "bound xvel 0 yvel 0 zvel 0 range z -0.11 0.01" else command "fix range z -0.11 0.01" end
    command "seek"
end

-- Adds a pressure, MPa, to each upper block.
function boxes.press(tests, pressure_of)
    for _, test in ipairs(tests) do
        command(("bound stress 0 0 %.17g 0 0 0 range z 0.09 0.11 y %g %g"):format(-pressure_of(test), test.low, test.high))
    end
end

-- The joint of each box.
function boxes.find(tests)
    for k, test in ipairs(tests) do test.contact = nearest("contact", 0, k * boxes.apart, 0) end
end

return boxes
