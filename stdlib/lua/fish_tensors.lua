-- Tensors of FISH and their principal values. Returns rows {name, least, most, read}: the numbers of arguments, and a function.

local runtime, native = ...
local stop, describe = native.stop, native.describe
local kind_of, need, types = runtime.kind_of, runtime.need, runtime.types
local rows = {}

local function define(name, least, most, read)
    rows[#rows + 1] = { name, least, most, read }
end

function runtime.new_tensor(...)
    local values = { ... }
    if #values ~= 0 and #values ~= 6 then
        stop(("'tensor' is given %d numbers"):format(#values), "six: xx, yy, zz, xy, xz, yz")
    end
    for i = 1, 6 do
        values[i] = native.number(values[i] or 0)
    end
    return setmetatable(values, types.tensor)
end

define("tensor", 0, 6, runtime.new_tensor)

local function of_tensor(event, sign, apply)
    types.tensor[event] = function(left, right)
        local tensors = (kind_of(left) == "tensor" and 1 or 0) + (kind_of(right) == "tensor" and 1 or 0)
        local scale = type(left) == "number" or type(right) == "number"
        local fits = sign == "+" or sign == "-"
        fits = fits and tensors == 2 or not fits and scale and (sign == "*" or kind_of(left) == "tensor")
        if not fits then
            stop(("%s and %s cannot be combined by '%s'"):format(describe(left), describe(right), sign), "")
        end
        local result = {}
        for i = 1, 6 do
            result[i] = apply(type(left) == "number" and left or left[i], type(right) == "number" and right or right[i])
        end
        return setmetatable(result, types.tensor)
    end
end
for event, operation in pairs(runtime.operations) do
    of_tensor(event, operation[2], operation[1])
end

-- --- principal values ---------------------------------------------------------------------------------

define("tensor.prin", 1, 1, function(t)
    local least, middle, greatest = native.principal(need("tensor", t, "tensor.prin"))
    return native.vector(least, middle, greatest)
end)
define("tensor.prin.dir", 1, 1, function(t)
    local columns = { select(4, native.principal(need("tensor", t, "tensor.prin.dir"))) }
    columns.columns = 3
    return setmetatable(columns, types.matrix)
end)
define("tensor.prin.from", 2, 2, function(values, directions)
    local axes = need("matrix", directions, "tensor.prin.from")
    if not native.is_vector(values) or #axes ~= 9 or axes.columns ~= 3 then
        stop("'tensor.prin.from' takes a vector of principal values and a matrix with their directions as columns", "")
    end
    local function part(i, k)
        local sum = 0.0
        for j, value in ipairs({ values.x, values.y, values.z }) do
            sum = sum + value * axes[3 * i + j] * axes[3 * k + j]
        end
        return sum
    end
    return runtime.new_tensor(part(0, 0), part(1, 1), part(2, 2), part(0, 1), part(0, 2), part(1, 2))
end)

return rows
