// The only file that includes Jolt.
#include <Jolt/Jolt.h> // before all others of Jolt

#include "sinew/cpu_program.hpp"

#include <Jolt/Core/Factory.h>
#include <Jolt/Core/JobSystemSingleThreaded.h>
#include <Jolt/Core/JobSystemThreadPool.h>
#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Physics/Body/BodyLock.h>
#include <Jolt/Physics/Collision/BroadPhase/BroadPhaseLayerInterfaceTable.h>
#include <Jolt/Physics/Collision/BroadPhase/ObjectVsBroadPhaseLayerFilterTable.h>
#include <Jolt/Physics/Collision/ObjectLayerPairFilterTable.h>
#include <Jolt/Physics/PhysicsSystem.h>
#include <Jolt/Physics/SoftBody/SoftBodyCreationSettings.h>
#include <Jolt/Physics/SoftBody/SoftBodyMotionProperties.h>
#include <Jolt/RegisterTypes.h>

#include <stdexcept>

namespace sinew::tools {

namespace {

constexpr std::size_t temporaryBytes = std::size_t{64} << 20;

void registerTypes() {
    static const bool isDone = [] {
        JPH::RegisterDefaultAllocator();
        JPH::Factory::sInstance = new JPH::Factory; // lives as long as the program
        JPH::RegisterTypes();
        return true;
    }();
    (void)isDone;
}

JPH::Ref<JPH::SoftBodySharedSettings> bodyOf(const sim::Scene& scene) {
    JPH::Ref<JPH::SoftBodySharedSettings> body = new JPH::SoftBodySharedSettings;
    for (const sim::Particle& p : scene.particles)
        body->mVertices.emplace_back(JPH::Float3(p.position.x, p.position.y, p.position.z),
                                     JPH::Float3(p.velocity.x, p.velocity.y, p.velocity.z), p.inverseMass);
    for (const sim::FixedConstraint& fixed : scene.fixed) body->mVertices[fixed.particle].mInvMass = 0;
    for (const sim::DistanceConstraint& link : scene.distances) {
        body->mEdgeConstraints.emplace_back(link.a, link.b, link.compliance);
        body->mEdgeConstraints.back().mRestLength = link.restLength;
    }
    body->AddFace({0, 1, 2}); // a body without faces has no shape; this one touches nothing
    body->Optimize();
    return body;
}

class JoltBody : public CpuProgram {
public:
    JoltBody(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t threads)
        : dt_(scene.dt), memory_(temporaryBytes) {
        broad_.MapObjectToBroadPhaseLayer(0, JPH::BroadPhaseLayer(0));
        if (threads > 1)
            jobs_ = std::make_unique<JPH::JobSystemThreadPool>(JPH::cMaxPhysicsJobs, JPH::cMaxPhysicsBarriers,
                                                               static_cast<int>(threads) - 1);
        else
            jobs_ = std::make_unique<JPH::JobSystemSingleThreaded>(JPH::cMaxPhysicsJobs);
        world_.Init(1, 0, 1, 1, broad_, broadFilter_, layers_);
        world_.SetGravity({scene.gravity.x, scene.gravity.y, scene.gravity.z});
        JPH::SoftBodyCreationSettings settings(bodyOf(scene), JPH::RVec3::sZero(), JPH::Quat::sIdentity(), 0);
        settings.mNumIterations = substeps;
        settings.mLinearDamping = 0;
        settings.mUpdatePosition = false; // places stay relative to the same point
        settings.mAllowSleeping = false;
        id_ = world_.GetBodyInterface().CreateAndAddSoftBody(settings, JPH::EActivation::Activate);
        if (id_.IsInvalid()) throw std::runtime_error("Jolt makes no soft body of this scene");
    }
    ~JoltBody() override {
        world_.GetBodyInterface().RemoveBody(id_);
        world_.GetBodyInterface().DestroyBody(id_);
    }
    JoltBody(const JoltBody&) = delete;
    JoltBody& operator=(const JoltBody&) = delete;

    void step() override { world_.Update(dt_, 1, &memory_, jobs_.get()); }

    std::vector<Eigen::Vector3d> positions() const override {
        const JPH::BodyLockRead lock(world_.GetBodyLockInterface(), id_);
        const JPH::Body& body = lock.GetBody();
        const auto& motion = static_cast<const JPH::SoftBodyMotionProperties&>(*body.GetMotionProperties());
        const JPH::RVec3 center = body.GetCenterOfMassPosition(); // the body is not turned
        std::vector<Eigen::Vector3d> result;
        for (const JPH::SoftBodyVertex& vertex : motion.GetVertices()) {
            const JPH::RVec3 x = center + vertex.mPosition;
            result.emplace_back(double{x.GetX()}, double{x.GetY()}, double{x.GetZ()});
        }
        return result;
    }

private:
    float dt_; // [s]
    JPH::TempAllocatorImpl memory_;
    std::unique_ptr<JPH::JobSystem> jobs_;
    JPH::BroadPhaseLayerInterfaceTable broad_{1, 1};
    JPH::ObjectLayerPairFilterTable layers_{1}; // no layer collides
    JPH::ObjectVsBroadPhaseLayerFilterTable broadFilter_{broad_, 1, layers_, 1};
    JPH::PhysicsSystem world_;
    JPH::BodyID id_;
};

} // namespace

bool hasJolt() {
    return true;
}

std::unique_ptr<CpuProgram> makeJoltBody(const sim::Scene& scene, std::uint32_t substeps,
                                         std::uint32_t threads) {
    registerTypes();
    return std::make_unique<JoltBody>(scene, substeps, threads);
}

} // namespace sinew::tools
