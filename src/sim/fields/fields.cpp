// The host side of force fields: surfaces of bodies on grids as triangles by particle, and the checks of a
// step's fields.
#include "sim/fields/fields.hpp"

#include "kernels.hpp"
#include "sim/core/hash.hpp"
#include "sim/lattice/squares.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace sinew::sim::fields {

namespace {

namespace k = kernels;

static_assert(MOST_FIELDS == ranges::mostFields);

constexpr float mostStretch = 2;     // of the diagonal of a face; a longer edge is cut or torn
constexpr float mostStrength = 1e8f; // the largest useful value in float32
constexpr float leastLength = 1e-6f; // [m]

struct Fields {
    layout::FieldPush push{};
    BufferId requests, arguments, bodies, corners, areas;
};

// Triangles of the surface of a grid.
std::vector<Face> trianglesOf(const Grid& grid) {
    std::vector<Face> faces;
    if (grid.nodes[1] > 1) {
        lattice::appendSquares(faces, grid, 0, lattice::Squares::outer);
        return faces;
    }
    std::vector<std::uint32_t> particle(std::size_t{grid.nodes[0]} * grid.nodes[2]);
    for (std::uint32_t i = 0; i < grid.node.size(); ++i) particle[grid.node[i]] = grid.firstParticle + i;
    for (std::uint32_t z = 0; z + 1 < grid.nodes[2]; ++z)
        for (std::uint32_t x = 0; x + 1 < grid.nodes[0]; ++x) {
            if (grid.fill[x + std::size_t{grid.nodes[0] - 1} * z] == 0) continue;
            const std::size_t low = x + std::size_t{grid.nodes[0]} * z, high = low + grid.nodes[0];
            const std::uint32_t a = particle[low], b = particle[low + 1], c = particle[high + 1],
                                d = particle[high];
            faces.push_back({{a, b, c}, 0, false});
            faces.push_back({{a, c, d}, 0, false});
        }
    return faces;
}

// The longest edge at which a triangle of the grid has an area, squared [m^2].
float farthestOf(const Grid& grid) {
    const float longest = mostStretch * grid.restLength[1];
    return longest * longest;
}

// Corners in the order of particles.
struct Surfaces {
    std::vector<layout::FieldCorner> corners;
    std::vector<layout::FieldCorners> ofSlots;
};

void addSurface(Surfaces& surfaces, const Grid& grid, const StateLayout& layout) {
    std::vector<std::vector<layout::FieldCorner>> corners(grid.node.size());
    for (const Face& face : trianglesOf(grid))
        for (std::size_t k = 0; k < 3; ++k) {
            const std::array<std::uint32_t, 3>& p = face.particles;
            corners[p[k] - grid.firstParticle].push_back(
                {{p[k], p[(k + 1) % 3], p[(k + 2) % 3]}, farthestOf(grid)});
        }
    const std::uint32_t closed = grid.nodes[1] > 1 ? FIELD_CLOSED : 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto first = static_cast<std::uint32_t>(surfaces.corners.size());
        const auto count = static_cast<std::uint32_t>(corners[i].size());
        surfaces.ofSlots[layout.slot[grid.firstParticle + i]] = {first, count | closed};
        surfaces.corners.insert(surfaces.corners.end(), corners[i].begin(), corners[i].end());
    }
}

Surfaces surfacesOf(const SceneModel& model) {
    Surfaces surfaces{.corners = {}, .ofSlots = std::vector<layout::FieldCorners>(model.layout.count)};
    for (const Grid& grid : model.scene.grids) addSurface(surfaces, grid, model.layout);
    return surfaces;
}

std::uint32_t groupsOf(std::size_t items) {
    return static_cast<std::uint32_t>((items + GROUP_ITEMS - 1) / GROUP_ITEMS);
}

// Whether squares of differences of such vectors fit into float32.
bool isNear(const Vec3& v) {
    constexpr float farthest = 1e9f;
    return std::abs(v.x) <= farthest && std::abs(v.y) <= farthest && std::abs(v.z) <= farthest;
}

bool isFinite(const ForceField& field) {
    return isNear(field.vector) && isNear(field.center) && std::isfinite(field.radius) &&
           std::isfinite(field.strength) && std::isfinite(field.scale);
}

std::uint32_t kindOf(FieldKind kind) {
    switch (kind) {
    case FieldKind::uniform:
        return FIELD_UNIFORM;
    case FieldKind::radial:
        return FIELD_RADIAL;
    case FieldKind::wind:
        return FIELD_WIND;
    case FieldKind::turbulence:
        return FIELD_TURBULENCE;
    }
    return FIELD_NONE;
}

bool hasEffect(const ForceField& field, std::size_t bodies) {
    return isFinite(field) && (field.radius == 0 || field.radius >= leastLength) &&
           (field.body == ForceField::allBodies || field.body < bodies) &&
           (field.kind != FieldKind::wind || field.strength >= 0) &&
           (field.kind != FieldKind::turbulence || field.scale >= leastLength);
}

