// Worlds of the module: parts come and go between steps.
#include "scene.hpp"

#include "sinew/sinew_query.h"

namespace sinew::python {

namespace {

/// The place of the elements of a part, or those of the whole world.
py::dict dictOf(const SinewSceneCounts& counts) {
    using namespace py::literals;
    return py::dict("particles"_a = counts.particles, "links"_a = counts.links, "bends"_a = counts.bends,
                    "tethers"_a = counts.tethers, "fixed"_a = counts.fixed,
                    "attachments"_a = counts.attachments, "faces"_a = counts.faces,
                    "planes"_a = counts.planes, "colliders"_a = counts.colliders, "bodies"_a = counts.bodies,
                    "grids"_a = counts.grids, "skins"_a = counts.skins);
}

struct World : Owned<SinewWorld, sinewDestroyWorld> {
    World(std::shared_ptr<Device> itsDevice, const Scene& base, const std::optional<Settings>& settings)
        : device(std::move(itsDevice)), step_(stepOf(base)) {
        const SinewSettings given = settingsOf(settings, base.handle);
        runUnlocked([&] { return sinewCreateWorld(device->handle, base.handle, &given, &handle); });
    }

    SinewPart add(const Scene& scene) {
        SinewPart part{};
        runUnlocked([&] { return sinewAddPart(handle, scene.handle, &part); });
        return part;
    }

    bool contains(const SinewPart& part) const {
        std::uint32_t isContained = 0;
        check(sinewContainsPart(handle, part, &isContained));
        return isContained != 0;
    }

    struct Place {
        SinewSceneCounts first{}, count{};
    };
    /// Nothing before the part has arrived.
    std::optional<Place> placeOf(const SinewPart& part) const {
        Place place;
        place.first.size = place.count.size = sizeof(SinewSceneCounts);
        const SinewResult result = sinewFindPart(handle, part, &place.first, &place.count);
        check(result);
        return result == SINEW_OK ? std::optional(place) : std::nullopt;
    }

    py::object find(const SinewPart& part) const {
        const std::optional<Place> place = placeOf(part);
        if (!place) return py::none();
        const py::dict first = dictOf(place->first), count = dictOf(place->count);
        py::dict ranges;
        for (const auto& [kind, begin] : first) ranges[kind] = py::make_tuple(begin, count[kind]);
        return ranges;
    }

    void step(std::uint32_t count, const std::optional<float>& dt, const std::optional<Vector>& gravity,
              const std::optional<Floats>& anchors, const std::vector<SinewGrab>& grabs,
              const std::vector<SinewField>& fields, const std::vector<SinewHostCollider>& hostColliders,
              const std::vector<SinewMotion>& motions, const Blade* blade) {
        const StepInput input(step_, dt, gravity, anchors, grabs, fields, hostColliders, motions, blade);
        runUnlocked([&] { return sinewStepWorld(handle, &input.step, count); });
    }

    SinewWorldInfo info() const {
        SinewWorldInfo info{};
        info.size = sizeof info;
        check(sinewGetWorldInfo(handle, &info));
        return info;
    }

    SinewSceneCounts counts() const {
        SinewSceneCounts counts{};
        counts.size = sizeof counts;
        check(sinewGetWorldCounts(handle, &counts));
        return counts;
    }

    std::uint64_t stepsDone() const {
        SinewSimulationInfo made{};
        made.size = sizeof made;
        check(sinewGetSimulationInfo(info().simulation, &made));
        return made.stepsDone;
    }

    /// A copy of rows of an output with four columns: those of a part, or all.
    py::array_t<float> rows(std::uint32_t output, const std::optional<SinewPart>& part) const {
        std::size_t first = 0, count = counts().particles;
        if (part) {
            const std::optional<Place> place = placeOf(*part);
            if (!place) throw py::value_error("the part has not arrived: call update() or step()");
            first = place->first.particles;
            count = place->count.particles;
        }
        py::array_t<float> array(std::vector<py::ssize_t>{static_cast<py::ssize_t>(count), 4});
        if (count == 0) return array;
        SinewBufferView view{};
        check(sinewGetView(info().simulation, output, &view));
        const std::size_t stride = 4 * sizeof(float), size = count * stride;
        view.offset += first * stride;
        view.size = size;
        void* const bytes = array.mutable_data();
        runUnlocked([&] { return sinewDownload(device->handle, &view, size, bytes); });
        return array;
    }

    /// The first hit of a ray on the bodies, or None.
    py::object pick(const Vector& origin, const Vector& direction, float length, bool skipsFixed) {
        const SinewRay ray{toVec3(origin), toVec3(direction), length, skipsFixed ? 1u : 0u};
        SinewRayHit hit{};
        hit.size = sizeof hit;
        const SinewQuery asked = query();
        runUnlocked([&] { return sinewCastRay(asked, &ray, &hit); });
        if (hit.isMet == 0) return py::none();
        using namespace py::literals;
        return py::dict("particle"_a = hit.particle,
                        "body"_a = hit.body == 0xffffffffu ? py::object(py::none()) : py::int_(hit.body),
                        "point"_a = Vector{hit.point.x, hit.point.y, hit.point.z},
                        "place"_a = Vector{hit.place.x, hit.place.y, hit.place.z},
                        "distance"_a = hit.distance);
    }

