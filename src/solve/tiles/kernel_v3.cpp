// SPDX-License-Identifier: GPL-3.0-or-later
#define CRACKLE_LEVEL v3
#define CRACKLE_WIDTH 4
#include "kernel_body.hpp"
