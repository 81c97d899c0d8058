// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "crackle/fluid/viscous_flow.hpp"

namespace crackle {

/// By LU factors; the order of elimination is kept while the places of the entries are.
SparseSolver sparse_solver();

}  // namespace crackle
