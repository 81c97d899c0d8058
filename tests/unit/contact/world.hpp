// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "crackle/contact/general_contact.hpp"
#include "crackle/solid/bulk.hpp"
#include "crackle/state/state.hpp"

namespace crackle::test {

/// A mesh turned by `angle` [rad] about the origin and then moved by `shift` [m].
Mesh placed(Mesh mesh, double angle, Vec2 shift);
/// One triangle, counter-clockwise.
Mesh one_triangle(Vec2 a, Vec2 b, Vec2 c);
/// Several bodies as one mesh; nothing joins them.
Mesh together(const std::vector<Mesh>& bodies);

struct WorldMaterial {
  double young_modulus = 1e8;  ///< [Pa]
  double poisson_ratio = 0.25;
  double density = 2000.0;  ///< [kg/m3]
  double damping_ratio = 0.0;
  ContactMaterial contact{1e8, 1e8, 0.0};
};

/// Energies at the displacements before a step [J/m].
struct WorldEnergy {
  double kinetic = 0.0, strain = 0.0, contact = 0.0, height = 0.0;
  double mechanical() const { return kinetic + strain + contact + height; }
};

/// A few elastic bodies in contact, stepped in time.
class World {
 public:
  World(const std::vector<Mesh>& bodies, const WorldMaterial& material);

  State state;
  Vec2 gravity;               ///< [m/s2]
  double mass_damping = 0.0;  ///< [1/s]
  double dt = 0.0;            ///< [s], 0.8 of the stable step

  WorldEnergy step() {
    WorldEnergy e;
    advance(&e);
    return e;
  }
  /// The same, without the energies.
  void advance() { advance(nullptr); }
  Index contacts() const { return contact_.count(state); }
  GeneralContact& contact() { return contact_; }

  /// Holds a body where it is.
  void fix(std::size_t body);
  /// Vertical force that contact puts on a body now [N/m].
  double vertical_force(std::size_t body);
  /// Looks for contacts with nothing but what the state holds, as after a restart.
  void restart() { contact_ = GeneralContact(state, contact_.material()); }
  void throw_body(std::size_t body, Vec2 velocity);
  Vec2 centre(std::size_t body) const;    ///< of mass [m]
  Vec2 momentum(std::size_t body) const;  ///< [kg/s]
  double mass(std::size_t body) const;    ///< [kg/m]
  Vec2 velocity(std::size_t body) const { return (1.0 / mass(body)) * momentum(body); }
  /// Steps for that long [s] with damping by mass, and then without.
  void settle(double duration, double damping);

 private:
  void advance(WorldEnergy* energy);

  std::vector<Index> first_;  // node of a body
  std::vector<double> mass_;  // of a node, fixed or not
  Bulk bulk_;
  GeneralContact contact_;
  std::vector<Vec2> corner_force_, before_;
};

}  // namespace crackle::test
