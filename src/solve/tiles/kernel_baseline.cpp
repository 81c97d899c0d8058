// SPDX-License-Identifier: GPL-3.0-or-later
#define CRACKLE_LEVEL baseline
#include "kernel_body.hpp"
