-- Rows of a family: expected and actual values. Every row is printed, and `done` fails if one of them is bad, so that one run shows all
-- errors.
--
--     row | case | quantity | expected | got | tolerance | good
local rows = { good = 0, bad = 0 }

local function row(case, quantity, expected, got, tolerance, good)
    print(("row | %s | %s | %s | %.7g | %s | %s"):format(case, quantity, expected, got, tolerance, good and "good" or "BAD"))
    if good then rows.good = rows.good + 1 else rows.bad = rows.bad + 1 end
    return good
end

-- The error is relative to the expected value, which must not be 0. NaN is never good.
function rows.relative(case, quantity, got, expected, tolerance)
    return row(case, quantity, ("%.7g"):format(expected), got, ("%.2g of it"):format(tolerance),
        math.abs(got - expected) <= tolerance * math.abs(expected))
end

-- The error is in the unit of the quantity.
function rows.absolute(case, quantity, got, expected, tolerance)
    return row(case, quantity, ("%.7g"):format(expected), got, ("%.2g"):format(tolerance), math.abs(got - expected) <= tolerance)
end

function rows.at_most(case, quantity, got, limit)
    return row(case, quantity, ("<= %.4g"):format(limit), got, "0", got <= limit)
end

function rows.at_least(case, quantity, got, limit)
    return row(case, quantity, (">= %.4g"):format(limit), got, "0", got >= limit)
end

-- Runs a case; an error in it is a bad row, and later cases still run. Removes hooks of `scene.watch`.
function rows.case(name, run)
    local before = rows.good + rows.bad
    local well, message = pcall(run)
    if not well then
        print(("failed | %s | %s"):format(name, tostring(message):gsub("%s+", " ")))
        row(name, "the case runs to its end", "1", 0, "0", false)
    elseif rows.good + rows.bad == before then
        row(name, "rows of the case", ">= 1", 0, "0", false)
    end
    require("parts.scene").forget()
end

-- The largest value of many cases of a kind; each is printed in a note, so that a bad one can be found.
local worst, order = {}, {}

function rows.collect(kind, what, value, limit, name)
    print(("note | %s | %s | %s | %.5g%s"):format(name, kind, what, value, value <= limit and "" or " | above " .. limit))
    local key = kind .. "|" .. what
    if not worst[key] then
        worst[key] = { kind = kind, what = what, value = value, limit = limit, name = name, above = 0, of = 0 }
        order[#order + 1] = worst[key]
    end
    local w = worst[key]
    w.of = w.of + 1
    if not (value <= limit) then w.above = w.above + 1 end
    if not (value <= w.value) then w.value, w.name = value, name end
end

function rows.collected()
    for _, w in ipairs(order) do
        rows.at_most(w.kind, ("%s (worst: %s; above in %d of %d)"):format(w.what, w.name, w.above, w.of), w.value, w.limit)
    end
end

-- Runs cases in order; cases that the program could not run are counted.
function rows.cases(from, to, run)
    local failing = {}
    for i = from, to do
        local well, message = pcall(run, i)
        require("parts.scene").forget()
        if not well then
            failing[#failing + 1] = i
            print(("failed | %d | %s"):format(i, tostring(message):gsub("%s+", " ")))
        end
    end
    rows.at_most("all cases", "cases that the program could not run", #failing, 0)
end

-- The last line of every deck. Without a row the test fails.
function rows.done()
    print(("rows | %d good | %d bad"):format(rows.good, rows.bad))
    if rows.bad > 0 then error(("%d of %d rows are bad"):format(rows.bad, rows.bad + rows.good), 2) end
    if rows.good == 0 then error("there are no rows", 2) end
end

return rows
