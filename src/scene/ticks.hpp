// Round numbers for axes and colour bars, and the colours.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace kaya {

/// Multiples of 1, 2 or 5 times a power of ten that enclose a range, about five of them; or a wider range around them.
struct Ticks {
    double low = 0, high = 1, step = 1;
    std::vector<double> values() const;
    std::string label(double value) const;
};
Ticks round_ticks(double low, double high, int about = 5);
/// Widens one of two ranges around its middle, so that a unit is as long across as upward on an area of this size.
void make_equal(Ticks& x, Ticks& y, double width, double height);
/// The round length, 1, 2 or 5 times a power of ten, that is nearest below `most`, above 0.
double round_length(double most);
/// A value with four digits, as short as it can be written: 0.006413, -1.25e6.
std::string short_number(double value);

using Colour = std::array<double, 3>;
/// Viridis: its lightness increases evenly, also for red-green colour blindness. `part` is 0 to 1.
Colour sequential_colour(double part);
/// Blue over white to brown.
Colour diverging_colour(double part);
/// Colours of Okabe and Ito, which are distinct with any colour vision; after the eighth they repeat.
Colour named_colour(std::size_t index);

} // namespace kaya
