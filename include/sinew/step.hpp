// The input of a step: its length, gravity, grabs, host colliders and blade.
#pragma once

#include "sinew/export.hpp"
#include "sinew/scene.hpp"

#include <cstdint>
#include <span>

namespace sinew::sim {

/// A grab: holds the particles near one particle and linked to it, and pulls them towards a target. In the
/// first step of a grab the held point is at the target, so that the grab starts without motion. Particles
/// nearer to the first one are held more strongly. Gains are accelerations of all linked particles, so that
/// light and heavy bodies feel alike. The pull is implicit and limited, hence stable for any target up to 1e9
/// m; gains are taken as at most 1e8. Particles that never move are not held.
struct SINEW_API Grab {
    std::uint32_t particle = 0;
    float radius = 0;            ///< [m] around the particle when the grab begins; 0 = this particle alone
    Vec3 target{};               ///< of the held point at the end of the step [m]
    float stiffness = 400;       ///< [1/s^2]; acceleration over distance
    float damping = 40;          ///< [1/s]; acceleration over speed; critical at 2 sqrt(stiffness)
    float maxAcceleration = 100; ///< [m/s^2]
    float maxSpeed = 10;         ///< of the held point on its way to the target [m/s]
};

/// A kinematic collider that the host moves. Particles stay out of it as of a Collider, whatever else they
/// touch: it pushes and carries them, and fast particles do not pass through. It moves and turns at constant
/// speed during a step. In its first step it stands at `pose`. A particle that is inside then, or inside
/// after a change of shape, leaves by the nearest side at 1 m/s and keeps no velocity from that. Planes take
/// precedence: a particle pushed through a plane is put back. A particle between it and a Collider is put in
/// front of the Collider.
struct SINEW_API HostCollider {
    ColliderShape shape = ColliderShape::sphere;
    float radius = 0; ///< [m]; sizes as in Collider
    float halfLength = 0;
    Vec3 halfExtents{};
    float friction = 0.3f;    ///< Coulomb coefficient while sliding, >= 0
    float staticFriction = 0; ///< coefficient before sliding starts; below `friction` = `friction`
    Pose pose{};              ///< at the end of the step; the rotation has unit length
    float maxSpeed = 10;      ///< of any of its points on the way there [m/s]
};

/// The state of a host collider after a step.
struct SINEW_API HostColliderState {
    HostCollider hostCollider{}; ///< as last listed, with its pose at the end of that step
    bool isThere = false;
    std::uint32_t changes = 0; ///< how often it appeared, disappeared, or changed its shape
};

/// Accelerates particles, or blows at them. Fields are not part of Simulation::forces.
enum class FieldKind {
    uniform,   ///< accelerates by `vector`
    radial,    ///< accelerates by `strength` away from `center`; below 0 = towards it
    wind,      ///< air that moves at `vector` presses on the surfaces of bodies on a grid (Scene::grids)
    turbulence ///< accelerates by at most `strength` along each axis, smoothly and at random in space
};

/// A force field in one step. The host lists fields anew in every step, so that it can move and change them.
/// An impulse J on a body of mass M is a uniform field of J / (M dt) in one step.
struct ForceField {
    static constexpr std::uint32_t allBodies = 0xffffffff;

    FieldKind kind = FieldKind::uniform;
    std::uint32_t body = allBodies; ///< index into Scene::bodies, or allBodies: loose particles too
    /// uniform: acceleration [m/s^2]. wind: velocity of the air [m/s]. turbulence: displacement of the
    /// pattern [m]; a host that adds velocity x dt in each step lets it drift. radial: not used.
    Vec3 vector{};
    /// radial: origin. Any kind, if `radius` > 0: centre of the region [m].
    Vec3 center{};
    /// 0 = everywhere; else the field has the share (1 - (d / radius)^2)^2 at a distance d < radius from
    /// `center`, and none beyond [m].
    float radius = 0;
    /// radial, turbulence: acceleration [m/s^2]. wind: half the density of the air times the drag
    /// coefficient [kg/m^3], 0 or more, about 0.6 for air; the pressure is `strength` times the square of the
    /// air's speed along the normal of the surface. Sheets feel both sides, closed bodies their windward
    /// side. A surface that a cut lays open feels none.
    float strength = 0;
    float scale = 1; ///< turbulence: distance over which it changes [m], above 0
};

/// The kinds of Motion, each of which acts once, at the start of a step.
enum class MotionKind {
    addVelocity, ///< adds velocities of a rigid motion
    setVelocity, ///< replaces all velocities by those
    impulse,     ///< adds the velocities of the rigid motion that an impulse and its moment give
    pose,        ///< turns a body about its centre of mass and displaces it, with its velocities
    spawn,       ///< puts a body of Body::isAbsent into the world as the scene has it, turned and displaced
    despawn      ///< takes it out again
};

/// A change of the motion of a body, or of all particles in a region, at the start of one step. It acts on
/// particles that may move, also on sleeping ones, which wake with all that they touch. Poses come first;
/// then velocities change, motion by motion. The centre of mass is that of the particles that a motion acts
/// on, in their place after all poses. Momentum, and angular momentum about that centre, are exact to
/// rounding. Motions are not part of Simulation::forces. They are undone with their step: pass them again
/// with it.
///
/// A pose places a body as if it had always been there: nothing on the way is touched, and no speed follows
/// from it. Contacts with other bodies begin anew; where it overlaps one, they part as in any collision.
/// Links, attachments and grabs hold on to it and pull; a blade's stroke begins anew in it. Previous
/// positions move with it, previous vertices of skins do not. It has no effect on a body with a fixed or
/// driven particle.
///
/// A spawned body has the shape of the scene, no velocity and no memory; a velocity may follow in the same
/// step. It is turned about the centre of mass that it has in the scene, then displaced from there. One that
/// is in the world is placed anew. A body out of the world stands still in one point, absentPlace on all
/// three axes (Body::isAbsent), with no inverse mass: it touches nothing, and other motions leave it there.
/// If several of a step spawn, despawn or pose a body, the last counts.
struct Motion {
    static constexpr std::uint32_t allBodies = 0xffffffff;
    static constexpr float absentPlace = 1e6f; ///< coordinates of all particles of an absent body [m]

