-- Lists, maps, tensors, matrices and structures of FISH. They are values: who stores one that another variable holds stores a copy (`own`). Arrays and
-- pointers are shared. The program calls this with the functions of translated FISH, to which it adds, and with its own functions.

local runtime, native = ...
local stop, describe, whole = native.stop, native.describe, native.whole
local types = {
    list = { __name = "list" },
    map = { __name = "map" },
    tensor = { __name = "tensor" },
    matrix = { __name = "matrix" }, -- its rows in turn, and `columns`
    structure = { __name = "structure" },
}
local axes = { xx = 1, yy = 2, zz = 3, xy = 4, xz = 5, yz = 6, yx = 4, zx = 5, zy = 6 }
local place_in_tensor = { { 1, 4, 5 }, { 4, 2, 6 }, { 5, 6, 3 } }
-- Names of the members, by name of the kind. They are kept with the variables, under names that no variable has.
local structures = setmetatable({}, {
    __index = function(_, name)
        return native.globals["struct " .. name]
    end,
    __newindex = function(_, name, members)
        native.globals["struct " .. name] = members
    end,
})

local function kind_of(value)
    local kind = type(value) == "table" and getmetatable(value) or nil
    if runtime.is_array(value) then return "array" end
    return kind and types[kind.__name] == kind and kind.__name or nil
end

local function own(value)
    if type(value) ~= "table" then
        return value
    end
    local kind = kind_of(value)
    if not kind or kind == "array" or kind == "tensor" then
        return value
    end
    local copy = {}
    if kind == "structure" then
        copy.kind, copy.values = value.kind, {}
        for i, one in ipairs(value.values) do
            copy.values[i] = own(one)
        end
    else
        for key, one in next, value do
            copy[key] = own(one)
        end
    end
    return setmetatable(copy, types[kind])
end

local function new_matrix(values, columns)
    values.columns = columns
    return setmetatable(values, types.matrix)
end

-- Where an element stands among the values; `...` are its row and its column.
local function matrix_place(matrix, name, ...)
    local row, column = whole((...)), whole(select(2, ...))
    local rows = #matrix // matrix.columns
    if not row or not column or row < 1 or row > rows or column < 1 or column > matrix.columns then
        stop(("%s(%s) is outside of the matrix of %d rows and %d columns"):format(name, native.texts(...), rows,
            matrix.columns), "rows and columns are whole numbers from 1")
    end
    return (row - 1) * matrix.columns + column
end

local function new_list(values)
    return setmetatable(values, types.list)
end

