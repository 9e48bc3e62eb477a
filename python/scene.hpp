// Devices, settings and scenes of the module, over the handles of the C interface.
#pragma once

#include "arrays.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

namespace sinew::python {

template <typename Handle, SinewResult (*destroy)(Handle)> struct Owned {
    Owned() = default;
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;
    ~Owned() {
        if (handle.id != 0) destroy(handle);
    }
    Handle handle{};
};

struct Device : Owned<SinewDevice, sinewDestroyDevice> {
    Device(const std::optional<std::string>& device, bool software, bool validation, const py::bytes& cache) {
        const std::string bytes = cache;
        SinewDeviceRequest request = sinewDefaultDeviceRequest();
        request.device = device ? device->c_str() : nullptr;
        request.isSoftware = software ? 1 : 0;
        request.hasValidation = validation ? 1 : 0;
        request.pipelineCache = bytes.data();
        request.pipelineCacheSize = bytes.size();
        check(sinewCreateDevice(&request, &handle));
    }
    SinewDeviceInfo info() const {
        SinewDeviceInfo info{};
        info.size = sizeof info;
        check(sinewGetDeviceInfo(handle, &info));
        return info;
    }
    py::bytes pipelineCache() const {
        std::size_t size = 0;
        check(sinewGetPipelineCache(handle, &size, nullptr));
        std::string bytes(size, '\0');
        check(sinewGetPipelineCache(handle, &size, bytes.data()));
        return py::bytes(bytes.data(), size);
    }
};

/// Sets members of a description from keyword arguments. Throws TypeError for an unknown one.
class Keywords {
public:
    explicit Keywords(const py::kwargs& given) : given_(py::dict(given)) {}
    template <typename T> void take(const char* name, T& member) {
        if (!given_.contains(name)) return;
        member = given_[name].cast<T>();
        given_.attr("pop")(name);
    }
    void takeFlag(const char* name, std::uint32_t& member) {
        bool flag = member != 0;
        take(name, flag);
        member = flag ? 1 : 0;
    }
    void takeVector(const char* name, SinewVec3& member) {
        Vector vector{member.x, member.y, member.z};
        take(name, vector);
        member = toVec3(vector);
    }
    /// Throws if anything was not taken.
    void finish() const {
        if (given_.empty()) return;
        throw py::type_error("unknown argument " + py::str(py::list(given_)[0]).cast<std::string>());
    }

private:
    py::dict given_;
};

struct Settings {
    SinewSettings values = sinewDefaultSettings();
};

inline SinewSettings settingsOf(const std::optional<Settings>& settings, SinewScene scene) {
    if (settings) return settings->values;
    SinewSettings own{};
    own.size = sizeof own;
    check(sinewGetSceneSettings(scene, &own));
    return own;
}

struct Scene : Owned<SinewScene, sinewDestroyScene> {
    explicit Scene(const std::optional<std::string>& path) {
        check(path ? sinewLoadScene(path->c_str(), &handle) : sinewCreateScene(&handle));
    }

    SinewSceneValues values() const {
        SinewSceneValues values{};
        values.size = sizeof values;
        check(sinewGetSceneValues(handle, &values));
        return values;
    }

