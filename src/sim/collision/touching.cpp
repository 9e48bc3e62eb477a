// Uses the tests by which compile() decides to add contact passes.
#include "sim/collision/touching.hpp"

#include "sim/collision/face_contacts.hpp"
#include "sim/collision/particle_contacts.hpp"

namespace sinew::sim::collision {

bool particlesTouch(const Scene& scene) {
    return collision::particle_contacts::areIn(scene);
}

bool facesTouch(const Scene& scene) {
    return collision::face_contacts::areIn(scene);
}

} // namespace sinew::sim::collision
