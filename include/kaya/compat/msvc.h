/* SPDX-License-Identifier: MIT */
/* For sources that throw std::exception("text"), which only the Microsoft library has. To be included
 * before everything else: `kaya jmodel build` does so, on a compiler line it is -include kaya/compat/msvc.h.
 * It is a macro, so a source that derives a class from std::exception and calls its constructor with
 * blanks or words needs to be compiled without it. */
#ifndef KAYA_COMPAT_MSVC_H
#define KAYA_COMPAT_MSVC_H

#include "kaya/compat/platform.h"
#include "kaya/compat/text.h"

/* Headers that speak of exception() themselves come before the macro. */
#include <array>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <future>
#include <list>
#include <locale>
#include <mutex>
#include <new>
#include <numeric>
#include <random>
#include <regex>
#include <set>
#include <thread>
#include <tuple>
#include <typeinfo>
#include <unordered_map>
#include <unordered_set>

#if !defined(_MSC_VER)
#define exception(...) runtime_error(::kaya_compat::exception_text(__VA_ARGS__))
#endif

namespace kaya_compat {
inline std::string exception_text() { return "std::exception"; }
inline std::string exception_text(const text& words) { return words; }
inline std::string exception_text(const text& words, int) { return words; }
} // namespace kaya_compat

#endif
