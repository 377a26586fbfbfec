-- The tables of chapter 4 of Koçal (2008): the columns that the thesis heads empirical (E) and numerical (N). MPa and mm.
-- The second table 4.7 is called "residual" here; no table of the thesis has the number 4.8.
local thesis = {}

-- Standard values, for quantities that a row does not vary.
thesis.standard = { jrco = 8, jcso = 100, sigmac = 150, resfriction = 20, stress = 5 }

thesis.closures = {
    { table = "4.2", varies = "jrco", label = "JRC_o", rows = {
        { 2, 0.083, 0.080 }, { 4, 0.144, 0.138 }, { 6, 0.182, 0.174 }, { 8, 0.208, 0.198 }, { 10, 0.227, 0.218 },
        { 12, 0.243, 0.232 }, { 14, 0.255, 0.243 }, { 16, 0.264, 0.253 }, { 18, 0.272, 0.259 }, { 20, 0.279, 0.265 } } },
    { table = "4.3", varies = "jcso", label = "JCS_o, MPa", rows = {
        { 40, 0.58, 0.55 }, { 50, 0.47, 0.447 }, { 60, 0.40, 0.37 }, { 70, 0.34, 0.315 }, { 80, 0.29, 0.27 },
        { 90, 0.24, 0.23 }, { 100, 0.21, 0.198 }, { 110, 0.18, 0.167 }, { 120, 0.15, 0.14 }, { 130, 0.12, 0.116 },
        { 140, 0.10, 0.094 } } },
    { table = "4.4", varies = "sigmac", label = "sigma_c, MPa", others = { jcso = 50 }, rows = {
        { 60, 0.25, 0.24 }, { 70, 0.29, 0.275 }, { 80, 0.32, 0.305 }, { 90, 0.35, 0.332 }, { 100, 0.38, 0.356 },
        { 110, 0.40, 0.377 }, { 120, 0.42, 0.396 }, { 130, 0.44, 0.415 }, { 140, 0.46, 0.432 }, { 150, 0.47, 0.447 },
        { 160, 0.49, 0.462 } } },
}

-- Normal stiffness, MPa/m, over closure, mm.
thesis.stiffness = { table = "4.5", label = "closure, mm", rows = {
    { 0.04, 162727, 152939 }, { 0.06, 203939, 196752 }, { 0.08, 253720, 262490 }, { 0.10, 359565, 367654 },
    { 0.12, 530212, 551458 }, { 0.14, 832889, 917475 }, { 0.16, 1548759, 1819283 }, { 0.18, 4267200, 5193935 } } }

thesis.peaks = {
    { table = "4.6", varies = "stress", label = "sigma_n, MPa", rows = {
        { 0.5, 0.36, 0.38 }, { 2, 1.23, 1.25 }, { 3, 1.76, 1.78 }, { 4, 2.26, 2.29 }, { 5, 2.75, 2.78 }, { 6, 3.22, 3.26 },
        { 7, 3.68, 3.72 }, { 8, 4.14, 4.17 }, { 9, 4.58, 4.62 }, { 10, 5.02, 5.05 } } },
    { table = "4.7", varies = "jrco", label = "JRC_o", rows = {
        { 2, 2.07, 2.09 }, { 4, 2.31, 2.34 }, { 6, 2.53, 2.56 }, { 8, 2.75, 2.78 }, { 10, 2.95, 2.98 }, { 12, 3.14, 3.17 },
        { 14, 3.31, 3.34 }, { 16, 3.48, 3.50 }, { 18, 3.63, 3.65 }, { 20, 3.77, 3.79 } } },
    { table = "4.9", varies = "jcso", label = "JCS_o, MPa", rows = {
        { 40, 2.43, 2.48 }, { 50, 2.51, 2.55 }, { 60, 2.57, 2.61 }, { 70, 2.62, 2.66 }, { 80, 2.67, 2.71 },
        { 90, 2.71, 2.75 }, { 100, 2.75, 2.78 }, { 110, 2.78, 2.82 }, { 120, 2.81, 2.85 }, { 130, 2.84, 2.87 },
        { 140, 2.87, 2.89 } } },
    { table = "4.10", varies = "resfriction", label = "phi_r, degrees", rows = {
        { 10, 1.70, 1.73 }, { 15, 2.21, 2.24 }, { 20, 2.75, 2.78 }, { 25, 3.35, 3.38 }, { 30, 4.02, 4.05 },
        { 35, 4.79, 4.82 }, { 40, 5.71, 5.72 } } },
}

thesis.residual = { table = "4.7, second", varies = "resfriction", label = "phi_r, degrees", rows = { { 10, 0.88, 0.82 } } }

-- Tangent shear stiffness, MPa/m, over shear displacement, mm: as printed; the equations do not give it.
thesis.shear_stiffness = { table = "4.11", rows = {
    { 0.02, 27078, 25500 }, { 0.04, 19291, 18750 }, { 0.06, 12234, 13333 }, { 0.08, 7862, 8625 }, { 0.10, 5160, 5900 },
    { 0.12, 3406, 3910 }, { 0.14, 2399, 2817 }, { 0.16, 1741, 2063 }, { 0.18, 1264, 1510 } } }

-- Misprints and omissions.
thesis.misprints = {
    "Table 4.3, row 110: the difference is printed as 5.99 %; its own pair, 0.18 and 0.167, gives 7.22 %.",
    "Table 4.5: the headings of the two columns are exchanged; the text promises nine points, eight are printed.",
    "Table 4.6, row 0.5: the difference is taken of the numerical value, in all other rows of the empirical one.",
    "Two tables are called 4.7, and none 4.8. The numerical residual strength, 0.82, is below the lowest that the law allows, 0.8816.",
    "Table 4.10: its caption leaves out the normal stress, 5 MPa.",
    "Numerical peaks (4.6 to 4.10) are 0.009 to 0.047 MPa above the law's, which no run of the law can be.",
    "Equations (2.12) and (2.20), dilation, print JCS; the worked example and the listing have JCS_n.",
    "Equation (2.15), displacement of the peak, has L_o under the root; Barton and Bandis (1982) have L_n, and so has kaya.",
    "Equation (2.37) has its inequality the wrong way round; (2.46) has a Δδ too many.",
}

-- The values of one row: the standard ones, those of the table, that of the row.
function thesis.values(tab, row)
    local v = {}
    for word, value in pairs(thesis.standard) do v[word] = value end
    for word, value in pairs(tab.others or {}) do v[word] = value end
    if tab.varies then v[tab.varies] = row[1] end
    return v
end

return thesis
