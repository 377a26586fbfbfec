-- An open pit slope over a weak layer, between faults: geometry, stages and output. The decks in this folder set the numbers.
local pit = {}

-- Ground x z ... along the section, over the layer z = layer.z - x tan(dip) (a negative dip rises away from the pit); y from sides[1] to sides[2].
function pit.build(p)
    local function layer_at(x) return p.layer.z + x * math.tan(math.rad(p.layer.dip)) end
    local first, last = p.ground[1], p.ground[#p.ground - 1]
    local section = { { first, layer_at(first) } }
    for i = 1, #p.ground, 2 do section[#section + 1] = { p.ground[i], p.ground[i + 1] } end
    section[#section + 1] = { last, layer_at(last) }
    local function prism(corners)
        local text = {}
        for i, y in ipairs(p.sides) do
            text[#text + 1] = i == 1 and "a" or "b"
            for _, c in ipairs(corners) do text[#text + 1] = ("(%.12g,%.12g,%.12g)"):format(c[1], y, c[2]) end
        end
        command("poly prism " .. table.concat(text, " "))
    end
    prism(section)
    local inside = vector(p.inside[1], p.inside[2], p.inside[3])
    local planes = {}
    for _, f in ipairs(p.faults) do
        command(("jset dip %.12g dd %.12g origin %.12g %.12g %.12g"):format(f.dip, f.dd, f.x, f.y, f.z))
        local dip, dd = math.rad(f.dip), math.rad(f.dd)
        local n, o = vector(math.sin(dip) * math.sin(dd), math.sin(dip) * math.cos(dd), math.cos(dip)), vector(f.x, f.y, f.z)
        planes[#planes + 1] = { n = n * ((inside - o):dot(n) > 0 and 1 or -1), o = o }
    end
    prism { { first, layer_at(first) }, { last, layer_at(last) }, { last, layer_at(first) - 60 }, { first, layer_at(first) - 60 } }
    -- The slope has zones; the rock below, behind and at its sides is rigid and fixed.
    for block in blocks() do
        local x = block.position
        local moves = x.z > layer_at(x.x)
        for _, plane in ipairs(planes) do moves = moves and (x - plane.o):dot(plane.n) > 0 end
        command(moves and ("group block moving range bid %d"):format(block.id) or ("fix range bid %d"):format(block.id))
    end
    command(("gen edge %g range group moving"):format(p.edge))
    pit.layer_at = layer_at
end

-- Joints: the layer first, because it has no range, then the faults by their joint sets 1, 2, ...
local function joints(p, words)
    local list = { p.layer, table.unpack(p.faults) }
    for i, joint in ipairs(list) do command("jmodel " .. words(joint) .. (i > 1 and (" range jset %d"):format(i - 1) or "")) end
end

-- Weight is applied with unlimited strength; displacements are reset afterwards.
function pit.load(p)
    command "jmodel model mohr"
    joints(p, function(j) return ("jkn %g jks %g jfric 80 jcoh 1e9 jrcoh 1e9 jten 1e9 jrten 1e9"):format(j.kn, j.kn) end)
    local m = p.rock
    command(("prop mat 1 density %g young %g poisson %g bcoh 1e9 bfric %g bten 1e9"):format(m.density, m.young, m.poisson, m.friction))
    command "change cons 2\nset small on\ndamp local\nmscale on\ngravity 0 0 -9.81"
    command(("bound xvel 0 range group moving x %.12g"):format(p.ground[1]))
    if p.roller then command(("bound yvel 0 range group moving y %.12g"):format(p.roller)) end
    if p.water then command(("water ground '%s' shift 0 0 %g"):format(p.surface, -p.water)) end
    command "solve ratio 1e-4\nreset disp vel"
end

function pit.coulomb(p)
    command "jmodel model mohr"
    joints(p, function(j) return ("jkn %g jks %g jfric %g jcoh %g jrcoh %g jten 0"):format(j.kn, j.kn, j.friction, j.cohesion, j.cohesion) end)
    command(("prop mat 1 bcoh %g bten 0"):format(p.rock.cohesion))
end

-- JRC, JCS and residual angle of the tables are those of the whole joints; `jcs` selects one of the two wall strengths.
function pit.barton(p, jcs)
    command "jmodel model barton-bandis"
    joints(p, function(j)
        return ("jkn %g jks %g jrfric %g jrc %g jcs %g sigmac %g nj 0.9 large 1 ln %g mpa 1e6"):format(j.kn, j.kn, j.residual, j.jrc, j[jcs], j[jcs], j.length)
    end)
end

-- Factors of the weakest slip surfaces, along fault and layer and through the rock, in the section of the middle, which knows nothing of the sides.
function pit.slices(p)
    local from = ("limit equilibrium section %g %g 0 direction -1 0 0 "):format(0.5 * p.length, p.section)
    local function factor(surfaces)
        command(from .. surfaces)
        command "set @weakest [fos]"
        return ("%.3f"):format(fish.weakest)
    end
    return { factor "polylines spencer", factor "circles bishop" }
end

-- Displacements of the points, and the greatest over the length of the slope; the same as a cell of the table in README.md.
function pit.report(p, title)
    print(title)
    local most, cell = 0, {}
    for _, point in ipairs(p.points) do
        local d = nearest("gridpoint", point[2], point[3], point[4]).displacement
        local horizontal = math.sqrt(d.x * d.x + d.y * d.y)
        most = math.max(most, horizontal)
        cell[#cell + 1] = ("%.2f"):format(horizontal)
        print(("  %s: horizontal %.2f m, vertical %.2f m"):format(point[1], horizontal, d.z))
    end
    print(("  most, over the length of the slope: %.2f %%"):format(100 * most / p.length))
    return ("%s: %.2f %%"):format(table.concat(cell, ", "), 100 * most / p.length)
end

function pit.run(p)
    pit.build(p)
    pit.load(p)
    pit.coulomb(p)
    local cells = pit.slices(p)
    command "solve ratio 1e-4 cycles 8000"
    cells[#cells + 1] = pit.report(p, "Mohr-Coulomb")
    if fish.trials > 0 then command "solve fos ratio 1e-4 resolution 0.02" end
    for _, jcs in ipairs { "jcs_printed", "jcs" } do
        pit.barton(p, jcs)
        command "solve ratio 1e-4 cycles 8000"
        cells[#cells + 1] = pit.report(p, jcs == "jcs" and "Barton-Bandis, wall strengths recomputed" or "Barton-Bandis, wall strengths as printed")
    end
    print(("row pits | [%s](%s) | %d | %s"):format(p.name, p.name, model.zone_count, table.concat(cells, " | ")))
end

return pit
