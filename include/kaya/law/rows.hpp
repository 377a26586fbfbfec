/* SPDX-License-Identifier: MIT */
// Loops over the rows of a batch.
#pragma once

/// Before a loop whose rows do not depend on each other, so that the compiler may take several at once. Clang has no such hint without a
/// warning where it takes one at a time all the same.
#ifdef __clang__
#define KAYA_INDEPENDENT_ROWS
#else
#define KAYA_INDEPENDENT_ROWS _Pragma("GCC ivdep")
#endif
