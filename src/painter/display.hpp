// An X display for a machine without a screen.
#pragma once

#include <string>
#include <sys/types.h>

namespace kaya {

/// Starts Xvfb, which picks a free display number, with a random secret, and ends it again. When this program dies, the system ends Xvfb.
class Display {
public:
    /// Sets DISPLAY and XAUTHORITY. Throws std::runtime_error with a sentence for the user.
    Display();
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

private:
    void make_secret();
    void start();

    std::string folder_; ///< private, holds the secret
    pid_t server_ = -1;
};

} // namespace kaya
