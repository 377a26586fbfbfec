-- A separate stream of numbers from 0 to 1 for each seed, so that case 17 does not depend on earlier cases: the generator of Park and
-- Miller (1988) with the multiplier 48271.
return function(seed)
    local state = (seed * 7919 + 12345) % 2147483647
    if state == 0 then state = 1 end
    local function draw()
        state = state * 48271 % 2147483647
        return state / 2147483647
    end
    for _ = 1, 5 do draw() end
    return draw
end
