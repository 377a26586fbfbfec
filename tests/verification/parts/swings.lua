-- Vibrations about zero.
local swings = {}

-- Cycles for a time, and returns the frequency at which `value()` swings about zero: it crosses zero twice in a period.
function swings.frequency(value, seconds)
    local crossings, before = {}, value()
    local watch = hook.after_cycle(function()
        local now = value()
        if now * before < 0 then crossings[#crossings + 1] = model.time end
        before = now
    end)
    command("cycle time " .. seconds)
    hook.remove(watch)
    return (#crossings - 1) / 2 / (crossings[#crossings] - crossings[1])
end

return swings
