-- What a touch explains. The least area of a touch is a hundredth of the mean face area, of the block with the smaller faces:
--     k = kn A_min
-- and a touch with more area is stiffer.
local shapes = require "parts.shapes"
local touch = {}

function touch.stiffness(kn, one, other)
    local area = shapes.mean_face_area(one.shape)
    if other then area = math.min(area, shapes.mean_face_area(other.shape)) end
    return 0.01 * area * kn
end

-- Depth to which a mass behind a spring goes that arrives with the speed u and is pressed by F: k d^2/2 = m u^2/2 + F d. At
-- rest, u = 0, that is twice the static closure: a weight that is let go.
function touch.depth(k, m, u, F) return (F + math.sqrt(F * F + k * m * u * u)) / k end

return touch
