-- at_times(often, word, lines): gives lines of a deck with the probability `often`, and notes the word. Gives whether it did.
return function(draw, words)
    return function(often, word, lines)
        if draw() >= often then return false end
        words[#words + 1] = word
        command(lines)
        return true
    end
end
