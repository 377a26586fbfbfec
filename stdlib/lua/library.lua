-- The names for every Lua chunk of a deck. The program calls it with `native`, functions written in C++, and `trusted`; it returns the
-- table of names. Lua's own libraries are included as far as they are harmless: they start no program, load no library, and open no file
-- outside of the working folder.

local native, trusted = ...
local library = {}

local harmless = {
    "assert", "error", "getmetatable", "ipairs", "next", "pcall", "rawequal", "rawget", "rawlen", "rawset",
    "select", "tonumber", "tostring", "type", "xpcall",
}
for _, name in ipairs(harmless) do
    library[name] = _G[name]
end

local function copy(from, names)
    local result = {}
    for name, value in next, from do
        result[name] = value
    end
    for _, name in ipairs(names) do
        result[name] = nil
    end
    return result
end

-- No hook interrupts the handler of an error that was raised to stop the script, so such an error bypasses the handler.
function library.xpcall(f, handler, ...)
    return xpcall(f, function(problem)
        if native.stopping() then
            return problem
        end
        return handler(problem)
    end, ...)
end

-- One call into Lua's own library cannot be interrupted, so its work has bounds. Texts find these as their methods, too.
local most_bytes, most_elements = 2 ^ 30, 2 ^ 25
local repeated, moved = string.rep, table.move

function string.rep(text, count, separator)
    local size = #text + #(separator or "")
    if size == 0 then
        return ""
    elseif (math.tointeger(count) or 0) > most_bytes / size then
        native.fail("string.rep would make a text of more than 1 GB", "write it to a file piece by piece")
    end
    return repeated(text, count, separator)
end

function table.move(from, first, last, ...)
    if (math.tointeger(last) or 0) - (math.tointeger(first) or 0) >= most_elements then
        native.fail("table.move is given more elements than a table can have", "look at its second and third number")
    end
    return moved(from, first, last, ...)
end

library.string = copy(string, { "dump" })
library.table = copy(table, {})
library.utf8 = copy(utf8, {})
library.math = copy(math, {})

-- A missing name raises an error instead of being nil.
local function refusing(values, name)
    return setmetatable(values, {
        __index = function(_, key)
            local whole = name .. "." .. tostring(key)
            native.fail(whole .. " cannot be used in a deck", "run with --trust to allow it")
        end,
    })
end

library.os = refusing({
    clock = os.clock,
    date = os.date,
    difftime = os.difftime,
    time = os.time,
}, "os")
library.debug = refusing({ traceback = debug.traceback }, "debug")
library.package = refusing({}, "package")

-- Finalizers would run at an unpredictable moment.
function library.setmetatable(value, metatable)
    if type(metatable) == "table" and rawget(metatable, "__gc") ~= nil then
        native.fail("a metatable with __gc cannot be used in a deck", "leave __gc out")
    end
    return setmetatable(value, metatable)
end

-- pairs in a fixed order (numbers, texts, then pointers, each ascending): the same deck does the same work in
-- the same order in every run. Keys of other kinds come last.
local rank = { number = 1, string = 2, userdata = 3 }

local function before(a, b)
    local rank_a, rank_b = rank[type(a)] or 4, rank[type(b)] or 4
    if rank_a ~= rank_b then
        return rank_a < rank_b
    elseif rank_a <= 2 then
        return a < b
    elseif rank_a == 3 then
        return native.order(a) < native.order(b)
    end
    return false
end

function library.pairs(value)
    local metatable = getmetatable(value)
    if type(value) ~= "table" or (type(metatable) == "table" and metatable.__pairs) then
        return pairs(value)
    end
    local keys, count = {}, 0
    for key in next, value do
        count = count + 1
        keys[count] = key
    end
    table.sort(keys, before)
    local at = 0
    local function following()
        while at < count do
            at = at + 1
            local key = keys[at]
            local found = value[key]
            if found ~= nil then
                return key, found
            end
        end
    end
    return following, value, nil
end

-- Random numbers come from the generator of the model, so that they are the same in every run and continue after save and restore.
function library.math.random(low, high)
    if not low then
        return native.uniform()
    elseif not high then
        low, high = 1, low
    end
    if low > high then
        native.fail("the range of math.random is empty", "the first number must not be above the second")
    end
    return low + math.floor(native.uniform() * (high - low + 1))
end

function library.math.randomseed(seed)
    native.seed(math.tointeger(seed) or native.fail("math.randomseed needs a whole number", "such as 42"))
end

function library.load(text, name, _, environment)
    if type(text) ~= "string" then
        native.fail("load needs a text", "give it the Lua text to be run")
    end
    return load(text, name, "t", environment or native.environment())
end

library.print = function(...)
    local words = table.pack(...)
    for i = 1, words.n do
        words[i] = tostring(words[i])
    end
    native.print(table.concat(words, "\t"))
end

-- `restore` runs the chunks of a saved model again for their definitions, which must not change any file: a file that a chunk opens for
-- writing is opened at the first write after that, and the write is appended.
local function opened_later(open)
    local file, real = {}, nil
    local methods = {}
    for _, name in ipairs { "write", "flush", "setvbuf", "seek", "read", "lines" } do
        methods[name] = function(_, ...)
            if native.restoring() then
                return name == "lines" and function() end or name == "write" and file or nil
            end
            real = real or assert(open())
            local results = table.pack(real[name](real, ...))
            if results[1] == real then
                return file
            end
            return table.unpack(results, 1, results.n)
        end
    end
    function methods.close()
        return real == nil or real:close()
    end
    return setmetatable(file, { __index = methods, __name = "FILE*", __metatable = false })
