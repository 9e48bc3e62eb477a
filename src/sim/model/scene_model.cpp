// The order of the particles follows from the solver; all other facts do not depend on it.
#include "sim/model/scene_model.hpp"

#include "sim/model/components.hpp"
#include "sim/model/grids.hpp"
#include "sim/model/rounding.hpp"
#include "sim/model/touching.hpp"
#include "sinew/inverse_masses.hpp"

#include <algorithm>
#include <iterator>

namespace sinew::sim {

namespace {

// Calls `derive` the first time.
template <typename T, typename Derive> const T& once(std::optional<T>& fact, const Derive& derive) {
    if (!fact) fact = derive();
    return *fact;
}

StateLayout layoutFor(const SceneModel& model) {
    StateLayout layout = layoutOf(model.scene, model.grids, model.boxes);
    // `gauss_seidel` has at least one slot more, which never moves, for padding colors
    if (model.settings.solver == Solver::gaussSeidel)
        layout.count = paddedCount(model.scene.particles.size() + 1);
    layout.hasRemainders = keepsRemainders(model.scene, model.settings.substeps);
    return layout;
}

} // namespace

SceneModel::SceneModel(const Scene& of, const Settings& with)
    : scene(of), settings(with), inverseMass(inverseMasses(of)),
      grids(with.solver == Solver::split ? computedGrids(of, with) : std::vector<std::uint32_t>{}),
      boxes(boxesOf(of, grids)), layout(layoutFor(*this)) {}

bool SceneModel::isComputed(std::uint32_t grid) const {
    return std::ranges::binary_search(grids, grid);
}

const std::vector<std::uint32_t>& SceneModel::components() const {
    return once(components_, [&] { return linkedComponents(scene, inverseMass); });
}

const std::vector<std::uint32_t>& SceneModel::linkedBodies() const {
    return once(bodies_, [&] { return sim::linkedBodies(scene); });
}

const std::vector<float>& SceneModel::looseRadii() const {
    return once(looseRadii_, [&] { return sim::looseRadii(scene); });
}

bool SceneModel::particlesTouch() const {
    return once(particlesTouch_, [&] { return sim::particlesTouch(inverseMass, looseRadii()); });
}

bool SceneModel::facesTouch() const {
    return once(facesTouch_, [&] { return sim::facesTouch(scene, inverseMass); });
}

const std::vector<Tether>& SceneModel::tethers() const {
    return once(tethers_, [&] {
        std::vector<Tether> sorted;
        std::ranges::copy_if(scene.tethers, std::back_inserter(sorted),
                             [&](const Tether& tether) { return moves(tether.particle); });
        std::ranges::stable_sort(sorted, {}, &Tether::particle); // those of one particle keep their order
        return sorted;
    });
}

} // namespace sinew::sim
