-- The page of results: thesis, closed form, what the runs gave, error. Each row is also a comparison that stops the run
-- when its error is too large.
local formulas, verify = require "formulas", require "verify"
local report = {}

local sections = {} -- in order: {title, note, head, rows}

local function section(title, note, head)
    for _, s in ipairs(sections) do
        if s.title == title then return s end
    end
    sections[#sections + 1] = { title = title, note = note, head = head, rows = {} }
    return sections[#sections]
end

-- The row of verification that a table belongs to (docs/verification.md).
local case_of = { ["4.2"] = "J5", ["4.3"] = "J5", ["4.4"] = "J5", ["4.5"] = "J5", ["4.7, second"] = "J8" }

local function case(test)
    return ("%s table %s at %g"):format(case_of[test.table.table] or "J6", test.table.table, test.row[1])
end

-- `columns`: texts between the first column and the closed form.
local function compare(into, test, columns, quantity, ours, closed_form, format, tolerance, more)
    verify.relative(case(test), quantity, ours, closed_form, tolerance)
    local cells = { ("%g"):format(test.row[1]) }
    for _, text in ipairs(columns) do cells[#cells + 1] = text end
    cells[#cells + 1] = format:format(closed_form)
    cells[#cells + 1] = format:format(ours)
    cells[#cells + 1] = ("%.3f"):format(100 * (ours / closed_form - 1))
    for _, text in ipairs(more or {}) do cells[#cells + 1] = text end
    into.rows[#into.rows + 1] = cells
end

local function closures(tests, stress)
    for _, test in ipairs(tests) do
        local tab = test.table
        local into = section("Table " .. tab.table .. ": closure",
            ("Closure in mm at a normal stress of %g MPa, and the maximum closure V_m that it belongs to. The thesis gives "):format(
                stress) .. "V_m, read off a graph.",
            { tab.label, "thesis V_m, empirical", "thesis V_m, numerical", "V_m (2.25)", "closure (2.22)", "kaya", "error, %" })
        compare(into, test, { ("%.3f"):format(test.row[2]), ("%.3f"):format(test.row[3]),
            ("%.4f"):format(1e3 * formulas.maximum_closure(test.values)) }, "closure, mm", 1e3 * test.closed,
            1e3 * formulas.closure(test.values, stress), "%.5f", 0.001)
    end
end

local function stiffnesses(tests)
    for _, test in ipairs(tests) do
        local into = section("Table 4.5: normal stiffness", "Tangent stiffness in MPa/m at a closure. The thesis has its "
            .. "two columns exchanged: the one headed numerical is (2.23) with V_m rounded to 0.209 mm.",
            { "closure, mm", "thesis, empirical", "thesis, numerical", "(2.23)", "kaya", "error, %" })
        compare(into, test, { ("%d"):format(test.row[2]), ("%d"):format(test.row[3]) }, "normal stiffness, MPa/m",
            test.stiffness, formulas.normal_stiffness(test.values, test.closure), "%.0f", 0.005)
    end
end

local function peaks(tests)
    for _, test in ipairs(tests) do
        local into = section("Table " .. test.table.table .. ": peak shear strength",
            "Shear stress in MPa at the peak, and the displacement at which it came.",
            { test.table.label, "thesis, empirical", "thesis, numerical", "(2.5)", "kaya", "error, %", "at, mm", "(2.15), mm" })
        compare(into, test, { ("%.2f"):format(test.row[2]), ("%.2f"):format(test.row[3]) }, "peak shear stress, MPa",
            test.peak, formulas.peak(test.values), "%.4f", 0.005,
            { ("%.3f"):format(1e3 * test.at), ("%.3f"):format(1e3 * formulas.peak_displacement(test.values)) })
        verify.absolute(case(test),
            "largest excess over the law at the normal stress of the moment", test.above, 0, 1e-9)
    end
end

local function residuals(tests)
    for _, test in ipairs(tests) do
        local into = section("Table 4.7, the second: residual shear strength",
            "Shear stress in MPa after 100 times the displacement of the peak.",
            { test.table.label, "thesis, empirical", "thesis, numerical", "sigma_n tan(phi_r)", "kaya", "error, %" })
        compare(into, test, { ("%.2f"):format(test.row[2]), ("%.2f"):format(test.row[3]) }, "residual shear stress, MPa",
            test.residual, formulas.residual(test.values), "%.4f", 0.005)
    end
end

local function line(cells) return "| " .. table.concat(cells, " | ") .. " |\n" end

function report.write(file_name, stated_stress, closing, stiffening, sheared, wearing)
    closures(closing, stated_stress)
    stiffnesses(stiffening)
    peaks(sheared)
    residuals(wearing)
    local file = assert(io.open(file_name, "w"))
    file:write("# Tables 4.2 to 4.10 of the thesis\n\nKoçal (2008), chapter 4, beside the closed forms of ",
        "docs/joint-models/barton-bandis.md and shear box runs of kaya. Errors are those of kaya against the closed form.\n")
    for _, s in ipairs(sections) do
        file:write("\n## ", s.title, "\n\n", s.note, "\n\n", line(s.head), "|", ("---|"):rep(#s.head), "\n")
        for _, cells in ipairs(s.rows) do file:write(line(cells)) end
    end
    file:close()
    local f = require("figure").new("Shear box, normal stress 0.5 to 10 MPa", "shear displacement, mm", "shear stress, MPa")
    for _, test in ipairs(sheared) do
        if test.table.varies == "stress" and test.row[1] % 5 < 1 then
            f:line(("%g MPa"):format(test.row[1]), test.ways, test.stresses)
        end
    end
    f:write("thesis-shear")
end

return report
