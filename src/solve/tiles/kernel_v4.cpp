// SPDX-License-Identifier: GPL-3.0-or-later
#define CRACKLE_LEVEL v4
#define CRACKLE_WIDTH 8
#include "kernel_body.hpp"