    std::uint32_t addParticles(const Floats& positions, const std::optional<Floats>& velocities,
                               const Floats& inverseMasses, const Floats& radii) {
        const std::uint32_t count = rowsOf(positions, 3, "positions");
        if (velocities && rowsOf(*velocities, 3, "velocities") != count)
            throw py::value_error("velocities must have as many rows as positions");
        const PerElement inverseMass(inverseMasses, count, "inverse_masses"), radius(radii, count, "radii");
        std::vector<SinewParticle> particles(count);
        const float* x = positions.data();
        const float* v = velocities ? velocities->data() : nullptr;
        for (std::size_t i = 0; i < count; ++i) {
            SinewParticle& particle = particles[i];
            particle.position = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
            if (v != nullptr) particle.velocity = {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
            particle.inverseMass = inverseMass[static_cast<std::uint32_t>(i)];
            particle.radius = radius[static_cast<std::uint32_t>(i)];
        }
        std::uint32_t first = 0;
        check(sinewAddParticles(handle, count, particles.data(), &first));
        return first;
    }

    void addLinks(const Indices& pairs, const Floats& restLengths, const Floats& compliances) {
        const std::uint32_t count = rowsOf(pairs, 2, "pairs");
        const PerElement length(restLengths, count, "rest_lengths"),
            compliance(compliances, count, "compliances");
        std::vector<SinewLink> links(count);
        for (std::uint32_t i = 0; i < count; ++i)
            links[i] = {pairs.data()[std::size_t{2} * i], pairs.data()[std::size_t{2} * i + 1], length[i],
                        compliance[i]};
        check(sinewAddLinks(handle, count, links.data()));
    }

    void addFixed(const Indices& particles) {
        check(sinewAddFixed(handle, rowsOf(particles, 1, "particles"), particles.data()));
    }

    std::uint32_t addAttachments(const Indices& particles, const Floats& anchors, const Floats& compliances) {
        const std::uint32_t count = rowsOf(particles, 1, "particles");
        if (rowsOf(anchors, 3, "anchors") != count)
            throw py::value_error("anchors must have a row for each particle");
        const PerElement compliance(compliances, count, "compliances");
        std::vector<SinewAttachment> attachments(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            const float* anchor = anchors.data() + std::size_t{3} * i;
            attachments[i] = {particles.data()[i], {anchor[0], anchor[1], anchor[2]}, compliance[i], 0, 0};
        }
        std::uint32_t first = 0;
        check(sinewAddAttachments(handle, count, attachments.data(), &first));
        return first;
    }

    std::uint32_t addBody(const std::string& name, std::uint32_t first, std::uint32_t count) {
        std::uint32_t body = 0;
        check(sinewAddBody(handle, name.c_str(), first, count, &body));
        return body;
    }

    void setAbsent(std::uint32_t body, bool isAbsent) {
        check(sinewSetAbsent(handle, body, isAbsent ? 1 : 0));
    }

    void addPlane(const Vector& normal, float offset, float friction, float restitution) {
        SinewPlane plane = sinewDefaultPlane();
        plane.normal = toVec3(normal);
        plane.offset = offset;
        plane.friction = friction;
        plane.restitution = restitution;
        check(sinewAddPlane(handle, &plane));
    }

    std::uint32_t addCloth(const py::kwargs& given) {
        SinewCloth cloth = sinewDefaultCloth();
        std::string name = "cloth";
        Indices pinned;
        Keywords keywords(given);
        keywords.take("name", name);
        keywords.take("columns", cloth.columns);
        keywords.take("rows", cloth.rows);
        keywords.take("spacing", cloth.spacing);
        keywords.takeVector("origin", cloth.origin);
        keywords.takeVector("right", cloth.right);
        keywords.takeVector("down", cloth.down);
        keywords.take("area_density", cloth.areaDensity);
        keywords.take("membrane_stiffness", cloth.membraneStiffness);
        keywords.take("bending_stiffness", cloth.bendingStiffness);
        keywords.take("skip_stiffness", cloth.skipStiffness);
        keywords.take("thickness", cloth.thickness);
        keywords.take("tethers", cloth.tethers);
        keywords.take("pinned", pinned);
        keywords.takeFlag("cuttable", cloth.isCuttable);
        keywords.take("tear_strain", cloth.tearStrain);
        keywords.take("toughness", cloth.toughness);
        keywords.finish();
        cloth.name = name.c_str();
        cloth.pinned = pinned.data();
        cloth.pinnedCount = rowsOf(pinned, 1, "pinned");
        std::uint32_t body = 0;
        check(sinewAddCloth(handle, &cloth, &body));
        return body;
    }

    std::uint32_t addLattice(const py::kwargs& given) {
        SinewLattice lattice = sinewDefaultLattice();
        std::string name = "lattice";
        std::array<std::uint32_t, 3> cells{1, 1, 1};
        Floats fill;
        Keywords keywords(given);
        keywords.take("name", name);
        keywords.take("cells", cells);
        keywords.takeVector("origin", lattice.origin);
        keywords.take("spacing", lattice.spacing);
        keywords.take("young_modulus", lattice.youngModulus);
        keywords.take("poisson_ratio", lattice.poissonRatio);
        keywords.take("recovery", lattice.recovery);
        keywords.take("density", lattice.density);
        keywords.take("radius", lattice.radius);
        keywords.takeFlag("cuttable", lattice.isCuttable);
        keywords.take("tear_strain", lattice.tearStrain);
        keywords.take("toughness", lattice.toughness);
        keywords.takeFlag("skin", lattice.hasSkin);
        keywords.takeFlag("faces", lattice.hasFaces);
        keywords.take("fill", fill);
        keywords.finish();
        std::ranges::copy(cells, lattice.cells);
        lattice.name = name.c_str();
        lattice.fill = fill.data();
        lattice.fillCount = static_cast<std::size_t>(fill.size());
        std::uint32_t body = 0;
        check(sinewAddLattice(handle, &lattice, &body));
        return body;
    }

    static SinewMesh meshOf(const py::kwargs& given, std::string& name) {
        SinewMesh mesh = sinewDefaultMesh();
        Keywords keywords(given);
        keywords.take("name", name);
        keywords.take("spacing", mesh.spacing);
        keywords.take("resolution", mesh.resolution);
        keywords.take("young_modulus", mesh.youngModulus);
        keywords.take("poisson_ratio", mesh.poissonRatio);
        keywords.take("recovery", mesh.recovery);
        keywords.take("density", mesh.density);
        keywords.takeFlag("touches", mesh.touches);
        keywords.takeFlag("cuttable", mesh.isCuttable);
        keywords.take("tear_strain", mesh.tearStrain);
        keywords.take("toughness", mesh.toughness);
        keywords.finish();
        mesh.name = name.c_str();
        return mesh;
    }

    std::uint32_t addMesh(const Floats& vertices, const Indices& triangles,
                          const std::optional<Floats>& texture, const py::kwargs& given) {
        std::string name = "mesh";
        SinewMesh mesh = meshOf(given, name);
        mesh.vertexCount = rowsOf(vertices, 3, "vertices");
        mesh.triangleCount = rowsOf(triangles, 3, "triangles");
        if (texture) {
            if (rowsOf(*texture, 2, "texture_coordinates") != mesh.vertexCount)
                throw py::value_error("texture_coordinates must have a row for each vertex");
            mesh.textureCoordinates = texture->data();
        }
        std::vector<SinewVec3> corners(mesh.vertexCount);
        std::memcpy(corners.data(), vertices.data(), corners.size() * sizeof(SinewVec3));
        mesh.vertices = corners.data();
        mesh.triangles = triangles.data();
        std::uint32_t body = 0;
        check(sinewAddMesh(handle, &mesh, &body));
        return body;
    }

    std::uint32_t addMeshFile(const std::string& path, float scale, const py::kwargs& given) {
        std::string name = "mesh";
        const SinewMesh mesh = meshOf(given, name);
        std::uint32_t body = 0;
        check(sinewAddMeshFile(handle, path.c_str(), scale, &mesh, &body));
        return body;
    }

    std::uint32_t particles() const {
        SinewSceneCounts counts{};
        counts.size = sizeof counts;
        check(sinewGetSceneCounts(handle, &counts));
        return counts.particles;
    }

    void validate(const std::optional<Settings>& settings) const {
        const SinewSettings given = settingsOf(settings, handle);
        check(sinewValidate(handle, &given));
    }

    std::string describe(const std::optional<Settings>& settings) const {
        const SinewSettings given = settingsOf(settings, handle);
        std::size_t size = 0;
        check(sinewDescribe(handle, &given, &size, nullptr));
        std::string text(size, '\0');
        check(sinewDescribe(handle, &given, &size, text.data()));
        text.resize(size - 1);
        return text;
    }
};

/// The edge of a blade before and after a step.
struct Blade {
    Blade(const Floats& before, const Floats& after, bool continues) : isCarried(continues) {
        const std::uint32_t count = rowsOf(before, 3, "before");
        if (rowsOf(after, 3, "after") != count || count < 2 || count > 256)
            throw py::value_error("before and after must have 2 to 256 points, and as many each");
        from.resize(count);
        to.resize(count);
        std::memcpy(from.data(), before.data(), count * sizeof(SinewVec3));
        std::memcpy(to.data(), after.data(), count * sizeof(SinewVec3));
    }
    std::vector<SinewVec3> from, to;
    bool isCarried;
};

/// Input of a step, with its lists. Not movable: the step leads to them.
struct StepInput {
    StepInput(const SinewStep& before, const std::optional<float>& dt, const std::optional<Vector>& gravity,
              const std::optional<Floats>& anchors, const std::vector<SinewGrab>& grabs,
              const std::vector<SinewField>& fields, const std::vector<SinewHostCollider>& hostColliders,
              const std::vector<SinewMotion>& motions, const Blade* blade)
        : step(before) {
        if (dt) step.dt = *dt;
        if (gravity) step.gravity = toVec3(*gravity);
        if (anchors) {
            points.resize(rowsOf(*anchors, 3, "anchors"));
            std::memcpy(points.data(), anchors->data(), points.size() * sizeof(SinewVec3));
        }
        step.anchors = points.data();
        step.anchorCount = static_cast<std::uint32_t>(points.size());
        step.grabs = grabs.data();
        step.grabCount = static_cast<std::uint32_t>(grabs.size());
        step.fields = fields.data();
        step.fieldCount = static_cast<std::uint32_t>(fields.size());
        step.hostColliders = hostColliders.data();
        step.hostColliderCount = static_cast<std::uint32_t>(hostColliders.size());
        step.motions = motions.data();
        step.motionCount = static_cast<std::uint32_t>(motions.size());
        if (blade == nullptr) return;
        step.bladeFrom = blade->from.data();
        step.bladeTo = blade->to.data();
        step.bladeCount = static_cast<std::uint32_t>(blade->from.size());
        step.bladeIsCarried = blade->isCarried ? 1 : 0;
    }
    StepInput(const StepInput&) = delete;
    StepInput& operator=(const StepInput&) = delete;
    SinewStep step;
    std::vector<SinewVec3> points;
};

/// Runs `call` without the lock of the interpreter.
template <typename Call> void runUnlocked(Call&& call) {
    SinewResult result = SINEW_OK;
    {
        const py::gil_scoped_release release;
        result = call();
    }
    check(result);
}

/// The step by default: that of the scene.
inline SinewStep stepOf(const Scene& scene) {
    const SinewSceneValues values = scene.values();
    SinewStep step = sinewDefaultStep();
    step.dt = values.dt;
    step.gravity = values.gravity;
    return step;
}

/// World and Part, in world.cpp.
void addWorld(py::module_& module);

} // namespace sinew::python
