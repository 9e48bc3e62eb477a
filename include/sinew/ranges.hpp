// The only table of allowed numbers: validate.cpp checks scenes against it, and scene files and their
// documentation read it.
#pragma once

#include "sinew/export.hpp"

#include <cstdint>
#include <limits>
#include <string>

namespace sinew::sim {

/// An interval of finite numbers, closed unless an end is open.
struct SINEW_API Range {
    double low = std::numeric_limits<double>::lowest();
    double high = std::numeric_limits<double>::max();
    bool isLowOpen = false, isHighOpen = false;

    /// Whether `value` is allowed; false for NaN and infinities.
    constexpr bool holds(double value) const {
        return (isLowOpen ? value > low : value >= low) && (isHighOpen ? value < high : value <= high);
    }
};

/// Text after "must be": "from 1 to 1000", "above 0 and at most 0.1", "at least 0", "a finite number".
SINEW_API std::string toText(const Range& range);

namespace ranges {

inline constexpr double largest = std::numeric_limits<float>::max(); // that the device can represent

// Scene
inline constexpr Range finite{-largest, largest};
inline constexpr Range dt{double{1e-6f}, double{0.1f}};                        // [s]
inline constexpr Range damping{0, largest};                                    // [1/s]
inline constexpr Range dampingTime{0, 1};                                      // [s]
inline constexpr Range inverseMass{0, largest};                                // [1/kg]
inline constexpr Range restLength{0, largest};                                 // [m]
inline constexpr Range compliance{0, largest};                                 // [m/N]
inline constexpr Range skipStiffness{0, largest};                              // [N/m]
inline constexpr Range maxForce{.low = 0, .high = largest, .isLowOpen = true}; // [N]
inline constexpr Range maxSpeed{.low = 0, .high = largest, .isLowOpen = true}; // [m/s]
inline constexpr Range tetherLength{0, largest};                               // [m]
/// Limit of attachments: their moving points travel in the command buffer, 64 KiB at a time.
inline constexpr std::size_t mostAttachments = 1024;
/// Points of each of the two poly-lines of a blade.
inline constexpr std::size_t mostBladePoints = 256;
inline constexpr Range friction{0, largest};
inline constexpr Range restitution{0, 1};
inline constexpr Range radius{0, largest};                                         // [m]
inline constexpr Range colliderSize{.low = 0, .high = largest, .isLowOpen = true}; // [m]
inline constexpr Range colliderLength{0, largest};                                 // [m]
inline constexpr Range margin{0, largest};                                         // [m]
inline constexpr Range pathTime{0, largest};                                       // [s]
inline constexpr std::uint32_t mostGrabs = 8, mostHostColliders = 1024, mostFields = 16, mostMotions = 64;
/// Limit of colliders, without those of the host; MOST_MOVERS in layout.h is the sum of these limits.
inline constexpr std::size_t mostColliders = 1024;
inline constexpr std::size_t mostDriven = 64;
inline constexpr Range recoverySpeed{.low = 0, .high = largest, .isLowOpen = true}; // [m/s]
inline constexpr std::size_t mostSurfaces = 64;    // a table of their pairs goes to the device
inline constexpr std::size_t mostFaces = 1u << 29; // their corners are counted in 32 bits
inline constexpr Range normalLength{1 - 1e-3, 1 + 1e-3};
inline constexpr Range poissonRatio{0.25,
                                    double{0.49f}}; // of a lattice; below 1/4 its volume would be unstable
inline constexpr Range recovery{0, 10};             // [shear moduli]
inline constexpr Range pressure{0, largest};        // [Pa]
inline constexpr Range restVolume{0, largest};      // [m^3]
inline constexpr Range embeddingWeight{-1e-3, 1 + 1e-3}; // rounding of a vertex on a cell's face
inline constexpr Range color{0, 1};
inline constexpr Range tearStrain{0, 100};
inline constexpr Range tearsPerStep{1, 65535};
inline constexpr Range toughness{0, 1e9};     // [J/m^2]
inline constexpr std::size_t mostPlanes = 32; // bits of the touched set in planes.glsl

// Settings
inline constexpr Range substeps{1, 1000};
/// Range of the automatic choice of substeps.
inline constexpr std::uint32_t fewestChosen = 4, mostChosen = 256;
/// Lower limit of that choice if particles may touch each other: falling clutter then overlaps by 0.1 radii.
inline constexpr std::uint32_t fewestTouching = 16;
inline constexpr Range tolerance{.low = 0, .high = 1, .isLowOpen = true, .isHighOpen = true};
inline constexpr Range iterations{1, 1000};
/// Limit of sweeps in one step: bounds the pass list, and the duration of one submission for devices with a
/// watchdog.
inline constexpr std::uint64_t mostSweeps = 20'000;
/// Limit of passes of `gauss_seidel`, one for each color and sweep: the number that `jacobi` has with
/// mostSweeps.
inline constexpr std::uint64_t mostColorPasses = 3 * mostSweeps;
/// Limits of links of one particle. The warm start of `gauss_seidel` unrolls the links of moving particles;
/// other kernels loop, and some devices silently end a loop at 65,535.
inline constexpr std::uint32_t mostLinksUnrolled = 128, mostLinks = 60'000;
/// Limit of bends of one particle: `split` unrolls them and reserves room for so many at every particle.
inline constexpr std::uint32_t mostBends = 128;
inline constexpr Range omega{.low = 0, .high = 10, .isLowOpen = true, .isHighOpen = true};
inline constexpr Range theta{0, 1};
inline constexpr Range levels{0, 6};
inline constexpr Range weight{0, 1};
inline constexpr Range warmStart{0, 1};
inline constexpr Range contactMargin{.low = 0, .high = 10, .isLowOpen = true};
inline constexpr std::uint32_t mostContactRoom = 1024; // CONTACT_MOST_ROOM in layout.h
inline constexpr Range contactRoom{1, mostContactRoom};
/// Limit of particles of other bodies within a space of a particle's size when a scene is loaded.
inline constexpr std::uint32_t mostInOneSpot = 256;
inline constexpr Range framesInFlight{1, 64};
inline constexpr Range outputFrames{0, 8};
inline constexpr Range eventRoom{1, 65536};
/// The flags that Settings::outputUsage may have: those of Vulkan 1.0 (bits 0 to 8), device addresses (bit
/// 17), for which buffers must come from a host's BufferHook, and the input of acceleration structures (bit
/// 19).
inline constexpr std::uint32_t outputUsages = 0x1ff | 1u << 17 | 1u << 19;
/// Limit of the pairs of a body and what it may touch whose contacts are events.
inline constexpr std::uint64_t mostEventPairs = 1u << 24;
inline constexpr std::uint32_t mostCutSurfaceRoom = 16'000'000; // the next number is exact in float too
inline constexpr Range cutSurfaceRoom{0, mostCutSurfaceRoom};
inline constexpr Range debris{0, 1'000'000};
/// `jacobi` converges on any graph if its factor on averaged corrections is below this.
inline constexpr double provenRelaxation = 4.0 / 3;
inline constexpr Range overRelaxation{.low = 0, .high = 2, .isLowOpen = true, .isHighOpen = true};

inline constexpr Range columns{0, 2};   // of Settings::forms: kernels exist for these; 0 = by the device
inline constexpr Range chunk{0, 65535}; // of Settings::forms; 0 = by the device
/// Limit of the nodes of all grids of a scene: their padded boxes are counted in 32 bits.
inline constexpr double mostGridNodes = 1 << 30;

/// Largest omega with which `split` is stable on any graph: a mode with h^2 K = s is stable for s (1 + 2
/// theta) <= 4.
constexpr double omegaBound(double thetaValue) {
    return 4 / (1 + 2 * thetaValue);
}

} // namespace ranges
} // namespace sinew::sim
