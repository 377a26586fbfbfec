-- What translated FISH needs where Lua differs: arrays with one or more dimensions, loops over lists.
-- Called by the program with `fail(message, hint)` and `whole(x)`; returns the functions by name.
-- A FISH array is a Lua table: elements 1 to n row by row, `dimensions` holds the sizes.

local fail, whole = ...
local runtime = {}
local array_kind = { __name = "array" }

local function is_array(value)
    return type(value) == "table" and getmetatable(value) == array_kind
end

local function refuse_index(array, name, index)
    if not is_array(array) then
        fail.not_array(array, name)
    end
    fail.outside(array, name, index)
end

-- Marks a table that holds its elements and its `dimensions` as an array.
function runtime.as_array(values)
    return setmetatable(values, array_kind)
end

runtime.is_array = is_array

function runtime.array(name, ...)
    local values = { dimensions = { ... } }
    local size = 1
    for i, extent in ipairs(values.dimensions) do
        local number = whole(extent)
        if not number or number < 1 then
            fail.size(name, extent)
        end
        values.dimensions[i] = number
        size = size * number
        if size > 2 ^ 27 then
            fail.too_large(name)
        end
    end
    for i = 1, size do
        values[i] = 0
    end
    return setmetatable(values, array_kind)
end

function runtime.element(array, name, index)
    if is_array(array) and #array.dimensions == 1 then
        local value = array[index]
        if value ~= nil and index ~= "dimensions" then
            return value
        end
    end
    refuse_index(array, name, { index })
end

function runtime.set_element(array, name, index, value)
    if is_array(array) and #array.dimensions == 1 and array[index] ~= nil and index ~= "dimensions" then
        array[index] = value
        return
    end
    refuse_index(array, name, { index })
end

-- Number of the element in the row-by-row order.
local function position(array, name, indices)
    if not is_array(array) then
        fail.not_array(array, name)
    end
    local dimensions = array.dimensions
    if #indices ~= #dimensions then
        fail.outside(array, name, indices)
    end
    local at = 0
    for i, extent in ipairs(dimensions) do
        local index = whole(indices[i])
        if not index or index < 1 or index > extent then
            fail.outside(array, name, indices)
        end
        at = at * extent + index - 1
    end
    return at + 1
end

function runtime.element_of(array, name, ...)
    return array[position(array, name, { ... })]
end

function runtime.set_element_of(array, name, value, ...)
    array[position(array, name, { ... })] = value
end

-- The members of a list one after the other. They are copied first: the body of the loop may change the
-- list and its loop variable.
function runtime.each(list)
    if type(list) ~= "table" then
        fail.not_list(list)
    end
    local members = table.move(list, 1, #list, 1, {})
    local at = 0
    return function()
        at = at + 1
        return members[at]
    end
end

return runtime
