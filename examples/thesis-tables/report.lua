-- The page of results: the number of rows within their tolerance, then thesis, closed form, results of the runs and error for
-- each table with its picture, and a list of misprints. Each row is also a comparison that stops the run if its
-- error is too large.
local formulas, verify, chart = require "formulas", require "verify", require "chart"
local report = {}

local sections = {} -- in order: {title, note, head, rows, picture}
local kinds = {}    -- in order: {name, tolerance, rows, worst}

-- `picture` is {file, x, y}: the file and axes of its picture.
local function section(title, note, head, picture)
    for _, s in ipairs(sections) do
        if s.title == title then return s end
    end
    picture.line = { "closed form", x = {}, y = {} }
    picture.points = { { "kaya", x = {}, y = {} }, { "empirical", x = {}, y = {} }, { "numerical", x = {}, y = {} } }
    sections[#sections + 1] = { title = title, note = note, head = head, rows = {}, picture = picture }
    return sections[#sections]
end

local function count(name, tolerance, error)
    local kind
    for _, known in ipairs(kinds) do
        if known.name == name then kind = known end
    end
    if not kind then
        kind = { name = name, tolerance = tolerance, rows = 0, good = 0, worst = 0 }
        kinds[#kinds + 1] = kind
    end
    kind.rows = kind.rows + 1
    if error <= tolerance then kind.good = kind.good + 1 end
    kind.worst = math.max(kind.worst, error)
end

-- The row of docs/verification.md for a table.
local case_of = { ["4.2"] = "J5", ["4.3"] = "J5", ["4.4"] = "J5", ["4.5"] = "J5", ["4.7, second"] = "J8" }

local function case(test)
    return ("%s table %s at %g"):format(case_of[test.table.table] or "J6", test.table.table, test.row[1])
end

-- Without a minus sign before zero.
local function percent(value)
    local text = ("%.3f"):format(100 * value)
    return text == "-0.000" and "0.000" or text
end

-- Adds a row to the picture of its table.
local function draw(into, x, closed_form, ours, empirical, numerical)
    local function put(set, y) set.x[#set.x + 1], set.y[#set.y + 1] = x, y end
    local points = into.picture.points
    put(into.picture.line, closed_form)
    put(points[1], ours)
    put(points[2], empirical)
    put(points[3], numerical)
end

-- `columns`: texts between the first column and the closed form.
local function compare(into, test, columns, kind, quantity, ours, closed_form, format, tolerance, more)
    verify.relative(case(test), quantity, ours, closed_form, tolerance)
    count(kind, tolerance, math.abs(ours / closed_form - 1))
    local cells = { ("%g"):format(test.row[1]) }
    for _, text in ipairs(columns) do cells[#cells + 1] = text end
    cells[#cells + 1] = format:format(closed_form)
    cells[#cells + 1] = format:format(ours)
    cells[#cells + 1] = percent(ours / closed_form - 1)
    for _, text in ipairs(more or {}) do cells[#cells + 1] = text end
    into.rows[#into.rows + 1] = cells
end

local function closures(tests, stress)
    for _, test in ipairs(tests) do
        local tab = test.table
        local into = section("Table " .. tab.table .. ": closure",
            ("Closure in mm at a normal stress of %g MPa, and the maximum closure V_m that it belongs to. The thesis gives "):format(
                stress) .. "V_m, read off a graph.",
            { tab.label, "thesis V_m, empirical", "thesis V_m, numerical", "V_m (2.25)", "closure (2.22)", "kaya", "error, %" },
            { file = "thesis-table-" .. tab.table .. ".svg", x = tab.label, y = "V_m, mm" })
        local most = 1e3 * formulas.maximum_closure(test.values)
        compare(into, test, { ("%.3f"):format(test.row[2]), ("%.3f"):format(test.row[3]), ("%.4f"):format(most) }, "closures",
            "closure, mm", 1e3 * test.closed, 1e3 * formulas.closure(test.values, stress), "%.5f", 0.001)
        draw(into, test.row[1], most, 1e3 * formulas.maximum_of_closure(test.closed, stress), test.row[2], test.row[3])
    end
end

local function stiffnesses(tests)
    for _, test in ipairs(tests) do
        local into = section("Table 4.5: normal stiffness", "Tangent stiffness in MPa/m at a closure. The thesis has its "
            .. "two columns exchanged: the one headed numerical is (2.23) with V_m rounded to 0.209 mm.",
            { "closure, mm", "thesis, empirical", "thesis, numerical", "(2.23)", "kaya", "error, %" },
            { file = "thesis-table-4.5.svg", x = "closure, mm", y = "normal stiffness, GPa/m" })
        local expected = formulas.normal_stiffness(test.values, test.closure)
        compare(into, test, { ("%d"):format(test.row[2]), ("%d"):format(test.row[3]) }, "normal stiffnesses",
            "normal stiffness, MPa/m", test.stiffness, expected, "%.0f", 0.005)
        draw(into, test.row[1], 1e-3 * expected, 1e-3 * test.stiffness, 1e-3 * test.row[2], 1e-3 * test.row[3])
    end
end

local function peaks(tests)
    for _, test in ipairs(tests) do
        local into = section("Table " .. test.table.table .. ": peak shear strength",
            "Shear stress in MPa at the peak, and the displacement at which it came.",
            { test.table.label, "thesis, empirical", "thesis, numerical", "(2.5)", "kaya", "error, %", "at, mm", "(2.15), mm" },
            { file = "thesis-table-" .. test.table.table .. ".svg", x = test.table.label, y = "peak shear stress, MPa" })
        local expected = formulas.peak(test.values)
        compare(into, test, { ("%.2f"):format(test.row[2]), ("%.2f"):format(test.row[3]) }, "peak strengths",
            "peak shear stress, MPa", test.peak, expected, "%.4f", 0.005,
            { ("%.3f"):format(1e3 * test.at), ("%.3f"):format(1e3 * formulas.peak_displacement(test.values)) })
        verify.absolute(case(test),
            "largest excess over the law at the normal stress of the moment", test.above, 0, 1e-9)
        draw(into, test.row[1], expected, test.peak, test.row[2], test.row[3])
    end
end

local function residuals(tests)
    for _, test in ipairs(tests) do
        local into = section("Table 4.7, the second: residual shear strength",
            "Shear stress in MPa after 100 times the displacement of the peak.",
            { test.table.label, "thesis, empirical", "thesis, numerical", "sigma_n tan(phi_r)", "kaya", "error, %" }, {})
        compare(into, test, { ("%.2f"):format(test.row[2]), ("%.2f"):format(test.row[3]) }, "residual strength",
            "residual shear stress, MPa", test.residual, formulas.residual(test.values), "%.4f", 0.005)
    end
end

local function line(cells) return "| " .. table.concat(cells, " | ") .. " |\n" end

-- "79 of 79 rows within ..."
local function summary()
    local rows, good, parts = 0, 0, {}
    for _, kind in ipairs(kinds) do
        rows, good = rows + kind.rows, good + kind.good
        parts[#parts + 1] = ("%d %s within %g %% (worst %.2g %%)"):format(kind.good, kind.name, 100 * kind.tolerance, 100 * kind.worst)
    end
    return ("**%d of %d rows within their tolerance**: %s."):format(good, rows, table.concat(parts, ", "))
end

local function table_4_11(file)
    local thesis = require "thesis"
    file:write("\n## Table 4.11: shear stiffness, not run\n\n",
        "Tangent shear stiffness in MPa/m over shear displacement. No box is sheared for it: no hyperbola (2.27), (2.28) gives its numbers. ",
        "For any such law 1/sqrt(K_s) is a straight line over the displacement; the printed numbers make it rise ever faster. ",
        "The last column is how much it rises from the row before.\n\n",
        line({ "shear, mm", "thesis, empirical", "thesis, numerical", "1/sqrt(K_s) of empirical, 1e-3", "rises by, 1e-3" }), "|---|---|---|---|---|\n")
    local before
    for _, r in ipairs(thesis.shear_stiffness.rows) do
        local root = 1e3 / math.sqrt(r[2])
        file:write(line({ ("%.2f"):format(r[1]), ("%d"):format(r[2]), ("%d"):format(r[3]), ("%.2f"):format(root),
            before and ("%.2f"):format(root - before) or "" }))
        before = root
    end
end

local function misprints(file)
    file:write("\n## In print\n\nWhat a reader of chapters 2 and 4 meets, found by computing each table again:\n\n")
    for _, sentence in ipairs(require("thesis").misprints) do file:write("* ", sentence, "\n") end
end

function report.write(file_name, stated_stress, closing, stiffening, sheared, wearing)
    closures(closing, stated_stress)
    stiffnesses(stiffening)
    peaks(sheared)
    residuals(wearing)
    local file = assert(io.open(file_name, "w"))
    file:write("# Tables 4.2 to 4.10 of the thesis\n\nKoçal (2008), chapter 4, beside the closed forms of ",
        "docs/joint-models/barton-bandis.md and shear box runs of kaya. Errors are those of kaya against the closed form.\n\n", summary(), "\n")
    for _, s in ipairs(sections) do
        file:write("\n## ", s.title, "\n\n", s.note, "\n\n", line(s.head), "|", ("---|"):rep(#s.head), "\n")
        for _, cells in ipairs(s.rows) do file:write(line(cells)) end
        if s.picture.file then
            chart.write(s.picture.file, s.title, s.picture.x, s.picture.y, s.picture.line, s.picture.points)
            file:write("\n![", s.title, "](", s.picture.file, ")\n")
        end
    end
    table_4_11(file)
    misprints(file)
    file:close()
    print((summary():gsub("%*", "")))
    -- The rows of the table in README.md.
    for _, kind in ipairs(kinds) do
        print(("row kinds | %s | %d of %d | %g %% | %.3f %%"):format(kind.name, kind.good, kind.rows, 100 * kind.tolerance, 100 * kind.worst))
    end
    local f = require("figure").new("Shear box, normal stress 0.5 to 10 MPa", "shear displacement, mm", "shear stress, MPa")
    for _, test in ipairs(sheared) do
        if test.table.varies == "stress" and test.row[1] % 5 < 1 then
            f:line(("%g MPa"):format(test.row[1]), test.ways, test.stresses)
        end
    end
    f:write("thesis-shear")
end

return report
