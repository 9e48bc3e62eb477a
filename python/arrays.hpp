// Arrays and vectors between Python and the C interface.
#pragma once

#include "sinew/sinew_events.h"
#include "sinew/sinew_motions.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <vector>

namespace sinew::python {

namespace py = pybind11;

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;
using Vector = std::array<float, 3>;

/// Throws sinew.Error with the last sentence unless `result` is a success.
void check(SinewResult result);

inline SinewVec3 toVec3(const Vector& v) {
    return {v[0], v[1], v[2]};
}

/// The number of rows of an array with `columns` columns. Throws ValueError that names the array.
std::uint32_t rowsOf(const py::array& array, std::size_t columns, const char* name);

/// Names of the kinds of events, by bit of SinewSettings::events.
inline constexpr std::array<const char*, 9> eventNames{
    "contact_begins", "contact_ends", "cut", "tear", "pieces", "sleeps", "wakes", "lacks_room", "fragments"};
/// Events of the newest steps of a simulation, as a list of dicts.
py::list eventsOf(SinewSimulation simulation);

/// Impulses on bodies in the newest step, with the axes body, kind, part and coordinate.
py::array_t<float> impulsesOf(SinewSimulation simulation);
/// Impulse on the blade in the newest step; 0 if no body has a toughness.
py::array_t<float> bladeImpulseOf(SinewSimulation simulation);

/// Values of `count` elements, given as one number or as an array with one for each.
class PerElement {
public:
    PerElement(const Floats& values, std::uint32_t count, const char* name);
    float operator[](std::uint32_t i) const { return isOne_ ? data_[0] : data_[i]; }

private:
    Floats values_;
    const float* data_;
    bool isOne_;
};

/// An output of a simulation as an array of `columns` columns: a view of its memory if the host sees it,
/// which keeps `owner` alive, else a copy. It cannot be written to.
py::array outputArray(SinewDevice device, SinewSimulation simulation, std::uint32_t output, py::object owner);

} // namespace sinew::python
