-- Placement of a model: a point x of the model is mapped to t + s R x. R is a rotation, with a reflection if its determinant is -1.
local place = {}
place.__index = place

local unturned = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }

function place.new(turn, shift, scale)
    local self = { turn = turn or unturned, shift = shift or vector(0, 0, 0), scale = scale or 1 }
    local r = self.turn
    local rows = {}
    for i = 1, 3 do rows[i] = vector(r[i][1], r[i][2], r[i][3]) end
    -- +1, or -1 for a reflection: an additional factor of moments and spins.
    self.hand = rows[1]:cross(rows[2]):dot(rows[3]) > 0 and 1 or -1
    return setmetatable(self, place)
end

-- The rotation about an axis by an angle in degrees (Rodrigues).
function place.about(axis, degrees)
    local n = axis:unit()
    local c, s = math.cos(math.rad(degrees)), math.sin(math.rad(degrees))
    local x, y, z, k = n.x, n.y, n.z, 1 - c
    return {
        { c + x * x * k, x * y * k - z * s, x * z * k + y * s },
        { y * x * k + z * s, c + y * y * k, y * z * k - x * s },
        { z * x * k - y * s, z * y * k + x * s, c + z * z * k },
    }
end

-- The smallest rotation from the unit vector `from` to the unit vector `to`.
function place.between(from, to)
    local axis, cosine = from:cross(to), from:dot(to)
    if axis:length() < 1e-12 then
        if cosine > 0 then return unturned end
        local other = math.abs(from.x) < 0.9 and vector(1, 0, 0) or vector(0, 1, 0)
        return place.about(from:cross(other), 180)
    end
    return place.about(axis, math.deg(math.atan(axis:length(), cosine)))
end

-- First `first`, then `second`.
function place.product(second, first)
    local result = {}
    for i = 1, 3 do
        result[i] = {}
        for k = 1, 3 do
            local sum = 0.0
            for j = 1, 3 do sum = sum + second[i][j] * first[j][k] end
            result[i][k] = sum
        end
    end
    return result
end

function place.turned(turn, v)
    return vector(turn[1][1] * v.x + turn[1][2] * v.y + turn[1][3] * v.z, turn[2][1] * v.x + turn[2][2] * v.y + turn[2][3] * v.z,
        turn[3][1] * v.x + turn[3][2] * v.y + turn[3][3] * v.z)
end

function place.turned_back(turn, v)
    return vector(turn[1][1] * v.x + turn[2][1] * v.y + turn[3][1] * v.z, turn[1][2] * v.x + turn[2][2] * v.y + turn[3][2] * v.z,
        turn[1][3] * v.x + turn[2][3] * v.y + turn[3][3] * v.z)
end

function place:direction(v) return place.turned(self.turn, v) end
function place:direction_back(v) return place.turned_back(self.turn, v) end
function place:point(v) return place.turned(self.turn, v) * self.scale + self.shift end
function place:point_back(v) return place.turned_back(self.turn, (v - self.shift) / self.scale) end

-- Three numbers of a deck.
function place.text(v) return ("%.17g %.17g %.17g"):format(v.x, v.y, v.z) end

-- The line that makes the brick between two corners.
function place:brick(low, high)
    local line = "poly prism"
    for _, z in ipairs { low.z, high.z } do
        line = line .. (z == low.z and " a" or " b")
        for _, c in ipairs { { low.x, low.y }, { high.x, low.y }, { high.x, high.y }, { low.x, high.y } } do
            line = line .. " " .. place.text(self:point(vector(c[1], c[2], z)))
        end
    end
    return line
end

return place
