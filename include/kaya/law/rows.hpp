// Loops over the rows of a batch.
#pragma once

/// Before a loop whose rows do not depend on each other, so that the compiler may take several at once.
#ifdef __clang__
#define KAYA_INDEPENDENT_ROWS _Pragma("clang loop vectorize(assume_safety)")
#else
#define KAYA_INDEPENDENT_ROWS _Pragma("GCC ivdep")
#endif
