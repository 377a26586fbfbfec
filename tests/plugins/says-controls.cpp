// Its texts hold every character that a terminal obeys, but for NUL, tab and the ends of lines.
#include "tests/plugins/plugin.hpp"

#include <stdexcept>
#include <string>

namespace {

std::string controls() {
    std::string text;
    for (char c = 1; c < 32; ++c)
        if (c != '\t' && c != '\n' && c != '\r') text += c;
    text += '\x7f';
    for (int c = 0x80; c < 0xA0; ++c) text += {'\xc2', static_cast<char>(c)};
    return text + "\xff\xe2\x80\xae\xe2\x81\xa6"; // no UTF-8, and two that turn the direction of writing
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static const std::string text = controls();
    static kaya_jmodel model = plugin::working("says-controls");
    model.title = text.c_str();
    model.run = [](kaya_jbatch*) -> ptrdiff_t { throw std::runtime_error(text); };
    return &model;
}
