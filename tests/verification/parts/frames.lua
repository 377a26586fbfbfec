-- Bricks, and points in text, in a rotated frame.
local frames = {}

function frames.text(v) return ("%.17g %.17g %.17g"):format(v.x, v.y, v.z) end

-- Unit vectors x, y, z: x points to the azimuth, and down by the plunge (degrees).
function frames.axes(azimuth, plunge)
    local a, p = math.rad(azimuth), math.rad(plunge)
    local x = vector(math.cos(a) * math.cos(p), math.sin(a) * math.cos(p), -math.sin(p))
    local y = vector(-math.sin(a), math.cos(a), 0)
    return x, y, x:cross(y)
end

-- The same axes turned about x, in degrees; `side` is -1 for their mirror image across y.
function frames.turned(azimuth, plunge, turn, side)
    local x, flat, steep = frames.axes(azimuth, plunge)
    local c, s = math.cos(math.rad(turn)), math.sin(math.rad(turn))
    return x, (flat * c + steep * s) * side, steep * c - flat * s
end

-- Four frames: the name, and what frames.turned is called with.
frames.four = { { "as it is", 0, 0, 0, 1 }, { "turned by 90", 90, 0, 0, 1 }, { "oblique", 50, 40, 30, 1 }, { "mirrored", 0, 0, 0, -1 } }

-- A brick between two corners given in the frame at o.
function frames.brick(o, x, y, z, low, high)
    local function side(at)
        local line = ""
        for _, c in ipairs { { low.y, low.z }, { high.y, low.z }, { high.y, high.z }, { low.y, high.z } } do
            line = line .. " " .. frames.text(o + x * at + y * c[1] + z * c[2])
        end
        return line
    end
    command(("poly prism a%s b%s"):format(side(low.x), side(high.x)))
end

return frames
