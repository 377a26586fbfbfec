-- Convex bodies as lists of corners and faces, at any position, and the depth of overlap of two of them.
local place = require "parts.place"
local shapes = {}

local function shape(points, faces) return { points = points, faces = faces } end

-- A convex polygon in the plane x z, extruded along y.
function shapes.prism(polygon, y0, y1)
    local points, n = {}, #polygon
    for i, p in ipairs(polygon) do
        points[i] = vector(p[1], y0, p[2])
        points[n + i] = vector(p[1], y1, p[2])
    end
    local faces = { {}, {} }
    for i = 1, n do
        faces[1][i], faces[2][i] = n + 1 - i, n + i
        local k = i % n + 1
        faces[i + 2] = { i, k, n + k, n + i }
    end
    return shape(points, faces)
end

function shapes.box(a, b, c)
    return shapes.prism({ { -a / 2, -c / 2 }, { a / 2, -c / 2 }, { a / 2, c / 2 }, { -a / 2, c / 2 } }, -b / 2, b / 2)
end

-- Corners on the circle; a flat is at the bottom.
function shapes.drum(flats, radius, width)
    local polygon = {}
    for i = 1, flats do
        local angle = 2 * math.pi * (i - 0.5) / flats - math.pi / 2
        polygon[i] = { radius * math.cos(angle), radius * math.sin(angle) }
    end
    return shapes.prism(polygon, -width / 2, width / 2)
end

function shapes.tetrahedron(a, b, c, d)
    return shape({ a, b, c, d }, { { 1, 2, 3 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 1, 4 } })
end

-- A polygon of n corners on a circle below, a tip above.
function shapes.pyramid(n, radius, height)
    local points, faces = {}, { {} }
    for i = 1, n do
        local angle = 2 * math.pi * (i - 0.5) / n
        points[i] = vector(radius * math.cos(angle), radius * math.sin(angle), 0)
        faces[1][i] = i
        faces[i + 1] = { i, i % n + 1, n + 1 }
    end
    points[n + 1] = vector(0, 0, height)
    return shape(points, faces)
end

local function area_vector(points, face)
    local sum, first = vector(0, 0, 0), points[face[1]]
    for i = 2, #face - 1 do
        sum = sum + (points[face[i]] - first):cross(points[face[i + 1]] - first)
    end
    return sum * 0.5
end

function shapes.mean_face_area(s)
    local sum = 0.0
    for _, face in ipairs(s.faces) do sum = sum + area_vector(s.points, face):length() end
    return sum / #s.faces
end

-- Mean of the corners: a point inside.
function shapes.middle(points)
    local sum = vector(0, 0, 0)
    for _, p in ipairs(points) do sum = sum + p end
    return sum / #points
end

-- Outward unit normals of the faces, for corners at `points`.
function shapes.normals(points, faces)
    local middle, normals = shapes.middle(points), {}
    for i, face in ipairs(faces) do
        local n = area_vector(points, face):unit()
        normals[i] = n:dot(points[face[1]] - middle) < 0 and n * -1 or n
    end
    return normals
end

