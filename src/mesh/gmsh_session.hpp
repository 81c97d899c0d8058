// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace crackle::meshing {

/// libgmsh between its initialisation and finalisation, silent. Only one at a time.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

}  // namespace crackle::meshing
