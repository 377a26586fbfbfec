#include "system/sentence.hpp"

#include <unistd.h>

namespace kaya {

bool Sentence::write() const {
    std::size_t done = 0;
    while (done < length_) {
        const ssize_t n = ::write(STDERR_FILENO, text_ + done, length_ - done);
        if (n <= 0) return false;
        done += static_cast<std::size_t>(n);
    }
    return true;
}

} // namespace kaya
