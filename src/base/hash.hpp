// A 64-bit digest of state: equal bits give equal digests. Not for security.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace kaya {

class Hash {
public:
    void add(const void* data, std::size_t bytes);
    void add(std::string_view text) {
        add_number(text.size());
        add(text.data(), text.size());
    }
    void add_number(std::uint64_t number) { add(&number, sizeof number); }
    std::uint64_t value() const { return state_; }

private:
    std::uint64_t state_ = 0xcbf29ce484222325ull;
};

} // namespace kaya
