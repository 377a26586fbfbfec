/* SPDX-License-Identifier: MIT */
#include "kaya/compat/jointmodel.h"
