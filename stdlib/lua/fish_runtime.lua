-- Functions for translated FISH where Lua differs: arrays with one or more dimensions, loops over lists. The program calls it with `fail`,
-- functions that stop with a message, and `whole(x)`: x as a whole number, or nil. A FISH array is a Lua table: elements 1 to n, row by
-- row; `dimensions` holds the sizes. The two most used functions, element and set_element for one dimension, are written in C++.

local fail, whole = ...
local runtime = { list_kind = { __name = "array" }, grid_kind = { __name = "array" } }
local most_elements = 2 ^ 27

function runtime.is_array(value)
    if type(value) ~= "table" then
        return false
    end
    local kind = getmetatable(value)
    return kind == runtime.list_kind or kind == runtime.grid_kind
end

-- Makes an array of a table that holds its elements and its `dimensions`.
function runtime.as_array(values)
    return setmetatable(values, #values.dimensions == 1 and runtime.list_kind or runtime.grid_kind)
end

local function same_sizes(array, sizes)
    if not runtime.is_array(array) or #array.dimensions ~= #sizes then
        return false
    end
    for i, extent in ipairs(array.dimensions) do
        if extent ~= sizes[i] then
            return false
        end
    end
    return true
end

-- Result of the statement `array name(...)`. `old` is the present value of the variable: an array of the same sizes is kept, because decks
-- repeat the statement in a loop that fills the array.
function runtime.array(name, old, ...)
    local values = { dimensions = { ... } }
    local size = 1
    for i, extent in ipairs(values.dimensions) do
        local number = whole(extent)
        if not number or number < 1 then
            fail.size(name, extent)
        end
        values.dimensions[i] = number
        size = size * number
        if size > most_elements then
            fail.too_large(name)
        end
    end
    if same_sizes(old, values.dimensions) then
        return old
    end
    for i = 1, size do
        values[i] = 0
    end
    return runtime.as_array(values)
end

-- Number of the element in the row-by-row order.
local function position(array, name, indices)
    if not runtime.is_array(array) then
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
    if not runtime.is_array(array) then
        local other = runtime.other_element_of(array, name, ...)
        if other ~= nil then
            return other
        end
    end
    return array[position(array, name, { ... })]
end

function runtime.set_element_of(array, name, value, ...)
    if runtime.is_array(array) or not runtime.set_other_element_of(array, name, value, ...) then
        array[position(array, name, { ... })] = value
    end
end

return runtime
