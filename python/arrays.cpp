// Arrays and vectors between Python and the C interface.
#include "arrays.hpp"

#include <algorithm>
#include <string>

namespace sinew::python {

std::uint32_t rowsOf(const py::array& array, std::size_t columns, const char* name) {
    const bool fits = columns == 1 ? array.ndim() == 1
                                   : array.ndim() == 2 && static_cast<std::size_t>(array.shape(1)) == columns;
    if (!fits || array.shape(0) > 0x7fffffff)
        throw py::value_error(
            std::string(name) + " must have " +
            (columns == 1 ? "one dimension" : "the shape (n, " + std::to_string(columns) + ")"));
    return static_cast<std::uint32_t>(array.shape(0));
}

PerElement::PerElement(const Floats& values, std::uint32_t count, const char* name)
    : values_(values), data_(values_.data()), isOne_(values_.ndim() == 0) {
    if (!isOne_ && (values_.ndim() != 1 || values_.shape(0) != static_cast<py::ssize_t>(count)))
        throw py::value_error(std::string(name) + " must be a number, or an array of " +
                              std::to_string(count));
}

py::array outputArray(SinewDevice device, SinewSimulation simulation, std::uint32_t output,
                      py::object owner) {
    SinewBufferView view{};
    check(sinewGetView(simulation, output, &view));
    const bool isIndices = view.stride == 4 || output == SINEW_CUT_DRAWS;
    const py::ssize_t columns = view.stride / 4;
    const py::ssize_t rows = view.stride == 0 ? 0 : static_cast<py::ssize_t>(view.size / view.stride);
    const py::dtype type = isIndices ? py::dtype::of<std::uint32_t>() : py::dtype::of<float>();
    const std::vector<py::ssize_t> shape =
        columns == 1 ? std::vector<py::ssize_t>{rows} : std::vector<py::ssize_t>{rows, columns};
    const void* address = nullptr;
    std::size_t size = 0;
    py::array array;
    if (rows == 0) {
        array = py::array(type, shape);
    } else if (sinewMap(simulation, output, &address, &size) == SINEW_OK) {
        array = py::array(type, shape, address, owner);
    } else {
        array = py::array(type, shape);
        check(sinewDownload(device, &view, static_cast<std::size_t>(view.size), array.mutable_data()));
    }
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

namespace {

SinewSimulationInfo infoOf(SinewSimulation simulation) {
    SinewSimulationInfo info{};
    info.size = sizeof info;
    check(sinewGetSimulationInfo(simulation, &info));
    return info;
}

} // namespace

py::array_t<float> impulsesOf(SinewSimulation simulation) {
    const SinewSimulationInfo info = infoOf(simulation);
    std::uint32_t count = info.bodies;
    std::vector<SinewBodyImpulses> impulses(count);
    const std::uint64_t next = info.nextFrame;
    if (next == 0 || sinewGetBodyImpulses(simulation, next - 1, &count, impulses.data()) != SINEW_OK)
        count = 0;
    py::array_t<float> array(std::vector<py::ssize_t>{count, 5, 2, 3});
    static_assert(sizeof(SinewBodyImpulses) == 5 * 2 * 3 * sizeof(float));
    std::memcpy(array.mutable_data(), impulses.data(), count * sizeof(SinewBodyImpulses));
    return array;
}

py::array_t<float> bladeImpulseOf(SinewSimulation simulation) {
    std::uint32_t count = 1;
    SinewImpulse impulse{};
    const std::uint64_t next = infoOf(simulation).nextFrame;
    if (next > 0) check(sinewGetImpulses(simulation, next - 1, SINEW_IMPULSES_BLADE, &count, &impulse));
    py::array_t<float> array(3);
    std::memcpy(array.mutable_data(), &impulse.linear, sizeof impulse.linear);
    return array;
}

py::list eventsOf(SinewSimulation simulation) {
    constexpr std::array<const char*, 5> partners{"", "body", "plane", "host_collider", "collider"};
    std::uint32_t count = 0;
    check(sinewGetStepEvents(simulation, &count, nullptr, nullptr));
    std::vector<SinewEvent> events(count);
    check(sinewGetStepEvents(simulation, &count, events.data(), nullptr));
    events.resize(std::min<std::size_t>(count, events.size())); // another thread may have stepped in between
    using namespace py::literals;
    py::list list;
    for (const SinewEvent& event : events) {
        py::dict entry("step"_a = event.frame, "kind"_a = eventNames[event.kind]);
        if (event.kind != SINEW_EVENT_LACKS_ROOM) entry["body"] = event.body;
        if (event.partner != SINEW_PARTNER_NONE) {
            entry["partner"] = partners[event.partner];
            entry["other"] = event.other;
        }
        entry["count"] = event.count;
        list.append(entry);
    }
    return list;
}

} // namespace sinew::python
