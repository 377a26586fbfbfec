-- A semicircular arch of 20 voussoirs of 9 degrees with plane faces, 0.5 m deep; those at the springings are fixed.
local ring = {}

-- Returns the voussoirs in order from the right springing.
function ring.build(inner, outer, damping)
    local n = 20
    command "delete\nreset time damp"
    local function place(radius, angle, y) return (" %.17g %g %.17g"):format(radius * math.cos(angle), y, radius * math.sin(angle)) end
    for i = 1, n do
        local from, to = math.pi * (i - 1) / n, math.pi * i / n
        local line = "poly prism"
        for _, side in ipairs { { " a", 0 }, { " b", 0.5 } } do
            local y = side[2]
            line = line .. side[1] .. place(inner, from, y) .. place(outer, from, y) .. place(outer, to, y) .. place(inner, to, y)
        end
        command(line .. ((i == 1 or i == n) and " mat 2" or " mat 1"))
    end
    local voussoirs = {}
    for block in blocks() do voussoirs[#voussoirs + 1] = block end
    table.sort(voussoirs, function(a, b) return a.id < b.id end)
    for _, i in ipairs { 1, n } do command(("fix range id %d"):format(voussoirs[i].id)) end
    command("prop mat 1 density 1000\nprop mat 2 density 2200\ngravity 0 0 -9.806")
    command("jmodel model mohr\njmodel jkn 9e10 jks 5e10 jfric 35")
    command("damp " .. damping)
    return voussoirs
end

-- The contact between two blocks, and the forces of its sub-contacts as { position, normal force, shear force }.
function ring.joint(one, other)
    for c in contacts() do
        local a, b = c.block1.id, c.block2.id
        if a == one.id and b == other.id or a == other.id and b == one.id then
            local points = {}
            for s in sub_contacts() do
                if s.contact.id == c.id then points[#points + 1] = s end
            end
            return c, points
        end
    end
end

return ring
