-- Comparison of a result with a closed form. Each call prints one row,
--     verified | case | quantity | closed form | kaya | error | tolerance
-- which the tests count and from which the table of docs/verification.md is made, and stops the run when
-- the error is above the tolerance.
--
--     local verify = require "verify"
--     verify.relative("J6", "peak shear stress at 5 MPa, MPa", peak, 2.7486, 0.005)
--     verify.absolute("M7", "creep in 1 s, m", creep, 0, 1e-6)
local verify = {}

local function row(case, quantity, ours, expected, error_text, tolerance_text, good)
    print(("verified | %s | %s | %.7g | %.7g | %s | %s"):format(case, quantity, expected, ours, error_text,
        tolerance_text))
    if not good then
        error(("%s: %s is %.9g, the closed form gives %.9g: the error of %s is above %s"):format(case, quantity, ours,
            expected, error_text, tolerance_text), 2)
    end
end

-- The error is measured by the closed form, which must not be 0.
function verify.relative(case, quantity, ours, expected, tolerance)
    local relative = math.abs(ours - expected) / math.abs(expected)
    row(case, quantity, ours, expected, ("%.2g %%"):format(100 * relative), ("%.2g %%"):format(100 * tolerance),
        relative <= tolerance)
end

-- The error is measured in the quantity's own unit.
function verify.absolute(case, quantity, ours, expected, tolerance)
    local difference = math.abs(ours - expected)
    row(case, quantity, ours, expected, ("%.2g"):format(difference), ("%.2g"):format(tolerance),
        difference <= tolerance)
end

return verify
