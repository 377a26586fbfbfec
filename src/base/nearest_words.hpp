// The words nearest to one that was typed, beside did_you_mean (diagnostic.hpp), which gives one or none.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace kaya {

/// The `count` candidates with the fewest mistakes between them and `word`, the nearest first; equals keep their order.
std::vector<std::string_view> nearest_words(std::string_view word, std::vector<std::string_view> candidates,
                                            std::size_t count);

} // namespace kaya