-- Keys of a map: numbers first, then texts, then pointers.
local function keys_of(map)
    local keys, rank = {}, { number = 1, string = 2, userdata = 3 }
    for key in next, map do
        keys[#keys + 1] = key
    end
    table.sort(keys, function(a, b)
        local left, right = rank[type(a)], rank[type(b)]
        if left ~= right then
            return left < right
        end
        if left == 3 then
            return native.order(a) < native.order(b)
        end
        return a < b
    end)
    return keys
end

local function check_key(key)
    local kind = math.type(key) or type(key)
    local fits = kind == "integer" or kind == "string" or kind == "float" and key == key
    if not fits and not native.is_pointer(key) then
        stop(("%s cannot be the key of a map"):format(describe(key)), "a key is a number, a text or a pointer")
    end
    return key
end

-- 'start', 's', 'end', 'e', or a number.
local function list_place(list, name, index)
    if type(index) == "string" then
        local word = index:lower()
        if word == "start" or word == "s" then
            return 1
        elseif word == "end" or word == "e" then
            return #list
        end
    end
    local at = whole(index)
    if not at or at < 1 or at > #list then
        stop(("%s(%s) is outside of the list of %d"):format(name, native.text(index), #list),
            "indices are whole numbers from 1, or 'start' and 'end'")
    end
    return at
end

local function list_element(list, name, index)
    if kind_of(index) == "list" then
        local picked = {}
        for i, at in ipairs(index) do
            picked[i] = list[list_place(list, name, at)]
        end
        return new_list(picked)
    end
    if #list == 0 then
        stop(("the list %s is empty"):format(name), "")
    end
    return list[list_place(list, name, index)]
end

local readers = {
    list = list_element,
    map = function(map, name, key)
        local value = map[check_key(key)]
        if value == nil then
            stop(("the map %s has no key %s"):format(name, describe(key)), "ask before: map.has(m, key)")
        end
        return value
    end,
    tensor = function(tensor, name, index)
        local at = whole(index)
        if not at or at < 1 or at > 6 then
            stop(("%s(%s) is outside of the tensor"):format(name, native.text(index)), "1 to 6: xx, yy, zz, xy, xz, yz")
        end
        return tensor[at]
    end,
    matrix = function(_, name)
        stop(("an element of the matrix %s has a row and a column"):format(name), ("write: %s(1, 2)"):format(name))
    end,
    vector = function(vector, name, index)
        local at = whole(index)
        if not at or at < 1 or at > 3 then
            stop(("%s(%s) is outside of the vector"):format(name, native.text(index)), "1 to 3: x, y, z")
        end
        return vector[("xyz"):sub(at, at)]
    end,
}

-- An element of something that is not an array with one dimension; nil when it has none.
function runtime.other_element(whole_value, name, index)
    local kind = native.is_vector(whole_value) and "vector" or kind_of(whole_value)
    if readers[kind] then
        return readers[kind](whole_value, name, index)
    end
    if type(whole_value) == "function" then
        return native.fish_value(whole_value(index))
    end
end

local writers = {
    list = function(list, name, index, value)
        local word = type(index) == "string" and index:lower() or nil
        if word == "end" or word == "e" then
            list[#list + 1] = value
        elseif word == "start" or word == "s" then
            table.insert(list, 1, value)
        else
            list[list_place(list, name, index)] = value
        end
    end,
    map = function(map, _, key, value)
        map[check_key(key)] = value
    end,
}

-- True when it was set.
function runtime.set_other_element(whole_value, name, index, value)
    local kind = kind_of(whole_value)
    if writers[kind] then
        writers[kind](whole_value, name, index, value)
        return true
    end
    if kind == "matrix" then
        readers.matrix(whole_value, name)
    elseif kind == "tensor" or native.is_vector(whole_value) then
        stop(("the elements of %s cannot be set by their numbers"):format(describe(whole_value)),
            ("write: %s->%s = ..."):format(name, kind == "tensor" and "xx" or "x"))
    end
    return false
end

local function sub_range(list, name, first, last)
    local from, to = whole(first) or list_place(list, name, first), whole(last) or list_place(list, name, last)
    if from < 1 or to > #list or from > to + 1 then
        stop(("%s(%d,%d) is outside of the list of %d"):format(name, from, to, #list), "")
    end
    return from, to
end

-- With several indices: a part of a list, an element of a tensor.
function runtime.other_element_of(whole_value, name, ...)
    local kind, count = kind_of(whole_value), select("#", ...)
    if kind == "list" and count == 2 then
        local from, to = sub_range(whole_value, name, ...)
        return new_list(table.move(whole_value, from, to, 1, {}))
    elseif kind == "tensor" and count == 2 then
        local row = place_in_tensor[whole((...)) or 0]
        local at = row and row[whole(select(2, ...)) or 0]
        if at then
            return whole_value[at]
        end
        stop(("a tensor has rows and columns 1 to 3, not (%s)"):format(native.texts(...)), "")
    elseif kind == "matrix" and count == 2 then
        return whole_value[matrix_place(whole_value, name, ...)]
    elseif type(whole_value) == "function" then
        return native.fish_value(whole_value(...))
    end
end

function runtime.set_other_element_of(whole_value, name, value, ...)
    if kind_of(whole_value) == "matrix" and select("#", ...) == 2 then
        whole_value[matrix_place(whole_value, name, ...)] = native.number(value)
        return true
    end
    if kind_of(whole_value) ~= "list" or select("#", ...) ~= 2 then
        return false
    end
    local from, to = sub_range(whole_value, name, ...)
    if kind_of(value) ~= "list" then
        stop(("a part of the list %s is replaced by %s"):format(name, describe(value)), "give a list, list(1) for one value")
    end
    local rest = table.move(whole_value, to + 1, #whole_value, 1, {})
    for i = #whole_value, from, -1 do
        whole_value[i] = nil
    end
    table.move(value, 1, #value, from, whole_value)
    table.move(rest, 1, #rest, #whole_value + 1, whole_value)
    return true
end

-- The members that a loop visits, as a new table: the body may change what it walks over.
function runtime.members(whole_value)
    local kind = kind_of(whole_value)
    if kind == "map" then
        local values = {}
        for i, key in ipairs(keys_of(whole_value)) do
            values[i] = whole_value[key]
        end
        return values
    elseif native.is_vector(whole_value) then
        return { whole_value.x, whole_value.y, whole_value.z }
    elseif type(whole_value) ~= "table" or kind == "structure" then
        stop(("'loop foreach' needs a list, here it is given %s"):format(describe(whole_value)), "")
    end
    return table.move(whole_value, 1, #whole_value, 1, {})
end

-- The same of a list that nothing else holds.
function runtime.fresh_members(list)
    return kind_of(list) == "list" and list or runtime.members(list)
end

-- --- members: a->b ---------------------------------------------------------------------------------

local function structure_member(structure, name)
    for i, member in ipairs(structures[structure.kind] or {}) do
        if member == name then
            return i
        end
    end
    stop(("the structure '%s' has no member '%s'"):format(structure.kind, name),
        "it has: " .. table.concat(structures[structure.kind] or {}, ", "))
end

local families = { list = "list", map = "map", array = "array", tensor = "tensor", matrix = "matrix" }

-- The function that a->b means for a value of this kind: list.b, block.gp.b, ...
local function method(from, whole_value, name)
    local family
    if native.is_pointer(whole_value) then
        family = native.family(whole_value)
    elseif type(whole_value) == "string" then
        family = "string"
    elseif native.is_vector(whole_value) then
        family = "math"
    else
        family = families[kind_of(whole_value) or ""]
    end
    local called = family and family .. "." .. name
    return called and from[called], called
end

function runtime.member(whole_value, name, ...)
    local kind = kind_of(whole_value)
    if native.is_vector(whole_value) and (name == "x" or name == "y" or name == "z") then
        return whole_value[name]
    elseif kind == "tensor" and axes[name] then
        return whole_value[axes[name]]
    elseif kind == "structure" then
        return whole_value.values[structure_member(whole_value, name)]
    end
    local read, called = method(native.readers, whole_value, name)
    if not read then
        stop(("%s has no '%s'"):format(describe(whole_value), name), called and native.near(called) or "")
    end
    return read(whole_value, ...)
end

-- The value with one member changed: a new vector or tensor; a pointer or structure is the same one.
function runtime.with_member(whole_value, name, value, ...)
    local kind = kind_of(whole_value)
    if native.is_vector(whole_value) and (name == "x" or name == "y" or name == "z") then
        local parts = { x = whole_value.x, y = whole_value.y, z = whole_value.z }
        parts[name] = value
        return native.vector(parts.x, parts.y, parts.z)
    elseif kind == "tensor" and axes[name] then
        local copy = table.move(whole_value, 1, 6, 1, {})
        copy[axes[name]] = native.number(value)
        return setmetatable(copy, types.tensor)
    elseif kind == "structure" then
        whole_value.values[structure_member(whole_value, name)] = own(value)
        return whole_value
    end
    local write, called = method(native.writers, whole_value, name)
    if write then
        if select("#", ...) == 0 then
            write(whole_value, value)
        else
            write(whole_value, ..., value)
        end
        return whole_value
    end
    local readable = called and native.readers[called]
    stop(readable and ("'%s' can be read, not set"):format(called) or ("%s has no '%s'"):format(describe(whole_value), name),
        not readable and called and native.near(called) or "")
end

-- The same where the value is held by nothing that could be set.
function runtime.set_member(whole_value, name, value, ...)
    if native.is_vector(whole_value) or kind_of(whole_value) == "tensor" then
        stop(("'%s' is set in %s that nothing holds"):format(name, describe(whole_value)), "give it to a variable before")
    end
    runtime.with_member(whole_value, name, value, ...)
end

-- --- making values ----------------------------------------------------------------------------------

function runtime.new_list(...)
    local values = { ... }
    for i = 1, #values do
        values[i] = own(values[i])
    end
    return new_list(values)
end

function runtime.new_map(...)
    local map, given = {}, { ... }
    if #given % 2 == 1 then
        stop(("'map' is given %d values"):format(#given), "keys and values in turn: map('a', 1, 'b', 2)")
    end
    for i = 1, #given, 2 do
        map[check_key(given[i])] = own(given[i + 1])
    end
    return setmetatable(map, types.map)
end

function runtime.define_structure(name, ...)
    local members, seen = { ... }, {}
    for _, member in ipairs(members) do
        if seen[member] then
            stop(("the structure '%s' names the member '%s' twice"):format(name, member), "")
        end
        seen[member] = true
    end
    structures[name] = setmetatable(members, types.list)
end

function runtime.new_structure(name, ...)
    local members = structures[name]
    if not members then
        stop(("there is no structure '%s'"):format(name), ("define it before: struct %s(one, two)"):format(name))
    elseif select("#", ...) > #members then
        stop(("the structure '%s' has %d members, here it is given %d"):format(name, #members, select("#", ...)), "")
    end
    local values = { ... }
    for i = 1, #members do
        values[i] = own(values[i] == nil and 0 or values[i])
    end
    return setmetatable({ kind = name, values = values }, types.structure)
end

-- --- arithmetic ---------------------------------------------------------------------------------------

local function elementwise(operation, sign)
    return function(left, right)
        local of_left, of_right = kind_of(left) == "list", kind_of(right) == "list"
        if of_left and of_right and #left ~= #right then
            stop(("lists of %d and %d elements are combined by '%s'"):format(#left, #right, sign), "")
        end
        local result = {}
        for i = 1, #(of_left and left or right) do
            result[i] = operation(of_left and left[i] or left, of_right and right[i] or right)
        end
        return new_list(result)
    end
end

local operations = {
    __add = { function(a, b) return a + b end, "+" },
    __sub = { function(a, b) return a - b end, "-" },
    __mul = { function(a, b) return a * b end, "*" },
    __div = { function(a, b) return runtime.ratio(a, b) end, "/" },
}
for event, operation in pairs(operations) do
    types.list[event] = elementwise(operation[1], operation[2])
end

local function same(left, right)
    if rawequal(left, right) then
        return true
    end
    local kind = kind_of(left)
    if kind ~= kind_of(right) or not kind then
        return false
    end
    if kind == "structure" then
        return left.kind == right.kind and runtime.same_members(left.values, right.values)
    end
    return runtime.same_members(left, right)
end

function runtime.same_members(left, right)
    for key, value in next, left do
        if right[key] ~= value then
            return false
        end
    end
    for key in next, right do
        if left[key] == nil then
            return false
        end
    end
    return true
end
for _, kind in pairs(types) do
    kind.__eq = same
end

runtime.own, runtime.kind_of, runtime.keys_of, runtime.make_list = own, kind_of, keys_of, new_list
runtime.types, runtime.structures, runtime.most_elements = types, structures, 2 ^ 27
runtime.make_matrix, runtime.place_in_tensor, runtime.operations = new_matrix, place_in_tensor, operations

-- What FISH prints.
function runtime.text(value)
    local kind, shown, size = kind_of(value), {}, 0
    local function add(text)
        size = size + #text
        shown[#shown + 1] = size < 1000 and text or nil
        return size < 1000
    end
    if kind == "map" then
        for _, key in ipairs(keys_of(value)) do
            if not add(native.text(key) .. ": " .. native.text(value[key])) then
                break
            end
        end
    elseif kind == "structure" then
        for i, member in ipairs(structures[value.kind] or {}) do
            add(member .. ": " .. native.text(value.values[i]))
        end
    elseif kind == "matrix" then
        for i = 1, #value, value.columns do
            if not add("{" .. native.texts(table.unpack(value, i, i + math.min(value.columns, 100) - 1)):gsub(",", ", ") .. "}") then
                break
            end
        end
    else
        for i = 1, #value do
            if not add(native.text(value[i])) then break end
        end
    end
    local inside = table.concat(shown, ", ") .. (size < 1000 and "" or ", ...")
    if kind == "tensor" then
        return "(" .. inside:gsub(" ", "") .. ")"
    end
    return (kind == "structure" and value.kind or "") .. "{" .. inside .. "}"
end
