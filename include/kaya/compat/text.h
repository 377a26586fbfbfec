/* SPDX-License-Identifier: MIT */
/* The text class of joint models: std::string that also understands L"wide literals". */
#ifndef KAYA_COMPAT_TEXT_H
#define KAYA_COMPAT_TEXT_H

#include <string>

namespace kaya_compat {

inline std::string narrow(const wchar_t* wide) {
    std::string narrow;
    for (; wide && *wide; ++wide) {
        const auto code = static_cast<unsigned long>(*wide);
        if (code < 0x80) {
            narrow += static_cast<char>(code);
        } else if (code < 0x800) {
            narrow += static_cast<char>(0xc0 | code >> 6);
            narrow += static_cast<char>(0x80 | (code & 0x3f));
        } else if (code < 0x10000) {
            narrow += static_cast<char>(0xe0 | code >> 12);
            narrow += static_cast<char>(0x80 | (code >> 6 & 0x3f));
            narrow += static_cast<char>(0x80 | (code & 0x3f));
        } else {
            narrow += static_cast<char>(0xf0 | code >> 18);
            narrow += static_cast<char>(0x80 | (code >> 12 & 0x3f));
            narrow += static_cast<char>(0x80 | (code >> 6 & 0x3f));
            narrow += static_cast<char>(0x80 | (code & 0x3f));
        }
    }
    return narrow;
}

class text : public std::string {
public:
    using std::string::string;
    text() = default;
    text(const std::string& other) : std::string(other) {}
    text(std::string&& other) : std::string(static_cast<std::string&&>(other)) {}
    text(const char* other) : std::string(other ? other : "") {}
    text(const wchar_t* wide) : std::string(narrow(wide)) {}
    text(const std::wstring& wide) : std::string(narrow(wide.c_str())) {}

    text& operator+=(const text& more) {
        append(more);
        return *this;
    }
    text& operator+=(const std::string& more) {
        append(more);
        return *this;
    }
    text& operator+=(const char* more) {
        append(more);
        return *this;
    }
    text& operator+=(const wchar_t* more) {
        append(narrow(more));
        return *this;
    }
    text& operator+=(char more) {
        push_back(more);
        return *this;
    }

    friend text operator+(const text& a, const text& b) {
        return text(static_cast<const std::string&>(a) + static_cast<const std::string&>(b));
    }
    friend text operator+(const text& a, const char* b) { return text(static_cast<const std::string&>(a) + b); }
    friend text operator+(const char* a, const text& b) { return text(a + static_cast<const std::string&>(b)); }
    friend text operator+(const text& a, const wchar_t* b) {
        return text(static_cast<const std::string&>(a) + narrow(b));
    }
    friend text operator+(const wchar_t* a, const text& b) {
        return text(narrow(a) + static_cast<const std::string&>(b));
    }
    /* Without these a sum with a std::string could be made in two ways. */
    friend text operator+(const text& a, const std::string& b) { return text(static_cast<const std::string&>(a) + b); }
    friend text operator+(const text& a, std::string&& b) { return text(static_cast<const std::string&>(a) + b); }
    friend text operator+(const std::string& a, const text& b) { return text(a + static_cast<const std::string&>(b)); }
    friend text operator+(std::string&& a, const text& b) { return text(a + static_cast<const std::string&>(b)); }
    friend bool operator==(const text& a, const wchar_t* b) { return static_cast<const std::string&>(a) == narrow(b); }
    friend bool operator!=(const text& a, const wchar_t* b) { return static_cast<const std::string&>(a) != narrow(b); }
};

} // namespace kaya_compat

#endif
