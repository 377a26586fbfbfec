/* SPDX-License-Identifier: MIT */
/* What sources written for another compiler and another program take for granted. */
#ifndef KAYA_COMPAT_PLATFORM_H
#define KAYA_COMPAT_PLATFORM_H

/* A source may include <cmath> inside its own namespace, or use assert() without its header: both do
 * no harm when the header has been included here. The .h forms put abs(double) into the global
 * namespace, so that an unqualified abs does not become the one for whole numbers. */
#include <algorithm>
#include <assert.h>
#include <cassert>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <limits>
#include <map>
#include <math.h>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <stdlib.h>
#include <string>
#include <utility>
#include <vector>

#if !defined(_WIN32)
#ifndef __stdcall
#define __stdcall
#endif
#ifndef __cdecl
#define __cdecl
#endif
#ifndef __forceinline
#define __forceinline inline
#endif
#ifndef __declspec
#define __declspec(what) KAYA_COMPAT_DECLSPEC_##what
#define KAYA_COMPAT_DECLSPEC_dllexport __attribute__((visibility("default")))
#define KAYA_COMPAT_DECLSPEC_dllimport __attribute__((visibility("default")))
#define KAYA_COMPAT_DECLSPEC_noinline __attribute__((noinline))
#define KAYA_COMPAT_DECLSPEC_noreturn __attribute__((noreturn))
#define KAYA_COMPAT_DECLSPEC_novtable
#define KAYA_COMPAT_DECLSPEC_selectany __attribute__((weak))
#define KAYA_COMPAT_DECLSPEC_align(bytes) __attribute__((aligned(bytes)))
#endif
#define EXPORT_TAG __attribute__((visibility("default")))

/* Of the Microsoft library. */
inline int _isnan(double x) { return x != x; }
inline int _finite(double x) { return x - x == 0; }
template <class... Values> int sprintf_s(char* text, std::size_t size, const char* format, Values... values) {
    return std::snprintf(text, size, format, values...);
}
template <std::size_t size, class... Values> int sprintf_s(char (&text)[size], const char* format, Values... values) {
    return std::snprintf(text, size, format, values...);
}
#else
#define EXPORT_TAG __declspec(dllexport)
#endif
#define IMPORT_TAG
#define JMODEL_EXPORT EXPORT_TAG

#define NEWC(what) new what
#define NEW(where) new

#endif
