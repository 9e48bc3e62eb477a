// Features of a step, and the stages at which they add their passes. compile/features.cpp lists the features;
// compile() orders the stages and names no feature; the solvers name forces, contacts and colliders alone.
#pragma once

#include "sim/model/scene_model.hpp"

#include <map>
#include <memory>
#include <span>
#include <typeindex>

namespace sinew::sim {

struct Feature;
struct Substep;

/// A program under construction.
class Build {
public:
    /// Refers to all of these.
    Build(ProgramBuilder& builder, const SceneModel& of, std::span<const Feature> all)
        : program(builder), model(of), features_(all) {}
    Build(const Build&) = delete;
    Build& operator=(const Build&) = delete;

    ProgramBuilder& program;
    const SceneModel& model;
    ParticleBuffers particles; ///< the solver's state

    /// Stores what a feature needs at later stages, one value of each type.
    template <typename T> T& keep(T value) {
        auto kept = std::make_shared<T>(std::move(value));
        kept_[typeid(T)] = kept;
        return *kept;
    }
    /// Null if nothing of this type was kept.
    template <typename T> T* find() const {
        const auto found = kept_.find(typeid(T));
        return found == kept_.end() ? nullptr : static_cast<T*>(found->second.get());
    }

    using Add = void (*)(Build& build);
    using AddInSubstep = void (*)(Build& build, const Substep& substep);
    /// Calls the functions that the features have for a stage, feature by feature.
    void add(Add Feature::*stage);
    void add(AddInSubstep Feature::*stage, const Substep& substep);

private:
    std::span<const Feature> features_;
    std::map<std::type_index, std::shared_ptr<void>> kept_;
};

/// A substep to which features add passes.
struct Substep {
    const ParticleBuffers& particles; ///< those that the passes read and change
    std::uint32_t index = 0;          ///< from 0
    Kick kick = Kick::whole;
    /// `gauss_seidel`: passes change these, not velocities; else invalid.
    BufferId corrections = {};
    /// Particles before contacts with each other; null if they touch nothing but colliders and planes.
    const ParticleBuffers* predicted = nullptr;
    bool isOpen() const { return corrections != BufferId{}; }
    /// The buffer that passes change beside positions.
    BufferId changed() const { return isOpen() ? corrections : particles.velocities; }
};

/// A feature: a function for each stage at which it adds buffers or passes, in the order of the device. One
/// that a scene does not use adds nothing.
struct Feature {
    const char* name = nullptr;
    Build::Add buffers = nullptr;    ///< before all passes
    Build::Add begin = nullptr;      ///< start of a step
    Build::Add cutBuffers = nullptr; ///< buffers of cuts, which the next stages use
    Build::Add move = nullptr;       ///< before all that depends on where particles are
    Build::Add cut = nullptr;        ///< of a step with a blade, before the phase that solves
    Build::Add open = nullptr;       ///< once a step, before its substeps
    Build::AddInSubstep substepBegin = nullptr;
    Build::AddInSubstep afterLinks = nullptr;    ///< `split` only: before contacts
    Build::AddInSubstep afterContacts = nullptr; ///< projections
    Build::AddInSubstep substepEnd = nullptr;
    Build::Add check = nullptr;   ///< after the check of the state, before it is published
    Build::Add cutEnd = nullptr;  ///< of a step with a blade, after an undone step has restored its buffers
    Build::Add end = nullptr;     ///< after the public state was written
    Build::Add finish = nullptr;  ///< after all other passes of a step
    Build::Add rewrite = nullptr; ///< list of the same name, after the links of cut bodies were put in
    Build::Add skinNormals = nullptr; ///< list of skins, between positions and normals of vertices
    Build::Add skinEnd = nullptr;     ///< end of that list
};

inline void Build::add(Add Feature::*stage) {
    for (const Feature& feature : features_)
        if (feature.*stage) (feature.*stage)(*this);
}

inline void Build::add(AddInSubstep Feature::*stage, const Substep& substep) {
    for (const Feature& feature : features_)
        if (feature.*stage) (feature.*stage)(*this, substep);
}

} // namespace sinew::sim
