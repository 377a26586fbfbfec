-- Functions of modern FISH that have no classic name: on lists, maps, texts, numbers, and quantities that follow from one or two others.
-- Returns rows {name, least, most, read, write}: the numbers of arguments, and functions.

local runtime, native = ...
local stop, describe, whole, number = native.stop, native.describe, native.whole, native.number
local A, W = native.readers, native.writers
local own, kind_of, make_list = runtime.own, runtime.kind_of, runtime.make_list
local rows = {}

local function define(name, least, most, read, write)
    rows[#rows + 1] = { name, least, most, read, write }
end

local function truth(value)
    return value and 1 or 0
end

-- A function's first argument, which has to be of that kind.
function runtime.need(kind, value, name)
    if kind_of(value) ~= kind then
        stop(("the first argument of '%s' must be a %s, here it is %s"):format(name, kind, describe(value)), "")
    end
    return value
end
local need = runtime.need

local function need_text(value, name)
    if type(value) ~= "string" then
        stop(("'%s' takes texts, here it is given %s"):format(name, describe(value)), "")
    end
    return value
end

local function need_whole(value, name)
    local result = whole(value)
    if not result then
        stop(("'%s' takes a whole number, here it is given %s"):format(name, describe(value)), "")
    end
    return result
end

local function limited(size, name)
    if size > runtime.most_elements then
        stop(("'%s' would make a list of %d elements"):format(name, size), "at most 134217728 are possible")
    end
    return size
end

-- --- values -------------------------------------------------------------------------------------------

define("list", 0, 50, runtime.new_list)
define("map", 0, 50, runtime.new_map)
define("boolean", 1, 1, function(value)
    return truth(value ~= 0)
end)

-- --- lists --------------------------------------------------------------------------------------------

local function list_function(name, least, most, body)
    define("list." .. name, least, most, function(list, ...)
        return body(need("list", list, "list." .. name), ...)
    end)
end

for _, name in ipairs({ "list.sequence", "list.seq" }) do
    define(name, 0, 200, runtime.new_list)
end
define("list.create", 1, 2, function(size, value)
    local values = {}
    for i = 1, limited(need_whole(size, "list.create"), "list.create") do
        values[i] = own(value or 0)
    end
    return make_list(values)
end)
define("list.size", 1, 1, function(list)
    local kind = kind_of(list)
    return (kind == "list" or kind == "array") and #list or #need("list", list, "list.size")
end)
local function joined(list, ...)
    local values = table.move(list, 1, #list, 1, {})
    for _, value in ipairs({ ... }) do
        values[#values + 1] = own(value)
    end
    return make_list(values)
end
list_function("append", 2, 50, joined)
list_function("prepend", 2, 50, function(list, ...)
    local first = runtime.new_list(...)
    return make_list(table.move(list, 1, #list, #first + 1, first))
end)
local function concatenate(list, ...)
    local values = table.move(list, 1, #list, 1, {})
    for _, other in ipairs({ ... }) do
        need("list", other, "list.concatenate")
        table.move(other, 1, #other, #values + 1, values)
    end
    return make_list(values)
end
list_function("concatenate", 2, 50, concatenate)
list_function("extend", 2, 50, concatenate)
local function place(list, index, name, beyond)
    local at = whole(index)
    if not at or at < 1 or at > #list + beyond then
        stop(("'%s' is given the place %s in a list of %d"):format(name, native.text(index), #list), "")
    end
    return at
end
list_function("at", 2, 2, function(list, index)
    return list[place(list, index, "list.at", 0)]
end)
list_function("insert", 3, 3, function(list, index, value)
    local values = table.move(list, 1, #list, 1, {})
    table.insert(values, place(list, index, "list.insert", 1), own(value))
    return make_list(values)
end)
list_function("remove", 2, 2, function(list, index)
    local values = table.move(list, 1, #list, 1, {})
    table.remove(values, place(list, index, "list.remove", 0))
    return make_list(values)
end)
list_function("range", 3, 3, function(list, first, last)
    return runtime.other_element_of(list, "list.range", first, last)
end)
list_function("resize", 2, 3, function(list, size, value)
    local values = {}
    for i = 1, limited(need_whole(size, "list.resize"), "list.resize") do
        values[i] = list[i] == nil and (value or 0) or list[i]
    end
    return make_list(values)
end)
list_function("reverse", 1, 1, function(list)
    local values = {}
    for i = #list, 1, -1 do
        values[#values + 1] = list[i]
    end
    return make_list(values)
end)
list_function("find.index", 2, 2, function(list, value)
    for i, one in ipairs(list) do
        if one == value then
            return i
        end
    end
    return 0
end)
list_function("count", 2, 2, function(list, value)
    local count = 0
    for _, one in ipairs(list) do
        count = count + truth(one == value)
    end
    return count
end)
list_function("sort", 1, 1, function(list)
    local values, kind = table.move(list, 1, #list, 1, {}), type(list[1])
    for _, value in ipairs(values) do
        if type(value) ~= kind or kind ~= "number" and kind ~= "string" or value ~= value then
            stop(("'list.sort' cannot order %s"):format(describe(value)), "a list of numbers or of texts can be sorted")
        end
    end
    table.sort(values)
    return make_list(values)
end)
list_function("sum", 1, 1, function(list)
    local sum = #list > 0 and list[1] or 0
    for i = 2, #list do
        sum = sum + list[i]
    end
    return sum
end)
local function extreme(name, better)
    list_function(name, 1, 1, function(list)
        local best
        for _, value in ipairs(list) do
            best = (best == nil or better(number(value), best)) and number(value) or best
        end
        if not best then
            stop(("'list.%s' is given an empty list"):format(name), "")
        end
        return best
    end)
end
extreme("max", function(a, b)
    return a > b
end)
extreme("min", function(a, b)
    return a < b
end)

-- --- maps and arrays ----------------------------------------------------------------------------------

local function map_function(name, least, most, body)
    define("map." .. name, least, most, function(map, ...)
        return body(need("map", map, "map." .. name), ...)
    end)
end
map_function("keys", 1, 1, function(map)
    return make_list(runtime.keys_of(map))
end)
map_function("size", 1, 1, function(map)
    local count = 0
    for _ in next, map do
        count = count + 1
    end
    return count
end)
map_function("has", 2, 2, function(map, key)
    return truth(map[key] ~= nil)
end)
map_function("value", 2, 3, function(map, key, otherwise)
    if map[key] == nil and otherwise ~= nil then
        return otherwise
    end
    return runtime.other_element(map, "map.value", key)
end)
map_function("add", 3, 3, function(map, key, value)
    local copy = own(map)
    runtime.set_other_element(copy, "map.add", key, own(value))
    return copy
end)
map_function("remove", 2, 2, function(map, key)
    local copy = own(map)
    copy[key] = nil
    return copy
end)
map_function("merge", 2, 2, function(map, other)
    local copy = own(map)
    for key, value in next, need("map", other, "map.merge") do
        copy[key] = own(value)
    end
    return copy
end)
define("array.copy", 1, 1, function(array)
    need("array", array, "array.copy")
    local copy = table.move(array, 1, #array, 1, { dimensions = table.move(array.dimensions, 1, #array.dimensions, 1, {}) })
    return runtime.as_array(copy)
end)

-- --- tensors ------------------------------------------------------------------------------------------

define("tensor.trace", 1, 1, function(t)
    need("tensor", t, "tensor.trace")
    return t[1] + t[2] + t[3]
end)
define("tensor.i2", 1, 1, function(t)
    need("tensor", t, "tensor.i2")
    return t[1] * t[2] + t[2] * t[3] + t[3] * t[1] - t[4] ^ 2 - t[5] ^ 2 - t[6] ^ 2
end)
define("tensor.j2", 1, 1, function(t)
    need("tensor", t, "tensor.j2")
    return ((t[1] - t[2]) ^ 2 + (t[2] - t[3]) ^ 2 + (t[3] - t[1]) ^ 2) / 6 + t[4] ^ 2 + t[5] ^ 2 + t[6] ^ 2
end)

-- --- texts --------------------------------------------------------------------------------------------

local function text_function(name, least, most, body)
    define("string." .. name, least, most, function(text, ...)
        return body(need_text(text, "string." .. name), ...)
    end)
end
text_function("find", 2, 3, function(text, part, from)
    return string.find(text, need_text(part, "string.find"), from and need_whole(from, "string.find") or 1, true) or 0
end)
text_function("compare", 2, 2, function(text, other)
    other = need_text(other, "string.compare")
    return text == other and 0 or text < other and -1 or 1
end)
text_function("replace", 3, 3, function(text, part, by)
    part, by = need_text(part, "string.replace"), need_text(by, "string.replace")
    if part == "" then
        return text
    end
    return (text:gsub(part:gsub("%p", "%%%0"), (by:gsub("%%", "%%%%"))))
end)
text_function("simplify", 1, 1, function(text)
    return (text:gsub("%s+", " "):gsub("^ ", ""):gsub(" $", ""))
end)
text_function("split", 1, 2, function(text, between)
    local parts, from = {}, 1
    between = need_text(between or " ", "string.split")
    while between ~= "" do
        local first, last = text:find(between, from, true)
        if not first then
            break
        end
        parts[#parts + 1], from = text:sub(from, first - 1), last + 1
    end
    parts[#parts + 1] = text:sub(from)
    return make_list(parts)
end)
define("string.join", 1, 2, function(list, between)
    local parts = {}
    for i, value in ipairs(need("list", list, "string.join")) do
        parts[i] = native.text(value)
    end
    return table.concat(parts, need_text(between or "", "string.join"))
end)
define("type.name", 1, 1, function(value)
    if type(value) == "number" then
        return math.type(value) == "integer" and "int" or "float"
    elseif native.is_vector(value) then
        return "vector"
    end
    return kind_of(value) or type(value) == "string" and "string" or native.is_pointer(value) and "pointer" or type(value)
end)

-- --- numbers ------------------------------------------------------------------------------------------

local function of_number(name, apply)
    define("math." .. name, 1, 1, function(value)
        return apply(number(value))
    end)
end
of_number("ceiling", math.ceil)
of_number("floor", math.floor)
of_number("cosh", function(x)
    return (math.exp(x) + math.exp(-x)) / 2
end)
of_number("sinh", function(x)
    return (math.exp(x) - math.exp(-x)) / 2
end)
of_number("tanh", function(x)
    local part = math.exp(-2 * math.abs(x))
    local size = (1 - part) / (1 + part)
    return x < 0 and -size or size
end)
of_number("isnan", function(x)
    return truth(x ~= x)
end)
of_number("isinf", function(x)
    return truth(x == math.huge or x == -math.huge)
end)
define("math.outer.product", 2, 2, function(a, b)
    if not native.is_vector(a) or not native.is_vector(b) then
        stop("'math.outer.product' takes two vectors", "")
    elseif a ~= b then
        local row = runtime.new_matrix(b)
        row.columns = 3
        return runtime.new_matrix(a) * row
    end
    return runtime.new_tensor(a.x * a.x, a.y * a.y, a.z * a.z, a.x * a.y, a.x * a.z, a.y * a.z)
end)

-- --- the model ----------------------------------------------------------------------------------------

if A["b_type"] then
    define("block.isrigid", 1, 1, function(block)
        return truth(A.b_type(block) == 1)
    end)
end
if A["cx_nforce"] and A["cx_sforce"] then
    define("block.subcontact.sratio", 1, 1, function(sub_contact)
        local normal = A.cx_nforce(sub_contact)
        return normal ~= 0 and A.mag(A.cx_sforce(sub_contact)) / normal or 0.0
    end)
end
-- A face of a contact is the face of its block here.
if A["face_id"] then
    define("block.face.bface", 1, 1, function(face)
        return A.face_id(face) and face
    end)
    define("block.face.gplist", 1, 1, function(face)
        local values = {}
        for i = 1, A.face_ngp(face) do
            values[i] = A.face_gp(face, i)
        end
        return make_list(values)
    end)
end
local ratios = {
    ["ratio-average"] = "average_ratio",
    ["ratio"] = "average_ratio",
    ["ratio-maximum"] = "maximum_ratio",
    ["ratio-local"] = "local_ratio",
    ["unbalanced-maximum"] = "unbalanced_force",
    ["time-total"] = "time",
    ["cycles-total"] = "cycle",
}
define("mech.solve", 1, 1, function(word)
    local field = ratios[need_text(word, "mech.solve"):lower()]
    if not field then
        stop(("'mech.solve' knows no limit '%s'"):format(word),
            "'ratio-average', 'ratio-maximum', 'ratio-local', 'unbalanced-maximum', 'time-total' or 'cycles-total'")
    end
    return native.model_value(field) or 0
end)
define("system.command", 1, 1, native.run_program)

return rows
