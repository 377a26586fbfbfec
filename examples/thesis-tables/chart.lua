-- A picture of one table as SVG: a line, and points of several kinds, over the number that varies between rows.
local chart = {}

local width, height = 560, 340
local left, right, top, bottom = 70, 150, 30, 50
local colours = { "#1f77b4", "#d62728", "#ff7f0e", "#2ca02c" }

-- Round numbers from low to high.
local function ticks(low, high)
    local step = 10 ^ math.floor(math.log(high - low, 10))
    while (high - low) / step < 4 do step = step / 2 end
    local list = {}
    for k = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) do list[#list + 1] = k * step end
    return list
end

local function reach(curves, axis)
    local low, high = math.huge, -math.huge
    for _, curve in ipairs(curves) do
        for _, value in ipairs(curve[axis]) do low, high = math.min(low, value), math.max(high, value) end
    end
    local margin = 0.06 * (high - low)
    if margin == 0 then margin = 0.1 * math.abs(high) end
    return low - margin, high + margin
end

local mark = {
    function(x, y, colour) return ('<circle cx="%.1f" cy="%.1f" r="4.5" fill="%s"/>'):format(x, y, colour) end,
    function(x, y, colour)
        return ('<rect x="%.1f" y="%.1f" width="8" height="8" fill="none" stroke="%s" stroke-width="1.5"/>'):format(x - 4, y - 4, colour)
    end,
    function(x, y, colour)
        return ('<path d="M%.1f %.1f l5 9 h-10 z" fill="none" stroke="%s" stroke-width="1.5"/>'):format(x, y - 6, colour)
    end,
}

-- `line` and each of `points` are {label, x = {...}, y = {...}}.
function chart.write(file_name, title, x_name, y_name, line, points)
    local all = { line, table.unpack(points) }
    local x_low, x_high = reach(all, "x")
    local y_low, y_high = reach(all, "y")
    local function at(x, y)
        return left + (x - x_low) / (x_high - x_low) * (width - left - right), top + (y_high - y) / (y_high - y_low) * (height - top - bottom)
    end
    local out = { ('<svg xmlns="http://www.w3.org/2000/svg" width="%d" height="%d" font-family="sans-serif" font-size="12">'):format(width, height),
        '<rect width="100%" height="100%" fill="white"/>' }
    local function add(text, ...) out[#out + 1] = text:format(...) end
    add('<text x="%d" y="18" font-weight="bold">%s</text>', left, title)
    for _, x in ipairs(ticks(x_low, x_high)) do
        local px = at(x, 0)
        add('<path d="M%.1f %d V%d" stroke="#ddd"/><text x="%.1f" y="%d" text-anchor="middle">%.6g</text>', px, top, height - bottom, px, height - bottom + 16, x)
    end
    for _, y in ipairs(ticks(y_low, y_high)) do
        local _, py = at(0, y)
        add('<path d="M%d %.1f H%d" stroke="#ddd"/><text x="%d" y="%.1f" text-anchor="end">%.6g</text>', left, py, width - right, left - 6, py + 4, y)
    end
    add('<rect x="%d" y="%d" width="%d" height="%d" fill="none" stroke="#888"/>', left, top, width - left - right, height - top - bottom)
    add('<text x="%d" y="%d" text-anchor="middle">%s</text>', (left + width - right) // 2, height - 12, x_name)
    add('<text transform="translate(16,%d) rotate(-90)" text-anchor="middle">%s</text>', (top + height - bottom) // 2, y_name)
    local path = {}
    for i, x in ipairs(line.x) do path[i] = ("%s%.1f %.1f"):format(i == 1 and "M" or "L", at(x, line.y[i])) end
    add('<path d="%s" fill="none" stroke="black" stroke-width="1.5"/>', table.concat(path, " "))
    add('<path d="M%d 42 h20" stroke="black" stroke-width="1.5"/><text x="%d" y="46">%s</text>', width - right + 12, width - right + 38, line[1])
    for k, set in ipairs(points) do
        for i, x in ipairs(set.x) do
            local px, py = at(x, set.y[i])
            out[#out + 1] = mark[k](px, py, colours[k])
        end
        out[#out + 1] = mark[k](width - right + 22, 42 + 20 * k, colours[k])
        add('<text x="%d" y="%d">%s</text>', width - right + 38, 46 + 20 * k, set[1])
    end
    out[#out + 1] = "</svg>\n"
    local file = assert(io.open(file_name, "w"))
    file:write(table.concat(out, "\n"))
    file:close()
end

return chart
