// A scene as one soft body of Bullet 3: nodes and links, stepped without a world, so that Bullet spends no
// time on collision detection that the scene does not need.
#pragma once

#include "sinew/cpu_program.hpp"

namespace sinew::tools {

class BulletBody : public CpuProgram {
public:
    /// Bullet's links have a stiffness k in [0, 1] per iteration, without unit; an iteration moves a position
    /// by -k C / (w_a + w_b) (PBD). With w = w_a + w_b, k = w / (w + compliance / h^2) makes one iteration
    /// per substep of h equal to XPBD; with n iterations, k_n = 1 - (1 - k)^(1/n) leaves the same residual of
    /// a single link. Bullet thus gets the material as exactly as possible. `scene` may only have springs,
    /// masses and gravity.
    BulletBody(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t iterations);
    ~BulletBody() override;
    BulletBody(const BulletBody&) = delete;
    BulletBody& operator=(const BulletBody&) = delete;

    void step() override;
    std::vector<Eigen::Vector3d> positions() const override;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace sinew::tools
