// The module `sinew._sinew`: classes over the C interface. sinew/__init__.pyi documents them.
#include "scene.hpp"

#include <variant>

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

constexpr std::array<const char*, 3> solverNames{"jacobi", "split", "gauss_seidel"};

struct State : Owned<SinewState, sinewDestroyState> {};

struct Simulation : Owned<SinewSimulation, sinewDestroySimulation> {
    Simulation(std::shared_ptr<Device> itsDevice, const Scene& scene, const std::optional<Settings>& settings)
        : device(std::move(itsDevice)), step_(stepOf(scene)) {
        const SinewSettings given = settingsOf(settings, scene.handle);
        runUnlocked([&] { return sinewCreateSimulation(device->handle, scene.handle, &given, &handle); });
    }

    void step(std::uint32_t count, const std::optional<float>& dt, const std::optional<Vector>& gravity,
              const std::optional<Floats>& anchors, const std::vector<SinewGrab>& grabs,
              const std::vector<SinewField>& fields, const std::vector<SinewHostCollider>& hostColliders,
              const std::vector<SinewMotion>& motions, const Blade* blade) {
        const StepInput input(step_, dt, gravity, anchors, grabs, fields, hostColliders, motions, blade);
        runUnlocked([&] { return sinewStep(handle, &input.step, count); });
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

    std::vector<std::string> complaints() {
        std::vector<std::string> sentences;
        const char* sentence = nullptr;
        while (sinewNextComplaint(handle, &sentence) == SINEW_OK) sentences.emplace_back(sentence);
        return sentences;
    }

    std::shared_ptr<Device> device; // destroyed after the simulation

private:
    SinewStep step_;
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
    type.def_property(
        "events",
        [](const Settings& settings) {
            std::vector<std::string> names;
            for (std::size_t kind = 0; kind < eventNames.size(); ++kind)
                if ((settings.values.events >> kind & 1) != 0) names.emplace_back(eventNames[kind]);
            return names;
        },
        [](Settings& settings, const std::vector<std::string>& names) {
            std::uint32_t events = 0;
            for (const std::string& name : names) {
                const auto found = std::ranges::find(eventNames, name);
                if (found == eventNames.end()) throw py::value_error("there is no event " + name);
                events |= 1u << (found - eventNames.begin());
            }
            settings.values.events = events;
        });
    add("event_room", &SinewSettings::eventRoom);
    add("substeps", &SinewSettings::substeps);
    add("iterations", &SinewSettings::iterations);
    add("tolerance", &SinewSettings::tolerance);
    add("contact_margin", &SinewSettings::contactMargin);
    add("contact_room", &SinewSettings::contactRoom);
    add("grabs", &SinewSettings::grabs);
    add("fields", &SinewSettings::fields);
    add("host_colliders", &SinewSettings::hostColliders);
    add("motions", &SinewSettings::motions);
    add("frames_in_flight", &SinewSettings::framesInFlight);
    add("omega", &SinewSettings::omega);
    add("theta", &SinewSettings::theta);
    type.def_property(
        "levels",
        [](const Settings& settings) -> py::object {
            if (settings.values.levels == SINEW_AUTO_LEVELS) return py::str("auto");
            return py::int_(settings.values.levels);
        },
        [](Settings& settings, const std::variant<std::uint32_t, std::string>& levels) {
            if (const std::string* word = std::get_if<std::string>(&levels); word && *word != "auto")
                throw py::value_error("levels is \"" + *word +
                                      "\": must be a number from 0 to 6, or \"auto\"");
            const std::uint32_t* number = std::get_if<std::uint32_t>(&levels);
            settings.values.levels = number ? *number : SINEW_AUTO_LEVELS;
        });
    add("weight", &SinewSettings::weight);
    add("over_relaxation", &SinewSettings::overRelaxation);
    add("warm_start", &SinewSettings::warmStart);
    addFlag("sleeps", &SinewSettings::sleeps);
    addFlag("keeps_forces", &SinewSettings::keepsForces);
    addFlag("keeps_previous", &SinewSettings::keepsPrevious);
    addFlag("sharp_clamp", &SinewSettings::hasSharpClamp);
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
    py::class_<SinewHostCollider>(module, "HostCollider")
        .def(py::init([](const std::string& shape, const Vector& position,
                         const std::array<float, 4>& rotation, float radius, float halfLength,
                         const Vector& halfExtents, float friction, float staticFriction, float maxSpeed) {
                 constexpr const char* shapes[] = {"sphere", "capsule", "box"};
                 static_assert(SINEW_SPHERE == 0 && SINEW_CAPSULE == 1 && SINEW_BOX == 2);
                 const auto found = std::ranges::find(shapes, shape);
                 if (found == std::end(shapes)) throw py::value_error("there is no shape " + shape);
                 SinewHostCollider collider = sinewDefaultHostCollider();
                 collider.shape = static_cast<std::uint32_t>(found - std::begin(shapes));
                 collider.radius = radius;
                 collider.halfLength = halfLength;
                 collider.halfExtents = toVec3(halfExtents);
                 collider.friction = friction;
                 collider.staticFriction = staticFriction;
                 collider.pose.position = toVec3(position);
                 collider.pose.rotation = {rotation[0], rotation[1], rotation[2], rotation[3]};
                 collider.maxSpeed = maxSpeed;
                 return collider;
             }),
             py::arg("shape"), py::arg("position"), py::arg("rotation") = std::array<float, 4>{0, 0, 0, 1},
             py::arg("radius") = 0.0f, py::arg("half_length") = 0.0f, py::arg("half_extents") = Vector{},
             py::arg("friction") = 0.3f, py::arg("static_friction") = 0.0f, py::arg("max_speed") = 10.0f);
    py::class_<Blade>(module, "Blade")
        .def(py::init<const Floats&, const Floats&, bool>(), py::arg("before"), py::arg("after"),
             py::arg("carried") = false);
    py::class_<SinewMotion>(module, "Motion")
        .def(py::init([](const std::string& kind, std::uint32_t body, const Vector& linear,
                         const Vector& angular, const std::array<float, 4>& rotation, const Vector& center,
                         float radius) {
                 constexpr const char* kinds[] = {"add_velocity", "set_velocity", "impulse",
                                                  "pose",         "spawn",        "despawn"};
                 const auto found = std::ranges::find(kinds, kind);
                 if (found == std::end(kinds)) throw py::value_error("there is no motion of kind " + kind);
                 return SinewMotion{static_cast<std::uint32_t>(found - std::begin(kinds)),
                                    body,
                                    toVec3(center),
                                    radius,
                                    toVec3(linear),
                                    toVec3(angular),
                                    {rotation[0], rotation[1], rotation[2], rotation[3]}};
             }),
             py::arg("kind"), py::arg("body") = SINEW_ALL_BODIES, py::arg("linear") = Vector{},
             py::arg("angular") = Vector{}, py::arg("rotation") = std::array<float, 4>{0, 0, 0, 1},
             py::arg("center") = Vector{}, py::arg("radius") = 0.0f);
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
             py::arg("grabs") = std::vector<SinewGrab>{}, py::arg("fields") = std::vector<SinewField>{},
             py::arg("host_colliders") = std::vector<SinewHostCollider>{},
             py::arg("motions") = std::vector<SinewMotion>{},
             py::arg("blade") = static_cast<const Blade*>(nullptr))
        .def("reset", [](Simulation& self) { runUnlocked([&] { return sinewReset(self.handle); }); })
        .def("update_skin",
             [](Simulation& self) { runUnlocked([&] { return sinewUpdateSkin(self.handle); }); })
        .def("save",
             [](Simulation& self) {
                 auto state = std::make_shared<State>();
                 runUnlocked([&] { return sinewSaveState(self.handle, &state->handle); });
                 return state;
             })
        .def("load",
             [](Simulation& self, const State& state) {
                 runUnlocked([&] { return sinewLoadState(self.handle, state.handle); });
             })
        .def("status", &Simulation::status)
        .def("impulses", [](const Simulation& self) { return impulsesOf(self.handle); })
        .def("blade_impulse", [](const Simulation& self) { return bladeImpulseOf(self.handle); })
        .def("events", [](const Simulation& self) { return eventsOf(self.handle); })
        .def("complaints", &Simulation::complaints)
        .def_property_readonly("positions", output(SINEW_POSITIONS))
        .def_property_readonly("velocities", output(SINEW_VELOCITIES))
        .def_property_readonly("previous_positions", output(SINEW_PREVIOUS_POSITIONS))
        .def_property_readonly("previous_skin_vertices", output(SINEW_PREVIOUS_SKIN_VERTICES))
        .def_property_readonly("skin_vertices", output(SINEW_SKIN_VERTICES))
        .def_property_readonly("skin_indices", output(SINEW_SKIN_INDICES))
        .def_property_readonly("texture_coordinates", output(SINEW_TEXTURE_COORDINATES))
        .def_property_readonly("cut_vertices", output(SINEW_CUT_VERTICES))
        .def_property_readonly("cut_rest", output(SINEW_CUT_REST))
        .def_property_readonly("cut_indices", output(SINEW_CUT_INDICES))
        .def_property_readonly("cut_draws", output(SINEW_CUT_DRAWS))
        .def_property_readonly("cut_texture_coordinates", output(SINEW_CUT_TEXTURE_COORDINATES))
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
        .def("set_absent", &Scene::setAbsent, py::arg("body"), py::arg("absent") = true)
        .def("add_plane", &Scene::addPlane, py::arg("normal") = Vector{0, 1, 0}, py::arg("offset") = 0.0f,
             py::arg("friction") = 0.0f, py::arg("restitution") = 0.0f)
        .def("add_cloth", &Scene::addCloth)
        .def("add_lattice", &Scene::addLattice)
        .def("add_mesh", &Scene::addMesh, py::arg("vertices"), py::arg("triangles"),
             py::arg("texture_coordinates") = py::none())
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
    addWorld(module);
}

} // namespace sinew::python