-- Edges as {from, to, face, face}.
function shapes.edges(s)
    local found, edges = {}, {}
    for f, face in ipairs(s.faces) do
        for i = 1, #face do
            local a, b = face[i], face[i % #face + 1]
            local key = math.min(a, b) * 100000 + math.max(a, b)
            if found[key] then
                edges[found[key]][4] = f
            else
                edges[#edges + 1] = { a, b, f }
                found[key] = #edges
            end
        end
    end
    return edges
end

function shapes.moved(s, where)
    local points = {}
    for i, p in ipairs(s.points) do points[i] = where:point(p) end
    return shape(points, s.faces)
end

-- The shape scaled about its middle so that no corner is farther from it than `reach`.
function shapes.within(s, reach)
    local middle, farthest = shapes.middle(s.points), 0
    for _, p in ipairs(s.points) do farthest = math.max(farthest, (p - middle):length()) end
    local points, factor = {}, math.min(1, reach / farthest)
    for i, p in ipairs(s.points) do points[i] = middle + (p - middle) * factor end
    return shape(points, s.faces)
end

-- Creates the block of a placed shape, and finds the gridpoint of each corner.
function shapes.build(s)
    local words, middle = { "poly" }, shapes.middle(s.points)
    for _, face in ipairs(s.faces) do
        words[#words + 1] = "face"
        -- Clockwise seen from outside.
        local backward = area_vector(s.points, face):dot(s.points[face[1]] - middle) > 0
        for i = 1, #face do
            local p = s.points[face[backward and #face + 1 - i or i]]
            words[#words + 1] = ("%.17g %.17g %.17g"):format(p.x, p.y, p.z)
        end
    end
    command(table.concat(words, " "))
    local body = { shape = s, block = require("parts.scene").newest(), corners = {} }
    shapes.find_corners(body)
    return body
end

-- The gridpoints at the initial corners of a body; they change when it is zoned.
function shapes.find_corners(body)
    for i, p in ipairs(body.shape.points) do
        local nearest_way = math.huge
        for g in body.block:gridpoints() do
            local way = (g.position - p):length()
            if way < nearest_way then nearest_way, body.corners[i] = way, g end
        end
    end
end

function shapes.points_now(body)
    local points = {}
    for i, g in ipairs(body.corners) do points[i] = g.position end
    return points
end

function shapes.lowest(body)
    local low = math.huge
    for _, g in ipairs(body.corners) do
        local z = g.z
        if z < low then low = z end
    end
    return low
end

-- Ends of edges, one for each direction. They are constant in a rigid body, so they are computed once.
local function edge_directions(s)
    if s.directions then return s.directions end
    local known = {}
    s.directions = {}
    for _, edge in ipairs(shapes.edges(s)) do
        local d = (s.points[edge[2]] - s.points[edge[1]]):unit()
        local new = true
        for _, other in ipairs(known) do new = new and math.abs(d:dot(other)) <= 1 - 1e-10 end
        if new then
            known[#known + 1] = d
            s.directions[#s.directions + 1] = edge
        end
    end
    return s.directions
end

local function directions_now(points, s)
    local list = {}
    for i, edge in ipairs(edge_directions(s)) do list[i] = (points[edge[2]] - points[edge[1]]):unit() end
    return list
end

local function reach(points, axis)
    local low, high = math.huge, -math.huge
    for _, p in ipairs(points) do
        local x = axis:dot(p)
        if x < low then low = x end
        if x > high then high = x end
    end
    return low, high
end

-- The smallest translation that separates the two bodies, negative if they are apart: separating axes are normals of faces and cross
-- products of edges (Gottschalk, Lin and Manocha 1996). If it is at most `enough`, any translation up to `enough` may be returned.
function shapes.overlap(one, other, enough)
    enough = math.max(enough or 0, 0)
    local a, b = shapes.points_now(one), shapes.points_now(other)
    local least = math.huge
    local function is_small(axis)
        local low_a, high_a = reach(a, axis)
        local low_b, high_b = reach(b, axis)
        least = math.min(least, high_a - low_b, high_b - low_a)
        return least < enough
    end
    for _, n in ipairs(shapes.normals(a, one.shape.faces)) do if is_small(n) then return least end end
    for _, n in ipairs(shapes.normals(b, other.shape.faces)) do if is_small(n) then return least end end
    local of_b = directions_now(b, other.shape)
    for _, d in ipairs(directions_now(a, one.shape)) do
        for _, e in ipairs(of_b) do
            local axis = d:cross(e)
            if axis:length() > 1e-6 and is_small(axis:unit()) then return least end
        end
    end
    return least
end

-- A uniformly distributed rotation: a random unit quaternion (Shoemake 1992).
function shapes.random_turn(random)
    local u, v, w = random(), 2 * math.pi * random(), 2 * math.pi * random()
    local a, b = math.sqrt(1 - u), math.sqrt(u)
    local q = { b * math.cos(w), a * math.sin(v), a * math.cos(v), b * math.sin(w) }
    local axis = vector(q[2], q[3], q[4])
    if axis:length() < 1e-9 then return place.about(vector(0, 0, 1), 0) end
    return place.about(axis, math.deg(2 * math.atan(axis:length(), q[1])))
end

return shapes
