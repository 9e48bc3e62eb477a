// A program on the CPU that computes the motion of a scene, to be compared with.
#pragma once

#include "sinew/scene.hpp"

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace sinew::tools {

class CpuProgram {
public:
    virtual ~CpuProgram() = default;
    virtual void step() = 0; ///< of the scene's length
    virtual std::vector<Eigen::Vector3d> positions() const = 0;
};

/// Whether this program was built with Jolt.
bool hasJolt();

/// A scene as one soft body of Jolt 5, with `substeps` iterations a step, each of which is a step of XPBD of
/// its own. `scene` may only have springs, masses and gravity. Null without Jolt.
std::unique_ptr<CpuProgram> makeJoltBody(const sim::Scene& scene, std::uint32_t substeps,
                                         std::uint32_t threads);

} // namespace sinew::tools