layout::FieldRequest onDevice(const ForceField& field) {
    const Vec3 &v = field.vector, &c = field.center;
    return {.vector = {v.x, v.y, v.z, std::clamp(field.strength, -mostStrength, mostStrength)},
            .center = {c.x, c.y, c.z, field.radius},
            .kind = kindOf(field.kind),
            .body = field.body,
            .scale = field.scale,
            .unused0 = 0};
}

void addKick(Build& build, const Substep& substep, const vk::ShaderCode& code, bool isFirst) {
    const Fields& fields = *build.find<Fields>();
    const ParticleBuffers& particles = substep.particles;
    std::vector<BufferId> buffers{fields.requests, fields.bodies,       fields.corners,      fields.areas,
                                  particles.step,  particles.positions, particles.velocities};
    if (substep.isOpen()) buffers.push_back(substep.corrections);
    layout::FieldPush push = fields.push;
    push.isFirst = isFirst ? 1 : 0;
    push.lateKick = substep.kick == Kick::half && !substep.isOpen() ? 0.5f : 0;
    build.program.dispatchIndirect(code, {fields.arguments, FIELDS_APPLIED, push.count}, buffers, push,
                                   remainderConstants(particles.layout));
}

} // namespace

void add(Build& build) {
    ProgramBuilder& program = build.program;
    const SceneModel& model = build.model;
    const std::uint32_t count = model.settings.fields, slots = static_cast<std::uint32_t>(model.layout.count);
    if (count == 0) return;
    Surfaces surfaces = surfacesOf(model);
    const auto corners = static_cast<std::uint32_t>(surfaces.corners.size());
    Fields& fields = build.keep(Fields{
        .push = {slots, count, 0, 0},
        .requests = program.scratch<layout::FieldRequest>("fields.requests", count),
        .arguments = program.scratch<layout::DispatchArguments>("fields.arguments", FIELD_ARGUMENTS),
        .bodies = program.upload("fields.bodies", bodiesOfSlots(model.scene, model.layout, FIELD_NO_BODY)),
        .corners = program.upload("fields.corners_of_slots", surfaces.ofSlots),
        .areas = program.scratch<layout::vec4>("fields.areas", std::max(corners, 1u))});
    program.updateFields(fields.requests, fields.arguments);
    program.program().fields = {groupsOf(corners), groupsOf(slots)};
    if (corners == 0) return;
    program.dispatchIndirect(
        k::measureAreas, {fields.arguments, FIELDS_AREAS, corners},
        {program.upload("fields.corners", surfaces.corners), program.program().positions, fields.areas},
        layout::FieldPush{corners, count, 0, 0});
}

void addPass(Build& build, const Substep& substep) {
    if (!build.find<Fields>()) return;
    addKick(build, substep, k::applyFields, substep.kick == Kick::whole && substep.index == 0);
}

void addOpenPass(Build& build, const Substep& substep) {
    if (!build.find<Fields>() || !substep.isOpen()) return;
    addKick(build, substep, k::applyFieldsOpen, false);
}

void FieldRequests::advance(std::span<const ForceField> fields) noexcept {
    requests_ = {};
    bool areAny = false, blows = false;
    for (std::size_t f = 0; f < std::min<std::size_t>(count_, fields.size()); ++f) {
        if (!hasEffect(fields[f], bodies_)) continue;
        requests_[f] = onDevice(fields[f]);
        areAny = true;
        blows = blows || fields[f].kind == FieldKind::wind;
    }
    arguments_[FIELDS_AREAS] = {blows ? groups_.areas : 0, 1, 1, 0};
    arguments_[FIELDS_APPLIED] = {areAny ? groups_.applied : 0, 1, 1, 0};
}

float FieldRequests::key() const noexcept {
    if (std::ranges::all_of(requests_, [](const auto& request) { return request.kind == FIELD_NONE; }))
        return 0;
    const std::uint64_t hash = fnv1a(std::as_bytes(std::span(requests_)));
    constexpr std::uint32_t exponent = 0x20000000, rest = 0x1fffffff; // a normal number
    return std::bit_cast<float>(exponent | (static_cast<std::uint32_t>(hash >> 32 ^ hash) & rest));
}

float FieldRequests::acceleration() const noexcept {
    float sum = 0;
    for (const layout::FieldRequest& request : requests_) {
        const layout::vec4& v = request.vector;
        if (request.kind == FIELD_UNIFORM) sum += std::hypot(v.x, v.y, v.z);
        if (request.kind == FIELD_RADIAL) sum += std::abs(v.w);
        if (request.kind == FIELD_TURBULENCE) sum += std::numbers::sqrt3_v<float> * std::abs(v.w);
    }
    return sum;
}

} // namespace sinew::sim::fields
