-- Bounds of a contact. Its minimum area is 1/100 of the mean face area of the block with the smaller faces:
--     k = kn A_min
-- A contact with more area is stiffer.
local shapes = require "parts.shapes"
local touch = {}

function touch.stiffness(kn, one, other)
    local area = shapes.mean_face_area(one.shape)
    if other then area = math.min(area, shapes.mean_face_area(other.shape)) end
    return 0.01 * area * kn
end

-- Depth of a mass on a spring that arrives with the speed u under the force F: k d^2/2 = m u^2/2 + F d. With u = 0 it is twice the static
-- closure: a suddenly released weight.
function touch.depth(k, m, u, F) return (F + math.sqrt(F * F + k * m * u * u)) / k end

return touch
