// The module `sinew._sinew`: classes over the C interface. sinew/__init__.pyi documents them.
#include "arrays.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

namespace sinew::python {

namespace {

/// The exception of the module; its attribute `result` is the name of the result.
PyObject* errorType = nullptr;

} // namespace

void check(SinewResult result) {
    if (result >= 0) return;
    const py::object error = py::handle(errorType)(sinewLastError());
    error.attr("result") = sinewResultName(result);
    PyErr_SetObject(errorType, error.ptr());
    throw py::error_already_set();
}

namespace {

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

constexpr std::array<const char*, 3> solverNames{"jacobi", "split", "gauss_seidel"};

struct Settings {
    SinewSettings values = sinewDefaultSettings();
};

SinewSettings settingsOf(const std::optional<Settings>& settings, SinewScene scene) {
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
        keywords.finish();
        mesh.name = name.c_str();
        return mesh;
    }

    std::uint32_t addMesh(const Floats& vertices, const Indices& triangles, const py::kwargs& given) {
        std::string name = "mesh";
        SinewMesh mesh = meshOf(given, name);
        mesh.vertexCount = rowsOf(vertices, 3, "vertices");
        mesh.triangleCount = rowsOf(triangles, 3, "triangles");
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

struct State : Owned<SinewState, sinewDestroyState> {};

struct Simulation : Owned<SinewSimulation, sinewDestroySimulation> {
    Simulation(std::shared_ptr<Device> itsDevice, const Scene& scene, const std::optional<Settings>& settings)
        : device(std::move(itsDevice)) {
        const SinewSettings given = settingsOf(settings, scene.handle);
        const SinewSceneValues values = scene.values();
        step_.dt = values.dt;
        step_.gravity = values.gravity;
        const py::gil_scoped_release release;
        const SinewResult result = sinewCreateSimulation(device->handle, scene.handle, &given, &handle);
        const py::gil_scoped_acquire acquire;
        check(result);
    }

    void step(std::uint32_t count, const std::optional<float>& dt, const std::optional<Vector>& gravity,
              const std::optional<Floats>& anchors, const std::vector<SinewGrab>& grabs,
              const std::vector<SinewField>& fields) {
        SinewStep step = step_;
        if (dt) step.dt = *dt;
        if (gravity) step.gravity = toVec3(*gravity);
        std::vector<SinewVec3> points;
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
        run([&] { return sinewStep(handle, &step, count); });
    }

    /// Runs `call` without the lock of the interpreter.
    template <typename Call> void run(Call&& call) {
        SinewResult result = SINEW_OK;
        {
            const py::gil_scoped_release release;
            result = call();
        }
        check(result);
    }

    SinewSimulationInfo info() const {
        SinewSimulationInfo info{};
        info.size = sizeof info;
        check(sinewGetSimulationInfo(handle, &info));
        return info;
    }

    py::dict status() const {
        SinewStatus status{};
        status.size = sizeof status;
        const std::uint64_t next = info().nextFrame;
        if (next == 0 || sinewGetStatus(handle, next - 1, &status) != SINEW_OK) return {};
        using namespace py::literals;
        return py::dict("frame"_a = status.frame, "non_finite"_a = status.nonFinite,
                        "slowed"_a = status.slowed, "sleeping"_a = status.sleeping,
                        "lost_time"_a = status.lostTime, "links_cut"_a = status.linksCutInAll,
                        "pieces"_a = status.pieces);
    }

    /// Impulses on bodies in the newest step, with the axes body, kind, part and coordinate.
    py::array_t<float> impulses() const {
        std::uint32_t count = info().bodies;
        std::vector<SinewBodyImpulses> impulses(count);
        const std::uint64_t next = info().nextFrame;
        if (next == 0 || sinewGetBodyImpulses(handle, next - 1, &count, impulses.data()) != SINEW_OK)
            count = 0;
        py::array_t<float> array(std::vector<py::ssize_t>{count, 5, 2, 3});
        static_assert(sizeof(SinewBodyImpulses) == 5 * 2 * 3 * sizeof(float));
        std::memcpy(array.mutable_data(), impulses.data(), count * sizeof(SinewBodyImpulses));
        return array;
    }

    std::vector<std::string> complaints() {
        std::vector<std::string> sentences;
        const char* sentence = nullptr;
        while (sinewNextComplaint(handle, &sentence) == SINEW_OK) sentences.emplace_back(sentence);
        return sentences;
    }

    std::shared_ptr<Device> device; // destroyed after the simulation

private:
    SinewStep step_ = sinewDefaultStep();
};

void addSettings(py::module_& module) {
    py::class_<Settings> type(module, "Settings");
    type.def(py::init([](const py::kwargs& given) {
        const auto settings = std::make_unique<Settings>();
        const py::object self = py::cast(settings.get(), py::return_value_policy::reference);
        for (const auto& [name, value] : given) {
            if (!py::hasattr(self, name))
                throw py::type_error("unknown argument " + name.cast<std::string>());
            py::setattr(self, name, value);
        }
        return *settings;
    }));
    const auto add = [&](const char* name, auto member) {
        using Value = std::remove_reference_t<decltype(std::declval<SinewSettings&>().*member)>;
        type.def_property(
            name, [member](const Settings& settings) { return settings.values.*member; },
            [member](Settings& settings, Value value) { settings.values.*member = value; });
    };
    const auto addFlag = [&](const char* name, std::uint32_t SinewSettings::*member) {
        type.def_property(
            name, [member](const Settings& settings) { return settings.values.*member != 0; },
            [member](Settings& settings, bool value) { settings.values.*member = value ? 1 : 0; });
    };
    type.def_property(
        "solver", [](const Settings& settings) { return solverNames[settings.values.solver]; },
        [](Settings& settings, const std::string& name) {
            const auto found = std::ranges::find(solverNames, name);
            if (found == std::end(solverNames)) throw py::value_error("there is no solver " + name);
            settings.values.solver = static_cast<std::uint32_t>(found - std::begin(solverNames));
        });
    add("substeps", &SinewSettings::substeps);
    add("iterations", &SinewSettings::iterations);
    add("tolerance", &SinewSettings::tolerance);
    add("contact_margin", &SinewSettings::contactMargin);
    add("contact_room", &SinewSettings::contactRoom);
    add("grabs", &SinewSettings::grabs);
    add("fields", &SinewSettings::fields);
    add("frames_in_flight", &SinewSettings::framesInFlight);
    add("omega", &SinewSettings::omega);
    add("theta", &SinewSettings::theta);
    add("weight", &SinewSettings::weight);
    add("over_relaxation", &SinewSettings::overRelaxation);
    add("warm_start", &SinewSettings::warmStart);
    addFlag("sleeps", &SinewSettings::sleeps);
    addFlag("keeps_forces", &SinewSettings::keepsForces);
}

void addStepInput(py::module_& module) {
    py::class_<SinewGrab>(module, "Grab")
        .def(py::init([](std::uint32_t particle, const Vector& target, float radius, float stiffness,
                         float damping) {
                 SinewGrab grab = sinewDefaultGrab();
                 grab.particle = particle;
                 grab.target = toVec3(target);
                 grab.radius = radius;
                 grab.stiffness = stiffness;
                 grab.damping = damping;
                 return grab;
             }),
             py::arg("particle"), py::arg("target"), py::arg("radius") = 0.0f, py::arg("stiffness") = 400.0f,
             py::arg("damping") = 40.0f);
    py::class_<SinewField>(module, "Field")
        .def(py::init([](const std::string& kind, const Vector& vector, const Vector& center, float radius,
                         float strength, float scale, std::uint32_t body) {
                 constexpr const char* kinds[] = {"uniform", "radial", "wind", "turbulence"};
                 const auto found = std::ranges::find(kinds, kind);
                 if (found == std::end(kinds)) throw py::value_error("there is no field of kind " + kind);
                 return SinewField{static_cast<std::uint32_t>(found - std::begin(kinds)),
                                   body,
                                   toVec3(vector),
                                   toVec3(center),
                                   radius,
                                   strength,
                                   scale};
             }),
             py::arg("kind"), py::arg("vector") = Vector{}, py::arg("center") = Vector{},
             py::arg("radius") = 0.0f, py::arg("strength") = 0.0f, py::arg("scale") = 1.0f,
             py::arg("body") = SINEW_ALL_BODIES);
}

void addSimulation(py::module_& module) {
    py::class_<State, std::shared_ptr<State>>(module, "State");
    const auto output = [](std::uint32_t which) {
        return [which](const py::object& self) {
            const Simulation& simulation = self.cast<const Simulation&>();
            return outputArray(simulation.device->handle, simulation.handle, which, self);
        };
    };
    py::class_<Simulation, std::shared_ptr<Simulation>>(module, "Simulation")
        .def(py::init<std::shared_ptr<Device>, const Scene&, const std::optional<Settings>&>(),
             py::arg("device"), py::arg("scene"), py::arg("settings") = py::none())
        .def("step", &Simulation::step, py::arg("count") = 1, py::arg("dt") = py::none(),
             py::arg("gravity") = py::none(), py::arg("anchors") = py::none(),
             py::arg("grabs") = std::vector<SinewGrab>{}, py::arg("fields") = std::vector<SinewField>{})
        .def("reset", [](Simulation& self) { self.run([&] { return sinewReset(self.handle); }); })
        .def("update_skin", [](Simulation& self) { self.run([&] { return sinewUpdateSkin(self.handle); }); })
        .def("save",
             [](Simulation& self) {
                 auto state = std::make_shared<State>();
                 self.run([&] { return sinewSaveState(self.handle, &state->handle); });
                 return state;
             })
        .def("load",
             [](Simulation& self, const State& state) {
                 self.run([&] { return sinewLoadState(self.handle, state.handle); });
             })
        .def("status", &Simulation::status)
        .def("impulses", &Simulation::impulses)
        .def("complaints", &Simulation::complaints)
        .def_property_readonly("positions", output(SINEW_POSITIONS))
        .def_property_readonly("velocities", output(SINEW_VELOCITIES))
        .def_property_readonly("skin_vertices", output(SINEW_SKIN_VERTICES))
        .def_property_readonly("skin_indices", output(SINEW_SKIN_INDICES))
        .def_property_readonly("pieces", output(SINEW_PIECES))
        .def_property_readonly("substeps", [](const Simulation& self) { return self.info().substeps; })
        .def_property_readonly("steps_done", [](const Simulation& self) { return self.info().stepsDone; });
}

} // namespace

PYBIND11_MODULE(_sinew, module) {
    errorType = PyErr_NewException("sinew.Error", PyExc_RuntimeError, nullptr);
    module.add_object("Error", errorType);
    module.attr("version") = std::to_string(sinewVersion() >> 22) + "." +
                             std::to_string(sinewVersion() >> 12 & 1023) + "." +
                             std::to_string(sinewVersion() & 4095);
    py::class_<Device, std::shared_ptr<Device>>(module, "Device")
        .def(py::init<const std::optional<std::string>&, bool, bool, const py::bytes&>(),
             py::arg("device") = py::none(), py::arg("software") = false, py::arg("validation") = false,
             py::arg("pipeline_cache") = py::bytes(""))
        .def_property_readonly("name", [](const Device& self) { return std::string(self.info().name); })
        .def_property_readonly("is_software", [](const Device& self) { return self.info().isSoftware != 0; })
        .def("pipeline_cache", &Device::pipelineCache);
    addSettings(module);
    addStepInput(module);
    py::class_<Scene>(module, "Scene")
        .def(py::init<const std::optional<std::string>&>(), py::arg("path") = py::none())
        .def("add_particles", &Scene::addParticles, py::arg("positions"), py::arg("velocities") = py::none(),
             py::arg("inverse_masses") = 1.0f, py::arg("radii") = 0.0f)
        .def("add_links", &Scene::addLinks, py::arg("pairs"), py::arg("rest_lengths"),
             py::arg("compliances") = 0.0f)
        .def("add_fixed", &Scene::addFixed, py::arg("particles"))
        .def("add_attachments", &Scene::addAttachments, py::arg("particles"), py::arg("anchors"),
             py::arg("compliances") = 0.0f)
        .def("add_body", &Scene::addBody, py::arg("name"), py::arg("first"), py::arg("count"))
        .def("add_plane", &Scene::addPlane, py::arg("normal") = Vector{0, 1, 0}, py::arg("offset") = 0.0f,
             py::arg("friction") = 0.0f, py::arg("restitution") = 0.0f)
        .def("add_cloth", &Scene::addCloth)
        .def("add_lattice", &Scene::addLattice)
        .def("add_mesh", &Scene::addMesh, py::arg("vertices"), py::arg("triangles"))
        .def("add_mesh_file", &Scene::addMeshFile, py::arg("path"), py::arg("scale") = 1.0f)
        .def("validate", &Scene::validate, py::arg("settings") = py::none())
        .def("describe", &Scene::describe, py::arg("settings") = py::none())
        .def_property_readonly("particle_count", &Scene::particles)
        .def_property_readonly(
            "settings", [](const Scene& self) { return Settings{settingsOf(std::nullopt, self.handle)}; })
        .def_property(
            "dt", [](const Scene& self) { return self.values().dt; },
            [](Scene& self, float dt) {
                SinewSceneValues values = self.values();
                values.dt = dt;
                check(sinewSetSceneValues(self.handle, &values));
            })
        .def_property(
            "gravity",
            [](const Scene& self) {
                const SinewVec3 gravity = self.values().gravity;
                return Vector{gravity.x, gravity.y, gravity.z};
            },
            [](Scene& self, const Vector& gravity) {
                SinewSceneValues values = self.values();
                values.gravity = toVec3(gravity);
                check(sinewSetSceneValues(self.handle, &values));
            });
    addSimulation(module);
}

} // namespace sinew::python