    MotionKind kind = MotionKind::addVelocity;
    /// Index into Scene::bodies, with all its pieces but removed ones; or allBodies: loose particles too. A
    /// pose, a spawn and a despawn need one.
    std::uint32_t body = allBodies;
    Vec3 center{}; ///< of the region [m]
    /// 0 = everywhere; else a motion acts on particles nearer to `center` than that, after all poses [m]. Of
    /// a pose, a spawn and a despawn 0.
    float radius = 0;
    /// Velocity of the centre of mass [m/s]; impulse [N s]; of a pose or spawn its displacement [m].
    Vec3 linear{};
    Vec3 angular{}; ///< angular velocity [rad/s]; of an impulse its moment about the centre of mass [N m s]
    Quaternion rotation{}; ///< of a pose or spawn, about the centre of mass; of unit length
};

/// The surface that the edge of a blade sweeps in a step: quads between two poly-lines, each split into two
/// triangles by the diagonal from a point of `from` to the next point of `to`. It cuts links of cuttable
/// bodies (Grid::isCuttable) at their positions at the start of the step, and may end inside a body. Both
/// poly-lines [m] have the same number of points, 2 to ranges::mostBladePoints; any other blade is ignored.
struct SINEW_API Blade {
    std::span<const Vec3> from{}, to{};
    /// True if `from` continues from the last blade's `to`, moved with the material since then: a stroke over
    /// several steps then leaves no link between its sweeps. False begins a stroke.
    bool isCarried = false;
};

/// Cuts every link that is nearer than `radius` to a segment, such as a pointer's ray of limited depth: the
/// simple cut, without a surface. [m]; radius 0 = none.
struct SINEW_API RayCut {
    Vec3 from{}, to{};
    float radius = 0;
};

/// Input of one step.
struct SINEW_API Step {
    /// Length of the step [s], 1e-6 to 0.1; a value outside is taken as the nearer end. Steps may differ:
    /// with `split`, links that a longer step had to soften regain their stiffness within seconds.
    float dt = 1.0f / 60.0f;
    Vec3 gravity{0, -9.81f, 0}; ///< [m/s^2]
    std::uint64_t frame = 0;    ///< increases by one with every step
    /// Targets of the scene's attachments at the end of the step [m], in their order; the points move there
    /// at constant speed, limited by Attachment::maxSpeed. Points that are left out stay. Read only during
    /// record().
    std::span<const Vec3> anchors{};
    /// Grabs 0, 1, ... in this step, at most Settings::grabs; a grab that is not listed, or has a non-finite
    /// number, releases its particles. An entry with another particle than before begins a new grab. Read
    /// only during record().
    std::span<const Grab> grabs{};
    /// Host colliders 0, 1, ..., at most Settings::hostColliders; a host collider that is not listed, has a
    /// non-finite number or an invalid size, is absent and touches nothing. Read only during record().
    std::span<const HostCollider> hostColliders{};
    /// Force fields of this step, at most Settings::fields. A field with a number that is not finite, a
    /// vector beyond 1e9, no such body, or a size below 1e-6 has no effect; a strength counts as at most 1e8.
    /// Read only during record().
    std::span<const ForceField> fields{};
    /// Motions of this step, at most Settings::motions; one that Simulation::faultOf() names a fault of has
    /// no effect. Read only during record().
    std::span<const Motion> motions{};
    /// Wakes all sleeping particles (Settings::sleeps). Not needed for changes that the step itself contains:
    /// another gravity or dt, and other fields than in the step before, wake all; a moving anchor, collider
    /// or host collider wakes what it holds or comes near.
    bool wakes = false;
    /// Declares that the host reads Status::lacksLists of every step. When all recorded steps have finished,
    /// it must record the first step with lacksLists again, with the same frame and input, and all steps
    /// after it. In return most steps have fewer passes. Results do not depend on it, to the bit if dt is the
    /// same in all steps in flight. It may change from step to step; until the step with lacksLists is
    /// recorded again, all other steps are undone, whatever their `repeats` says.
    bool repeats = false;
    Blade blade{}; ///< read only during record(); pass it again if the step was undone
    RayCut ray{};
};

} // namespace sinew::sim