end

local function open_file(name, mode)
    mode = mode or "r"
    if type(mode) ~= "string" or not mode:find("^[rwa]%+?b?$") then
        native.fail(("io.open does not know the mode '%s'"):format(mode), "r reads, w writes, a appends; r+ reads and writes")
    end
    if mode:find("[wa+]") and native.restoring() then
        native.require_file(name, mode)
        return opened_later(function() return native.open_file(name, (mode:gsub("w", "a"))) end)
    end
    return native.open_file(name, mode)
end

-- The file is closed at its end.
local function lines_of(name, ...)
    local file, why = open_file(name)
    if not file then
        native.fail(why, "check the name and the folder")
    end
    local next_line = file:lines(...)
    return function()
        local results = table.pack(next_line())
        if results[1] == nil then
            file:close()
        end
        return table.unpack(results, 1, results.n)
    end
end

library.io = refusing({
    open = open_file,
    lines = lines_of,
    write = function(...) native.write(table.concat { ... }) end,
}, "io")

library.require = native.require
library.vector = native.vector
library.command = native.command
library.capture = native.capture
library.nearest = native.nearest
library.count = native.count
library.property = native.property
library.set_property = native.set_property

-- contacts(), blocks(), ...: one function for each table of the model.
for _, name in ipairs(native.tables()) do
    library[name .. "s"] = function(...)
        -- `for b in blocks do` calls it as an iterator, for ever.
        if select("#", ...) > 0 then
            native.fail(("'%ss' takes no values"):format(name), ("write: for x in %ss() do ... end"):format(name))
        end
        return native.list(name)
    end
end

for word, way in next, { sum = "sum", minimum = "minimum", maximum = "maximum", mean = "mean" } do
    library[word] = function(table_name, field) return native.reduce(table_name, field, way) end
end

-- A file name as a word of a command.
local function quoted(name)
    if type(name) ~= "string" then
        native.fail("a model is saved and restored by the name of a file", "write it in quotes")
    end
    return "'" .. name:gsub("'", "''") .. "'"
end

local calls = {
    reset = function() native.command("new") end,
    save = function(name) native.command("save " .. quoted(name)) end,
    restore = function(name) native.command("restore " .. quoted(name)) end,
}

library.model = setmetatable({}, {
    __index = function(model, name) return calls[name] or native.read_model(model, name) end,
    __newindex = native.write_model,
    __metatable = false,
})

-- Numbered tables: tables[1].y, tables[1]:at(0.5), tables[2] = { x = {...}, y = {...} } or { {x, y}, ... }.
library.tables = setmetatable({}, {
    __index = function(_, number)
        local found = native.read_table(number)
        if found then
            found.at = function(_, x) return native.table_value(number, x) end
        end
        return found
    end,
    __newindex = function(_, number, points)
        if type(points) ~= "table" then
            native.fail("a table is made of points", "write tables[1] = { x = {...}, y = {...} }, or { {x, y}, ... }")
        end
        local x, y = points.x, points.y
        if type(x) ~= "table" or type(y) ~= "table" then
            x, y = {}, {}
            for i, point in ipairs(points) do
                if type(point) ~= "table" then
                    native.fail("point " .. i .. " of table " .. tostring(number) .. " is not { x, y }", "write { {0, 1}, {2, 3} }")
                end
                x[i], y[i] = point[1] or false, point[2] or false
            end
        end
        native.write_table(number, x, y)
    end,
    __metatable = false,
})

library.fish = setmetatable({}, {
    __index = function(_, name) return native.read_fish(name) end,
    __newindex = function(_, name, value)
        if type(value) == "table" and not native.is_array(value) then
            local values = table.move(value, 1, #value, 1, { dimensions = { #value } })
            value = native.as_array(values)
        end
        native.write_fish(name, value)
    end,
    __metatable = false,
})

library.hook = {
    before_cycle = function(f, interval) return native.add_hook("before_cycle", f, interval) end,
    after_forces = function(f, interval) return native.add_hook("after_forces", f, interval) end,
    after_cycle = function(f, interval) return native.add_hook("after_cycle", f, interval) end,
    remove = native.remove_hook,
}

-- A function becomes a global function with a unique name, which the command `history` can use.
library.history = setmetatable({
    add = function(what)
        if type(what) == "function" then
            local name = native.name_history()
            native.environment()[name] = what
            what = name
        elseif type(what) ~= "string" then
            native.fail("history.add needs a function", "or the name of a FISH variable as a text")
        end
        native.command("history @" .. what)
    end,
}, {
    __index = function(_, name) return native.history(name) end,
    __newindex = function() native.fail("histories can be read, not set", "history.add makes one") end,
    __metatable = false,
})

if trusted then
    for _, name in ipairs { "debug", "package", "dofile", "loadfile" } do
        library[name] = _G[name]
    end
    library.io, library.os = copy(io, {}), copy(os, {})
    library.io.open = open_file
    function library.io.popen(...)
        local words = table.pack(...)
        local function start() return io.popen(table.unpack(words, 1, words.n)) end
        return native.restoring() and opened_later(start) or start()
    end
    for _, name in ipairs { "execute", "exit", "remove", "rename", "tmpname" } do
        library.os[name] = function(...)
            if not native.restoring() then
                return os[name](...)
            end
        end
    end
    function library.io.output(...)
        if native.restoring() then
            return io.output()
        end
        return io.output(...)
    end
end

return library