    /// The particles inside a box along the axes, grown by a radius.
    py::array_t<std::uint32_t> overlap(const Vector& center, const Vector& halfExtents, float radius,
                                       bool skipsFixed) {
        const SinewRegion region{toVec3(center), toVec3(halfExtents), radius, skipsFixed ? 1u : 0u};
        const SinewQuery asked = query();
        std::vector<std::uint32_t> particles(counts().particles);
        auto count = static_cast<std::uint32_t>(particles.size());
        runUnlocked([&] { return sinewFindParticles(asked, &region, &count, particles.data()); });
        return py::array_t<std::uint32_t>(static_cast<py::ssize_t>(count), particles.data());
    }

    std::shared_ptr<Device> device; // destroyed after the world

private:
    /// For the present simulation: made anew after a take-over.
    SinewQuery query() {
        const std::uint64_t now = info().takeOvers;
        if (!query_ || queriedAt_ != now) {
            const SinewQueryRoom room{sizeof room, 1, std::max(counts().particles, 1u), 1};
            auto made = std::make_unique<Query>();
            runUnlocked([&] { return sinewCreateWorldQuery(handle, &room, &made->handle); });
            query_ = std::move(made);
            queriedAt_ = now;
        }
        return query_->handle;
    }

    struct Query : Owned<SinewQuery, sinewDestroyQuery> {};
    SinewStep step_;
    std::unique_ptr<Query> query_;
    std::uint64_t queriedAt_ = 0; // take-overs when it was made
};

} // namespace

void addWorld(py::module_& module) {
    py::class_<SinewPart>(module, "Part")
        .def("__eq__",
             [](const SinewPart& self, const SinewPart& other) {
                 return self.world == other.world && self.index == other.index &&
                        self.generation == other.generation;
             })
        .def("__hash__",
             [](const SinewPart& self) {
                 return py::hash(py::make_tuple(self.world, self.index, self.generation));
             })
        .def("__repr__", [](const SinewPart& self) {
            return "<sinew.Part " + std::to_string(self.index) + "." + std::to_string(self.generation) + ">";
        });
    const auto output = [](std::uint32_t which) {
        return [which](const World& self, const std::optional<SinewPart>& part) {
            return self.rows(which, part);
        };
    };
    py::class_<World, std::shared_ptr<World>>(module, "World")
        .def(py::init<std::shared_ptr<Device>, const Scene&, const std::optional<Settings>&>(),
             py::arg("device"), py::arg("base"), py::arg("settings") = py::none())
        .def("add", &World::add, py::arg("scene"))
        .def(
            "remove", [](World& self, const SinewPart& part) { check(sinewRemovePart(self.handle, part)); },
            py::arg("part"))
        .def("__contains__", &World::contains, py::arg("part"))
        .def("find", &World::find, py::arg("part"))
        .def("update", [](World& self) { runUnlocked([&] { return sinewUpdateWorld(self.handle); }); })
        .def("step", &World::step, py::arg("count") = 1, py::arg("dt") = py::none(),
             py::arg("gravity") = py::none(), py::arg("anchors") = py::none(),
             py::arg("grabs") = std::vector<SinewGrab>{}, py::arg("fields") = std::vector<SinewField>{},
             py::arg("host_colliders") = std::vector<SinewHostCollider>{},
             py::arg("motions") = std::vector<SinewMotion>{},
             py::arg("blade") = static_cast<const Blade*>(nullptr))
        .def("positions", output(SINEW_POSITIONS), py::arg("part") = py::none())
        .def("velocities", output(SINEW_VELOCITIES), py::arg("part") = py::none())
        .def("pick", &World::pick, py::arg("origin"), py::arg("direction"), py::arg("length") = 0.0f,
             py::arg("skips_fixed") = false)
        .def("overlap", &World::overlap, py::arg("center"), py::arg("half_extents") = Vector{},
             py::arg("radius") = 0.0f, py::arg("skips_fixed") = false)
        .def("events", [](const World& self) { return eventsOf(self.info().simulation); })
        .def("impulses", [](const World& self) { return impulsesOf(self.info().simulation); })
        .def("blade_impulse", [](const World& self) { return bladeImpulseOf(self.info().simulation); })
        .def("counts", [](const World& self) { return dictOf(self.counts()); })
        .def_property_readonly("is_changing", [](const World& self) { return self.info().isChanging != 0; })
        .def_property_readonly("take_overs", [](const World& self) { return self.info().takeOvers; })
        .def_property_readonly("substeps", [](const World& self) { return self.info().substeps; })
        .def_property_readonly("steps_done", &World::stepsDone);
}

} // namespace sinew::python
