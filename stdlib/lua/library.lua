-- What every Lua chunk of a deck can use. The program calls it with `native`, functions written in C++, and
-- `trusted`; it returns the table of names. Lua's own libraries are taken over as far as they are harmless:
-- nothing here starts a program, loads a library, or opens a file outside of the working folder.

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

library.string = copy(string, { "dump" })
library.table = copy(table, {})
library.utf8 = copy(utf8, {})
library.math = copy(math, {})

-- What is missing says so, instead of being nil.
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

-- Finalizers would run at a moment that nobody can foretell.
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

-- Random numbers come from the generator of the model, so that they are the same in every run and go on after
-- save and restore.
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

library.io = refusing({
    open = function(name, mode) return io.open(native.allowed_path(name), mode) end,
    lines = function(name, ...) return io.lines(native.allowed_path(name), ...) end,
    write = function(...) native.write(table.concat { ... }) end,
}, "io")

library.require = native.require
library.vector = native.vector
library.command = native.command
library.nearest = native.nearest
library.count = native.count

-- contacts(), blocks(), ...: one function for each table of the model.
for _, name in ipairs(native.tables()) do
    library[name .. "s"] = function() return native.list(name) end
end

for word, way in next, { sum = "sum", minimum = "minimum", maximum = "maximum", mean = "mean" } do
    library[word] = function(table_name, field) return native.reduce(table_name, field, way) end
end

library.model = setmetatable({}, {
    __index = native.read_model,
    __newindex = native.write_model,
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

-- A function becomes a global function with a name of its own, which the command `history` can name.
library.history = {
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
}

if trusted then
    for _, name in ipairs { "os", "io", "debug", "package", "dofile", "loadfile" } do
        library[name] = _G[name]
    end
end

return library
