-- Matrices of FISH. Returns rows {name, least, most, read}: the numbers of arguments, and a function.

local runtime, native = ...
local stop, describe, whole = native.stop, native.describe, native.whole
local own, kind_of, need = runtime.own, runtime.kind_of, runtime.need
local operations = runtime.operations
local types, new_matrix, place_in_tensor = runtime.types, runtime.make_matrix, runtime.place_in_tensor
local rows = {}

local function define(name, least, most, read)
    rows[#rows + 1] = { name, least, most, read }
end

-- --- making and combining -----------------------------------------------------------------------------

local function numbers_of(list)
    local numbers = {}
    for i, value in ipairs(list) do
        numbers[i] = native.number(value)
    end
    return numbers
end

local function matrix_of_rows(rows)
    local values, columns = {}, nil
    for _, row in ipairs(rows) do
        local numbers = numbers_of(kind_of(row) == "list" and row or { row })
        columns = columns or #numbers -- of the first row
        if #numbers ~= columns or columns == 0 then
            stop(("a row of the matrix has %d numbers, and the first has %d"):format(#numbers, columns), "")
        end
        table.move(numbers, 1, columns, #values + 1, values)
    end
    if #values == 0 then
        stop("a matrix has at least one row", "")
    end
    return new_matrix(values, columns)
end

-- matrix(2, 3) of zeros; the matrix of a tensor, the column of a vector, the rows of a list.
function runtime.new_matrix(first, columns)
    if kind_of(first) == "matrix" then
        return own(first)
    elseif kind_of(first) == "list" then
        return matrix_of_rows(first)
    elseif native.is_vector(first) then
        return new_matrix({ first.x, first.y, first.z }, 1)
    elseif kind_of(first) == "tensor" then
        local values = {}
        for i = 1, 9 do
            values[i] = first[place_in_tensor[(i - 1) // 3 + 1][(i - 1) % 3 + 1]]
        end
        return new_matrix(values, 3)
    end
    local rows = whole(first)
    columns = whole(columns or 1)
    if not rows or not columns or rows < 1 or columns < 1 or rows > 1e6 // columns then
        stop("'matrix' takes the numbers of rows and columns, from 1; it has up to 1000000 elements",
            "or a tensor, a vector, a list of rows: matrix(list(list(1,2), list(3,4)))")
    end
    local values = {}
    for i = 1, rows * columns do
        values[i] = 0.0
    end
    return new_matrix(values, columns)
end

define("matrix", 1, 2, runtime.new_matrix)

local function of_matrix(event, sign, combine)
    types.matrix[event] = function(left, right)
        local result = combine(left, right, kind_of(left) == "matrix", kind_of(right) == "matrix")
        if not result then
            stop(("%s and %s cannot be combined by '%s'"):format(describe(left), describe(right), sign),
                "matrices fit when their rows and columns do")
        end
        return result
    end
end

local function each(matrix, apply)
    local values = {}
    for i = 1, #matrix do
        values[i] = apply(matrix[i], i)
    end
    return new_matrix(values, matrix.columns)
end

local function sum_of_matrices(apply)
    return function(left, right, of_left, of_right)
        if of_left and of_right and #left == #right and left.columns == right.columns then
            return each(left, function(value, i) return apply(value, right[i]) end)
        end
    end
end
of_matrix("__add", "+", sum_of_matrices(operations.__add[1]))
of_matrix("__sub", "-", sum_of_matrices(operations.__sub[1]))

local function product_of_matrices(left, right)
    local columns = right.columns
    if left.columns * columns ~= #right then
        return nil
    end
    local values = {}
    for i = 0, #left // left.columns - 1 do
        for k = 1, columns do
            local sum = 0.0
            for j = 1, left.columns do
                sum = sum + left[i * left.columns + j] * right[(j - 1) * columns + k]
            end
            values[i * columns + k] = sum
        end
    end
    return new_matrix(values, columns)
end

of_matrix("__mul", "*", function(left, right, of_left, of_right)
    if type(left) == "number" or type(right) == "number" then
        local scale = type(left) == "number" and left or right
        return each(of_left and left or right, function(value) return value * scale end)
    elseif not of_left or not of_right and not native.is_vector(right) and kind_of(right) ~= "tensor" then
        return nil
    end
    local product = product_of_matrices(left, of_right and right or runtime.new_matrix(right))
    if product and native.is_vector(right) and #product == 3 then
        return native.vector(product[1], product[2], product[3])
    end
    return product
end)
of_matrix("__div", "/", function(left, right, of_left)
    return of_left and type(right) == "number" and each(left, function(value) return runtime.ratio(value, right) end)
end)
types.matrix.__unm = function(matrix)
    return each(matrix, function(value) return -value end)
end

-- --- functions -----------------------------------------------------------------------------------------

local function matrix_function(name, body)
    define("matrix." .. name, 1, 1, function(matrix)
        return body(need("matrix", matrix, "matrix." .. name))
    end)
end
matrix_function("rows", function(matrix)
    return #matrix // matrix.columns
end)
matrix_function("cols", function(matrix)
    return matrix.columns
end)
matrix_function("transpose", function(matrix)
    local rows = #matrix // matrix.columns
    local turned = runtime.new_matrix(matrix.columns, rows)
    for i = 0, #matrix - 1 do
        turned[i % matrix.columns * rows + i // matrix.columns + 1] = matrix[i + 1]
    end
    return turned
end)
local function need_square(matrix, name)
    if #matrix ~= matrix.columns ^ 2 then
        stop(("'%s' takes a matrix with as many rows as columns, here it has %d and %d"):format(name,
            #matrix // matrix.columns, matrix.columns), "")
    end
    return matrix
end
matrix_function("det", function(matrix)
    return native.determinant(need_square(matrix, "matrix.det"), matrix.columns)
end)
matrix_function("inverse", function(matrix)
    local found = native.inverse(need_square(matrix, "matrix.inverse"), matrix.columns)
    found.columns = matrix.columns
    return setmetatable(found, types.matrix)
end)
define("matrix.identity", 1, 1, function(size)
    local made = runtime.new_matrix(size, size)
    for i = 1, size do
        made[(i - 1) * size + i] = 1.0
    end
    return made
end)

return rows
