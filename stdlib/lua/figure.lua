-- Pictures of results: curves next to closed forms, outlines of blocks. A figure is written as a gnuplot script that
-- holds its data; scripts/verification draws the figures of the verification decks as SVG.
--
--     local figure = require "figure"
--     local f = figure.new("way of the block", "time, s", "way, m")
--     f:line("kaya", times, ways)
--     f:dashed("closed form", times, expected)
--     f:write("way")                                  -- the file way.gp
local figure = {}
figure.__index = figure

local most_points = 160 -- of one curve: enough for the eye, and a small file

-- `x` and `y` are the names of the axes, with units.
function figure.new(title, x, y)
    return setmetatable({ title = title, x = x, y = y, data = {}, plots = {}, colours = 0, equal = false }, figure)
end

local colours = { "#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e" }

local function next_colour(self)
    self.colours = self.colours + 1
    return colours[(self.colours - 1) % #colours + 1]
end

local function quoted(text)
    return '"' .. text:gsub('["\\]', "") .. '"'
end

local function add(self, rows, style, label)
    local name = "$d" .. #self.data + 1
    self.data[#self.data + 1] = ("%s << EOD\n%s\nEOD\n"):format(name, table.concat(rows, "\n"))
    self.plots[#self.plots + 1] = ("%s %s %s"):format(name, style,
        label == "" and "notitle" or "title " .. quoted(label))
end

local function curve(self, label, xs, ys, style)
    if #xs ~= #ys then
        error(("the curve '%s' has %d x values and %d y values"):format(label, #xs, #ys), 3)
    end
    local rows, step = {}, math.max(1, (#xs - 1) / (most_points - 1))
    for k = 0, math.floor((#xs - 1) / step + 1e-9) do
        local i = 1 + math.floor(k * step + 0.5)
        rows[#rows + 1] = ("%.5g %.5g"):format(xs[i], ys[i])
    end
    add(self, rows, style, label)
end

function figure:line(label, xs, ys)
    curve(self, label, xs, ys, ("with lines lw 2 lc rgb '%s'"):format(next_colour(self)))
end

-- For closed forms.
function figure:dashed(label, xs, ys)
    curve(self, label, xs, ys, "with lines lw 1.5 dt 2 lc rgb 'black'")
end

function figure:points(label, xs, ys)
    curve(self, label, xs, ys, ("with points pt 7 ps 0.8 lc rgb '%s'"):format(next_colour(self)))
end

-- Closed polygons, lists of {x, y}, in one colour: "grey" for the earlier state. The axes get equal scales.
function figure:outlines(label, polygons, colour)
    local rows = {}
    for _, polygon in ipairs(polygons) do
        for i = 1, #polygon + 1 do
            local p = polygon[(i - 1) % #polygon + 1]
            rows[#rows + 1] = ("%.5g %.5g"):format(p[1], p[2])
        end
        rows[#rows + 1] = ""
    end
    self.equal = true
    add(self, rows, ("with lines lw 1.5 lc rgb '%s'"):format(colour or next_colour(self)), label)
end

-- Writes NAME.gp in the working folder.
function figure:write(name)
    local file = assert(io.open(name .. ".gp", "w"))
    file:write(table.concat(self.data))
    file:write("set title ", quoted(self.title), "\nset xlabel ", quoted(self.x), "\nset ylabel ", quoted(self.y), "\n")
    file:write("set key outside top center horizontal\n")
    if self.equal then
        file:write("set size ratio -1\n")
    end
    file:write("plot ", table.concat(self.plots, ", "), "\n")
    file:close()
end

return figure
