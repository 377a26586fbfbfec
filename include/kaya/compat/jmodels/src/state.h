/* SPDX-License-Identifier: MIT */
#include "kaya/compat/state.h"
