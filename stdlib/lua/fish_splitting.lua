-- Split arguments of FISH: block.vol(::blocks). Returns no rows, since no name is defined.

local runtime, native = ...
local stop, describe = native.stop, native.describe
local kind_of = runtime.kind_of

-- Calls `take` with the elements of the lists at each place.
local function walk(lists, take)
    local members, size = {}, nil
    for i, list in ipairs(lists) do
        local kind = kind_of(list)
        if kind ~= "list" and kind ~= "array" and kind ~= "map" then
            stop(("'::' splits a list, here it is given %s"):format(describe(list)), "")
        end
        members[i] = runtime.members(list)
        size = size or #members[i]
        if #members[i] ~= size then
            stop(("lists of %d and %d elements are split together"):format(size, #members[i]), "")
        end
    end
    local at = {}
    for place = 1, size do
        for i = 1, #lists do
            at[i] = members[i][place]
        end
        take(place, table.unpack(at, 1, #lists))
    end
    return size
end

-- The list of what a call gives for each element.
function runtime.split(call, ...)
    local results = {}
    walk({ ... }, function(place, ...)
        results[place] = call(...) or 0
    end)
    return runtime.make_list(results)
end

-- Sets the same value for each element; with `one_each` those of a list in turn.
function runtime.set_split(set, value, one_each, ...)
    local values = one_each and (kind_of(value) == "list" or kind_of(value) == "array") and value or nil
    if one_each and not values then
        stop(("'=::' gives the elements of a list, here it is given %s"):format(describe(value)), "write = for one value")
    end
    walk({ ... }, function(place, ...)
        if values and values[place] == nil then
            stop(("%d values are given to more elements"):format(#values), "")
        end
        set(values and values[place] or value, ...)
    end)
end

return {}
