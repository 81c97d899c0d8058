// SPDX-License-Identifier: GPL-3.0-or-later
#define CRACKLE_LEVEL baseline
#define CRACKLE_WIDTH 2
#include "kernel_body.hpp"
